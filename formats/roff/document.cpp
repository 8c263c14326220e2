// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/roff/document.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>

#include "formats/byte_order_mark.h"

namespace geomend::roff {

namespace {

constexpr std::size_t longest_name = 1000;

struct TypeRow {
    std::string_view word;
    ValueType type;
    std::uint32_t size;  // in binary files; 0 for text
};
constexpr std::array types = {TypeRow{"int", ValueType::integer, 4},        TypeRow{"float", ValueType::real, 4},
                              TypeRow{"double", ValueType::real_double, 8}, TypeRow{"bool", ValueType::boolean, 1},
                              TypeRow{"byte", ValueType::byte, 1},          TypeRow{"char", ValueType::text, 0}};

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

/// Walks over the tokens of a file; what it needs of each form is in next() and the take_... functions.
class Finder {
public:
    Finder(Document& document, const Monitor* monitor) : document_(document), bytes_(document.input.bytes()), monitor_(monitor) {}

    Result<void> run() {
        next();  // "roff-bin" or "roff-asc"
        while (true) {
            if (monitor_ != nullptr && monitor_->stopped())
                return failure(FailureKind::cancelled, "F022", {document_.input.name()}, "stopped");
            const std::uint64_t place = skip_comments();
            const std::string_view word = next();
            if (word.empty()) return fail("F004", place, "expected the tag eof, found the end of the file");
            if (word != "tag") return fail("F012", place, "expected 'tag', found '" + shown(word) + "'");
            Tag tag;
            tag.place = place;
            tag.name = next();
            if (tag.name.empty() || tag.name.size() > longest_name) return fail("F012", place, "expected the name of a tag");
            if (auto done = take_entries(tag); !done) return done;
            const bool end = tag.name == "eof";
            document_.tags.push_back(std::move(tag));
            if (end) return {};
        }
    }

private:
    Failure fail(const char* code, std::uint64_t at, std::string message) const {
        return unreadable(code, place_at(document_, at), std::move(message));
    }
    static std::string shown(std::string_view word) {
        std::string text;
        for (const char c : word.substr(0, 40)) text += c >= ' ' && c <= '~' ? c : '?';
        return text;
    }

    /// The next token; empty at the end of the file. A quoted one comes without its quotes.
    std::string_view next() {
        if (!document_.text) {
            const std::size_t end = bytes_.find('\0', at_);
            if (end == std::string_view::npos) {
                at_ = bytes_.size();
                return {};
            }
            const std::string_view word = bytes_.substr(at_, end - at_);
            at_ = end + 1;
            return word;
        }
        skip_blanks();
        const std::uint64_t begin = at_;
        while (at_ < bytes_.size() && !is_blank(bytes_[at_])) ++at_;
        return bytes_.substr(begin, at_ - begin);
    }

    void skip_blanks() {
        while (at_ < bytes_.size() && is_blank(bytes_[at_])) ++at_;
    }

    /// Comments stand between # and #; in binary files they are tokens. The place of what comes after.
    std::uint64_t skip_comments() {
        while (true) {
            if (document_.text) skip_blanks();
            if (at_ >= bytes_.size() || bytes_[at_] != '#') return at_;
            if (!document_.text) {
                next();
                continue;
            }
            const std::size_t end = bytes_.find('#', at_ + 1);
            at_ = end == std::string_view::npos ? bytes_.size() : end + 1;
        }
    }

    Result<void> take_entries(Tag& tag) {
        while (true) {
            const std::uint64_t place = skip_comments();
            std::string_view word = next();
            if (word == "endtag") return {};
            if (word.empty()) return fail("F004", place, "the file ends within the tag '" + shown(tag.name) + "'");
            Entry entry;
            entry.place = place;
            entry.array = word == "array";
            if (entry.array) word = next();
            const auto row = std::ranges::find(types, word, &TypeRow::word);
            if (row == types.end())
                return fail("F012", place,
                            "expected a type (int, float, double, bool, byte, char) or 'endtag', found '" + shown(word) + "'");
            entry.type = row->type;
            entry.name = next();
            if (entry.name.empty() || entry.name.size() > longest_name)
                return fail("F012", place, "expected the name of a value in the tag '" + shown(tag.name) + "'");
            if (auto done = take_count(entry); !done) return done;
            entry.begin = at_;
            if (auto done = take_extent(entry, row->size); !done) return done;
            entry.end = at_;
            if (entry.name == "byteswaptest" && !document_.text) {
                if (auto done = take_byte_order(entry); !done) return done;
            }
            tag.entries.push_back(std::move(entry));
        }
    }

