// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include "formats/vtk/xml_read.h"
#include "formats/vtk/xml_write.h"
#include "support/program.h"
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

TEST(Series, without_an_object_is_not_written) {
    const TemporaryFolder folder;
    OutputSet out(folder / "s.pvd");
    const auto losses = vtk::write_pvd({}, out, {});
    ASSERT_FALSE(losses.ok());
    EXPECT_EQ(losses.why().error.code, "F021");
}

TEST(Series, comes_back_as_one_object_with_the_values_of_each_moment) {
    CellMesh mesh = one_cell();
    add(mesh, "PORO", 0.2, nullptr, {});
    add(mesh, "FIP_OIL_20200101", 5, "2020-01-01", 0);
    add(mesh, "FIP_OIL_20200201", 7, "2020-02-01", 31.5);
    Dataset dataset;
    dataset.objects.emplace_back(std::move(mesh));
    const TemporaryFolder folder;
    OutputSet out(folder / "s.pvd");
    ASSERT_TRUE(vtk::write_pvd(dataset, out, {}).ok());
    ASSERT_TRUE(out.commit().ok());
    const auto back = vtk::read_vtk_xml(*Input::open((folder / "s.pvd").string()), {});
    ASSERT_TRUE(back.ok()) << back.why().error.message;
    ASSERT_EQ(back->objects.size(), 1u);
    const auto& attributes = info_of(back->objects[0]).attributes;
    ASSERT_EQ(attributes.size(), 3u);
    EXPECT_EQ(attributes[0].name, "PORO");
    EXPECT_FALSE(attributes[0].time.has_value());
    double sum = 0;
    for (std::size_t i = 1; i < 3; ++i) {
        ASSERT_TRUE(attributes[i].time.has_value());
        EXPECT_EQ(*attributes[i].time->days, value_as_double(attributes[i], 0) == 5 ? 0 : 31.5);
        sum += value_as_double(attributes[i], 0);
    }
    EXPECT_EQ(sum, 12);
}

std::string poly(double x, double value) {
    const std::string at = std::to_string(x), v = std::to_string(value);
    return "<VTKFile type=\"PolyData\" version=\"1.0\"><PolyData><Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\"><PointData>"
           "<DataArray type=\"Float64\" Name=\"p\" format=\"ascii\">" +
           v +
           " 2 3</DataArray></PointData><Points>"
           "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">" +
           at +
           " 0 0 1 0 0 0 1 0</DataArray></Points><Polys>"
           "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>"
           "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys></Piece></PolyData></VTKFile>";
}

std::string series_of(const std::string& sets) {
    return "<VTKFile type=\"Collection\" version=\"0.1\"><Collection>" + sets + "</Collection></VTKFile>";
}

TEST(Series, parts_and_changed_geometry_are_objects_of_their_own) {
    const TemporaryFolder folder;
    write_file(folder / "a.vtp", poly(0, 1));
    write_file(folder / "b.vtp", poly(0, 4));
    write_file(folder / "c.vtp", poly(0.5, 4));
    write_file(
        folder / "s.pvd",
        series_of("<DataSet timestep=\"0\" part=\"0\" file=\"a.vtp\"/><DataSet timestep=\"0\" part=\"1\" name=\"second\" file=\"c.vtp\"/>"
                  "<DataSet timestep=\"2.5\" part=\"0\" file=\"b.vtp\"/><DataSet timestep=\"2.5\" part=\"1\" file=\"a.vtp\"/>"));
    const auto data = vtk::read_vtk_xml(*Input::open((folder / "s.pvd").string()), {});
    ASSERT_TRUE(data.ok()) << data.why().error.message;
    ASSERT_EQ(data->objects.size(), 3u);
    EXPECT_EQ(info_of(data->objects[0]).name, "a");
    EXPECT_EQ(info_of(data->objects[0]).attributes.size(), 2u);
    EXPECT_EQ(info_of(data->objects[1]).name, "second");
    EXPECT_EQ(info_of(data->objects[1]).attributes.size(), 1u);
    EXPECT_EQ(info_of(data->objects[2]).attributes.at(0).time->days, 2.5);
    EXPECT_EQ(info_of(data->objects[2]).name, "a");
}

