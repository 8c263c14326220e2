// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/grdecl/grdecl.h"

namespace geomend::grdecl {

std::span<const Format> formats() { return {}; }

}  // namespace geomend::grdecl
