// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/eclipse/array_writer.h"
#include "formats/eclipse/arrays.h"
#include "model/dataset.h"

// Arrays that are not of the grid (heads, tables, unknown ones) are kept as text for the way back: annotations with
// the kind of file as key, and the value "NAME TYPE COUNT v v 3*v ...", text between quotes, equal values in a row as N*v.

namespace geomend::eclipse {

inline constexpr std::string_view array_key = "eclipse.array";  ///< of EGRID and GRID files
inline constexpr std::string_view init_key = "eclipse.init";    ///< of INIT files
inline constexpr std::string_view deck_key = "eclipse.deck";    ///< of binary GRDECL

/// The annotation of an array.
Result<Annotation> kept_array(const ArrayFile& file, const Array& array, std::string_view key);

/// The array with a name among annotations, as its text; nullptr where there is none.
const std::string* find_kept(const std::vector<Annotation>& annotations, std::string_view key, std::string_view name);

/// What formats of other families do not take along of them, heads apart: a loss of identity for each grid. Linear in the
/// annotations.
std::vector<Loss> losses_of_arrays(const Dataset& dataset);

/// Name of the array that a text is of.
std::string_view kept_name(std::string_view text);

/// Its whole numbers; nothing where it is not such a text. Counts are bounded by `most`.
std::optional<std::vector<std::int32_t>> kept_integers(std::string_view text, std::size_t most = std::size_t{1} << 28);

/// Writes it as it was. False where it is not such a text; then nothing is written.
bool write_kept(ArrayWriter& writer, std::string_view text);

}  // namespace geomend::eclipse
