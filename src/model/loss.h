// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace geomend {

/// How bad it is that a target cannot hold something: substance needs --lossy, identity is warned of, style
/// is listed.
enum class LossClass : std::uint8_t { substance, identity, style };

/// "substance", ...
const char* to_string(LossClass c);

/// One thing that did not go into the target (or was not understood when read).
struct Loss {
    LossClass loss_class = LossClass::style;
    std::string entity;  ///< whose: object, region, attribute, ...; empty for the whole file
    std::string what;    ///< what is lost, e.g. "attribute 'porosity'"
    std::string why;     ///< e.g. "IRAP points hold no attributes"
    std::uint64_t count = 1;
};

/// Adds a loss, or counts one more where the same entity, what and why is listed already.
void add_loss(std::vector<Loss>& losses, Loss loss);

}  // namespace geomend
