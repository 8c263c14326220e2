// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/vtk/vtk.h"

namespace geomend::vtk {

std::span<const Format> formats() { return {}; }

}  // namespace geomend::vtk
