// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/grdecl/section_words.h"

#include <algorithm>
#include <array>

#include "base/text_cursor.h"
#include "formats/grdecl/deck_text.h"
#include "formats/grdecl/flow_words.h"

namespace geomend::grdecl {

namespace {

/// The line without its remark, which "--" begins outside of quotes.
std::string_view without_remark(std::string_view line) {
    char quote = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (quote != 0) quote = line[i] == quote ? '\0' : quote;
        else if (line[i] == '\'' || line[i] == '"') quote = line[i];
        else if (line.substr(i, 2) == "--") return line.substr(0, i);
    }
    return line;
}

/// Names of summary vectors are made of a letter for what they are about and others for what it is: with these letters, none is known to be
/// wrong. Of the rest the few that do not begin so.
bool may_be_summary_vector(std::string_view word) {
    constexpr auto others = std::to_array<std::string_view>({"DATE", "DAY", "ELAPSED", "MONTH", "PERFORMA", "YEAR"});
    constexpr auto beginnings = std::to_array<std::string_view>({"HM", "MAX", "MEM", "ML", "MS", "ZIP"});
    return std::string_view("ABCFGLNRSTW").find(word[0]) != std::string_view::npos || std::ranges::find(others, word) != others.end() ||
           std::ranges::any_of(beginnings, [&](std::string_view b) { return word.starts_with(b); });
}

}  // namespace

std::string SectionWords::unknown_in(std::string_view line) {
    const bool indented = !line.empty() && (line[0] == ' ' || line[0] == '\t');
    const std::string_view text = trimmed(without_remark(line));
    if (text.empty()) return {};
    const bool may_begin = may_begin_;
    may_begin_ = text.back() == '/';
    if (indented || !may_begin || !is_keyword(text) || text.find('/') != std::string_view::npos) return {};
    std::string word = upper_case(text);
    const bool is_known = flow_reads(word) || (section_ == Section::summary && may_be_summary_vector(word));
    // Vectors of the field take no record; what the others take is read up to its slash.
    may_begin_ = section_ == Section::summary && (word[0] == 'F' || !may_be_summary_vector(word));
    return is_known ? std::string() : word;
}

std::string SectionWords::fault_in(std::string_view line) {
    if (section_ != Section::schedule) return {};
    const std::string_view text = trimmed(without_remark(line));
    if (text.empty()) return {};
    if (!in_faults_ || text[0] == '/') {
        in_faults_ = !in_faults_ && upper_case(text) == "MULTFLT";
        return {};
    }
    const bool quoted = text[0] == '\'' || text[0] == '"';
    const std::string_view rest = quoted ? text.substr(1) : text;
    return std::string(trimmed(rest.substr(0, quoted ? rest.find(text[0]) : rest.find_first_of(" \t/"))));
}

}  // namespace geomend::grdecl
