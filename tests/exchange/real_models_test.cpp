// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <ostream>

#include "base/input.h"
#include "exchange/model_from_brep.h"
#include "formats/gmsh/gmsh.h"
#include "formats/gocad/gocad.h"
#include "support/real_data.h"
#include "topology/brep_from_dataset.h"

namespace geomend {
namespace {

struct Known {
    const char* file;
    std::size_t corners, lines, surfaces, regions, vertices, polygons;
};
void PrintTo(const Known& o, std::ostream* out) { *out << o.file; }

Result<Dataset> read(const std::filesystem::path& path, std::span<const Format> rows) {
    auto input = Input::open(path.string());
    if (!input) return std::move(input).why();
    const Format* best = nullptr;
    int surest = 0;
    for (const Format& row : rows) {
        if (row.read == nullptr || row.sniff == nullptr) continue;
        const int sure = row.sniff(input->bytes().substr(0, 65536), input->base_name());
        if (sure > surest) {
            surest = sure;
            best = &row;
        }
    }
    if (best == nullptr) return failure(FailureKind::unreadable, "F003", {}, "not recognised");
    return best->read(*input, {});
}

class RealModels : public testing::TestWithParam<Known> {};

TEST_P(RealModels, HaveTheirKnownCountsAndKeepThemOnTheWayBack) {
    const Known& known = GetParam();
    const auto path = test::real_data(known.file);
    if (!path) GTEST_SKIP() << known.file << " is not here";
    auto data = read(*path, std::string_view(known.file).starts_with("gmsh") ? gmsh::formats() : gocad::formats());
    ASSERT_TRUE(data.ok()) << data.why().error.message;
    topology::build_breps(*data);
    ASSERT_EQ(data->breps.size(), 1u);
    const auto expect_counts = [&](const BrepData& b, const char* what) {
        EXPECT_EQ(b.corners.size(), known.corners) << what;
        EXPECT_EQ(b.lines.size(), known.lines) << what;
        EXPECT_EQ(b.surfaces.size(), known.surfaces) << what;
        EXPECT_EQ(b.regions.size(), known.regions) << what;
        std::size_t polygons = 0;
        for (const auto& s : b.surfaces) polygons += s.polygons.size();
        EXPECT_EQ(polygons, known.polygons) << what;
    };
    const BrepData& b = *data->breps[0];
    expect_counts(b, "as read");
    EXPECT_EQ(b.vertices.size(), known.vertices);
    double sum = 0;
    for (const auto& region : b.regions) {
        EXPECT_TRUE(region.volume_known) << region.name;
        sum += region.volume;
    }
    EXPECT_NEAR(sum, b.universe_volume, 1e-10 * sum);
    std::vector<Loss> losses;
    Dataset faced = exchange::faced_model(data->breps[0], losses);
    topology::build_breps(faced);
    expect_counts(*faced.breps.at(0), "from surfaces");
    losses.clear();
    Dataset tagged = exchange::tagged_model(data->breps[0], losses);
    for (const Loss& loss : losses) EXPECT_EQ(loss.loss_class, LossClass::style) << loss.entity << ": " << loss.what;
    topology::build_breps(tagged);
    const BrepData& t = *tagged.breps.at(0);
    expect_counts(t, "from a tagged mesh");
    EXPECT_EQ(t.layers.size(), b.layers.size());
    EXPECT_EQ(t.fault_blocks.size(), b.fault_blocks.size());
    EXPECT_EQ(t.features.size(), b.features.size());
    for (std::size_t s = 0; s < b.surfaces.size(); ++s) {
        EXPECT_EQ(t.surfaces[s].nodes.size(), b.surfaces[s].nodes.size()) << b.surfaces[s].name;
        EXPECT_EQ(t.surfaces[s].attributes.size(), b.surfaces[s].attributes.size()) << b.surfaces[s].name;
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, RealModels,
    testing::Values(Known{"gocad/modelA1.ml", 20, 36, 21, 4, 3602, 7932}, Known{"gocad/modelA4.ml", 52, 98, 55, 8, 23438, 48903},
                    Known{"gocad/modelA4.so", 52, 98, 55, 8, 6691, 10049}, Known{"gocad/modelA4_lts.so", 52, 98, 55, 8, 6691, 10049},
                    Known{"gocad/CloudSpin.ml", 138, 239, 115, 7, 14524, 30751},
                    Known{"gocad/CloudSpin_fixed.ml", 148, 249, 115, 7, 14524, 30751},
                    Known{"gocad/not_sealed_cube.ml", 6, 6, 6, 0, 24, 12}, Known{"gocad/split_cube.ml", 1, 1, 3, 2, 12, 22},
                    Known{"gocad/cube_model_equi.so", 12, 20, 11, 2, 54, 116}, Known{"gocad/test.lso", 22, 39, 23, 4, 313, 581},
                    Known{"gmsh/cube_v22.msh", 8, 12, 6, 1, 131, 240}, Known{"gmsh/cube_v41.msh", 8, 12, 6, 1, 131, 240}));

}  // namespace
}  // namespace geomend
