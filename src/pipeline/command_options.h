// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>

#include "formats/option_row.h"

namespace geomend {

/// What each command looks at of the options given with --option, beside those of the formats.
std::span<const OptionRow> info_option_rows();
std::span<const OptionRow> convert_option_rows();
std::span<const OptionRow> validate_option_rows();
std::span<const OptionRow> repair_option_rows();
std::span<const OptionRow> grid_option_rows();

}  // namespace geomend
