// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>

#include "formats/horizon/lattice.h"

namespace geomend::horizon {

inline constexpr double irap_mark = -996;
inline constexpr std::size_t irap_header_numbers = 19;

/// The header's numbers in the order of the ASCII file.
using IrapHeader = std::array<double, irap_header_numbers>;

struct IrapFrame {
    GridFrame frame;
    std::string warning;  ///< empty, or how the header disagrees with itself
};

/// The lattice that a header states; `count_limit` is the number of heights that the rest of the file could hold.
/// Failure F012 (not such a header) or F014 (asks for too much), located in `where`.
Result<IrapFrame> irap_frame(const IrapHeader& header, std::uint64_t count_limit, const Location& where);

/// The header of a grid.
IrapHeader irap_header(const FileGrid& grid);

/// The finding F113 for a warning.
Finding irap_warning(const std::string& warning, const Location& where);

}  // namespace geomend::horizon
