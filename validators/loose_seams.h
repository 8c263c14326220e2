// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "validators/model_scope.h"

namespace geomend::validators {

/// Per line of loose surfaces 1 where two pieces of one part of a file meet there, and nothing else does, whose elements have no points in
/// common in the file: they are apart only because their points at one position are not one. Cost: linear in the edges of lines.
std::vector<std::uint8_t> seams_between_pieces(const ModelScope& scope);

/// Per surface the first one of its part of a file, which stands for the others; of stated models each surface itself.
std::vector<std::uint32_t> first_of_part(const ModelScope& scope);

}  // namespace geomend::validators
