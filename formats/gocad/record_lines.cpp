// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/record_lines.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <utility>

namespace geomend::gocad {

namespace {

constexpr std::string_view blanks = " \t\r";

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// The first word of a text, which is cut off it.
std::string_view take_word(std::string_view& text) {
    const auto begin = std::find_if_not(text.begin(), text.end(), is_blank);
    const auto end = std::find_if(begin, text.end(), is_blank);
    const std::string_view word = text.substr(static_cast<std::size_t>(begin - text.begin()), static_cast<std::size_t>(end - begin));
    text.remove_prefix(static_cast<std::size_t>(end - text.begin()));
    return word;
}

/// A name as it stands at the end of a line, without blanks around it and without quotes.
std::string_view name_at_end(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    text = text.substr(0, text.find_last_not_of(blanks) + 1);
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
    return text;
}

std::int64_t number_in(std::string_view word) {
    std::int64_t number = 0;
    std::from_chars(word.data(), word.data() + word.size(), number);
    return number;
}

class Lookup {
public:
    explicit Lookup(std::span<const RecordQuery> queries) : queries_(queries), lines_(queries.size(), 0) {
        for (std::size_t q = 0; q < queries.size(); ++q) {
            if (queries[q].kind >= RecordQuery::region) of_list_[{queries[q].kind, queries[q].name}].push_back(q);
            else of_object_[queries[q].object][{queries[q].kind, queries[q].number}].push_back(q);
        }
    }

    std::vector<std::uint64_t> run(std::string_view text) {
        for (std::uint64_t number = 1; !text.empty(); ++number) {
            const std::size_t end = std::min(text.find('\n'), text.size());
            line(text.substr(0, end), number);
            text.remove_prefix(std::min(end + 1, text.size()));
        }
        forget_objects_of_one_name();
        return std::move(lines_);
    }

private:
    using Wanted = std::map<std::pair<RecordQuery::Kind, std::int64_t>, std::vector<std::size_t>>;

    void line(std::string_view rest, std::uint64_t number) {
        if (rest.starts_with("TRGL ")) return triangle(number);  // nearly all lines are this, or points
        if (!wants_points_ && (rest.starts_with("VRTX ") || rest.starts_with("PVRTX "))) return;
        const std::string_view whole = rest, word = take_word(rest);
        if (word == "TRGL") return triangle(number);
        if (word == "VRTX" || word == "PVRTX" || word == "ATOM" || word == "PATOM")
            return wants_points_ ? found(RecordQuery::point, number_in(take_word(rest)), number) : void();
        if (word == "BORDER") return found(RecordQuery::border, number_in(take_word(rest)), number);
        if (word == "GOCAD") {
            wanted_ = nullptr;
            wants_points_ = false;
            is_named_ = false;
            is_model_ = take_word(rest) == "Model3d";
            triangles_ = 0;
        } else if (!is_named_ && (word.starts_with("name:") || word.starts_with("HEADER")) && whole.find("name:") != whole.npos) {
            name(whole.substr(whole.find("name:") + 5));
        } else if (is_model_ && word == "REGION") {
            take_word(rest);
            found_list(RecordQuery::region, rest, number);
        } else if (is_model_ && word == "LAYER") {
            found_list(RecordQuery::layer, rest, number);
        } else if (is_model_ && word == "FAULT_BLOCK") {
            found_list(RecordQuery::fault_block, rest, number);
        }
    }

    /// Triangles are wanted by their numbers, which ascend: the next one is known.
    void triangle(std::uint64_t number) {
        ++triangles_;
        if (wanted_ == nullptr || next_ == wanted_->end() || next_->first != std::pair(RecordQuery::triangle, triangles_)) return;
        take(next_->second, number);
        ++next_;
    }

    void name(std::string_view text) {
        is_named_ = true;
        const std::string object(name_at_end(text.substr(0, text.find('}'))));
        ++times_[object];
        const auto at = of_object_.find(object);
        wanted_ = at == of_object_.end() ? nullptr : &at->second;
        if (wanted_ != nullptr) next_ = wanted_->lower_bound({RecordQuery::triangle, triangles_ + 1});
        wants_points_ =
            wanted_ != nullptr && std::ranges::any_of(*wanted_, [](const auto& entry) { return entry.first.first == RecordQuery::point; });
    }

    void found(RecordQuery::Kind kind, std::int64_t id, std::uint64_t number) {
        if (wanted_ == nullptr) return;
        const auto at = wanted_->find({kind, id});
        if (at != wanted_->end()) take(at->second, number);
    }

    void take(std::span<const std::size_t> queries, std::uint64_t number) {
        for (const std::size_t q : queries) {
            if (lines_[q] == 0) lines_[q] = number;
        }
    }

    void found_list(RecordQuery::Kind kind, std::string_view name, std::uint64_t number) {
        const auto at = of_list_.find({kind, std::string(name_at_end(name))});
        if (at == of_list_.end()) return;
        const bool is_first = ++list_times_[at->first] == 1;
        for (const std::size_t q : at->second) lines_[q] = is_first ? number : 0;
    }

    void forget_objects_of_one_name() {
        for (const auto& [object, wanted] : of_object_) {
            if (times_[object] < 2) continue;
            for (const auto& [key, all] : wanted) {
                for (const std::size_t q : all) lines_[q] = 0;
            }
        }
    }

    std::span<const RecordQuery> queries_;
    std::vector<std::uint64_t> lines_;
    std::map<std::string, Wanted> of_object_;
    std::map<std::pair<RecordQuery::Kind, std::string>, std::vector<std::size_t>> of_list_;
    std::map<std::string, unsigned> times_;
    std::map<std::pair<RecordQuery::Kind, std::string>, unsigned> list_times_;
    const Wanted* wanted_ = nullptr;
    Wanted::const_iterator next_;  ///< of those the next triangle; where there are any
    bool is_named_ = false, is_model_ = false, wants_points_ = false;
    std::int64_t triangles_ = 0;
};

}  // namespace

std::vector<std::uint64_t> record_lines(std::string_view text, std::span<const RecordQuery> queries) { return Lookup(queries).run(text); }

}  // namespace geomend::gocad
