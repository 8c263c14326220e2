// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/length.h"
#include "base/vectors.h"
#include "judged_model.h"
#include "volume/fill.h"

// Two boxes on top of each other, with a plane between them at z = 6 that has 4 x 4 squares, filled with paths as edges. What lies
// inside is known: from 0 to 10 along each axis.

namespace geomend::volumes {
namespace {

using test::model_of;
using Ends = std::array<std::uint32_t, 2>;

/// A rectangle of n x n squares in the plane across an axis, its normal along or against it.
void add_plane(Surface& surface, std::size_t axis, double at, const Vec3& low, const Vec3& high, int n, bool along) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            std::array<Vec3, 4> quad{};
            constexpr std::array<int, 4> di{0, 1, 1, 0}, dj{0, 0, 1, 1};
            for (std::size_t k = 0; k < 4; ++k) {
                quad[k][axis] = at;
                quad[k][u] = low[u] + (high[u] - low[u]) * (i + di[k]) / n;
                quad[k][v] = low[v] + (high[v] - low[v]) * (j + dj[k]) / n;
            }
            if (!along) std::swap(quad[1], quad[3]);
            const auto first = static_cast<std::uint32_t>(surface.points.size());
            surface.points.insert(surface.points.end(), quad.begin(), quad.end());
            surface.polygons.push_back(std::array<std::uint32_t, 3>{first, first + 1, first + 2});
            surface.polygons.push_back(std::array<std::uint32_t, 3>{first, first + 2, first + 3});
        }
    }
}

topology::JudgedModel two_boxes() {
    Surface around, between;
    around.info.name = "around";
    around.info.role = FeatureRole::boundary;
    between.info.name = "between";
    between.info.role = FeatureRole::horizon;
    for (const auto& [low, high] : {std::pair{Vec3{0, 0, 0}, Vec3{10, 10, 6}}, std::pair{Vec3{0, 0, 6}, Vec3{10, 10, 10}}}) {
        for (std::size_t axis = 0; axis < 2; ++axis) {
            add_plane(around, axis, 0, low, high, 4, false);
            add_plane(around, axis, 10, low, high, 4, true);
        }
    }
    add_plane(around, 2, 0, {0, 0, 0}, {10, 10, 10}, 4, false);
    add_plane(around, 2, 10, {0, 0, 0}, {10, 10, 10}, 4, true);
    add_plane(between, 2, 6, {0, 0, 0}, {10, 10, 10}, 4, true);
    return model_of({around, between});
}

Result<Filled> fill(const std::vector<std::vector<Vec3>>& paths, double size = 0) {
    FillOptions options;
    options.limits.program = {GEOMEND_PROGRAM};
    options.size = size;
    options.well_tolerance = 1e-7;
    for (const auto& path : paths) options.wells.push_back({"well " + std::to_string(options.wells.size()), path});
    return fill_dividing_surfaces(*two_boxes().brep, two_boxes().found, options);
}

std::set<Ends> cell_edges(const BrepData& brep) {
    std::set<Ends> edges;
    for (const auto& region : brep.regions) {
        for (std::size_t c = 0; c < region.cell_types.size(); ++c) {
            for (std::size_t i = 0; i < 4; ++i) {
                for (std::size_t k = 0; k < 4; ++k)
                    edges.insert({region.nodes[region.cell_nodes[4 * c + i]].value, region.nodes[region.cell_nodes[4 * c + k]].value});
            }
        }
    }
    return edges;
}

/// How far a point lies from a polyline.
double distance_to(const std::vector<Vec3>& path, const Vec3& p) {
    double least = 1e300;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        const Vec3 d = minus(path[i + 1], path[i]);
        const double share = std::clamp(dot(minus(p, path[i]), d) / dot(d, d), 0.0, 1.0);
        least = std::min(least, length(minus(p, plus(path[i], times(share, d)))));
    }
    return least;
}

/// What of a segment lies in the box from 0 to 10.
double length_in_box(const Vec3& a, const Vec3& b) {
    double from = 0, to = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const double d = b[k] - a[k];
        if (d == 0) {
            if (a[k] < 0 || a[k] > 10) return 0;
            continue;
        }
        from = std::max(from, std::min((0 - a[k]) / d, (10 - a[k]) / d));
        to = std::min(to, std::max((0 - a[k]) / d, (10 - a[k]) / d));
    }
    return to > from ? (to - from) * length(minus(b, a)) : 0;
}

