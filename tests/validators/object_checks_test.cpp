// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "pipeline/validate.h"
#include "support/real_data.h"
#include "validators/checks_testing.h"

// Point sets, polylines, wells, rasters and structured grids.

namespace geomend {
namespace {

using namespace testing;
using Codes = std::set<std::string>;

std::vector<Finding> findings_of(const Object& object, const CheckOptions& options = {}) {
    auto checked = validators::check(object, options);
    EXPECT_TRUE(checked);
    return checked ? std::move(checked->findings) : std::vector<Finding>{};
}
Codes codes_of(const Object& object) { return testing::codes_of(findings_of(object)); }

// ---- point sets

PointSet lattice_of_points(int n, double step = 1, Vec3 origin = {}) {
    PointSet set;
    set.info.name = "picks";
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) set.points.push_back({origin[0] + step * i, origin[1] + step * j, origin[2]});
    }
    return set;
}

TEST(PointSets, OfDifferentPlacesAreSound) {
    for (const double scale : {1e-3, 1.0, 1e3}) EXPECT_EQ(codes_of(lattice_of_points(10, scale)), Codes{});
    EXPECT_EQ(codes_of(lattice_of_points(10, 25, {500000, 6000000, -2000})), Codes{});
    EXPECT_EQ(codes_of(PointSet{}), Codes{});
    EXPECT_EQ(codes_of(lattice_of_points(1)), Codes{});
}

TEST(PointSets, TellEqualPointsFromNearOnes) {
    PointSet set = lattice_of_points(10);
    set.points.push_back(set.points[7]);
    set.points.push_back(set.points[7]);
    set.points.push_back({3, 3 + 1e-7, 0});  // the tolerance is 1.3e-6
    set.labels.first = 100;
    const auto found = findings_of(set);
    EXPECT_EQ(testing::codes_of(found), (Codes{"M01 warning", "M10 warning"}));
    const Finding equal = find(found, "M10", Severity::warning), near = find(found, "M01", Severity::warning);
    EXPECT_EQ(equal.elements, (std::vector<std::int64_t>{200, 201}));
    EXPECT_EQ(equal.index, (std::vector<std::int64_t>{100, 101}));
    EXPECT_EQ(near.elements, (std::vector<std::int64_t>{202}));
    EXPECT_EQ(near.entities.at(0).kind, "point-set");
    EXPECT_EQ(near.entities.at(0).name, "picks");
}

TEST(PointSets, TellWhereEqualPointsHaveOtherValues) {
    PointSet set = lattice_of_points(3);
    set.points.push_back(set.points[0]);
    set.points.push_back(set.points[1]);
    Attribute a;
    a.name = "value";
    a.values = std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, 0, 77};
    set.info.attributes.push_back(a);
    const Finding f = find(findings_of(set), "M10", Severity::warning);
    EXPECT_EQ(f.count, 2u);
    EXPECT_EQ(measure(f, "with_other_values"), 1);
}

TEST(PointSets, MayStateThatPointsShareAPlace) {
    PointSet set = lattice_of_points(3);
    set.points.push_back(set.points[4]);
    set.alias.assign(10, no_index);
    set.alias[9] = 4;
    EXPECT_EQ(codes_of(set), Codes{});
}

TEST(PointSets, OfOnePlaceSaySo) {
    PointSet set;
    set.points.assign(5, Vec3{1, 2, 3});
    const auto found = findings_of(set);
    ASSERT_EQ(testing::codes_of(found), Codes{"M10 warning"});
    EXPECT_NE(found[0].message.find("all points are at one position"), std::string::npos);
}

TEST(PointSets, WithACoordinateBeyondMeasureAreNotJudged) {
    for (const double bad : {1e20, -1e300, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        PointSet set = lattice_of_points(3);
        set.points.push_back(set.points[0]);
        set.points[5][1] = bad;
        const auto found = findings_of(set);
        ASSERT_EQ(testing::codes_of(found), Codes{"M09 error"});
        EXPECT_EQ(found[0].index, std::vector<std::int64_t>{5});
    }
}

TEST(PointSets, OfAMillionPointsTakeLittleTime) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(0, 1e4);
    PointSet set;
    for (int i = 0; i < 300000; ++i) set.points.push_back({place(random), place(random), place(random)});
    for (int i = 0; i < 1000; ++i) {
        Vec3 p = set.points[static_cast<std::size_t>(300 * i)];
        p[2] += 1e-4;  // the tolerance is above 1e-3
        set.points.push_back(p);
    }
    EXPECT_EQ(find(findings_of(set), "M01", Severity::warning).count, 1000u);
}

