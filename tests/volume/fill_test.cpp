// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/fill.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "judged_model.h"

// Boxes put together in the test are filled by the program's own child process.

namespace geomend::volumes {
namespace {

using test::model_of;

// A quadrangle of two triangles.
using Quad = std::array<Vec3, 4>;

void add_quad(Surface& surface, const Quad& quad) {
    const auto first = static_cast<std::uint32_t>(surface.points.size());
    surface.points.insert(surface.points.end(), quad.begin(), quad.end());
    surface.polygons.push_back(std::array<std::uint32_t, 3>{first, first + 1, first + 2});
    surface.polygons.push_back(std::array<std::uint32_t, 3>{first, first + 2, first + 3});
}

void add_box(Surface& surface, const Vec3& l, const Vec3& h) {
    add_quad(surface, {{{l[0], l[1], l[2]}, {l[0], h[1], l[2]}, {h[0], h[1], l[2]}, {h[0], l[1], l[2]}}});
    add_quad(surface, {{{l[0], l[1], h[2]}, {h[0], l[1], h[2]}, {h[0], h[1], h[2]}, {l[0], h[1], h[2]}}});
    add_quad(surface, {{{l[0], l[1], l[2]}, {h[0], l[1], l[2]}, {h[0], l[1], h[2]}, {l[0], l[1], h[2]}}});
    add_quad(surface, {{{l[0], h[1], l[2]}, {l[0], h[1], h[2]}, {h[0], h[1], h[2]}, {h[0], h[1], l[2]}}});
    add_quad(surface, {{{l[0], l[1], l[2]}, {l[0], l[1], h[2]}, {l[0], h[1], h[2]}, {l[0], h[1], l[2]}}});
    add_quad(surface, {{{h[0], l[1], l[2]}, {h[0], h[1], l[2]}, {h[0], h[1], h[2]}, {h[0], l[1], h[2]}}});
}

Surface named(const std::string& name, FeatureRole role) {
    Surface surface;
    surface.info.name = name;
    surface.info.role = role;
    return surface;
}

FillOptions options() {
    FillOptions o;
    o.limits.program = {GEOMEND_PROGRAM};
    return o;
}

/// How many cells have each triangle of a filled model as a face, over vertices of the model.
std::map<std::array<std::uint32_t, 3>, int> cells_at_faces(const BrepData& brep) {
    std::map<std::array<std::uint32_t, 3>, int> faces;
    for (const auto& region : brep.regions) {
        for (std::size_t c = 0; c < region.cell_types.size(); ++c) {
            for (std::size_t k = 0; k < 4; ++k) {
                std::array<std::uint32_t, 3> face{};
                for (std::size_t m = 0; m < 3; ++m) face[m] = region.nodes[region.cell_nodes[4 * c + (k + 1 + m) % 4]].value;
                std::ranges::sort(face);
                ++faces[face];
            }
        }
    }
    return faces;
}

void expect_triangles_are_faces(const BrepData& brep, const std::string& surface, int cells) {
    const auto faces = cells_at_faces(brep);
    std::size_t seen = 0;
    for (const auto& s : brep.surfaces) {
        if (s.name.find(surface) == std::string::npos) continue;
        for (std::size_t p = 0; p < s.polygons.size(); ++p) {
            const auto t = s.polygons[p];
            std::array<std::uint32_t, 3> face{s.nodes[t[0]].value, s.nodes[t[1]].value, s.nodes[t[2]].value};
            std::ranges::sort(face);
            const auto at = faces.find(face);
            EXPECT_EQ(at == faces.end() ? 0 : at->second, cells) << s.name;
            ++seen;
        }
    }
    EXPECT_GT(seen, 0u) << surface;
}

TEST(Fill, ABoxIsFilledToItsVolumeWhereverItLies) {
    for (const Vec3& at : {Vec3{0, 0, 0}, Vec3{512345.25, 6123456.5, -3000}}) {
        Surface box = named("box", FeatureRole::boundary);
        add_box(box, at, {at[0] + 10, at[1] + 20, at[2] + 5});
        const auto filled = fill_regions(model_of({box}), options());
        ASSERT_TRUE(filled) << filled.why().error.message;
        ASSERT_EQ(filled->regions.size(), 1u);
        ASSERT_TRUE(filled->regions[0].filled()) << filled->regions[0].why_not.front();
        EXPECT_NEAR(filled->regions[0].volume, 1000, 1e-6);
        EXPECT_GT(filled->regions[0].least_dihedral, 5);
        expect_triangles_are_faces(filled->brep, "box", 1);
    }
}

/// A cube with an edge of 10 and n x n quadrangles on each of its sides.
Surface fine_cube(int n) {
    Surface cube = named("cube", FeatureRole::boundary);
    const double step = 10.0 / n;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const double at : {0.0, 10.0}) {
            for (int i = 0; i < n; ++i) {
                for (int j = 0; j < n; ++j) {
                    Quad quad{};
                    for (std::size_t k = 0; k < 4; ++k) {
                        const std::array<int, 4> di{0, 1, 1, 0}, dj{0, 0, 1, 1};
                        quad[k][axis] = at;
                        quad[k][(axis + 1) % 3] = step * (i + di[k]);
                        quad[k][(axis + 2) % 3] = step * (j + dj[k]);
                    }
                    if (at == 0) std::swap(quad[1], quad[3]);
                    add_quad(cube, quad);
                }
            }
        }
    }
    return cube;
}

