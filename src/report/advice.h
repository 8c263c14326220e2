// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>

#include "base/finding.h"

namespace geomend {

/// What mends findings of a code, for people: it may name commands and options. A code that is found in several situations has a row
/// for each, which is told by a measure that its findings have.
struct Advice {
    std::string_view code, text;
    std::string_view measure = {};  ///< of findings in this situation; empty: of all others
};

/// All rows, in the order of the codes, those of situations before that of all others.
std::span<const Advice> advice_rows();

/// What mends a finding in its situation. Empty where nothing mends it.
std::string_view advice_for(const Finding& finding);

/// What mends findings of a code, where nothing is known of their situation. Empty where nothing mends them.
std::string_view advice_for(std::string_view code);

}  // namespace geomend