    Result<void> take_count(Entry& entry) {
        if (!entry.array) return {};
        std::int64_t count = -1;
        if (document_.text) {
            const std::string_view word = next();
            const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), count);
            if (error != std::errc{} || stop != word.data() + word.size()) count = -1;
        } else if (bytes_.size() - at_ >= 4) {
            std::uint32_t raw = 0;
            std::memcpy(&raw, bytes_.data() + at_, 4);
            count = static_cast<std::int32_t>(document_.swapped ? __builtin_bswap32(raw) : raw);
            at_ += 4;
        }
        if (count < 0 || static_cast<std::uint64_t>(count) > bytes_.size())
            return fail("F014", entry.place,
                        "expected how many values '" + shown(entry.name) + "' has, found a count that the file cannot hold");
        entry.count = static_cast<std::uint64_t>(count);
        return {};
    }

    /// Moves behind the values.
    Result<void> take_extent(const Entry& entry, std::uint32_t size) {
        const auto short_of = [&] { return fail("F004", entry.place, "the file ends within the values of '" + shown(entry.name) + "'"); };
        if (!document_.text && size != 0) {
            if (entry.count > (bytes_.size() - at_) / size) return short_of();
            at_ += entry.count * size;
            return {};
        }
        for (std::uint64_t i = 0; i < entry.count; ++i) {
            if (document_.text) skip_blanks();
            if (at_ >= bytes_.size()) return short_of();
            const bool quoted = document_.text && size == 0;
            if (quoted && bytes_[at_] != '"')
                return fail("F012", at_, "expected text between double quotes as value of '" + shown(entry.name) + "'");
            if (!quoted && document_.text) {
                while (at_ < bytes_.size() && !is_blank(bytes_[at_])) ++at_;
                continue;
            }
            const std::size_t end = bytes_.find(quoted ? '"' : '\0', at_ + (quoted ? 1 : 0));
            if (end == std::string_view::npos) return short_of();
            at_ = end + 1;
        }
        return {};
    }

    Result<void> take_byte_order(const Entry& entry) {
        if (entry.type != ValueType::integer || entry.array) return {};
        std::uint32_t raw = 0;
        std::memcpy(&raw, bytes_.data() + entry.begin, 4);
        if (raw != 1 && raw != 0x01000000u) return fail("F012", entry.begin, "expected 1 as byteswaptest, in either order of bytes");
        document_.swapped = raw != 1;
        return {};
    }

    Document& document_;
    std::string_view bytes_;
    const Monitor* monitor_;
    std::uint64_t at_ = 0;
};

}  // namespace

const char* type_word(ValueType type) { return std::ranges::find(types, type, &TypeRow::type)->word.data(); }

Location place_at(const Document& document, std::uint64_t offset) {
    Location where{document.input.name()};
    if (!document.text) {
        where.offset = static_cast<std::int64_t>(offset);
        return where;
    }
    const std::string_view before = document.input.bytes().substr(0, offset);
    where.line = static_cast<std::uint64_t>(std::ranges::count(before, '\n')) + 1;
    const std::size_t line_begin = before.rfind('\n');
    where.column = static_cast<std::uint32_t>(offset - (line_begin == std::string_view::npos ? 0 : line_begin + 1) + 1);
    return where;
}

const Entry* find_entry(const Tag& tag, std::string_view name) {
    const auto found = std::ranges::find(tag.entries, name, &Entry::name);
    return found == tag.entries.end() ? nullptr : &*found;
}

const Tag* find_tag(const Document& document, std::string_view name) {
    const auto found = std::ranges::find(document.tags, name, &Tag::name);
    return found == document.tags.end() ? nullptr : &*found;
}

Result<Document> find_tags(const Input& input, const Monitor* monitor) {
    Document document{input, false, false, {}};
    const std::string_view bytes = input.bytes();
    if (bytes.empty()) return unreadable("F002", {input.name()}, "the file is empty");
    const std::string_view text = without_byte_order_mark(bytes);
    const std::size_t begin = text.find_first_not_of(" \r\n\t");
    document.text = begin != std::string_view::npos && text.substr(begin).starts_with("roff-asc");
    if (!document.text && !bytes.starts_with(std::string_view("roff-bin\0", 9)))
        return unreadable("F003", {input.name()}, "expected 'roff-asc' or 'roff-bin' at the start of the file");
    if (auto done = Finder(document, monitor).run(); !done) return done.why();
    return document;
}

// ---- values ----

