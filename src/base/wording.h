// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace geomend {

// Words and numbers inside messages for people; files and --json get all digits (number_text.h).

/// "1 cell", "7 cells".
std::string counted(std::uint64_t count, std::string_view one, std::string_view many);
/// Four digits, for findings: reports have all digits in `measures`.
std::string rounded(double value);
/// Six digits, for what `info` says.
std::string short_number(double value);
/// A name between quotes, as it is.
std::string quoted(std::string_view name);
/// The first 40 characters of a word of a file between quotes, what is not printable ASCII as '?'; "..." where more follows.
std::string quoted_start(std::string_view word);

}  // namespace geomend
