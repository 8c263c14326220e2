// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/closing_front.h"

#include <algorithm>
#include <utility>

#include "geometry/cell_volume.h"
#include "model/cell_faces.h"

namespace geomend::hexes {

ClosingFront::ClosingFront(const TetMesh& mesh, const Candidates& candidates, ClosingCounts& counts)
    : m_(mesh),
      all_(candidates),
      counts_(counts),
      tets_(mesh.tets),
      across_(mesh.across),
      tet_of_(mesh.tets.size()),
      alive_(mesh.tets.size(), 1),
      positions_(mesh.positions),
      facet_places_(4 * mesh.tets.size()),
      half_of_(4 * mesh.tets.size(), no_index) {
    sources_.resize(tets_.size());
    for (std::uint32_t t = 0; t < tets_.size(); ++t) {
        tet_of_[t] = t;
        for (std::uint32_t k = 0; k < 4; ++k) sources_[t][k] = m_.wall[t][k] != TetMesh::no_wall ? 4 * t + k : no_index;
    }
}

template <class Change>
void ClosingFront::move_pending(FrontQuad& q, const Change& change) {
    const auto found = pending_.find(q.diagonal());
    const bool is_pending = found != pending_.end();
    if (is_pending && --found->second == 0) pending_.erase(found);
    change();
    if (is_pending) ++pending_[q.diagonal()];
}

void ClosingFront::add_cell(std::uint32_t i) {
    const auto cell = static_cast<std::uint32_t>(cells_.size());
    const auto tets = all_.tets_of(i);
    cells_.push_back({all_.types[i], all_.corners[i], m_.region[tets.front()], largest(tets)});
    std::array<std::uint32_t, 6> quad_of{};
    std::uint32_t number = 0;
    for (const LocalFace& face : faces_of(all_.types[i])) {
        const auto c = face.corners();
        if (c.size() == 4) {
            quad_of[number] = static_cast<std::uint32_t>(quads_.size());
            FrontQuad q{cell, number, {}, all_.diagonals[i] >> number & 1u, {no_index, no_index}, {}, {}};
            for (std::size_t k = 0; k < 4; ++k) q.v[k] = all_.corners[i][c[k]];
            quads_.push_back(std::move(q));
        }
        ++number;
    }
    for (const std::uint32_t t : tets) alive_[t] = 0;
    for (const std::uint32_t t : tets) {
        for (std::uint32_t k = 0; k < 4; ++k) {
            const std::uint32_t other = m_.across[t][k];
            if (other != no_index && std::ranges::find(tets, other / 4) != tets.end()) continue;
            note_facet(i, cell, quad_of, 4 * t + k);
        }
    }
}

void ClosingFront::note_facet(std::uint32_t i, std::uint32_t cell, const std::array<std::uint32_t, 6>& quad_of, std::uint32_t facet) {
    const auto f = m_.facet(facet);
    std::uint32_t number = 0;
    for (const LocalFace& face : faces_of(all_.types[i])) {
        const auto c = face.corners();
        const auto on_face = [&](std::uint32_t v) { return std::ranges::any_of(c, [&](auto k) { return all_.corners[i][k] == v; }); };
        if (std::ranges::all_of(f, on_face)) {
            std::uint32_t half = 0;
            if (c.size() == 4) {
                const FrontQuad& q = quads_[quad_of[number]];
                half = std::ranges::find(f, q.corner(3)) == f.end() ? 0 : 1;
                half_of_[facet] = half_bit | (2 * quad_of[number] + half);
            } else {
                half_of_[facet] = of_cell;
            }
            put_place(facet, cell, number, half);
            return;
        }
        ++number;
    }
}

void ClosingFront::put_place(std::uint32_t facet, std::uint32_t cell, std::uint32_t face, std::uint32_t half) {
    if (facet != no_index && m_.wall[facet / 4][facet % 4] != TetMesh::no_wall) facet_places_[facet] = {cell, half_face(face, half)};
}

void ClosingFront::link_quads() {
    for (std::uint32_t facet = 0; facet < half_of_.size(); ++facet) {
        const std::uint32_t code = half_of_[facet];
        if (code == no_index) continue;
        const std::uint32_t other = m_.across[facet / 4][facet % 4];
        std::uint32_t behind = other;
        if (other != no_index && alive_[other / 4] != 0) across_[other / 4][other % 4] = code;
        else if (other != no_index) behind = half_of_[other];
        if (is_half(code)) quads_[(code & ~half_bit) / 2].behind[code & 1] = behind;
    }
}

std::uint32_t ClosingFront::largest(std::span<const std::uint32_t> tets) const {
    const auto size = [&](std::uint32_t t) {
        const auto& c = m_.tets[t];
        return tetrahedron_volume(m_.positions[c[0]], m_.positions[c[1]], m_.positions[c[2]], m_.positions[c[3]]);
    };
    return *std::ranges::max_element(tets, {}, size);
}

void ClosingFront::settle(std::uint32_t number) {
    bool counted = false;
    while (!quads_[number].is_done) {
        const auto [b0, b1] = quads_[number].behind;
        if (b0 == no_index && b1 == no_index) return done(number);
        if (is_half(b0) && is_half(b1) && (b0 ^ b1) == 1) return join(number, (b0 & ~half_bit) / 2);
        if (!is_facet(b0) || !is_facet(b1)) return;
        if (!counted) ++counts_.quads;
        counted = true;
        if (b0 / 4 != b1 / 4) return;
        absorb(number, b0 / 4);
    }
}

void ClosingFront::join(std::uint32_t a, std::uint32_t b) {
    place_far(quads_[a], quads_[b].cell, quads_[b].face);
    place_far(quads_[b], quads_[a].cell, quads_[a].face);
    done(a);
    done(b);
}

void ClosingFront::place_far(const FrontQuad& q, std::uint32_t cell, std::uint32_t face) {
    for (const std::uint32_t facet : q.far) put_place(facet, cell, face, 0);
}

void ClosingFront::absorb(std::uint32_t number, std::uint32_t t) {
    FrontQuad& q = quads_[number];
    q.absorbed.push_back(t);
    alive_[t] = 0;
    move_pending(q, [&] { q.start = 1 - q.start; });
    std::array<std::uint32_t, 2> behind{};
    for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t missing = tets_[t][k];
        if (missing == q.corner(0) || missing == q.corner(2)) {  // a facet on the near side
            if (sources_[t][k] != no_index) q.far.push_back(sources_[t][k]);
            continue;
        }
        const std::uint32_t half = q.half_without(missing);
        put_place(sources_[t][k], q.cell, q.face, half);
        behind[half] = across_[t][k];
        link(behind[half], half_bit | (2 * number + half));
    }
    q.behind = behind;
}

