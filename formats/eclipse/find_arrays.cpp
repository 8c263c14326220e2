// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <cstring>

#include "formats/eclipse/arrays.h"
#include "formats/eclipse/byte_order.h"

namespace geomend::eclipse {

namespace {

constexpr std::uint64_t header_bytes = 16, framed_header = header_bytes + 8;
constexpr std::uint64_t largest_count = std::uint64_t{1} << 62;

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

std::string without_trailing_blanks(std::string_view text) {
    while (!text.empty() && (text.back() == ' ' || text.back() == '\0')) text.remove_suffix(1);
    return std::string(text);
}

bool is_name(std::string_view name) {
    return !name.empty() && std::ranges::all_of(name, [](char c) { return c >= ' ' && c <= '~'; });
}

/// Sets type and size of a value from the word of the header.
bool take_type(std::string_view word, Array& array) {
    struct Row {
        std::string_view word;
        ArrayType type;
        std::uint32_t size;
    };
    constexpr Row rows[] = {{"INTE", ArrayType::integer, 4}, {"REAL", ArrayType::real, 4}, {"DOUB", ArrayType::real_double, 8},
                            {"LOGI", ArrayType::logical, 4}, {"CHAR", ArrayType::text, 8}, {"MESS", ArrayType::message, 0}};
    for (const Row& row : rows) {
        if (row.word != word) continue;
        array.type = row.type;
        array.element_size = row.size;
        return true;
    }
    if (word.size() != 4 || word[0] != 'C') return false;
    std::uint32_t size = 0;
    const auto [stop, error] = std::from_chars(word.data() + 1, word.data() + 4, size);
    if (error != std::errc{} || stop != word.data() + 4 || size == 0) return false;
    array.type = ArrayType::text;
    array.element_size = size;
    return true;
}

/// Arrays of more than 2^31 - 1 values have a header of this type before their own; its count, negative, times
/// 2^31 is added to that of the second header.
constexpr std::string_view long_count_type = "X231";

struct Header {
    std::string name;
    std::string type;
    std::int64_t count = 0;
};

std::string shown(const Header& header) { return "'" + header.name + "' of " + std::to_string(header.count) + " " + header.type; }

// ---- binary ----

class BinaryFinder {
public:
    BinaryFinder(ArrayFile& file, const Monitor* monitor) : file_(file), bytes_(file.input.bytes()), monitor_(monitor) {}

    Result<void> run() {
        std::uint64_t at = 0;
        while (at < bytes_.size()) {
            if ((file_.arrays.size() & 1023u) == 0 && monitor_ != nullptr && monitor_->stopped()) return stopped();
            Array array;
            array.header = at;
            if (auto done = take_header(at, array); !done) return done;
            if (auto done = take_extent(at, array); !done) return done;
            at = array.end;
            file_.arrays.push_back(std::move(array));
        }
        return {};
    }

private:
    Failure stopped() const { return failure(FailureKind::cancelled, "F022", {file_.input.name()}, "stopped"); }
    Failure fail(const char* code, std::uint64_t at, std::string message) const {
        return unreadable(code, place_at(file_, at), std::move(message));
    }

    Result<Header> header_at(std::uint64_t at) const {
        if (bytes_.size() - at < framed_header) return fail("F004", at, "expected the header of an array, found the end of the file");
        const char* p = bytes_.data() + at;
        const std::uint32_t before = word_at(p), after = word_at(p + 4 + header_bytes);
        if (before != header_bytes || after != header_bytes) {
            const bool other_order = before == 0x10000000u;
            return fail(other_order ? "F013" : "F012", at,
                        other_order ? "the file is little-endian; expected big-endian records"
                                    : "expected the header of an array in a record of 16 bytes, found the lengths " +
                                          std::to_string(before) + " and " + std::to_string(after));
        }
        Header header{without_trailing_blanks({p + 4, 8}), {p + 16, 4}, static_cast<std::int32_t>(word_at(p + 12))};
        if (!is_name(header.name)) return fail("F012", at + 4, "expected the name of an array, found bytes that are no text");
        return header;
    }

    Result<void> take_header(std::uint64_t& at, Array& array) const {
        auto header = header_at(at);
        if (!header) return header.why();
        at += framed_header;
        std::int64_t more = 0;
        if (header->type == long_count_type) {
            const Header first = *header;
            header = header_at(at);
            if (!header) return header.why();
            at += framed_header;
            if (first.count >= 0 || header->name != first.name)
                return fail("F012", array.header, "expected a negative count and a second header of the same name, found " + shown(first));
            more = -first.count;
        }
        if (!take_type(header->type, array))
            return fail("F012", at - 8, "expected a type of values (INTE, REAL, DOUB, LOGI, CHAR, C0nn, MESS), found " + shown(*header));
        if (header->count < 0 || more >= std::int64_t{1} << 30)
            return fail("F014", array.header, "expected a count of values, found " + shown(*header));
        array.name = header->name;
        array.count = static_cast<std::uint64_t>(header->count) + (static_cast<std::uint64_t>(more) << 31);
        return {};
    }

