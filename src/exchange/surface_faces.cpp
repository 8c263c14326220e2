// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/surface_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <tuple>

#include "base/vectors.h"
#include "model/each_face.h"

namespace geomend::exchange {

namespace {

using Nodes = std::vector<std::uint32_t>;

/// A cycle of places from the lowest on, in the direction that comes to the lower neighbour first.
struct Cycle {
    Nodes places;
    bool turned = false;
};

Cycle cycle_of(Nodes places) {
    std::ranges::rotate(places, std::ranges::min_element(places));
    const bool turned = places.back() < places[1];
    if (turned) std::reverse(places.begin() + 1, places.end());
    return {std::move(places), turned};
}

/// One polygon of a surface, or one face of a cell that lies on it.
struct Polygon {
    Cycle cycle;
    std::uint32_t surface = no_index, number = no_index;
};

struct Match {
    std::uint32_t surface, polygon;
    FaceSide side;  ///< front or back
    CellFaceRef face;
    auto key() const { return std::tie(surface, side, face); }
};

std::vector<Polygon> polygons_of(const BrepData& model, const topology::Welder& places) {
    std::vector<std::uint32_t> place_of;
    for (const Vec3& v : model.vertices) place_of.push_back(places.find(v));
    std::vector<Polygon> all;
    Nodes cycle;
    for (std::uint32_t s = 0; s < model.surfaces.size(); ++s) {
        const auto& surface = model.surfaces[s];
        for (std::uint32_t p = 0; p < surface.polygons.size(); ++p) {
            cycle.clear();
            for (const std::uint32_t node : surface.polygons[p]) cycle.push_back(place_of[surface.nodes[node].value]);
            if (cycle.size() < 3 || std::ranges::find(cycle, no_index) != cycle.end()) continue;
            all.push_back({cycle_of(cycle), s, p});
        }
    }
    std::ranges::sort(all, {}, [](const Polygon& p) { return std::tie(p.cycle.places, p.surface, p.number); });
    return all;
}

/// All faces of cells that are polygons of a surface: by surface, side and face.
std::vector<Match> matches_of(const BrepData& model, const SolidCells& cells) {
    const std::vector<Polygon> polygons = polygons_of(model, cells.places);
    std::vector<std::uint8_t> is_lowest(cells.places.positions().size(), 0);  // of some polygon: most faces are passed over by it
    for (const Polygon& p : polygons) is_lowest[p.cycle.places[0]] = 1;
    std::vector<Match> matches;
    const auto match = [&](const CellFaceRef& face, Nodes& nodes) {
        for (std::uint32_t& n : nodes) n = cells.place_of[n];
        if (is_lowest[*std::ranges::min_element(nodes)] == 0) return;
        const Cycle cycle = cycle_of(nodes);
        for (const Polygon& p :
             std::ranges::equal_range(polygons, cycle.places, {}, [](const Polygon& q) -> const Nodes& { return q.cycle.places; })) {
            // A face is wound outwards: where it agrees with the polygon, its cell lies behind.
            const FaceSide side = p.cycle.turned == cycle.turned ? FaceSide::back : FaceSide::front;
            matches.push_back({p.surface, p.number, side, face});
        }
    };
    for (const VolumeMeshData::Block& block : cells.data.blocks) each_face(cells.data, block, match);
    std::ranges::sort(matches, {}, &Match::key);
    const auto repeated = std::ranges::unique(matches, {}, &Match::key);  // a surface with the same polygon twice
    matches.erase(repeated.begin(), repeated.end());
    return matches;
}

/// The side of a fault that is the hanging wall, front or back; none where the fault is vertical or flat to a thousandth, or where
/// normals cancel out.
FaceSide hanging_side(const BrepData& model, const BrepData::Surface& surface) {
    Vec3 sum{};
    double area = 0;
    for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
        const auto polygon = surface.polygons[p];
        const auto at = [&](std::size_t i) { return model.vertices[surface.nodes[polygon[i]].value]; };
        for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
            const Vec3 n = cross(minus(at(i), at(0)), minus(at(i + 1), at(0)));
            for (std::size_t a = 0; a < 3; ++a) sum[a] += n[a];
            area += std::sqrt(dot(n, n));
        }
    }
    constexpr double least = 1e-3;
    const double length = std::sqrt(dot(sum, sum));
    if (!(length > area / 2) || std::abs(sum[2]) < least * length || std::hypot(sum[0], sum[1]) < least * length) return FaceSide::none;
    return sum[2] > 0 ? FaceSide::front : FaceSide::back;
}

FaceSide named_side(FaceSide side, FaceSide hanging) {
    if (hanging == FaceSide::none) return side;
    return side == hanging ? FaceSide::hanging_wall : FaceSide::footwall;
}

