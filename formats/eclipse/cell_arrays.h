// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/eclipse/arrays.h"
#include "model/dataset.h"

namespace geomend::eclipse {

inline constexpr double missing_real = static_cast<double>(-9.99e20f);  ///< no-data of reals, as programs print it
inline constexpr std::int32_t missing_integer = -2147483647;
inline constexpr std::uint8_t missing_byte = 255;
inline constexpr std::string_view fracture_suffix = ":fracture";

/// The order in which arrays of active cells stand: the active matrix cells, then, with two porosities, the active
/// fracture cells.
struct CellOrder {
    std::size_t cells = 0;  ///< of the grid
    bool dual = false;
    bool all_active = false;  ///< of a grid of one porosity
    std::vector<std::uint64_t> matrix, fracture;

    std::size_t matrix_count() const { return all_active ? cells : matrix.size(); }
    std::size_t active() const { return matrix_count() + fracture.size(); }
    std::size_t total() const { return dual ? 2 * cells : cells; }
};
CellOrder cell_order(const CornerPointGrid& grid);

/// Whether an array is long enough for one value per cell (all or the active ones) and of a type that cells have.
bool fits_cells(const Array& array, const CellOrder& order);

/// Whether a name is always that of values of cells (PORO, PERMX, SATNUM, ...): any other count is an error of the file.
bool is_cell_property(std::string_view name);

/// Failure F008: an array has neither a value for each cell nor one for each active cell.
Failure wrong_cell_count(const ArrayFile& file, const Array& array, const CellOrder& order);

/// Reads an array of one value per cell, all or the active ones, into attributes of the grid: one, or two where there
/// are two porosities. Values that are not finite become no-data, with one finding.
/// \pre fits_cells
Result<void> take_cell_array(const ArrayFile& file, const Array& array, const CellOrder& order, const std::string& name,
                             CornerPointGrid& grid, std::vector<Finding>& findings);

/// Unit of a property where the unit system makes it certain; else empty.
std::string unit_of(std::string_view keyword, std::string_view unit_system);

}  // namespace geomend::eclipse
