// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/split_sides.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/vec3.h"
#include "model/face_corners.h"

namespace geomend {

namespace {

struct PlaceHash {
    std::size_t operator()(const Vec3& p) const {
        std::size_t hash = 0;
        for (const double x : p) hash = (hash ^ std::hash<double>()(x)) * 0x9e3779b97f4a7c15u;
        return hash ^ hash >> 32;
    }
};

/// Faces of entities, by number.
std::vector<std::uint32_t> faces_of_entities(const CellMesh& mesh) {
    std::vector<std::uint32_t> faces;
    for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
        if (dimension(mesh.types[c]) == 2 && mesh.cell_entity[c] < mesh.entities.size()) faces.push_back(c);
    }
    return faces;
}

using Pair = std::array<std::uint32_t, 2>;  // cells

/// Which of two faces gives its surface the name where one is on the other side of the other: the same whatever their order.
auto rank_of(const CellMesh& mesh, std::uint32_t face) {
    const std::uint32_t e = mesh.cell_entity[face];
    return std::tuple(std::string_view(mesh.entities[e].name), mesh.entities[e].tag, face);
}

struct PlacedFace {
    FaceCorners places, nodes;
    std::uint32_t entity, cell;
    auto operator<=>(const PlacedFace&) const = default;
};

/// Faces sorted by their places, then by their nodes.
std::vector<PlacedFace> placed_faces(const CellMesh& mesh, std::span<const std::uint32_t> faces, std::span<const std::uint32_t> first) {
    std::vector<PlacedFace> placed;
    for (const std::uint32_t c : faces) {
        const FaceCorners nodes = face_corners(mesh, c);
        placed.push_back({face_places(nodes, first), nodes, mesh.cell_entity[c], c});
    }
    std::ranges::sort(placed);
    return placed;
}

/// Whether two faces of the same nodes run around them against each other. \pre they have as many
bool run_against(const CellMesh& mesh, std::uint32_t a, std::uint32_t b) {
    const std::size_t count = linear_type(mesh.types[a]) == CellType::triangle ? 3 : 4;
    const auto one = mesh.cell_nodes(a).first(count), other = mesh.cell_nodes(b).first(count);
    const auto at = static_cast<std::size_t>(std::ranges::find(other, one[0]) - other.begin());
    return at < count && other[(at + 1) % count] == one[count - 1];
}

/// Pairs of faces at the same places, of one surface, or of two where no more than two faces are there: on different nodes, or on the same
/// ones the other way round, as where all corners of a face are on the free border of a split.
std::vector<Pair> pairs_of_faces(const CellMesh& mesh, const std::vector<PlacedFace>& placed) {
    std::vector<Pair> pairs;
    const auto add = [&](std::uint32_t a, std::uint32_t b) {
        if (rank_of(mesh, b) < rank_of(mesh, a)) std::swap(a, b);
        pairs.push_back({a, b});
    };
    for (auto group = placed.begin(); group != placed.end();) {
        const auto end = std::find_if(group, placed.end(), [&](const PlacedFace& f) { return f.places != group->places; });
        const auto other = std::find_if(group, end, [&](const PlacedFace& f) { return f.nodes != group->nodes; });
        const bool two_sides = other != end && (end - 1)->nodes == other->nodes;
        if (end - group == 2 && (two_sides || run_against(mesh, group->cell, (group + 1)->cell))) add(group->cell, (group + 1)->cell);
        for (auto a = group; two_sides && end - group > 2 && a != other; ++a) {
            const auto b = std::find_if(other, end, [&](const PlacedFace& f) { return f.entity == a->entity; });
            if (b != end) add(a->cell, b->cell);
        }
        group = end;
    }
    std::ranges::sort(pairs, {}, [&](const Pair& pair) { return rank_of(mesh, pair[0]); });
    return pairs;
}

/// Faces of entities that have pairs: pair after pair, then those that are alone.
struct Sides {
    std::vector<std::uint32_t> faces;
    std::uint32_t paired = 0;

    /// The number of a face as a part of the surface, which both faces of a pair are.
    std::uint32_t part(std::uint32_t f) const { return f < paired ? f / 2 : f; }
};

Sides sides_of(const CellMesh& mesh, std::span<const Pair> pairs, std::span<const std::uint32_t> all) {
    Sides sides;
    std::vector<std::uint8_t> has_pairs(mesh.entities.size(), 0), is_paired(mesh.cell_count(), 0);
    for (const Pair& pair : pairs) {
        has_pairs[mesh.cell_entity[pair[0]]] = 1;
        for (const std::uint32_t c : pair) is_paired[c] = 1;
        sides.faces.insert(sides.faces.end(), pair.begin(), pair.end());
    }
    sides.paired = static_cast<std::uint32_t>(sides.faces.size());
    for (const std::uint32_t c : all) {
        if (is_paired[c] == 0 && has_pairs[mesh.cell_entity[c]] != 0) sides.faces.push_back(c);
    }
    return sides;
}

/// An edge of a face, as the face runs along it.
struct RunEdge {
    std::array<std::uint32_t, 2> nodes;  ///< ascending
    std::uint32_t entity, face;
    bool forward, is_own;  ///< its own: the other face of the pair has not both nodes
    auto operator<=>(const RunEdge&) const = default;
};

/// The edges of faces, those of one entity along one edge together.
std::vector<RunEdge> edges_of(const CellMesh& mesh, const Sides& sides) {
    std::vector<RunEdge> edges;
    for (std::uint32_t f = 0; f < sides.faces.size(); ++f) {
        const std::uint32_t c = sides.faces[f];
        const FaceCorners other = face_corners(mesh, f < sides.paired ? sides.faces[f ^ 1u] : c);
        const auto is_there = [&](std::uint32_t node) { return std::ranges::find(other, node) != other.end(); };
        const auto nodes = mesh.cell_nodes(c).first(linear_type(mesh.types[c]) == CellType::triangle ? 3 : 4);
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const std::uint32_t u = nodes[i], v = nodes[(i + 1) % nodes.size()];
            edges.push_back({{std::min(u, v), std::max(u, v)}, mesh.cell_entity[c], f, u < v, !is_there(u) || !is_there(v)});
        }
    }
    std::ranges::sort(edges);
    return edges;
}

