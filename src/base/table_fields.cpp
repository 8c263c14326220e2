// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/table_fields.h"

#include "base/text_cursor.h"

namespace geomend {

namespace {

std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    TextCursor cursor(line);
    cursor.next_line();
    bool quoted = false;
    for (std::string_view t = cursor.quoted_token(&quoted); !t.empty() || quoted; t = cursor.quoted_token(&quoted)) words.push_back(t);
    return words;
}

}  // namespace

char separator_of(std::string_view line) {
    for (const char c : {';', ',', '\t'}) {
        if (line.find(c) != std::string_view::npos) return c;
    }
    return ' ';
}

std::string_view without_quotes(std::string_view text) {
    text = trimmed(text);
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = trimmed(text.substr(1, text.size() - 2));
    return text;
}

std::vector<std::string_view> fields_of(std::string_view line, char separator) {
    if (separator == ' ') return words_of(line);
    std::vector<std::string_view> fields;
    std::size_t begin = 0;
    bool quoted = false;
    for (std::size_t at = 0; at <= line.size(); ++at) {
        if (at < line.size() && line[at] == '"') quoted = !quoted;
        if (at < line.size() && (quoted || line[at] != separator)) continue;
        fields.push_back(without_quotes(line.substr(begin, at - begin)));
        begin = at + 1;
    }
    return fields;
}

}  // namespace geomend
