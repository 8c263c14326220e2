// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>

#include "base/result.h"
#include "model/dataset.h"
#include "validators/grid_scope.h"

// Which findings a user asks for with --checks and --skip. A word of these lists is a code (B08), a family by its letter (B), or
// a pattern in which * stands for any characters and ? for one (M2*, C0?).

namespace geomend::validators {

/// Whether a word is a code, its family or a pattern that it fits.
bool stands_for(std::string_view word, std::string_view code);

/// Findings that nobody can leave out: a file could not be read or written, or the work was not done (F001 to F099), or
/// coordinates do not allow to judge anything (M09). Without them a report would call valid what it has not seen.
bool always_reported(std::string_view code);

/// Failure (usage) where a word of `only` or `skip` stands for no code, with the code that is most like it; where a code is
/// named to be skipped that is always told; and where there is no such target.
Result<void> known_codes(const CheckOptions& options);

/// Whether the options ask for findings of a code. What is always told is always wanted.
bool wanted(const CheckOptions& options, std::string_view code);

/// Whether the options leave findings of a code out by --skip.
bool skipped(const CheckOptions& options, std::string_view code);

/// Whether the options leave out a code that might be reported of the dataset as a warning or an error: codes of checks that look
/// at objects such as there are, and remarks of readers.
bool leaves_checks_out(const CheckOptions& options, const Dataset& dataset);

/// Whether any of the checks that judge models is wanted: not where only remarks of readers are.
bool judges_anything(const CheckOptions& options);

/// The code that differs from a word in the fewest letters, without regard to case; the lowest of several.
std::string_view nearest_code(std::string_view word);

}  // namespace geomend::validators
