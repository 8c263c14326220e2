// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/result.h"

#include "base/codes.h"

namespace geomend {

std::string to_string(const Location& where) {
    std::string text = where.file;
    if (where.line > 0) {
        text += ':' + std::to_string(where.line);
        if (where.column > 0) text += ':' + std::to_string(where.column);
    } else if (where.offset >= 0) {
        text += ": byte " + std::to_string(where.offset);
    }
    return text;
}

Finding make_finding(std::string_view code, std::string message, Location where, std::uint64_t count) {
    Finding f;
    f.code = code;
    const CodeInfo* row = find_code(code);
    f.severity = row != nullptr ? row->severity : Severity::error;
    f.message = std::move(message);
    f.where = std::move(where);
    f.count = count;
    return f;
}

void use_other_severity(Finding& finding) {
    const CodeInfo* row = find_code(finding.code);
    assert(row != nullptr && row->other);
    finding.severity = row->other->severity;
}

Failure failure(FailureKind kind, std::string code, Location where, std::string message) {
    Failure f;
    f.kind = kind;
    f.error.code = std::move(code);
    f.error.severity = Severity::error;
    f.error.where = std::move(where);
    f.error.message = std::move(message);
    return f;
}

Failure unreadable(std::string code, Location where, std::string message) {
    return failure(FailureKind::unreadable, std::move(code), std::move(where), std::move(message));
}

}  // namespace geomend
