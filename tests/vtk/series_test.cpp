// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include "formats/vtk/xml_read.h"
#include "formats/vtk/xml_write.h"
#include "support/temporary_folder.h"

namespace geomend::test {
namespace {

CellMesh one_cell() {
    CellMesh mesh;
    mesh.info.name = "grid";
    for (unsigned c = 0; c < 4; ++c) mesh.points.push_back({double(c == 1), double(c == 2), double(c == 3)});
    mesh.add_cell(CellType::tetrahedron, std::array<std::uint32_t, 4>{0, 1, 2, 3});
    return mesh;
}

void add(CellMesh& mesh, const std::string& name, double value, const char* date, std::optional<double> days) {
    Attribute a;
    a.name = name;
    a.location = AttributeLocation::cell;
    a.values = std::vector<double>{value};
    if (date != nullptr) a.time = TimeStep{date, days, {}};
    mesh.info.attributes.push_back(std::move(a));
}

TEST(Series, has_a_file_per_moment_with_what_holds_then) {
    CellMesh mesh = one_cell();
    add(mesh, "PORO", 0.2, nullptr, {});
    add(mesh, "FIP_OIL_20200201", 7, "2020-02-01", 31.5);
    add(mesh, "FIP_OIL_20200101", 5, "2020-01-01", 0);
    Dataset dataset;
    dataset.objects.emplace_back(std::move(mesh));
    const TemporaryFolder folder;
    OutputSet out(folder / "s.pvd");
    const auto losses = vtk::write_pvd(dataset, out, {});
    ASSERT_TRUE(losses.ok());
    EXPECT_TRUE(losses->empty());
    ASSERT_TRUE(out.commit().ok());
    const std::string index = read_file(folder / "s.pvd");
    EXPECT_NE(index.find("timestep=\"0\" group=\"\" part=\"0\" file=\"s/s_0_0.vtu\""), std::string::npos) << index;
    EXPECT_NE(index.find("timestep=\"31.5\""), std::string::npos);
    const auto second = vtk::read_vtk_xml(*Input::open((folder / "s").string() + "/s_1_0.vtu"), {});
    ASSERT_TRUE(second.ok());
    const auto& attributes = info_of(second->objects.front()).attributes;
    ASSERT_EQ(attributes.size(), 2u);
    EXPECT_EQ(value_as_double(*find_attribute(attributes, "FIP_OIL", AttributeLocation::cell), 0), 7);
}

}  // namespace
}  // namespace geomend::test
