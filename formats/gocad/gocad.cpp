// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/gocad.h"

namespace geomend::gocad {

std::span<const Format> formats() { return {}; }

}  // namespace geomend::gocad
