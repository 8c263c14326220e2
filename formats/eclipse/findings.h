// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <utility>

#include "base/finding.h"

namespace geomend::eclipse {

/// A finding of the reader; `count` says how often.
inline Finding finding(const char* code, Severity severity, std::string message, Location where, std::uint64_t count = 1) {
    Finding f;
    f.code = code;
    f.severity = severity;
    f.message = std::move(message);
    f.where = std::move(where);
    f.count = count;
    return f;
}

}  // namespace geomend::eclipse
