// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/surface_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "base/vectors.h"
#include "judged_model.h"
#include "model/attribute.h"
#include "support/temporary_folder.h"
#include "volume/fill.h"

// Surfaces get vertices where cells cannot be made without them; their shape and their values stay.

namespace geomend::volumes {
namespace {

using test::model_of;

/// A prism whose top is turned by 30 degrees, its sides folded inwards: no tetrahedra over its six corners fill it (E. Schoenhardt, 1928).
Surface turned_prism() {
    Surface prism;
    prism.info.name = "prism";
    prism.info.role = FeatureRole::boundary;
    for (const double turn : {0.0, 30.0}) {
        for (int i = 0; i < 3; ++i) {
            const double angle = (120 * i + turn) * std::numbers::pi / 180;
            prism.points.push_back({std::cos(angle), std::sin(angle), turn > 0 ? 1.0 : 0.0});
        }
    }
    prism.polygons.corners = {0, 2, 1, 3, 4, 5};
    for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t j = (i + 1) % 3;
        prism.polygons.corners.insert(prism.polygons.corners.end(), {i, j, 3 + j, i, 3 + j, 3 + i});
    }
    Attribute height;
    height.name = "linear";
    height.location = AttributeLocation::point;
    std::vector<double> values;
    for (const Vec3& p : prism.points) values.push_back(p[0] + 2 * p[1] + 3 * p[2]);
    height.values = values;
    prism.info.attributes.push_back(height);
    return prism;
}

double area_of(const BrepData& brep, const BrepData::Surface& surface) {
    double area = 0;
    for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
        const auto t = surface.polygons[p];
        const auto at = [&](std::size_t k) { return brep.vertices[surface.nodes[t[k]].value]; };
        const Vec3 n = cross(minus(at(1), at(0)), minus(at(2), at(0)));
        area += 0.5 * std::sqrt(dot(n, n));
    }
    return area;
}

/// Each neighbour lies across the same edge, and is a neighbour back.
void expect_neighbours_agree(const BrepData::Surface& surface) {
    for (std::uint32_t p = 0; p < surface.polygons.size(); ++p) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t q = surface.neighbours[3 * p + k];
            if (q == no_index) continue;
            const std::uint32_t a = surface.polygons[p][k], b = surface.polygons[p][(k + 1) % 3];
            bool back = false;
            for (std::uint32_t m = 0; m < 3; ++m)
                back |= surface.polygons[q][m] == b && surface.polygons[q][(m + 1) % 3] == a && surface.neighbours[3 * q + m] == p;
            EXPECT_TRUE(back) << "polygon " << p << ", edge " << k;
        }
    }
}

TEST(SurfacePoints, NewVerticesOnFacetsThatAreNoFacesAreFoundOnEdgesAndInside) {
    RegionFacets facets;
    facets.vertices = {10, 11, 12, 13};
    facets.positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
    facets.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    facets.sides.assign(4, behind);
    facets.surfaces = {0, 1, 2, 3};
    Tetrahedra whole;
    whole.cells = {{0, 1, 2, 3}};
    EXPECT_EQ(points_on_facets(facets, whole).size(), 0u);
    Tetrahedra inside;  // a point in the first facet, and one that is on none
    inside.new_vertices = {{1, 1, 0}, {1, 1, 1}};
    inside.cells = {{4, 0, 1, 3}, {4, 1, 2, 3}, {4, 2, 0, 3}};
    const SurfacePoints one = points_on_facets(facets, inside);
    ASSERT_EQ(one.inside.size(), 1u);
    EXPECT_EQ(one.on_edges.size(), 0u);
    EXPECT_EQ(one.inside[0].surface, 0u);
    EXPECT_EQ(one.inside[0].corners, (Triangle{10, 12, 11}));
    Tetrahedra edge;  // a point on the edge between the first two facets
    edge.new_vertices = {{1, 0, 0}};
    edge.cells = {{0, 4, 2, 3}, {4, 1, 2, 3}};
    const SurfacePoints other = points_on_facets(facets, edge);
    ASSERT_EQ(other.on_edges.size(), 1u);
    EXPECT_EQ(other.inside.size(), 0u);
    EXPECT_EQ(other.on_edges[0].ends, (std::array<std::uint32_t, 2>{10, 11}));
}

