// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>

#include "base/number_text.h"
#include "base/text_cursor.h"
#include "formats/grdecl/deck_reader.h"

// Text behind a keyword on its line. Simulators take nothing there: the data of a keyword begin on the next line. Many
// files have them on the same line, though, and they are read there, too; so it has to be told what the text is.

namespace geomend::grdecl {

namespace {

bool opens_quote(char c) { return c == '\'' || c == '"'; }

/// The items of a line, without its comment; quotes stay on. At most `most` of them.
std::vector<std::string_view> words_of(std::string_view line, std::size_t most) {
    std::vector<std::string_view> words;
    std::size_t at = 0;
    while (words.size() < most) {
        while (at < line.size() && is_separator(line[at])) ++at;
        if (at == line.size() || line.substr(at).starts_with("--")) break;
        const std::size_t begin = at;
        if (opens_quote(line[at])) {
            at = std::min(line.find(line[at], at + 1), line.size() - 1) + 1;
        } else {
            while (at < line.size() && !is_separator(line[at]) && !line.substr(at).starts_with("--")) ++at;
        }
        words.push_back(line.substr(begin, at - begin));
    }
    return words;
}

/// 12, 1.5E3, 3*0.2, 4*, * and their like, with or without a '/' behind.
bool begins_like_number(std::string_view word) {
    if (word.starts_with('/')) return true;
    word = word.substr(0, word.find('/'));
    if (const std::size_t star = word.find('*'); star != std::string_view::npos) {
        std::uint64_t count = 0;
        if (star > 0 && parse_integer(word.substr(0, star), count) != NumberStatus::ok) return false;
        word.remove_prefix(star + 1);
        return word.empty() || opens_quote(word[0]) || begins_like_number(word);
    }
    double value = 0;
    return !word.empty() && parse_real(word, value) != NumberStatus::malformed;
}

/// A '/' that ends a record: behind items, or glued to the last one. Those within words and paths are none.
bool has_ending_slash(const std::vector<std::string_view>& words) {
    return std::ranges::any_of(words, [](std::string_view w) { return !opens_quote(w[0]) && (w == "/" || w.ends_with('/')); });
}

bool is_edited_array(std::string_view word) { return opens_quote(word[0]) || cell_keyword(known_name(word)).has_value(); }

/// Whether words are what a record of a keyword of words begins with.
bool begins_record(std::string_view keyword, const std::vector<std::string_view>& words) {
    if (has_ending_slash(words)) return true;
    const bool second_is_number = words.size() > 1 && begins_like_number(words[1]);
    if (keyword == "FAULTS" || keyword == "MULTFLT" || keyword == "CARFIN") return second_is_number && !words[0].starts_with('(');
    if (keyword.starts_with("COPY")) return words.size() > 1 && is_edited_array(words[0]) && is_edited_array(words[1]);
    if (is_edit(keyword)) return second_is_number && is_edited_array(words[0]);
    return opens_quote(words[0][0]);
}

}  // namespace

/// Goes over the text behind a keyword on its line, where it is no data.
void DeckReader::take_line_remark() {
    const std::string_view line = in().rest_of_line();
    const std::vector<std::string_view> words = words_of(line, 16);
    if (words.empty()) return;
    const std::string_view behind =
        std::string_view(line.data() + line.size(), static_cast<std::size_t>(in().end() - line.data()) - line.size());
    const std::size_t next = behind.find_first_not_of(" \t\r\n");
    const char follows = next == std::string_view::npos ? '\0' : behind[next];
    const std::string_view next_line =
        next == std::string_view::npos ? std::string_view{} : behind.substr(next, behind.find('\n', next) - next);
    const bool number_follows = follows != '/' && !words_of(next_line, 1).empty() && begins_like_number(words_of(next_line, 1)[0]);
    switch (first_item(word_)) {
        case FirstItem::nothing: {
            // Several keywords on one line, as some files have them. Names of sections and END are words of remarks there.
            const auto is_alone = [](std::string_view w) { return shape_of(known_name(w)) == Shape::alone; };
            if (section_of(word_) == Section::none && std::ranges::all_of(words, is_alone)) return;
            break;
        }
        case FirstItem::number:
            if (words[0].starts_with('/') && number_follows) break;
            if (begins_like_number(words[0]) || (has_ending_slash(words) && !(follows >= '0' && follows <= '9'))) return;
            break;
        case FirstItem::word:
            if (words[0].starts_with('/') ? !begins_record(word_, words_of(next_line, 16)) : follows == '/' || begins_record(word_, words))
                return;
            break;
        case FirstItem::path:
            if (words[0].starts_with('/') && opens_quote(follows)) break;
            if (opens_quote(words[0][0]) || follows == '/' || has_ending_slash(words) || !opens_quote(follows)) return;
            break;
        case FirstItem::any:
            return;
    }
    const bool says_something = std::ranges::any_of(
        line.substr(0, line.find("--")), [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); });
    if (says_something) note_remark(words[0].data());
    in().skip_line();
}

void DeckReader::note_remark(const char* at) {
    if (!probing_) notes_.remarks.add([&] { return where(at); });
}

/// Goes to the line below the keyword that ends at `begin`; false where nothing stands beside it.
bool DeckReader::go_behind_remark(const char* begin) {
    in().jump(begin);
    if (words_of(in().rest_of_line(), 1).empty()) return false;
    in().skip_line();
    return true;
}

/// Values on the lines below an unknown keyword with text beside it: whether they were taken as a property.
bool DeckReader::unknown_below_remark(const std::string& name, OptionalFailure& failed) {
    const char* begin = in().at();
    const std::string_view line = in().rest_of_line();
    const std::vector<std::string_view> words = words_of(line, 16);
    if (words.empty() || begins_like_number(words[0]) || opens_quote(words[0][0]) || has_ending_slash(words)) return false;
    in().skip_line();
    if (in().skip() && begins_like_number(Scanner(in()).item().text) && unknown_numbers(name, failed)) {
        note_remark(words[0].data());
        return true;
    }
    in().jump(begin);
    return false;
}

}  // namespace geomend::grdecl
