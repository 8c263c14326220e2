// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/ringmesh/model_text.h"

#include <algorithm>
#include <span>

#include "formats/byte_order_mark.h"
#include "formats/text_reading.h"

namespace geomend::ringmesh {

namespace {

constexpr std::string_view no_name = "No_name", no_feature = "no_geological_feature";

std::string stated(std::string_view word, std::string_view nothing) { return word == nothing ? std::string() : std::string(word); }

std::vector<std::string_view> words_of(TextCursor& cursor) {
    std::vector<std::string_view> words;
    for (std::string_view word = cursor.token(); !word.empty(); word = cursor.token()) words.push_back(word);
    return words;
}

/// The text from the first of some words to the last one, with the blanks between them. \pre there is one
std::string text_of(std::span<const std::string_view> words) {
    const char* begin = words.front().data();
    return {begin, static_cast<std::size_t>(words.back().data() + words.back().size() - begin)};
}

std::optional<Failure> whole(const Input& text, const TextCursor& cursor, std::string_view word, std::uint32_t& to) {
    std::int64_t n = 0;
    if (parse_integer(word, n) != NumberStatus::ok || n < 0 || n >= std::int64_t{no_index})
        return unreadable("F005", location_of(text, cursor, word), "expected a whole number of at least 0, found " + shown(word));
    to = static_cast<std::uint32_t>(n);
    return std::nullopt;
}

class EntityReader {
public:
    explicit EntityReader(const Input& text) : text_(text), cursor_(without_byte_order_mark(text.bytes())) {}

    Result<EntityText> run() {
        while (cursor_.next_line()) {
            if (cursor_.at_line_end()) continue;
            if (auto failed = record(words_of(cursor_))) return std::move(*failed);
        }
        if (auto failed = check()) return std::move(*failed);
        return std::move(out_);
    }

private:
    const Input& text_;
    TextCursor cursor_;
    EntityText out_;
    std::uint32_t version_ = 0;

    Failure malformed(const std::string& expected, std::string_view found = {}) const {
        return unreadable("F012", location_of(text_, cursor_, found), "expected " + expected + ", found " + shown(found));
    }

    std::optional<Failure> record(const std::vector<std::string_view>& words) {
        if (words[0] == "Version") {
            if (words.size() < 2) return malformed("the number of the version");
            if (auto failed = whole(text_, cursor_, words[1], version_)) return failed;
            if (version_ <= 2) return std::nullopt;
            return unreadable("F013", {text_.name(), cursor_.line()}, "models of version " + std::to_string(version_) + " are not read");
        }
        if (words[0] == "GeoModel") {
            if (words.size() > 2) out_.model = text_of(std::span(words).subspan(2));
            return std::nullopt;
        }
        if (words[0] == "Nb") return count(words);
        if (words[0] == "Universe") {
            out_.universe.emplace().line = cursor_.line();
            return bounds(EntityText::region, *out_.universe);
        }
        return entity(words);
    }

    std::optional<EntityText::Kind> kind_of(std::string_view word) const {
        using enum EntityText::Kind;
        for (const EntityText::Kind kind : {corner, line, surface, region}) {
            if (word == to_string(kind)) return kind;
        }
        return std::nullopt;
    }

    std::optional<Failure> count(const std::vector<std::string_view>& words) {
        const auto kind = words.size() > 1 ? kind_of(words[1]) : std::nullopt;
        if (!kind) return malformed("Corner, Line, Surface or Region", words.size() > 1 ? words[1] : "");
        std::uint32_t number = 0;
        if (auto failed = whole(text_, cursor_, words.size() > 2 ? words[2] : "", number)) return failed;
        // A record takes its type, its number and a name, and a second line.
        if (number > text_.bytes().size() / 8)
            return unreadable("F014", {text_.name(), cursor_.line()}, std::to_string(number) + " records are more than the file can hold");
        if (!out_.entities[*kind].empty())
            return unreadable("F009", {text_.name(), cursor_.line()},
                              "the number of records " + std::string(words[1]) + " is stated twice");
        out_.entities[*kind].resize(number);
        return std::nullopt;
    }

