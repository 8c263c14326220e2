// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "base/finding.h"

namespace geomend {

/// The severity of a code in one case that differs from the others.
struct OtherSeverity {
    Severity severity;
    std::string_view when;  ///< "where ...", without the word
};

/// One row of the catalogue of findings. Codes are stable and never reused.
struct CodeInfo {
    std::string_view code;
    Severity severity;
    std::string_view meaning;  ///< one line
    std::optional<OtherSeverity> other = std::nullopt;
};

/// All codes, in order.
std::span<const CodeInfo> code_catalogue();

/// The row of a code, or nullptr.
const CodeInfo* find_code(std::string_view code);

}  // namespace geomend
