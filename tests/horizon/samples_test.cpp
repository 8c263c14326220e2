// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>

#include "horizon/horizon_test.h"

namespace geomend::test {
namespace {

Dataset sample(std::string_view format_name, const std::string& name) {
    const auto input = Input::open(std::string(GEOMEND_SOURCE_DIR) + "/samples/" + name);
    EXPECT_TRUE(input.ok()) << name;
    auto dataset = format(format_name).read(*input, {});
    EXPECT_TRUE(dataset.ok()) << name;
    return std::move(dataset).value();
}

double expected_height(double x, double y) { return -300 + 20 * std::sin(x / 150) - y / 40; }

TEST(Samples, TheTurnedGridIsReadAsItWasMade) {
    const Dataset d = sample("irap-grid", "h1_grid.irap");
    ASSERT_EQ(raster_of(d).dims, (std::array<std::uint32_t, 3>{7, 5, 1}));
    EXPECT_TRUE(missing(d, 0, 0));
    EXPECT_TRUE(missing(d, 6, 4));
    EXPECT_NEAR(height(d, 5, 2), expected_height(500, 200), 5e-4);
    EXPECT_NEAR(place(d, 6, 0)[0], 300 + 600 * std::sqrt(3.0) / 2, 1e-9);
    EXPECT_NEAR(place(d, 6, 0)[1], 50 + 300, 1e-9);
}

TEST(Samples, TheFixedWidthGridIsReadAsItWasMade) {
    const Dataset d = sample("zmap", "h1_grid.zmap");
    ASSERT_EQ(raster_of(d).dims, (std::array<std::uint32_t, 3>{6, 4, 1}));
    for (std::uint32_t j = 0; j < 4; ++j) {
        for (std::uint32_t i = 0; i < 6; ++i) {
            const Vec3 p = place(d, i, j);
            EXPECT_EQ(p, (Vec3{200.0 * i, 200.0 * j, 0}));
            EXPECT_EQ(missing(d, i, j), i == 5 && j < 3);
            if (!missing(d, i, j)) {
                EXPECT_NEAR(height(d, i, j), expected_height(p[0], p[1]), 5e-4);
            }
        }
    }
    EXPECT_EQ(raster_of(d).info.name, "H1");
}

}  // namespace
}  // namespace geomend::test
