// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "base/result.h"

namespace geomend::cli {

/// What the process tells its caller (see geomend.1).
enum class ExitStatus : int {
    done = 0,
    findings = 1,
    usage = 2,
    unreadable = 3,
    unwritable = 4,
    limit = 5,
    invalid_result = 6,
    internal = 70,
    interrupted = 130
};

inline ExitStatus exit_status(FailureKind kind) {
    switch (kind) {
        case FailureKind::usage:
            return ExitStatus::usage;
        case FailureKind::unreadable:
            return ExitStatus::unreadable;
        case FailureKind::unwritable:
        case FailureKind::cannot_hold:
            return ExitStatus::unwritable;
        case FailureKind::limit:
            return ExitStatus::limit;
        case FailureKind::cancelled:
            return ExitStatus::interrupted;
        case FailureKind::internal:
            break;
    }
    return ExitStatus::internal;
}

/// The worse of two, for runs over several files: 70, then 130, 2, 3, 4, 5, 6, 1, 0.
inline ExitStatus worse(ExitStatus a, ExitStatus b) {
    constexpr ExitStatus order[] = {ExitStatus::internal,   ExitStatus::interrupted, ExitStatus::usage,          ExitStatus::unreadable,
                                    ExitStatus::unwritable, ExitStatus::limit,       ExitStatus::invalid_result, ExitStatus::findings};
    for (const ExitStatus s : order) {
        if (a == s || b == s) return s;
    }
    return ExitStatus::done;
}

}  // namespace geomend::cli