// ---- polylines

PolylineSet line_of(const std::vector<Vec3>& points, bool closed = false) {
    PolylineSet set;
    set.info.name = "line";
    set.points = points;
    for (std::uint32_t i = 0; i + 1 < points.size(); ++i) set.edges.push_back({i, i + 1});
    if (closed) set.edges.push_back({static_cast<std::uint32_t>(points.size()) - 1, 0});
    return set;
}

void add_line(PolylineSet& set, const std::vector<Vec3>& points) {
    if (set.parts.empty()) set.parts.push_back({0, 0, {}});
    const auto first = static_cast<std::uint32_t>(set.points.size());
    set.parts.push_back({first, set.edges.size(), {}});
    set.points.insert(set.points.end(), points.begin(), points.end());
    for (std::uint32_t i = 1; i < points.size(); ++i) set.edges.push_back({first + i - 1, first + i});
}

TEST(Polylines, ThatBranchCloseOrShareABorderAreSound) {
    EXPECT_EQ(codes_of(line_of({{0, 0, 0}, {1, 0, 0}, {2, 1, 0}})), Codes{});
    EXPECT_EQ(codes_of(line_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, true)), Codes{});
    EXPECT_EQ(codes_of(line_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}})), Codes{}) << "closed by a point at the place of the first";
    PolylineSet star = line_of({{0, 0, 0}, {1, 0, 0}});
    star.points.insert(star.points.end(), {{0, 1, 0}, {0, 0, 1}});
    star.edges.push_back({0, 2});
    star.edges.push_back({0, 3});
    EXPECT_EQ(codes_of(star), Codes{});
    PolylineSet fields = line_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}});
    add_line(fields, {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 0, 0}});
    EXPECT_EQ(codes_of(fields), Codes{});
    EXPECT_EQ(codes_of(PolylineSet{}), Codes{});
}

TEST(Polylines, TellEdgesWithoutLengthAndUnusedPoints) {
    PolylineSet set = line_of({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1e-9}});
    set.edges.push_back({3, 3});
    set.points.push_back({5, 5, 5});
    const auto found = findings_of(set);
    EXPECT_EQ(testing::codes_of(found), (Codes{"M02 info", "M11 warning"}));
    EXPECT_EQ(find(found, "M11", Severity::warning).index, (std::vector<std::int64_t>{1, 3, 4}));
    EXPECT_EQ(find(found, "M02", Severity::info).index, (std::vector<std::int64_t>{5}));
}

TEST(Polylines, TellEndsThatNearlyMeet) {
    PolylineSet set = line_of({{0, 0, 0}, {1, 0, 0}});
    add_line(set, {{1, 1e-9, 0}, {2, 0, 0}});
    EXPECT_EQ(codes_of(set), Codes{"M01 warning"});
}

TEST(Polylines, TellRepeatedEdges) {
    PolylineSet set = line_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
    set.edges.push_back({2, 1});
    const Finding f = find(findings_of(set), "M12", Severity::warning);
    EXPECT_EQ(f.index, (std::vector<std::int64_t>{2}));
    EXPECT_EQ(codes_of(set), Codes{"M12 warning"});
}

