// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>

#include "model/brep.h"
#include "topology/weld.h"

namespace geomend::topology {

enum class KeyMatch : std::uint8_t { same, reversed, absent };

/// Compares a stated key triangle with the triangles of its surface, bit by bit. Cost: linear in the surface at worst.
KeyMatch match_key(const BrepData::Surface& surface, const std::array<Vec3, 3>& key, const Welder& welder);

}  // namespace geomend::topology
