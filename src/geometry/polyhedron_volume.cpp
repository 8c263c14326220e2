// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/polyhedron_volume.h"

#include <algorithm>
#include <span>
#include <vector>

#include "geometry/cell_volume.h"

namespace geomend {

namespace {

struct EdgeUse {
    std::uint32_t low, high;
    std::uint32_t face;
    bool forward;
};

std::span<const std::uint32_t> face_of(const CellMesh& mesh, std::size_t face) {
    return {mesh.face_nodes.data() + mesh.face_offsets[face],
            static_cast<std::size_t>(mesh.face_offsets[face + 1] - mesh.face_offsets[face])};
}

double fan_flux6(const CellMesh& mesh, std::span<const std::uint32_t> face, const Vec3& origin) {
    const std::size_t n = face.size();
    if (n < 3) return 0;
    const auto lowest = static_cast<std::size_t>(std::min_element(face.begin(), face.end()) - face.begin());
    const auto corner = [&](std::size_t k) { return minus(mesh.points[face[(lowest + k) % n]], origin); };
    const Vec3 apex = corner(0);
    double sum = 0;
    for (std::size_t k = 1; k + 1 < n; ++k) sum += flux6(apex, corner(k), corner(k + 1));
    return sum;
}

std::vector<EdgeUse> sorted_edges(const CellMesh& mesh, std::size_t first_face, std::size_t last_face) {
    std::vector<EdgeUse> edges;
    for (std::size_t f = first_face; f < last_face; ++f) {
        const auto face = face_of(mesh, f);
        for (std::size_t i = 0; i < face.size(); ++i) {
            const std::uint32_t a = face[i], b = face[(i + 1) % face.size()];
            if (a != b) edges.push_back({std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(f - first_face), a < b});
        }
    }
    std::ranges::sort(edges, [](const EdgeUse& x, const EdgeUse& y) {
        if (x.low != y.low) return x.low < y.low;
        if (x.high != y.high) return x.high < y.high;
        return x.face < y.face;
    });
    return edges;
}

}  // namespace

std::vector<bool> faces_to_turn(const CellMesh& mesh, std::size_t cell) {
    const auto first_face = static_cast<std::size_t>(mesh.cell_faces[cell]),
               last_face = static_cast<std::size_t>(mesh.cell_faces[cell + 1]);
    const std::vector<EdgeUse> edges = sorted_edges(mesh, first_face, last_face);
    struct Link {
        std::uint32_t face, other;
        bool against;
    };
    std::vector<Link> links;
    bool agree = true;
    for (std::size_t i = 0; i < edges.size(); i += 2) {
        const bool pair = i + 1 < edges.size() && edges[i].low == edges[i + 1].low && edges[i].high == edges[i + 1].high;
        const bool third = i + 2 < edges.size() && edges[i].low == edges[i + 2].low && edges[i].high == edges[i + 2].high;
        if (!pair || third) return {};
        const bool against = edges[i].forward == edges[i + 1].forward;
        agree = agree && !against;
        links.push_back({edges[i].face, edges[i + 1].face, against});
        links.push_back({edges[i + 1].face, edges[i].face, against});
    }
    if (agree) return {};
    std::ranges::sort(links, {}, &Link::face);
    const std::size_t count = last_face - first_face;
    std::vector<bool> turn(count), seen(count);
    std::vector<std::uint32_t> stack;
    for (std::size_t start = 0; start < count; ++start) {
        if (seen[start]) continue;
        seen[start] = true;
        stack.push_back(static_cast<std::uint32_t>(start));
        while (!stack.empty()) {
            const std::uint32_t face = stack.back();
            stack.pop_back();
            for (const Link& link : std::ranges::equal_range(links, face, {}, &Link::face)) {
                if (seen[link.other]) continue;
                seen[link.other] = true;
                turn[link.other] = turn[face] != link.against;
                stack.push_back(link.other);
            }
        }
    }
    return turn;
}

double polyhedron_volume(const CellMesh& mesh, std::size_t cell) {
    const auto first = static_cast<std::size_t>(mesh.cell_faces[cell]), last = static_cast<std::size_t>(mesh.cell_faces[cell + 1]);
    if (first == last || face_of(mesh, first).empty()) return 0;
    const std::vector<bool> turn = faces_to_turn(mesh, cell);
    const Vec3 origin = mesh.points[face_of(mesh, first)[0]];
    double sum = 0;
    for (std::size_t f = first; f < last; ++f) {
        const double flux = fan_flux6(mesh, face_of(mesh, f), origin);
        sum += !turn.empty() && turn[f - first] ? -flux : flux;
    }
    return sum / 6;
}

}  // namespace geomend
