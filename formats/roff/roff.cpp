// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/roff/roff.h"

namespace geomend::roff {

std::span<const Format> formats() { return {}; }

}  // namespace geomend::roff
