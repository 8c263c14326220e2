// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>

#include "formats/format.h"

namespace geomend {

/// What looks at the options of one run.
struct OptionsInPlay {
    std::vector<const Format*> read;     ///< the formats of the inputs; empty: not known yet, so that those of all formats are taken
    const Format* written = nullptr;     ///< nullptr: nothing is written
    std::span<const OptionRow> command;  ///< what the command itself looks at
};

/// Options with words as their tables write them. Failure (usage, F018) where a key or value is in no table in play: it names the one
/// that is spelt nearly so, or where the option belongs, or all that are known.
Result<FormatOptions> checked_options(const FormatOptions& options, const OptionsInPlay& in_play);

}  // namespace geomend
