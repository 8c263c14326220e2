// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/assemble.h"

#include <algorithm>
#include <map>

#include "base/parallel.h"
#include "topology/cut_nodes.h"
#include "topology/face_volume.h"
#include "topology/geology.h"
#include "topology/pieces.h"
#include "topology/regions.h"
#include "topology/regions_of_complex.h"
#include "topology/winding.h"

namespace geomend::topology {

namespace {

void join_polygons(Assembly& a) {
    a.faces.resize(a.brep.surfaces.size());
    parallel_for_each_index(a.faces.size(), [&](std::size_t s) { a.faces[s] = connect_polygons(a.brep.surfaces[s]); });
}

void take_geometry(SurfaceComplex& complex, Assembly& a) {
    a.brep.name = std::move(complex.name);
    a.brep.crs = std::move(complex.crs);
    a.brep.annotations = std::move(complex.annotations);
    a.brep.vertices = std::move(complex.vertices);
    a.findings = std::move(complex.findings);
    a.brep.surfaces.reserve(complex.faces.size());
    for (auto& face : complex.faces) a.brep.surfaces.push_back(std::move(face.surface));
    join_polygons(a);
}

/// A surface for each piece that hangs together between lines. False where all are in one piece as they are.
bool split_into_pieces(SurfaceComplex& complex, Assembly& a) {
    std::vector<SurfaceComplex::Face> faces;
    std::vector<BrepData::Surface> surfaces;
    for (std::size_t f = 0; f < complex.faces.size(); ++f) {
        for (auto& piece : pieces_of(a.brep.surfaces[f], a.faces[f])) {
            faces.push_back(complex.faces[f]);
            auto& numbers = faces.back().source_polygons;
            if (const auto& known = complex.faces[f].source_polygons; !known.empty()) {
                for (std::uint32_t& p : piece.polygons) p = known[p];
            }
            numbers = std::move(piece.polygons);
            surfaces.push_back(std::move(piece.surface));
        }
    }
    if (surfaces.size() == complex.faces.size()) return false;
    complex.faces = std::move(faces);
    a.brep.surfaces = std::move(surfaces);
    join_polygons(a);
    return true;
}

/// Polygons that are wound against their neighbours are turned over, so that each side of a surface is one side.
/// \return per surface the turned ones; empty: none anywhere
std::vector<std::vector<std::uint32_t>> turn_over(Assembly& a) {
    auto& surfaces = a.brep.surfaces;
    std::vector<Winding> winding(surfaces.size());
    parallel_for_each_index(surfaces.size(), [&](std::size_t s) { winding[s] = winding_of(surfaces[s]); });
    const auto wrong = [](const Winding& w) { return !w.one_sided && !w.wrong.empty(); };
    if (std::ranges::none_of(winding, wrong)) return {};
    std::vector<std::vector<std::uint32_t>> turned(surfaces.size());
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        if (!wrong(winding[s])) continue;
        for (const std::uint32_t p : winding[s].wrong) turn_polygon(surfaces[s], p);
        turned[s] = std::move(winding[s].wrong);
    }
    join_polygons(a);
    return turned;
}

void make_lines_anew(const SurfaceComplex& complex, Assembly& a) {
    for (auto& surface : a.brep.surfaces) surface.lines.clear();
    a.brep.lines.clear();
    a.brep.corners.clear();
    a.graph = build_lines(a.brep, a.faces, complex.lines);
}

void name_corners(const SurfaceComplex& complex, BrepData& brep) {
    std::map<std::uint32_t, const std::string*> names;
    for (const auto& corner : complex.corner_names) names.emplace(corner.vertex, &corner.name);
    for (auto& corner : brep.corners) {
        if (const auto found = names.find(corner.vertex.value); found != names.end()) corner.name = *found->second;
    }
}

void name_lines(const SurfaceComplex& complex, Assembly& a) {
    if (complex.line_names.empty()) return;
    for (std::size_t l = 0; l < a.brep.lines.size(); ++l) {
        if (a.graph.stated_line[l] != no_index) a.brep.lines[l].name = complex.line_names[a.graph.stated_line[l]];
    }
}

/// Per line whether the polygons of one surface at each of its edges use the same nodes.
std::vector<std::uint8_t> lines_with_shared_nodes(const Assembly& a) {
    std::vector<PolygonEdges> edges_of;
    for (const auto& surface : a.brep.surfaces) edges_of.emplace_back(surface.polygons);
    std::vector<std::uint8_t> joined(a.brep.lines.size(), 1);
    std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> nodes;  // per surface
    for (const auto& edge : a.graph.edges) {
        nodes.clear();
        for (const EdgeUse& use : a.graph.edge_uses(edge)) {
            if (use.surface == no_index) continue;
            const auto& edges = edges_of[use.surface];
            const std::pair<std::uint32_t, std::uint32_t> here = std::minmax({edges.start_node(use.corner), edges.end_node(use.corner)});
            if (nodes.emplace(use.surface, here).first->second != here) joined[edge.line] = 0;
        }
    }
    return joined;
}

/// Per line whether it is one that is stated inside of a single surface, whose polygons use the same nodes on both sides of it.
std::vector<std::uint8_t> embedded_lines(const Assembly& a) {
    std::vector<std::uint32_t> owner(a.brep.lines.size(), no_index), uses(a.brep.lines.size(), 0);
    std::vector<std::uint8_t> embedded = a.joined_lines;
    for (std::uint32_t s = 0; s < a.brep.surfaces.size(); ++s) {
        for (const auto& use : a.brep.surfaces[s].lines) {
            const std::uint32_t l = use.line.value;
            if (owner[l] != no_index && owner[l] != s) embedded[l] = 0;
            owner[l] = s;
            ++uses[l];
        }
    }
    for (std::size_t l = 0; l < embedded.size(); ++l) {
        if (uses[l] != 2 || a.graph.stated_line[l] == no_index) embedded[l] = 0;
    }
    return embedded;
}

/// Lines and corners. Gives the polygons that were turned over, per surface: where the complex is taken apart, and where it is to be
/// judged, since a polygon that is wound wrongly is no reason to take a side of its surface for the other one.
std::vector<std::vector<std::uint32_t>> make_lines(SurfaceComplex& complex, RegionSearch search, Assembly& a) {
    a.graph = build_lines(a.brep, a.faces, complex.lines);
    const bool apart = complex.take_apart && split_into_pieces(complex, a);
    std::vector<std::vector<std::uint32_t>> turned;
    if (complex.take_apart || search == RegionSearch::always) turned = turn_over(a);
    if (apart || !turned.empty()) make_lines_anew(complex, a);
    name_corners(complex, a.brep);
    name_lines(complex, a);
    a.joined_lines = lines_with_shared_nodes(a);
    const auto embedded = embedded_lines(a);
    for (std::size_t f = 0; f < complex.faces.size(); ++f) {
        if (complex.faces[f].shared_nodes) split_nodes_along_cuts(a.brep, embedded, a.brep.surfaces[f]);
    }
    return turned;
}

void make_interfaces(const SurfaceComplex& complex, BrepData& brep) {
    InterfaceBook book(brep);
    for (std::uint32_t f = 0; f < complex.faces.size(); ++f) book.enter(SurfaceId(f), complex.faces[f].interface_name);
    for (const auto& said : complex.interfaces) {
        const InterfaceId found = book.find(said.name);
        if (!found.valid()) continue;
        brep.interfaces[found.value].feature = said.feature;
        brep.interfaces[found.value].annotations = said.annotations;
    }
    name_surfaces(brep);
}

void make_features(const SurfaceComplex& complex, BrepData& brep) {
    for (const auto& feature : complex.features) {
        BrepData::Feature made{feature.name, {}};
        for (const std::uint32_t f : feature.faces) {
            made.surfaces.emplace_back(f);
            auto& interface = brep.interfaces[brep.surfaces[f].interface_id.value];
            if (interface.feature.empty()) interface.feature = feature.name;
        }
        brep.features.push_back(std::move(made));
    }
}

}  // namespace

