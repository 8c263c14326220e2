// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/region_volumes.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "topology/face_edges.h"
#include "topology/face_volume.h"
#include "topology/frontiers.h"
#include "topology/line_graph.h"
#include "topology/pieces.h"
#include "topology/regions.h"
#include "topology/side_solver.h"
#include "validators/cell_scope.h"

namespace geomend::validators {

namespace {

/// The cells of all regions over the vertices of the model; \param region_of per cell
CellMesh cells_of_regions(const BrepData& brep, std::vector<std::uint32_t>& region_of) {
    CellMesh mesh;
    mesh.points = brep.vertices;
    const bool has_faces = std::ranges::any_of(brep.regions, [](const auto& r) { return !r.cell_faces.empty(); });
    if (has_faces) {
        mesh.cell_faces.push_back(0);
        mesh.face_offsets.push_back(0);
    }
    std::vector<std::uint32_t> nodes;
    for (std::uint32_t r = 0; r < brep.regions.size(); ++r) {
        const auto& region = brep.regions[r];
        for (std::size_t c = 0; c < region.cell_types.size(); ++c) {
            nodes.clear();
            for (std::uint64_t k = region.cell_offsets[c]; k < region.cell_offsets[c + 1]; ++k) {
                nodes.push_back(region.nodes[region.cell_nodes[k]].value);
            }
            mesh.add_cell(region.cell_types[c], nodes);
            region_of.push_back(r);
            if (region.cell_faces.empty()) continue;
            for (std::uint64_t f = region.cell_faces[c]; f < region.cell_faces[c + 1]; ++f) {
                for (std::uint64_t k = region.face_offsets[f]; k < region.face_offsets[f + 1]; ++k) {
                    mesh.face_nodes.push_back(region.nodes[region.face_nodes[k]].value);
                }
                mesh.face_offsets.push_back(mesh.face_nodes.size());
            }
            mesh.cell_faces.back() = mesh.face_offsets.size() - 1;
        }
    }
    return mesh;
}

using Corners = std::vector<std::uint32_t>;

/// The vertices of each polygon of all surfaces, sorted; the polygons ascend.
std::vector<Corners> polygons_of(const BrepData& brep) {
    std::vector<Corners> polygons;
    for (const auto& surface : brep.surfaces) {
        for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
            Corners corners;
            for (const std::uint32_t node : surface.polygons[p]) corners.push_back(surface.nodes[node].value);
            std::ranges::sort(corners);
            polygons.push_back(std::move(corners));
        }
    }
    std::ranges::sort(polygons);
    return polygons;
}

/// The pieces of all surfaces between lines, and what they part space into.
struct Pieces {
    BrepData parts;
    std::vector<std::uint32_t> source;  ///< per piece its surface
    std::vector<double> cones;
    topology::LineGraph graph;
    topology::FoundRegions found;
};

Pieces pieces_of_model(const ModelScope& scope) {
    const BrepData& brep = scope.brep();
    Pieces pieces;
    BrepData& parts = pieces.parts;
    parts.vertices = brep.vertices;
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        for (auto& piece : topology::pieces_of(brep.surfaces[s], scope.model().faces[s])) {
            piece.surface.lines.clear();
            piece.surface.neighbours.clear();
            parts.surfaces.push_back(std::move(piece.surface));
            pieces.source.push_back(s);
        }
    }
    std::vector<topology::FaceEdges> faces;
    for (auto& part : parts.surfaces) faces.push_back(topology::connect_polygons(part));
    pieces.graph = topology::build_lines(parts, faces, {});
    pieces.cones = topology::cone_volumes(parts, faces);
    std::vector<double> tolerances;
    tolerances.reserve(pieces.source.size());
    for (const std::uint32_t s : pieces.source) tolerances.push_back(s < scope.model().tolerances.size() ? scope.model().tolerances[s] : 0);
    pieces.found = topology::find_regions(parts, pieces.graph, pieces.cones, tolerances);
    return pieces;
}

}  // namespace

bool surfaces_are_whole(const ModelScope& scope) {
    const BrepData& brep = scope.brep();
    std::vector<std::uint32_t> piece_of;
    for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
        if (topology::number_pieces(brep.surfaces[s], scope.model().faces[s], piece_of) > 1) return false;
    }
    return true;
}

std::vector<std::uint8_t> regions_with_bare_facets(const ModelScope& scope) {
    const BrepData& brep = scope.brep();
    std::vector<std::uint8_t> bare(brep.regions.size(), 0);
    std::vector<std::uint32_t> region_of;
    const CellMesh mesh = cells_of_regions(brep, region_of);
    if (region_of.empty()) return bare;
    const CellScope cells(mesh, Lengths{}, {});
    const auto polygons = polygons_of(brep);
    const auto groups = cells.group_first();
    for (std::size_t g = 0; g + 1 < groups.size(); ++g) {
        const auto group = cells.grouped().subspan(groups[g], groups[g + 1] - groups[g]);
        std::set<std::uint32_t> regions;
        for (const std::uint32_t f : group) regions.insert(region_of[cells.faces()[f].cell]);
        if (group.size() > 1 && regions.size() == 1) continue;
        Corners corners;
        for (const std::uint32_t node : cells.nodes_of(cells.faces()[group.front()])) corners.push_back(node);
        std::ranges::sort(corners);
        if (std::ranges::binary_search(polygons, corners)) continue;
        for (const std::uint32_t r : regions) bare[r] = 1;
    }
    return bare;
}

