// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/surfaces/ply_header.h"

#include <array>

#include "formats/text_reading.h"

namespace geomend::surfaces {

namespace {

struct TypeWord {
    std::string_view old_word, new_word;
    PlyType type;
    std::size_t size;
};

constexpr std::array<TypeWord, 8> types{{{"char", "int8", PlyType::int8, 1},
                                         {"uchar", "uint8", PlyType::uint8, 1},
                                         {"short", "int16", PlyType::int16, 2},
                                         {"ushort", "uint16", PlyType::uint16, 2},
                                         {"int", "int32", PlyType::int32, 4},
                                         {"uint", "uint32", PlyType::uint32, 4},
                                         {"float", "float32", PlyType::float32, 4},
                                         {"double", "float64", PlyType::float64, 8}}};

std::optional<PlyType> type_of(std::string_view word) {
    for (const TypeWord& row : types) {
        if (word == row.old_word || word == row.new_word) return row.type;
    }
    return std::nullopt;
}

class HeaderReader {
public:
    HeaderReader(const Input& input, TextCursor& cursor) : input_(input), cursor_(cursor) {}

    Result<PlyHeader> run() {
        if (!cursor_.next_line() || trimmed(cursor_.line_text()) != "ply")
            return unreadable("F003", {input_.name(), 1, 1}, "the first line of a PLY file is 'ply'");
        while (cursor_.next_line()) {
            const std::string_view word = cursor_.token();
            if (word == "end_header") {
                if (!has_format_) return wrong("format");
                return std::move(header_);
            }
            if (auto failed = record(word)) return std::move(*failed);
        }
        return unreadable("F004", {input_.name(), cursor_.line()}, "expected end_header, found the end of the file");
    }

private:
    const Input& input_;
    TextCursor& cursor_;
    PlyHeader header_;
    bool has_format_ = false;

    Failure wrong(std::string_view expected) const {
        return unreadable("F012", {input_.name(), cursor_.line(), 1},
                          "expected " + std::string(expected) + ", found " + shown(trimmed(cursor_.line_text())));
    }

    std::optional<Failure> record(std::string_view word) {
        if (word.empty()) return std::nullopt;
        if (word == "comment" || word == "obj_info") {
            header_.comments.emplace_back(trimmed(cursor_.line_text()));
            return std::nullopt;
        }
        if (word == "format") return format();
        if (word == "element") return element();
        if (word == "property") return property();
        return wrong("format, comment, obj_info, element, property or end_header");
    }

    std::optional<Failure> format() {
        const std::string_view word = cursor_.token();
        has_format_ = true;
        if (word == "ascii") header_.encoding = PlyEncoding::text;
        else if (word == "binary_little_endian") header_.encoding = PlyEncoding::little_endian;
        else if (word == "binary_big_endian") header_.encoding = PlyEncoding::big_endian;
        else
            return unreadable("F013", location_of(input_, cursor_, word),
                              "expected ascii, binary_little_endian or binary_big_endian, found " + shown(word));
        return std::nullopt;
    }

    std::optional<Failure> element() {
        PlyElement made;
        made.name = cursor_.token();
        const std::string_view number = cursor_.token();
        std::int64_t count = 0;
        if (made.name.empty()) return wrong("the name of an element");
        if (parse_integer(number, count) != NumberStatus::ok || count < 0)
            return unreadable("F005", location_of(input_, cursor_, number), "expected how many there are, found " + shown(number));
        made.count = static_cast<std::uint64_t>(count);
        header_.elements.push_back(std::move(made));
        return std::nullopt;
    }

    std::optional<Failure> type(PlyType& to) {
        const std::string_view word = cursor_.token();
        const auto found = type_of(word);
        if (!found) return unreadable("F013", location_of(input_, cursor_, word), "expected a type (char to double), found " + shown(word));
        to = *found;
        return std::nullopt;
    }

    std::optional<Failure> property() {
        if (header_.elements.empty()) return wrong("an element before its properties");
        PlyProperty made;
        TextCursor before = cursor_;
        if (cursor_.token() == "list") {
            PlyType count{};
            if (auto failed = type(count)) return failed;
            if (count == PlyType::float32 || count == PlyType::float64) return wrong("a whole number as the length of lists");
            made.count_type = count;
        } else {
            cursor_ = before;
        }
        if (auto failed = type(made.type)) return failed;
        made.name = cursor_.token();
        if (made.name.empty()) return wrong("the name of a property");
        header_.elements.back().properties.push_back(std::move(made));
        return std::nullopt;
    }
};

}  // namespace

std::size_t size_of(PlyType type) { return types[static_cast<std::size_t>(type)].size; }

Result<PlyHeader> read_ply_header(const Input& input, TextCursor& cursor) { return HeaderReader(input, cursor).run(); }

}  // namespace geomend::surfaces
