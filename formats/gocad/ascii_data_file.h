// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/output.h"
#include "formats/gocad/object_scanner.h"
#include "model/attribute.h"

// The text form of array data: comment lines that begin with `*`, the longest of which names the columns, then one row
// per sample with its indices I J K from 0 (Voxet: in front; SGrid: X Y Z in front, indices at the end).

namespace geomend::gocad {

/// The columns of a data file, by sample in array order (I fastest).
struct AsciiColumns {
    std::vector<std::vector<double>> properties;  ///< one per wanted value column
    std::vector<Vec3> positions;                  ///< only where X Y Z were wanted
};

/// Reads a data file that must have one row for each sample of `dims`. Columns are found by the names in the comment
/// where all are there, else by their order.
/// \param value_names    names of the wanted value columns, in the order in which they are declared
/// \param with_positions X Y Z stand in front and I J K at the end
/// \param line           of the record that names the file, for messages
/// \return false after an error in `log`: F005 (number), F008 (rows), F012 (row), F014
bool read_ascii_data(std::string_view text, const std::string& name, const std::array<std::uint32_t, 3>& dims,
                     const std::vector<std::string>& value_names, bool with_positions, std::uint64_t line, ObjectLog& log,
                     AsciiColumns& columns);

/// Writes such a file. Values of cell attributes stand in the row of the cell's lowest sample; rows without a cell get
/// the no-data value.
/// \param positions     empty for a Voxet
/// \param cell_located  for each attribute whether it has one value per cell instead of per sample
void write_ascii_data(OutputFile& out, const std::array<std::uint32_t, 3>& dims, const std::vector<const Attribute*>& attributes,
                      const std::vector<bool>& cell_located, const std::vector<Vec3>& positions, double z_sign);

}  // namespace geomend::gocad
