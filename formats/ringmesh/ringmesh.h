// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>

#include "formats/format.h"

namespace geomend::ringmesh {

/// The rows of RINGMesh's model file.
std::span<const Format> formats();

}  // namespace geomend::ringmesh
