// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/cell_number.h"

#include <algorithm>
#include <cmath>

#include "base/bounds.h"
#include "base/larger_size.h"
#include "base/vectors.h"
#include "base/wording.h"

namespace geomend {

namespace {

/// Tetrahedra of an edge in a volume. TetGen makes 1.3 times as many as regular ones would be.
double tetrahedra_in(double volume, double edge) { return 1.3 * volume * 6 * std::sqrt(2.0) / (edge * edge * edge); }

double volume_in(const BrepData::Region& region) {
    return region.volume_known && std::isfinite(region.volume) ? std::abs(region.volume) : 0;
}

double area_of(const BrepData& brep, const BrepData::Surface& surface) {
    double area = 0;
    for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
        const auto polygon = surface.polygons[p];
        const auto at = [&](std::size_t k) { return brep.vertices[surface.nodes[polygon[k]].value]; };
        for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
            const Vec3 n = cross(minus(at(k), at(0)), minus(at(k + 1), at(0)));
            area += std::sqrt(dot(n, n)) / 2;
        }
    }
    return area;
}

/// Cells that a rule makes beside those that are there without it: the sum over layers around its surface.
double tetrahedra_by(const BrepData& brep, const remeshing::SizeRule& rule, double elsewhere) {
    if (rule.kind != remeshing::SizeRule::Kind::distance || !(rule.size < elsewhere)) return 0;
    double area = 0, whole = 0;
    for (const auto& surface : brep.surfaces) {
        const bool is_of =
            surface.name == rule.name || (surface.interface_id.valid() && brep.interfaces[surface.interface_id.value].name == rule.name);
        if (is_of) area += area_of(brep, surface);
    }
    for (const auto& region : brep.regions) whole += volume_in(region);
    const double end = rule.thickness + remeshing::influence_zone(rule.size, elsewhere, rule.ratio);
    const double most = area > 0 ? std::min(end, whole / (2 * area)) : 0;  // no farther than there is room on both sides
    double count = 0;
    const auto add = [&](double from, double to) {
        const double size = remeshing::size_at_distance(rule, (from + to) / 2, elsewhere);
        count += tetrahedra_in(2 * area * (to - from), size) - tetrahedra_in(2 * area * (to - from), elsewhere);
    };
    double at = std::min(rule.thickness, most);
    if (at > 0) add(0, at);
    for (double step = rule.size; at < most; step *= 1.1) {
        const double to = std::min(at + step, most);
        add(at, to);
        if (!(to > at)) break;
        at = to;
    }
    return count;
}

/// \param size the only one there is, or 0
Failure too_many(double count, std::uint64_t most, double size, const std::string& where) {
    const double factor = std::cbrt(count / static_cast<double>(most));
    const std::string more = std::isfinite(factor) ? size > 0 ? ": edges of " + two_digits_above(size * factor) + " make fewer"
                                                              : ": sizes " + two_digits_above(factor) + " times as large make fewer"
                                                   : std::string();
    Failure why = failure(FailureKind::limit, "F023", {},
                          "edges of " + (size > 0 ? rounded(size) : std::string("these sizes")) + " make about " + rounded(count) +
                              " cells" + where + ", and no more than " + std::to_string(most) + " are allowed" + more);
    why.error.measures = {{"most_cells", static_cast<double>(most)}};
    return why;
}

}  // namespace

Result<void> check_cell_number(const BrepData& brep, const WantedSizes& sizes, std::uint64_t most) {
    double count = sizes.further, largest = 0;
    const BrepData::Region* fullest = nullptr;
    for (const auto& region : brep.regions) {
        const auto own = std::ranges::find(sizes.of_regions, region.name, [](const auto& s) { return s.first; });
        const double size = own != sizes.of_regions.end() ? own->second : sizes.size;
        if (!(size > 0)) continue;
        const double cells = tetrahedra_in(volume_in(region), size);
        count += cells;
        if (cells > largest) fullest = &region;
        largest = std::max(largest, cells);
    }
    constexpr double share = 0.5;  // where sizes change from cell to cell, TetGen makes about half of what they say
    double by_rules = 0;
    for (const auto& rule : sizes.rules) by_rules += share * tetrahedra_by(brep, rule, sizes.size);
    count += by_rules;
    if (count <= static_cast<double>(most)) return {};
    const bool is_one = sizes.of_regions.empty() && by_rules + sizes.further < count / 2;
    std::string where;
    if (!sizes.of_regions.empty() && largest > count / 2) where = ", most of them in region " + geomend::quoted(fullest->name);
    if (by_rules > count / 2) where = ", most of them by --size-by";
    if (sizes.further > count / 2) where = ", most of them by --resize-by";
    return too_many(count, most, is_one ? sizes.size : 0, where);
}

Result<void> check_lattice(const BrepData& brep, const Vec3& steps, std::uint64_t most) {
    double whole = 0;
    for (const auto& region : brep.regions) whole += volume_in(region);
    constexpr double in_a_step = 6;
    const double count = in_a_step * whole / (steps[0] * steps[1] * steps[2]);
    if (count <= static_cast<double>(most)) return {};
    return too_many(count, most, std::cbrt(steps[0] * steps[1] * steps[2]), " on a lattice");
}

}  // namespace geomend
