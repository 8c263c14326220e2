// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/conflicts.h"

#include <algorithm>
#include <numeric>

#include "base/parallel.h"
#include "model/cell_faces.h"

namespace geomend::hexes {

namespace {

/// Numbers of pairs of vertices, ascending by the lower one, then the other.
class PairNumbers {
public:
    /// \param each calls what it is given with both vertices of each pair, as often as there are some; twice in the same order
    template <class Each>
    PairNumbers(std::size_t vertices, const Each& each) : first_(vertices + 1, 0) {
        each([&](std::uint32_t a, std::uint32_t b) { ++first_[std::min(a, b) + 1]; });
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        others_.resize(first_.back());
        std::vector<std::uint64_t> next(first_.begin(), first_.end() - 1);
        each([&](std::uint32_t a, std::uint32_t b) { others_[next[std::min(a, b)]++] = std::max(a, b); });
        leave_once();
    }
    std::uint32_t of(std::uint32_t a, std::uint32_t b) const {
        const auto begin = others_.begin() + static_cast<std::ptrdiff_t>(first_[std::min(a, b)]),
                   end = others_.begin() + static_cast<std::ptrdiff_t>(first_[std::min(a, b) + 1]);
        return static_cast<std::uint32_t>(std::lower_bound(begin, end, std::max(a, b)) - others_.begin());
    }
    std::size_t size() const { return others_.size(); }

private:
    void leave_once() {
        std::uint64_t next = 0;
        for (std::size_t v = 0; v + 1 < first_.size(); ++v) {
            const auto begin = others_.begin() + static_cast<std::ptrdiff_t>(first_[v]),
                       end = others_.begin() + static_cast<std::ptrdiff_t>(first_[v + 1]);
            std::sort(begin, end);
            first_[v] = next;
            for (auto at = begin; at != end; ++at) {
                if (at == begin || *at != others_[next - 1]) others_[next++] = *at;
            }
        }
        first_.back() = next;
        others_.resize(next);
        others_.shrink_to_fit();
    }