double length_in_box(const std::vector<Vec3>& path) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) sum += length_in_box(path[i], path[i + 1]);
    return sum;
}

/// All regions are filled to their volumes, and each path is edges of cells over its whole way in the box.
void expect_wells_are_edges(const Filled& filled, const std::vector<std::vector<Vec3>>& paths) {
    ASSERT_EQ(filled.regions.size(), 2u);
    double volume = 0;
    for (const auto& region : filled.regions) {
        ASSERT_TRUE(region.filled()) << region.why_not.front();
        EXPECT_NEAR(region.volume, region.volume > 500 ? 600 : 400, 1e-9 * 600);
        volume += region.volume;
    }
    EXPECT_NEAR(volume, 1000, 1e-6);
    const auto edges = cell_edges(filled.brep);
    ASSERT_EQ(filled.wells.size(), paths.size());
    for (std::size_t w = 0; w < paths.size(); ++w) {
        double sum = 0;
        for (const Ends& e : filled.wells[w].edges) {
            EXPECT_TRUE(edges.contains(e)) << "well " << w;
            const Vec3 &a = filled.brep.vertices[e[0]], &b = filled.brep.vertices[e[1]];
            EXPECT_LT(std::max(distance_to(paths[w], a), distance_to(paths[w], b)), 3e-7) << "well " << w;
            sum += length(minus(b, a));
        }
        EXPECT_NEAR(sum, length_in_box(paths[w]), 1e-9 * (1 + sum)) << "well " << w;
        EXPECT_NEAR(sum, filled.wells[w].inside, 1e-9 * (1 + sum));
    }
}

TEST(FillWells, AWellThatEndsInsideIsAChainOfEdgesThroughTheSurface) {
    const std::vector<std::vector<Vec3>> paths{{{3.1, 4.3, 12}, {3.1, 4.3, 7}, {5.7, 4.9, 2.2}}};
    const auto filled = fill(paths);
    ASSERT_TRUE(filled) << filled.why().error.message;
    expect_wells_are_edges(*filled, paths);
    const auto& edges = filled->wells[0].edges;
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) EXPECT_EQ(edges[i][1], edges[i + 1][0]);
    EXPECT_EQ(filled->wells[0].crossings, 2u);  // the top, and the plane between
    EXPECT_NEAR(filled->brep.vertices[edges.back()[1]][2], 2.2, 1e-12);
}

TEST(FillWells, PiecesAreNoLongerThanCellsAreToBe) {
    const std::vector<std::vector<Vec3>> paths{{{3.1, 4.3, 9.5}, {6.2, 4.9, 0.5}}};
    const auto filled = fill(paths, 0.8);
    ASSERT_TRUE(filled) << filled.why().error.message;
    expect_wells_are_edges(*filled, paths);
    EXPECT_GE(filled->wells[0].edges.size(), 12u);
    for (const Ends& e : filled->wells[0].edges)
        EXPECT_LE(length(minus(filled->brep.vertices[e[0]], filled->brep.vertices[e[1]])), 0.8 + 1e-9);
}

TEST(FillWells, WellsThatPassCloseByHaveShortEdgesThereAndNowhereElse) {
    const std::vector<std::vector<Vec3>> paths{{{3.1, 4.3, 9.5}, {3.1, 4.3, 0.5}}, {{1.2, 4.32, 3.1}, {8.9, 4.32, 2.7}}};
    const auto filled = fill(paths, 3);
    ASSERT_TRUE(filled) << filled.why().error.message;
    expect_wells_are_edges(*filled, paths);
    double shortest = 100;
    for (const WellChain& chain : filled->wells) {
        for (const Ends& e : chain.edges)
            shortest = std::min(shortest, length(minus(filled->brep.vertices[e[0]], filled->brep.vertices[e[1]])));
        EXPECT_LT(chain.edges.size(), 60u) << "pieces become longer away from the place";
    }
    EXPECT_LE(shortest, 0.04);
}

TEST(FillWells, WellsTooCloseBesideEachOtherAreRefusedByTheirNamesAndPlace) {
    const auto filled = fill({{{3.1, 4.3, 9.5}, {3.1, 4.3, 0.5}}, {{3.10001, 4.3, 9.5}, {3.10001, 4.3, 0.5}}}, 3);
    ASSERT_FALSE(filled);
    EXPECT_NE(filled.why().error.message.find("wells 'well 0' and 'well 1' come within 1e-05 of each other at (3.1"), std::string::npos)
        << filled.why().error.message;
}

