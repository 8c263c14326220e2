// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/map_axes.h"

#include <cmath>

namespace geomend::grid {

namespace {

Failure cannot(const CornerPointGrid& grid, const char* code, const std::string& why) {
    return unreadable(code, {}, "grid '" + grid.info.name + "': MAPAXES cannot be applied: " + why);
}

// What lengths of the grid are multiplied by; 0 where a unit is not known.
double scale_to_map(const CornerPointGrid& grid) {
    const std::string& own = grid.info.crs.axis_units[0];
    if (grid.map_unit.empty() || own.empty() || grid.map_unit == own) return 1;
    const double from = metres(own), to = metres(grid.map_unit);
    return from == 0 || to == 0 ? 0 : from / to;
}

}  // namespace

double metres(std::string_view unit) {
    if (unit == "METRES" || unit == "METERS" || unit == "M" || unit == "m") return 1;
    if (unit == "FEET" || unit == "FT" || unit == "ft") return 0.3048;
    if (unit == "CM" || unit == "cm") return 0.01;
    if (unit.starts_with("US_SURV") || unit == "FTUS" || unit == "ftUS") return 1200.0 / 3937;  // the survey foot of the United States
    return 0;
}

Result<void> apply_map_axes(CornerPointGrid& grid) {
    if (!grid.map_axes || grid.map_relative) return {};
    if (grid.cylindrical) return cannot(grid, "F013", "the grid is cylindrical");
    const auto& [x1, y1, x2, y2, x3, y3] = *grid.map_axes;
    const double length_x = std::hypot(x3 - x2, y3 - y2), length_y = std::hypot(x1 - x2, y1 - y2);
    if (!(length_x >= 1e-5) || !(length_y >= 1e-5)) return cannot(grid, "F012", "an axis has no length");
    const double ux = (x3 - x2) / length_x, uy = (y3 - y2) / length_x, vx = (x1 - x2) / length_y, vy = (y1 - y2) / length_y;
    if (std::abs(ux * vy - uy * vx) < 1e-9) return cannot(grid, "F012", "the axes are parallel");
    const double scale = scale_to_map(grid);
    if (scale == 0) {
        const bool of_map = metres(grid.map_unit) == 0;
        return cannot(grid, "F012",
                      "unit '" + (of_map ? grid.map_unit : grid.info.crs.axis_units[0]) + "' of " + (of_map ? "MAPUNITS" : "GRIDUNIT") +
                          " is not known: state METRES, FEET or CM there");
    }
    const double origin_x = x2, origin_y = y2;
    for (std::size_t p = 0; p + 2 < grid.pillars.size(); p += 3) {
        const double x = grid.pillars[p] * scale, y = grid.pillars[p + 1] * scale;
        grid.pillars[p] = origin_x + x * ux + y * vx;
        grid.pillars[p + 1] = origin_y + x * uy + y * vy;
        grid.pillars[p + 2] *= scale;
    }
    if (scale != 1) {
        for (double& depth : grid.depths) depth *= scale;
        grid.info.crs.axis_units.fill(grid.map_unit);
    }
    grid.map_relative = true;
    return {};
}

}  // namespace geomend::grid
