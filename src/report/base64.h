// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace geomend {

/// Base64 (RFC 4648) of 32-bit words, each with its lowest byte first, whatever the machine.
std::string base64_of_words(std::span<const std::uint32_t> words);

}  // namespace geomend
