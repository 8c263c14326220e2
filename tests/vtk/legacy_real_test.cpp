// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>

#include "support/real_data.h"
#include "vtk/legacy_support.h"

namespace geomend::test {
namespace {

Dataset read_real(const std::filesystem::path& path) {
    const auto input = Input::open(path.string());
    if (!input) return {};
    auto data = vtk::read_legacy(*input, {});
    if (!data) {
        ADD_FAILURE() << to_string(data.why().error.where) << ' ' << data.why().error.message;
        return {};
    }
    EXPECT_TRUE(data->losses.empty()) << path;
    return std::move(data).value();
}

std::size_t count(const CellMesh& mesh, CellType type) { return static_cast<std::size_t>(std::ranges::count(mesh.types, type)); }

TEST(LegacyReal, PebiGridHasItsHexesAndPrisms) {
    const auto path = real_data("vtk/hybridHexPrismMesh.vtk");
    if (!path) GTEST_SKIP() << "no real data";
    const Dataset data = read_real(*path);
    const auto& mesh = only<CellMesh>(data);
    EXPECT_EQ(mesh.points.size(), 660u);
    EXPECT_EQ(count(mesh, CellType::hexahedron), 70u);
    EXPECT_EQ(count(mesh, CellType::pentagonal_prism), 100u);
    EXPECT_EQ(count(mesh, CellType::hexagonal_prism), 130u);
}

TEST(LegacyReal, EveryKindOfCellAndOfDatasetIsReadAndComesBack) {
    const auto folder = real_data("vtk");
    if (!folder) GTEST_SKIP() << "no real data";
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(*folder)) {
        if (entry.path().extension() != ".vtk") continue;
        ++files;
        const Dataset data = read_real(entry.path());
        ASSERT_EQ(data.objects.size(), 1u) << entry.path();
        for (const auto& options : all_encodings()) {
            const Dataset back = must_read(written(data, options));
            ASSERT_EQ(back.objects.size(), 1u);
            EXPECT_EQ(data.objects[0].index(), back.objects[0].index());
            const auto &a = info_of(data.objects[0]).attributes, &b = info_of(back.objects[0]).attributes;
            ASSERT_EQ(a.size(), b.size());
            for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].values, b[i].values) << entry.path() << ' ' << a[i].name;
            if (const auto* mesh = std::get_if<CellMesh>(&data.objects[0])) {
                EXPECT_EQ(mesh->points, std::get<CellMesh>(back.objects[0]).points);
                EXPECT_EQ(mesh->nodes, std::get<CellMesh>(back.objects[0]).nodes);
                EXPECT_EQ(mesh->types, std::get<CellMesh>(back.objects[0]).types);
            }
        }
    }
    EXPECT_GE(files, 24u);
}

TEST(LegacyReal, SupportedElementsHasTwelveCells) {
    const auto path = real_data("vtk/supportedElements.vtk");
    if (!path) GTEST_SKIP() << "no real data";
    EXPECT_EQ(only<CellMesh>(read_real(*path)).cell_count(), 12u);
}

}  // namespace
}  // namespace geomend::test