    /// Where the values end; the records are of one length but for the last.
    Result<void> take_extent(std::uint64_t at, Array& array) const {
        array.data = array.end = at;
        if (array.type == ArrayType::message || array.count == 0) return {};
        const std::uint64_t left = bytes_.size() - at;
        if (array.count > left / array.element_size) {
            return fail("F004", array.header,
                        "expected " + std::to_string(array.count) + " values of '" + array.name + "', found " + std::to_string(left) +
                            " bytes to the end of the file");
        }
        const std::uint32_t first = left >= 4 ? word_at(bytes_.data() + at) : 0;
        array.block = first / array.element_size;
        if (array.block == 0 || first % array.element_size != 0 || array.block > array.count) {
            return fail(
                "F012", at,
                "expected the length of a record of '" + array.name + "', found " + std::to_string(static_cast<std::int32_t>(first)));
        }
        const std::uint64_t blocks = (array.count - 1) / array.block + 1;
        const std::uint64_t size = array.count * array.element_size + 8 * blocks;
        if (size > left) return fail("F004", array.header, "the file ends within the values of '" + array.name + "'");
        array.end = at + size;
        return {};
    }

    ArrayFile& file_;
    std::string_view bytes_;
    const Monitor* monitor_;
};

// ---- formatted ----

class TextFinder {
public:
    TextFinder(ArrayFile& file, const Monitor* monitor) : file_(file), text_(file.input.bytes()), monitor_(monitor) {}

    Result<void> run() {
        std::uint64_t at = past_blanks(0);
        while (at < text_.size()) {
            if ((file_.arrays.size() & 1023u) == 0 && monitor_ != nullptr && monitor_->stopped())
                return failure(FailureKind::cancelled, "F022", {file_.input.name()}, "stopped");
            Array array;
            array.header = at;
            if (auto done = take_header(at, array); !done) return done;
            if (auto done = take_extent(at, array); !done) return done;
            at = past_blanks(array.end);
            file_.arrays.push_back(std::move(array));
        }
        return {};
    }

private:
    Failure fail(const char* code, std::uint64_t at, std::string message) const {
        return unreadable(code, place_at(file_, at), std::move(message));
    }
    std::uint64_t past_blanks(std::uint64_t at) const {
        while (at < text_.size() && is_blank(text_[at])) ++at;
        return at;
    }

    std::optional<std::string> quoted(std::uint64_t& at) const {
        at = past_blanks(at);
        if (at >= text_.size() || text_[at] != '\'') return std::nullopt;
        const std::size_t close = text_.find('\'', at + 1);
        if (close == std::string_view::npos || close - at > 9) return std::nullopt;
        std::string word = without_trailing_blanks(text_.substr(at + 1, close - at - 1));
        at = close + 1;
        return word;
    }

    Result<Header> header_at(std::uint64_t& at) const {
        const std::uint64_t begin = at;
        const auto name = quoted(at);
        const std::uint64_t number = past_blanks(at);
        std::int64_t count = 0;
        const auto [stop, error] = std::from_chars(text_.data() + number, text_.data() + text_.size(), count);
        at = static_cast<std::uint64_t>(stop - text_.data());
        const auto type = quoted(at);
        if (!name || error != std::errc{} || !type) {
            const bool end = past_blanks(begin) + 8 >= text_.size() || number >= text_.size();
            return fail(end ? "F004" : "F012", begin, "expected the header of an array: 'NAME' count 'TYPE'");
        }
        if (!is_name(*name)) return fail("F012", begin, "expected the name of an array, found bytes that are no text");
        return Header{*name, *type, count};
    }

    Result<void> take_header(std::uint64_t& at, Array& array) const {
        auto header = header_at(at);
        if (!header) return header.why();
        std::int64_t more = 0;
        if (header->type == long_count_type) {
            const Header first = *header;
            header = header_at(at);
            if (!header) return header.why();
            if (first.count >= 0 || first.count < -(std::int64_t{1} << 30) || header->name != first.name)
                return fail("F012", array.header, "expected a negative count and a second header of the same name, found " + shown(first));
            more = -first.count;
        }
        if (!take_type(header->type, array))
            return fail("F012", array.header,
                        "expected a type of values (INTE, REAL, DOUB, LOGI, CHAR, C0nn, MESS), found " + shown(*header));
        if (header->count < 0 || header->count > static_cast<std::int64_t>(largest_count / 2))
            return fail("F014", array.header, "expected a count of values, found " + shown(*header));
        array.name = header->name;
        array.count = static_cast<std::uint64_t>(header->count) + (static_cast<std::uint64_t>(more) << 31);
        array.data = array.end = at;
        return {};
    }