TEST(FillWells, WellsMayRunAlongSurfacesAndTheirEdgesAndThroughTheirVertices) {
    const std::vector<std::vector<Vec3>> paths{
        {{1.3, 1.1, 6}, {8.2, 6.4, 6}, {8.9, 7.3, 6}},   // in the plane between
        {{0, 3, 10}, {0, 3, 0}},                         // on the side of the box
        {{2.5, 2.5, 11}, {2.5, 2.5, -1}},                // through a vertex of the plane
        {{-1, 5, 6}, {12, 5, 6}},                        // along edges of the plane, from outside to outside
        {{7.5, 1, 8}, {7.5, 1.25, 6}, {7.5, 9, 2}},      // on an edge of the plane
        {{1, 9, 6}, {2, 9, 6 + 1e-8}, {4, 8, 6 - 1e-8}}  // in the plane but for less than the tolerance
    };
    for (std::size_t w = 0; w < paths.size(); ++w) {
        const auto filled = fill({paths[w]});
        ASSERT_TRUE(filled) << filled.why().error.message;
        expect_wells_are_edges(*filled, {paths[w]});
        const bool lies_on_surfaces = w == 0 || w == 1 || w == 3 || w == 5;
        EXPECT_EQ(filled->wells[0].on_surfaces == filled->wells[0].edges.size(), lies_on_surfaces) << w;
    }
    const auto all = fill(paths);
    ASSERT_TRUE(all) << all.why().error.message;
    expect_wells_are_edges(*all, paths);
}

TEST(FillWells, WellsThatMeetHaveAVertexInCommon) {
    const std::vector<std::vector<Vec3>> paths{{{5, 5, 9}, {5, 5, 1}},
                                               {{1, 1.5, 3}, {9, 8.5, 3}},                    // crosses the first one
                                               {{5, 5, 9}, {5, 5, 8}, {7, 6, 3}},             // leaves it on the way
                                               {{5, 5, 2}, {2, 7, 1}},                        // begins on it
                                               {{8, 8, 8}, {8, 8, 8}, {8, 8, 7}, {8, 8, 9}},  // stands still, and goes back
                                               {}};
    const auto filled = fill(paths);
    ASSERT_TRUE(filled) << filled.why().error.message;
    ASSERT_EQ(filled->wells.size(), 6u);
    const auto vertices = [&](std::size_t w) {
        std::set<std::uint32_t> all;
        for (const Ends& e : filled->wells[w].edges) all.insert(e.begin(), e.end());
        return all;
    };
    const auto first = vertices(0);
    for (const std::size_t w : {1u, 2u, 3u}) {
        const auto own = vertices(w);
        EXPECT_TRUE(std::ranges::any_of(own, [&](std::uint32_t v) { return first.contains(v); })) << w;
    }
    EXPECT_NEAR(filled->wells[4].inside, 2, 1e-9);  // each edge once
    EXPECT_EQ(filled->wells[5].edges.size(), 0u);
    const auto edges = cell_edges(filled->brep);
    for (const auto& well : filled->wells) {
        for (const Ends& e : well.edges) EXPECT_TRUE(edges.contains(e)) << well.name;
    }
}

TEST(FillWells, AWellOutsideOfTheModelHasNoEdges) {
    const std::vector<std::vector<Vec3>> paths{{{12, 12, 12}, {12, 12, -5}}, {{5, 5, 12}, {5, 5, 10.5}}};
    const auto filled = fill(paths);
    ASSERT_TRUE(filled) << filled.why().error.message;
    for (const auto& well : filled->wells) {
        EXPECT_TRUE(well.edges.empty());
        EXPECT_EQ(well.inside, 0);
        EXPECT_GT(well.length, 1);
    }
}

TEST(FillWells, RandomWellsAreEdgesOverTheirWholeWayInside) {
    std::mt19937 random(7);
    const auto number = [&](double low, double high) { return low + (high - low) * static_cast<double>(random()) / 4294967296.0; };
    for (int round = 0; round < 12; ++round) {
        std::vector<std::vector<Vec3>> paths(1 + random() % 3);
        for (auto& path : paths) {
            for (std::size_t i = 0; i < 2 + random() % 4; ++i) path.push_back({number(-1, 11), number(-1, 11), number(-1, 11)});
        }
        const auto filled = fill(paths);
        ASSERT_TRUE(filled) << filled.why().error.message;
        expect_wells_are_edges(*filled, paths);
        if (HasFailure()) return;
    }
}

}  // namespace
}  // namespace geomend::volumes
