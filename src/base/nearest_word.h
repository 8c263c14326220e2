// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace geomend {

/// The word of a list that another one was probably meant to be: with the fewest letters to put in, take out, change or swap with
/// the next one, without regard to case; the first of equals. Empty where more than every third letter differs from all: a word of two
/// letters is one step away from many that mean something else. Only the first 100 bytes of the word count.
/// Cost: the length of the word times that of all in the list.
std::string_view nearest_word(std::string_view word, std::span<const std::string_view> known);
/// "; the nearest is 'WORD'", or nothing where there is none: the end of a message.
std::string nearest_hint(std::string_view word, std::span<const std::string_view> known);

}  // namespace geomend