TEST(Polylines, TellALineThatCrossesTouchesOrOverlapsItself) {
    const auto kinds = [&](const std::vector<Vec3>& points) {
        const Finding f = find(findings_of(line_of(points)), "M13", Severity::warning);
        return std::array<double, 3>{measure(f, "crossing"), measure(f, "touch"), measure(f, "overlap")};
    };
    const std::array<double, 3> none{-1e300, -1e300, -1e300};
    EXPECT_EQ(kinds({{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {2, 2, 0}, {2, -2, 0}}), (std::array<double, 3>{1, 0, 0}));
    EXPECT_EQ(kinds({{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {2, 2, 0}, {2, 0, 0}}), (std::array<double, 3>{0, 1, 0}));
    EXPECT_EQ(kinds({{0, 0, 0}, {4, 0, 0}, {2, 0, 0}, {2, 2, 0}}), (std::array<double, 3>{0, 1, 1})) << "it turns back on itself";
    EXPECT_EQ(kinds({{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {2, 2, 1}, {2, -2, 1}}), none) << "it passes above";
}

TEST(Polylines, TellDifferentLinesThatCrossByANote) {
    PolylineSet set = line_of({{0, 0, 0}, {4, 0, 0}});
    add_line(set, {{2, -1, 0}, {2, 1, 0}});
    EXPECT_EQ(codes_of(set), Codes{"M14 info"});
    const Finding f = find(findings_of(set), "M14", Severity::info);
    ASSERT_EQ(f.points.size(), 1u);
    EXPECT_EQ(f.points[0], (Vec3{2, 0, 0}));
    for (Vec3& p : set.points) p[2] = p[0] == 2 ? 1 : 0;
    EXPECT_EQ(codes_of(set), Codes{}) << "one above the other";
}

TEST(Polylines, AreJudgedAlikeWhereverTheyAre) {
    std::mt19937 random(5);
    for (const double scale : {1e-3, 1.0, 1e3}) {
        for (const Vec3 origin : {Vec3{}, Vec3{500000 * scale, 6000000 * scale, -3000 * scale}}) {
            std::vector<Vec3> points;
            for (int i = 0; i < 200; ++i) {
                const double turn = 0.3 * i, far = 1 + 0.05 * i;
                points.push_back({origin[0] + scale * far * std::cos(turn), origin[1] + scale * far * std::sin(turn), origin[2]});
            }
            EXPECT_EQ(codes_of(line_of(points)), Codes{}) << scale;
            // A bar over three windings.
            PolylineSet crossed = line_of(points);
            const auto first = static_cast<std::uint32_t>(crossed.points.size());
            crossed.points.push_back({origin[0] + scale * 4.03, origin[1], origin[2]});
            crossed.points.push_back({origin[0] + scale * 7.17, origin[1], origin[2]});
            crossed.edges.push_back({first, first + 1});
            crossed.edges.push_back({0, first});
            EXPECT_TRUE(codes_of(crossed).contains("M13 warning")) << scale;
        }
    }
}

// All lines through one point: as many pairs as their square must not take the day.
TEST(Polylines, ThatAllMeetInOnePlaceAreBrokenOff) {
    PolylineSet set;
    for (std::uint32_t i = 0; i < 3000; ++i) {
        const double a = 3.14159 * i / 3000;
        set.points.push_back({std::cos(a), std::sin(a), 0});
        set.points.push_back({-std::cos(a), -std::sin(a), 0});
        set.edges.push_back({2 * i, 2 * i + 1});
    }
    const Finding f = find(findings_of(set), "M14", Severity::info);
    EXPECT_GE(f.count, 1000000u);
    EXPECT_NE(f.message.find("not counted"), std::string::npos);
}

TEST(MeshesOfPointsAndLines, AreJudgedAsPointSetsAndPolylines) {
    CellMesh mesh;
    mesh.points = {{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {2, 2, 0}, {2, -2, 0}};
    for (std::uint32_t i = 0; i < 4; ++i) mesh.add_cell(CellType::line, std::array{i, i + 1});
    Dataset data;
    data.objects.emplace_back(mesh);
    const auto checked = validators::check_models(data, {});
    ASSERT_TRUE(checked);
    EXPECT_EQ(testing::codes_of(checked->findings), Codes{"M13 warning"});
}

// ---- wells

Well straight_well() {
    Well well;
    well.info.name = "W-1";
    for (int s = 0; s <= 10; ++s) {
        well.path.push_back({500000, 6000000, -100.0 * s});
        well.measured_depth.push_back(100.0 * s);
    }
    well.markers = {{"top", 250, {}}, {"base", 1000, {}}};
    well.zones = {{"sand", 300, 400, {}}};
    Well::Curve log;
    log.values.name = "GR";
    log.measured_depth = {100, 200, 300};
    log.values.values = std::vector<double>{1, 2, 3};
    well.curves.push_back(log);
    return well;
}

TEST(Wells, WithAPlainPathAreSound) {
    EXPECT_EQ(codes_of(straight_well()), Codes{});
    Well upwards = straight_well();
    std::ranges::reverse(upwards.curves[0].measured_depth);
    EXPECT_EQ(codes_of(upwards), Codes{}) << "logs are run upwards";
    Well bare = straight_well();
    bare.measured_depth.clear();
    EXPECT_EQ(codes_of(bare), Codes{});
}

TEST(Wells, TellMeasuredDepthsThatDoNotGrow) {
    Well well = straight_well();
    well.measured_depth[4] = 250;  // 300 before, 500 behind it
    const auto found = findings_of(well);
    EXPECT_EQ(testing::codes_of(found), (Codes{"M30 error"}));
    EXPECT_EQ(find(found, "M30", Severity::error).index, (std::vector<std::int64_t>{4}));
    well.measured_depth[4] = 300;
    EXPECT_EQ(codes_of(well), (Codes{"M30 error"})) << "two places at one depth";
}

TEST(Wells, TellStationsInOnePlace) {
    Well well = straight_well();
    well.path.insert(well.path.begin() + 3, well.path[3]);
    well.measured_depth.insert(well.measured_depth.begin() + 3, 300);
    EXPECT_EQ(codes_of(well), (Codes{"M31 warning"}));
    EXPECT_EQ(find(findings_of(well), "M31", Severity::warning).index, (std::vector<std::int64_t>{4}));
}

TEST(Wells, TellPathsThatAreLongerThanWhatWasDrilled) {
    Well well = straight_well();
    well.path[5][0] += 50;
    EXPECT_EQ(find(findings_of(well), "M33", Severity::warning).count, 2u);
    Well feet = straight_well();
    for (Vec3& p : feet.path) p[2] /= 0.3048;
    EXPECT_EQ(find(findings_of(feet), "M33", Severity::warning).count, 10u);
    Well rounded_path = straight_well();
    for (std::size_t s = 0; s < rounded_path.path.size(); ++s) rounded_path.path[s][2] -= 0.004 * double(s % 2);
    EXPECT_EQ(codes_of(rounded_path), Codes{});
}

TEST(Wells, TellWhatLiesOffThePath) {
    Well well = straight_well();
    well.markers[1].measured_depth = 1200;
    well.zones[0].to = 290;
    well.curves[0].measured_depth = {100, 2000, 2100};
    const Finding f = find(findings_of(well), "M32", Severity::warning);
    EXPECT_EQ(f.count, 3u);
    ASSERT_EQ(f.entities.size(), 4u);
    EXPECT_EQ(f.entities[1].name, "base");
    EXPECT_EQ(f.entities[2].kind, "zone");
    EXPECT_EQ(f.entities[3].name, "GR");
    EXPECT_EQ(codes_of(well), Codes{"M32 warning"});
}

TEST(Wells, TellLogsThatGoBackAndForth) {
    Well well = straight_well();
    well.curves[0].measured_depth = {100, 300, 200};
    EXPECT_EQ(codes_of(well), Codes{"M34 warning"});
}

TEST(Wells, WithoutAPathAreNotCalledValid) {
    Dataset data;
    data.objects.emplace_back(Well{});
    const auto file = validate("well", data, {});
    ASSERT_TRUE(file);
    EXPECT_FALSE(file->valid.has_value());
    EXPECT_EQ(testing::codes_of(file->findings), Codes{"F160 info"});
    data.objects.emplace_back(lattice_of_points(3));
    EXPECT_FALSE(validate("well and points", data, {})->valid.has_value()) << "one of the two was not judged";
    data.objects.erase(data.objects.begin());
    EXPECT_EQ(validate("points", data, {})->valid, true);
}

TEST(Grids, WithoutActiveCellsAreNotCalledValid) {
    CornerPointGrid grid = testing::brick_grid(2, 2, 1);
    grid.activity.assign(grid.cell_count(), 0);
    Dataset data;
    data.objects.emplace_back(grid);
    const auto file = validate("grid", data, {});
    ASSERT_TRUE(file);
    EXPECT_FALSE(file->valid.has_value());
    EXPECT_EQ(testing::codes_of(file->findings), Codes{"F160 info"});
    EXPECT_NE(file->findings[0].message.find("no cell is active"), std::string::npos) << file->findings[0].message;
    testing::CheckOptions all;
    all.all_cells = true;
    EXPECT_EQ(validate("grid", data, all)->valid, true);
    std::get<CornerPointGrid>(data.objects[0]).activity[1] = 1;
    EXPECT_EQ(validate("grid", data, {})->valid, true);
}

// ---- rasters

Raster flat_raster(std::uint32_t ni, std::uint32_t nj, std::uint32_t nk) {
    Raster raster;
    raster.info.name = "lattice";
    raster.dims = {ni, nj, nk};
    raster.step = {{{25, 0, 0}, {0, 25, 0}, {0, 0, 4}}};
    return raster;
}

Attribute values_of(const std::string& name, std::vector<double> values) {
    Attribute a;
    a.name = name;
    a.values = std::move(values);
    return a;
}

TEST(Rasters, WithSquareOrLeaningAxesAreSound) {
    EXPECT_EQ(codes_of(flat_raster(4, 3, 2)), Codes{});
    EXPECT_EQ(codes_of(flat_raster(4, 3, 1)), Codes{});
    EXPECT_EQ(codes_of(flat_raster(4, 1, 1)), Codes{});
    EXPECT_EQ(codes_of(flat_raster(1, 1, 1)), Codes{});
    Raster leaning = flat_raster(4, 3, 2);
    leaning.step[2] = {30, 0, 0.001};
    EXPECT_EQ(codes_of(leaning), Codes{});
    Raster unused = flat_raster(4, 3, 1);
    unused.step[2] = {};
    EXPECT_EQ(codes_of(unused), Codes{}) << "one sample needs no step";
}

TEST(Rasters, TellAxesThatDoNotSpanThem) {
    Raster zero = flat_raster(4, 3, 2);
    zero.step[1] = {};
    EXPECT_EQ(codes_of(zero), Codes{"M40 error"});
    Raster parallel = flat_raster(4, 3, 1);
    parallel.step[1] = {50, 0, 0};
    EXPECT_EQ(codes_of(parallel), Codes{"M40 error"});
    Raster plane = flat_raster(4, 3, 2);
    plane.step[2] = {3, 4, 0};
    EXPECT_EQ(codes_of(plane), Codes{"M40 error"});
    Raster stops = flat_raster(3, 2, 2);
    stops.coordinates = {{{0, 1, 1}, {0, 1}, {0, 1}}};
    EXPECT_EQ(codes_of(stops), Codes{"M40 error"});
    stops.coordinates[0] = {0, 2, 1};
    EXPECT_EQ(codes_of(stops), Codes{"M40 error"});
    stops.coordinates[0] = {0, 1, 5};
    EXPECT_EQ(codes_of(stops), Codes{});
}

TEST(Rasters, NoteLeftHandedAxes) {
    Raster down = flat_raster(4, 3, 2);
    down.step[2] = {0, 0, -4};
    EXPECT_EQ(codes_of(down), Codes{"M41 info"});
    Raster map = flat_raster(4, 3, 1);
    map.step[1] = {0, -25, 0};
    EXPECT_EQ(codes_of(map), Codes{"M41 info"});
    Raster section = flat_raster(4, 1, 3);
    section.step[2] = {0, 0, -4};
    EXPECT_EQ(codes_of(section), Codes{}) << "a section has two sides";
    Raster falling = flat_raster(2, 2, 2);
    falling.coordinates = {{{0, 1}, {1, 0}, {0, 1}}};
    EXPECT_EQ(codes_of(falling), Codes{"M41 info"});
}

TEST(Properties, WithoutAnyValueAreTold) {
    Raster raster = flat_raster(2, 2, 1);
    raster.info.attributes = {values_of("good", {1, 2, 3, 4}), values_of("empty", {-99, -99, -99, -99}),
                              values_of("nan", {NAN, NAN, NAN, NAN})};
    raster.info.attributes[1].no_data = -99;
    const Finding f = find(findings_of(raster), "M42", Severity::warning);
    EXPECT_EQ(f.count, 2u);
    ASSERT_EQ(f.entities.size(), 3u);
    EXPECT_EQ(f.entities[1].name, "empty");
    raster.info.attributes.resize(1);
    EXPECT_EQ(codes_of(raster), Codes{});
}

TEST(Properties, WithUndeclaredNoDataAreNoted) {
    const auto codes = [&](std::vector<double> values, std::optional<double> declared = {}) {
        Raster raster = flat_raster(2, 2, 1);
        raster.info.attributes = {values_of("depth", std::move(values))};
        raster.info.attributes[0].no_data = declared;
        return codes_of(raster);
    };
    EXPECT_EQ(codes({1, 2, -999.25, 3}), Codes{"M43 info"});
    EXPECT_EQ(codes({1, 2, 1e30, 3}), Codes{"M43 info"});
    EXPECT_EQ(codes({1, 2, double(1e30f), 3}), Codes{"M43 info"}) << "in single precision";
    EXPECT_EQ(codes({1, 2, -999.25, 3}, -999.25), Codes{});
    EXPECT_EQ(codes({-2000, -500, -999, -1000}), Codes{}) << "it lies among the others";
    EXPECT_EQ(codes({-2000, -1500, -999, -1200}), Codes{}) << "it is a value like the others";
    EXPECT_EQ(codes({1, 2, 3, 4}), Codes{});
    EXPECT_EQ(codes({-999, -999, -999, -999}), Codes{}) << "nothing to compare with";
}

// ---- structured grids

StructuredGrid bricks(std::uint32_t ni, std::uint32_t nj, std::uint32_t nk) {
    StructuredGrid grid;
    grid.info.name = "bricks";
    grid.dims = {ni + 1, nj + 1, nk + 1};
    for (std::uint32_t k = 0; k <= nk; ++k) {
        for (std::uint32_t j = 0; j <= nj; ++j) {
            for (std::uint32_t i = 0; i <= ni; ++i) grid.points.push_back({100.0 * i, 50.0 * j, 10.0 * k + 3.0 * i});
        }
    }
    return grid;
}

Vec3& node(StructuredGrid& grid, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return grid.points[(std::size_t{k} * grid.dims[1] + j) * grid.dims[0] + i];
}

TEST(StructuredGrids, OfBricksAreSoundWhicheverWayTheyRun) {
    EXPECT_EQ(codes_of(bricks(4, 3, 2)), Codes{});
    StructuredGrid down = bricks(4, 3, 2);
    for (Vec3& p : down.points) p[2] = -p[2];
    EXPECT_EQ(codes_of(down), Codes{});
    StructuredGrid sheet = bricks(4, 3, 0);
    EXPECT_EQ(codes_of(sheet), Codes{});
    StructuredGrid far = bricks(4, 3, 2);
    for (Vec3& p : far.points) p = {p[0] + 500000, p[1] + 6000000, p[2]};
    EXPECT_EQ(codes_of(far), Codes{});
}

TEST(StructuredGrids, TellCellsThatAreTurnedOver) {
    StructuredGrid grid = bricks(4, 3, 2);
    for (std::uint32_t j = 0; j < 4; ++j) {
        for (std::uint32_t i = 3; i < 5; ++i) node(grid, i, j, 2)[2] = node(grid, i, j, 1)[2] - 5;
    }
    const auto found = findings_of(grid);
    const Finding f = find(found, "M20", Severity::error);
    EXPECT_EQ(cells_of(f), (std::vector<Cell>{{4, 1, 2}, {4, 2, 2}, {4, 3, 2}}));
    EXPECT_EQ(f.index, (std::vector<std::int64_t>{15, 19, 23}));
    EXPECT_EQ(f.entities.at(0).kind, "structured-grid");
    grid.dead_cells.assign(24, 0);
    for (const std::size_t dead : {14u, 15u, 18u, 19u, 22u, 23u}) grid.dead_cells[dead] = 1;
    EXPECT_EQ(codes_of(grid), Codes{}) << "blanked cells are not judged";
}

TEST(StructuredGrids, TellPinchedCellsByAWarning) {
    StructuredGrid grid = bricks(4, 3, 2);
    for (std::uint32_t j = 0; j < 4; ++j) {
        for (std::uint32_t i = 2; i < 5; ++i) node(grid, i, j, 2) = node(grid, i, j, 1);
    }
    const auto found = findings_of(grid);
    EXPECT_EQ(testing::codes_of(found), Codes{"M20 warning"}) << "the wedges before them are sound";
    EXPECT_EQ(find(found, "M20", Severity::warning).count, 6u);
}

TEST(StructuredGrids, TellFoldedCells) {
    StructuredGrid grid = bricks(2, 2, 2);
    node(grid, 1, 1, 1) = {30, 15, 3};  // past the diagonal of the first cell
    const auto found = findings_of(grid);
    EXPECT_TRUE(testing::codes_of(found).contains("M21 error"));
}

TEST(StructuredGrids, TellLayersWithoutThickness) {
    StructuredGrid grid = bricks(4, 3, 2);
    for (std::uint32_t j = 0; j < 4; ++j) {
        for (std::uint32_t i = 0; i < 5; ++i) node(grid, i, j, 1) = node(grid, i, j, 0);
    }
    const Finding f = find(findings_of(grid), "M50", Severity::warning);
    EXPECT_EQ(f.count, 1u);
    EXPECT_NE(f.message.find("layer 1 along k"), std::string::npos) << f.message;
}

TEST(StructuredGrids, JudgeCellsAtSplitNodesByTheirOwnCorners) {
    StructuredGrid grid = bricks(2, 1, 1);
    for (std::uint32_t j = 0; j < 2; ++j) {
        for (std::uint32_t k = 0; k < 2; ++k) {
            Vec3 p = node(grid, 1, j, k);
            p[2] -= 30;  // the second column is thrown down at its western nodes
            StructuredGrid::Split split{};
            split.node = {1, j, k};
            split.position = p;
            for (unsigned b = 0; b < 8; ++b) split.cells |= static_cast<std::uint8_t>((b & 1u) == 0 ? 1u << b : 0u);
            grid.splits.push_back(split);
            node(grid, 2, j, k)[2] -= 30;
        }
    }
    EXPECT_EQ(codes_of(grid), Codes{});
    // Its lower nodes alone thrown up through its roof.
    for (auto& split : grid.splits) split.position[2] += split.node[2] == 0 ? 60 : 0;
    EXPECT_TRUE(codes_of(grid).contains("M20 error") || codes_of(grid).contains("M21 error"));
}

// ---- real files

TEST(RealObjects, AreValid) {
    bool any = false;
    for (const char* name : {"gocad/points.vs", "gocad/normal_lines.pl", "gocad/test.wl", "gocad/test.vo", "gocad/auscope/vsTest.vs",
                             "gocad/auscope/plTest.pl", "gocad/auscope/wl2Test.wl", "gocad/auscope/gpTest.gp", "gocad/auscope/small.vo",
                             "vtk/egg_withBurdens_small.vts", "vtk/cube_STRUCTURED_GRID.vtk", "vtk/cube_STRUCTURED_POINTS.vtk",
                             "vtk/cube_RECTILINEAR_GRID.vtk"}) {
        const auto path = test::real_data(name);
        if (!path) continue;
        any = true;
        const auto file = validate(path->string(), LoadOptions{}, CheckOptions{});
        ASSERT_TRUE(file) << name << ": " << file.why().error.message;
        EXPECT_EQ(file->valid, true) << name;
        for (const Finding& f : file->findings) EXPECT_NE(f.severity, Severity::error) << name << ": " << f.code << " " << f.message;
    }
    if (!any) GTEST_SKIP() << "no real data";
}

}  // namespace
}  // namespace geomend
