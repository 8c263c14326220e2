// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <random>

#include "wells/well_files.h"

namespace geomend::test {
namespace {

TEST(RmsWells, APathWithItsLogs) {
    const Dataset data = good_wells("rms-wells", std::string(two_wells));
    ASSERT_EQ(data.objects.size(), 2u);
    const Well& a = well_at(data, 0);
    EXPECT_EQ(a.info.name, "12/3-A 4 H");
    EXPECT_EQ(a.head, (Vec3{461292.7, 5931883.3, 0}));
    EXPECT_EQ(a.kelly_bushing, 25.5);
    EXPECT_EQ(a.path.at(2), (Vec3{461253.925476, 5931878.912109, -1695.516724}));
    EXPECT_EQ(a.info.crs.z_positive, ZPositive::depth);
    EXPECT_EQ(a.measured_depth, (std::vector<double>{1720.5, 1721.25, 1722}));
    ASSERT_EQ(a.curves.size(), 3u);
    EXPECT_EQ(a.curves[0].measured_depth, a.measured_depth);
    EXPECT_EQ(a.curves[0].values.code_names.at(2), (std::pair<int, std::string>{5, "Coal"}));
    EXPECT_TRUE(is_no_data(a.curves[0].values, value_as_double(a.curves[0].values, 2)));
    EXPECT_TRUE(is_no_data(a.curves[1].values, value_as_double(a.curves[1].values, 1)));
    EXPECT_EQ(a.curves[2].values.unit, "API");
}

TEST(RmsWells, WithoutMeasuredDepthsLogsStandAlongThePath) {
    const Dataset data = good_wells("rms-wells", std::string(two_wells));
    const Well& b = well_at(data, 1);
    EXPECT_EQ(b.info.name, "B1");
    EXPECT_TRUE(b.measured_depth.empty());
    EXPECT_EQ(b.curves.at(0).measured_depth, (std::vector<double>{0, 4}));
    ASSERT_EQ(data.findings.size(), 1u);
    EXPECT_EQ(data.findings[0].code, "F163");
    EXPECT_EQ(data.findings[0].entities.at(0).name, "B1");
}

TEST(RmsWells, RowsWithoutAPositionAreListedAsLost) {
    const Dataset data = good_wells("rms-wells", "1.0\nUndefined\nA 1 2\n1\nGR API lin\n1 2 3 4\n-999 2 3 5\n1 2 9 6\n");
    EXPECT_EQ(well_at(data, 0).path, (std::vector<Vec3>{{1, 2, -3}, {1, 2, -9}}));
    EXPECT_EQ(value_as_double(well_at(data, 0).curves.at(0).values, 1), 6);
    ASSERT_EQ(data.losses.size(), 1u);
    EXPECT_EQ(data.losses[0].loss_class, LossClass::substance);
    const auto reported = std::ranges::find(data.findings, "F150", &Finding::code);
    ASSERT_NE(reported, data.findings.end());
    EXPECT_EQ(reported->where.line, 7u);
}

TEST(RmsWells, AHeadWithoutPointsIsReported) {
    const Dataset data = good_wells("rms-wells", "1.0\nUndefined\nA 1 2\n1\nGR API lin\n");
    ASSERT_EQ(std::ranges::count(data.findings, "F119", &Finding::code), 1);
    EXPECT_EQ(std::ranges::find(data.findings, "F119", &Finding::code)->entities.at(0).name, "A");
    EXPECT_EQ(std::ranges::count(good_wells("rms-wells", std::string(two_wells)).findings, "F119", &Finding::code), 0);
}

TEST(RmsWells, WhatIsWrongIsRefusedWithItsPlace) {
    const std::string head = "1.0\nUndefined\nA 1 2\n1\nPHIT UNK lin\n";
    EXPECT_EQ(refused_well("rms-wells", head + "1 2 3\n"), "F012 a.w:6:6");
    EXPECT_EQ(refused_well("rms-wells", head + "1 2 3 4 5\n"), "F012 a.w:6:9");
    EXPECT_EQ(refused_well("rms-wells", head + "1 2 x 4\n"), "F005 a.w:6:5");
    EXPECT_EQ(refused_well("rms-wells", head + "1 nan 3 4\n"), "F006 a.w:6:3");
    EXPECT_EQ(refused_well("rms-wells", "1.0\nUndefined\nA 1\n"), "F012 a.w:3:1");
    EXPECT_EQ(refused_well("rms-wells", "1.0\nUndefined\nA 1 2\n9999999999\n"), "F014 a.w:4");
    EXPECT_EQ(refused_well("rms-wells", "1.0\nUndefined\nA 1 2\n2\nPHIT UNK lin\n"), "F004 a.w:5");
    EXPECT_EQ(refused_well("rms-wells", "1.0\nUndefined\nA 1 2\n1\nF DISC 0 a x b\n"), "F005 a.w:5:12");
    EXPECT_EQ(refused_well("rms-wells", "1.0\nUndefined\nA 1 2\n1\nF DISC 0 a\n1 2 3 0.5\n"), "F005 a.w:6:7");
    EXPECT_EQ(refused_well("rms-wells", "\n"), "F017 a.w");
}

TEST(RmsWells, CutOrDamagedItNeverCrashes) {
    const std::string whole(two_wells);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const auto data = read_wells("rms-wells", whole.substr(0, size));
        EXPECT_TRUE(data.ok() || !data.why().error.code.empty());
    }
    std::mt19937 random(7);
    for (int round = 0; round < 3000; ++round) {
        std::string bytes = whole;
        for (int k = 0; k < 1 + round % 3; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
        const auto data = read_wells("rms-wells", bytes);
        EXPECT_TRUE(data.ok() || !data.why().error.code.empty());
    }
}

TEST(RmsWells, AFileComesBackAsItWas) {
    const Dataset once = good_wells("rms-wells", std::string(two_wells));
    const WrittenWells file = written_rms(once);
    EXPECT_TRUE(file.losses.empty());
    EXPECT_NE(file.bytes.find("12/3-A 4 H 461292.7 5931883.3 25.5\n4\nMDEPTH unit1 scale1\nFacies DISC 0 Floodplain 1 Channel 5 Coal\n"),
              std::string::npos);
    EXPECT_EQ(written_rms(good_wells("rms-wells", file.bytes)).bytes, file.bytes);
}

RC_GTEST_PROP(RmsWells, EveryBitOfPathsAndLogsComesBack, ()) {
    Dataset data;
    const auto any = [] { return *rc::gen::inRange<int>(-1000000000, 1000000000) / 3.0; };
    for (int w = *rc::gen::inRange(1, 4); w > 0; --w) {
        Well well;
        well.info.name = "W " + std::to_string(w) + "a";
        well.head = {any(), any(), 0};
        well.kelly_bushing = *rc::gen::element(0.0, 30.1);
        const auto points = *rc::gen::inRange<std::size_t>(1, 6);
        for (std::size_t i = 0; i < points; ++i) {
            well.path.push_back({any(), any(), any()});
            well.measured_depth.push_back(static_cast<double>(i) / 3);
        }
        for (int c = *rc::gen::inRange(0, 3); c > 0; --c) {
            Attribute a;
            a.name = "log" + std::to_string(c);
            a.no_data = -999;
            std::vector<double> values(points);
            for (double& v : values) v = *rc::gen::element(-999.0, any());
            a.values = values;
            well.curves.push_back({well.measured_depth, a});
        }
        data.objects.emplace_back(well);
    }
    const WrittenWells file = written_rms(data);
    const Dataset back = good_wells("rms-wells", file.bytes);
    RC_ASSERT(back.objects.size() == data.objects.size());
    for (std::size_t i = 0; i < data.objects.size(); ++i) {
        const Well &a = well_at(data, i), &b = well_at(back, i);
        RC_ASSERT(a.info.name == b.info.name);
        RC_ASSERT(a.head == b.head);
        RC_ASSERT(a.kelly_bushing == b.kelly_bushing);
        RC_ASSERT(a.path == b.path);
        RC_ASSERT(a.measured_depth == b.measured_depth);
        RC_ASSERT(a.curves.size() == b.curves.size());
        for (std::size_t c = 0; c < a.curves.size(); ++c) {
            RC_ASSERT(a.curves[c].measured_depth == b.curves[c].measured_depth);
            RC_ASSERT(std::get<std::vector<double>>(a.curves[c].values.values) == std::get<std::vector<double>>(b.curves[c].values.values));
        }
    }
    RC_ASSERT(written_rms(back).bytes == file.bytes);
}

TEST(RmsWells, WhatHasNoPlaceIsListed) {
    Dataset data = good_wells("rms-wells", std::string(two_wells));
    Well& well = std::get<Well>(data.objects[0]);
    well.markers.push_back({"top", 1721, {}});
    well.curves[2].measured_depth.back() += 1;
    well.curves[1].values.name = "total porosity";
    const auto losses = written_rms(data).losses;
    const auto has = [&](LossClass c, std::string_view what) {
        return std::ranges::any_of(losses, [&](const Loss& l) { return l.loss_class == c && l.what.find(what) != std::string::npos; });
    };
    EXPECT_TRUE(has(LossClass::substance, "marker 'top'"));
    EXPECT_TRUE(has(LossClass::substance, "log 'GR'"));
    EXPECT_TRUE(has(LossClass::identity, "the name of a log"));
}

}  // namespace
}  // namespace geomend::test
