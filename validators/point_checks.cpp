// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <string>

#include "base/disjoint_sets.h"
#include "topology/near_weld.h"
#include "topology/weld.h"
#include "validators/cell_findings.h"
#include "validators/object_checks.h"

namespace geomend::validators {

namespace {

/// The points of an object that M01 looks at: of polylines those that an edge uses.
std::vector<std::uint8_t> judged_points(const ObjectScope& scope) {
    const auto* lines = scope.as<PolylineSet>();
    std::vector<std::uint8_t> judged(scope.points().size(), lines == nullptr ? 1 : 0);
    if (lines == nullptr) return judged;
    for (const auto& edge : lines->edges) judged[edge[0]] = judged[edge[1]] = 1;
    return judged;
}

/// Points at different positions: the first one at each, and which of them each point stands at.
struct Positions {
    std::vector<std::uint32_t> first_point, position_of;
    std::vector<Vec3> positions;
};

Positions positions_of(const ObjectScope& scope) {
    const auto judged = judged_points(scope);
    Positions all;
    topology::Welder welder(scope.points().size());
    all.position_of.assign(judged.size(), no_index);
    for (std::uint32_t p = 0; p < judged.size(); ++p) {
        if (judged[p] == 0) continue;
        const std::uint32_t position = welder.add(scope.points()[p]);
        if (position == all.first_point.size()) all.first_point.push_back(p);
        all.position_of[p] = position;
    }
    all.positions = welder.take_positions();
    return all;
}

bool differ(const Attribute& a, std::uint32_t p, std::uint32_t q) {
    for (std::uint32_t c = 0; c < a.components; ++c) {
        const std::size_t i = std::size_t{p} * a.components + c, j = std::size_t{q} * a.components + c;
        const bool same =
            std::visit([&](const auto& v) { return v[i] == v[j] || (v[i] != v[i] && v[j] != v[j]); }, a.values);  // NaN is like NaN
        if (!same) return true;
    }
    return false;
}

/// Points of a set that have no position of their own, unless the file says that they share that of another one.
void tell_equal_points(const ObjectScope& scope, const PointSet& set, const Positions& at, std::vector<Finding>& findings) {
    std::vector<std::uint32_t> repeats;
    std::uint64_t other_values = 0;
    for (std::uint32_t p = 0; p < at.position_of.size(); ++p) {
        const std::uint32_t first = at.first_point[at.position_of[p]];
        if (first == p || (p < set.alias.size() && set.alias[p] != no_index)) continue;
        repeats.push_back(p);
        other_values += std::ranges::any_of(set.info.attributes, [&](const Attribute& a) {
            const bool fits = a.location == AttributeLocation::point && value_count(a) == set.points.size() * a.components;
            return fits && differ(a, first, p);
        });
    }
    if (repeats.empty()) return;
    std::string message = counted(repeats.size(), "point", "points") + of_object(scope) + (repeats.size() == 1 ? " lies" : " lie") +
                          " where another one is" + (at.positions.size() == 1 ? ": all points are at one position" : "");
    if (other_values > 0) message += "; " + std::to_string(other_values) + " with other values of properties";
    Finding finding = object_finding(scope, "M10", std::move(message));
    list_points(scope, repeats, finding);
    finding.measures = {{"with_other_values", static_cast<double>(other_values)}};
    findings.push_back(std::move(finding));
}

}  // namespace

void check_point_positions(const ObjectScope& scope, std::vector<Finding>& findings) {
    const auto* set = scope.as<PointSet>();
    const auto* lines = scope.as<PolylineSet>();
    if ((set == nullptr && lines == nullptr) || scope.points().empty()) return;
    const Positions at = positions_of(scope);
    if (set != nullptr) tell_equal_points(scope, *set, at, findings);
    const double tolerance = scope.lengths().tolerance;
    if (tolerance <= 0 || at.positions.size() < 2) return;
    const auto cluster = topology::clusters_within(at.positions, tolerance);
    DisjointSets joined(at.positions.size());  // by edges without length, which M11 tells
    if (lines != nullptr) {
        for (const auto& edge : lines->edges) {
            const std::uint32_t a = at.position_of[edge[0]], b = at.position_of[edge[1]];
            if (cluster[a] == cluster[b]) joined.join(a, b);
        }
    }
    std::vector<std::uint32_t> near;
    for (std::uint32_t i = 0; i < cluster.size(); ++i) {
        if (joined.root(i) == i && joined.root(cluster[i]) != i) near.push_back(at.first_point[i]);
    }
    if (near.empty()) return;
    Finding finding = object_finding(scope, "M01",
                                     counted(near.size(), "point", "points") + of_object(scope) + (near.size() == 1 ? " is" : " are") +
                                         " nearer than " + rounded(tolerance) + " to another one, but not equal");
    list_points(scope, near, finding);
    findings.push_back(std::move(finding));
}

void check_unused_points(const ObjectScope& scope, std::vector<Finding>& findings) {
    const auto* lines = scope.as<PolylineSet>();
    if (lines == nullptr) return;
    const auto used = judged_points(scope);
    std::vector<std::uint32_t> unused;
    for (std::uint32_t p = 0; p < used.size(); ++p) {
        if (used[p] == 0) unused.push_back(p);
    }
    if (unused.empty()) return;
    Finding finding = object_finding(
        scope, "M02",
        counted(unused.size(), "point", "points") + of_object(scope) + (unused.size() == 1 ? " belongs" : " belong") + " to no edge");
    list_points(scope, unused, finding);
    findings.push_back(std::move(finding));
}

}  // namespace geomend::validators