TEST(Series, geometry_that_changes_under_one_name_is_numbered_by_its_moment) {
    const TemporaryFolder folder;
    write_file(folder / "a.vtp", poly(0, 1));
    write_file(folder / "c.vtp", poly(0.5, 4));
    write_file(folder / "s.pvd", series_of("<DataSet timestep=\"0\" name=\"top\" file=\"a.vtp\"/>"
                                           "<DataSet timestep=\"1\" name=\"top\" file=\"c.vtp\"/>"));
    const auto data = vtk::read_vtk_xml(*Input::open((folder / "s.pvd").string()), {});
    ASSERT_TRUE(data.ok()) << data.why().error.message;
    ASSERT_EQ(data->objects.size(), 2u);
    EXPECT_EQ(info_of(data->objects[0]).name, "top");
    EXPECT_EQ(info_of(data->objects[1]).name, "top_1");
}

TEST(Series, of_one_file_is_that_file_with_its_model) {
    const TemporaryFolder folder;
    const std::string sample = std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.ml";
    ASSERT_EQ(run_geomend({"convert", sample, "-o", folder / "box.vtu"}).status, 0);
    write_file(folder / "s.pvd", series_of("<DataSet timestep=\"0\" file=\"box.vtu\"/>"));
    const auto alone = vtk::read_vtk_xml(*Input::open((folder / "box.vtu").string()), {});
    const auto series = vtk::read_vtk_xml(*Input::open((folder / "s.pvd").string()), {});
    ASSERT_TRUE(alone.ok() && series.ok());
    EXPECT_EQ(series->models.size(), 1u);
    EXPECT_EQ(series->objects.size(), alone->objects.size());
    EXPECT_EQ(series->losses.size(), alone->losses.size());
    EXPECT_EQ(series->findings.size(), alone->findings.size());
    // With another moment the model has no place.
    write_file(folder / "s.pvd", series_of("<DataSet timestep=\"0\" file=\"box.vtu\"/><DataSet timestep=\"1\" file=\"box.vtu\"/>"));
    const auto two = vtk::read_vtk_xml(*Input::open((folder / "s.pvd").string()), {});
    ASSERT_TRUE(two.ok());
    EXPECT_TRUE(two->models.empty());
    EXPECT_FALSE(two->losses.empty());
}

TEST(Series, what_is_wrong_is_refused) {
    const TemporaryFolder folder;
    write_file(folder / "a.vtp", poly(0, 1));
    const auto refused = [&](const std::string& sets) {
        write_file(folder / "s.pvd", series_of(sets));
        const auto data = vtk::read_vtk_xml(*Input::open((folder / "s.pvd").string()), {});
        return data.ok() ? std::string("was read") : data.why().error.code;
    };
    EXPECT_EQ(refused(""), "F017");
    EXPECT_EQ(refused("<DataSet timestep=\"x\" file=\"a.vtp\"/>"), "F005");
    EXPECT_EQ(refused("<DataSet timestep=\"nan\" file=\"a.vtp\"/>"), "F005");
    EXPECT_EQ(refused("<DataSet part=\"1.5\" file=\"a.vtp\"/>"), "F005");
    EXPECT_EQ(refused("<DataSet timestep=\"0\"/>"), "F012");
    EXPECT_EQ(refused("<DataSet file=\"missing.vtp\"/>"), "F010");
    EXPECT_EQ(refused("<DataSet file=\"s.pvd\"/>"), "F014");  // it names itself
    EXPECT_EQ(refused("<DataSet file=\"a.vtp\"/>"), "was read");
}

}  // namespace
}  // namespace geomend::test
