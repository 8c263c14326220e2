// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/pore_volume.h"

#include <cmath>

#include "grid/cell_geometry.h"
#include "grid/edits.h"
#include "grid/map_axes.h"
#include "grid/transmissibility.h"

namespace geomend::grid {

namespace {

// Cubic lengths of the grid in the unit of reservoir volume.
double volume_factor(const CornerPointGrid& grid) {
    if (grid.unit_system.empty()) return 1;
    const bool field = grid.unit_system == "FIELD", lab = grid.unit_system == "LAB";
    const double own = field ? 0.3048 : lab ? 0.01 : 1;
    const double stated = metres(grid.info.crs.axis_units[0]);
    const double side = (stated > 0 ? stated : own) / own;
    constexpr double cubic_feet_in_barrel = 5.614583333333333;  // 9702 cubic inches
    return side * side * side / (field ? cubic_feet_in_barrel : 1);
}

}  // namespace

std::vector<double> fitting_values(const CornerPointGrid& grid, std::string_view name, double fallback) {
    const Attribute* a = find_attribute(grid.info.attributes, std::string(name), AttributeLocation::cell);
    if (a == nullptr || a->components != 1 || value_count(*a) != grid.cell_count()) return {};
    return cell_values(grid, name, fallback);
}

bool knows_pore_volumes(const CornerPointGrid& grid) {
    return !fitting_values(grid, "PORV", 0).empty() || !fitting_values(grid, "PORO", 0).empty();
}

double least_pore_volume(const CornerPointGrid& grid) { return grid.least_pore_volume.value_or(1e-6); }

std::vector<double> pore_volumes(const CornerPointGrid& grid) {
    std::vector<double> volumes;
    const std::vector<double> porosity = fitting_values(grid, "PORO", 0);
    if (!porosity.empty()) {
        volumes = cell_volumes(grid);
        const double factor = volume_factor(grid);
        for (std::size_t c = 0; c < volumes.size(); ++c) volumes[c] = std::abs(volumes[c]) * factor * porosity[c];
        for (const char* name : {"NTG", "MULTPV"}) {
            const std::vector<double> by = fitting_values(grid, name, 1);
            for (std::size_t c = 0; c < by.size(); ++c) volumes[c] *= by[c];
        }
    }
    const std::vector<double> stated = fitting_values(grid, "PORV", NAN);
    if (volumes.empty()) volumes.assign(grid.cell_count(), 0);
    apply_edits(
        grid, "PORV", [](std::size_t) { return true; }, volumes);
    for (std::size_t c = 0; c < stated.size(); ++c) {
        if (!std::isnan(stated[c])) volumes[c] = stated[c];
    }
    return volumes;
}

}  // namespace geomend::grid
