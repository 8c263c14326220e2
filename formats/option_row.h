// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace geomend {

/// KEY=VALUE options, as given with --option.
using FormatOptions = std::vector<std::pair<std::string, std::string>>;

/// The last value given for a key, or an empty view.
inline std::string_view option_value(const FormatOptions& options, std::string_view key) {
    std::string_view value;
    for (const auto& [k, v] : options) {
        if (k == key) value = v;
    }
    return value;
}

/// What an option may be set to.
enum class OptionValue : std::uint8_t {
    words,         ///< one of the words of `values`, divided by '|'; letters of either case
    text,          ///< anything, such as a name
    length,        ///< a number of 0 or more
    whole_number,  ///< 0 or more
    whole_numbers  ///< some, divided by commas
};

/// When a format looks at an option.
enum class OptionUse : std::uint8_t { reading, writing, both };

/// One option: a row of a format's table, or of a command's.
struct OptionRow {
    std::string_view key;
    OptionUse use;
    OptionValue kind;
    std::string_view values;   ///< the words, or how manuals write the value: "NAME", "N,M,..."
    std::string_view meaning;  ///< one line
};

}  // namespace geomend
