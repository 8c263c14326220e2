// SPDX-License-Identifier: AGPL-3.0-or-later
#include <rapidcheck.h>

#include <bit>
#include <cmath>
#include <limits>

#include "gocad/gocad_support.h"

namespace geomend::test {
namespace {

// Any finite double there is, tiny and huge ones too.
rc::Gen<double> finite_double() {
    return rc::gen::map(rc::gen::arbitrary<std::uint64_t>(), [](std::uint64_t bits) {
        const auto value = std::bit_cast<double>(bits);
        return std::isfinite(value) ? value : 0.5;
    });
}

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

Surface random_surface() {
    Surface s;
    s.info.name = *rc::gen::element<std::string>("a", "two words", "Fault/1", "x\"y");
    s.info.crs.z_positive = *rc::gen::element(ZPositive::elevation, ZPositive::depth);
    const auto count = *rc::gen::inRange<std::uint32_t>(3, 30);
    for (std::uint32_t i = 0; i != count; ++i) s.points.push_back({*finite_double(), *finite_double(), *finite_double()});
    if (*rc::gen::arbitrary<bool>()) {
        for (std::uint32_t i = 0; i != count; ++i) s.labels.ids.push_back(static_cast<std::int64_t>(count - i) * 7);
    }
    const auto triangles = *rc::gen::inRange<std::uint32_t>(1, 40);
    for (std::uint32_t i = 0; i != 3 * triangles; ++i) s.polygons.corners.push_back(*rc::gen::inRange<std::uint32_t>(0, count));
    if (*rc::gen::arbitrary<bool>()) s.parts = {{0, 0}, {count / 2, triangles / 2}};
    if (*rc::gen::arbitrary<bool>()) {
        s.alias.assign(count, no_index);
        s.alias[count - 1] = 0;
        s.points[count - 1] = s.points[0];
    }
    Attribute a;
    a.name = "a b";
    a.components = *rc::gen::inRange<std::uint32_t>(1, 4);
    std::vector<double> values;
    for (std::uint32_t i = 0; i != count * a.components; ++i) values.push_back(*finite_double());
    a.values = values;
    a.no_data = -99999;
    a.unit = "m";
    a.kind = "Length";
    a.property_class = "class of it";
    a.legal_min = 0.1;
    if (*rc::gen::arbitrary<bool>()) s.info.attributes.push_back(a);
    if (*rc::gen::arbitrary<bool>()) s.info.sets.push_back({"set", AttributeLocation::point, {0, 2}});
    return s;
}

TEST(GocadWriting, SurfacesComeBackBitByBit) {
    const bool held = rc::check([] {
        const Surface s = random_surface();
        Dataset d;
        d.objects.emplace_back(s);
        std::vector<Loss> losses;
        const std::string text = written(d, "gocad-ts", &losses);
        RC_ASSERT(losses.empty());
        const auto read = read_text(text);
        RC_ASSERT(read.ok());
        const Surface& t = surface_at(*read, 0);
        RC_ASSERT(t.points.size() == s.points.size());
        for (std::size_t i = 0; i != s.points.size(); ++i) {
            for (std::size_t c = 0; c != 3; ++c) RC_ASSERT(same_bits(s.points[i][c], t.points[i][c]));
            RC_ASSERT(s.labels[i] == t.labels[i]);
        }
        RC_ASSERT(t.polygons.corners == s.polygons.corners);
        RC_ASSERT(t.alias == s.alias);
        RC_ASSERT(t.info.crs.z_positive == s.info.crs.z_positive);
        RC_ASSERT(t.parts.size() == std::max<std::size_t>(1, s.parts.size()));
        const bool parts_kept = s.parts.empty() || t.parts[1].first_polygon == s.parts[1].first_polygon;
        RC_ASSERT(parts_kept);
        RC_ASSERT(t.info.attributes.size() == s.info.attributes.size());
        for (const Attribute& a : s.info.attributes) {
            const Attribute& b = t.info.attributes[0];
            RC_ASSERT(a.name == b.name && a.unit == b.unit && a.kind == b.kind && a.property_class == b.property_class);
            RC_ASSERT(a.no_data == b.no_data && a.legal_min == b.legal_min && !b.legal_max && a.components == b.components);
            for (std::size_t i = 0; i != value_count(a); ++i) {
                // A twin without a value of its own would be another matter; these have their own.
                RC_ASSERT(same_bits(value_as_double(a, i), value_as_double(b, i)));
            }
        }
        RC_ASSERT(t.info.sets.size() == s.info.sets.size());
        RC_ASSERT(written(*read, "gocad-ts") == text);
    });
    EXPECT_TRUE(held);
}

TEST(GocadWriting, MissingValuesBecomeNoData) {
    Dataset d;
    PointSet set;
    set.points = {{0, 0, 0}, {1, 0, 0}};
    Attribute a;
    a.name = "v";
    a.values = std::vector<double>{std::numeric_limits<double>::quiet_NaN(), 2};
    set.info.attributes.push_back(a);
    d.objects.emplace_back(set);
    const std::string text = written(d, "gocad-vs");
    EXPECT_NE(text.find("NO_DATA_VALUES -99999\n"), std::string::npos) << text;
    EXPECT_NE(text.find("PVRTX 1 0 0 0 -99999\n"), std::string::npos) << text;
}

TEST(GocadWriting, QuadsAreALossUnlessTheyMayBeSplit) {
    Dataset d;
    Surface s;
    s.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    s.polygons.push_back(std::array<std::uint32_t, 4>{0, 1, 2, 3});
    s.polygons.push_back(std::array<std::uint32_t, 3>{0, 1, 2});
    d.objects.emplace_back(s);
    std::vector<Loss> losses;
    EXPECT_EQ(surface_at(dataset_of(written(d, "gocad-ts", &losses)), 0).polygons.size(), 1u);
    ASSERT_EQ(losses.size(), 1u);
    EXPECT_EQ(losses[0].loss_class, LossClass::substance);
    WriteOptions split;
    split.options = {{"triangulate", "yes"}};
    EXPECT_EQ(surface_at(dataset_of(written(d, "gocad-ts", &losses, split)), 0).polygons.size(), 3u);
    EXPECT_EQ(losses.at(0).loss_class, LossClass::identity);
}

TEST(GocadWriting, TextAndForeignLocationsAreListed) {
    Dataset d;
    PointSet set;
    set.points = {{0, 0, 0}};
    Attribute words;
    words.name = "w";
    words.values = std::vector<std::string>{"x"};
    Attribute whole;
    whole.name = "o";
    whole.location = AttributeLocation::object;
    whole.values = std::vector<double>{1};
    set.info.attributes = {words, whole};
    d.objects.emplace_back(set);
    std::vector<Loss> losses;
    written(d, "gocad-vs", &losses);
    EXPECT_EQ(losses.size(), 2u);
}

TEST(GocadWriting, HeaderLinesRecordsAndWordsComeBack) {
    const std::string text =
        "GOCAD VSet 1\nHEADER {\n*atoms*size:2\nname:old\ngname:no\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME \" gocad Local\"\nPROJECTION "
        "UTM\n"
        "DATUM WGS84\nAXIS_NAME U V W\nAXIS_UNIT m m ms\nZPOSITIVE Elevation\nEND_ORIGINAL_COORDINATE_SYSTEM\nGEOLOGICAL_FEATURE top of "
        "it\n"
        "GEOLOGICAL_TYPE normal_fault\nSTRATIGRAPHIC_POSITION unit 3\nCLASSIFICATION a b c\nPROPERTY_CLASS_HEADER Z {\nis_z:on\n}\n"
        "VRTX 1 0 0 0\nAFTER this\nEND\n";
    const Dataset d = dataset_of(text);
    EXPECT_EQ(points_at(d, 0).info.name, "old");
    EXPECT_EQ(points_at(d, 0).info.role, FeatureRole::fault);
    const std::string again = written(d, "gocad-vs");
    for (const char* line : {"*atoms*size:2\n", "name:old\n", "gname:no\n", "NAME \"gocad Local\"\n", "PROJECTION UTM\n", "DATUM WGS84\n",
                             "AXIS_UNIT m m ms\n", "GEOLOGICAL_FEATURE top of it\n", "GEOLOGICAL_TYPE normal_fault\n",
                             "STRATIGRAPHIC_POSITION unit 3\n", "CLASSIFICATION a b c\n", "VRTX 1 0 0 0\nAFTER this\nEND\n"}) {
        EXPECT_NE(again.find(line), std::string::npos) << line << again;
    }
    EXPECT_EQ(written(dataset_of(again), "gocad-vs"), again);
    Dataset renamed = d;
    info_of(renamed.objects[0]).name = "new";
    EXPECT_NE(written(renamed, "gocad-vs").find("*atoms*size:2\nname:new\ngname:no\n"), std::string::npos);
}

TEST(GocadWriting, NodesAndElementsThatAnObjectHasNotGoNowhereAndAreListed) {
    const Dataset d = dataset_of("GOCAD VSet 1\nHEADER {\nname:v\n}\nTETRA 1 2 3 4\nODD 1\nVRTX 1 0 0 0\nTRGL 1 1 1\nEND\n");
    ASSERT_EQ(d.losses.size(), 2u);
    EXPECT_EQ(d.losses[0].loss_class, LossClass::identity);
    const std::string again = written(d, "gocad-vs");
    EXPECT_NE(again.find("ODD 1\n"), std::string::npos);
    EXPECT_EQ(again.find("TRGL"), std::string::npos);
    EXPECT_EQ(again.find("TETRA 1"), std::string::npos);
    EXPECT_TRUE(has_finding(d, "F102"));
}

TEST(GocadWriting, LinesPartsAndSetsComeBack) {
    const std::string text =
        "GOCAD PLine 1\nREGION r 0\nILINE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nSEG 1 2\nILINE\nATOM 3 1\nVRTX 9 5 5 5 CNXYZ\nSEG 3 9\n"
        "BEGIN_ATOM_REGION_INDICATORS\nARI 2 1\nEND_ATOM_REGION_INDICATORS\nEND\n";
    const std::string once = written(dataset_of(text), "gocad-pl");
    const Dataset d = dataset_of(once);
    EXPECT_EQ(lines_at(d, 0).parts.size(), 2u);
    EXPECT_EQ(lines_at(d, 0).alias.at(2), 0u);
    EXPECT_EQ(lines_at(d, 0).labels[3], 9);
    EXPECT_EQ(lines_at(d, 0).info.sets.size(), 2u);
    EXPECT_EQ(written(d, "gocad-pl"), once);
}

}  // namespace
}  // namespace geomend::test
