// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/eclipse/eclipse.h"

namespace geomend::eclipse {

std::span<const Format> formats() { return {}; }

}  // namespace geomend::eclipse
