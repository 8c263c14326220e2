// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/local_hosts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "base/place_words.h"
#include "base/vectors.h"
#include "base/wording.h"
#include "grid/cell_geometry.h"
#include "validators/cell_findings.h"
#include "validators/object_places.h"

namespace geomend::validators {

namespace {

using grid::Corners;

struct Range {
    Vec3 low, high;
};

Range range_of(const Corners& corners) {
    Range range{corners[0], corners[0]};
    for (const Vec3& p : corners) {
        for (std::size_t d = 0; d < 3; ++d) {
            range.low[d] = std::min(range.low[d], p[d]);
            range.high[d] = std::max(range.high[d], p[d]);
        }
    }
    return range;
}

/// Whether two ranges have at most a strip of that width in common.
bool are_apart(const Range& a, const Range& b, double strip) {
    for (std::size_t d = 0; d < 3; ++d) {
        if (a.low[d] >= b.high[d] - strip || b.low[d] >= a.high[d] - strip) return true;
    }
    return false;
}

double length_of_range(const Range& r) {
    const Vec3 d = minus(r.high, r.low);
    return std::sqrt(dot(d, d));
}

/// What lies below that inside or outside of a host cell is rounding.
double rounding_of(const Range& host, bool single) {
    double largest = 0;
    for (std::size_t d = 0; d < 3; ++d) largest = std::max({largest, std::abs(host.low[d]), std::abs(host.high[d])});
    return std::max(1e-6 * length_of_range(host), 4 * step_above(largest, single));
}

/// The point of the trilinear cell at (u,v,w), and the directions along them.
struct AtPlace {
    Vec3 point{};
    std::array<Vec3, 3> along{};
};
AtPlace at_place(const Corners& corners, const Vec3& place) {
    AtPlace at;
    for (unsigned c = 0; c < 8; ++c) {
        std::array<double, 3> weight{}, slope{};
        for (unsigned d = 0; d < 3; ++d) {
            const bool is_far = ((c >> d) & 1U) != 0;
            weight[d] = is_far ? place[d] : 1 - place[d];
            slope[d] = is_far ? 1 : -1;
        }
        at.point = plus(at.point, times(weight[0] * weight[1] * weight[2], corners[c]));
        at.along[0] = plus(at.along[0], times(slope[0] * weight[1] * weight[2], corners[c]));
        at.along[1] = plus(at.along[1], times(weight[0] * slope[1] * weight[2], corners[c]));
        at.along[2] = plus(at.along[2], times(weight[0] * weight[1] * slope[2], corners[c]));
    }
    return at;
}

/// (u,v,w) of a point in a trilinear cell, by Newton's method; nothing where that does not come to an end, as in cells without volume.
std::optional<Vec3> place_in(const Corners& corners, const Vec3& point, double close) {
    Vec3 place{0.5, 0.5, 0.5};
    for (unsigned round = 0; round < 20; ++round) {
        const AtPlace at = at_place(corners, place);
        const Vec3 rest = minus(point, at.point);
        if (dot(rest, rest) <= close * close) return place;
        const double volume = dot(at.along[0], cross(at.along[1], at.along[2]));
        if (volume == 0 || !std::isfinite(volume)) return std::nullopt;
        const Vec3 step{dot(rest, cross(at.along[1], at.along[2])) / volume, dot(at.along[0], cross(rest, at.along[2])) / volume,
                        dot(at.along[0], cross(at.along[1], rest)) / volume};
        for (std::size_t d = 0; d < 3; ++d) place[d] = std::clamp(place[d] + step[d], -20.0, 20.0);
    }
    return std::nullopt;
}

Vec3 nearest_inside(const Vec3& place) {
    return {std::clamp(place[0], 0.0, 1.0), std::clamp(place[1], 0.0, 1.0), std::clamp(place[2], 0.0, 1.0)};
}

enum class Lies { inside, centre_outside, outside };

/// How a local cell lies to a host cell. What cannot be told counts as inside.
Lies lies(const Corners& local, const Corners& host, bool single) {
    const Range of_host = range_of(host), of_local = range_of(local);
    const double rounding = rounding_of(of_host, single);
    for (const double bound : {length_of_range(of_host), length_of_range(of_local)}) {
        if (!(bound < 1e20)) return Lies::inside;  // told by C02
    }
    const Vec3 middle = grid::centre(local);
    const Range of_middle{middle, middle};
    if (are_apart(of_host, of_local, rounding) && are_apart(of_host, of_middle, -rounding)) return Lies::outside;
    const auto place = place_in(host, middle, 0.01 * rounding);
    if (!place) return are_apart(of_host, of_middle, -rounding) ? Lies::centre_outside : Lies::inside;
    const Vec3 off = minus(middle, at_place(host, nearest_inside(*place)).point);
    if (dot(off, off) <= rounding * rounding) return Lies::inside;
    Vec3 low = *place, high = *place;
    for (const Vec3& corner : local) {
        const auto p = place_in(host, corner, 0.01 * rounding);
        if (!p) return Lies::centre_outside;
        for (std::size_t d = 0; d < 3; ++d) {
            low[d] = std::min(low[d], (*p)[d]);
            high[d] = std::max(high[d], (*p)[d]);
        }
    }
    constexpr double strip = 1e-3;  // of the host cell
    for (std::size_t d = 0; d < 3; ++d) {
        if (low[d] >= 1 - strip || high[d] <= strip) return Lies::outside;
    }
    return Lies::centre_outside;
}

/// The range of a box of host cells, where a file states no host of each cell.
Range range_of_box(const CornerPointGrid& host, const CornerPointGrid::Host& box) {
    constexpr double none = std::numeric_limits<double>::infinity();
    Range all{{none, none, none}, {-none, -none, -none}};
    for (std::uint32_t k = box.first[2]; k <= std::min(box.last[2], host.dims[2] - 1); ++k) {
        for (std::uint32_t j = box.first[1]; j <= std::min(box.last[1], host.dims[1] - 1); ++j) {
            for (std::uint32_t i = box.first[0]; i <= std::min(box.last[0], host.dims[0] - 1); ++i) {
                const Range cell = range_of(cell_corners(host, i, j, k));
                for (std::size_t d = 0; d < 3; ++d) {
                    all.low[d] = std::min(all.low[d], cell.low[d]);
                    all.high[d] = std::max(all.high[d], cell.high[d]);
                }
            }
        }
    }
    return all;
}

/// The cell of the host in which a point lies, if there is one.
std::optional<std::size_t> holder_of(const CornerPointGrid& host, const Vec3& point, bool single) {
    const Range at{point, point};
    for (std::size_t cell = 0; cell < host.cell_count(); ++cell) {
        if (!host.is_active(cell)) continue;
        const auto [i, j, k] = host.ijk(cell);
        const Corners corners = cell_corners(host, i, j, k);
        const Range range = range_of(corners);
        if (are_apart(range, at, 0)) continue;
        const double rounding = rounding_of(range, single);
        const auto place = place_in(corners, point, 0.01 * rounding);
        if (!place) continue;
        const Vec3 off = minus(point, at_place(corners, nearest_inside(*place)).point);
        if (dot(off, off) <= rounding * rounding) return cell;
    }
    return std::nullopt;
}

struct Misplaced {
    FoundCells outside, centre_outside;
};

Misplaced misplaced_cells(const CornerPointGrid& host, const CornerPointGrid& local, bool single) {
    Misplaced found;
    const bool has_cells = !local.host->cells.empty();
    const Range box = has_cells ? Range{} : range_of_box(host, *local.host);
    for (std::size_t cell = 0; cell < local.cell_count(); ++cell) {
        if (!local.is_active(cell)) continue;
        const auto [i, j, k] = local.ijk(cell);
        const Corners corners = cell_corners(local, i, j, k);
        Lies how = Lies::inside;
        if (!has_cells) {
            const Range own = range_of(corners);
            if (length_of_range(own) < 1e20 && length_of_range(box) < 1e20 && are_apart(box, own, rounding_of(box, single)))
                how = Lies::outside;
        } else if (const std::uint64_t stated = local.host->cells[cell]; stated < host.cell_count()) {
            const auto at = host.ijk(static_cast<std::size_t>(stated));
            how = lies(corners, cell_corners(host, at[0], at[1], at[2]), single);
        }
        if (how == Lies::outside) found.outside.add(cell, 0);
        if (how == Lies::centre_outside) found.centre_outside.add(cell, 0);
    }
    return found;
}

/// "(1,2,1) is stated in (3,4,1), but its centre (x, y, z) lies in (4,4,1)".
std::string words_of_first(const CornerPointGrid& host, const CornerPointGrid& local, std::size_t cell, bool single) {
    const auto [i, j, k] = local.ijk(cell);
    const Vec3 middle = grid::centre(cell_corners(local, i, j, k));
    const auto& box = *local.host;
    std::string text = cell_text(local, cell) + " is stated in ";
    if (box.cells.empty()) {
        text += cell_text(host, host.cell(box.first[0], box.first[1], box.first[2])) + " to " +
                cell_text(host, host.cell(box.last[0], box.last[1], box.last[2]));
    } else {
        text += cell_text(host, static_cast<std::size_t>(box.cells[cell]));
    }
    text += ", but its centre, " + coordinate(middle[0]) + " " + coordinate(middle[1]) + " at depth " + coordinate(middle[2]);
    const auto holder = holder_of(host, middle, single);
    return text + (holder ? ", lies in " + cell_text(host, *holder) : ", lies in no active cell of the host");
}

void tell_misplaced(const CornerPointGrid& host, const CornerPointGrid& local, const FoundCells& cells, bool only_centres, bool single,
                    std::vector<Finding>& findings) {
    if (cells.count == 0) return;
    const bool is_one = cells.count == 1;
    const std::string of_one = only_centres ? " has its centre outside of the host cell that is stated for it: "
                                            : " lies outside of the host cell that is stated for it: ";
    const std::string of_many = only_centres ? " have their centres outside of the host cells that are stated for them: "
                                             : " lie outside of the host cells that are stated for them: ";
    Finding f = make_finding("C32",
                             counted(cells.count, "cell", "cells") + " of local grid '" + local.info.name + "'" +
                                 (is_one ? of_one : of_many) + words_of_first(host, local, cells.first.front(), single),
                             {}, cells.count);
    if (only_centres) use_other_severity(f);
    f.entities = {{"corner-point-grid", local.info.name}, {"corner-point-grid", host.info.name}};
    list_cells(local, cells, f);
    place_cells(local, f);
    findings.push_back(std::move(f));
}

bool can_be_judged(const CornerPointGrid& grid) {
    return !grid.cylindrical && !grid.pillars.empty() && !grid.depths.empty() && misfit(grid).empty();
}

}  // namespace

void check_local_hosts(std::span<const CornerPointGrid* const> grids, std::vector<Finding>& findings) {
    for (const CornerPointGrid* local : grids) {
        if (!local->host || !can_be_judged(*local)) continue;
        if (!local->host->cells.empty() && local->host->cells.size() != local->cell_count()) continue;
        const auto host = std::ranges::find_if(grids, [&](const CornerPointGrid* g) {
            return g != local && (local->host->grid.empty() ? !g->host.has_value() : local->host->grid == g->info.name);
        });
        if (host == grids.end() || !can_be_judged(**host)) continue;
        const auto is_single = [](const CornerPointGrid& g) { return g.info.precision == CoordinatePrecision::single_precision; };
        const bool single = is_single(**host) || is_single(*local);
        const Misplaced found = misplaced_cells(**host, *local, single);
        tell_misplaced(**host, *local, found.outside, false, single, findings);
        tell_misplaced(**host, *local, found.centre_outside, true, single, findings);
    }
}

}  // namespace geomend::validators
