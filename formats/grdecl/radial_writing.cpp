// SPDX-License-Identifier: AGPL-3.0-or-later
// Radial grids as blocks around an axis: simulators such as OPM Flow take no others.
#include <algorithm>
#include <cmath>

#include "formats/grdecl/deck.h"
#include "formats/grdecl/value_text.h"
#include "formats/grdecl/writing.h"

namespace geomend::grdecl {

namespace {

/// Steps that add up to some positions. Empty where they do not grow, or where the sums differ from the positions by more than rounding.
std::vector<double> steps_between(const std::vector<double>& positions) {
    std::vector<double> steps;
    double sum = positions[0];
    for (std::size_t n = 1; n < positions.size(); ++n) {
        double step = positions[n] - sum;
        for (const double other : {std::nextafter(step, 0.0), std::nextafter(step, HUGE_VAL)}) {
            if (sum + step != positions[n] && sum + other == positions[n]) step = other;
        }
        if (!(step > 0)) return {};
        sum += step;
        if (std::abs(sum - positions[n]) > 1e-14 * std::abs(positions[n])) return {};
        steps.push_back(step);
    }
    return steps;
}

/// The position of all pillars of a line along x or y: the same for all lines, and upright. Empty where it is not.
std::vector<double> common_positions(const CornerPointGrid& grid, std::size_t axis) {
    const std::size_t columns = std::size_t{grid.dims[0]} + 1, rows = std::size_t{grid.dims[1]} + 1;
    std::vector<double> positions;
    for (std::size_t n = 0; n < (axis == 0 ? columns : rows); ++n)
        positions.push_back(grid.pillars[6 * (axis == 0 ? n : columns * n) + axis]);
    for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t i = 0; i < columns; ++i) {
            const double* p = grid.pillars.data() + 6 * (i + columns * j);
            const double wanted = positions[axis == 0 ? i : j];
            if (p[axis] != wanted || p[axis + 3] != wanted) return {};
        }
    }
    return positions;
}

/// Tops of the first layer and heights of all cells, which are flat and lie on each other. False where they do not.
bool take_depths(const CornerPointGrid& grid, RadialBlocks& blocks) {
    for (std::size_t k = 0; k < grid.dims[2]; ++k) {
        for (std::size_t j = 0; j < grid.dims[1]; ++j) {
            for (std::size_t i = 0; i < grid.dims[0]; ++i) {
                const auto at = [&](unsigned corner) { return grid.depths[corner_index(grid.dims, i, j, k, corner)]; };
                const double top = at(0), bottom = at(4);
                for (unsigned c = 0; c < 8; ++c) {
                    if (at(c) != (c < 4 ? top : bottom)) return false;
                }
                if (!std::isfinite(top) || !(bottom >= top)) return false;
                if (k == 0) blocks.tops.push_back(top);
                else if (grid.depths[corner_index(grid.dims, i, j, k - 1, 4)] != top) return false;
                blocks.heights.push_back(bottom - top);
            }
        }
    }
    return true;
}

}  // namespace

std::optional<RadialBlocks> radial_blocks(const CornerPointGrid& grid) {
    const bool is_single =
        grid.porosity == CornerPointGrid::Porosity::single && grid.reservoirs.empty() && grid.orientation.empty() && !grid.host;
    if (!grid.cylindrical || !is_single || grid.depths.empty() || grid.pillars.size() != 6 * pillar_count(grid.dims)) return std::nullopt;
    const auto radii = common_positions(grid, 0), angles = common_positions(grid, 1);
    if (radii.empty() || angles.empty() || !(radii[0] >= 0) || angles[0] != 0) return std::nullopt;
    RadialBlocks blocks;
    blocks.inner = radii[0];
    blocks.radii = steps_between(radii);
    blocks.angles = steps_between(angles);
    if (blocks.radii.empty() || blocks.angles.empty() || !take_depths(grid, blocks)) return std::nullopt;
    return blocks;
}

void write_radial_blocks(const RadialBlocks& blocks, DeckOutput& to) {
    to.main << "INRAD\n ";
    to.main.number(blocks.inner) << " /\n\n";
    const auto array = [&](std::string_view name, const std::vector<double>& values) {
        write_array(to.main, name, values.size(), [&](std::size_t i) { return Element<double>{values[i]}; });
    };
    array("DRV", blocks.radii);
    array("DTHETAV", blocks.angles);
    array("DZ", blocks.heights);
    array("TOPS", blocks.tops);
}

}  // namespace geomend::grdecl
