// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "base/vec3.h"
#include "model/objects.h"
#include "model/triangle_soup.h"

namespace geomend::remeshing {

/// A half-edge 3 t + k runs from corner k of triangle t to the next one.
inline std::uint32_t next_of(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
inline std::uint32_t previous_of(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }

/// Triangles that turn one way around, with what lies across each edge, in plain arrays. Around each vertex the triangles are one
/// fan. Removed triangles and vertices leave holes in the arrays, which are filled again.
struct EdgeMesh {
    std::vector<Vec3> places;            ///< per vertex
    std::vector<std::uint32_t> corners;  ///< per half-edge the vertex that it starts at; no_index: the triangle is removed
    std::vector<std::uint32_t> twins;    ///< per half-edge the one that runs back; no_index: a border
    std::vector<std::uint32_t> leaving;  ///< per vertex a half-edge from it, that on the border if there is one; no_index: removed
    std::vector<std::uint32_t> free_triangles, free_vertices;

    std::uint32_t from(std::uint32_t h) const { return corners[h]; }
    std::uint32_t to(std::uint32_t h) const { return corners[next_of(h)]; }
    std::uint32_t tip(std::uint32_t h) const { return corners[previous_of(h)]; }  ///< the corner of its triangle that it does not touch
    std::uint32_t triangle_count() const { return static_cast<std::uint32_t>(corners.size() / 3); }  ///< with removed ones
    bool has_triangle(std::uint32_t t) const { return corners[3 * std::size_t{t}] != no_index; }
    bool has_vertex(std::uint32_t v) const { return leaving[v] != no_index; }
    bool on_border(std::uint32_t v) const { return twins[leaving[v]] == no_index; }
    std::array<Vec3, 3> triangle(std::uint32_t t) const {
        return {places[corners[3 * std::size_t{t}]], places[corners[3 * std::size_t{t} + 1]], places[corners[3 * std::size_t{t} + 2]]};
    }
};

/// Calls visit(h) for each half-edge that leaves a vertex, counter-clockwise; on a border from its beginning to its end (where the edge
/// at the end of the fan has no half-edge from the vertex).
template <class Visit>
void visit_leaving(const EdgeMesh& mesh, std::uint32_t vertex, const Visit& visit) {
    const std::uint32_t first = mesh.leaving[vertex];
    std::uint32_t h = first;
    do {
        visit(h);
        h = mesh.twins[previous_of(h)];
    } while (h != no_index && h != first);
}

/// Calls visit(v) for each vertex that an edge leads to.
template <class Visit>
void visit_neighbours(const EdgeMesh& mesh, std::uint32_t vertex, const Visit& visit) {
    visit_leaving(mesh, vertex, [&](std::uint32_t h) {
        visit(mesh.to(h));
        if (mesh.twins[previous_of(h)] == no_index) visit(mesh.tip(h));
    });
}

/// The mesh of triangles whose neighbours are given: where the triangles at a vertex are several fans, it becomes a vertex for each.
struct FannedMesh {
    EdgeMesh mesh;
    std::vector<std::uint32_t> vertex_of;  ///< per vertex of the mesh that of the triangles
};
/// \param neighbours per corner the triangle across the edge to the next one; no_index: none
/// Failure (cannot_hold, F026) with the reason where a triangle names a vertex twice, or two neighbours turn opposite ways. Linear.
Result<FannedMesh> fanned_mesh(std::span<const Vec3> places, std::span<const std::uint32_t> corners,
                               std::span<const std::uint32_t> neighbours);

/// Puts a vertex on an edge: each triangle there becomes two. \return the vertex, whose leaving half-edges lie in the old triangles and
/// in new ones
std::uint32_t split_edge(EdgeMesh& mesh, std::uint32_t h, const Vec3& place);

/// Puts a vertex inside of a triangle, which becomes three. \return the vertex
std::uint32_t split_face(EdgeMesh& mesh, std::uint32_t triangle, const Vec3& place);

/// Whether an edge can be turned: it is no border, and its tips have no edge between them.
bool can_flip(const EdgeMesh& mesh, std::uint32_t h);
/// The edge runs between its two tips afterwards; it keeps its number. \pre can_flip()
void flip_edge(EdgeMesh& mesh, std::uint32_t h);

/// Whether an end of an edge can give way to the other one, so that the mesh stays what it is: the two have no common neighbours but
/// the tips, and no border is pinched. A vertex of a border gives way along the border only. \pre `gone` is an end of the edge
bool can_collapse(const EdgeMesh& mesh, std::uint32_t h, std::uint32_t gone);
/// \pre can_collapse()
void collapse_edge(EdgeMesh& mesh, std::uint32_t h, std::uint32_t gone);

/// Whether corners, twins and leaving half-edges are what they promise; for tests. Linear.
bool is_consistent(const EdgeMesh& mesh);

}  // namespace geomend::remeshing
