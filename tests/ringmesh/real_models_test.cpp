// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <set>

#include "formats/gocad/gocad.h"
#include "formats/registry.h"
#include "ringmesh/gm_files.h"
#include "support/real_data.h"
#include "topology/brep_from_dataset.h"

namespace geomend::test {
namespace {

Dataset with_brep(const std::filesystem::path& path) {
    const auto input = Input::open(path.string());
    const auto format = format_for_reading(*input);
    auto data = (*format)->read(*input, {});
    if (!data) {
        ADD_FAILURE() << data.why().error.message;
        return {};
    }
    topology::build_breps(*data);
    return std::move(data).value();
}

std::set<std::string> names(const Dataset& data) {
    std::set<std::string> all;
    for (const Object& object : data.objects) all.insert(info_of(object).name);
    for (const auto& region : data.breps.at(0)->regions) all.insert(region.name);
    return all;
}

TEST(RealRingmesh, CountsNamesAndVolumesAreThoseOfTheSameModelInGocad) {
    const auto gm = real_data("ringmesh/modelA1_version2.gm"), ml = real_data("gocad/modelA1.ml");
    if (!gm || !ml) GTEST_SKIP() << "no real data";
    const Dataset a = with_brep(*gm), b = with_brep(*ml);
    ASSERT_EQ(a.breps.size(), 1u);
    const auto& x = *a.breps[0];
    const auto& y = *b.breps[0];
    EXPECT_EQ(x.corners.size(), y.corners.size());
    EXPECT_EQ(x.lines.size(), y.lines.size());
    EXPECT_EQ(x.surfaces.size(), y.surfaces.size());
    EXPECT_EQ(x.vertices.size(), y.vertices.size());
    EXPECT_EQ(names(a), names(b));
    ASSERT_EQ(x.regions.size(), y.regions.size());
    for (std::size_t r = 0; r < x.regions.size(); ++r) EXPECT_NEAR(x.regions[r].volume, y.regions[r].volume, 1e-9 * y.regions[r].volume);
}

TEST(RealRingmesh, LinesAndCornersAreAsManyAsTheFileStates) {
    const auto gm = real_data("ringmesh/corbieres.gm");
    if (!gm) GTEST_SKIP() << "no real data";
    const Dataset data = with_brep(*gm);
    const auto& brep = *data.breps.at(0);
    EXPECT_EQ(brep.corners.size(), 98u);
    EXPECT_EQ(brep.lines.size(), 188u);
    EXPECT_EQ(brep.surfaces.size(), 110u);
    EXPECT_EQ(brep.regions.size(), 19u);
    EXPECT_EQ(brep.vertices.size(), 20595u);
    EXPECT_EQ(data.objects.size(), 13u);
}

}  // namespace
}  // namespace geomend::test
