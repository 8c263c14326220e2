// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/result.h"

namespace geomend {

/// Whether bytes begin as gzip data with deflate do.
bool is_gzip(std::string_view bytes);

/// Inflates gzip data of one or several members (RFC 1952, 2.2). What follows the last member is not looked at.
/// \param name  of the file, for messages
/// \param most  bytes that the result may have: more is a failure (F014), found before they are all there
/// Damaged data are F015.
Result<std::string> inflate_gzip(std::string_view packed, const std::string& name, std::size_t most);

/// Inflates bare deflate data (RFC 1951) that give exactly `size` bytes; else F015.
Result<std::string> inflate_exactly(std::string_view packed, std::size_t size, const std::string& name);

}  // namespace geomend
