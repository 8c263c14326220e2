// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/self_joints.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <span>
#include <tuple>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/vectors.h"
#include "model/objects.h"
#include "repair/soup_edges.h"

namespace geomend::repair {

namespace {

/// A soup in pieces of one patch between lines, with lines along some inner edges besides.
struct PartedSoup {
    const TriangleSoup& soup;
    SoupEdges edges;
    std::vector<std::uint8_t> is_joint;  ///< per edge
    std::vector<std::uint32_t> piece;    ///< per triangle the first one of its piece

    explicit PartedSoup(const TriangleSoup& s) : soup(s), edges(edges_of(s)), is_joint(edges.size(), 0) { find_pieces(); }

    bool joins(std::size_t e) const { return is_joint[e] == 0 && is_inner(soup, edges[e]); }
    void find_pieces() {
        DisjointSets sets(soup.triangles.size());
        for (std::size_t e = 0; e < edges.size(); ++e) {
            if (joins(e)) sets.join(edges[e][0].triangle, edges[e][1].triangle);
        }
        piece = std::move(sets).roots();
    }
    /// The uses of an edge by pieces that use it more than twice, piece by piece.
    std::vector<SoupEdges::Use> crowd(std::size_t e) const {
        std::vector<SoupEdges::Use> uses;
        if (edges[e].size() < 3) return uses;
        for (const auto& use : edges[e]) {
            const auto same = std::ranges::count_if(edges[e], [&](const auto& o) { return piece[o.triangle] == piece[use.triangle]; });
            if (same > 2) uses.push_back(use);
        }
        std::ranges::stable_sort(uses, {}, [&](const auto& use) { return piece[use.triangle]; });
        return uses;
    }
    /// Per triangle that is the first one of its piece whether the piece is not manifold. Empty: all are.
    std::vector<std::uint8_t> crowded() const {
        std::vector<std::uint8_t> found;
        for (std::size_t e = 0; e < edges.size(); ++e) {
            for (const auto& use : crowd(e)) {
                found.resize(piece.size(), 0);
                found[piece[use.triangle]] = 1;
            }
        }
        return found;
    }
    /// Away from an edge within a triangle, square to the edge, of length 1; 0 where the triangle is flat.
    Vec3 away(const SoupEdges::Use& use) const {
        const Vec3 &a = soup.vertices[use.low], &b = soup.vertices[use.high];
        const Vec3 along = minus(b, a), w = minus(soup.vertices[soup.triangles[use.triangle][(use.corner + 2) % 3]], a);
        const Vec3 off = minus(w, times(dot(w, along) / dot(along, along), along));
        const double size = std::sqrt(dot(off, off));
        return size > 0 ? times(1 / size, off) : Vec3{};
    }
    /// 0 where two triangles go on straight over an edge, 2 where one is folded onto the other.
    double bend(const SoupEdges::Use& one, const SoupEdges::Use& other) const { return 1 + dot(away(one), away(other)); }
};

/// Parts that were apart when the model was read stay so.
void part_as_read(const SurfaceModel& model, const std::vector<std::uint8_t>& crowded, PartedSoup& parted) {
    const PatchPieces parts = pieces_between_lines(model.source, edges_of(model.source));
    const auto part_of = [&](std::uint32_t t) {
        const std::uint32_t source = model.origin.triangles[t];
        return source == no_index ? no_index : parts.of[source];
    };
    for (std::size_t e = 0; e < parted.edges.size(); ++e) {
        const auto uses = parted.edges[e];
        if (!parted.joins(e) || crowded[parted.piece[uses[0].triangle]] == 0) continue;
        const std::uint32_t one = part_of(uses[0].triangle), other = part_of(uses[1].triangle);
        parted.is_joint[e] = one != other && one != no_index && other != no_index ? 1 : 0;
    }
}

/// Sheets of pieces that are not manifold, from the edges where too many meet: of those the two that go on straightest are one sheet, the
/// others another. Both grow over the least bent edges first, and meet where the surface is bent most.
class SheetGrowth {
public:
    explicit SheetGrowth(PartedSoup& parted) : parted_(parted), sheet_(parted.piece.size(), 0), over_(parted.piece.size()) {
        for (auto& over : over_) over.fill(no_index);
        for (std::size_t e = 0; e < parted.edges.size(); ++e) {
            if (!parted.joins(e)) continue;
            for (const auto& use : parted.edges[e]) over_[use.triangle][use.corner] = static_cast<std::uint32_t>(e);
        }
    }

    void part() {
        for (std::size_t e = 0; e < parted_.edges.size(); ++e) seed(parted_.crowd(e));
        while (!front_.empty()) {
            const auto [bend, triangle, sheet] = front_.top();
            front_.pop();
            take(triangle, sheet);
        }
        for (std::size_t e = 0; e < parted_.edges.size(); ++e) {
            if (!parted_.joins(e)) continue;
            const auto uses = parted_.edges[e];
            if (sheet_[uses[0].triangle] != sheet_[uses[1].triangle]) parted_.is_joint[e] = 1;
        }
    }

private:
    using Step = std::tuple<double, std::uint32_t, std::uint8_t>;  ///< bend, triangle, sheet
    PartedSoup& parted_;
    std::vector<std::uint8_t> sheet_;                 ///< per triangle; 0: none yet
    std::vector<std::array<std::uint32_t, 3>> over_;  ///< per corner of a triangle the edge over which it hangs together with another
    std::priority_queue<Step, std::vector<Step>, std::greater<>> front_;

    void seed(std::span<const SoupEdges::Use> uses) {
        while (!uses.empty()) {
            std::size_t n = 1;
            while (n < uses.size() && parted_.piece[uses[n].triangle] == parted_.piece[uses[0].triangle]) ++n;
            std::array<std::size_t, 2> straightest{0, 1};
            double least = 3;
            for (std::size_t i = 0; i < n; ++i) {
                for (std::size_t j = i + 1; j < n; ++j) {
                    const double bend = parted_.bend(uses[i], uses[j]);
                    if (bend < least) least = bend, straightest = {i, j};
                }
            }
            for (std::size_t i = 0; i < n; ++i) {
                const bool goes_through = i == straightest[0] || i == straightest[1];
                take(uses[i].triangle, goes_through ? 1 : 2);
            }
            uses = uses.subspan(n);
        }
    }

    void take(std::uint32_t triangle, std::uint8_t sheet) {
        if (sheet_[triangle] != 0) return;
        sheet_[triangle] = sheet;
        for (const std::uint32_t e : over_[triangle]) {
            if (e == no_index) continue;
            const auto uses = parted_.edges[e];
            const std::uint32_t other = uses[uses[0].triangle == triangle ? 1 : 0].triangle;
            if (sheet_[other] == 0) front_.emplace(parted_.bend(uses[0], uses[1]), other, sheet);
        }
    }
};

}  // namespace

std::vector<std::array<std::uint32_t, 2>> self_joints(const SurfaceModel& model) {
    PartedSoup parted(model.model.soup);
    const auto crowded = parted.crowded();
    if (crowded.empty()) return {};
    part_as_read(model, crowded, parted);
    parted.find_pieces();
    if (!parted.crowded().empty()) SheetGrowth(parted).part();
    std::vector<std::array<std::uint32_t, 2>> joints;
    for (std::size_t e = 0; e < parted.edges.size(); ++e) {
        if (parted.is_joint[e] != 0) joints.push_back({parted.edges[e][0].low, parted.edges[e][0].high});
    }
    return joints;
}

}  // namespace geomend::repair
