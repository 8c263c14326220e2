// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <iterator>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "validators/model_scope.h"

namespace geomend::validators {

/// Asks judge(surface) -> optional<Finding> of each surface, in parallel; findings come in the order of surfaces.
template <class Judge>
void judge_surfaces(const ModelScope& scope, std::vector<Finding>& findings, const Judge& judge) {
    std::vector<std::optional<Finding>> found(scope.brep().surfaces.size());
    parallel_for_each_index(found.size(), [&](std::size_t s) {
        if (!scope.stopped()) found[s] = judge(static_cast<std::uint32_t>(s));
    });
    for (auto& finding : found) {
        if (finding) findings.push_back(std::move(*finding));
    }
}

/// What goes on after one triangle, and after several.
struct PolygonWords {
    std::string one, many;
};

/// Asks bad(number of the surface, polygon) -> bool of each polygon; a surface with such polygons gets one finding: "12 triangles of
/// 'H1b_2' ..." with the words(number of the surface) -> PolygonWords.
template <class Words, class Bad>
void judge_polygons(const ModelScope& scope, std::vector<Finding>& findings, std::string_view code, const Words& words, const Bad& bad) {
    judge_surfaces(scope, findings, [&](std::uint32_t s) -> std::optional<Finding> {
        const auto& surface = scope.brep().surfaces[s];
        std::vector<std::uint32_t> polygons;
        for (std::uint32_t p = 0; p < surface.polygons.size(); ++p) {
            if (bad(s, p)) polygons.push_back(p);
        }
        if (polygons.empty()) return std::nullopt;
        const char* kind = surface.polygons.all_triangles() ? "triangle" : "polygon";
        const PolygonWords text = words(s);
        std::string message = std::to_string(polygons.size()) + " " + kind + (polygons.size() == 1 ? "" : "s") + " of " +
                              quoted(surface.name) + " " + (polygons.size() == 1 ? text.one : text.many);
        return polygons_finding(scope, code, s, std::move(message), polygons);
    });
}
/// The same with bad(surface, polygon), and the same words for all surfaces.
template <class Bad>
void judge_polygons(const ModelScope& scope, std::vector<Finding>& findings, std::string_view code, std::string_view one,
                    std::string_view many, const Bad& bad) {
    judge_polygons(
        scope, findings, code,
        [&](std::uint32_t) {
            return PolygonWords{std::string(one), std::string(many)};
        },
        [&](std::uint32_t s, std::uint32_t p) { return bad(scope.brep().surfaces[s], p); });
}

}  // namespace geomend::validators
