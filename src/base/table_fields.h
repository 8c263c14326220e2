// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

namespace geomend {

/// What parts the columns of a line of a table: the first of semicolon, comma and tab that occurs, else the blank.
char separator_of(std::string_view line);

/// The text without blanks around it, and without the double quotes that hold all of it.
std::string_view without_quotes(std::string_view text);

/// The fields of a line of a table, without quotes; where blanks part them, its words. A separator within double quotes is none.
std::vector<std::string_view> fields_of(std::string_view line, char separator);

}  // namespace geomend
