// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/pinched_cell.h"

#include <algorithm>
#include <vector>

namespace geomend::grid {

namespace {

// Seen from outside they run with the normal out of a cell that is right-handed in (I, J, K).
constexpr std::array<std::array<unsigned, 4>, 6> outward{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

using Face = std::vector<std::uint32_t>;

// The faces with area, each corner once.
std::vector<Face> faces_with_area(const std::array<std::uint32_t, 8>& corners) {
    std::vector<Face> faces;
    for (const auto& side : outward) {
        Face face;
        for (const unsigned c : side) {
            if (std::ranges::find(face, corners[c]) == face.end()) face.push_back(corners[c]);
        }
        if (face.size() >= 3) faces.push_back(std::move(face));
    }
    return faces;
}

// Two faces that lie on each other with opposite turns bound nothing.
void drop_folded(std::vector<Face>& faces) {
    for (std::size_t a = 0; a < faces.size(); ++a) {
        for (std::size_t b = a + 1; b < faces.size(); ++b) {
            Face p = faces[a], q = faces[b];
            std::ranges::sort(p);
            std::ranges::sort(q);
            if (p != q) continue;
            faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(b));
            faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(a));
            return drop_folded(faces);
        }
    }
}

// The corner of a triangle's far end: the node that shares a face edge with `node` but is not on `base`.
std::uint32_t across(const std::vector<Face>& faces, std::uint32_t node, const Face& base) {
    for (const Face& face : faces) {
        const auto at = std::ranges::find(face, node);
        if (at == face.end()) continue;
        const std::size_t n = face.size(), i = static_cast<std::size_t>(at - face.begin());
        for (const std::uint32_t next : {face[(i + 1) % n], face[(i + n - 1) % n]}) {
            if (std::ranges::find(base, next) == base.end()) return next;
        }
    }
    return node;
}

bool disjoint(const Face& a, const Face& b) {
    return std::ranges::none_of(a, [&](std::uint32_t n) { return std::ranges::find(b, n) != b.end(); });
}

void add_polyhedron(const std::vector<Face>& faces, CellMesh& mesh) {
    if (mesh.cell_faces.empty()) {
        mesh.cell_faces.assign(mesh.types.size() + 1, 0);
        mesh.face_offsets.assign(1, 0);
    }
    Face distinct;
    for (const Face& face : faces) {
        mesh.face_nodes.insert(mesh.face_nodes.end(), face.begin(), face.end());
        mesh.face_offsets.push_back(mesh.face_nodes.size());
        distinct.insert(distinct.end(), face.begin(), face.end());
    }
    std::ranges::sort(distinct);
    distinct.erase(std::ranges::unique(distinct).begin(), distinct.end());
    mesh.types.push_back(CellType::polyhedron);
    mesh.nodes.insert(mesh.nodes.end(), distinct.begin(), distinct.end());
    mesh.offsets.push_back(mesh.nodes.size());
    mesh.cell_faces.push_back(mesh.face_offsets.size() - 1);
}

}  // namespace

void add_cell(const std::array<std::uint32_t, 8>& c, bool right_handed, CellMesh& mesh) {
    std::array<std::uint32_t, 8> sorted = c;
    std::ranges::sort(sorted);
    const auto count = static_cast<std::size_t>(std::ranges::unique(sorted).begin() - sorted.begin());
    if (count == 8) {
        if (right_handed) mesh.add_cell(CellType::hexahedron, std::array{c[4], c[5], c[7], c[6], c[0], c[1], c[3], c[2]});
        else mesh.add_cell(CellType::hexahedron, std::array{c[0], c[1], c[3], c[2], c[4], c[5], c[7], c[6]});
        return;
    }
    std::vector<Face> faces = faces_with_area(c);
    drop_folded(faces);
    // Elevation turns the hand round.
    if (right_handed) {
        for (Face& face : faces) std::ranges::reverse(face);
    }
    std::vector<const Face*> triangles, quads;
    for (const Face& face : faces) (face.size() == 3 ? triangles : quads).push_back(&face);
    if (count == 6 && triangles.size() == 2 && quads.size() == 3 && disjoint(*triangles[0], *triangles[1])) {
        const Face& t = *triangles[0];  // its normal leaves the cell, as wedges want it
        mesh.add_cell(CellType::wedge,
                      std::array{t[0], t[1], t[2], across(faces, t[0], t), across(faces, t[1], t), across(faces, t[2], t)});
    } else if (count == 5 && quads.size() == 1 && triangles.size() == 4) {
        const Face& q = *quads[0];
        mesh.add_cell(CellType::pyramid, std::array{q[3], q[2], q[1], q[0], across(faces, q[0], q)});
    } else if (count == 4 && triangles.size() == 4) {
        const Face& t = *triangles[0];
        mesh.add_cell(CellType::tetrahedron, std::array{t[2], t[1], t[0], across(faces, t[0], t)});
    } else {
        add_polyhedron(faces, mesh);
    }
}

}  // namespace geomend::grid
