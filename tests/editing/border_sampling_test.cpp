// SPDX-License-Identifier: AGPL-3.0-or-later
#include "editing/border_sampling.h"

#include <gtest/gtest.h>

namespace geomend::editing {
namespace {

using Order = std::vector<std::uint32_t>;

// N. Euler's acceptance tests 22 to 24.
TEST(BorderSampling, ACommonBorderHasAsManyEdgesAsItsPoorestSurfaceNeeds) {
    EXPECT_EQ(common_edges(5, false), 4u) << "5 and 6 representative nodes";
    EXPECT_EQ(common_edges(5, true), 5u);
    EXPECT_EQ(common_edges(2, false), 2u) << "only the ends are representative";
    EXPECT_EQ(common_edges(0, true), 2u);
}

std::vector<std::array<Vec3, 3>> star(const Vec3& p, const std::vector<Vec3>& ring) {
    std::vector<std::array<Vec3, 3>> triangles;
    for (std::size_t i = 0; i < ring.size(); ++i) triangles.push_back({p, ring[i], ring[(i + 1) % ring.size()]});
    return triangles;
}

TEST(BorderSampling, ARelaxedVertexLiesInTheMiddleOfItsRing) {
    const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, oblong{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
    const Vec3 a = relaxed_place(star({0.8, 0.5, 0}, square)), b = relaxed_place(star({0.9, 0.2, 0}, oblong));
    for (const auto& [found, expected] : {std::pair{a, Vec3{0.5, 0.5, 0}}, {b, Vec3{1, 0.5, 0}}}) {
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], 1e-12);
    }
}

TEST(BorderSampling, TheOrderOfMostGroupsPrevails) {
    const std::vector<Order> groups{{1, 2, 3}, {1, 3, 2}, {2, 3, 1}, {}, {3, 1, 2}};
    EXPECT_EQ(prevailing_order(groups), (Order{1, 2, 3}));
    EXPECT_TRUE(same_order({1, 2, 3}, {3, 1, 2}));
    EXPECT_FALSE(same_order({1, 2, 3}, {1, 3, 2}));
    EXPECT_TRUE(prevailing_order(std::vector<Order>{{}, {}}).empty());
}

}  // namespace
}  // namespace geomend::editing
