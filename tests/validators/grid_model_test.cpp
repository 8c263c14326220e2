// SPDX-License-Identifier: AGPL-3.0-or-later
// The boundary representation of a corner-point grid, judged: by itself (as convert writes it) and with the grid.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "grid/boundary_model.h"
#include "topology/brep_from_dataset.h"
#include "validators/checks_testing.h"

namespace geomend {
namespace {

using namespace testing;
using Codes = std::set<std::string>;

CheckOptions as_brep(std::string regions = {}, std::vector<std::uint32_t> horizons = {}) {
    CheckOptions options;
    options.grid_model = grid::ModelRequest{std::move(regions), std::move(horizons)};
    return options;
}

// Numbers of surfaces of each interface.
std::map<std::string, int> surfaces_of(const CornerPointGrid& grid) {
    auto model = grid::boundary_model(grid, {});
    std::map<std::string, int> counts;
    for (const Object& object : model->objects) ++counts[info_of(object).name];
    return counts;
}

// Codes of errors and warnings of the model as a file of surfaces would have it. Layers may be thinner than the rule's tolerance.
Codes codes_of_model(const CornerPointGrid& grid, const grid::ModelRequest& request = {}) {
    auto model = grid::boundary_model(grid, request);
    CheckOptions options;
    options.tolerance = 0;
    auto checked = validators::check_models(*model, options);
    // A fault may part the region of a grid into blocks; as one region of a file of surfaces these are volumes too many (B13).
    std::erase_if(checked->findings, [](const Finding& f) { return f.severity == Severity::info || f.element_kind == "volume"; });
    return codes_of(checked->findings);
}

// Columns of one row along a line on the ground, 100 wide, two layers of 10.
CornerPointGrid ribbon(const std::vector<std::array<double, 2>>& line) {
    CornerPointGrid grid = brick_grid(static_cast<std::uint32_t>(line.size() - 1), 1, 2);
    for (std::uint32_t i = 0; i < line.size(); ++i) {
        const auto& a = line[i == 0 ? 0 : i - 1];
        const auto& b = line[i + 1 < line.size() ? i + 1 : i];
        const double dx = b[0] - a[0], dy = b[1] - a[1], length = std::hypot(dx, dy);
        for (const std::uint32_t j : {0u, 1u}) {
            const double away = j == 0 ? -50 : 50;
            for (const std::size_t at : {0u, 3u}) {
                pillar(grid, i, j)[at] = line[i][0] - away * dy / length;
                pillar(grid, i, j)[at + 1] = line[i][1] + away * dx / length;
            }
        }
    }
    return grid;
}

const std::vector<std::array<double, 2>> bow{{0, 0}, {300, 0}, {600, 0}, {900, 100}, {1000, 400}, {800, 700}, {500, 700}, {400, 400}};

TEST(BoundaryOfGrids, HasOneSurfaceForEachPieceThatHangsTogether) {
    CornerPointGrid grid = brick_grid(4, 3, 2);
    EXPECT_EQ(surfaces_of(grid),
              (std::map<std::string, int>{
                  {"base", 1}, {"boundary I+", 1}, {"boundary I-", 1}, {"boundary J+", 1}, {"boundary J-", 1}, {"top", 1}}));
    // Where cells meet across the throw, where the upper block stands out, and where the lower one does.
    add_throw(grid, 2, 5);
    EXPECT_EQ(surfaces_of(grid), (std::map<std::string, int>{{"base", 2},
                                                             {"boundary I+", 1},
                                                             {"boundary I-", 1},
                                                             {"boundary J+", 1},
                                                             {"boundary J-", 1},
                                                             {"top", 2},
                                                             {"unnamed throw", 3}}));
    // Blocks that do not touch any more have sides of their own.
    add_throw(grid, 2, 95);
    EXPECT_EQ(surfaces_of(grid), (std::map<std::string, int>{{"base", 2},
                                                             {"boundary I+", 1},
                                                             {"boundary I-", 1},
                                                             {"boundary J+", 2},
                                                             {"boundary J-", 2},
                                                             {"top", 2},
                                                             {"unnamed throw", 2}}));
}

TEST(BoundaryOfGrids, IsSoundWithFaultsInSteps) {
    for (const int way : {1, -1}) {
        CornerPointGrid grid = brick_grid(6, 6, 3);
        reshape(grid, [&](std::uint32_t i, std::uint32_t j, auto, unsigned, double depth) {
            return (way > 0 ? i + j >= 6 : i >= j) ? depth + 4 : depth;
        });
        EXPECT_EQ(codes_of_model(grid), Codes{}) << way;
        EXPECT_EQ(codes_of(findings_of(grid, as_brep())), Codes{"C18 info"}) << way;
    }
}

TEST(BoundaryOfGrids, IsSoundWithFaultsThatCross) {
    CornerPointGrid grid = brick_grid(6, 6, 3);
    reshape(grid,
            [](std::uint32_t i, std::uint32_t j, auto, unsigned, double depth) { return depth + (i >= 3 ? 4 : 0) + (j >= 2 ? 7 : 0); });
    EXPECT_EQ(codes_of_model(grid), Codes{});
    EXPECT_EQ(codes_of_model(grid, {"", {1, 2}}), Codes{});
    EXPECT_EQ(codes_of(findings_of(grid, as_brep("", {1, 2}))), Codes{"C18 info"});
}

// Four walls around one column, on a fault that goes on: the sheet would come back to itself.
TEST(BoundaryOfGrids, IsSoundWithALoopOnAFault) {
    CornerPointGrid grid = brick_grid(6, 6, 3);
    reshape(grid, [](std::uint32_t i, std::uint32_t j, auto, unsigned, double depth) {
        if (i == 2 && j == 3) return depth + 3;
        return i >= 3 ? depth + 7 : depth;
    });
    EXPECT_EQ(codes_of_model(grid), Codes{});
}

TEST(BoundaryOfGrids, IsSoundAroundInactiveCells) {
    CornerPointGrid grid = brick_grid(5, 5, 3);
    grid.activity.assign(grid.cell_count(), 1);
    for (const auto& [i, j, k] : {std::array{1u, 1u, 1u}, std::array{2u, 2u, 1u}, std::array{3u, 2u, 2u}, std::array{0u, 4u, 0u}})
        grid.activity[grid.cell(i, j, k)] = 0;
    add_throw(grid, 3, 4);
    EXPECT_EQ(codes_of_model(grid), Codes{});
}

TEST(GridModels, C27FindsAGridThatRunsIntoItself) {
    auto line = bow;
    const CornerPointGrid free = ribbon(line);
    EXPECT_EQ(codes_of(findings_of(free, as_brep())), Codes{});
    line.push_back({420, -200});  // across column 2, from 300 to 600
    const CornerPointGrid crossed = ribbon(line);
    EXPECT_EQ(codes_of(findings_of(crossed)), Codes{}) << "no other check sees it";
    const Finding f = find(findings_of(crossed, as_brep()), "C27", Severity::error);
    std::set<std::int64_t> columns;
    for (const Cell& cell : cells_of(f)) columns.insert(cell[0]);
    EXPECT_EQ(columns, (std::set<std::int64_t>{2, 8}));
    EXPECT_EQ(f.count, 4u);  // both layers of both columns
    EXPECT_FALSE(f.polylines.empty());
    CornerPointGrid mended = crossed;
    mended.activity.assign(mended.cell_count(), 1);
    mended.activity[mended.cell(7, 0, 0)] = mended.activity[mended.cell(7, 0, 1)] = 0;
    EXPECT_EQ(codes_of(findings_of(mended, as_brep())), Codes{});
    CheckOptions skipped = as_brep();
    skipped.skip = {"C27"};
    EXPECT_EQ(codes_of(findings_of(crossed, skipped)), Codes{});
}

TEST(GridModels, C27FindsColumnsThatLieInOnePlace) {
    // Out and back again, in the same depths: all sides of the first and the last column are in the same planes.
    CornerPointGrid grid = ribbon({{0, 0}, {100, 0}, {300, 300}, {600, 300}, {600, -300}, {100, -300}, {-100, -150}, {-100, 0}, {0, 0}});
    for (const std::uint32_t j : {0u, 1u}) {
        for (std::size_t v = 0; v < 6; ++v) {
            pillar(grid, 7, j)[v] = pillar(grid, 0, j)[v];
            pillar(grid, 8, j)[v] = pillar(grid, 1, j)[v];
        }
    }
    EXPECT_TRUE(codes_of(findings_of(grid, as_brep())).contains("C27 error"));
}

TEST(GridModels, C27AcceptsColumnsThatOnlyTouch) {
    // A ring of eight columns whose last side is the first one's.
    std::vector<std::array<double, 2>> ring;
    for (int n = 0; n <= 8; ++n) ring.push_back({1000 * std::cos(n * std::acos(-1.0) / 4), 1000 * std::sin(n * std::acos(-1.0) / 4)});
    CornerPointGrid grid = ribbon(ring);
    for (const std::uint32_t j : {0u, 1u}) {
        for (std::size_t v = 0; v < 6; ++v) pillar(grid, 8, j)[v] = pillar(grid, 0, j)[v];
    }
    EXPECT_EQ(codes_of(findings_of(grid, as_brep())), Codes{});
}

// A throw between pillars that lean apart: sides are bent, and tops that meet them are plane.
CornerPointGrid leaning(double lean) {
    CornerPointGrid grid = brick_grid(4, 4, 2);
    for (std::uint32_t j = 0; j <= 4; ++j) {
        for (std::uint32_t i = 0; i <= 4; ++i) pillar(grid, i, j)[3] += (j % 2 == 0 ? lean : -lean);
    }
    reshape(grid, [](std::uint32_t i, std::uint32_t j, auto, unsigned c, double depth) {
        const double y = j + ((c >> 1) & 1u);
        return i >= 2 ? depth + 9 - 5 * y : depth + 3 * y;
    });
    return grid;
}

TEST(GridModels, C28TellsOfBentFacesOnlyWhereTheyCross) {
    const auto upright = findings_of(leaning(0), as_brep());
    EXPECT_FALSE(codes_of(upright).contains("C28 info"));
    const auto bent = findings_of(leaning(30), as_brep());
    const Finding f = find(bent, "C28", Severity::info);
    EXPECT_GT(f.count, 0u);
    EXPECT_GT(measure(f, "depth"), 0);
    for (const Cell& cell : cells_of(f)) EXPECT_TRUE(cell[0] == 2 || cell[0] == 3) << cell[0] << " is not at the fault";
    EXPECT_FALSE(codes_of(findings_of(leaning(30))).contains("C28 info"));
}

TEST(GridModels, ThatOverlapAreNotJudgedTwice) {
    CornerPointGrid grid = brick_grid(2, 1, 3);
    for (unsigned c = 4; c < 8; ++c) corner(grid, 0, 0, 0, c) += 4;
    const auto without = codes_of(grid), with = codes_of(findings_of(grid, as_brep()));
    Codes more;
    std::ranges::set_difference(with, without, std::inserter(more, more.end()));
    EXPECT_TRUE(without.contains("C04 error"));
    EXPECT_EQ(more, Codes{"F162 info"});
}

TEST(GridModels, AreNotMadeOfCoordinatesThatAreNotFinite) {
    CornerPointGrid grid = brick_grid(2, 1, 2);
    corner(grid, 0, 0, 0, 0) = 1e30;
    EXPECT_EQ(codes_of(findings_of(grid, as_brep())), (Codes{"C02 error", "F162 info"}));
}

TEST(GridModels, OfRegionsTellOfScatteredOnesOnce) {
    CornerPointGrid grid = brick_grid(5, 1, 1);
    add_constant(grid, "BLOCK", 1);
    auto& block = std::get<std::vector<double>>(grid.info.attributes[0].values);
    block = {1, 1, 2, 2, 2};
    EXPECT_EQ(codes_of(findings_of(grid, as_brep("BLOCK"))), Codes{});
    block = {1, 2, 1, 1, 2};
    EXPECT_EQ(codes_of(findings_of(grid, as_brep("BLOCK"))), Codes{"C23 info"});
    EXPECT_EQ(codes_of(grid), Codes{}) << "an attribute that nobody asked for";
    EXPECT_EQ(codes_of(findings_of(grid, as_brep("NONE"))), Codes{"F162 warning"});
    EXPECT_EQ(codes_of(findings_of(grid, as_brep("", {1}))), Codes{"F162 warning"}) << "there is nothing below the only layer";
}

TEST(GridModels, OfManyRandomGridsAreSound) {
    std::uint64_t state = 11;
    const auto below = [&](std::uint32_t n) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<std::uint32_t>((state >> 33) % n);
    };
    for (int round = 0; round < 200; ++round) {
        SCOPED_TRACE(round);
        CornerPointGrid grid = brick_grid(5, 5, 3);
        std::array<double, 25> down{};
        for (double& d : down) d = below(2) == 0 ? 0 : 1.25 * below(30);
        reshape(grid, [&](std::uint32_t i, std::uint32_t j, auto, unsigned, double depth) { return depth + down[i + 5 * j]; });
        grid.activity.assign(grid.cell_count(), 1);
        for (int n = 0; n < 5; ++n) grid.activity[below(75)] = 0;
        // Blocks that faults part are regions of their own to B13 of models; of a grid they are one.
        const auto found = findings_of(grid, as_brep());
        Codes of_model = codes_of_model(grid);
        of_model.erase("B13 error");
        ASSERT_EQ(of_model, Codes{});
        for (const Finding& f : found) {
            ASSERT_EQ(f.severity, Severity::info) << f.code << ' ' << f.message;
            ASSERT_NE(f.code, "C28") << f.message;
        }
    }
}

// The outline of a column of a ribbon, round.
std::array<std::array<double, 2>, 4> outline_of(CornerPointGrid& grid, std::uint32_t i) {
    const auto at = [&](std::uint32_t a, std::uint32_t j) { return std::array{pillar(grid, a, j)[0], pillar(grid, a, j)[1]}; };
    return {at(i, 0), at(i + 1, 0), at(i + 1, 1), at(i, 1)};
}

// How far two convex outlines reach into each other, along the direction in which that is least; negative: they are apart.
double reach_of(const std::array<std::array<double, 2>, 4>& a, const std::array<std::array<double, 2>, 4>& b) {
    double least = HUGE_VAL;
    for (const auto* outline : {&a, &b}) {
        for (std::size_t n = 0; n < 4; ++n) {
            const auto &p = (*outline)[n], &q = (*outline)[(n + 1) % 4];
            const double length = std::hypot(q[0] - p[0], q[1] - p[1]);
            const std::array normal{(p[1] - q[1]) / length, (q[0] - p[0]) / length};
            std::array<double, 2> low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
            for (const auto* shape : {&a, &b}) {
                const std::size_t which = shape == &a ? 0 : 1;
                for (const auto& corner : *shape) {
                    const double along = corner[0] * normal[0] + corner[1] * normal[1];
                    low[which] = std::min(low[which], along);
                    high[which] = std::max(high[which], along);
                }
            }
            least = std::min({least, high[0] - low[1], high[1] - low[0]});
        }
    }
    return least;
}

// Ribbons that wander about, and run into themselves or not: the columns told are those whose outlines overlap, by the
// separating directions of convex outlines.
TEST(GridModels, C27TellsJustTheColumnsThatOverlap) {
    std::uint64_t state = 5;
    const auto random = [&] {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return double(state >> 40) / double(1u << 24);
    };
    int folded = 0, free = 0;
    for (int round = 0; round < 300; ++round) {
        SCOPED_TRACE(round);
        std::vector<std::array<double, 2>> line{{0, 0}};
        double way = 0, turn = 1.6 * (random() - 0.5);
        for (int n = 0; n < 14; ++n) {
            way += 0.7 * turn;
            turn += 0.3 * (random() - 0.5);
            const double step = 120 + 60 * random();
            line.push_back({line.back()[0] + step * std::cos(way), line.back()[1] + step * std::sin(way)});
        }
        CornerPointGrid grid = ribbon(line);
        std::set<std::int64_t> expected;
        bool close = false;
        for (std::uint32_t p = 0; p < 14; ++p) {
            for (std::uint32_t q = p + 2; q < 14; ++q) {
                const double reach = reach_of(outline_of(grid, p), outline_of(grid, q));
                close = close || std::abs(reach) < 0.01;
                if (reach > 0) expected.insert({p + 1, q + 1});
            }
        }
        if (close) continue;
        ++(expected.empty() ? free : folded);
        std::set<std::int64_t> columns;
        for (const Cell& cell : cells_of(find(findings_of(grid, as_brep()), "C27", Severity::error))) columns.insert(cell[0]);
        ASSERT_EQ(columns, expected);
    }
    EXPECT_GT(folded, 30);
    EXPECT_GT(free, 30);
}

// Depths from a few whole numbers: layers without thickness, gaps that close, faces that coincide.
TEST(GridModels, OfManyGridsWithPinchesAndGapsClose) {
    std::uint64_t state = 7;
    const auto below = [&](std::uint32_t n) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<std::uint32_t>((state >> 33) % n);
    };
    for (int round = 0; round < 60; ++round) {
        SCOPED_TRACE(round);
        CornerPointGrid grid = brick_grid(5, 5, 4);
        const double lean = round % 2 == 0 ? 0 : 20;
        for (std::uint32_t p = 0; p < 36; ++p) pillar(grid, p % 6, p / 6)[3] += lean * std::sin(p);
        for (std::uint32_t column = 0; column < 100; ++column) {
            const std::uint32_t i = column / 4 % 5, j = column / 20;
            double depth = 1000 + below(4);
            for (std::uint32_t k = 0; k < 4; ++k) {
                depth += below(6) == 0 ? 1 : 0;
                corner(grid, i, j, k, column % 4) = depth;
                depth += below(3);
                corner(grid, i, j, k, column % 4 + 4) = depth;
            }
        }
        grid.activity.assign(grid.cell_count(), 1);
        for (int n = 0; n < 10; ++n) grid.activity[below(100)] = 0;
        for (const Finding& f : findings_of(grid, as_brep("", {2}))) ASSERT_NE(f.code[0], 'B') << f.code << ' ' << f.message;
        const Codes of_model = codes_of_model(grid, {"", {2}});
        for (const char* code : {"B03 error", "B04 error", "B05 error", "B07 error", "M05 error"})
            ASSERT_FALSE(of_model.contains(code)) << code;
    }
}

}  // namespace
}  // namespace geomend
