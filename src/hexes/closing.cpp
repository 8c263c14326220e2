// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/closing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>

#include "base/vectors.h"
#include "geometry/cell_volume.h"
#include "hexes/cavity_apex.h"
#include "hexes/half_spaces.h"
#include "hexes/jacobian.h"
#include "hexes/open_diagonal.h"
#include "hexes/pair_set.h"
#include "hexes/split_cells.h"
#include "model/cell_faces.h"

namespace geomend::hexes {

namespace {

/// What lies across a facet or behind half of a quadrangle: a facet of a tetrahedron, half of a quadrangle, nothing (no_index), or a
/// triangle of a cell.
constexpr std::uint32_t half_bit = 0x80000000u, of_cell = 0xfffffffeu;
constexpr bool is_half(std::uint32_t code) { return (code & half_bit) != 0 && code < of_cell; }
constexpr bool is_facet(std::uint32_t code) { return (code & half_bit) == 0; }

struct Quad {
    std::uint32_t cell, face;
    std::array<std::uint32_t, 4> v;  ///< wound outwards
    std::uint32_t start;  ///< 0 or 1: its halves are v[start], v[start + 1], v[start + 2] and v[start], v[start + 2], v[start + 3]
    std::array<std::uint32_t, 2> behind;  ///< per half
    std::vector<std::uint32_t> far;       ///< facets on walls that belong to the cell behind
    std::vector<std::uint32_t> absorbed;  ///< tetrahedra on it that became a part of it
    bool is_done = false;

    std::uint32_t corner(std::uint32_t k) const { return v[(start + k) % 4]; }
    std::uint64_t diagonal() const { return pair_key(corner(0), corner(2)); }
    /// The half that does not have a corner of it. \pre the corner is not on the diagonal
    std::uint32_t half_without(std::uint32_t vertex) const { return vertex == corner(3) ? 0 : 1; }
};

class Closer {
public:
    Closer(const TetMesh& mesh, const Candidates& candidates, ClosingCounts& counts)
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

    /// \param urgent per cell and face how often that quadrangle could not be closed before: it comes the earlier for it
    MixedMesh run(std::span<const std::uint32_t> selected, Closing how, const std::map<std::array<std::uint32_t, 2>, int>& urgent) {
        for (const std::uint32_t i : selected) add_cell(i);
        link_quads();
        for (const Quad& q : quads_) {
            if (is_facet(q.behind[0]) || is_facet(q.behind[1])) ++pending_[q.diagonal()];
        }
        for (std::uint32_t q = 0; q < quads_.size(); ++q) settle(q);
        for (std::uint32_t q = 0; q < quads_.size(); ++q) {
            for (std::size_t k = 0; k < 4 && !quads_[q].is_done; ++k)
                quads_at_.emplace(pair_key(quads_[q].v[k], quads_[q].v[(k + 1) % 4]), q);
        }
        for (const std::uint32_t q : hardest_first(how, urgent)) close_quad(q, how);
        return finish();
    }

