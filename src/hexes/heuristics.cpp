// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/heuristics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <queue>

#include "base/vectors.h"
#include "hexes/cotree.h"
#include "hexes/random.h"
#include "hexes/selection.h"
#include "model/cell_faces.h"

namespace geomend::hexes {

namespace {

double sine_at(const Vec3& at, const Vec3& a, const Vec3& b) {
    const Vec3 u = minus(a, at), v = minus(b, at), n = cross(u, v);
    const double lengths = std::sqrt(dot(u, u) * dot(v, v));
    return lengths > 0 ? std::sqrt(dot(n, n)) / lengths : 0;
}

/// Candidates in the way of those taken are out.
class Taking {
public:
    explicit Taking(const Conflicts& conflicts) : c_(conflicts), is_out_(conflicts.size(), 0), seen_(conflicts.size(), no_index) {}
    bool may(std::uint32_t i) const { return is_out_[i] == 0; }
    void take(std::uint32_t i) {
        selected.push_back(i);
        is_out_[i] = 1;
        c_.visit(i, seen_, i, [&](std::uint32_t j) { is_out_[j] = 1; });
    }
    std::vector<std::uint32_t> selected;

private:
    const Conflicts& c_;
    std::vector<std::uint8_t> is_out_;
    std::vector<std::uint32_t> seen_;
};

std::vector<std::uint32_t> shuffled(std::size_t count) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    Random random(1);
    for (auto i = static_cast<std::uint32_t>(count); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    return order;
}

/// From tetrahedron to tetrahedron, starting anew where none is left beside those that were seen.
std::vector<std::uint32_t> by_tetrahedra(const TetMesh& mesh, const Conflicts& conflicts, std::span<const double> weights) {
    const Candidates& all = conflicts.candidates();
    std::vector<std::vector<std::uint32_t>> of_tet(mesh.tets.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) {
        for (const std::uint32_t t : all.tets_of(i)) of_tet[t].push_back(i);
    }
    Taking taking(conflicts);
    std::vector<std::uint8_t> is_seen(mesh.tets.size(), 0);
    std::queue<std::uint32_t> open;
    const auto see = [&](std::uint32_t t) {
        if (is_seen[t] != 0) return;
        is_seen[t] = 1;
        open.push(t);
    };
    for (const std::uint32_t start : shuffled(mesh.tets.size())) {
        see(start);
        for (; !open.empty(); open.pop()) {
            const std::uint32_t t = open.front();
            std::uint32_t best = no_index;
            for (const std::uint32_t i : of_tet[t]) {
                if (taking.may(i) && (best == no_index || weights[i] > weights[best])) best = i;
            }
            if (best != no_index) taking.take(best);
            for (const std::uint32_t other : mesh.across[t]) {
                if (other != no_index) see(other / 4);
            }
        }
    }
    return taking.selected;
}

enum class Order : std::uint8_t { random, heaviest, lightest };

std::vector<std::uint32_t> by_cograph(const Conflicts& conflicts, std::span<const double> weights, Order order, bool complement) {
    std::vector<std::uint32_t> all = shuffled(conflicts.size());
    if (order == Order::heaviest) std::ranges::stable_sort(all, std::greater<>(), [&](std::uint32_t i) { return weights[i]; });
    if (order == Order::lightest) std::ranges::stable_sort(all, std::less<>(), [&](std::uint32_t i) { return weights[i]; });
    Cotree tree(conflicts.size(), complement);
    std::vector<std::uint32_t> seen(conflicts.size(), no_index), neighbours;
    for (const std::uint32_t i : all) {
        neighbours.clear();
        conflicts.visit(i, seen, i, [&](std::uint32_t j) { neighbours.push_back(j); });
        tree.insert(i, neighbours);
    }
    std::vector<std::uint32_t> selected = tree.heaviest(weights);
    if (!complement) return selected;
    // Conflicts were left out of the complement: of those in conflict the heaviest stay.
    std::ranges::stable_sort(selected, std::greater<>(), [&](std::uint32_t i) { return weights[i]; });
    Taking taking(conflicts);
    for (const std::uint32_t i : selected) {
        if (taking.may(i)) taking.take(i);
    }
    return taking.selected;
}

}  // namespace

std::optional<Heuristic> heuristic_named(std::string_view name) {
    const auto found = std::ranges::find(heuristic_names, name);
    if (found == heuristic_names.end()) return std::nullopt;
    return static_cast<Heuristic>(found - heuristic_names.begin());
}

std::vector<double> weights_by_angles(const TetMesh& mesh, const Candidates& candidates) {
    std::vector<double> weights(candidates.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
        double sum = 0;
        int count = 0;
        const auto at = [&](std::uint8_t k) { return mesh.positions[candidates.corners[i][k]]; };
        for (const LocalFace& face : faces_of(candidates.types[i])) {
            const auto c = face.corners();
            for (std::size_t k = 0; c.size() == 4 && k < 4; ++k, ++count) sum += sine_at(at(c[k]), at(c[(k + 1) % 4]), at(c[(k + 3) % 4]));
        }
        const CellType type = candidates.types[i];
        weights[i] = (type == CellType::hexahedron ? 10 : type == CellType::wedge ? 4 : 0) + sum / count;
    }
    return weights;
}

std::vector<std::uint32_t> select_by(Heuristic rule, const TetMesh& mesh, const Conflicts& conflicts, std::span<const double> weights) {
    const auto greedy = [&](Greedy how) { return select_greedily(conflicts, weights, how); };
    std::vector<std::uint32_t> selected;
    switch (rule) {
        case Heuristic::search:
        case Heuristic::gmax1:
            return greedy(Greedy::weight);
        case Heuristic::gmax2:
            return greedy(Greedy::weight_by_degree);
        case Heuristic::gmax3:
            return greedy(Greedy::weight_by_sum);
        case Heuristic::gmax4:
            return greedy(Greedy::weight_less_sum);
        case Heuristic::gtet:
            selected = by_tetrahedra(mesh, conflicts, weights);
            break;
        case Heuristic::cograph_rand:
        case Heuristic::cograph_max:
        case Heuristic::cograph_min:
        case Heuristic::comp_cograph_rand:
        case Heuristic::comp_cograph_max:
        case Heuristic::comp_cograph_min: {
            const bool complement = rule >= Heuristic::comp_cograph_rand;
            const auto first = complement ? Heuristic::comp_cograph_rand : Heuristic::cograph_rand;
            const auto order = static_cast<Order>(static_cast<int>(rule) - static_cast<int>(first));
            selected = by_cograph(conflicts, weights, order, complement);
            break;
        }
    }
    std::ranges::sort(selected);
    return selected;
}

}  // namespace geomend::hexes