std::vector<RegionVolumes> volumes_of_regions(const ModelScope& scope) {
    const BrepData& brep = scope.brep();
    std::vector<RegionVolumes> volumes(brep.regions.size());
    using Stated = std::pair<std::uint32_t, bool>;  // surface and side
    std::vector<std::set<Stated>> sides(brep.regions.size());
    std::vector<std::uint8_t> listed(brep.surfaces.size(), 0), has_inner(brep.regions.size(), 0);
    std::vector<std::vector<std::uint32_t>> regions_at(2 * brep.surfaces.size());  // per surface and side
    const auto place = [](const Stated& s) { return 2 * std::size_t{s.first} + (s.second ? 1 : 0); };
    for (const auto& side : brep.universe) listed[side.surface.value] = 1;
    for (std::uint32_t r = 0; r < brep.regions.size(); ++r) {
        for (const auto& side : brep.regions[r].sides) {
            sides[r].emplace(side.surface.value, side.front);
            listed[side.surface.value] = 1;
        }
        for (const Stated& s : sides[r]) regions_at[place(s)].push_back(r);
        has_inner[r] = std::ranges::any_of(sides[r], [&](const Stated& s) { return sides[r].contains({s.first, !s.second}); });
    }
    const bool all_listed = std::ranges::find(listed, 0) == listed.end();
    if (all_listed && std::ranges::find(has_inner, 1) == has_inner.end()) return volumes;

    const auto count = [&](const topology::FoundRegions& found, const auto& surface_of) {
        for (const auto& volume : found.regions) {
            std::set<std::uint32_t> unlisted;
            std::set<Stated> stated;
            for (const auto& side : volume) {
                const std::uint32_t s = surface_of(side.surface.value);
                if (listed[s] == 0) unlisted.insert(s);
                else stated.emplace(s, side.front);
            }
            if (stated.empty()) continue;
            for (const std::uint32_t r : regions_at[place(*stated.begin())]) {
                if (!std::ranges::includes(sides[r], stated)) continue;
                ++volumes[r].count;
                volumes[r].unlisted.insert(volumes[r].unlisted.end(), unlisted.begin(), unlisted.end());
            }
        }
    };
    // Surfaces in one piece each part space as they were found to already.
    if (surfaces_are_whole(scope)) {
        count(scope.model().found, [](std::uint32_t s) { return s; });
    } else {
        const Pieces pieces = pieces_of_model(scope);
        count(pieces.found, [&](std::uint32_t piece) { return pieces.source[piece]; });
    }
    for (std::uint32_t r = 0; r < volumes.size(); ++r) {
        auto& [number, unlisted] = volumes[r];
        std::ranges::sort(unlisted);
        unlisted.erase(std::unique(unlisted.begin(), unlisted.end()), unlisted.end());
        if (has_inner[r] == 0 && unlisted.empty()) number = 0;
    }
    return volumes;
}

std::vector<std::uint8_t> surfaces_between_several(const ModelScope& scope) {
    const Pieces pieces = pieces_of_model(scope);
    const auto& [source, found] = std::tie(pieces.source, pieces.found);
    std::vector<std::uint8_t> several(scope.brep().surfaces.size(), 0);
    if (found.region_of_side.empty()) return several;
    using Sides = std::array<std::uint32_t, 2>;
    std::vector<std::optional<Sides>> first(several.size());
    for (std::uint32_t piece = 0; piece < source.size(); ++piece) {
        const Sides sides{found.region_of_side[2 * piece], found.region_of_side[2 * piece + 1]};
        auto& known = first[source[piece]];
        if (known && *known != sides) several[source[piece]] = 1;
        known = sides;
    }
    return several;
}

std::vector<std::optional<CutVolume>> volumes_when_cut(const ModelScope& scope, std::span<const std::uint32_t> surfaces) {
    const Pieces pieces = pieces_of_model(scope);
    std::vector<std::optional<CutVolume>> volumes(surfaces.size());
    if (pieces.found.region_of_side.empty()) return volumes;
    const auto volume_of = [&](std::uint32_t region) {
        CutVolume made{topology::enclosed(pieces.found.regions[region], pieces.cones, pieces.graph).volume, {}};
        for (const auto& side : pieces.found.regions[region]) made.surfaces.push_back(pieces.source[side.surface.value]);
        std::ranges::sort(made.surfaces);
        made.surfaces.erase(std::unique(made.surfaces.begin(), made.surfaces.end()), made.surfaces.end());
        return made;
    };
    for (std::uint32_t piece = 0; piece < pieces.source.size(); ++piece) {
        const auto at = std::ranges::find(surfaces, pieces.source[piece]);
        const std::uint32_t behind = pieces.found.region_of_side[2 * piece], in_front = pieces.found.region_of_side[2 * piece + 1];
        if (at == surfaces.end() || behind == in_front) continue;
        auto& known = volumes[static_cast<std::size_t>(at - surfaces.begin())];
        for (const std::uint32_t region : {behind, in_front}) {
            if (region == no_index) continue;
            CutVolume volume = volume_of(region);
            if (!known || volume.volume < known->volume) known = std::move(volume);
        }
    }
    return volumes;
}

}  // namespace geomend::validators
