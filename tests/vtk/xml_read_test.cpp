// SPDX-License-Identifier: AGPL-3.0-or-later
#include "vtk/xml_support.h"

namespace geomend::test {
namespace {

std::string tetrahedron() { return unstructured(four_points, "0 1 2 3", "4", "10", 4, 1); }

std::string faces(const std::string& stream, const std::string& offset) {
    return "<DataArray type=\"Int64\" Name=\"faces\" format=\"ascii\">" + stream +
           "</DataArray><DataArray type=\"Int64\" Name=\"faceoffsets\" format=\"ascii\">" + offset + "</DataArray>";
}
const std::string tet_faces = "4 3 0 2 1 3 0 1 3 3 1 2 3 3 0 3 2";

TEST(XmlRead, ReadsPointsCellsAndTypes) {
    const auto mesh = only_object<CellMesh>(must_read_xml(tetrahedron()));
    EXPECT_EQ(mesh.points.size(), 4u);
    EXPECT_EQ(mesh.types, std::vector{CellType::tetrahedron});
    EXPECT_EQ(mesh.nodes, (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

TEST(XmlRead, TurnsPixelsVoxelsAndStripsAndRepeatsTheirValues) {
    const std::string data = "<CellData Scalars=\"c\"><DataArray type=\"Int16\" Name=\"c\" format=\"ascii\">7 -8 9</DataArray></CellData>";
    const std::string points = "0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1";
    const auto mesh =
        only_object<CellMesh>(must_read_xml(unstructured(points, "0 1 2 3 0 1 2 3 4 0 1 2 3 4 5 6 7", "4 9 17", "8 6 11", 8, 3, "", data)));
    EXPECT_EQ(mesh.types, (std::vector{CellType::quad, CellType::triangle, CellType::triangle, CellType::triangle, CellType::hexahedron}));
    EXPECT_EQ(mesh.nodes, (std::vector<std::uint32_t>{0, 1, 3, 2, 0, 1, 2, 2, 1, 3, 2, 3, 4, 0, 1, 3, 2, 4, 5, 7, 6}));
    EXPECT_EQ(std::get<std::vector<std::int16_t>>(mesh.info.attributes.at(0).values), (std::vector<std::int16_t>{7, -8, -8, -8, 9}));
}

TEST(XmlRead, ReadsPolyhedra) {
    const auto mesh = only_object<CellMesh>(must_read_xml(unstructured(four_points, "0 1 2 3", "4", "42", 4, 1, faces(tet_faces, "17"))));
    EXPECT_EQ(mesh.cell_faces, (std::vector<std::uint64_t>{0, 4}));
    EXPECT_EQ(mesh.face_offsets, (std::vector<std::uint64_t>{0, 3, 6, 9, 12}));
    EXPECT_EQ(mesh.face_nodes, (std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2}));
}

// VTK 9.1's own reader ends by SIGSEGV on three of these.
TEST(XmlRead, RefusesFaceStreamsThatLeadAstray) {
    const auto code = [&](const std::string& stream, const std::string& offset) {
        return failure_code(unstructured(four_points, "0 1 2 3", "4", "42", 4, 1, faces(stream, offset)));
    };
    EXPECT_EQ(code("4 300000000 0 2 1 3 0 1 3 3 1 2 3 3 0 3 2", "17"), "F008");
    EXPECT_EQ(code(tet_faces, "999999999"), "F008");
    EXPECT_EQ(code("1000000000 3 0 2 1 3 0 1 3 3 1 2 3 3 0 3 2", "17"), "F008");
    EXPECT_EQ(code("4 -3 0 2 1 3 0 1 3 3 1 2 3 3 0 3 2", "17"), "F007");
    EXPECT_EQ(code("4 3 0 2 99 3 0 1 3 3 1 2 3 3 0 3 2", "17"), "F007");
}

TEST(XmlRead, RefusesCountsThatTheFileCannotHold) {
    std::string text = tetrahedron();
    text.replace(text.find("NumberOfCells=\"1\""), 17, "NumberOfCells=\"100000000000\"");
    EXPECT_EQ(failure_code(text), "F014");
    text = tetrahedron();
    text.replace(text.find("NumberOfCells=\"1\""), 17, "NumberOfCells=\"4000000000\"");
    EXPECT_EQ(failure_code(text), "F008");
    text = tetrahedron();
    text.replace(text.find("NumberOfPoints=\"4\""), 18, "NumberOfPoints=\"1000000000000000000\"");
    EXPECT_EQ(failure_code(text), "F014");
}

TEST(XmlRead, RefusesNumbersOfComponentsThatMakeNoSense) {
    for (const char* count : {"-1e300", "x", "3.0", "0", "99999999999", ""}) {
        std::string text = tetrahedron();
        text.replace(text.find("NumberOfComponents=\"3\""), 22, "NumberOfComponents=\"" + std::string(count) + "\"");
        EXPECT_EQ(failure_code(text), "F005") << count;
        const std::string field = "<FieldData><DataArray type=\"Int32\" Name=\"f\" NumberOfComponents=\"" + std::string(count) +
                                  "\" NumberOfTuples=\"1\" format=\"ascii\">1</DataArray></FieldData>";
        text = tetrahedron();
        text.insert(text.find("<Piece"), field);
        EXPECT_EQ(failure_code(text), "F005") << "field data " << count;
    }
}

TEST(XmlRead, CellsOfHigherOrderAreHeldByTheirCorners) {
    const Dataset data = must_read_xml(unstructured("0 0 0 1 0 0 0 1 0 0 0 1 0.5 0 0 0.5 0.5 0 0 0.5 0 0 0 0.5 0.5 0 0.5 0 0.5 0.5",
                                                    "0 1 2 3 4 5 6 7 8 9", "10", "71", 10, 1));
    const auto& mesh = std::get<CellMesh>(data.objects.at(0));
    ASSERT_EQ(mesh.types, std::vector{CellType::tetrahedron});
    EXPECT_EQ(mesh.nodes, (std::vector<std::uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(data.losses.size(), 1u);
    EXPECT_EQ(data.findings.size(), 1u);
    EXPECT_EQ(must_read_xml(unstructured(four_points, "0 1 2 3", "4", "71", 4, 1)).losses.size(), 0u) << "of first order nothing is lost";
}

TEST(XmlRead, ArraysThatPiecesLackAreReported) {
    const TemporaryFolder folder;
    write_file(folder / "p.vtu", unstructured(four_points, "0 1 2 3", "4", "10", 4, 1));
    write_file(folder / "all.pvtu",
               "<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n<PUnstructuredGrid GhostLevel=\"0\">\n"
               "<PPoints><PDataArray type=\"Float64\" NumberOfComponents=\"3\"/></PPoints>\n<PCellData>\n"
               "<PDataArray type=\"Float32\" Name=\"velocity\" NumberOfComponents=\"3\"/>\n</PCellData>\n"
               "<Piece Source=\"p.vtu\"/>\n</PUnstructuredGrid>\n</VTKFile>\n");
    const auto data = read_xml_file(folder / "all.pvtu");
    ASSERT_TRUE(data.ok());
    ASSERT_EQ(data->findings.size(), 1u);
    EXPECT_EQ(data->findings[0].code, "F113");
    EXPECT_NE(data->findings[0].message.find("'velocity'"), std::string::npos);
    EXPECT_EQ(data->findings[0].where.line, 5u);
}

TEST(XmlRead, ArraysThatPiecesHaveWithOtherComponentsAreReported) {
    const TemporaryFolder folder;
    write_file(folder / "p.vtp",
               "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\"><PolyData><Piece NumberOfPoints=\"1\">"
               "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0</DataArray></Points>"
               "<PointData><DataArray type=\"Float64\" Name=\"t\" format=\"ascii\">1</DataArray></PointData>"
               "</Piece></PolyData></VTKFile>\n");
    for (const bool same : {true, false}) {
        write_file(folder / "all.pvtp",
                   std::string("<VTKFile type=\"PPolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n<PPolyData GhostLevel=\"0\">\n"
                               "<PPointData>\n<PDataArray type=\"Float64\" Name=\"t\"") +
                       (same ? "" : " NumberOfComponents=\"3\"") +
                       "/>\n</PPointData>\n<Piece Source=\"p.vtp\"/>\n</PPolyData>\n</VTKFile>\n");
        const auto data = read_xml_file(folder / "all.pvtp");
        ASSERT_TRUE(data.ok());
        ASSERT_EQ(data->findings.size(), same ? 0u : 1u);
        if (same) continue;
        EXPECT_EQ(data->findings[0].code, "F113");
        EXPECT_EQ(data->findings[0].message, "array 't' is announced with 3 components, but 1 piece has 1");
        EXPECT_EQ(data->findings[0].where.line, 4u);
    }
}

TEST(XmlRead, TellsWhatIsWrongAndWhere) {
    EXPECT_EQ(failure_code(unstructured("0 0 0 1 0 0 0 1 0 0 0 nan", "0 1 2 3", "4", "10", 4, 1)), "F006");
    EXPECT_EQ(failure_code(unstructured(four_points, "0 1 2 4", "4", "10", 4, 1)), "F007");
    EXPECT_EQ(failure_code(unstructured(four_points, "0 1 2 3", "5", "10", 4, 1)), "F008");
    EXPECT_EQ(failure_code(unstructured(four_points, "0 1 2 3", "4", "12", 4, 1)), "F008");
    EXPECT_EQ(failure_code(unstructured(four_points, "0 1 2 3", "4", "60", 4, 1)), "F013");
    EXPECT_EQ(failure_code(unstructured(four_points, "0 1 2 3 0 1 2 3", "8 4", "10 10", 4, 2)), "F008");
    const auto data = read_xml(unstructured("0 0 0 1 0 0 0 1x 0 0 0 1", "0 1 2 3", "4", "10", 4, 1));
    ASSERT_FALSE(data.ok());
    EXPECT_EQ(data.why().error.code, "F005");
    EXPECT_EQ(data.why().error.where.line, 7u);
    EXPECT_EQ(data.why().error.where.column, 15u);
    EXPECT_NE(data.why().error.message.find("1x"), std::string::npos);
}

TEST(XmlRead, RefusesXmlThatIsNotWellFormed) {
    const std::string text = tetrahedron();
    for (std::size_t n = 0; n < text.size() - 2; ++n) EXPECT_FALSE(failure_code(text.substr(0, n)).empty()) << "cut at " << n;
    EXPECT_EQ(failure_code("<VTKFile type=\"PolyData\"></VTKFileX>"), "F012");
    EXPECT_EQ(failure_code("<VTKFile type=\"NoSuchThing\"></VTKFile>"), "F013");
    std::string deep = "<VTKFile type=\"vtkMultiBlockDataSet\"><vtkMultiBlockDataSet>";
    for (int i = 0; i < 100000; ++i) deep += "<Block>";
    EXPECT_EQ(failure_code(deep), "F014");
}

// Inline base64, header and data in one stream; values 1.5 and -2 as Float32, 32-bit header.
TEST(XmlRead, ReadsInlineBase64AndBigEndian) {
    const auto image = [](const std::string& order, const std::string& base64) {
        return "<VTKFile type=\"ImageData\" version=\"0.1\" byte_order=\"" + order +
               "\"><ImageData WholeExtent=\"0 1 0 0 0 0\" Origin=\"1 2 3\" Spacing=\"0.5 1 1\"><Piece Extent=\"0 1 0 0 0 0\"><PointData>"
               "<DataArray type=\"Float32\" Name=\"v\" format=\"binary\">" +
               base64 + "</DataArray></PointData></Piece></ImageData></VTKFile>";
    };
    for (const auto& [order, base64] : {std::pair{"LittleEndian", "CAAAAAAAwD8AAADA"}, std::pair{"BigEndian", "AAAACD/AAADAAAAA"}}) {
        const auto raster = only_object<Raster>(must_read_xml(image(order, base64)));
        EXPECT_EQ(raster.dims, (std::array<std::uint32_t, 3>{2, 1, 1}));
        EXPECT_EQ(raster.step[0], (Vec3{0.5, 0, 0}));
        EXPECT_EQ(std::get<std::vector<float>>(raster.info.attributes.at(0).values), (std::vector<float>{1.5f, -2.0f}));
    }
    EXPECT_EQ(failure_code(image("LittleEndian", "CAAAAAAAwD8AAAD*")), "F004");
    EXPECT_EQ(failure_code(image("LittleEndian", "/////wAAwD8AAADA")), "F004");
}

TEST(XmlRead, JoinsPiecesAndDropsGhostCells) {
    const auto piece = [](const std::string& x, const std::string& ghost) {
        return "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><CellData><DataArray type=\"UInt8\" Name=\"vtkGhostType\" "
               "format=\"ascii\">" +
               ghost + "</DataArray></CellData><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">" + x +
               " 0 0 1 0 0 0 1 0 0 0 1"
               "</DataArray></Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray>"
               "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">4</DataArray><DataArray type=\"UInt8\" Name=\"types\" "
               "format=\"ascii\">10"
               "</DataArray></Cells></Piece>";
    };
    const auto data = must_read_xml("<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>" + piece("5", "0") + piece("6", "1") +
                                    piece("7", "0") + "</UnstructuredGrid></VTKFile>");
    const auto mesh = only_object<CellMesh>(data);
    EXPECT_EQ(mesh.points.size(), 12u);
    EXPECT_EQ(mesh.nodes, (std::vector<std::uint32_t>{0, 1, 2, 3, 8, 9, 10, 11}));
    ASSERT_EQ(data.findings.size(), 1u);
    EXPECT_EQ(data.findings[0].code, "F130");
}

TEST(XmlRead, NamesTheMissingBlock) {
    const TemporaryFolder folder;
    const std::string path = (folder / "blocks.vtm").string();
    write_file(path,
               "<VTKFile type=\"vtkMultiBlockDataSet\">\n<vtkMultiBlockDataSet>\n<DataSet name=\"main\" file=\"gone.vtu\"/>\n"
               "</vtkMultiBlockDataSet>\n</VTKFile>\n");
    const auto data = read_xml_file(path);
    ASSERT_FALSE(data.ok());
    EXPECT_EQ(data.why().error.code, "F010");
    EXPECT_EQ(data.why().error.where.line, 3u);
    EXPECT_NE(data.why().error.message.find("gone.vtu"), std::string::npos);
}

TEST(XmlRead, StopsAtFilesThatNameThemselves) {
    const TemporaryFolder folder;
    const std::string path = (folder / "self.vtm").string();
    write_file(
        path, "<VTKFile type=\"vtkMultiBlockDataSet\"><vtkMultiBlockDataSet><DataSet file=\"self.vtm\"/></vtkMultiBlockDataSet></VTKFile>");
    const auto data = read_xml_file(path);
    ASSERT_FALSE(data.ok());
    EXPECT_EQ(data.why().error.code, "F014");
}

TEST(XmlRead, KeepsBlockNamesAndGroups) {
    const TemporaryFolder folder;
    write_file(folder / "a.vtu", tetrahedron());
    const std::string path = (folder / "blocks.vtm").string();
    write_file(path,
               "<VTKFile type=\"vtkMultiBlockDataSet\"><vtkMultiBlockDataSet><Block name=\"outer\"><Block name=\"in &amp; out\">"
               "<DataSet name=\"T\" file=\"a.vtu\"/></Block></Block></vtkMultiBlockDataSet></VTKFile>");
    const auto data = read_xml_file(path);
    ASSERT_TRUE(data.ok());
    const auto mesh = only_object<CellMesh>(*data);
    EXPECT_EQ(mesh.info.name, "T");
    EXPECT_EQ(mesh.info.groups, (std::vector<std::string>{"outer", "in & out"}));
}

}  // namespace
}  // namespace geomend::test