/// Calls visit(f, g, same) for faces of one entity next to each other: whether they are on one side of the split. Those that have an edge
/// of their own in common are; of two others those that run along it against each other.
template <class Visit>
void each_step(const CellMesh& mesh, const Sides& sides, const Visit& visit) {
    const std::vector<RunEdge> edges = edges_of(mesh, sides);
    const auto is_like = [](const RunEdge& a, const RunEdge& b) { return a.nodes == b.nodes && a.entity == b.entity; };
    for (auto first = edges.begin(); first != edges.end();) {
        const auto last = std::find_if(first, edges.end(), [&](const RunEdge& e) { return !is_like(e, *first); });
        const auto other = std::find_if(first, last, [&](const RunEdge& e) { return sides.part(e.face) != sides.part(first->face); });
        if (other != last) {
            const bool two = std::all_of(other, last, [&](const RunEdge& e) { return sides.part(e.face) == sides.part(other->face); });
            if (first->is_own && other->is_own) visit(first->face, other->face, true);
            else if (two) visit(first->face, other->face, first->forward != other->forward);
        }
        first = last;
    }
}

/// Which face of each pair is left out, and for which one: faces on one side as far as it hangs together are kept, that on which faces
/// that are alone are wound, else from the first one by number on.
std::vector<std::uint32_t> keep_one_side(const CellMesh& mesh, std::span<const Pair> pairs, std::span<const std::uint32_t> all) {
    const Sides sides = sides_of(mesh, pairs, all);
    const auto count = static_cast<std::uint32_t>(sides.faces.size());
    DisjointSets sets(2 * sides.faces.size());  // count + f: what is on the other side than face f
    const auto join = [&](std::uint32_t f, std::uint32_t g, bool same) {
        sets.join(f, same ? g : count + g);
        sets.join(count + f, same ? count + g : g);
    };
    each_step(mesh, sides, join);
    for (std::uint32_t a = 0; a < sides.paired; a += 2) join(a, a + 1, false);
    std::vector<std::uint8_t> is_left_out(2 * sides.faces.size(), 0);
    const auto keep = [&](std::uint32_t f) {
        const std::uint32_t one = sets.root(f), other = sets.root(count + f);
        if (is_left_out[one] == 0 && one != other) is_left_out[other] = 1;  // where sides cannot be told apart both stay open
    };
    for (std::uint32_t f = sides.paired; f < count; ++f) keep(f);
    std::vector<std::uint32_t> side_of(mesh.cell_count(), no_index);
    for (std::uint32_t a = 0; a < sides.paired; a += 2) {
        keep(a);
        const bool first_is_left = is_left_out[sets.root(a)] != 0;
        const Pair& pair = pairs[a / 2];
        side_of[pair[first_is_left ? 0 : 1]] = pair[first_is_left ? 1 : 0];
    }
    return side_of;
}

}  // namespace

std::vector<std::uint32_t> first_at_places(const CellMesh& mesh, std::span<const std::uint32_t> faces) {
    std::unordered_map<Vec3, std::uint32_t, PlaceHash> first_at;
    for (const std::uint32_t c : faces) {
        for (const std::uint32_t node : mesh.cell_nodes(c)) first_at.emplace(mesh.points[node], no_index);
    }
    std::vector<std::uint32_t> first(mesh.points.size());
    for (std::uint32_t p = 0; p < first.size(); ++p) {
        first[p] = p;
        const auto at = first_at.find(mesh.points[p]);
        if (at == first_at.end()) continue;
        if (at->second == no_index) at->second = p;
        first[p] = at->second;
    }
    return first;
}

std::vector<std::uint32_t> other_sides(const CellMesh& mesh) {
    if (mesh.cell_entity.size() != mesh.cell_count()) return {};
    const auto faces = faces_of_entities(mesh);
    std::vector<Pair> pairs = pairs_of_faces(mesh, placed_faces(mesh, faces, first_at_places(mesh, faces)));
    if (pairs.empty()) return {};
    std::unordered_map<FaceCorners, std::uint32_t, FaceCornersHash> cells_at;
    std::vector<std::uint8_t> marked(mesh.points.size(), 0);
    for (const Pair& pair : pairs) {
        for (const std::uint32_t c : pair) {
            cells_at.emplace(face_corners(mesh, c), 0);
            for (const std::uint32_t node : mesh.cell_nodes(c)) marked[node] = 1;
        }
    }
    each_marked_face(mesh, marked, [&](std::size_t, const FaceCorners& corners) {
        if (const auto at = cells_at.find(corners); at != cells_at.end()) ++at->second;
    });
    const auto has_same_nodes = [&](const Pair& pair) { return face_corners(mesh, pair[0]) == face_corners(mesh, pair[1]); };
    std::erase_if(pairs, [&](const Pair& pair) {
        const std::uint32_t cells = has_same_nodes(pair) ? 2 : 1;
        return cells_at[face_corners(mesh, pair[0])] != cells || cells_at[face_corners(mesh, pair[1])] != cells;
    });
    if (std::ranges::all_of(pairs, has_same_nodes)) return {};  // nothing is split
    return keep_one_side(mesh, pairs, faces);
}

}  // namespace geomend
