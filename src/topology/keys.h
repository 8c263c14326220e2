// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <string>

#include "model/brep.h"
#include "model/dataset.h"

namespace geomend::topology {

enum class KeyMatch : std::uint8_t { same, reversed, absent };

/// Compares a stated key triangle with the triangles of its surface, which has it if any of them is the same. Cost: linear
/// in the surface at worst.
/// \param wanted the vertices of the key; no_index where there is none
KeyMatch match_key(const BrepData::Surface& surface, const std::array<std::uint32_t, 3>& wanted);

/// Gives the faces of a surface in several parts those parts that have their key triangles, where each key is in one part and no two are in
/// the same: numbers of TFACE records ascend with the parts in the files of Gocad, but others number them as they like. Where all keys
/// are where they are expected nothing is changed. Cost: linear in the surfaces at worst, times the parts of those that are changed.
void find_parts_by_keys(Dataset& dataset);

/// Compares the key triangles of faces whose records have a line in the file with the parts of surfaces that they are of,
/// by position, and adds to the findings what does not fit: F106 reversed, F116 not a triangle of the part; one finding for
/// each model and code, at the first such record. Cost: linear in those surfaces at worst.
/// \param file its name
void report_stated_keys(const std::string& file, Dataset& dataset);

}  // namespace geomend::topology
