// SPDX-License-Identifier: AGPL-3.0-or-later
#include "vtk/legacy_support.h"

namespace geomend::test {
namespace {

const std::string head = "# vtk DataFile Version 3.0\ntitle here\nASCII\n";
const std::string cube_points = "POINTS 8 double\n0 0 0 1 0 0 0 1 0 1 1 0\n0 0 1 1 0 1 0 1 1 1 1 1\n";

TEST(LegacyRead, TakesAnImageWithDefaultsForOriginAndSpacing) {
    const Dataset data = must_read(
        head + "DATASET STRUCTURED_POINTS\nDIMENSIONS 3 2 1\nPOINT_DATA 6\nSCALARS h float\nLOOKUP_TABLE default\n1 2 3 4 5 6.5\n");
    const auto& raster = only<Raster>(data);
    EXPECT_EQ(raster.dims, (std::array<std::uint32_t, 3>{3, 2, 1}));
    EXPECT_EQ(raster.origin, (Vec3{0, 0, 0}));
    EXPECT_EQ(raster.step[1], (Vec3{0, 1, 0}));
    EXPECT_EQ(data.findings.size(), 2u);
    EXPECT_EQ(values_of<float>(raster.info, "h", AttributeLocation::point), (std::vector<float>{1, 2, 3, 4, 5, 6.5f}));
    EXPECT_EQ(data.variant, "legacy 3.0 text, STRUCTURED_POINTS");
}

TEST(LegacyRead, TakesTheOldWordForSpacingAndKeywordsInAnyCase) {
    const Dataset data = must_read(
        "# vtk DataFile Version 1.0\nt\nascii\ndataset structured_points\ndimensions 2 2 2\nOrigin 1 2 3\naspect_ratio .5 +2 1e1\n");
    const auto& raster = only<Raster>(data);
    EXPECT_EQ(raster.origin, (Vec3{1, 2, 3}));
    EXPECT_EQ(raster.step[0][0], 0.5);
    EXPECT_EQ(raster.step[2][2], 10);
}

TEST(LegacyRead, TakesRectilinearCoordinates) {
    const Dataset data = must_read(
        head +
        "DATASET RECTILINEAR_GRID\nDIMENSIONS 2 1 3\nX_COORDINATES 2 float\n0 4\nY_COORDINATES 1 int\n7\nZ_COORDINATES 3 double\n0 1 10\n");
    const auto& raster = only<Raster>(data);
    EXPECT_EQ(sample_position(raster, 1, 0, 2), (Vec3{4, 7, 10}));
}

TEST(LegacyRead, BlankedPointsMakeDeadCells) {
    const Dataset data = must_read(head +
                                   "DATASET STRUCTURED_GRID\nDIMENSIONS 3 2 1\nPOINTS 6 float\n0 0 0 1 0 0 2 0 0 0 1 0 1 1 0 2 1 "
                                   "0\nBLANKING 6 unsigned_char\n1 1 0 1 1 1\n");
    EXPECT_EQ(only<StructuredGrid>(data).dead_cells, (std::vector<std::uint8_t>{0, 1}));
}

TEST(LegacyRead, GhostFlagsOfCellsMakeDeadCells) {
    const Dataset data = must_read(head +
                                   "DATASET STRUCTURED_GRID\nDIMENSIONS 3 2 1\nPOINTS 6 float\n0 0 0 1 0 0 2 0 0 0 1 0 1 1 0 2 1 "
                                   "0\nCELL_DATA 2\nFIELD FieldData 1\nvtkGhostType 1 2 unsigned_char\n32 0\n");
    const auto& grid = only<StructuredGrid>(data);
    EXPECT_EQ(grid.dead_cells, (std::vector<std::uint8_t>{1, 0}));
    EXPECT_TRUE(grid.info.attributes.empty());
}

TEST(LegacyRead, OldAndNewLayoutOfCellsGiveTheSame) {
    const std::string types = "CELL_TYPES 3\n11 10\n42\n";
    const Dataset old_layout = must_read(head + "DATASET UNSTRUCTURED_GRID\n" + cube_points +
                                         "CELLS 3 32\n8 0 1 2 3 4 5 6 7\n4 0 1 2 4\n17 4 3 0 1 2 3 0 1 4 3 1 2 4 3 0 2 4\n" + types);
    const Dataset new_layout = must_read("# vtk DataFile Version 5.1\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n" + cube_points +
                                         "CELLS 4 29\nOFFSETS vtktypeint64\n0 8 12 29\nCONNECTIVITY vtktypeint64\n0 1 2 3 4 5 6 7 0 1 2 4 "
                                         "4 3 0 1 2 3 0 1 4 3 1 2 4 3 0 2 4\n" +
                                         types);
    const auto& a = only<CellMesh>(old_layout);
    const auto& b = only<CellMesh>(new_layout);
    EXPECT_EQ(a.types, (std::vector<CellType>{CellType::hexahedron, CellType::tetrahedron, CellType::polyhedron}));
    EXPECT_EQ(std::vector<std::uint32_t>(a.nodes.begin(), a.nodes.begin() + 8), (std::vector<std::uint32_t>{0, 1, 3, 2, 4, 5, 7, 6}));
    EXPECT_EQ(a.nodes, b.nodes);
    EXPECT_EQ(a.face_nodes, b.face_nodes);
    EXPECT_EQ(a.face_offsets, (std::vector<std::uint64_t>{0, 3, 6, 9, 12}));
}

TEST(LegacyRead, StripsBecomeTrianglesThatRepeatTheirCellValues) {
    const Dataset data = must_read(head +
                                   "DATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 1 1 0\nTRIANGLE_STRIPS 1 5\n4 0 1 2 3\nCELL_DATA "
                                   "1\nSCALARS id int 1\nLOOKUP_TABLE default\n9\n");
    const auto& surface = only<Surface>(data);
    ASSERT_EQ(surface.polygons.size(), 2u);
    EXPECT_EQ(values_of<std::int32_t>(surface.info, "id", AttributeLocation::polygon), (std::vector<std::int32_t>{9, 9}));
}

TEST(LegacyRead, RecordsMayStandInAnyOrderAndDataInSeveralSections) {
    const Dataset data = must_read(
        head + "DATASET UNSTRUCTURED_GRID\nPOINT_DATA 3\nVECTORS v double\n1 2 3 4 5 6 7 8 9\nCELL_TYPES 1\n5\nCELLS 1 4\n3 0 1 2\n" +
        "POINTS 3 int\n0 0 0 1 0 0 0 1 0\nCELL_DATA 1\nGLOBAL_IDS g vtkIdType\n77\nPOINT_DATA 3\nFIELD x 2\na%20b 1 3 short\n1 2 "
        "3\nNULL_ARRAY\n");
    const auto& mesh = only<CellMesh>(data);
    EXPECT_EQ(values_of<double>(mesh.info, "v", AttributeLocation::point).size(), 9u);
    EXPECT_EQ(values_of<std::int64_t>(mesh.info, "g", AttributeLocation::cell), (std::vector<std::int64_t>{77}));
    EXPECT_EQ(values_of<std::int16_t>(mesh.info, "a b", AttributeLocation::point), (std::vector<std::int16_t>{1, 2, 3}));
}

TEST(LegacyRead, MetadataGivesComponentNamesAndTheUnit) {
    const Dataset data =
        must_read(head +
                  "DATASET POLYDATA\nPOINTS 1 float\n0 0 0\nMETADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 "
                  "1\n\nVERTICES 1 2\n1 0\n"
                  "POINT_DATA 1\nFIELD FieldData 2\nv 2 1 float\n1 2\nMETADATA\nCOMPONENT_NAMES\neast%20ward\nnorth\nINFORMATION 1\nNAME "
                  "UNITS_LABEL LOCATION vtkDataArray\nDATA m/s\n\nw 1 1 int\n3\n");
    const auto& set = only<PointSet>(data);
    const Attribute* v = find_attribute(set.info.attributes, "v", AttributeLocation::point);
    ASSERT_NE(v, nullptr);
    EXPECT_EQ(v->component_names, (std::vector<std::string>{"east ward", "north"}));
    EXPECT_EQ(v->unit, "m/s");
    EXPECT_EQ(values_of<std::int32_t>(set.info, "w", AttributeLocation::point), (std::vector<std::int32_t>{3}));
}

TEST(LegacyRead, MetadataMayFollowAnyRecord) {
    const Dataset data = must_read(head +
                                   "DATASET POLYDATA\nPOINTS 2 float\n0 0 0 1 0 0\nLINES 1 3\n2 0 1\nMETADATA\nINFORMATION 0\n\nPOINT_DATA "
                                   "2\nNORMALS n float\n0 0 1 0 0 1\n");
    EXPECT_TRUE(data.findings.empty());
    EXPECT_EQ(only<PolylineSet>(data).info.attributes.size(), 1u);
}

TEST(LegacyRead, StringsOfALineEachMayBeEmptyAndArePercentDecoded) {
    const Dataset data = must_read(
        head + "DATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 2 0 0\nPOINT_DATA 3\nFIELD f 1\nname 1 3 string\na%20b\n\nc%25%zz\n");
    EXPECT_EQ(values_of<std::string>(only<PointSet>(data).info, "name", AttributeLocation::point),
              (std::vector<std::string>{"a b", "", "c%%zz"}));
}

TEST(LegacyRead, CoordinatesStatedAsFloatKeepTheDigitsOfTheText) {
    const Dataset data = must_read(head + "DATASET POLYDATA\nPOINTS 1 float\n400000.33333333331 0.1 1e-300\n");
    EXPECT_EQ(only<PointSet>(data).points[0], (Vec3{400000.33333333331, 0.1, 1e-300}));
}

TEST(LegacyRead, ArraysWithoutGeometryAreToldAsLost) {
    const Dataset data = must_read(head + "FIELD FieldData 1\ntimes 1 2 double\n1 2\n");
    EXPECT_TRUE(data.objects.empty());
    ASSERT_EQ(data.losses.size(), 1u);
    EXPECT_EQ(data.losses[0].loss_class, LossClass::substance);
    EXPECT_EQ(data.findings.size(), 1u);
}

TEST(LegacyRead, ArraysOfTheDatasetAreObjectAttributes) {
    const Dataset data =
        must_read(head + "DATASET POLYDATA\nFIELD FieldData 2\ntime 1 1 double\n2.5\ntable 2 2 int\n1 2 3 4\nPOINTS 1 float\n0 0 0\n");
    const auto& info = only<PointSet>(data).info;
    EXPECT_EQ(values_of<double>(info, "time", AttributeLocation::object), (std::vector<double>{2.5}));
    EXPECT_EQ(values_of<std::int32_t>(info, "table", AttributeLocation::object), (std::vector<std::int32_t>{1, 2, 3, 4}));
}

TEST(LegacyRead, UnknownRecordsAreToldAndPassedOver) {
    const Dataset data = must_read(head + "DATASET POLYDATA\nPOINTS 1 float\n0 0 0\nHYPERFACES 1 2\n1 0\nVERTICES 1 2\n1 0\n");
    EXPECT_EQ(only<PointSet>(data).points.size(), 1u);
    ASSERT_EQ(data.findings.size(), 1u);
    EXPECT_EQ(data.findings[0].code, "F150");
    EXPECT_EQ(data.findings[0].where.line, 7u);
    ASSERT_EQ(data.losses.size(), 1u);
    EXPECT_EQ(data.losses[0].loss_class, LossClass::substance);
}

TEST(LegacyRead, BytesAfterTheLastRecordAreAFinding) {
    const Dataset data = must_read(head + "DATASET POLYDATA\nPOINTS 1 float\n0 0 0\nend of export\n");
    ASSERT_EQ(data.findings.size(), 1u);
    EXPECT_EQ(data.findings[0].severity, Severity::warning);
}

TEST(LegacyRead, AFileWithoutItsLastLineEndMayBeCut) {
    // F165: all that is stated is there, so that the file can be converted.
    for (const auto& [rest, code] : {std::pair("0 0 0.25", "F165"), std::pair("0 0 0\nPOINT_DATA 1", "F101")}) {
        const Dataset data = must_read(head + "DATASET POLYDATA\nPOINTS 1 float\n" + rest);
        ASSERT_EQ(data.findings.size(), 1u);
        EXPECT_EQ(data.findings[0].code, code);
    }
}

// As VTK 9.1 reads them: bytes, rounded.
TEST(LegacyRead, ColoursOfTextFilesAreBytes) {
    const Dataset data =
        must_read(head + "DATASET POLYDATA\nPOINTS 2 float\n0 0 0\n1 0 0\nPOINT_DATA 2\nCOLOR_SCALARS c 3\n0 0.5 1\n0.2 0.7 0.0019\n");
    const auto& attributes = info_of(data.objects.at(0)).attributes;
    ASSERT_EQ(attributes.size(), 1u);
    EXPECT_EQ(std::get<std::vector<std::uint8_t>>(attributes[0].values), (std::vector<std::uint8_t>{0, 128, 255, 51, 178, 0}));
}

TEST(LegacyRead, AColourThatIsNoNumberIsNone) {
    const Dataset data = must_read(head + "DATASET POLYDATA\nPOINTS 1 float\n0 0 0\nPOINT_DATA 1\nCOLOR_SCALARS c 3\nnan 1e30 -1e30\n");
    EXPECT_EQ(std::get<std::vector<std::uint8_t>>(info_of(data.objects.at(0)).attributes.at(0).values),
              (std::vector<std::uint8_t>{0, 255, 0}));
}

// As old writers end their files, whose lines are whole.
TEST(LegacyRead, AnEmptySectionAtTheEndIsReportedAndNoSignOfACut) {
    const Dataset data = must_read(head + "DATASET POLYDATA\nPOINTS 1 float\n0 0 0\nCELL_DATA 1\nPOINT_DATA 1\n");
    ASSERT_EQ(data.findings.size(), 1u);
    EXPECT_EQ(data.findings[0].code, "F119");
}

TEST(LegacyRead, CellsOfHigherOrderAreHeldByTheirCorners) {
    const Dataset data = must_read(head +
                                   "DATASET UNSTRUCTURED_GRID\nPOINTS 9 float\n0 0 0 2 0 0 2 2 0 0 2 0 1 0 0 2 1 0 1 2 0 0 1 0 1 1 0\n"
                                   "CELLS 1 10\n9 0 1 2 3 4 5 6 7 8\nCELL_TYPES 1\n70\n");
    const auto& mesh = only<CellMesh>(data);
    ASSERT_EQ(mesh.types, std::vector{CellType::quad});
    EXPECT_EQ(mesh.nodes, (std::vector<std::uint32_t>{0, 1, 2, 3}));
    ASSERT_EQ(data.losses.size(), 1u);
    EXPECT_EQ(data.losses[0].loss_class, LossClass::substance);
    ASSERT_EQ(data.findings.size(), 1u);
    EXPECT_EQ(data.findings[0].code, "F150");
}

TEST(LegacyRead, NonFiniteValuesAreOneFindingPerArray) {
    const Dataset data = must_read(
        head + "DATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 2 0 0\nPOINT_DATA 3\nSCALARS s float\nLOOKUP_TABLE default\nnan 1 -inf\n");
    ASSERT_EQ(data.findings.size(), 1u);
    EXPECT_EQ(data.findings[0].code, "F120");
    EXPECT_EQ(data.findings[0].count, 2u);
}

TEST(LegacyRead, LineEndsOfDosAreTaken) {
    std::string text =
        head + "DATASET POLYDATA\nPOINTS 2 float\n0 0 0\n1 0 0\nLINES 1 3\n2 0 1\nPOINT_DATA 2\nFIELD f 1\nn 1 2 string\nx\ny\n";
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
    const Dataset data = must_read(text);
    EXPECT_EQ(values_of<std::string>(only<PolylineSet>(data).info, "n", AttributeLocation::point), (std::vector<std::string>{"x", "y"}));
}

TEST(LegacySniff, KnowsTheFirstLine) {
    EXPECT_EQ(vtk::sniff_legacy("# vtk DataFile Version 2.0\n", ""), 100);
    EXPECT_EQ(vtk::sniff_legacy("<VTKFile type=\"PolyData\">", "a.vtk"), 0);
}

// ---- what cannot be read ----

struct Wrong {
    const char* name;
    std::string text;
    const char* code;
    std::uint64_t line;
};

class LegacyFailure : public testing::TestWithParam<Wrong> {};

TEST_P(LegacyFailure, TellsCodeAndLine) {
    const auto data = read_text(GetParam().text);
    ASSERT_FALSE(data.ok());
    EXPECT_EQ(data.why().error.code, GetParam().code) << data.why().error.message;
    EXPECT_EQ(data.why().error.where.line, GetParam().line) << data.why().error.message;
    EXPECT_EQ(data.why().kind, FailureKind::unreadable);
}

const std::string poly = head + "DATASET POLYDATA\n";
const std::string grid = head + "DATASET UNSTRUCTURED_GRID\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n";

INSTANTIATE_TEST_SUITE_P(
    Files, LegacyFailure,
    testing::Values(
        Wrong{"cut_in_a_keyword", poly + "POINTS 1 float\n0 0 0\nVERT", "F004", 7}, Wrong{"cut_before_points", poly, "F004", 5},
        Wrong{"cut_before_types", grid + "CELLS 0 0\n", "F004", 8},
        Wrong{"cut_in_a_string", poly + "POINTS 1 float\n0 0 0\nPOINT_DATA 1\nFIELD f 1\ns 1 1 string\nabc", "F004", 10},
        Wrong{"no_signature", "solid x\n", "F003", 1}, Wrong{"no_version", "# vtk DataFile Version x\nt\nASCII\n", "F005", 1},
        Wrong{"newer_version", "# vtk DataFile Version 7.0\nt\nASCII\n", "F013", 1},
        Wrong{"no_encoding", "# vtk DataFile Version 3.0\nt\nHEX\n", "F012", 3}, Wrong{"nothing_else", head, "F017", 4},
        Wrong{"unknown_dataset", head + "DATASET TREE\n", "F013", 4}, Wrong{"two_datasets", poly + "DATASET POLYDATA\n", "F012", 5},
        Wrong{"malformed_number", poly + "POINTS 1 float\n0 1,5 0\n", "F005", 6},
        Wrong{"keyword_among_numbers", poly + "POINTS 2 float\n0 0 0\nVERTICES 1 2\n1 0\n", "F008", 7},
        Wrong{"too_many_numbers", poly + "POINTS 1 float\n0 0 0\n1 1 1\n", "F008", 7},
        Wrong{"not_finite", poly + "POINTS 1 float\n0 0\nnan\n", "F006", 7},
        Wrong{"cut_short", poly + "POINTS 3 float\n0.000000000 0.000000000 0.000000000\n0 0\n", "F004", 8},
        Wrong{"huge_count", poly + "POINTS 1000000000000000000 float\n0 0 0\n", "F014", 5},
        Wrong{"negative_count", poly + "POINTS -1 float\n0 0 0\n", "F005", 5},
        Wrong{"unknown_type", poly + "POINTS 1 quad\n0 0 0\n", "F013", 5},
        Wrong{"undefined_point", poly + "POINTS 1 float\n0 0 0\nVERTICES 2 4\n1 0\n1 1\n", "F007", 9},
        Wrong{"list_beyond_size", grid + "CELLS 2 5\n3 0 1 2\n3 0 1 2\n", "F008", 9},
        Wrong{"size_beyond_lists", grid + "CELLS 1 6\n3 0 1 2\n0 0\nCELL_TYPES 1\n5\n", "F008", 7},
        Wrong{"no_types", grid + "CELLS 1 4\n3 0 1 2\n", "F004", 9},
        Wrong{"wrong_number_of_types", grid + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 2\n5 5\n", "F008", 9},
        Wrong{"wrong_size_for_type", grid + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n10\n", "F008", 8},
        Wrong{"unknown_cell", grid + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n60\n", "F013", 10},
        Wrong{"broken_face_stream", grid + "CELLS 1 6\n5 2 3 0 1 2\nCELL_TYPES 1\n42\n", "F008", 8},
        Wrong{"falling_offsets", grid + "CELLS 3 3\nOFFSETS vtktypeint64\n0 4 3\nCONNECTIVITY vtktypeint64\n0 1 2\nCELL_TYPES 2\n5 5\n",
              "F012", 9},
        Wrong{"offsets_miss_size", grid + "CELLS 2 3\nOFFSETS vtktypeint64\n0 2\nCONNECTIVITY vtktypeint64\n0 1 2\nCELL_TYPES 1\n5\n",
              "F008", 7},
        Wrong{"count_of_data", poly + "POINTS 1 float\n0 0 0\nPOINT_DATA 2\nSCALARS s int\nLOOKUP_TABLE default\n1 2\n", "F008", 7},
        Wrong{"count_of_field", poly + "POINTS 1 float\n0 0 0\nPOINT_DATA 1\nFIELD f 1\na 1 2 int\n1 2\n", "F008", 9},
        Wrong{"value_out_of_type", poly + "POINTS 1 float\n0 0 0\nPOINT_DATA 1\nFIELD f 1\na 1 1 unsigned_char\n300\n", "F005", 10},
        Wrong{"fraction_for_integer", poly + "POINTS 1 float\n0 0 0\nPOINT_DATA 1\nFIELD f 1\na 1 1 int\n1.5\n", "F005", 10},
        Wrong{"attribute_before_section", poly + "POINTS 1 float\n0 0 0\nSCALARS s int\nLOOKUP_TABLE default\n1\n", "F012", 7},
        Wrong{"dims_and_points", head + "DATASET STRUCTURED_GRID\nDIMENSIONS 2 2 1\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n", "F008", 6},
        Wrong{"huge_dims", head + "DATASET STRUCTURED_POINTS\nDIMENSIONS 2000000000 2000000000 2000000000\n", "F014", 5},
        Wrong{"foreign_record", poly + "CELL_TYPES 1\n5\n", "F012", 5},
        Wrong{"points_twice", poly + "POINTS 1 float\n0 0 0\nPOINTS 1 float\n0 0 0\n", "F009", 7}),
    [](const auto& row) { return row.param.name; });

TEST(LegacyFailureColumn, PointsAtTheWord) {
    const auto data = read_text(poly + "POINTS 1 float\n0 0x12 0\n");
    ASSERT_FALSE(data.ok());
    EXPECT_EQ(to_string(data.why().error.where), "model.vtk:6:3");
    EXPECT_NE(data.why().error.message.find("'0x12'"), std::string::npos);
}

TEST(LegacyFailureStop, EndsReading) {
    const std::atomic<bool> stop = true;
    Monitor monitor;
    monitor.stop = &stop;
    ReadOptions options;
    options.monitor = &monitor;
    const auto data = vtk::read_legacy(Input::from_memory(poly + "POINTS 1 float\n0 0 0\n", "m.vtk"), options);
    ASSERT_FALSE(data.ok());
    EXPECT_EQ(data.why().kind, FailureKind::cancelled);
}

}  // namespace
}  // namespace geomend::test