TEST(Fill, ASmallerSizeMakesMoreCells) {
    const auto model = model_of({fine_cube(8)});
    FillOptions coarse = options(), fine = options();
    coarse.size = 5;
    fine.size = 1;
    const auto few = fill_regions(model, coarse), many = fill_regions(model, fine);
    ASSERT_TRUE(few && many);
    ASSERT_TRUE(few->regions[0].filled() && many->regions[0].filled());
    EXPECT_GT(many->regions[0].cells, 2 * few->regions[0].cells);
    EXPECT_NEAR(few->regions[0].volume, 1000, 1e-6);
    EXPECT_NEAR(many->regions[0].volume, 1000, 1e-6);
    EXPECT_EQ(fill_regions(model, options())->regions[0].rung, "tetgen pYqa");
}

/// The lengths of edges of cells with both ends inside of the only region of a filled cube.
std::vector<double> lengths_inside(const BrepData& brep) {
    const BrepData::Region& region = brep.regions[0];
    const auto at = [&](std::uint32_t node) { return brep.vertices[region.nodes[node].value]; };
    const auto is_inside = [&](const Vec3& p) { return std::ranges::all_of(p, [](double x) { return x > 0 && x < 10; }); };
    std::set<std::array<std::uint32_t, 2>> edges;
    std::vector<double> lengths;
    for (std::size_t c = 0; c < region.cell_types.size(); ++c) {
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = i + 1; j < 4; ++j) {
                const std::uint32_t a = region.cell_nodes[4 * c + i], b = region.cell_nodes[4 * c + j];
                const Vec3 p = at(a), q = at(b);
                if (!edges.insert({std::min(a, b), std::max(a, b)}).second || !is_inside(p) || !is_inside(q)) continue;
                lengths.push_back(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
            }
        }
    }
    return lengths;
}

TEST(Fill, EdgesInsideAreMostlyAsLongAsTheSize) {
    for (const int n : {10, 14}) {
        FillOptions how = options();
        how.size = 10.0 / n;
        const auto filled = fill_regions(model_of({fine_cube(n)}), how);
        ASSERT_TRUE(filled && filled->regions[0].filled());
        auto lengths = lengths_inside(filled->brep);
        ASSERT_GT(lengths.size(), 300u);
        std::ranges::sort(lengths);
        EXPECT_NEAR(lengths[lengths.size() / 2] / how.size, 1.0, 0.08) << n;
    }
}