    /// Type, number and name; then, by version, the feature, the kind of mesh or both. A name may hold blanks.
    std::optional<Failure> entity(const std::vector<std::string_view>& words) {
        const auto kind = kind_of(words[0]);
        if (!kind) return malformed("Corner, Line, Surface, Region or Universe", words[0]);
        const std::size_t behind = version_ == 1 ? 2 : 1;
        if (words.size() < 3 + behind) return malformed("type, number, name and what it is");
        std::uint32_t number = 0;
        if (auto failed = whole(text_, cursor_, words[1], number)) return failed;
        auto& all = out_.entities[*kind];
        if (number >= all.size())
            return unreadable(
                "F008", location_of(text_, cursor_, words[1]),
                std::string(words[0]) + " " + std::to_string(number) + ": the file announces " + std::to_string(all.size()) + " of them");
        EntityText::Entity& e = all[number];
        if (e.stated)
            return unreadable("F009", location_of(text_, cursor_, words[1]),
                              std::string(words[0]) + " " + std::to_string(number) + " is defined twice");
        e.stated = true;
        e.line = cursor_.line();
        e.name = stated(text_of(std::span(words).subspan(2, words.size() - 2 - behind)), no_name);
        if (version_ < 2) e.feature = stated(words[words.size() - behind], no_feature);
        return bounds(*kind, e);
    }

    /// The second line of a record: "boundary" and numbers, or the numbers of surfaces with the sign of their side.
    std::optional<Failure> bounds(EntityText::Kind kind, EntityText::Entity& e) {
        if (!cursor_.next_line())
            return unreadable("F004", {text_.name(), cursor_.line()}, "expected the boundary of a record, found the end of the file");
        const bool sides = kind == EntityText::region;
        if (const std::string_view word = sides ? "boundary" : cursor_.token(); word != "boundary") return malformed("'boundary'", word);
        for (std::string_view word = cursor_.token(); !word.empty(); word = cursor_.token()) {
            if (sides && word[0] != '+' && word[0] != '-') return malformed("+ or - and the number of a surface", word);
            EntityText::Bound& b = e.bounds.emplace_back();
            b.positive = word[0] != '-';
            if (auto failed = whole(text_, cursor_, sides ? word.substr(1) : word, b.number)) return failed;
        }
        return std::nullopt;
    }

    std::optional<Failure> check() const {
        for (const EntityText::Kind kind : {EntityText::corner, EntityText::line, EntityText::surface, EntityText::region}) {
            const auto& all = out_.entities[kind];
            for (std::size_t i = 0; i < all.size(); ++i) {
                if (!all[i].stated)
                    return unreadable("F008", {text_.name()},
                                      "expected " + std::to_string(all.size()) + " records " + to_string(kind) + ", but number " +
                                          std::to_string(i) + " is missing");
                if (kind == EntityText::corner) continue;
                if (auto failed = check_bounds(all[i], static_cast<EntityText::Kind>(kind - 1))) return failed;
            }
        }
        return out_.universe ? check_bounds(*out_.universe, EntityText::surface) : std::nullopt;
    }

    std::optional<Failure> check_bounds(const EntityText::Entity& e, EntityText::Kind of) const {
        for (const EntityText::Bound& b : e.bounds) {
            if (b.number >= out_.entities[of].size())
                return unreadable(
                    "F007", {text_.name(), e.line + 1},
                    "the boundary names " + std::string(to_string(of)) + " " + std::to_string(b.number) + ", which has no record");
        }
        return std::nullopt;
    }
};

}  // namespace

const char* to_string(EntityText::Kind kind) {
    constexpr const char* words[] = {"Corner", "Line", "Surface", "Region"};
    return words[kind];
}

Result<EntityText> read_entity_text(const Input& text) { return EntityReader(text).run(); }

Result<std::vector<GeologicalText>> read_geological_text(const Input& text) {
    std::vector<GeologicalText> all;
    TextCursor cursor(without_byte_order_mark(text.bytes()));
    while (cursor.next_line()) {
        const auto words = words_of(cursor);
        if (words.empty() || words[0] == "Nb" || words[0] == "No") continue;  // counts of what follows, or that nothing does
        if (words.size() < 4)
            return unreadable("F012", {text.name(), cursor.line(), 1},
                              "expected type, number, name and feature, found " + shown(cursor.line_text()));
        GeologicalText& g = all.emplace_back();
        std::uint32_t number = 0;
        if (auto failed = whole(text, cursor, words[1], number)) return std::move(*failed);
        g.type = words[0];
        g.name = stated(text_of(std::span(words).subspan(2, words.size() - 3)), no_name);
        g.feature = stated(words.back(), no_feature);
        g.line = cursor.line();
        if (!cursor.next_line())
            return unreadable("F004", {text.name(), cursor.line()}, "expected the members of a record, found the end of the file");
        for (std::string_view word = cursor.token(); !word.empty(); word = cursor.token()) {
            if (auto failed = whole(text, cursor, word, g.members.emplace_back())) return std::move(*failed);
        }
    }
    return all;
}

}  // namespace geomend::ringmesh
