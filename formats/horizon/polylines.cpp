// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/horizon/polylines.h"

namespace geomend::horizon {

namespace {

/// Points and edges of one part.
struct PartRange {
    std::size_t first_point, last_point, first_edge, last_edge;
};

PartRange part_range(const PolylineSet& set, std::size_t part) {
    if (set.parts.empty()) return {0, set.points.size(), 0, set.edges.size()};
    const bool last = part + 1 == set.parts.size();
    return {set.parts[part].first_point, last ? set.points.size() : set.parts[part + 1].first_point,
            static_cast<std::size_t>(set.parts[part].first_edge),
            last ? set.edges.size() : static_cast<std::size_t>(set.parts[part + 1].first_edge)};
}

}  // namespace

std::vector<Chain> chains_of(const PolylineSet& set) {
    std::vector<Chain> chains;
    std::vector<bool> used(set.points.size());
    const std::size_t parts = set.parts.empty() ? 1 : set.parts.size();
    for (std::size_t part = 0; part < parts; ++part) {
        const PartRange range = part_range(set, part);
        for (std::size_t e = range.first_edge; e < range.last_edge; ++e) {
            const auto [from, to] = set.edges[e];
            used[from] = used[to] = true;
            if (e == range.first_edge || chains.back().points.back() != from) chains.push_back({part, {from}});
            chains.back().points.push_back(to);
        }
        for (std::size_t p = range.first_point; p < range.last_point; ++p) {
            if (!used[p]) chains.push_back({part, {static_cast<std::uint32_t>(p)}});
        }
    }
    return chains;
}

void add_line(PolylineSet& set, std::string name, std::span<const Vec3> points) {
    if (points.empty()) return;
    const bool closed = points.size() >= 4 && points.front() == points.back();
    const auto first = static_cast<std::uint32_t>(set.points.size());
    set.parts.push_back({first, set.edges.size(), std::move(name)});
    if (closed) points = points.first(points.size() - 1);
    set.points.insert(set.points.end(), points.begin(), points.end());
    const auto last = static_cast<std::uint32_t>(set.points.size() - 1);
    for (std::uint32_t p = first; p < last; ++p) set.edges.push_back({p, p + 1});
    if (closed) set.edges.push_back({last, first});
}

Result<std::size_t> polylines_for_writing(const Dataset& dataset, std::string_view title) {
    for (std::size_t i = 0; i < dataset.objects.size(); ++i) {
        const auto* set = std::get_if<PolylineSet>(&dataset.objects[i]);
        if (set != nullptr && !set->points.empty()) return i;
    }
    return failure(FailureKind::cannot_hold, "F021", {},
                   std::string(title) + " hold one set of polylines: there is none with points among the objects");
}

}  // namespace geomend::horizon
