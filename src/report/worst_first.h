// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "base/finding.h"

namespace geomend {

/// Errors, then warnings, then information, each in the order given.
std::vector<const Finding*> worst_first(std::span<const Finding> findings);

}  // namespace geomend
