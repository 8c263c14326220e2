// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>

#include "base/finding.h"

namespace geomend {

/// One row of the catalogue of findings. Codes are stable and never reused.
struct CodeInfo {
    std::string_view code;
    Severity severity;
    std::string_view meaning;  ///< one line
    std::string_view fix;      ///< what repairs it; empty where nothing does
};

/// All codes, in order.
std::span<const CodeInfo> code_catalogue();

/// The row of a code, or nullptr.
const CodeInfo* find_code(std::string_view code);

}  // namespace geomend
