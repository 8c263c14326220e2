// SPDX-License-Identifier: AGPL-3.0-or-later
#include "horizon/horizon_test.h"

namespace geomend::test {
namespace {

const PointSet& points_of(const Dataset& d) { return std::get<PointSet>(d.objects.at(0)); }

const Attribute& attribute(const Dataset& d, std::string_view name) {
    for (const Attribute& a : points_of(d).info.attributes) {
        if (a.name == name) return a;
    }
    ADD_FAILURE() << "no attribute " << name;
    static const Attribute none;
    return none;
}

TEST(IrapPoints, AreThreeNumbersALine) {
    const Dataset d = good("irap-points", "# a comment\n100.5 200.25 -30\n\n  101 201\t-31.125\r\n");
    EXPECT_EQ(points_of(d).points, (std::vector<Vec3>{{100.5, 200.25, -30}, {101, 201, -31.125}}));
    EXPECT_TRUE(d.findings.empty());
    EXPECT_EQ(points_of(d).info.name, "Top_A");
}

TEST(IrapPoints, DepthsAreNegatedAndComeBack) {
    const Dataset d = good("irap-points", "1 2 30\n", {{"z", "depth"}});
    EXPECT_EQ(points_of(d).points[0], (Vec3{1, 2, -30}));
    EXPECT_EQ(well_written("irap-points", d).bytes, "1 2 30\n");
    EXPECT_EQ(well_written("irap-points", d, {{"z", "elevation"}}).bytes, "1 2 -30\n");
}

TEST(IrapPoints, FurtherColumnsAreAttributes) {
    const Dataset d = good("irap-points", "1 2 3 4.5 6\n2 3 4 5.5 7\n");
    EXPECT_EQ(attribute(d, "column 4").values, AttributeValues(std::vector<double>{4.5, 5.5}));
    EXPECT_EQ(attribute(d, "column 5").values, AttributeValues(std::vector<double>{6, 7}));
}

constexpr std::string_view rms =
    "Discrete FaultBlock\n"
    "String FaultTag\n"
    "Float VerticalSep\n"
    "519427.941 6733887.914 -1968.988 6 UNDEF 1.5\n"
    "519446.363 6732037.91 -1806.782 UNDEF F1 UNDEF\n";

TEST(IrapPoints, ReadTheAttributesOfRms) {
    const Dataset d = good("irap-points", rms);
    EXPECT_EQ(attribute(d, "FaultBlock").values, AttributeValues(std::vector<std::int32_t>{6, -999}));
    EXPECT_EQ(attribute(d, "FaultTag").values, AttributeValues(std::vector<std::string>{"UNDEF", "F1"}));
    EXPECT_EQ(attribute(d, "VerticalSep").values, AttributeValues(std::vector<double>{1.5, -999}));
    EXPECT_TRUE(is_no_data(attribute(d, "VerticalSep"), -999));
}

TEST(IrapPoints, WriteAttributesOnlyWhenAsked) {
    const Dataset d = good("irap-points", rms);
    EXPECT_EQ(well_written("irap-points", d, {{"attributes", "rms"}}).bytes, rms);
    const Written w = well_written("irap-points", d);
    EXPECT_EQ(w.bytes, "519427.941 6733887.914 -1968.988\n519446.363 6732037.91 -1806.782\n");
    EXPECT_EQ(substance(w.losses), 3);
}

TEST(IrapPoints, TextsWithBlanksStandInQuotes) {
    Dataset d = good("irap-points", "1 2 3\n4 5 6\n7 8 9\n");
    Attribute texts;
    texts.name = "t";
    texts.values = std::vector<std::string>{"a b", "", "say \"x\""};
    std::get<PointSet>(d.objects[0]).info.attributes = {texts};
    const Written w = well_written("irap-points", d, {{"attributes", "rms"}});
    EXPECT_EQ(w.bytes, "String t\n1 2 3 \"a b\"\n4 5 6 UNDEF\n7 8 9 UNDEF\n");
    EXPECT_TRUE(has_loss(w.losses, LossClass::substance, "texts of attribute 't'"));
    EXPECT_EQ(attribute(good("irap-points", w.bytes), "t").values, AttributeValues(std::vector<std::string>{"a b", "UNDEF", "UNDEF"}));
}

TEST(IrapPoints, SeparatorsBeginParts) {
    const std::string content = "1 1 1\n2 2 2\n999.0 999.0 999.0\n3 3 3\n";
    const Dataset d = good("irap-points", content);
    EXPECT_EQ(points_of(d).points.size(), 3);
    EXPECT_EQ(points_of(d).part_first, (std::vector<std::uint32_t>{2}));
    EXPECT_EQ(well_written("irap-points", d).bytes, content);
}

TEST(IrapPoints, WrongRowsAreToldWithTheirPlace) {
    const auto expect = [](std::string_view content, std::string_view code, std::uint64_t line) {
        const auto d = read("irap-points", content);
        ASSERT_FALSE(d) << content;
        EXPECT_EQ(d.why().error.code, code) << content;
        EXPECT_EQ(d.why().error.where.line, line) << content;
    };
    expect("1 2 3\n1 2\n", "F012", 2);
    expect("1 2 3\n1 2 3 4\n", "F012", 2);
    expect("1 2 3\n1 x 3\n", "F005", 2);
    expect("1 2 3\n1 inf 3\n", "F006", 2);
    expect("1 2 1e999\n", "F006", 1);
    expect("# nothing\n", "F017", 1);
}

TEST(IrapPoints, AMissingLastLineEndIsTold) {
    EXPECT_TRUE(has_finding(good("irap-points", "1 2 3\n4 5 6"), "F101"));
    EXPECT_FALSE(has_finding(good("irap-points", "1 2 3\n4 5 6\n"), "F101"));
}

TEST(PetrelPoints, TypesMayStandBeforeNamesInQuotes) {
    const Dataset d = good("petrel-points",
                           "VERSION 1\nBEGIN HEADER\nX\nY\nZ\nSTRING \"Well\"\nSTRING \"Layer, name\"\nFLOAT \"Net to gross\"\nEND HEADER\n"
                           "1 2 -3 \"A 1\" \"Upper sand\" 0.5\n");
    const auto& attributes = std::get<PointSet>(d.objects.at(0)).info.attributes;
    ASSERT_EQ(attributes.size(), 3u);
    EXPECT_EQ(attributes[0].name, "Well");
    EXPECT_EQ(attributes[1].name, "Layer, name");
    EXPECT_EQ(std::get<std::vector<std::string>>(attributes[1].values), std::vector<std::string>{"Upper sand"});
    EXPECT_EQ(attributes[2].name, "Net to gross");
    EXPECT_EQ(value_as_double(attributes[2], 0), 0.5);
}

TEST(PetrelPoints, TypesMayStandBeforeNamesBehindABlankOrASemicolon) {
    for (const char* between : {" ", "\t", ";", " ; ", ",", ", "}) {
        const std::string b = between;
        const Dataset d = good("petrel-points", "VERSION 1\nBEGIN HEADER\nX\nY\nZ\nSTRING" + b + "Well\nINT" + b + "Line number\nFLOAT" +
                                                    b + "Net, to gross\nPlain name\nEND HEADER\n1 2 -3 \"A 1\" 7 0.5 8\n");
        const auto& attributes = std::get<PointSet>(d.objects.at(0)).info.attributes;
        ASSERT_EQ(attributes.size(), 4u) << b;
        EXPECT_EQ(attributes[0].name, "Well") << b;
        EXPECT_EQ(std::get<std::vector<std::string>>(attributes[0].values), std::vector<std::string>{"A 1"}) << b;
        EXPECT_EQ(attributes[1].name, "Line number") << b;
        EXPECT_EQ(attributes[2].name, "Net, to gross") << b;
        EXPECT_EQ(attributes[3].name, "Plain name") << b;
    }
}

constexpr std::string_view petrel =
    "# Petrel Points with attributes\n"
    "# Unit in X and Y direction: m\n"
    "# Unit in depth: ft\n"
    "VERSION 1\n"
    "BEGIN HEADER\n"
    "X\n"
    "Y\n"
    "Z\n"
    "FLOAT,Dip angle\n"
    "INT,Line\n"
    "STRING,Horizon name\n"
    "END HEADER\n"
    "475000.1 6500000.2 -1500 12.5 7 \"Top A\"\n"
    "475001.1 6500001.2 -1501 -999 -999 \"\"\n";

TEST(PetrelPoints, CarryTypedAttributesAndUnits) {
    const Dataset d = good("petrel-points", petrel);
    EXPECT_EQ(points_of(d).points[1], (Vec3{475001.1, 6500001.2, -1501}));
    EXPECT_EQ(attribute(d, "Dip angle").values, AttributeValues(std::vector<double>{12.5, -999}));
    EXPECT_EQ(attribute(d, "Line").values, AttributeValues(std::vector<std::int32_t>{7, -999}));
    EXPECT_EQ(attribute(d, "Horizon name").values, AttributeValues(std::vector<std::string>{"Top A", ""}));
    EXPECT_EQ(points_of(d).info.crs.axis_units, (std::array<std::string, 3>{"m", "m", "ft"}));
    const Written w = well_written("petrel-points", d);
    EXPECT_EQ(w.bytes, petrel);
    EXPECT_TRUE(w.losses.empty());
}

TEST(PetrelPoints, ColumnsMayStandInAnotherOrder) {
    const Dataset d = good("petrel-points", "VERSION 1\nBEGIN HEADER\nFLOAT,a\nZ\nY\nX\nEND HEADER\n9 3 2 1\n");
    EXPECT_EQ(points_of(d).points[0], (Vec3{1, 2, 3}));
    EXPECT_EQ(attribute(d, "a").values, AttributeValues(std::vector<double>{9}));
}

TEST(PetrelPoints, HeadersAreChecked) {
    EXPECT_EQ(read("petrel-points", petrel.substr(0, 120)).why().error.code, "F004");
    EXPECT_EQ(read("petrel-points", "VERSION 1\nBEGIN HEADER\nX\nY\nEND HEADER\n").why().error.code, "F012");
    EXPECT_EQ(read("petrel-points", "VERSION 1\nBEGIN HEADER\nX\nY\nZ\nCOLOUR,a\nEND HEADER\n").why().error.code, "F013");
    EXPECT_EQ(read("petrel-points", std::string(petrel) + "1 2 3\n").why().error.code, "F012");
}

TEST(PetrelPoints, VectorsGoIntoColumnsAndAValueOfMinus999IsALoss) {
    Dataset d = good("irap-points", "1 2 3\n4 5 6\n");
    Attribute vector;
    vector.name = "n";
    vector.components = 2;
    vector.values = std::vector<float>{0.1f, 2, 3, 4};
    Attribute plain;
    plain.name = "p";
    plain.values = std::vector<std::int16_t>{-999, 5};
    auto& info = std::get<PointSet>(d.objects[0]).info;
    info.attributes = {vector, plain};
    const Written w = well_written("petrel-points", d);
    EXPECT_NE(w.bytes.find("FLOAT,n_1\nFLOAT,n_2\nINT,p\nEND HEADER\n1 2 3 0.1 2 -999\n4 5 6 3 4 5\n"), std::string::npos) << w.bytes;
    EXPECT_TRUE(has_loss(w.losses, LossClass::identity, "components"));
    EXPECT_TRUE(has_loss(w.losses, LossClass::substance, "values -999 of attribute 'p'"));
}

}  // namespace
}  // namespace geomend::test