Result<JudgedModel> assemble(SurfaceComplex complex, RegionSearch search) {
    Assembly a;
    take_geometry(complex, a);
    auto turned = make_lines(complex, search, a);
    for (const auto& face : complex.faces) a.tolerances.push_back(face.tolerance);
    make_interfaces(complex, a.brep);
    make_regions(complex, a);
    if (search == RegionSearch::where_none_are_stated) report_wrong_sides(a);
    make_contacts(a.brep);
    count_internal_lines(a.brep);
    make_features(complex, a.brep);
    const bool found = !a.found.region_of_side.empty() || a.brep.surfaces.empty();
    if (!found && search == RegionSearch::always) a.found = find_regions(a.brep, a.graph, a.cones, a.tolerances);
    std::vector<std::vector<std::uint32_t>> source_polygons;
    std::vector<std::uint64_t> first_polygon;
    const bool apart = std::ranges::any_of(complex.faces, [](const auto& face) { return !face.source_polygons.empty(); });
    for (auto& face : complex.faces) {
        first_polygon.push_back(face.first_polygon);
        if (apart) source_polygons.push_back(std::move(face.source_polygons));
    }
    auto brep = Brep::make(std::move(a.brep));
    if (!brep) return std::move(brep).why();
    const double tolerance = a.tolerances.empty() ? 0 : std::ranges::max(a.tolerances);
    return JudgedModel{std::move(brep).value(),
                       std::move(a.faces),
                       std::move(a.graph),
                       std::move(a.found),
                       complex.stated,
                       !found,
                       tolerance,
                       std::move(a.tolerances),
                       complex.points_welded,
                       std::move(complex.welded_positions),
                       std::move(source_polygons),
                       std::move(turned),
                       std::move(first_polygon),
                       std::move(a.findings),
                       std::move(a.claims),
                       std::move(a.joined_lines)};
}

}  // namespace geomend::topology
