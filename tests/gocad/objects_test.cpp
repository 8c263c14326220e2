// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>

#include "gocad/gocad_support.h"

namespace geomend::test {
namespace {

TEST(GocadVSet, IsReadWithItsName) {
    const Dataset d = dataset_of("GOCAD VSet 1\nHEADER {\nname: two pts\n}\nVRTX 1 0 0 -10\nVRTX 2 3 4 -10\nEND\n");
    ASSERT_EQ(d.objects.size(), 1u);
    const PointSet& set = points_at(d, 0);
    EXPECT_EQ(set.info.name, "two pts");
    ASSERT_EQ(set.points.size(), 2u);
    EXPECT_EQ(set.points[1], (Vec3{3, 4, -10}));
    EXPECT_EQ(d.format, "gocad");
    EXPECT_EQ(d.variant, "VSet");
    EXPECT_TRUE(d.findings.empty());
}

TEST(GocadVSet, DepthIsNegatedAndUnitsAreReported) {
    const Dataset d = dataset_of(
        "GOCAD VSet 1\nHDR name:d\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nAXIS_UNIT \"km\" \" km \" \"m\"\nZPOSITIVE Depth\n"
        "END_ORIGINAL_COORDINATE_SYSTEM\nVRTX 7 1 2 100\nEND\n");
    const PointSet& set = points_at(d, 0);
    EXPECT_EQ(set.info.name, "d");
    EXPECT_EQ(set.points.at(0), (Vec3{1, 2, -100}));
    EXPECT_EQ(set.labels[0], 7);
    EXPECT_EQ(set.info.crs.axis_units, (std::array<std::string, 3>{"km", "km", "m"}));
    EXPECT_EQ(set.info.crs.z_positive, ZPositive::depth);
}

TEST(GocadVSet, CoordinateBlockMayFollowTheNodes) {
    const Dataset d = dataset_of(
        "GOCAD VSet 1\nVRTX 1 1 2 100\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nZPOSITIVE Depth\nEND_ORIGINAL_COORDINATE_SYSTEM\nEND\n");
    EXPECT_EQ(points_at(d, 0).points.at(0)[2], -100);
}

TEST(GocadVSet, UnclosedCoordinateBlockEndsAtTheNodes) {
    const Dataset d = dataset_of("GOCAD VSet 1\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nZPOSITIVE Depth\nVRTX 1 1 2 100\nEND\n");
    EXPECT_EQ(points_at(d, 0).points.at(0)[2], -100);
    EXPECT_TRUE(has_finding(d, "F118"));
}

TEST(GocadVSet, VectorsHaveAdjacentComponents) {
    const Dataset d = dataset_of(
        "GOCAD VSet 1\nHEADER {\nname:v\n}\nPROPERTIES n q\nNO_DATA_VALUES -99999 -1\nESIZES 3 1\n"
        "PVRTX 1 0 0 0 0 0 1 -1\nPVRTX 2 1 0 0 -99999 -99999 -99999 5\nEND\n");
    const ObjectInfo& info = points_at(d, 0).info;
    ASSERT_EQ(info.attributes.size(), 2u);
    EXPECT_EQ(info.attributes[0].components, 3u);
    EXPECT_EQ(values_of(info, "n"), (std::vector<double>{0, 0, 1, -99999, -99999, -99999}));
    EXPECT_EQ(values_of(info, "q"), (std::vector<double>{-1, 5}));
    EXPECT_TRUE(is_no_data(info.attributes[1], -1));
}

TEST(GocadVSet, QuotedNamesLoseTheirInnerBlanks) {
    const Dataset d = dataset_of(
        "# comment first\nGOCAD VSet 1\nHEADER {\nname: q\n*atoms*color: #ff8000\n}\nPROPERTIES \" my prop\" k\n"
        "PROPERTY_SUBCLASSES LINEARFUNCTION Float 1  0 QUANTITY Float\nESIZES 1  1\nUNITS m none\nPVRTX 1 0 0 0 2 3\nEND\n");
    const ObjectInfo& info = points_at(d, 0).info;
    ASSERT_EQ(info.attributes.size(), 2u);
    EXPECT_EQ(info.attributes[0].name, "my prop");
    EXPECT_EQ(info.attributes[0].unit, "m");
    EXPECT_EQ(info.attributes[1].unit, "none");
    EXPECT_EQ(values_of(info, "k"), std::vector<double>{3});
    EXPECT_TRUE(std::ranges::any_of(info.annotations, [](const Annotation& a) { return a.value == "*atoms*color: #ff8000"; }));
}

TEST(GocadVSet, ClassesStandInForMissingNames) {
    const Dataset d = dataset_of("GOCAD VSet 1\nPROPERTY_CLASSES aa bb\nPVRTX 1 0 0 0 7 8\nEND\n");
    EXPECT_EQ(values_of(points_at(d, 0).info, "bb"), std::vector<double>{8});
}

TEST(GocadPLine, PartsAreOpenOrClosed) {
    const Dataset d = dataset_of(
        "GOCAD Pline 1\nHEADER {\nname:l\n}\nILINE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 1 1 0\nSEG 1 2\nSEG 2 3\n"
        "ILINE\nVRTX 4 0 0 5\nVRTX 5 1 0 5\nVRTX 6 0 1 5\nSEG 4 5\nSEG 5 6\nSEG 6 4\nEND\n");
    const PolylineSet& lines = lines_at(d, 0);
    ASSERT_EQ(lines.parts.size(), 2u);
    EXPECT_EQ(lines.parts[1].first_point, 3u);
    EXPECT_EQ(lines.parts[1].first_edge, 2u);
    EXPECT_EQ(lines.edges.back(), (std::array<std::uint32_t, 2>{5, 3}));
}

TEST(GocadPLine, WithoutSegmentsNodesFollowEachOther) {
    const Dataset d =
        dataset_of("GOCAD PLine 1\nILINE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nILINE\nVRTX 3 0 0 0\nVRTX 4 1 0 0\nVRTX 5 2 0 0\nEND\n");
    const PolylineSet& lines = lines_at(d, 0);
    EXPECT_EQ(lines.edges, (std::vector<std::array<std::uint32_t, 2>>{{0, 1}, {2, 3}, {3, 4}}));
}

TEST(GocadTSurf, IdsWithGapsAndControlFlags) {
    const Dataset d = dataset_of(
        "GOCAD TSurf 1.0\nHEADER {\nname: \"gap surf\"\n}\nTFACE\nVRTX 0 0 0 0 CNXYZ\nVRTX 10 1 0 0\nVRTX 12 0 1 0 CNZ\nTRGL 0 10 "
        "12\nEND\n");
    const Surface& s = surface_at(d, 0);
    EXPECT_EQ(s.info.name, "gap surf");
    EXPECT_EQ(s.labels.ids, (std::vector<std::int64_t>{0, 10, 12}));
    EXPECT_EQ(s.polygons.corners, (std::vector<std::uint32_t>{0, 1, 2}));
    ASSERT_EQ(s.info.sets.size(), 2u);
    EXPECT_EQ(s.info.sets[0].name, "gocad.control:CNXYZ");
    EXPECT_EQ(s.info.sets[1].members, std::vector<std::uint32_t>{2});
}

TEST(GocadTSurf, AtomsJoinParts) {
    const Dataset d = dataset_of(
        "GOCAD TSurf 1\nHEADER {\nname:two\n}\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\n"
        "TFACE\nATOM 4 2\nATOM 5 3\nVRTX 6 1 1 0\nTRGL 4 6 5\nBSTONE 1\nBORDER 7 1 3\nEND\n");
    const Surface& s = surface_at(d, 0);
    ASSERT_EQ(s.parts.size(), 2u);
    EXPECT_EQ(s.parts[1].first_point, 3u);
    EXPECT_EQ(s.parts[1].first_polygon, 1u);
    EXPECT_EQ(s.alias, (std::vector<std::uint32_t>{no_index, no_index, no_index, 1, 2, no_index}));
    EXPECT_EQ(s.points[4], (Vec3{0, 1, 0}));
    EXPECT_EQ(s.polygons.corners, (std::vector<std::uint32_t>{0, 1, 2, 3, 5, 4}));
    ASSERT_EQ(s.border_starts.size(), 1u);
    EXPECT_EQ(s.border_starts[0].id, 7);
    EXPECT_EQ(s.border_starts[0].next, 2u);
    EXPECT_EQ(s.border_corners, std::vector<std::uint32_t>{0});
}

TEST(GocadTSurf, AtomMayPointForwards) {
    const Dataset d = dataset_of("GOCAD TSurf 1\nTFACE\nATOM 1 3\nVRTX 2 1 0 0\nVRTX 3 0 0 0\nVRTX 4 0 1 0\nTRGL 1 2 4\nEND\n");
    EXPECT_EQ(surface_at(d, 0).points.at(0), (Vec3{0, 0, 0}));
    EXPECT_EQ(surface_at(d, 0).alias.at(0), 2u);
}

TEST(GocadTSurf, ChainsOfAtomsEndAtTheirNode) {
    const Dataset d =
        dataset_of("GOCAD TSurf 1\nTFACE\nATOM 1 2\nATOM 2 3\nATOM 3 4\nVRTX 4 5 6 7\nVRTX 5 0 0 0\nVRTX 6 1 0 0\nTRGL 1 5 6\nEND\n");
    const Surface& s = surface_at(d, 0);
    for (std::size_t i = 0; i != 3; ++i) {
        EXPECT_EQ(s.points[i], (Vec3{5, 6, 7}));
        EXPECT_EQ(s.alias[i], 3u);
    }
}

TEST(GocadTSurf, CircleOfAtomsIsAnError) {
    const auto read = read_text("GOCAD TSurf 1\nTFACE\nATOM 1 2\nATOM 2 1\nVRTX 3 0 0 0\nTRGL 1 2 3\nEND\n");
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.why().error.code, "F007");
}

TEST(GocadTSurf, AtomsHaveValuesOfTheirOwnOrTakeThem) {
    const Dataset d = dataset_of(
        "GOCAD TSurf 1\nPROPERTIES a\nNO_DATA_VALUES -99999\nTFACE\nPVRTX 1 0 0 0 10\nPVRTX 2 1 0 0 20\nPVRTX 3 0 1 0 -99999 CNXYZ\n"
        "TRGL 1 2 3\nTFACE\nPATOM 4 2 99\nPVRTX 5 1 1 0 40\nPATOM 6 3 60\nATOM 7 2\nTRGL 4 5 6\nEND\n");
    EXPECT_EQ(values_of(surface_at(d, 0).info, "a"), (std::vector<double>{10, 20, -99999, 99, 40, 60, 20}));
    EXPECT_EQ(surface_at(d, 0).points[3], (Vec3{1, 0, 0}));
}

TEST(GocadTSurf, SeveralObjectsHaveIdsOfTheirOwn) {
    const Dataset d = dataset_of(
        "GOCAD TSurf 1\nHEADER {\nname:A\n}\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n"
        "GOCAD PLine 1\nHEADER {\nname:B\n}\nILINE\nVRTX 1 9 9 9\nVRTX 2 9 9 8\nSEG 1 2\n");
    ASSERT_EQ(d.objects.size(), 2u);
    EXPECT_EQ(lines_at(d, 1).points[1], (Vec3{9, 9, 8}));
    ASSERT_TRUE(has_finding(d, "F101"));
    EXPECT_EQ(d.findings.front().entities.front().name, "B");
    EXPECT_EQ(d.variant, "TSurf, PLine");
}

TEST(GocadTSurf, AllErrorsAreToldAtOnce) {
    const auto read = read_text(
        "GOCAD TSurf 1\nHEADER {\nname:bad\n}\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 nan 1 0\nTRGL 1 2 2\nTRGL 1 2 3\nTRGL 1 2 "
        "99\nEND\n");
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(codes_of(read.why()), (std::vector<std::string>{"F006", "F007", "F103"}));
    EXPECT_EQ(read.why().error.code, "F006");
    EXPECT_EQ(read.why().error.where.line, 8u);
}

TEST(GocadTSurf, RegionBitsBecomeNodeSets) {
    const Dataset d = dataset_of(
        "GOCAD TSurf 1\nREGION r1 0\nREGION r2 1\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nBEGIN_ATOM_REGION_INDICATORS\n"
        "ARI 1 1 0\nARI 2 1 0\nARI 3 1 1\nEND_ATOM_REGION_INDICATORS\nTRGL 1 2 3\nEND\n");
    const ObjectInfo& info = surface_at(d, 0).info;
    ASSERT_EQ(info.sets.size(), 2u);
    EXPECT_EQ(info.sets[0].members, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(info.sets[1].name, "r2");
    EXPECT_EQ(info.sets[1].members, std::vector<std::uint32_t>{2});
}

TEST(GocadTSurf, ARegionWithoutANameIsWrittenByItsBit) {
    Dataset d = dataset_of("GOCAD TSurf 1\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n");
    info_of(d.objects[0]).sets.push_back({"", AttributeLocation::point, {1}});
    const Dataset back = dataset_of(written(d, "gocad-ts"));
    const ObjectInfo& info = surface_at(back, 0).info;
    ASSERT_EQ(info.sets.size(), 1u);
    EXPECT_EQ(info.sets[0].name, "region_0");
    EXPECT_EQ(info.sets[0].members, std::vector<std::uint32_t>{1});
}

TEST(GocadTSurf, NodesMayComeInAnyOrderAndAfterTheirTriangles) {
    const Dataset d = dataset_of("GOCAD TSurf 1\nTFACE\nTRGL 1 2 3\nVRTX 3 0 1 0\nVRTX 2 1 0 0\nVRTX 1 0 0 0\nEND\n");
    EXPECT_EQ(surface_at(d, 0).polygons.corners, (std::vector<std::uint32_t>{2, 1, 0}));
}

TEST(GocadTSurf, HugeIdsTakeNoMemory) {
    const Dataset d =
        dataset_of("GOCAD TSurf 1\nTFACE\nVRTX 1 0 0 0\nVRTX 3000000000000000000 1 0 0\nVRTX 2 0 1 0\nTRGL 1 3000000000000000000 2\nEND\n");
    EXPECT_EQ(surface_at(d, 0).polygons.corners, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_FALSE(read_text("GOCAD TSurf 1\nTFACE\nVRTX 99999999999999999999 0 0 0\nEND\n").ok());
}

TEST(GocadTSurf, SameIdTwiceIsAnError) {
    const auto read = read_text("GOCAD TSurf 1\nTFACE\nVRTX 1 0 0 0\nVRTX 1 1 0 0\nVRTX 3 0 1 0\nTRGL 1 1 3\nEND\n");
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.why().error.code, "F009");
    EXPECT_EQ(read.why().error.where.line, 4u);
}

TEST(GocadTSurf, GluedPartAndWordsAfterTriangles) {
    const Dataset d = dataset_of(
        "GOCAD TSurf 1\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3 more words\nTFACEVRTX 7 0 0 5\nVRTX 8 1 0 5\n"
        "VRTX 9 0 1 5\nTRGL 7 8 9\nEND\n");
    const Surface& s = surface_at(d, 0);
    ASSERT_EQ(s.parts.size(), 2u);
    EXPECT_EQ(s.parts[1].first_point, 3u);
    EXPECT_EQ(s.parts[1].first_polygon, 1u);
    EXPECT_TRUE(has_finding(d, "F118"));
}

TEST(GocadTSurf, FirstPartMayLackItsTface) {
    const Dataset d = dataset_of(
        "GOCAD TSurf 1\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nTFACE\nVRTX 4 0 0 5\nVRTX 5 1 0 5\nVRTX 6 0 1 5\nTRGL 4 5 "
        "6\nEND\n");
    EXPECT_EQ(surface_at(d, 0).parts.size(), 2u);
}

TEST(GocadTSurf, ValuesPerTriangle) {
    const Dataset d =
        dataset_of("GOCAD TSurf 1\nTRGL_PROPERTIES k\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3 0.5\nEND\n");
    const Attribute* k = find_attribute(surface_at(d, 0).info.attributes, "k", AttributeLocation::polygon);
    ASSERT_NE(k, nullptr);
    EXPECT_EQ(value_as_double(*k, 0), 0.5);
}

TEST(GocadTSurf, PaddingAndSurplusAreTold) {
    const Dataset few = dataset_of("GOCAD VSet 1\nPROPERTIES a b\nNO_DATA_VALUES -1 -2\nPVRTX 1 0 0 0 5\nEND\n");
    EXPECT_TRUE(has_finding(few, "F105"));
    EXPECT_EQ(values_of(points_at(few, 0).info, "b"), std::vector<double>{-2});
    EXPECT_TRUE(has_finding(dataset_of("GOCAD VSet 1\nPROPERTIES a\nPVRTX 1 0 0 0 5 6\nEND\n"), "F107"));
}

TEST(GocadTSurf, PropertiesWithoutAnEntryAreNamed) {
    const Dataset d = dataset_of("GOCAD VSet 1\nPROPERTIES a b c\nNO_DATA_VALUES -1 -2\nPVRTX 1 0 0 0 5 6 7\nEND\n");
    const auto found = std::ranges::find(d.findings, "F105", &Finding::code);
    ASSERT_NE(found, d.findings.end());
    EXPECT_NE(found->message.find("none for 'c'"), std::string::npos) << found->message;
}

TEST(GocadTSurf, OneNoDataValueIsThatOfEachProperty) {
    const Dataset d = dataset_of("GOCAD VSet 1\nPROPERTIES a b\nNO_DATA_VALUES -99999\nPVRTX 1 0 0 0 1.5 -99999\nEND\n");
    EXPECT_TRUE(has_finding(d, "F105"));
    for (const Attribute& a : points_at(d, 0).info.attributes) EXPECT_EQ(a.no_data, -99999) << a.name;
}

TEST(GocadTSurf, AHeaderThatIsNotClosedEndsWhereTheNextRecordBegins) {
    const std::string coordinates = "GOCAD_ORIGINAL_COORDINATE_SYSTEM\nZPOSITIVE Depth\nEND_ORIGINAL_COORDINATE_SYSTEM\n";
    for (const std::string& next : {coordinates, "GEOLOGICAL_TYPE fault\n" + coordinates}) {
        const Dataset d =
            dataset_of("GOCAD VSet 1\nHEADER {\nname:fault 7\n" + next + "PROPERTY_CLASS_HEADER Z {\nis_z:on\n}\nVRTX 1 0 0 1500\nEND\n");
        EXPECT_TRUE(has_finding(d, "F118"));
        EXPECT_EQ(points_at(d, 0).info.name, "fault 7");
        EXPECT_EQ(points_at(d, 0).info.crs.z_positive, ZPositive::depth);
        EXPECT_EQ(points_at(d, 0).points[0][2], -1500);
    }
    const Dataset whole = dataset_of("GOCAD VSet 1\nHEADER {\nname:x\nproperties: a\n*solid*color: red\n}\nVRTX 1 0 0 0\nEND\n");
    EXPECT_FALSE(has_finding(whole, "F118"));
}

TEST(GocadTSurf, NumbersOfAllSpellings) {
    const Dataset d = dataset_of("GOCAD VSet 1\nVRTX 1 5.28845e-005 +2 60e3\nVRTX\t2\t1.5D+02 -0 .5\nEND\n");
    EXPECT_EQ(points_at(d, 0).points[0], (Vec3{5.28845e-5, 2, 60000}));
    EXPECT_EQ(points_at(d, 0).points[1][0], 150);
    for (const char* bad : {"-1.#INF", "inf", "nan", "1e999", "1,5", "x", "0x10", "1.2.3"}) {
        EXPECT_FALSE(read_text("GOCAD VSet 1\nVRTX 1 0 " + std::string(bad) + " 0\nEND\n").ok()) << bad;
    }
    EXPECT_FALSE(read_text("GOCAD VSet 1\nVRTX 1 0 0\nEND\n").ok());
    EXPECT_FALSE(read_text("GOCAD VSet 1\nVRTX 1.5 0 0 0\nEND\n").ok());
}

TEST(GocadText, LineEndsCaseTabsAndBlanksDoNotMatter) {
    const std::string text =
        "GOCAD TSurf 1\nHEADER {\nname:s\n}\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\n# note\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n";
    std::string crlf, tabs, lower = text;
    for (const char c : text) {
        if (c == '\n') crlf += '\r';
        crlf += c;
        tabs += c == ' ' ? '\t' : c;
        if (c == '\n') tabs += "  ";
    }
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (const std::string& variant : {text, crlf, tabs, lower}) {
        const Dataset d = dataset_of(variant);
        ASSERT_EQ(d.objects.size(), 1u);
        EXPECT_EQ(surface_at(d, 0).info.name, "s");
        EXPECT_EQ(surface_at(d, 0).points.size(), 3u);
        EXPECT_EQ(surface_at(d, 0).polygons.size(), 1u);
        EXPECT_FALSE(has_finding(d, "F101"));
    }
}

TEST(GocadText, UnknownRecordsAreKeptAndTold) {
    const Dataset d = dataset_of("GOCAD VSet 1\nFOO a b\nBAR {\nx\n}\nBEGIN_STUFF\ny\nEND_STUFF\nVRTX 1 0 0 0\nEND\n");
    const auto& notes = points_at(d, 0).info.annotations;
    ASSERT_EQ(notes.size(), 3u);
    EXPECT_EQ(notes[1].value, "BAR {\nx\n}");
    EXPECT_EQ(notes[2].value, "BEGIN_STUFF\ny\nEND_STUFF");
    EXPECT_EQ(std::ranges::count(d.findings, "F102", &Finding::code), 3);
}

TEST(GocadText, UnknownTypesAreLossesAndNothingElseIsLost) {
    const Dataset d = dataset_of("GOCAD Cauldron 1\nHEADER {\nname:c\n}\nstuff\nEND\nGOCAD VSet 1\nVRTX 1 0 0 0\nEND\n");
    EXPECT_EQ(d.objects.size(), 1u);
    ASSERT_EQ(d.losses.size(), 1u);
    EXPECT_EQ(d.losses[0].loss_class, LossClass::substance);
    EXPECT_EQ(d.losses[0].entity, "c");
    EXPECT_EQ(read_text("GOCAD Cauldron 1\nstuff\nEND\n").why().error.code, "F017");
}

TEST(GocadText, GroupsNestAndNameTheirMembers) {
    const std::string text =
        "GOCAD HeterogeneousGroup 1\nHEADER {\nname:g\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nZPOSITIVE "
        "Depth\nEND_ORIGINAL_COORDINATE_SYSTEM\n"
        "BEGIN_MEMBERS\nGOCAD VSet 1\nHEADER {\nname:a\n}\nVRTX 1 0 0 1\nEND\nGOCAD HomogeneousGroup 1\nHEADER {\nname:h\n}\nTYPE VSet\n"
        "BEGIN_MEMBERS\nGOCAD VSet 1\nHEADER {\nname:b\n}\nVRTX 1 1 0 0\nEND\nEND_MEMBERS\nEND\nEND_MEMBERS\nEND\n";
    const Dataset d = dataset_of(text);
    ASSERT_EQ(d.objects.size(), 2u);
    EXPECT_EQ(points_at(d, 0).info.groups, std::vector<std::string>{"g"});
    EXPECT_EQ(points_at(d, 1).info.groups, (std::vector<std::string>{"g", "h"}));
    EXPECT_EQ(points_at(d, 0).points[0][2], -1) << "members without a coordinate block have that of their group";
    const std::string again = written(d, "gocad-gp");
    EXPECT_NE(again.find("GOCAD HomogeneousGroup 1\nHEADER {\nname:h\n}\nTYPE VSet\nBEGIN_MEMBERS\n"), std::string::npos) << again;
    const Dataset twice = dataset_of(again);
    ASSERT_EQ(twice.objects.size(), 2u);
    EXPECT_EQ(points_at(twice, 1).info.groups, points_at(d, 1).info.groups);
    EXPECT_EQ(written(twice, "gocad-gp"), again);
}

TEST(GocadText, DamagedFramesAreRefused) {
    EXPECT_EQ(read_text("").why().error.code, "F002");
    EXPECT_EQ(read_text("hello\nworld\n").why().error.code, "F012");
    EXPECT_EQ(read_text("GOCAD VSet 1\nHEADER {\nname:x\nVRTX 1 0 0 0\nEND\n").why().error.code, "F012");
    EXPECT_EQ(read_text("GOCAD HeterogeneousGroup 1\nBEGIN_MEMBERS\nGOCAD VSet 1\nVRTX 1 0 0 0\nEND\n").why().error.code, "F004");
    std::string deep;
    for (int i = 0; i != 100; ++i) deep += "GOCAD HeterogeneousGroup 1\nBEGIN_MEMBERS\n";
    EXPECT_EQ(read_text(deep).why().error.code, "F014");
    EXPECT_EQ(read_text("GOCAD VSet 1\nPROPERTIES a b c\nESIZES 60000 60000 60000\nPVRTX 1 0 0 0 1\nEND\n").why().error.code, "F014");
}

TEST(GocadText, PropertiesAfterTheNodesAreAnErrorAndNotLost) {
    EXPECT_EQ(read_text("GOCAD VSet 1\nVRTX 1 0 0 0\nPROPERTIES a\nEND\n").why().error.code, "F012");
}

TEST(GocadText, ByteOrderMarkIsPassedOver) { EXPECT_EQ(dataset_of("\xef\xbb\xbfGOCAD VSet 1\nVRTX 1 0 0 0\nEND\n").objects.size(), 1u); }

TEST(GocadText, IsToldByItsFirstLine) {
    const Format& row = format_row("gocad-ts");
    EXPECT_GE(row.sniff("# c\n\n  GOCAD VSet 1\n", ""), 90);
    EXPECT_EQ(row.sniff("GOCADX VSet 1\n", ""), 0);
    EXPECT_EQ(row.sniff("$MeshFormat\n", ""), 0);
}

// None of the real files has any of these.
TEST(Gocad, MalformedHeadsAreReportedWithTheirLine) {
    const std::string body = "VRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n";
    const std::string header = "HEADER {\nname:a\n}\n",
                      frame = "GOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME \"X\" \"Y\" \"Z\"\n";
    const std::string ends = "END_ORIGINAL_COORDINATE_SYSTEM\n";
    const auto line_of = [&](const std::string& head) -> std::uint64_t {
        const auto d = read_text(head + body);
        if (!d.ok()) return 1000;
        EXPECT_LE(d->findings.size(), 1u);
        for (const Finding& f : d->findings) {
            if (f.code == "F166") return f.where.line;
        }
        return 0;
    };
    EXPECT_EQ(line_of("GOCAD TSurf 1\n" + header + frame + ends), 0u);
    EXPECT_EQ(line_of("GOCAD TSurf\n" + header), 0u);
    EXPECT_EQ(line_of("GOCAD TSurf 3\n" + header), 1u);
    EXPECT_EQ(line_of("GOCAD TSurf one\n" + header), 1u);
    EXPECT_EQ(line_of("GOCAD TSurf 1\n" + header + header), 5u);
    EXPECT_EQ(line_of("GOCAD TSurf 1\nHEADER {\nname:\n}\n"), 3u);
    EXPECT_EQ(line_of("GOCAD TSurf 1\nHEADER {\nname:a\nnonsense\n}\n"), 4u);
    EXPECT_EQ(line_of("GOCAD TSurf 1\n" + header + frame + "AXIS_NAME E N U\n" + ends), 8u);
    EXPECT_EQ(line_of("GOCAD TSurf 1\n" + header + "GOCAD_ORIGINAL_COORDINATE_SYSTEM\nAXIS_NAME \"X\" \"Y\"\n" + ends), 6u);
}

}  // namespace
}  // namespace geomend::test
