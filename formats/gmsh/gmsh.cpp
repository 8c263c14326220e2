// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gmsh/gmsh.h"

namespace geomend::gmsh {

std::span<const Format> formats() { return {}; }

}  // namespace geomend::gmsh