const std::string& name_of(const BrepData& model, const BrepData::Surface& surface) {
    return surface.interface_id.valid() ? model.interfaces[surface.interface_id.value].name : surface.name;
}

std::string suffix(FaceSide side) {
    std::string text = to_string(side);
    std::ranges::replace(text, ' ', '_');
    return "_" + text;
}

/// Names of interfaces that have cells on both sides.
std::set<std::string> two_sided(const BrepData& model, std::span<const Match> matches) {
    std::set<std::string> front, back, both;
    for (const Match& m : matches) (m.side == FaceSide::front ? front : back).insert(name_of(model, model.surfaces[m.surface]));
    std::ranges::set_intersection(front, back, std::inserter(both, both.end()));
    return both;
}

/// Pairs of faces on one polygon whose vertices differ.
void add_split_pairs(std::span<const Match> matches, std::span<const FaceSide> hanging, SolidCells& cells) {
    VolumeMeshData& d = cells.data;
    if (d.vertex_origins.empty()) return;
    const auto key = [](const Match& m) { return std::tie(m.surface, m.polygon, m.side, m.face); };
    std::vector<Match> by_polygon(matches.begin(), matches.end());
    std::ranges::sort(by_polygon, [&](const Match& a, const Match& b) { return key(a) < key(b); });
    const auto nodes_of = [&](const CellFaceRef& ref) {
        const CellType type = std::prev(std::ranges::upper_bound(d.blocks, ref.cell, {}, &VolumeMeshData::Block::first))->type;
        Nodes nodes;
        if (type == CellType::polyhedron) {
            const std::uint64_t f = d.cell_faces[ref.cell] + ref.face;
            for (std::uint64_t k = d.face_offsets[f]; k < d.face_offsets[f + 1]; ++k) nodes.push_back(d.face_nodes[k]);
        } else {
            for (const std::uint8_t corner : faces_of(type)[ref.face].corners()) nodes.push_back(d.nodes_of(ref.cell)[corner]);
        }
        std::ranges::sort(nodes);
        return nodes;
    };
    std::set<std::array<CellFaceRef, 2>> known;  // where two surfaces have the same polygon
    for (std::size_t i = 1; i < by_polygon.size(); ++i) {
        const Match &front = by_polygon[i - 1], &back = by_polygon[i];  // FaceSide::front comes first
        if (front.surface != back.surface || front.polygon != back.polygon || front.side == back.side) continue;
        if (nodes_of(front.face) == nodes_of(back.face)) continue;
        if (!known.insert({std::min(front.face, back.face), std::max(front.face, back.face)}).second) continue;
        const FaceSide h = hanging[front.surface];
        d.split_pairs.push_back({{front.face, back.face}, {named_side(front.side, h), named_side(back.side, h)}});
    }
}

/// Polygons of a surface that are no face of a cell on any side.
void list_unmatched(const BrepData& model, std::span<const Match> matches, std::vector<Loss>& losses) {
    std::vector<std::vector<std::uint8_t>> found;
    for (const auto& surface : model.surfaces) found.emplace_back(surface.polygons.size(), 0);
    for (const Match& m : matches) found[m.surface][m.polygon] = 1;
    for (std::size_t s = 0; s < found.size(); ++s) {
        const auto missing = static_cast<std::uint64_t>(std::ranges::count(found[s], 0));
        if (missing == 0) continue;
        const bool all = missing == found[s].size();
        add_loss(losses, {LossClass::substance, name_of(model, model.surfaces[s]), all ? "surface" : "polygons",
                          all ? "it is no face of any cell" : "they are no faces of cells", all ? 1 : missing});
    }
}

}  // namespace

void add_surface_faces(const BrepData& model, SolidCells& cells, std::vector<Loss>& losses) {
    VolumeMeshData& d = cells.data;
    const std::vector<Match> matches = matches_of(model, cells);
    const std::set<std::string> both = two_sided(model, matches);
    std::vector<FaceSide> hanging;
    for (const auto& surface : model.surfaces) {
        d.surfaces.push_back(name_of(model, surface));
        hanging.push_back(surface.role == FeatureRole::fault ? hanging_side(model, surface) : FaceSide::none);
    }
    for (std::size_t i = 0; i < matches.size(); ++i) {
        const Match& m = matches[i];
        if (i == 0 || matches[i - 1].surface != m.surface || matches[i - 1].side != m.side) {
            const FaceSide side = named_side(m.side, hanging[m.surface]);
            const std::string& name = d.surfaces[m.surface];
            d.face_sets.push_back({both.contains(name) ? name + suffix(side) : name, model.surfaces[m.surface].role, side, m.surface, {}});
        }
        d.face_sets.back().faces.push_back(m.face);
    }
    add_split_pairs(matches, hanging, cells);
    list_unmatched(model, matches, losses);
}

}  // namespace geomend::exchange
