// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstring>

#include "formats/gocad/object_scanner.h"

namespace geomend::gocad {

/// Whether a line begins with a word (given with its blank) and goes on after it.
template <std::size_t N>
bool starts_with(const char* p, const char* end, const char (&word)[N]) {
    return static_cast<std::size_t>(end - p) >= N && std::memcmp(p, word, N - 1) == 0;
}

/// Walks over the lines of an object's body: scan(p, end, line) takes a line as programs write them and gives the
/// start of the next one, or nullptr; then take(cursor) reads that line with care. False when the user has stopped the
/// work. Cost: one pass.
template <class Scanner, class Scan, class Take>
bool walk_lines(Scanner& scanner, const Scan& scan, const Take& take) {
    constexpr std::uint64_t lines_between_looks = 1u << 16;
    const char* p = scanner.frame.body.data();
    const char* const end = p + scanner.frame.body.size();
    TextCursor cursor = scanner.text();
    std::uint64_t line = scanner.frame.body_line;
    std::uint64_t next_look = line + lines_between_looks;
    while (p != end) {
        const char* next = scan(p, end, line);
        if (next != nullptr) [[likely]] {
            p = next;
            ++line;
        } else {
            cursor.jump(p, line);
            cursor.next_line();
            take(cursor);
            p = cursor.next_line_begin();
            line = cursor.line() + 1;
        }
        if (line >= next_look) {
            if (scanner.stopped()) return false;
            next_look = line + lines_between_looks;
        }
    }
    return true;
}

}  // namespace geomend::gocad
