// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>

#include "formats/format.h"

namespace geomend::wells {

/// The rows of the formats of wells.
std::span<const Format> formats();

}  // namespace geomend::wells
