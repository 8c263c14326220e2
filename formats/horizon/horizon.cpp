// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/horizon/horizon.h"

namespace geomend::horizon {

std::span<const Format> formats() { return {}; }

}  // namespace geomend::horizon
