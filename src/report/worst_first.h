// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/finding.h"

namespace geomend {

/// Errors, then warnings, then information, each in the order given.
std::vector<const Finding*> worst_first(std::span<const Finding> findings);

/// The first `most` of them.
std::vector<const Finding*> worst_first(std::span<const Finding> findings, std::size_t most);

}  // namespace geomend