TEST(Fill, PointsThatAreAskedForAreVerticesOfCells) {
    std::vector<Vec3> asked;
    for (int i = 1; i < 8; ++i) {
        for (int j = 1; j < 8; ++j) {
            for (int k = 1; k < 8; ++k) asked.push_back({1.25 * i + 1e-5 * (i * j % 3), 1.25 * j + 1e-5 * (j * k % 5), 1.25 * k});
        }
    }
    FillOptions o = options();
    o.improve = false;
    o.points = [&](const RegionFacets&) { return asked; };
    const auto filled = fill_regions(model_of({fine_cube(8)}), o);
    ASSERT_TRUE(filled && filled->regions[0].filled());
    EXPECT_TRUE(filled->regions[0].as_asked);
    EXPECT_GE(filled->regions[0].new_vertices, asked.size());
    EXPECT_NEAR(filled->regions[0].volume, 1000, 1e-6);
    std::set<Vec3> vertices;
    for (const Vec3& p : filled->brep.vertices) vertices.insert(p);
    EXPECT_TRUE(std::ranges::all_of(asked, [&](const Vec3& p) { return vertices.contains(p); }));
}

TEST(Fill, AFaultThatEndsInsideIsAFaceOfCellsOnBothSides) {
    Surface box = named("box", FeatureRole::boundary), fault = named("fault", FeatureRole::fault);
    add_box(box, {0, 0, 0}, {10, 10, 10});
    add_quad(fault, {{{5, 2, 2}, {5, 8, 2}, {6, 8, 8}, {6, 2, 8}}});
    const auto filled = fill_regions(model_of({box, fault}), options());
    ASSERT_TRUE(filled) << filled.why().error.message;
    ASSERT_TRUE(filled->regions.size() == 1 && filled->regions[0].filled());
    EXPECT_NEAR(filled->regions[0].volume, 1000, 1e-6);
    expect_triangles_are_faces(filled->brep, "fault", 2);
    expect_triangles_are_faces(filled->brep, "box", 1);
}

TEST(Fill, ARegionAroundAnotherOneIsFilledUpToIt) {
    Surface outer = named("outer", FeatureRole::boundary), inner = named("inner", FeatureRole::horizon);
    add_box(outer, {0, 0, 0}, {10, 10, 10});
    add_box(inner, {3, 3, 3}, {6, 7, 8});
    const auto filled = fill_regions(model_of({outer, inner}), options());
    ASSERT_TRUE(filled) << filled.why().error.message;
    ASSERT_EQ(filled->regions.size(), 2u);
    std::multiset<int> volumes;
    for (const auto& r : filled->regions) {
        ASSERT_TRUE(r.filled());
        volumes.insert(static_cast<int>(std::lround(r.volume)));
    }
    EXPECT_EQ(volumes, (std::multiset<int>{60, 940}));
    expect_triangles_are_faces(filled->brep, "inner", 2);
}

TEST(Fill, WhatTheChildDoesWrongIsToldOfItsRegion) {
    Surface box = named("box", FeatureRole::boundary);
    add_box(box, {0, 0, 0}, {10, 10, 10});
    const auto model = model_of({box});
    FillOptions o = options();
    for (const std::vector<std::string>& program :
         {std::vector<std::string>{"/bin/false"}, {"/bin/echo", "this is no answer"}, {GEOMEND_MISBEHAVING, "crash"}}) {
        o.limits.program = program;
        const auto filled = fill_regions(model, o);
        ASSERT_TRUE(filled);
        EXPECT_FALSE(filled->regions[0].filled());
        EXPECT_FALSE(filled->regions[0].why_not.empty());
        EXPECT_TRUE(filled->brep.regions[0].cell_types.empty());
    }
    o = options();
    o.size = 0.05;
    o.limits.seconds = 0.1;
    const auto slow = fill_regions(model_of({fine_cube(20)}), o);
    ASSERT_TRUE(slow);
    ASSERT_FALSE(slow->regions[0].why_not.empty());
    EXPECT_NE(slow->regions[0].why_not[0].find("did not end"), std::string::npos) << slow->regions[0].why_not[0];
}

TEST(Fill, AnOpenBoxHasNothingToFill) {
    Surface box = named("box", FeatureRole::boundary);
    add_box(box, {0, 0, 0}, {10, 10, 10});
    box.polygons.corners.resize(box.polygons.corners.size() - 3);
    const auto filled = fill_regions(model_of({box}), options());
    ASSERT_FALSE(filled);
    EXPECT_EQ(filled.why().error.code, "F026");
}

}  // namespace
}  // namespace geomend::volumes
