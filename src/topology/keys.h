// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>

#include "model/brep.h"

namespace geomend::topology {

enum class KeyMatch : std::uint8_t { same, reversed, absent };

/// Compares a stated key triangle with the triangles of its surface. Cost: linear in the surface at worst.
/// \param wanted the vertices of the key; no_index where there is none
KeyMatch match_key(const BrepData::Surface& surface, const std::array<std::uint32_t, 3>& wanted);

}  // namespace geomend::topology