void ClosingFront::give_up(std::uint32_t number) {
    FrontQuad& q = quads_[number];
    for (; !q.absorbed.empty(); q.absorbed.pop_back()) {
        const std::uint32_t t = q.absorbed.back();
        const std::array<std::uint32_t, 2> far = q.behind;
        alive_[t] = 1;
        for (std::uint32_t k = 0; k < 4; ++k) {
            const std::uint32_t missing = tets_[t][k];
            if (missing == q.corner(1) || missing == q.corner(3)) {
                across_[t][k] = far[q.half_without(missing)];
                link(across_[t][k], 4 * t + k);
            }
        }
        move_pending(q, [&] { q.start = 1 - q.start; });
        for (std::uint32_t k = 0; k < 4; ++k) {
            const std::uint32_t missing = tets_[t][k];
            if (missing != q.corner(1) && missing != q.corner(3)) continue;
            q.behind[q.half_without(missing)] = 4 * t + k;
            across_[t][k] = half_bit | (2 * number + q.half_without(missing));
        }
    }
    q.far.clear();
    failed_.push_back({quads_[number].cell, quads_[number].face, quads_[number].start});
    done(number);
}

void ClosingFront::done(std::uint32_t number) {
    FrontQuad& q = quads_[number];
    if (q.is_done) return;
    q.is_done = true;
    if (const auto found = pending_.find(q.diagonal()); found != pending_.end() && --found->second == 0) pending_.erase(found);
}

