// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "base/monitor.h"

// Large records of numbers: the text is cut into pieces at line ends, several of which are read at the same time.

namespace geomend::grdecl {

/// What stands for an element that is not set, in memory: simulators' own no-data value, and a whole number that is none.
inline constexpr double unset_real = static_cast<double>(-9.99e20F);
inline constexpr std::int32_t unset_whole = -2147483647;

template <class T>
constexpr T unset_value() {
    if constexpr (std::numeric_limits<T>::is_integer) return unset_whole;
    else return unset_real;
}

enum class ArrayStatus : std::uint8_t { ok, malformed, not_finite, out_of_range, bad_repeat, too_many, cancelled };

struct ArrayScan {
    ArrayStatus status = ArrayStatus::ok;
    std::uint64_t count = 0;   ///< values that the text holds, repeats counted; stops growing at 2^62
    const char* at = nullptr;  ///< the item that is wrong, or the first one too many
    bool whole = true;         ///< every value is written as a whole number that fits 32 bits
    bool defaults = false;     ///< N* occurs
};

/// Reads numbers (of type double or int32) from the text of a record, without its '/'. Elements left out by N* become
/// unset_value(). `values` gets at most `room` elements; where the text has more, the status is too_many and count
/// tells how many. Nothing is stored where room is 0: then it only counts.
/// Cost: linear, on all threads; a few MB besides `values`.
template <class T>
ArrayScan read_numbers(std::string_view text, std::uint64_t room, std::vector<T>& values, const Monitor* monitor);

/// The item of a text of numbers with which it passes `room` values, or the end of the text.
const char* item_beyond(std::string_view text, std::uint64_t room);

extern template ArrayScan read_numbers(std::string_view, std::uint64_t, std::vector<double>&, const Monitor*);
extern template ArrayScan read_numbers(std::string_view, std::uint64_t, std::vector<std::int32_t>&, const Monitor*);

}  // namespace geomend::grdecl
