// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "arrangement/face_mesh.h"
#include "arrangement/link_table.h"

namespace geomend::arrangement {

/// What cutting one triangle needs, kept from one to the next to save memory requests.
struct CutScratch {
    FaceMesh mesh;
    std::vector<std::uint32_t> way, loop, names, local;
    std::vector<Vec3> positions;
    std::vector<std::uint64_t> ways;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> numbers;
};

/// Where segments inside one triangle cross each other or pass within the distance of points on it: crossing points to be made
/// (edge and other are the two segments), and points that stand on segments.
/// \param segments between vertices of the triangle or on it \param on_face vertices on its inside; corners and the
/// vertices on its edges are looked at, too. Cost: near-linear where few cross.
void cross_segments(std::span<const Vec3> points, const Triangle& triangle, const LinkTable& links, std::span<const Link> segments,
                    std::span<const std::uint32_t> on_face, double distance, std::vector<NewPoint>& crossings,
                    std::vector<VertexOnEdge>& on_segments, CutScratch& scratch);

/// Cuts a triangle along segments and at points: adds triangles that fill it, turned as it is, none with a vertex twice.
/// \param links what stands on its edges and on the segments \param on_face vertices inside \param segments as above
/// \param reach flat triangles up to this height are avoided
/// True where all was brought in; false where rounding keeps a point or a segment out: what is left shows when the result is
/// looked through again. Nothing is added for a triangle of which a corner stands on the edge opposite.
bool cut_triangle(std::span<const Vec3> points, const Triangle& triangle, const LinkTable& links, std::span<const Link> segments,
                  std::span<const std::uint32_t> on_face, double reach, CutScratch& scratch, std::vector<Triangle>& parts);

}  // namespace geomend::arrangement