    /// Quadrangles of cells that had to be split.
    const std::vector<OpenQuad>& failed() const { return failed_; }

private:
    void add_cell(std::uint32_t i) {
        const auto cell = static_cast<std::uint32_t>(cells_.size());
        const auto tets = all_.tets_of(i);
        cells_.push_back({all_.types[i], all_.corners[i], m_.region[tets.front()], largest(tets)});
        std::array<std::uint32_t, 6> quad_of{};
        std::uint32_t number = 0;
        for (const LocalFace& face : faces_of(all_.types[i])) {
            const auto c = face.corners();
            if (c.size() == 4) {
                quad_of[number] = static_cast<std::uint32_t>(quads_.size());
                Quad q{cell, number, {}, all_.diagonals[i] >> number & 1u, {no_index, no_index}, {}, {}};
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

    /// A facet of a cell's own tetrahedra on one of its faces.
    void note_facet(std::uint32_t i, std::uint32_t cell, const std::array<std::uint32_t, 6>& quad_of, std::uint32_t facet) {
        const auto f = m_.facet(facet);
        std::uint32_t number = 0;
        for (const LocalFace& face : faces_of(all_.types[i])) {
            const auto c = face.corners();
            const auto on_face = [&](std::uint32_t v) { return std::ranges::any_of(c, [&](auto k) { return all_.corners[i][k] == v; }); };
            if (std::ranges::all_of(f, on_face)) {
                std::uint32_t half = 0;
                if (c.size() == 4) {
                    const Quad& q = quads_[quad_of[number]];
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

    void put_place(std::uint32_t facet, std::uint32_t cell, std::uint32_t face, std::uint32_t half) {
        if (facet != no_index && m_.wall[facet / 4][facet % 4] != TetMesh::no_wall) facet_places_[facet] = {cell, half_face(face, half)};
    }

    void link_quads() {
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

    std::uint32_t largest(std::span<const std::uint32_t> tets) const {
        const auto size = [&](std::uint32_t t) {
            const auto& c = m_.tets[t];
            return tetrahedron_volume(m_.positions[c[0]], m_.positions[c[1]], m_.positions[c[2]], m_.positions[c[3]]);
        };
        return *std::ranges::max_element(tets, {}, size);
    }

    /// Takes what lies flat on a quadrangle as a part of it. Done is what then ends the mesh or has another cell behind it.
    void settle(std::uint32_t number) {
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

    /// What quadrangles that are to be closed later need: a vertex that closes this one has to be in front of their corners.
    void find_beside(std::uint32_t number) {
        beside_.clear();
        std::vector<std::uint32_t> others;
        const auto note = [&](std::uint32_t other) {
            if (other != number && !quads_[other].is_done && std::ranges::find(others, other) == others.end()) others.push_back(other);
        };
        for (const std::uint32_t t : fan_) {
            for (const std::uint32_t code : across_[t]) {
                if (is_half(code)) note((code & ~half_bit) / 2);
            }
        }
        const Quad& q = quads_[number];
        for (std::size_t k = 0; k < 4; ++k) {
            const auto [first, last] = quads_at_.equal_range(pair_key(q.v[k], q.v[(k + 1) % 4]));
            for (auto at = first; at != last; ++at) note(at->second);
        }
        for (const std::uint32_t other : others) {
            const auto p = points(quads_[other]);
            for (std::size_t k = 0; k < 4; ++k) add_half_space(p[k], p[(k + 1) % 4], p[(k + 3) % 4], beside_);
        }
    }

    void close_quad(std::uint32_t number, Closing how) {
        const Quad& q = quads_[number];
        if (q.is_done) return;
        const bool has_fan = how == Closing::open && is_facet(q.behind[0]) && is_facet(q.behind[1]) && find_fan(q);
        if (!has_fan) return give_up(number);
        find_beside(number);
        if (make_pyramid(number) || open(number) || (!beside_.empty() && open_cavity(number))) return;
        beside_.clear();
        if (!make_pyramid(number) && !open(number) && !open_cavity(number)) give_up(number);
    }

    /// Quadrangles that are not done, those first where there is the least room behind.
    std::vector<std::uint32_t> hardest_first(Closing how, const std::map<std::array<std::uint32_t, 2>, int>& urgent) {
        std::vector<std::tuple<int, double, std::uint32_t>> order;
        for (std::uint32_t number = 0; number < quads_.size(); ++number) {
            const Quad& q = quads_[number];
            if (q.is_done) continue;
            const bool has_fan = how == Closing::open && is_facet(q.behind[0]) && is_facet(q.behind[1]) && find_fan(q);
            const auto found = urgent.find({q.cell, q.face});
            order.emplace_back(found != urgent.end() ? -found->second : 0, has_fan ? place_behind(q).quality : 0, number);
        }
        std::ranges::sort(order);
        std::vector<std::uint32_t> numbers;
        for (const auto& [times, room, number] : order) numbers.push_back(number);
        return numbers;
    }

    /// \pre the fan is that of the quadrangle
    ApexPlace place_behind(const Quad& q) const {
        std::vector<Vec3> chain;
        for (const std::uint32_t v : chain_) chain.push_back(positions_[v]);
        return place_for_apex({points(q), chain, beside_});
    }

    void done(std::uint32_t number) {
        Quad& q = quads_[number];
        if (q.is_done) return;
        q.is_done = true;
        if (const auto found = pending_.find(q.diagonal()); found != pending_.end() && --found->second == 0) pending_.erase(found);
    }

    /// The quadrangle is two triangles: what was absorbed is there again.
    void give_up(std::uint32_t number) {
        Quad& q = quads_[number];
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

    /// Two cells with one quadrangle.
    void join(std::uint32_t a, std::uint32_t b) {
        place_far(quads_[a], quads_[b].cell, quads_[b].face);
        place_far(quads_[b], quads_[a].cell, quads_[a].face);
        done(a);
        done(b);
    }
    void place_far(const Quad& q, std::uint32_t cell, std::uint32_t face) {
        for (const std::uint32_t facet : q.far) put_place(facet, cell, face, 0);
    }

    /// A tetrahedron with the corners of the quadrangle becomes a part of it: behind it, the quadrangle has its other diagonal.
    void absorb(std::uint32_t number, std::uint32_t t) {
        Quad& q = quads_[number];
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

    template <class Change>
    void move_pending(Quad& q, const Change& change) {
        const auto found = pending_.find(q.diagonal());
        const bool is_pending = found != pending_.end();
        if (is_pending && --found->second == 0) pending_.erase(found);
        change();
        if (is_pending) ++pending_[q.diagonal()];
    }

    /// What lies across `code` is `other`.
    void link(std::uint32_t code, std::uint32_t other) {
        if (is_facet(code)) across_[code / 4][code % 4] = other;
        else if (is_half(code)) quads_[(code & ~half_bit) / 2].behind[code & 1] = other;
    }

    std::uint32_t index_in(std::uint32_t t, std::uint32_t v) const {
        return static_cast<std::uint32_t>(std::ranges::find(tets_[t], v) - tets_[t].begin());
    }

    /// The tetrahedra around the diagonal behind a quadrangle, and the chain of their other corners.
    bool find_fan(const Quad& q) {
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

    std::array<Vec3, 4> points(const Quad& q) const {
        return {positions_[q.corner(0)], positions_[q.corner(1)], positions_[q.corner(2)], positions_[q.corner(3)]};
    }

    /// The wall facets that the tetrahedra behind have on the quadrangle belong to the pyramid's base.
    std::uint32_t add_pyramid(const Quad& q, std::uint32_t apex) {
        const auto cell = static_cast<std::uint32_t>(cells_.size());
        const std::uint32_t tet = tet_of_[fan_.front()];
        cells_.push_back({CellType::pyramid,
                          {q.corner(0), q.corner(1), q.corner(2), q.corner(3), apex, no_index, no_index, no_index},
                          m_.region[tet],
                          tet});
        for (const std::uint32_t code : q.behind) put_place(sources_[code / 4][code % 4], cell, 0, 0);
        place_far(q, cell, 0);
        return cell;
    }

    /// Of two tetrahedra with one apex, where no other quadrangle has yet to be closed along an edge from it.
    bool make_pyramid(std::uint32_t number) {
        const Quad& q = quads_[number];
        if (fan_.size() != 2) return false;
        const std::uint32_t apex = chain_[1];
        for (std::uint32_t k = 0; k < 4; ++k) {
            if (pending_.contains(pair_key(q.corner(k), apex))) return false;
        }
        const auto p = points(q);
        if (!is_valid(CellType::pyramid, std::array{p[0], p[1], p[2], p[3], positions_[apex]})) return false;
        const auto is_in = [&](const HalfSpace& h) { return h.depth(positions_[apex]) > 0; };
        if (!std::ranges::all_of(beside_, is_in)) return false;
        const std::uint32_t cell = add_pyramid(q, apex);
        for (std::uint32_t k = 0; k < 4; ++k) {
            // The side over the edge from corner k to the next is the facet without the other end of the diagonal.
            const std::uint32_t t = fan_[k / 2], local = index_in(t, k == 0 || k == 3 ? q.corner(2) : q.corner(0));
            put_place(sources_[t][local], cell, 1 + k, 0);
            link(across_[t][local], of_cell);
        }
        for (const std::uint32_t t : fan_) alive_[t] = 0;
        ++counts_.pyramids;
        done(number);
        return true;
    }

    bool open(std::uint32_t number) {
        const ApexPlace place = place_behind(quads_[number]);
        if (!(place.quality > 1e-5)) return false;
        const Quad& q = quads_[number];
        const auto apex = static_cast<std::uint32_t>(positions_.size());
        positions_.push_back(place.position);
        new_vertices_.push_back({q.v, m_.region[tet_of_[fan_.front()]]});
        add_pyramid(q, apex);
        const std::uint32_t a = q.corner(0), c = q.corner(2);
        const auto first = static_cast<std::uint32_t>(tets_.size());
        // The tetrahedra at c are new, those at a take the old places.
        for (std::size_t i = 0; i < fan_.size(); ++i) add_at_c(fan_[i], i, first, a, c);
        for (std::size_t i = 0; i < fan_.size(); ++i) {
            const std::uint32_t t = fan_[i], at_c = first + static_cast<std::uint32_t>(i), ia = index_in(t, a), ic = index_in(t, c);
            tets_[t][ic] = apex;
            across_[t][ia] = 4 * at_c + ic;
            sources_[t][ia] = no_index;
            for (std::uint32_t k = 0; k < 4; ++k) {
                if (k == ia || k == ic) continue;
                sources_[t][k] = no_index;
                if (is_half(across_[t][k])) across_[t][k] = of_cell;
            }
        }
        ++counts_.opened;
        done(number);
        return true;
    }

    void add_at_c(std::uint32_t t, std::size_t i, std::uint32_t first, std::uint32_t a, std::uint32_t c) {
        const std::uint32_t ia = index_in(t, a), ic = index_in(t, c), self = first + static_cast<std::uint32_t>(i);
        std::array<std::uint32_t, 4> tet = tets_[t], across = across_[t], source{no_index, no_index, no_index, no_index};
        tet[ia] = static_cast<std::uint32_t>(positions_.size() - 1);
        source[ia] = sources_[t][ia];
        link(across[ia], 4 * self + ia);
        across[ic] = 4 * t + ia;
        for (std::uint32_t k = 0; k < 4; ++k) {
            if (k == ia || k == ic) continue;
            if (is_half(across[k])) across[k] = of_cell;
            else {
                const auto neighbour = static_cast<std::uint32_t>(std::ranges::find(fan_, across[k] / 4) - fan_.begin());
                across[k] = 4 * (first + neighbour) + across[k] % 4;
            }
        }
        tets_.push_back(tet);
        across_.push_back(across);
        sources_.push_back(source);
        tet_of_.push_back(tet_of_[t]);
        alive_.push_back(1);
    }

    /// Where the fan behind a quadrangle leaves no room for a vertex: takes tetrahedra beside it out as well, until there is room for one
    /// that sees all around.
    bool open_cavity(std::uint32_t number) {
        constexpr std::size_t most_faces = 60;
        cavity_ = fan_;
        find_border(number);
        while (border_.size() <= most_faces) {
            const CavityBorder border = border_places();
            const Room room = room_in(border);
            if (is_simple_ && room.depth > 1e-6 && !loses_something()) {
                const ApexPlace place = place_for_apex(border);
                if (place.quality > 1e-5) {
                    fill_cavity(place.position);
                    return true;
                }
            }
            if (!grow(number, room.in_the_way)) return false;
        }
        return false;
    }

    /// Takes the tetrahedron behind one of some triangles of the border, the one that leaves most room.
    bool grow(std::uint32_t number, std::span<const std::uint32_t> triangles) {
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

    bool is_in_cavity(std::uint32_t t) const { return std::ranges::find(cavity_, t) != cavity_.end(); }

    /// Half of a quadrangle that gets a pyramid over the vertex in the cavity.
    bool is_capped(std::uint32_t facet) const {
        const std::uint32_t code = across_[facet / 4][facet % 4];
        return is_half(code) && std::ranges::find(capped_, (code & ~half_bit) / 2) != capped_.end();
    }

    std::array<std::uint32_t, 3> facet(std::uint32_t number) const {
        const auto& tet = tets_[number / 4];
        const auto& c = facet_corners[number % 4];
        return {tet[c[0]], tet[c[1]], tet[c[2]]};
    }

    /// The facets around the cavity, and the quadrangles that have both halves there and all that is behind their diagonal inside.
    void find_border(std::uint32_t number) {
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

    CavityBorder border_places() const {
        CavityBorder border;
        border.also = beside_;
        for (const std::uint32_t number : capped_) border.quads.push_back(points(quads_[number]));
        for (const std::uint32_t f : border_) {
            const auto c = facet(f);
            if (!is_capped(f)) border.triangles.push_back({positions_[c[0]], positions_[c[2]], positions_[c[1]]});
        }
        return border;
    }

    /// Whether a vertex or an edge that stays lies inside of the cavity.
    bool loses_something() const {
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

    /// Pyramids on the capped quadrangles and tetrahedra on the other faces of the border, all over one new vertex.
    void fill_cavity(const Vec3& place) {
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

    /// What two faces of a cavity's border have made meets above their common edge.
    void join_at(std::uint64_t edge, std::array<std::uint32_t, 2> faces, const std::vector<std::uint32_t>& made) {
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

    /// The edge between the two corners of a tetrahedron that are none of two.
    static std::uint64_t pair_key_without(const std::array<std::uint32_t, 4>& tet, std::uint32_t k, std::uint32_t l) {
        std::array<std::uint32_t, 2> ends{};
        std::size_t count = 0;
        for (std::uint32_t n = 0; n < 4; ++n) {
            if (n != k && n != l) ends[count++] = tet[n];
        }
        return pair_key(ends[0], ends[1]);
    }

    MixedMesh finish() {
        for (const Quad& q : quads_) counts_.absorbed += q.absorbed.size();
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

    const TetMesh& m_;
    const Candidates& all_;
    ClosingCounts& counts_;
    std::vector<std::array<std::uint32_t, 4>> tets_, across_, sources_;  ///< sources: facets of the mesh on walls
    std::vector<std::uint32_t> tet_of_;
    std::vector<std::uint8_t> alive_;
    std::vector<Vec3> positions_;
    std::vector<MixedMesh::NewVertex> new_vertices_;
    std::vector<MixedMesh::Cell> cells_;
    std::vector<CellFaceRef> facet_places_;  ///< face: twice the local face, and the half of a quadrangle
    std::vector<Quad> quads_;
    std::vector<std::uint32_t> half_of_;                        ///< per facet of a cell's own tetrahedra; else no_index
    std::unordered_map<std::uint64_t, std::uint32_t> pending_;  ///< diagonals of quadrangles that are not closed yet
    std::vector<OpenQuad> failed_;
    std::vector<std::uint32_t> fan_, chain_;
    std::vector<HalfSpace> beside_;                                   ///< what other quadrangles need
    std::unordered_multimap<std::uint64_t, std::uint32_t> quads_at_;  ///< by edge
    std::vector<std::uint32_t> cavity_, border_, capped_;  ///< tetrahedra, facets around them, quadrangles with both halves there
    bool is_simple_ = false;                               ///< each edge of the border is one of two faces there
    std::vector<std::pair<std::uint64_t, std::uint32_t>> border_edges_;  ///< with the number of the facet in `border_`; ascending
};

}  // namespace

MixedMesh close(const TetMesh& mesh, const Candidates& candidates, std::span<const std::uint32_t> selected, Closing how,
                ClosingCounts& counts, std::vector<std::uint32_t>& failed) {
    std::map<std::array<std::uint32_t, 2>, int> urgent;
    MixedMesh best;
    for (int round = 0; round < 2; ++round) {
        ClosingCounts own;
        Closer closer(mesh, candidates, own);
        MixedMesh made = closer.run(selected, how, urgent);
        std::vector<std::uint32_t> lost;
        for (const OpenQuad& quad : closer.failed()) {
            lost.push_back(selected[quad.cell]);
            ++urgent[{quad.cell, quad.face}];
        }
        std::ranges::sort(lost);
        lost.erase(std::ranges::unique(lost).begin(), lost.end());
        if (round == 0 || lost.size() < failed.size()) {
            best = std::move(made);
            counts = own;
            failed = std::move(lost);
        }
        if (failed.empty()) break;
    }
    return best;
}

}  // namespace geomend::hexes
