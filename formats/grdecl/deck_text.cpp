// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/grdecl/deck_text.h"

#include <algorithm>
#include <cstring>

#include "base/mapped_pages.h"
#include "base/number_text.h"

namespace geomend::grdecl {

namespace {

constexpr std::uint64_t longest_record = 1'000'000;  // of items with repeats written out; arrays are read by other means

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
bool is_quote(char c) { return c == '\'' || c == '"'; }

const char* line_end(const char* at, const char* end) {
    const void* newline = std::memchr(at, '\n', static_cast<std::size_t>(end - at));
    return newline == nullptr ? end : static_cast<const char*>(newline);
}

Failure bad_repeat(const Scanner& in, const Item& item) {
    return unreadable("F012", in.location(item.at),
                      "expected a repeat count (a whole number from 1) before '*', found " + shown(item.text));
}

/// Splits "N*" or "N*value"; count 0 where it is neither.
struct Repeat {
    std::uint64_t count = 0;
    std::string_view value;
    bool bad = false;
};

Repeat repeat_of(const Item& item) {
    if (item.quoted) return {};
    const std::size_t star = item.text.find('*');
    if (star == std::string_view::npos) return {};
    const std::string_view digits = item.text.substr(0, star);
    Repeat r{0, item.text.substr(star + 1)};
    if (digits.empty()) {
        if (r.value.empty()) r.count = 1;
        else r.bad = true;
        return r;
    }
    if (!std::ranges::all_of(digits, is_digit)) return {};
    r.bad = parse_integer(digits, r.count) != NumberStatus::ok || r.count == 0;
    return r;
}

}  // namespace

bool is_separator(char c) { return c == ' ' || c == ',' || (c >= '\t' && c <= '\r') || c == '\1'; }

bool is_keyword(std::string_view word) {
    return !word.empty() && is_letter(word.front()) &&
           std::ranges::all_of(word, [](char c) { return is_letter(c) || is_digit(c) || c == '-' || c == '_' || c == '+'; });
}

Location location_of(const Input& input, const char* at) {
    const std::string_view bytes = input.bytes();
    Location where{input.name(), 1, 1};
    if (bytes.empty() || at == nullptr) return where;
    const char* line = bytes.data();
    for (const char* p = line; (p = line_end(p, at)) != at; line = ++p) ++where.line;
    where.column = static_cast<std::uint32_t>(at - line + 1);
    return where;
}

std::string shown(std::string_view token) {
    if (token.empty()) return "nothing";
    constexpr std::size_t longest = 40;
    return "'" + std::string(token.substr(0, longest)) + (token.size() > longest ? "...'" : "'");
}

const char* find_slash(const char* at, const char* end) {
    constexpr std::ptrdiff_t window = std::ptrdiff_t{1} << 24;
    const char* begin = at;
    while (at != end) {
        const auto size = static_cast<std::size_t>(std::min(end - at, window));
        const void* found = std::memchr(at, '/', size);
        if (found == nullptr) {
            if (size == static_cast<std::size_t>(window)) release_mapped_pages({at, size});  // they are read again piece by piece
            at += size;
            continue;
        }
        const char* slash = static_cast<const char*>(found);
        const char* line = slash;
        while (line != begin && line[-1] != '\n') --line;
        const std::string_view before(line, static_cast<std::size_t>(slash - line));
        if (before.find("--") == std::string_view::npos) return slash;
        at = line_end(slash, end);
    }
    return end;
}

Scanner::Scanner(const Input& input) : input_(&input), at_(input.bytes().data()), end_(at_ + input.bytes().size()) {
    if (input.bytes().starts_with(byte_order_mark)) at_ += byte_order_mark.size();
}

bool Scanner::skip() {
    while (at_ != end_) {
        if (is_separator(*at_)) ++at_;
        else if (*at_ == '-' && at_ + 1 != end_ && at_[1] == '-') at_ = line_end(at_, end_);
        else return true;
    }
    return false;
}

Item Scanner::item() {
    if (!skip()) return {};
    const char* begin = at_;
    if (*at_ == '/') {
        at_ = line_end(at_, end_);  // the rest of the line is a remark
        return {{begin, 1}, begin};
    }
    if (is_quote(*at_)) {
        const char* stop = line_end(at_, end_);
        const void* closing = std::memchr(at_ + 1, *at_, static_cast<std::size_t>(stop - at_ - 1));
        const char* last = closing == nullptr ? stop : static_cast<const char*>(closing);
        at_ = closing == nullptr ? stop : last + 1;
        return {{begin + 1, static_cast<std::size_t>(last - begin - 1)}, begin, true};
    }
    while (at_ != end_ && !is_separator(*at_) && *at_ != '/' && !is_quote(*at_)) {
        if (*at_ == '-' && at_ + 1 != end_ && at_[1] == '-') break;
        ++at_;
    }
    return {{begin, static_cast<std::size_t>(at_ - begin)}, begin};
}

bool Scanner::word_alone_follows(std::string_view& word) {
    if (!skip() || is_quote(*at_)) return false;
    const char* begin = at_;
    while (begin != input_->bytes().data() && begin[-1] != '\n') {
        if (!is_separator(*--begin)) return false;
    }
    Scanner ahead(*this);
    word = ahead.item().text;
    const char* end = ahead.at();
    return !word.empty() && is_letter(word.front()) && (!ahead.skip() || std::find(end, ahead.at(), '\n') != ahead.at());
}

Result<Record> Scanner::record(std::string_view keyword, const RecordRule& rule) {
    Record record;
    skip();
    record.begin = at_;
    const char* last = at_;  // the end of the last item
    for (;; last = at_) {
        const bool more = skip() && *at_ != '/';
        if (more && rule.most > 0 && record.items.size() >= rule.most) {
            if (!rule.may_lack_slash || std::find(last, at_, '\n') == at_)
                return unreadable("F008", here(),
                                  "expected '/' after the " + std::to_string(rule.most) + (rule.most == 1 ? " item" : " items") + " of " +
                                      std::string(keyword) + ", found " + shown(Scanner(*this).item().text));
            record.slash = at_;
            record.slash_missing = true;
            return record;
        }
        std::string_view word;
        if (more && rule.known != nullptr && !record.items.empty() && record.items.size() >= rule.words && word_alone_follows(word) &&
            rule.known(word)) {
            return unreadable("F008", here(),
                              "expected the '/' that ends the record of " + std::string(keyword) + ", found the keyword " + shown(word));
        }
        Item next = item();
        if (next.at == nullptr) {
            return unreadable("F004", here(),
                              "expected a '/' that ends the record of " + std::string(keyword) + ", found the end of the file");
        }
        if (!next.quoted && next.text == "/") {
            record.slash = next.at;
            return record;
        }
        const Repeat repeat = repeat_of(next);
        if (repeat.bad) return bad_repeat(*this, next);
        if (repeat.count == 0) {
            record.items.push_back(next);
            continue;
        }
        if (repeat.count > longest_record || record.items.size() + repeat.count > longest_record) {
            return unreadable("F014", location(next.at),
                              "the record of " + std::string(keyword) + " repeats an item too often: " + shown(next.text));
        }
        Item copy{repeat.value, next.at, false, !repeat.value.empty()};
        if (repeat.value.empty() && at_ != end_ && is_quote(*at_)) copy = item();
        record.items.insert(record.items.end(), static_cast<std::size_t>(repeat.count), copy);
    }
}

bool Scanner::take_slash() {
    if (!skip() || *at_ != '/') return false;
    at_ = line_end(at_, end_);
    return true;
}

void Scanner::after_slash(const char* slash) { at_ = line_end(slash, end_); }

void Scanner::skip_line() {
    at_ = line_end(at_, end_);
    if (at_ != end_) ++at_;
}

std::string_view Scanner::rest_of_line() const { return {at_, static_cast<std::size_t>(line_end(at_, end_) - at_)}; }

bool Scanner::data_follows(bool first, bool (*known)(std::string_view)) {
    if (!skip()) return false;
    if (*at_ == '/') return first;
    Scanner ahead(*this);
    const Item word = ahead.item();
    // What else stands on its line?
    std::size_t words = 1;
    bool slash = false;
    const char* stop = line_end(at_, end_);
    while (ahead.skip() && ahead.at() < stop && !slash) {
        slash = *ahead.at() == '/';
        ahead.item();
        ++words;
    }
    if (word.quoted) return first || words > 1;
    if (!is_letter(word.text.front())) return true;
    if (words == 1) return false;
    if (slash && words == 2) return !known(word.text);
    return slash || first || !known(word.text);
}

}  // namespace geomend::grdecl