namespace {

std::uint64_t size_of(ValueType type) { return std::ranges::find(types, type, &TypeRow::type)->size; }

template <class T>
T raw_at(const char* p, bool swapped) {
    if constexpr (sizeof(T) == 1) return static_cast<T>(static_cast<unsigned char>(*p));
    using Word = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;
    if constexpr (sizeof(T) >= 4) {
        Word word = 0;
        std::memcpy(&word, p, sizeof word);
        if (swapped)
            word = sizeof(T) == 8 ? static_cast<Word>(__builtin_bswap64(word))
                                  : static_cast<Word>(__builtin_bswap32(static_cast<std::uint32_t>(word)));
        return std::bit_cast<T>(word);
    }
    return T{};
}

template <class Stored, class T>
std::vector<T> raw_values(const Document& document, const Entry& entry) {
    std::vector<T> values(entry.count);
    const char* p = document.input.bytes().data() + entry.begin;
    for (std::uint64_t i = 0; i < entry.count; ++i) values[i] = static_cast<T>(raw_at<Stored>(p + i * sizeof(Stored), document.swapped));
    return values;
}

template <class Stored>
bool parse(std::string_view word, Stored& value) {
    if (word.starts_with('+')) word.remove_prefix(1);
    if constexpr (sizeof(Stored) == 1) {
        int wide = 0;
        const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), wide);
        value = static_cast<Stored>(wide);
        return error == std::errc{} && stop == word.data() + word.size() && wide >= -128 && wide <= 255;
    } else {
        const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if constexpr (std::is_floating_point_v<Stored>) {
            if (error == std::errc::result_out_of_range) {
                // Too small for the type: zero, or a subnormal. Too large is not a number of it.
                double wide = 0;
                const auto [end, wide_error] = std::from_chars(word.data(), word.data() + word.size(), wide);
                const bool small =
                    wide_error == std::errc{} ? wide > -1 && wide < 1 : word.find("E-") != word.npos || word.find("e-") != word.npos;
                value = static_cast<Stored>(wide_error == std::errc{} ? wide : 0);
                return small && end == word.data() + word.size();
            }
        }
        return error == std::errc{} && stop == word.data() + word.size();
    }
}

template <class Stored, class T>
Result<std::vector<T>> text_values(const Document& document, const Entry& entry) {
    std::vector<T> values;
    values.reserve(entry.count);
    const std::string_view text = document.input.bytes();
    std::uint64_t at = entry.begin;
    while (values.size() < entry.count) {
        while (at < entry.end && is_blank(text[at])) ++at;
        const std::uint64_t begin = at;
        while (at < entry.end && !is_blank(text[at])) ++at;
        const std::string_view word = text.substr(begin, at - begin);
        Stored value{};
        if (!parse(word, value)) {
            return unreadable("F005", place_at(document, begin),
                              "expected value " + std::to_string(values.size() + 1) + " of '" + entry.name + "' (" + type_word(entry.type) +
                                  "), found '" + std::string(word.substr(0, 40)) + "'");
        }
        values.push_back(static_cast<T>(value));
    }
    return values;
}

template <class Stored, class T>
Result<std::vector<T>> values_of(const Document& document, const Entry& entry) {
    if (document.text) return text_values<Stored, T>(document, entry);
    return raw_values<Stored, T>(document, entry);
}

Failure wrong_type(const Document& document, const Entry& entry, const char* expected) {
    return unreadable("F012", place_at(document, entry.place),
                      std::string("expected ") + expected + " in '" + entry.name + "', found type " + type_word(entry.type));
}

}  // namespace

Result<std::vector<std::int32_t>> integers(const Document& document, const Entry& entry) {
    switch (entry.type) {
        case ValueType::integer:
            return values_of<std::int32_t, std::int32_t>(document, entry);
        case ValueType::boolean:
        case ValueType::byte:
            return values_of<std::uint8_t, std::int32_t>(document, entry);
        default:
            return wrong_type(document, entry, "whole numbers");
    }
}

Result<std::vector<std::uint8_t>> bytes(const Document& document, const Entry& entry) {
    if (size_of(entry.type) != 1) return wrong_type(document, entry, "bytes");
    return values_of<std::uint8_t, std::uint8_t>(document, entry);
}

Result<std::vector<float>> floats(const Document& document, const Entry& entry) {
    if (entry.type != ValueType::real) return wrong_type(document, entry, "reals");
    return values_of<float, float>(document, entry);
}

Result<std::vector<double>> doubles(const Document& document, const Entry& entry) {
    if (entry.type == ValueType::real_double) return values_of<double, double>(document, entry);
    if (entry.type == ValueType::real) return values_of<float, double>(document, entry);
    if (entry.type == ValueType::integer) return values_of<std::int32_t, double>(document, entry);
    return wrong_type(document, entry, "reals");
}

Result<std::vector<std::string>> texts(const Document& document, const Entry& entry) {
    if (entry.type != ValueType::text) return wrong_type(document, entry, "text");
    std::vector<std::string> values;
    const std::string_view all = document.input.bytes();
    std::uint64_t at = entry.begin;
    while (values.size() < entry.count) {
        if (document.text) {
            while (is_blank(all[at])) ++at;
            ++at;
        }
        const std::size_t end = all.find(document.text ? '"' : '\0', at);
        values.emplace_back(all.substr(at, end - at));
        at = end + 1;
    }
    return values;
}

}  // namespace geomend::roff
