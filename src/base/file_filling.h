// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>

namespace geomend {

/// What stands behind the end of a file's content without being any: blanks, what programs fill files up with, and the mark with which DOS
/// ends a text.
inline constexpr std::string_view file_filling(" \t\r\n\0\x1a", 6);

}  // namespace geomend