    /// Numbers have no quotes, so the next one opens the next header; text is counted.
    Result<void> take_extent(std::uint64_t at, Array& array) const {
        if (array.type == ArrayType::message || array.count == 0) return {};
        if (array.count > (text_.size() - at) / 2 + 1) {
            return fail("F004", array.header,
                        "expected " + std::to_string(array.count) + " values of '" + array.name + "', found " +
                            std::to_string(text_.size() - at) + " bytes to the end of the file");
        }
        if (array.type != ArrayType::text) {
            array.end = std::min(text_.find('\'', at), text_.size());
            return {};
        }
        for (std::uint64_t i = 0; i < array.count; ++i) {
            at = past_blanks(at);
            const std::uint64_t close = at + array.element_size + 1;
            if (close >= text_.size()) return fail("F004", array.header, "the file ends within the values of '" + array.name + "'");
            if (text_[at] != '\'' || text_[close] != '\'') {
                return fail("F012", at,
                            "expected " + std::to_string(array.element_size) + " characters of '" + array.name + "' between quotes");
            }
            at = close + 1;
        }
        array.end = at;
        return {};
    }

    ArrayFile& file_;
    std::string_view text_;
    const Monitor* monitor_;
};

}  // namespace

std::optional<FirstArray> first_array(std::string_view head) {
    Array ignored;
    if (head.size() >= 24 && word_at(head.data()) == 16 && word_at(head.data() + 20) == 16) {
        const std::string_view type = head.substr(16, 4);
        if (!take_type(type, ignored) && type != long_count_type) return std::nullopt;
        return FirstArray{false, without_trailing_blanks(head.substr(4, 8))};
    }
    std::size_t at = 0;
    while (at < head.size() && is_blank(head[at])) ++at;
    if (at + 11 > head.size() || head[at] != '\'' || head[at + 9] != '\'') return std::nullopt;
    std::size_t p = at + 10;
    const std::size_t number = head.find_first_not_of(' ', p);
    if (number == std::string_view::npos || number == p) return std::nullopt;
    p = head.find_first_not_of("0123456789-", number);
    if (p == std::string_view::npos || p == number) return std::nullopt;
    p = head.find_first_not_of(' ', p);
    if (p == std::string_view::npos || head.size() - p < 6 || head[p] != '\'' || head[p + 5] != '\'') return std::nullopt;
    if (!take_type(head.substr(p + 1, 4), ignored) && head.substr(p + 1, 4) != long_count_type) return std::nullopt;
    return FirstArray{true, without_trailing_blanks(head.substr(at + 1, 8))};
}

Result<ArrayFile> find_arrays(const Input& input, const Monitor* monitor) {
    ArrayFile file{input, false, {}};
    const std::string_view bytes = input.bytes();
    if (bytes.empty()) return unreadable("F002", {input.name()}, "the file is empty");
    const std::size_t first = bytes.find_first_not_of(" \n\r\t");
    file.formatted = first != std::string_view::npos && bytes[first] == '\'';
    const Result<void> done = file.formatted ? TextFinder(file, monitor).run() : BinaryFinder(file, monitor).run();
    if (!done) return done.why();
    return file;
}

std::string type_word(const Array& array) {
    switch (array.type) {
        case ArrayType::integer:
            return "INTE";
        case ArrayType::real:
            return "REAL";
        case ArrayType::real_double:
            return "DOUB";
        case ArrayType::logical:
            return "LOGI";
        case ArrayType::message:
            return "MESS";
        case ArrayType::text:
            break;
    }
    if (array.element_size == 8) return "CHAR";
    const std::string digits = std::to_string(array.element_size);
    return "C" + std::string(3 - std::min<std::size_t>(3, digits.size()), '0') + digits;
}

Location place_at(const ArrayFile& file, std::uint64_t offset) {
    Location where{file.input.name()};
    if (!file.formatted) {
        where.offset = static_cast<std::int64_t>(offset);
        return where;
    }
    const std::string_view before = file.input.bytes().substr(0, offset);
    where.line = static_cast<std::uint64_t>(std::ranges::count(before, '\n')) + 1;
    const std::size_t line_begin = before.rfind('\n');
    where.column = static_cast<std::uint32_t>(offset - (line_begin == std::string_view::npos ? 0 : line_begin + 1) + 1);
    return where;
}

Location place_of(const ArrayFile& file, const Array& array) { return place_at(file, array.header); }

}  // namespace geomend::eclipse
