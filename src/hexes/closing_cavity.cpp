// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/closing_cavity.h"

#include <algorithm>
#include <cmath>

#include "hexes/jacobian.h"

namespace geomend::hexes {

double CavityFront::shape_wanted(std::span<const std::uint32_t> tets) const {
    constexpr double least = 1e-5, most = 3e-3, share = 0.1;
    double best = 0;
    for (const std::uint32_t t : tets) {
        const auto& c = tets_[t];
        const std::array corners{positions_[c[0]], positions_[c[1]], positions_[c[2]], positions_[c[3]]};
        best = std::max(best, scaled_jacobian(CellType::tetrahedron, corners));
    }
    return std::clamp(share * best, least, most);
}

bool CavityFront::open_cavity(std::uint32_t number) {
    constexpr std::size_t most_faces = 60;
    cavity_ = fan_;
    find_border(number);
    while (border_.size() <= most_faces) {
        const CavityBorder border = border_places();
        const Room room = room_in(border);
        if (is_simple_ && room.depth > 1e-6 && !loses_something()) {
            const ApexPlace place = place_for_apex(border);
            if (place.quality > shape_wanted(cavity_)) {
                fill_cavity(place.position);
                return true;
            }
        }
        if (!grow(number, room.in_the_way)) return false;
    }
    return false;
}

bool CavityFront::grow(std::uint32_t number, std::span<const std::uint32_t> triangles) {
    std::vector<std::uint32_t> behind;
    std::uint32_t at = 0;
    for (const std::uint32_t f : border_) {
        if (is_capped(f)) continue;
        const std::uint32_t code = across_[f / 4][f % 4];
        const bool may_give_way = is_facet(code) && sources_[f / 4][f % 4] == no_index;
        if (may_give_way && std::ranges::find(triangles, at) != triangles.end()) behind.push_back(code / 4);
        ++at;
    }
    double most = -HUGE_VAL;
    std::uint32_t best = no_index;
    for (const std::uint32_t t : behind) {
        cavity_.push_back(t);
        find_border(number);
        const double depth = room_in(border_places()).depth - (is_simple_ ? 0 : 1);
        if (depth > most) most = depth, best = t;
        cavity_.pop_back();
    }
    if (best == no_index) return false;
    cavity_.push_back(best);
    find_border(number);
    return true;
}

bool CavityFront::is_in_cavity(std::uint32_t t) const { return std::ranges::find(cavity_, t) != cavity_.end(); }

bool CavityFront::is_capped(std::uint32_t facet) const {
    const std::uint32_t code = across_[facet / 4][facet % 4];
    return is_half(code) && std::ranges::find(capped_, (code & ~half_bit) / 2) != capped_.end();
}

std::array<std::uint32_t, 3> CavityFront::facet(std::uint32_t number) const {
    const auto& tet = tets_[number / 4];
    const auto& c = facet_corners[number % 4];
    return {tet[c[0]], tet[c[1]], tet[c[2]]};
}

void CavityFront::find_border(std::uint32_t number) {
    border_.clear();
    capped_.assign(1, number);
    border_edges_.clear();
    std::vector<std::uint32_t> halves;
    for (const std::uint32_t t : cavity_) {
        for (std::uint32_t k = 0; k < 4; ++k) {
            const std::uint32_t code = across_[t][k];
            if (is_facet(code) && sources_[t][k] == no_index && is_in_cavity(code / 4)) continue;
            const auto c = facet(4 * t + k);
            for (std::size_t e = 0; e < 3; ++e)
                border_edges_.push_back({pair_key(c[e], c[(e + 1) % 3]), static_cast<std::uint32_t>(border_.size())});
            border_.push_back(4 * t + k);
            if (is_half(code)) halves.push_back(code & ~half_bit);
        }
    }
    std::ranges::sort(border_edges_);
    is_simple_ = true;
    for (std::size_t i = 0; i < border_edges_.size(); i += 2) {
        const bool pairs = i + 1 < border_edges_.size() && border_edges_[i].first == border_edges_[i + 1].first;
        is_simple_ = is_simple_ && pairs && (i + 2 == border_edges_.size() || border_edges_[i].first != border_edges_[i + 2].first);
    }
    std::ranges::sort(halves);
    for (std::size_t i = 0; i + 1 < halves.size(); ++i) {
        const bool is_whole = halves[i] % 2 == 0 && halves[i + 1] == halves[i] + 1;
        if (is_whole && halves[i] / 2 != number && !quads_[halves[i] / 2].is_done) capped_.push_back(halves[i] / 2);
    }
}

CavityBorder CavityFront::border_places() const {
    CavityBorder border;
    border.also = beside_;
    for (const std::uint32_t number : capped_) border.quads.push_back(points(quads_[number]));
    for (const std::uint32_t f : border_) {
        const auto c = facet(f);
        if (!is_capped(f)) border.triangles.push_back({positions_[c[0]], positions_[c[2]], positions_[c[1]]});
    }
    return border;
}

bool CavityFront::loses_something() const {
    const auto is_at_border = [&](std::uint32_t a, std::uint32_t b) {
        const auto found = std::ranges::lower_bound(border_edges_, pair_key(a, b), {}, [](const auto& e) { return e.first; });
        return found != border_edges_.end() && found->first == pair_key(a, b);
    };
    const auto is_line = [&](std::uint32_t a, std::uint32_t b) {
        return a < m_.positions.size() && b < m_.positions.size() && m_.lines.has(a, b);
    };
    for (const std::uint32_t t : cavity_) {
        const auto& c = tets_[t];
        for (std::size_t i = 0; i < 4; ++i) {
            bool is_out = false;
            for (std::size_t k = 0; k < 4; ++k) {
                if (k == i) continue;
                const bool at_border = is_at_border(c[i], c[k]);
                is_out = is_out || at_border;
                if (!at_border && is_line(c[i], c[k])) return true;
            }
            const auto has = [&](std::uint32_t f) {
                const auto corners = facet(f);
                return std::ranges::find(corners, c[i]) != corners.end();
            };
            if (!is_out && std::ranges::none_of(border_, has)) return true;
        }
    }
    return false;
}

void CavityFront::fill_cavity(const Vec3& place) {
    const auto apex = static_cast<std::uint32_t>(positions_.size());
    positions_.push_back(place);
    new_vertices_.push_back({quads_[capped_.front()].v, m_.region[tet_of_[cavity_.front()]]});
    fan_ = cavity_;
    for (const std::uint32_t number : capped_) {
        add_pyramid(quads_[number], apex);
        done(number);
    }
    counts_.opened += capped_.size();
    std::vector<std::uint32_t> made(border_.size(), no_index);
    for (std::size_t i = 0; i < border_.size(); ++i) {
        if (is_capped(border_[i])) continue;
        const std::uint32_t t = border_[i] / 4, k = border_[i] % 4;
        made[i] = static_cast<std::uint32_t>(tets_.size());
        std::array<std::uint32_t, 4> tet = tets_[t], source{no_index, no_index, no_index, no_index};
        tet[k] = apex;
        source[k] = sources_[t][k];
        tets_.push_back(tet);
        across_.push_back(across_[t]);
        sources_.push_back(source);
        tet_of_.push_back(tet_of_[t]);
        alive_.push_back(1);
        link(across_[t][k], 4 * made[i] + k);
    }
    for (std::size_t e = 0; e + 1 < border_edges_.size(); e += 2)
        join_at(border_edges_[e].first, {border_edges_[e].second, border_edges_[e + 1].second}, made);
    for (const std::uint32_t t : cavity_) alive_[t] = 0;
}

void CavityFront::join_at(std::uint64_t edge, std::array<std::uint32_t, 2> faces, const std::vector<std::uint32_t>& made) {
    std::array<std::uint32_t, 2> codes{of_cell, of_cell};
    for (std::size_t n = 0; n < 2; ++n) {
        const std::uint32_t t = made[faces[n]];
        if (t == no_index) continue;
        for (std::uint32_t k = 0; k < 4; ++k) {
            if (k != border_[faces[n]] % 4 && pair_key_without(tets_[t], k, border_[faces[n]] % 4) == edge) codes[n] = 4 * t + k;
        }
    }
    for (std::size_t n = 0; n < 2; ++n) {
        if (codes[n] != of_cell) across_[codes[n] / 4][codes[n] % 4] = codes[1 - n];
    }
}

std::uint64_t CavityFront::pair_key_without(const std::array<std::uint32_t, 4>& tet, std::uint32_t k, std::uint32_t l) {
    std::array<std::uint32_t, 2> ends{};
    std::size_t count = 0;
    for (std::uint32_t n = 0; n < 4; ++n) {
        if (n != k && n != l) ends[count++] = tet[n];
    }
    return pair_key(ends[0], ends[1]);
}

}  // namespace geomend::hexes
