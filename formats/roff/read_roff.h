// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::roff {

/// Reads grids with their parameters, text or binary. A file of parameters alone gives a grid without pillars and
/// depths. Coordinates are (local + offset) * scale in double precision; the depth axis points down.
Result<Dataset> read_roff(const Input& input, const ReadOptions& options);

inline constexpr std::string_view tag_key = "roff.tag";              ///< a tag as text, for the way back
inline constexpr std::string_view translate_key = "roff.translate";  ///< three numbers
inline constexpr std::string_view scale_key = "roff.scale";          ///< three numbers
inline constexpr std::string_view type_key = "roff.type";            ///< of an attribute, where it is not told by its values

inline constexpr double missing_real = -999.0;
inline constexpr int missing_integer = -999;
inline constexpr int missing_byte = 255;

}  // namespace geomend::roff
