// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "base/codes.h"
#include "base/input.h"
#include "base/number_text.h"
#include "base/text_cursor.h"
#include "formats/byte_order_mark.h"
#include "model/dataset.h"

// What readers of plain text files have in common.

namespace geomend {

/// The text of a file, behind a byte order mark.
inline std::string_view text_of(const Input& input) { return without_byte_order_mark(input.bytes()); }

/// File name without folder, ".gz" and extension: for formats that name no objects.
inline std::string name_of(const Input& input) {
    std::string name = input.base_name();
    const std::size_t dot = name.rfind('.');
    if (dot != std::string::npos && dot > 0) name.resize(dot);
    return name;
}

/// Location of a token that lies in the current line of a cursor, or of the line where the token is empty.
inline Location location_of(const Input& input, const TextCursor& cursor, std::string_view token) {
    Location where{input.name(), cursor.line(), cursor.column()};
    const std::string_view line = cursor.line_text();
    if (!token.empty() && token.data() >= line.data() && token.data() < line.data() + line.size()) {
        where.column = static_cast<std::uint32_t>(token.data() - line.data() + 1);
    }
    return where;
}

/// "'1.2.3'" cut to a length fit for a message, or "the end of the line".
inline std::string shown(std::string_view token) {
    if (token.empty()) return "the end of the line";
    constexpr std::size_t longest = 40;
    return "'" + std::string(token.substr(0, longest)) + (token.size() > longest ? "...'" : "'");
}

/// Reads the next token of a line as a finite number. The failure says what was expected.
inline std::optional<Failure> finite_number(const Input& input, TextCursor& cursor, std::string_view token, std::string_view what,
                                            double& value) {
    const NumberStatus status = parse_real(token, value);
    if (status == NumberStatus::ok && std::isfinite(value)) return std::nullopt;
    const bool not_finite = status != NumberStatus::malformed;
    return unreadable(not_finite ? "F006" : "F005", location_of(input, cursor, token),
                      "expected " + std::string(what) + (not_finite ? " as a finite number" : "") + ", found " + shown(token));
}

/// The failure of stopped work (F022).
inline Failure stopped(const Input& input) { return failure(FailureKind::cancelled, "F022", {input.name()}, "reading was stopped"); }

/// A finding F101 when the last line has no line end, so that its last number may be cut short.
inline void tell_missing_line_end(const Input& input, Dataset& dataset) {
    const std::string_view bytes = input.bytes();
    if (bytes.empty() || bytes.back() == '\n' || bytes.back() == '\r') return;
    dataset.findings.push_back(make_finding("F101", "the last line has no line end: the file may have been cut short", {input.name()}, 0));
}

}  // namespace geomend
