// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>

namespace geomend {

/// The geological role of a surface. Finer words of a file (normal_fault, top, ...) are kept beside it as text.
enum class FeatureRole : std::uint8_t { unknown, fault, fracture, horizon, unconformity, intrusion, boundary, topography };

/// "fault", "horizon", ...
const char* to_string(FeatureRole role);

/// The role behind a word as formats write it, without regard to case: fault, normal_fault, reverse_fault, top,
/// bottom, horizon, intraformational, unconformity, intrusive, boundary, topographic, fracture, ...; else unknown.
FeatureRole feature_role(std::string_view word);

/// The word that Gocad uses for a role ("top" for a horizon, "none" for unknown).
const char* gocad_word(FeatureRole role);

}  // namespace geomend
