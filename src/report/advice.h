// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>

namespace geomend {

/// What mends a finding of a code, for people: it may name commands and options. Empty where nothing mends it.
std::string_view advice_for(std::string_view code);

}  // namespace geomend
