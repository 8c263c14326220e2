// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/registry.h"

#include <algorithm>
#include <array>

#include "validators/corner_point.h"

namespace geomend::validators {

namespace {

constexpr std::array table = {
    Check{"C01", "an array has another length than the dimensions ask for; nothing else is then checked"},
    Check{"C02", "a corner or pillar of an active cell is not finite, or 1e20 or more", check_coordinates},
    Check{"C03", "on a pillar the bottom lies above the top by more than the tolerance", check_inverted},
    Check{"C04", "depths of a cell and the next active one below differ by more than the tolerance: overlap (error) or gap (warning)",
          check_vertical_neighbours},
    Check{"C05", "top and bottom agree within the tolerance on all four pillars", check_collapsed},
    Check{"C06", "top and bottom agree within the tolerance on one to three pillars", check_wedges},
    Check{
        "C07",
        "after the grid's majority sign, det J is negative at a Gauss point, or at a corner without a collapsed edge, by more than moving "
        "a corner by the tolerance explains",
        check_inside_out},
    Check{"C08", "seen from above a corner of top or base lies inside the triangle of the other three, deeper than the tolerance",
          check_concave},
    Check{"C09", "an angle of top or base (in space or seen from above) or of a side is below 10 or above 170 degrees", check_angles},
    Check{"C10", "the two points of a pillar agree in depth within the tolerance, but not in x and y", check_flat_pillars},
    Check{"C11", "two pillars of a column touch within its active depths, or the way between them turns by more than 90 degrees",
          check_crossing_pillars},
    Check{"C12", "outlines seen from above turn both ways (error), or all are left-handed in (x, y, depth) or on the map (info)",
          check_handedness},
    Check{"C13", "MAPAXES has no two axes, or MAPUNITS is missing beside it", check_map_axes, true},
    Check{"C14", "SPECGRID and DIMENS differ; told by the reader of decks"},
    Check{"C15", "ACTNUM is above 1 (above 3 in a grid of two porosities)", check_activity, true},
    Check{"C16", "PORV, or volume times PORO, NTG and MULTPV, is below MINPV or MINPVV (1e-6 where it is not stated)", check_pore_volumes},
    Check{"C17", "active cells are not all connected: across faults, past pinched cells and by stated connections", check_parts},
    Check{"C18", "a stated fault without throw, or throw without a stated fault, beyond the tolerance, between neighbours of one layer",
          check_fault_throws},
    Check{"C19", "rounding to single precision moves a corner by more than the tolerance", check_single_precision},
    Check{"C20", "the cells of a fault record are outside the grid, run backwards or are more than one layer thick", check_fault_boxes,
          true},
    Check{"C21", "an active cell touches no other; a column of them touches no other column", check_isolated},
    Check{"C22", "the longest mean edge is more than 1000 times the shortest", check_flat_cells},
};

Failure stopped() { return failure(FailureKind::cancelled, "F022", {}, "the checks were stopped"); }

}  // namespace

std::span<const Check> all_checks() { return table; }

Result<void> known_codes(const CheckOptions& options) {
    for (const auto* list : {&options.only, &options.skip}) {
        for (const std::string& code : *list) {
            if (std::ranges::find(table, std::string_view(code), &Check::code) == table.end())
                return failure(FailureKind::usage, "F018", {}, code + ": no such check (see 'geomend checks')");
        }
    }
    return {};
}

bool wanted(const CheckOptions& options, std::string_view code) {
    const auto names = [&](const std::vector<std::string>& list) { return std::ranges::find(list, code) != list.end(); };
    return (options.only.empty() || names(options.only)) && !names(options.skip);
}

Result<Checked> check(const CornerPointGrid& grid, const CheckOptions& options) {
    Checked result;
    check_array_lengths(grid, result.findings);
    result.geometry = has_geometry(grid);
    if (result.geometry && !misfit(grid).empty()) return result;  // told even where C01 is skipped: nothing can be judged
    if (!wanted(options, "C01")) result.findings.clear();
    const GridScope scope(grid, options);
    result.lengths = scope.lengths();
    for (const Check& row : table) {
        if (scope.stopped()) return stopped();
        if (row.run != nullptr && (result.geometry || row.of_records) && wanted(options, row.code)) row.run(scope, result.findings);
        if (options.monitor != nullptr)
            options.monitor->progress("checking", static_cast<double>(&row - table.data() + 1) / static_cast<double>(table.size()));
    }
    if (scope.stopped()) return stopped();
    if (!result.geometry) {
        result.findings.push_back(grid_finding(
            scope, "F161", "there is no geometry here: only the lengths of arrays, MAPAXES, ACTNUM and fault records were checked"));
    }
    return result;
}

}  // namespace geomend::validators