void ClosingFront::link(std::uint32_t code, std::uint32_t other) {
    if (is_facet(code)) across_[code / 4][code % 4] = other;
    else if (is_half(code)) quads_[(code & ~half_bit) / 2].behind[code & 1] = other;
}

std::uint32_t ClosingFront::index_in(std::uint32_t t, std::uint32_t v) const {
    return static_cast<std::uint32_t>(std::ranges::find(tets_[t], v) - tets_[t].begin());
}

bool ClosingFront::find_fan(const FrontQuad& q) {
    fan_.clear();
    chain_.assign(1, q.corner(1));
    const std::uint32_t a = q.corner(0), c = q.corner(2);
    std::uint32_t facet = q.behind[0];
    while (true) {
        const std::uint32_t t = facet / 4;
        if (alive_[t] == 0) return false;
        fan_.push_back(t);
        const std::uint32_t x = chain_.back(), y = tets_[t][facet % 4];
        chain_.push_back(y);
        if (index_in(t, a) == 4 || index_in(t, c) == 4 || index_in(t, x) == 4) return false;
        const std::uint32_t next = across_[t][index_in(t, x)];
        if (y == q.corner(3) && is_half(next)) return 4 * t + index_in(t, x) == q.behind[1];
        if (!is_facet(next) || sources_[t][index_in(t, x)] != no_index || fan_.size() > 200) return false;
        facet = next;
    }
}

std::array<Vec3, 4> ClosingFront::points(const FrontQuad& q) const {
    return {positions_[q.corner(0)], positions_[q.corner(1)], positions_[q.corner(2)], positions_[q.corner(3)]};
}

std::uint32_t ClosingFront::add_pyramid(const FrontQuad& q, std::uint32_t apex) {
    const auto cell = static_cast<std::uint32_t>(cells_.size());
    const std::uint32_t tet = tet_of_[fan_.front()];
    cells_.push_back(
        {CellType::pyramid, {q.corner(0), q.corner(1), q.corner(2), q.corner(3), apex, no_index, no_index, no_index}, m_.region[tet], tet});
    for (const std::uint32_t code : q.behind) put_place(sources_[code / 4][code % 4], cell, 0, 0);
    place_far(q, cell, 0);
    return cell;
}

MixedMesh ClosingFront::finish() {
    for (const FrontQuad& q : quads_) counts_.absorbed += q.absorbed.size();
    MixedMesh mesh{std::move(positions_), std::move(new_vertices_), std::move(cells_), std::move(facet_places_)};
    counts_.split = split_cells(mesh, failed_);
    for (CellFaceRef& place : mesh.facet_places) {
        if (place.cell != no_index) place.face /= 2;
    }
    for (std::uint32_t t = 0; t < tets_.size(); ++t) {
        if (alive_[t] == 0) continue;
        const auto cell = static_cast<std::uint32_t>(mesh.cells.size());
        const auto& c = tets_[t];
        const std::array<std::uint32_t, 8> corners{c[0], c[1], c[2], c[3], no_index, no_index, no_index, no_index};
        mesh.cells.push_back({CellType::tetrahedron, corners, m_.region[tet_of_[t]], tet_of_[t]});
        for (std::uint32_t k = 0; k < 4; ++k) {
            if (sources_[t][k] != no_index) mesh.facet_places[sources_[t][k]] = {cell, face_opposite(k)};
        }
    }
    return mesh;
}

}  // namespace geomend::hexes
