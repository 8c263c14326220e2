// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hexes/candidates.h"

namespace geomend::hexes {

/// Which candidates may not stand beside each other, by three tables: the candidates that hold a tetrahedron, those that have a pair of
/// vertices as an edge, and those that have it as the diagonal of a quadrangle. Two are in conflict where they share a tetrahedron, where
/// an edge of one is a diagonal of the other, or where they share a diagonal and not its quadrangle; but those of quadrangles at the end of
/// the mesh have nothing behind them to fit: at the end of a crack the two sides have three corners in common. The pairs of candidates are
/// not kept: there may be a hundred for each.
class Conflicts {
public:
    /// \pre the candidates outlive this. Cost: n log n.
    Conflicts(const Candidates& candidates, std::size_t tets);

    std::size_t size() const { return all_.size(); }
    const Candidates& candidates() const { return all_; }

    /// Calls visit(j) once for each candidate j in conflict with i, in an order that depends on nothing but the candidates.
    /// \param seen one number per candidate, that of the last call which came by; `mark` is a number that was not used before
    template <class Visit>
    void visit(std::uint32_t i, std::vector<std::uint32_t>& seen, std::uint32_t mark, const Visit& visit) const {
        seen[i] = mark;
        const auto meet = [&](std::uint32_t j) {
            if (seen[j] == mark) return;
            seen[j] = mark;
            visit(j);
        };
        for (const std::uint32_t t : all_.tets_of(i)) {
            for (const std::uint32_t j : by_tet_.at(t)) meet(j);
        }
        for (const std::uint32_t pair : edges_of(i)) {
            for (const Diagonal& other : by_diagonal_.at(pair)) meet(other.candidate);
        }
        for (const Diagonal& own : diagonals_of(i)) {
            for (const std::uint32_t j : by_edge_.at(own.pair)) meet(j);
            for (const Diagonal& other : by_diagonal_.at(own.pair)) {
                if (other.pair != own.other) meet(other.candidate);
            }
        }
    }

    /// How many pairs are in conflict. Cost: as many
    std::uint64_t count() const;

    /// The numbers of pairs of vertices that are edges of a candidate, and of those that are diagonals.
    struct Diagonal {
        std::uint32_t pair;   ///< the pair itself; in the table by pairs: the quadrangle's other diagonal
        std::uint32_t other;  ///< the quadrangle's other diagonal
        std::uint32_t candidate;
    };
    std::span<const std::uint32_t> edges_of(std::uint32_t i) const {
        return {edges_.data() + edge_offsets_[i], edges_.data() + edge_offsets_[i + 1]};
    }
    std::span<const Diagonal> diagonals_of(std::uint32_t i) const {
        return {diagonals_.data() + diagonal_offsets_[i], diagonals_.data() + diagonal_offsets_[i + 1]};
    }
    std::size_t pair_count() const { return pairs_; }

private:
    template <class Row>
    struct Table {
        std::vector<std::uint64_t> offsets;
        std::vector<Row> rows;
        std::span<const Row> at(std::uint32_t key) const { return {rows.data() + offsets[key], rows.data() + offsets[key + 1]}; }
    };
    template <class Row, class Each>
    static Table<Row> table_of(std::size_t keys, const Each& each);
    void number_pairs();

    const Candidates& all_;
    std::size_t pairs_ = 0;
    std::vector<std::uint64_t> edge_offsets_{0}, diagonal_offsets_{0};
    std::vector<std::uint32_t> edges_;
    std::vector<Diagonal> diagonals_;
    Table<std::uint32_t> by_tet_, by_edge_;
    Table<Diagonal> by_diagonal_;
};

/// Whether two candidates may stand beside each other, decided by their corners and tetrahedra alone: no common tetrahedron, and nothing,
/// a corner, a common edge or a common face between them. For tests and for results; slower than the tables by far.
bool stand_together(const Candidates& candidates, std::uint32_t a, std::uint32_t b);

}  // namespace geomend::hexes
