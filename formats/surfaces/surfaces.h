// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>

#include "formats/format.h"

namespace geomend::surfaces {

/// The rows of the table of formats: STL, OBJ, PLY, OFF.
std::span<const Format> formats();

}  // namespace geomend::surfaces
