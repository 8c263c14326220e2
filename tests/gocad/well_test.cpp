// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gocad/gocad_support.h"

using namespace geomend;
using namespace geomend::test;

namespace {

const char* const deep_well =
    "GOCAD Well 1\nHEADER {\nname:w\n}\n"
    "GOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nZPOSITIVE Depth\nEND_ORIGINAL_COORDINATE_SYSTEM\n"
    "PATH_ZM_UNIT m\nWREF 1000 2000 -25\nDATUM KellyBushing\nKB 0\n"
    "PATH 0 -25 0 0\nPATH 100 75 0 0\nPATH 200 170 20 0\n"
    "MRKR Top 1 150\nUNIT A\nMRKR \"Base 2\" 0 190.5\nZONE z1 100 200 1\n"
    "WELL_CURVE\nPROPERTY gamma\nPROP_UNIT gAPI\nPROP_NO_DATA_VALUE -999.25\nREC 10 55.5\nREC 20 -999.25\nEND_CURVE\nEND\n";

const Well& well_at(const Dataset& dataset, std::size_t i) { return std::get<Well>(dataset.objects.at(i)); }

void expect_same_well(const Well& a, const Well& b) {
    EXPECT_EQ(a.head, b.head);
    EXPECT_EQ(a.kelly_bushing, b.kelly_bushing);
    EXPECT_EQ(a.path, b.path);
    EXPECT_EQ(a.measured_depth, b.measured_depth);
    ASSERT_EQ(a.markers.size(), b.markers.size());
    for (std::size_t m = 0; m < a.markers.size(); ++m) {
        EXPECT_EQ(a.markers[m].name, b.markers[m].name);
        EXPECT_EQ(a.markers[m].measured_depth, b.markers[m].measured_depth);
        EXPECT_EQ(a.markers[m].lines, b.markers[m].lines);
    }
    ASSERT_EQ(a.zones.size(), b.zones.size());
    for (std::size_t z = 0; z < a.zones.size(); ++z) {
        EXPECT_EQ(a.zones[z].name, b.zones[z].name);
        EXPECT_EQ(a.zones[z].from, b.zones[z].from);
        EXPECT_EQ(a.zones[z].to, b.zones[z].to);
        EXPECT_EQ(a.zones[z].rest, b.zones[z].rest);
    }
    ASSERT_EQ(a.curves.size(), b.curves.size());
    for (std::size_t c = 0; c < a.curves.size(); ++c) {
        EXPECT_EQ(a.curves[c].measured_depth, b.curves[c].measured_depth);
        EXPECT_EQ(a.curves[c].values.name, b.curves[c].values.name);
        EXPECT_EQ(a.curves[c].values.unit, b.curves[c].values.unit);
        EXPECT_EQ(a.curves[c].values.no_data, b.curves[c].values.no_data);
        EXPECT_TRUE(a.curves[c].values.values == b.curves[c].values.values);
    }
}

}  // namespace

TEST(GocadWell, PathMarkersAndZonesAreTurnedUp) {
    const Dataset data = dataset_of(deep_well);
    ASSERT_EQ(data.objects.size(), 1u);
    const Well& well = well_at(data, 0);
    ASSERT_EQ(well.path.size(), 3u);
    EXPECT_EQ(well.path[0], (Vec3{1000, 2000, 25}));
    EXPECT_EQ(well.path[1], (Vec3{1000, 2000, -75}));
    EXPECT_EQ(well.path[2], (Vec3{1020, 2000, -170}));
    EXPECT_EQ(well.measured_depth, (std::vector<double>{0, 100, 200}));
    ASSERT_EQ(well.markers.size(), 2u);
    EXPECT_EQ(well.markers[0].name, "Top");
    EXPECT_EQ(well.markers[0].measured_depth, 150);
    EXPECT_EQ(well.markers[0].lines, (std::vector<std::string>{"UNIT A"}));
    EXPECT_EQ(well.markers[1].name, "Base 2");
    ASSERT_EQ(well.zones.size(), 1u);
    EXPECT_EQ(well.zones[0].from, 100);
    EXPECT_EQ(well.zones[0].to, 200);
    ASSERT_EQ(well.curves.size(), 1u);
    EXPECT_EQ(well.curves[0].values.name, "gamma");
}

TEST(GocadWell, ComesBackAsItWas) {
    const Dataset data = dataset_of(deep_well);
    std::vector<Loss> losses;
    const std::string text = written(data, "gocad-wl", &losses);
    EXPECT_TRUE(losses.empty()) << (losses.empty() ? "" : losses[0].what);
    const Dataset back = dataset_of(text);
    ASSERT_EQ(back.objects.size(), 1u);
    expect_same_well(well_at(data, 0), well_at(back, 0));
    EXPECT_EQ(written(back, "gocad-wl"), text);
}

TEST(GocadWell, StationsComeBackWithThePathThatTheyGave) {
    const Dataset data = dataset_of(
        "GOCAD Well 1\nHEADER {\nname:s\n}\nWREF 10 20 5\nKB 2\nDEVIATION_SURVEY \"Minimum Curvature\"\n"
        "STATION 0 0 0\nSTATION 100 0 0\nSTATION 200 30 90\nEND\n");
    ASSERT_EQ(data.objects.size(), 1u);
    const Well& well = well_at(data, 0);
    ASSERT_EQ(well.path.size(), 3u);
    EXPECT_EQ(well.path[1], (Vec3{10, 20, -93}));
    EXPECT_GT(well.path[2][0], 10);  // azimuth 90 is east
    EXPECT_NEAR(well.path[2][1], 20, 1e-9);
    const std::string text = written(data, "gocad-wl");
    EXPECT_NE(text.find("STATION 200 30 90"), std::string::npos) << text;
    const Dataset back = dataset_of(text);
    ASSERT_EQ(back.objects.size(), 1u);
    expect_same_well(well, well_at(back, 0));
}

TEST(GocadWell, CurvesOfSinglePrecisionKeepTheirDigitsAndTheirTypeIsListed) {
    Dataset data = dataset_of(deep_well);
    Well& well = std::get<Well>(data.objects[0]);
    well.curves[0].values.values = std::vector<float>{0.1f, -999.25f};
    std::vector<Loss> losses;
    const Dataset back = dataset_of(written(data, "gocad-wl", &losses));
    ASSERT_EQ(losses.size(), 1u);
    EXPECT_EQ(losses[0].loss_class, LossClass::identity);
    const Attribute& again = well_at(back, 0).curves.at(0).values;
    EXPECT_EQ(static_cast<float>(value_as_double(again, 0)), 0.1f);
}

TEST(GocadWell, EndingAtAnyLineIsNeverASilentSuccess) {
    const std::string whole = deep_well;
    for (std::size_t end = whole.find('\n'); end + 1 < whole.size(); end = whole.find('\n', end + 1)) {
        const auto read = read_text(whole.substr(0, end + 1));
        if (read.ok()) {
            EXPECT_FALSE(read->findings.empty()) << whole.substr(0, end);
        }
    }
}