TEST(SurfacePoints, AreVerticesOfSurfacesAndLinesWithoutAChangeOfShape) {
    // A sheet that ends inside of the prism: its border is a line.
    Surface sheet;
    sheet.info.name = "sheet";
    sheet.points = {{-0.1, -0.1, 0.4}, {0.1, -0.1, 0.4}, {0, 0.1, 0.6}};
    sheet.polygons.corners = {0, 1, 2};
    const auto model = model_of({turned_prism(), sheet});
    const BrepData& brep = *model.brep;
    const auto vertex_at = [&](const Vec3& p) {
        return static_cast<std::uint32_t>(std::ranges::find(brep.vertices, p) - brep.vertices.begin());
    };
    const std::uint32_t a = vertex_at({-0.1, -0.1, 0.4}), b = vertex_at({0.1, -0.1, 0.4});
    ASSERT_LT(std::max(a, b), brep.vertices.size());
    SurfacePoints points;
    const Vec3 quarter{-0.05, -0.1, 0.4}, middle{0, -0.1, 0.4};
    points.on_edges = {{{std::min(a, b), std::max(a, b)}, middle}, {{std::min(a, b), std::max(a, b)}, quarter}};
    // An edge between two triangles of the prism, and a point inside of one of them.
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        const auto& surface = brep.surfaces[s];
        if (surface.name.find("prism") == std::string::npos) continue;
        const auto t = surface.polygons[3];
        const Triangle corners{surface.nodes[t[0]].value, surface.nodes[t[1]].value, surface.nodes[t[2]].value};
        const auto place = [&](std::size_t k) { return brep.vertices[corners[k]]; };
        points.inside.push_back({s, corners, times(1.0 / 3, plus(place(0), plus(place(1), place(2))))});
        points.on_edges.push_back(
            {{std::min(corners[0], corners[1]), std::max(corners[0], corners[1])}, times(0.5, plus(place(0), place(1)))});
        break;
    }
    ASSERT_EQ(points.inside.size(), 1u);
    const BrepData made = with_points(brep, points);
    ASSERT_TRUE(Brep::make(made));
    EXPECT_EQ(made.vertices.size(), brep.vertices.size() + 4);
    std::size_t before = 0, after = 0;
    for (std::size_t s = 0; s < brep.surfaces.size(); ++s) {
        EXPECT_NEAR(area_of(made, made.surfaces[s]), area_of(brep, brep.surfaces[s]), 1e-14);
        expect_neighbours_agree(made.surfaces[s]);
        before += brep.surfaces[s].polygons.size();
        after += made.surfaces[s].polygons.size();
        for (const Attribute& attribute : made.surfaces[s].attributes) {
            if (attribute.name != "linear") continue;
            const auto& values = std::get<std::vector<double>>(attribute.values);
            for (std::size_t n = 0; n < values.size(); ++n) {
                const Vec3& p = made.vertices[made.surfaces[s].nodes[n].value];
                EXPECT_NEAR(values[n], p[0] + 2 * p[1] + 3 * p[2], 1e-14);
            }
        }
    }
    EXPECT_EQ(after, before + 2 + 2 + 2) << "two points on one border, one on an edge of two triangles, one inside";
    bool on_line = false;
    for (const auto& line : made.lines)
        for (std::size_t i = 2; i < line.vertices.size(); ++i)
            on_line |= made.vertices[line.vertices[i - 1].value] == quarter &&
                       (made.vertices[line.vertices[i].value] == middle || made.vertices[line.vertices[i - 2].value] == middle);
    EXPECT_TRUE(on_line);
    const auto facets = facets_of_regions(made, model.found), known = facets_of_regions(model);
    ASSERT_TRUE(facets && known);
    EXPECT_NEAR((*facets)[0].volume, (*known)[0].volume, 1e-14);
}

TEST(SurfacePoints, ARegionThatCannotBeFilledOverItsTrianglesIsFilledOverPartsOfThem) {
    // A child that refuses to leave the prism's own triangles whole.
    const test::TemporaryFolder folder;
    const std::size_t question = (3 + 3 * 2) * sizeof(std::uint64_t) + 6 * sizeof(Vec3) + 8 * sizeof(Triangle);  // head and three messages
    test::write_file(folder / "child", "case \"$2\" in *Y*) [ $(wc -c < \"$5\") -gt " + std::to_string(question) +
                                           " ] || exit 1;; esac\nexec " GEOMEND_PROGRAM " \"$@\"\n");
    const auto model = model_of({turned_prism()});
    FillOptions options;
    options.limits.program = {"/bin/sh", (folder / "child").string()};
    const auto whole = fill_regions(model, options);
    ASSERT_TRUE(whole);
    ASSERT_FALSE(whole->regions[0].filled());
    const auto filled = fill_dividing_surfaces(*model.brep, model.found, options);
    ASSERT_TRUE(filled);
    ASSERT_TRUE(filled->regions[0].filled());
    EXPECT_GT(filled->surface_vertices, 0u);
    EXPECT_NEAR(filled->regions[0].volume, whole->regions[0].surface_volume, 1e-12);
    EXPECT_FALSE(filled->regions[0].why_not.empty()) << "what was tried before";
    EXPECT_TRUE(Brep::make(filled->brep));
    options.limits.program = {"/bin/false"};
    const auto never = fill_dividing_surfaces(*model.brep, model.found, options);
    ASSERT_TRUE(never);
    EXPECT_FALSE(never->regions[0].filled());
    EXPECT_EQ(never->surface_vertices, 0u);
}

}  // namespace
}  // namespace geomend::volumes