    std::vector<std::uint64_t> first_;
    std::vector<std::uint32_t> others_;
};

bool has_edge(const Candidates& all, std::uint32_t i, std::uint32_t a, std::uint32_t b) {
    const auto& c = all.corners[i];
    return std::ranges::any_of(edges_of(all.types[i]),
                               [&](const auto& e) { return (c[e[0]] == a && c[e[1]] == b) || (c[e[0]] == b && c[e[1]] == a); });
}

/// Whether a candidate has a face with these corners; \param across of a quadrangle the one opposite to the first, or no_index
bool has_face(const Candidates& all, std::uint32_t i, const std::vector<std::uint32_t>& corners, std::uint32_t across) {
    for (const LocalFace& face : faces_of(all.types[i])) {
        const auto local = face.corners();
        if (local.size() != corners.size()) continue;
        std::size_t common = 0, first = 0;
        for (std::size_t k = 0; k < local.size(); ++k) {
            const std::uint32_t v = all.corners[i][local[k]];
            if (std::ranges::find(corners, v) != corners.end()) ++common;
            if (v == corners.front()) first = k;
        }
        if (common != corners.size()) continue;
        if (local.size() == 3 || all.corners[i][local[(first + 2) % 4]] == across) return true;
    }
    return false;
}

/// The corner opposite to the first one on the quadrangle with these four corners, or no_index.
std::uint32_t across_in(const Candidates& all, std::uint32_t i, const std::vector<std::uint32_t>& corners) {
    for (const std::uint32_t v : corners) {
        if (v != corners.front() && has_face(all, i, corners, v)) return v;
    }
    return no_index;
}

}  // namespace

template <class Row, class Each>
Conflicts::Table<Row> Conflicts::table_of(std::size_t keys, const Each& each) {
    Table<Row> table;
    table.offsets.assign(keys + 1, 0);
    each([&](std::uint32_t key, const Row&) { ++table.offsets[key + 1]; });
    std::partial_sum(table.offsets.begin(), table.offsets.end(), table.offsets.begin());
    table.rows.resize(table.offsets.back());
    std::vector<std::uint64_t> next(table.offsets.begin(), table.offsets.end() - 1);
    each([&](std::uint32_t key, const Row& row) { table.rows[next[key]++] = row; });
    return table;
}

Conflicts::Conflicts(const Candidates& candidates, std::size_t tets) : all_(candidates) {
    number_pairs();
    const auto count = static_cast<std::uint32_t>(all_.size());
    by_tet_ = table_of<std::uint32_t>(tets, [&](const auto& put) {
        for (std::uint32_t i = 0; i < count; ++i) {
            for (const std::uint32_t t : all_.tets_of(i)) put(t, i);
        }
    });
    by_edge_ = table_of<std::uint32_t>(pairs_, [&](const auto& put) {
        for (std::uint32_t i = 0; i < count; ++i) {
            for (const std::uint32_t pair : edges_of(i)) put(pair, i);
        }
    });
    by_diagonal_ = table_of<Diagonal>(pairs_, [&](const auto& put) {
        for (std::uint32_t i = 0; i < count; ++i) {
            for (const Diagonal& d : diagonals_of(i)) put(d.pair, Diagonal{d.other, d.other, i});
        }
    });
}

void Conflicts::number_pairs() {
    std::size_t vertices = 0;
    for (std::uint32_t i = 0; i < all_.size(); ++i) {
        for (const std::uint32_t v : all_.corners_of(i)) vertices = std::max(vertices, std::size_t{v} + 1);
    }
    const auto visit_edges = [&](std::uint32_t i, const auto& visit) {
        const auto& c = all_.corners[i];
        for (const auto& e : geomend::edges_of(all_.types[i])) visit(c[e[0]], c[e[1]]);
    };
    const auto visit_diagonals = [&](std::uint32_t i, const auto& visit) {
        const auto& c = all_.corners[i];
        std::uint32_t number = 0;
        for (const LocalFace& face : faces_of(all_.types[i])) {
            const auto f = face.corners();
            const bool matters = f.size() == 4 && (all_.ends[i] >> number & 1u) == 0;
            ++number;
            for (std::size_t k = 0; matters && k < 2; ++k) visit(c[f[k]], c[f[k + 2]]);
        }
    };
    std::size_t edges = 0, diagonals = 0;
    const PairNumbers numbers(vertices, [&](const auto& visit) {
        edges = diagonals = 0;
        for (std::uint32_t i = 0; i < all_.size(); ++i) {
            visit_edges(i, [&](std::uint32_t a, std::uint32_t b) { ++edges, visit(a, b); });
            visit_diagonals(i, [&](std::uint32_t a, std::uint32_t b) { ++diagonals, visit(a, b); });
        }
    });
    pairs_ = numbers.size();
    edges_.reserve(edges);
    diagonals_.reserve(diagonals);
    edge_offsets_.reserve(all_.size() + 1);
    diagonal_offsets_.reserve(all_.size() + 1);
    for (std::uint32_t i = 0; i < all_.size(); ++i) {
        visit_edges(i, [&](std::uint32_t a, std::uint32_t b) { edges_.push_back(numbers.of(a, b)); });
        visit_diagonals(i, [&](std::uint32_t a, std::uint32_t b) { diagonals_.push_back({numbers.of(a, b), 0, i}); });
        edge_offsets_.push_back(edges_.size());
        diagonal_offsets_.push_back(diagonals_.size());
    }
    for (std::size_t d = 0; d < diagonals_.size(); ++d) diagonals_[d].other = diagonals_[d ^ 1].pair;
}

std::uint64_t Conflicts::count() const {
    std::vector<std::uint32_t> seen(size(), no_index);
    std::uint64_t twice = 0;
    for (std::uint32_t i = 0; i < size(); ++i) visit(i, seen, i, [&](std::uint32_t) { ++twice; });
    return twice / 2;
}

bool stand_together(const Candidates& all, std::uint32_t a, std::uint32_t b) {
    for (const std::uint32_t t : all.tets_of(a)) {
        if (std::ranges::find(all.tets_of(b), t) != all.tets_of(b).end()) return false;
    }
    std::vector<std::uint32_t> common;
    for (const std::uint32_t v : all.corners_of(a)) {
        if (std::ranges::find(all.corners_of(b), v) != all.corners_of(b).end()) common.push_back(v);
    }
    switch (common.size()) {
        case 0:
        case 1:
            return true;
        case 2:
            return has_edge(all, a, common[0], common[1]) && has_edge(all, b, common[0], common[1]);
        case 3:
            return has_face(all, a, common, no_index) && has_face(all, b, common, no_index);
        case 4: {
            const std::uint32_t across = across_in(all, a, common);
            return across != no_index && has_face(all, b, common, across);
        }
        default:
            return false;
    }
}

}  // namespace geomend::hexes
