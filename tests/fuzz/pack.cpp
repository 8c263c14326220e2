// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cctype>

#include "whole_path.h"

namespace geomend::test {

namespace {

constexpr std::string_view mark = "%%% ";

// A relative path of at most one folder, with plain characters.
std::string safe_name(std::string_view text) {
    std::string name;
    bool folder = false;
    for (const char c : text.substr(0, 60)) {
        if (c == '/' && !folder && !name.empty()) {
            folder = true;
            name += c;
        } else if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '@' ||
                   (c == '.' && !name.empty() && name.back() != '/')) {
            name += c;
        }
    }
    if (name.empty() || name.back() == '/') name += "fuzz";
    return name;
}

// Where the next line that names a file begins, from `at` on, which is the begin of a line.
std::size_t next_mark(std::string_view bytes, std::size_t at) {
    if (bytes.substr(at).starts_with(mark)) return at;
    const std::size_t found = bytes.find("\n%%% ", at);
    return found == std::string_view::npos ? found : found + 1;
}

}  // namespace

Pack unpack(std::string_view bytes) {
    Pack pack;
    const std::size_t head = std::min(bytes.size(), pack.plan.size());
    std::transform(bytes.begin(), bytes.begin() + head, pack.plan.begin(), [](char c) { return static_cast<std::uint8_t>(c); });
    bytes.remove_prefix(head);
    std::size_t at = next_mark(bytes, 0);
    if (at != 0) {
        pack.files.push_back({"fuzz", std::string(bytes.substr(0, at))});
    }
    while (at != std::string_view::npos) {
        const std::size_t line_end = std::min(bytes.find('\n', at), bytes.size());
        const std::size_t content = std::min(line_end + 1, bytes.size());
        const std::size_t next = next_mark(bytes, content);
        pack.files.push_back({safe_name(bytes.substr(at + mark.size(), line_end - at - mark.size())),
                              std::string(bytes.substr(content, next == std::string_view::npos ? next : next - content))});
        at = next;
    }
    return pack;
}

// A content without a last line feed gets none: the line of the next file begins where it ends only after one.
std::string pack_text(const Pack& pack) {
    std::string text(pack.plan.begin(), pack.plan.end());
    for (const Pack::File& file : pack.files) {
        if (text.size() > pack.plan.size() && text.back() != '\n') text += '\n';
        text.append(mark).append(file.name).append("\n").append(file.content);
    }
    return text;
}

}  // namespace geomend::test
