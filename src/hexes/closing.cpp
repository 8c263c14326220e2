// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/closing.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "base/vectors.h"
#include "hexes/closing_cavity.h"
#include "hexes/jacobian.h"
#include "hexes/open_diagonal.h"
#include "model/cell_faces.h"

namespace geomend::hexes {

namespace {

/// Closes the quadrangles of a front one after the other.
class Closer : private CavityFront {
public:
    Closer(const TetMesh& mesh, const Candidates& candidates, ClosingCounts& counts) : CavityFront(mesh, candidates, counts) {}

    /// \param urgent per cell and face how often that quadrangle could not be closed before: it comes the earlier for it
    MixedMesh run(std::span<const std::uint32_t> selected, Closing how, const std::map<std::array<std::uint32_t, 2>, int>& urgent) {
        for (const std::uint32_t i : selected) add_cell(i);
        link_quads();
        for (const FrontQuad& q : quads_) {
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
        const FrontQuad& q = quads_[number];
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
        const FrontQuad& q = quads_[number];
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
            const FrontQuad& q = quads_[number];
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
    ApexPlace place_behind(const FrontQuad& q) const {
        std::vector<Vec3> chain;
        for (const std::uint32_t v : chain_) chain.push_back(positions_[v]);
        return place_for_apex({points(q), chain, beside_});
    }

    /// Of two tetrahedra with one apex, where no other quadrangle has yet to be closed along an edge from it.
    bool make_pyramid(std::uint32_t number) {
        const FrontQuad& q = quads_[number];
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
        if (!(place.quality > shape_wanted(fan_))) return false;
        const FrontQuad& q = quads_[number];
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

    std::unordered_multimap<std::uint64_t, std::uint32_t> quads_at_;  ///< by edge
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
