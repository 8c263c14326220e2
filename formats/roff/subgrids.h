// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "model/corner_point.h"

namespace geomend::roff {

/// Name of the property that says in which subgrid a cell is, from 1 at the top.
inline constexpr std::string_view subgrid_name = "SUBGRID";

/// Numbers of layers of the subgrids, the uppermost first, as the kept tag of the grid states them; empty where there is
/// none, or they do not add up to the layers of the grid.
std::vector<std::int32_t> subgrid_layers(const CornerPointGrid& grid);

/// That property, where there are two subgrids or more.
std::optional<Attribute> subgrid_attribute(const CornerPointGrid& grid);

}  // namespace geomend::roff
