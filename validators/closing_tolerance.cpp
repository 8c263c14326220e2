// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/closing_tolerance.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "topology/near_weld.h"

namespace geomend::validators {

namespace {

constexpr std::size_t most_tries = 3;

/// Numbers of one digit above a length, up to another one; exact decimals as far as doubles have them.
std::vector<double> one_digit_between(double above, double up_to) {
    std::vector<double> lengths;
    if (!(above > 0) || !(up_to > above)) return lengths;
    for (int power = static_cast<int>(std::floor(std::log10(above))); lengths.size() < 200; ++power) {
        for (int digit = 1; digit <= 9; ++digit) {
            const double length = power < 0 ? digit / std::pow(10.0, -power) : digit * std::pow(10.0, power);
            if (length > up_to) return lengths;
            if (length > above) lengths.push_back(length);
        }
    }
    return lengths;
}

std::size_t count_within(std::span<const Vec3> points, double length) {
    const auto first = topology::clusters_within(points, length);
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < first.size(); ++i) count += first[i] == i ? 1 : 0;
    return count;
}

/// Lengths from which on for a while no more points become one.
struct Rest {
    double from = 0, up_to = 0;
    double ratio() const { return up_to / from; }
};

/// \param count_at how many are apart still at a length  \param before at the first one
template <class CountAt>
std::vector<Rest> rests_between(double tolerance, double near, std::size_t before, const CountAt& count_at) {
    std::vector<Rest> rests;
    for (const double length : one_digit_between(tolerance, near)) {
        const std::size_t count = count_at(length);
        if (count < before) rests.push_back({length, length});
        else if (!rests.empty()) rests.back().up_to = length;
        before = count;
    }
    // Nothing is looked for beyond `near`: what rests there rests on.
    if (!rests.empty() && rests.back().up_to > rests.back().from) rests.back().up_to = std::max(rests.back().up_to, 2 * rests.back().from);
    std::erase_if(rests, [](const Rest& rest) { return rest.ratio() < 2; });
    return rests;
}

std::vector<Rest> rests_of(const BorderPoints& model) {
    return rests_between(model.tolerance, model.near, model.positions.size(),
                         [&](double length) { return count_within(model.positions, length); });
}

/// The lengths at which the longest rests begin, ascending.
std::vector<double> longest_of(std::vector<Rest> rests) {
    std::ranges::stable_sort(rests, [](const Rest& a, const Rest& b) { return a.ratio() > b.ratio(); });
    if (rests.size() > most_tries) rests.resize(most_tries);
    std::vector<double> tolerances;
    tolerances.reserve(rests.size());
    for (const Rest& rest : rests) tolerances.push_back(rest.from);
    std::ranges::sort(tolerances);
    return tolerances;
}

}  // namespace

BorderPoints border_points(const ModelScope& scope) {
    BorderPoints points;
    std::vector<std::uint32_t> vertices;
    for (const auto& edge : scope.model().graph.edges) {
        for (const auto& use : scope.model().graph.edge_uses(edge)) {
            vertices.insert(vertices.end(), {use.low, use.high});
            if (use.surface == no_index) continue;
            const Lengths& lengths = scope.lengths(use.surface);
            points.tolerance = points.tolerance > 0 ? std::min(points.tolerance, lengths.tolerance) : lengths.tolerance;
            points.near = std::max(points.near, lengths.near);
        }
    }
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const std::uint32_t v : vertices) points.positions.push_back(scope.brep().vertices[v]);
    return points;
}

std::vector<double> tolerances_to_try(std::span<const BorderPoints> models) {
    std::vector<Rest> rests;
    for (const BorderPoints& model : models) {
        for (const Rest& rest : rests_of(model)) {
            const auto same = std::ranges::find(rests, rest.from, &Rest::from);
            if (same == rests.end()) rests.push_back(rest);
            else same->up_to = std::max(same->up_to, rest.up_to);
        }
    }
    return longest_of(std::move(rests));
}

std::vector<double> tolerances_to_try(std::span<const double> lengths, double tolerance, double near) {
    std::vector<double> sorted(lengths.begin(), lengths.end());
    std::ranges::sort(sorted);
    const auto above = [&](double length) { return static_cast<std::size_t>(sorted.end() - std::ranges::upper_bound(sorted, length)); };
    return longest_of(rests_between(tolerance, near, above(tolerance), above));
}

Result<std::optional<ClosingTolerance>> closing_tolerance(std::span<const double> tolerances, std::uint64_t errors,
                                                          const std::function<Result<std::uint64_t>(double)>& errors_at) {
    constexpr std::uint64_t many = 10;
    std::optional<ClosingTolerance> best;
    for (const double tolerance : tolerances) {
        const auto left = errors_at(tolerance);
        if (!left) return left.why();
        const ClosingTolerance closing{tolerance, errors, *left};
        if (*left == 0) return std::optional(closing);
        if (errors >= many && many * *left <= errors && (!best || *left < best->left)) best = closing;
    }
    return best;
}

}  // namespace geomend::validators
