// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>

#include "formats/format.h"

namespace geomend::roff {

/// The rows of this family in the table of formats.
std::span<const Format> formats();

}  // namespace geomend::roff
