// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/inner_tets.h"

#include <algorithm>

#include "geometry/cell_volume.h"
#include "hexes/quad_table.h"
#include "model/cell_faces.h"

namespace geomend::hexes {

namespace {

constexpr std::size_t most_tets = 15;  // of a hexahedron, by the enumeration of Pellerin, Verhetsel and Remacle (2018)

/// For each set of three corners of a cell, as bits, the face that has them; 255 where none has.
using FaceOfTriple = std::array<std::uint8_t, 256>;

FaceOfTriple faces_of_triples(CellType type) {
    FaceOfTriple face_of{};
    face_of.fill(255);
    std::uint8_t number = 0;
    for (const LocalFace& face : faces_of(type)) {
        const auto c = face.corners();
        unsigned all = 0;
        for (const std::uint8_t k : c) all |= 1u << k;
        if (c.size() == 3) face_of[all] = number;
        else {
            for (const std::uint8_t k : c) face_of[all & ~(1u << k)] = number;
        }
        ++number;
    }
    return face_of;
}

const FaceOfTriple& face_table(CellType type) {
    static const FaceOfTriple hexahedron = faces_of_triples(CellType::hexahedron), wedge = faces_of_triples(CellType::wedge);
    return type == CellType::hexahedron ? hexahedron : wedge;
}

/// Whether all four corners of a tetrahedron lie on one face of the cell.
bool is_on_face(CellType type, unsigned bits) {
    for (const LocalFace& face : faces_of(type)) {
        unsigned all = 0;
        for (const std::uint8_t k : face.corners()) all |= 1u << k;
        if ((bits & ~all) == 0) return true;
    }
    return false;
}

}  // namespace

template <std::size_t n>
unsigned InnerTets::bits_of(const std::array<std::uint32_t, n>& vertices) const {
    unsigned bits = 0;
    for (const std::uint32_t v : vertices) {
        if (local_[v] == 255) return 0;
        bits |= 1u << local_[v];
    }
    return bits;
}

bool InnerTets::find(CellType type, std::span<const std::uint32_t> corners) {
    for (std::size_t k = 0; k < corners.size(); ++k) local_[corners[k]] = static_cast<std::uint8_t>(k);
    bool found = false;
    tets_.clear();
    for (std::uint32_t i = m_.star_offsets[corners[0]]; !found && i < m_.star_offsets[corners[0] + 1]; ++i) {
        const std::uint32_t t = m_.star[i];
        const unsigned bits = bits_of(m_.tets[t]);
        if (bits == 0 || is_on_face(type, bits)) continue;
        found = flood(t, type, corners, false) || (could_go_on_ && flood(t, type, corners, true));
    }
    for (const std::uint32_t v : corners) local_[v] = 255;
    return found;
}

bool InnerTets::flood(std::uint32_t seed, CellType type, std::span<const std::uint32_t> corners, bool goes_on) {
    could_go_on_ = false;
    tets_.assign(1, seed);
    facet_count_.fill(0);
    if (!taken_.empty() && taken_[seed] != 0) return false;
    for (std::size_t i = 0; i < tets_.size(); ++i) {
        for (std::uint32_t k = 0; k < 4; ++k) {
            if (!cross(4 * tets_[i] + k, type, goes_on)) return false;
        }
    }
    if (!faces_are_whole(type, corners) || !lines_stay(type, corners)) return false;
    std::ranges::sort(tets_);
    volume_ = 0;
    for (const std::uint32_t t : tets_) {
        const auto& c = m_.tets[t];
        volume_ += tetrahedron_volume(m_.positions[c[0]], m_.positions[c[1]], m_.positions[c[2]], m_.positions[c[3]]);
    }
    return true;
}

/// Notes a facet on a face of the cell, or takes the tetrahedron on its other side. Three corners of a quadrangle may also be those of a
/// facet inside, where the quadrangle is cut along its other diagonal. \param goes_on whether tetrahedra behind such are taken
bool InnerTets::cross(std::uint32_t facet, CellType type, bool goes_on) {
    const std::uint8_t face = face_table(type)[bits_of(m_.facet(facet))];
    const std::uint32_t behind = m_.across[facet / 4][facet % 4];
    const unsigned bits_behind = behind == no_index ? 0 : bits_of(m_.tets[behind / 4]);
    const bool could_go_on = face != 255 && bits_behind != 0 && !is_on_face(type, bits_behind);
    could_go_on_ = could_go_on_ || could_go_on;
    if (face != 255 && !(goes_on && could_go_on)) {
        if (facet_count_[face] == 2) return false;
        facets_[face][facet_count_[face]++] = facet;
        return true;
    }
    if (behind == no_index || m_.wall[facet / 4][facet % 4] != TetMesh::no_wall) return false;
    const std::uint32_t t = behind / 4;
    if (std::ranges::find(tets_, t) != tets_.end()) return true;
    if (tets_.size() == most_tets || bits_behind == 0 || (!taken_.empty() && taken_[t] != 0)) return false;
    tets_.push_back(t);
    return true;
}

/// Two facets with one diagonal on each quadrangle, and one on each triangle.
bool InnerTets::faces_are_whole(CellType type, std::span<const std::uint32_t> corners) {
    diagonals_ = ends_ = 0;
    std::size_t f = 0;
    for (const LocalFace& face : faces_of(type)) {
        const auto c = face.corners();
        const std::size_t number = f++;
        if (facet_count_[number] != c.size() - 2) return false;
        if (c.size() == 3) continue;
        std::array<std::uint32_t, 4> quad{};
        for (std::size_t k = 0; k < 4; ++k) quad[k] = corners[c[k]];
        // The corners of the quadrangle that its two facets do not have.
        std::array<std::size_t, 2> missing{};
        for (std::size_t h = 0; h < 2; ++h) {
            const auto facet = m_.facet(facets_[number][h]);
            for (std::size_t k = 0; k < 4; ++k) {
                if (std::ranges::find(facet, quad[k]) == facet.end()) missing[h] = k;
            }
        }
        if ((missing[0] ^ missing[1]) != 2) return false;
        if (missing[0] % 2 == 0) diagonals_ |= static_cast<std::uint8_t>(1u << number);
        const auto ends_at = [&](std::size_t h) { return m_.across[facets_[number][h] / 4][facets_[number][h] % 4] == no_index; };
        if (ends_at(0) && ends_at(1)) ends_ |= static_cast<std::uint8_t>(1u << number);
        const std::size_t from = (missing[0] + 1) % 4;
        const auto wall = [&](std::size_t h) { return m_.wall[facets_[number][h] / 4][facets_[number][h] % 4]; };
        if (!may_be_quad(m_, quad[from], quad[(from + 2) % 4], wall(0), wall(1))) return false;
        if (!face_may_be(quad, facets_[number][0])) return false;
    }
    return true;
}

/// Whether the face may also be cut along its other diagonal, where a tetrahedron behind it has all its corners.
bool InnerTets::face_may_be(std::span<const std::uint32_t> quad, std::uint32_t facet) const {
    const std::uint32_t other = m_.across[facet / 4][facet % 4];
    if (other == no_index) return true;
    const auto& corners = m_.tets[other / 4];
    for (const std::uint32_t v : quad) {
        if (std::ranges::find(corners, v) == corners.end()) return true;
    }
    // Corners of the quadrangle that the facet has twice are the ends of its own diagonal; the two others see the far facets.
    std::array<std::uint32_t, 2> far{};
    std::array<std::uint32_t, 2> ends{};
    std::size_t count = 0;
    const auto near = m_.facet(facet);
    const auto apart = std::ranges::find_if(quad, [&](std::uint32_t v) { return std::ranges::find(near, v) == near.end(); });
    const auto at = static_cast<std::size_t>(apart - quad.begin());
    ends = {quad[at], quad[(at + 2) % 4]};
    for (std::uint32_t k = 0; k < 4; ++k) {
        if (corners[k] != ends[0] && corners[k] != ends[1]) far[count++] = m_.wall[other / 4][k];
    }
    const bool is_near_wall = m_.wall[facet / 4][facet % 4] != TetMesh::no_wall;
    if (is_near_wall && (far[0] != TetMesh::no_wall || far[1] != TetMesh::no_wall)) return false;
    return may_be_quad(m_, ends[0], ends[1], far[0], far[1]) || (is_near_wall && far[0] == TetMesh::no_wall && far[1] == TetMesh::no_wall);
}

/// No line may be lost: those between two corners must be edges of the cell.
bool InnerTets::lines_stay(CellType type, std::span<const std::uint32_t> corners) const {
    unsigned on_lines = 0;
    for (const std::uint32_t v : corners) on_lines += m_.lines.has(v) ? 1u : 0u;
    if (on_lines < 2) return true;
    std::array<std::uint8_t, 8> joined{};
    for (const auto& e : edges_of(type)) {
        joined[e[0]] |= static_cast<std::uint8_t>(1u << e[1]);
        joined[e[1]] |= static_cast<std::uint8_t>(1u << e[0]);
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
        for (std::size_t k = i + 1; k < corners.size(); ++k) {
            if ((joined[i] >> k & 1) == 0 && m_.lines.has(corners[i], corners[k])) return false;
        }
    }
    return true;
}

}  // namespace geomend::hexes
