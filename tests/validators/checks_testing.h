// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "support/corner_point_grids.h"
#include "validators/registry.h"

namespace geomend::testing {

using validators::CheckOptions;

inline std::vector<Finding> findings_of(const CornerPointGrid& grid, const CheckOptions& options = {}) {
    auto checked = validators::check(grid, options);
    return checked ? std::move(checked->findings) : std::vector<Finding>{};
}

/// Codes with their severity, e.g. "C04 warning".
inline std::set<std::string> codes_of(const std::vector<Finding>& findings) {
    constexpr const char* words[] = {" info", " warning", " error"};
    std::set<std::string> all;
    for (const Finding& f : findings) all.insert(f.code + words[static_cast<std::size_t>(f.severity)]);
    return all;
}
inline std::set<std::string> codes_of(const CornerPointGrid& grid) { return codes_of(findings_of(grid)); }

/// The one finding of a code and severity; an empty one where there is none or are several.
inline Finding find(const std::vector<Finding>& findings, const std::string& code, Severity severity) {
    const auto wanted = [&](const Finding& f) { return f.code == code && f.severity == severity; };
    if (std::ranges::count_if(findings, wanted) != 1) return {};
    return *std::ranges::find_if(findings, wanted);
}

using Cell = std::array<std::int64_t, 3>;

/// Cells that a finding lists, (i,j,k) from 1.
inline std::vector<Cell> cells_of(const Finding& f) {
    std::vector<Cell> cells;
    for (std::size_t e = 0; e + 2 < f.elements.size(); e += 3) cells.push_back({f.elements[e], f.elements[e + 1], f.elements[e + 2]});
    return cells;
}

inline double measure(const Finding& f, const std::string& name) {
    for (const auto& [key, value] : f.measures) {
        if (key == name) return value;
    }
    return -1e300;
}

inline double& corner(CornerPointGrid& grid, std::uint32_t i, std::uint32_t j, std::uint32_t k, unsigned c) {
    return grid.depths[corner_index(grid.dims, i, j, k, c)];
}

/// Moves both points of a pillar.
inline void move_pillar(CornerPointGrid& grid, std::uint32_t i, std::uint32_t j, double dx, double dy) {
    double* p = grid.pillars.data() + 6 * (i + (std::size_t{grid.dims[0]} + 1) * j);
    for (const std::size_t at : {0u, 3u}) {
        p[at] += dx;
        p[at + 1] += dy;
    }
}

inline double* pillar(CornerPointGrid& grid, std::uint32_t i, std::uint32_t j) {
    return grid.pillars.data() + 6 * (i + (std::size_t{grid.dims[0]} + 1) * j);
}

}  // namespace geomend::testing
