// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>

#include "base/text_cursor.h"
#include "formats/grdecl/deck_reader.h"
#include "formats/grdecl/flow_words.h"

namespace geomend::grdecl {

namespace {

/// Sizes of blocks: layers that are not given are like the one above, and tops stack on it.
bool is_block_size(std::string_view name) {
    return name == "TOPS" || name == "DX" || name == "DY" || name == "DZ" || name == "DR" || name == "DTHETA";
}

/// DXV, NXFIN, DRV, ...: by the second letter.
std::size_t axis_of(std::string_view name) {
    name.remove_prefix(1);
    return name.starts_with('X') || name.starts_with('R') ? 0 : name.starts_with('Y') || name.starts_with('T') ? 1 : 2;
}

std::string unquoted(std::string_view word) {
    const auto is_quote = [](char c) { return c == '\'' || c == '"'; };
    while (!word.empty() && is_quote(word.front())) word.remove_prefix(1);
    while (!word.empty() && is_quote(word.back())) word.remove_suffix(1);
    return std::string(word);
}

/// A word with letters and a dot or a slash within, as "../grid/COORD.dat".
bool is_file_name(std::string_view quoted) {
    const std::string word = unquoted(quoted);
    const std::size_t dot = word.find_last_of(".");
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    return dot != std::string::npos && dot + 1 < word.size() && is_letter(word[dot + 1]) &&
           std::ranges::any_of(word.substr(0, dot), is_letter);
}

/// Whether a word is a number, perhaps repeated, that a list of real numbers could hold.
bool is_real(std::string_view word) {
    if (const std::size_t star = word.find('*'); star != std::string_view::npos) word.remove_prefix(star + 1);
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size();
}

/// Values that a box gives to the uppermost layer hold for the cells below that have none yet, as simulators take them.
void fill_below(std::vector<double>& values, const CellBox& box, const Dims& d) {
    const std::size_t layer = std::size_t{d[0]} * d[1];
    for (std::size_t k = 1; k < d[2]; ++k) {
        for (std::size_t j = box.first[1]; j <= box.last[1]; ++j) {
            for (std::size_t i = box.first[0]; i <= box.last[0]; ++i) {
                const std::size_t top = i + d[0] * j;
                if (values[top + layer * k] == unset_real) values[top + layer * k] = values[top];
            }
        }
    }
}

std::string_view text_between(const char* begin, const char* end) { return {begin, static_cast<std::size_t>(end - begin)}; }

}  // namespace

/// SPECGRID may stand after what needs it: a second walk, from here on, finds it.
bool DeckReader::find_dims_ahead() {
    if (looked_ahead_) return false;
    looked_ahead_ = true;
    DeckReader ahead(*input_, *options_);
    ahead.probing_ = true;
    ahead.frames_.clear();
    for (const Frame& f : frames_) ahead.frames_.push_back(f);
    ahead.aliases_ = aliases_;
    ahead.section_ = section_;
    ahead.skip_missing_ = true;
    ahead.word_ = word_;
    ahead.in().jump(word_at_);
    if (ahead.run() || !ahead.grids_.front().dims) return false;
    grids_.front().dims = ahead.grids_.front().dims;
    grids_.front().coordinate_sets = ahead.grids_.front().coordinate_sets;
    return true;
}

OptionalFailure DeckReader::need_dims(const char* at, std::string_view name) {
    if (grid().dims || (!probing_ && find_dims_ahead())) {
        grid().dims_used = true;
        return {};
    }
    return unreadable("F024", where(at),
                      std::string(name) +
                          " needs the numbers of cells, but neither SPECGRID nor DIMENS stands in the text: give them with "
                          "--option dims=NX,NY,NZ, or read the deck that includes this file");
}

OptionalFailure DeckReader::afford(std::uint64_t values, const char* at, std::string_view name) {
    if (values > room_) {
        return unreadable("F014", where(at),
                          std::string(name) + " asks for " + std::to_string(values) +
                              " values, more than a text of this size should: --option max-values=N raises the limit");
    }
    room_ -= values;
    return {};
}

Failure DeckReader::array_failure(const ArrayScan& scan, std::string_view name, std::string_view text, std::uint64_t expected,
                                  const char* slash) const {
    const std::string item =
        scan.at == nullptr ? std::string() : std::string(text.substr(static_cast<std::size_t>(scan.at - text.data()), 40));
    const std::string token = shown(std::string_view(item).substr(0, item.find_first_of(" \t\r\n,")));
    const Location at = where(scan.at == nullptr ? slash : scan.at);
    const std::string of = " of " + std::string(name);
    switch (scan.status) {
        case ArrayStatus::cancelled:
            return failure(FailureKind::cancelled, "F022", {input_->name()}, "reading was stopped");
        case ArrayStatus::not_finite:
            return unreadable("F006", at, "expected a finite number" + of + ", found " + token);
        case ArrayStatus::out_of_range:
            return unreadable("F005", at, "expected a whole number of 32 bits" + of + ", found " + token);
        case ArrayStatus::bad_repeat:
            return unreadable("F012", at, "expected a repeat count (a whole number from 1) before '*'" + of + ", found " + token);
        case ArrayStatus::malformed: {
            // The name of a file goes on behind a '/', where the numbers end.
            const std::string_view rest = scan.at == nullptr
                                              ? std::string_view()
                                              : text_between(scan.at, scan.at + std::min<std::ptrdiff_t>(200, in().end() - scan.at));
            const std::string plain(rest.substr(0, rest.find_first_of(" \t\r\n,")));
            const bool word = scan.at != nullptr && is_keyword(item.substr(0, item.find_first_of(" \t\r\n,/")));
            if (is_file_name(plain))
                return unreadable("F005", at,
                                  "expected a number" + of + ", found " + shown(plain) +
                                      ", which looks like the name of a file: INCLUDE '" + unquoted(plain) +
                                      "' / takes the text of a file in");
            const std::string wanted = is_real(item.substr(0, item.find_first_of(" \t\r\n,/"))) ? "a whole number" : "a number";
            return unreadable("F005", at, "expected " + wanted + of + (word ? ", or the '/' that ends it" : "") + ", found " + token);
        }
        case ArrayStatus::ok:
        case ArrayStatus::too_many:
            break;
    }
    return unreadable("F008", at, "expected " + std::to_string(expected) + " values" + of + ", found " + std::to_string(scan.count));
}

/// The numbers of one record, with its '/'. Where they do not fit and the keyword has text beside it, that may be a
/// remark, as simulators take it. \pre the scanner stands behind the keyword
template <class T>
OptionalFailure DeckReader::numbers(std::string_view name, std::uint64_t expected, bool defaults_allowed, std::vector<T>& values,
                                    bool may_be_short, std::uint64_t or_else) {
    const char* begin = in().at();
    auto failed = numbers_here(name, expected, defaults_allowed, values, may_be_short, or_else);
    if (!failed || failed->kind != FailureKind::unreadable || !go_behind_remark(begin)) return failed;
    values.clear();
    if (numbers_here(name, expected, defaults_allowed, values, may_be_short, or_else)) return failed;
    note_remark(begin);
    return {};
}

template <class T>
OptionalFailure DeckReader::numbers_here(std::string_view name, std::uint64_t expected, bool defaults_allowed, std::vector<T>& values,
                                         bool may_be_short, std::uint64_t or_else) {
    const char* begin = in().at();
    const char* slash = find_slash(begin, in().end());
    if (slash == in().end()) {
        // Without a '/' the numbers may run into the next keyword: that is the better place to tell of.
        std::vector<T> none;
        const ArrayScan scan = read_numbers(text_between(begin, slash), 0, none, options_->monitor);
        if (scan.status != ArrayStatus::ok) return array_failure(scan, name, text_between(begin, slash), expected, slash);
        return unreadable("F004", where(slash),
                          "expected a '/' that ends " + std::string(name) + ", found the end of the file after " +
                              std::to_string(scan.count) + " values");
    }
    const std::string_view text = text_between(begin, slash);
    in().after_slash(slash);
    if (text.size() / 2 + 1 < expected) {  // only repeats can make so many: count before memory is taken
        ArrayScan scan = read_numbers(text, 0, values, options_->monitor);
        if (scan.status == ArrayStatus::ok && scan.count > expected) scan.at = item_beyond(text, expected);
        const bool fits = scan.count == expected || (may_be_short && scan.count < expected) || (or_else > 0 && scan.count == or_else);
        if (scan.status != ArrayStatus::ok || !fits) return array_failure(scan, name, text, expected, slash);
        expected = scan.count;
    }
    if (auto failed = afford(expected, begin, name)) return failed;
    const ArrayScan scan = read_numbers(text, expected, values, options_->monitor);
    if (scan.status != ArrayStatus::ok || (scan.count != expected && !may_be_short && (or_else == 0 || scan.count != or_else)))
        return array_failure(scan, name, text, expected, slash);
    if (scan.defaults && !defaults_allowed)
        return unreadable("F012", where(begin), "expected a value for every element of " + std::string(name) + ", found defaults (N*)");
    return {};
}

template OptionalFailure DeckReader::numbers(std::string_view, std::uint64_t, bool, std::vector<double>&, bool, std::uint64_t);
template OptionalFailure DeckReader::numbers(std::string_view, std::uint64_t, bool, std::vector<std::int32_t>&, bool, std::uint64_t);

OptionalFailure DeckReader::coord() {
    if (probing_) return unknown(word_at_, word_);
    if (auto failed = need_dims(word_at_, word_)) return failed;
    const Dims& d = *grid().dims;
    return numbers(word_, 6 * pillar_count(d) * grid().coordinate_sets, false, grid().pillars);
}

OptionalFailure DeckReader::zcorn() {
    if (probing_) return unknown(word_at_, word_);
    if (auto failed = need_dims(word_at_, word_)) return failed;
    const std::uint64_t expected = 8 * cells_of(*grid().dims);
    // With two porosities the depths of the matrix suffice.
    return numbers(word_, expected, false, grid().depths, false, has_two_porosities() ? expected / 2 : 0);
}

OptionalFailure DeckReader::vector_of_widths() {
    if (probing_) return unknown(word_at_, word_);
    if (auto failed = need_dims(word_at_, word_)) return failed;
    const std::size_t axis = axis_of(word_);
    if (word_ == "DRV" || word_ == "DTHETAV") grid().radial = true;
    return numbers(word_, (*grid().dims)[axis], false, grid().widths[axis]);
}

OptionalFailure DeckReader::corner_tops() {
    if (probing_) return unknown(word_at_, word_);
    if (auto failed = need_dims(word_at_, word_)) return failed;
    return numbers(word_, pillar_count(*grid().dims), false, grid().corner_tops);
}

OptionalFailure DeckReader::fine_cells() {
    if (probing_) return unknown(word_at_, word_);
    const std::size_t axis = axis_of(word_);
    if (current_ == 0) return unreadable("F012", where(word_at_), word_ + " stands outside CARFIN and ENDFIN");
    const auto& host = *grid().grid.host;
    const std::uint64_t hosts = std::uint64_t{host.last[axis]} - host.first[axis] + 1;
    if (word_[0] == 'H') return numbers(word_, (*grid().dims)[axis], false, grid().fine_widths[axis]);
    std::vector<std::int32_t> counts;
    const char* at = word_at_;
    if (auto failed = numbers(word_, hosts, false, counts)) return failed;
    std::uint64_t sum = 0;
    for (const std::int32_t n : counts) {
        if (n < 1) return unreadable("F012", where(at), "expected numbers of cells from 1 in " + word_);
        sum += static_cast<std::uint64_t>(n);
    }
    if (sum != (*grid().dims)[axis])
        return unreadable("F008", where(at),
                          "expected " + std::to_string((*grid().dims)[axis]) + " fine cells in all, found " + std::to_string(sum));
    grid().fine_cells[axis].assign(counts.begin(), counts.end());
    return {};
}

OptionalFailure DeckReader::cell_array(std::string_view name, bool whole) {
    if (probing_) return unknown(word_at_, word_);
    if (auto failed = need_dims(word_at_, name)) return failed;
    const CellBox box = box_.value_or(whole_grid());
    const auto row = cell_keyword(name);
    // With two porosities those of the matrix suffice; its cells say which of the fracture are active, too.
    const std::uint64_t half = has_two_porosities() && !box_ ? box.count() / 2 : 0;
    if (whole) {
        std::vector<std::int32_t> values;
        if (auto failed = numbers(name, box.count(), true, values, false, half)) return failed;
        if (values.size() < box.count()) {
            if (auto failed = afford(half, word_at_, name)) return failed;
            values.resize(static_cast<std::size_t>(box.count()), unset_whole);
            if (name == "ACTNUM") std::copy_n(values.begin(), half, values.begin() + static_cast<std::ptrdiff_t>(half));
        }
        return store(name, std::move(values), row);
    }
    std::vector<double> values;
    const char* at = in().skip() ? in().at() : word_at_;
    if (auto failed = numbers(name, box.count(), true, values, is_block_size(name), half)) return failed;
    if (name == "MULTPV" && section_ == Section::edit && has_pore_volumes(grid())) {
        note_without_effect(at, "MULTPV that stands after what changes PORV changes no pore volume");
        keep_array(word_at_, in().at());
        return {};
    }
    if (is_block_size(name)) {
        if (auto failed = block_sizes(name, box, at, values)) return failed;
    }
    if (values.size() < box.count()) {
        if (auto failed = afford(box.count() - values.size(), word_at_, name)) return failed;
        values.resize(static_cast<std::size_t>(box.count()), unset_real);
    }
    return store(name, std::move(values), row);
}

/// Sizes of blocks for some layers only: those that are not there are like the one above. Defaults stand for no
/// thickness, as OPM Flow takes them.
OptionalFailure DeckReader::block_sizes(std::string_view name, const CellBox& box, const char* at, std::vector<double>& values) {
    const std::uint64_t layer = (std::uint64_t{box.last[0]} - box.first[0] + 1) * (std::uint64_t{box.last[1]} - box.first[1] + 1);
    const auto unset = static_cast<std::uint64_t>(std::ranges::count(values, unset_real));
    const std::string of = std::to_string(box.count()) + " values of " + std::string(name);
    if (values.size() < layer && !box_)
        return unreadable("F008", where(at), "expected " + of + ", found " + std::to_string(values.size()) + ", less than a layer has");
    if (name == "TOPS" || probing_) return {};
    if (values.size() < box.count())
        findings_.push_back(
            finding("F145", where(at),
                    "expected " + of + ", found " + std::to_string(values.size()) + ": cells without one are like those above them",
                    box.count() - values.size()));
    if (unset == 0) return {};
    const bool thickness = name == "DZ";
    findings_.push_back(
        finding("F145", where(at),
                "expected " + of + ", found defaults (N*) among them: " +
                    (thickness ? "those cells have no thickness, as OPM Flow takes it" : "those cells are like those above them"),
                unset));
    if (thickness) std::ranges::replace(values, unset_real, 0.0);
    return {};
}

/// Puts values of the current box where they belong. Elements that they leave out stay what they were.
template <class T>
OptionalFailure DeckReader::store(std::string_view name, std::vector<T>&& values, const std::optional<CellKeyword>& row) {
    GridText& g = grid();
    CellArray* array = g.find(name);
    if (array == nullptr && g.arrays.size() >= 5000) return unreadable("F014", where(word_at_), "more than 5000 properties of cells");
    const T unset = unset_value<T>();
    const T initial = row && row->initial ? static_cast<T>(*row->initial) : unset;
    const CellBox box = box_.value_or(whole_grid());
    const bool all = box.count() == cells_of(*g.dims);
    if (array == nullptr || array->values.index() != (std::is_same_v<T, double> ? 0U : 1U)) {
        if (array != nullptr) static_cast<void>(g.take(name));
        if (all) {
            if (initial != unset) std::ranges::replace(values, unset, initial);
            g.arrays.push_back({std::string(name), std::move(values), section_});
            return {};
        }
        if (auto failed = afford(cells_of(*g.dims), word_at_, name)) return failed;
        g.arrays.push_back({std::string(name), std::vector<T>(static_cast<std::size_t>(cells_of(*g.dims)), initial), section_});
        array = &g.arrays.back();
    }
    auto& target = std::get<std::vector<T>>(array->values);
    // Each multiplier of connections in EDIT acts beside those before it; that of pore volumes takes their place.
    const bool also = section_ == Section::edit && std::is_same_v<T, double> && name.starts_with("MULT") && name != "MULTPV";
    const Dims& d = *g.dims;
    std::size_t next = 0;
    for (std::size_t k = box.first[2]; k <= box.last[2]; ++k) {
        for (std::size_t j = box.first[1]; j <= box.last[1]; ++j) {
            const std::size_t line = d[0] * (j + std::size_t{d[1]} * k);
            for (std::size_t i = box.first[0]; i <= box.last[0]; ++i, ++next) {
                if (values[next] == unset) continue;
                const bool multiplies = also && target[line + i] != unset;
                target[line + i] = multiplies ? static_cast<T>(target[line + i] * values[next]) : values[next];
            }
        }
    }
    if constexpr (std::is_same_v<T, double>) {
        if (box.first[2] == 0 && (name == "PORO" || name.starts_with("PERM"))) fill_below(target, box, d);
    }
    return {};
}

/// A keyword that is not known: with one value for each cell it is a property, else it is kept as it stands.
OptionalFailure DeckReader::unknown(const char* begin, const std::string& name) {
    if (OptionalFailure failed; section_ != Section::runspec && unknown_below_remark(name, failed)) return failed;
    if (in().skip() && section_ != Section::runspec) {
        const char c = *in().at();
        if ((c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.' || c == '*') {
            OptionalFailure failed;
            if (unknown_numbers(name, failed)) return failed;
        } else if ((c == '\'' || c == '"') && !probing_) {
            if (unknown_words(name)) return {};
        }
    }
    in().skip();
    return keep(begin, name, false);
}

/// Whether unknown numbers that do not fit are a property all the same: in a file of properties alone, whose grid is
/// that of an option, where they have repeats or are many. Nothing more of the keyword may follow them.
bool DeckReader::is_short_property(const std::string& name, std::string_view text, std::uint64_t count) {
    if (grid().dims_stated || !texts_.empty() || flow_reads(name)) return false;
    if (text.find('*') == std::string_view::npos && count < 8) return false;
    const char* start = in().at();
    in().after_slash(text.data() + text.size());
    const bool more = in().data_follows(false, is_known);
    in().jump(start);
    return !more;
}

bool DeckReader::unknown_numbers(const std::string& name, OptionalFailure& failed) {
    const char* start = in().at();
    const char* slash = find_slash(start, in().end());
    if (slash == in().end()) return false;
    const std::string_view text = text_between(start, slash);
    if (probing_) {  // only to get behind it, fast where it is large
        if (text.size() < 1000) return false;
        in().after_slash(slash);
        return true;
    }
    if (!grid().dims && !find_dims_ahead()) {
        // A few numbers may be anything; a property says so by having repeats or many of them.
        std::vector<double> none;
        const ArrayScan scan = read_numbers(text, 0, none, options_->monitor);
        if (scan.status != ArrayStatus::ok || (text.find('*') == std::string_view::npos && scan.count < 8)) return false;
        failed = need_dims(word_at_, name);
        return true;
    }
    grid().dims_used = true;
    const std::uint64_t cells = box_.value_or(whole_grid()).count();
    std::vector<double> values;
    const ArrayScan count = read_numbers(text, 0, values, options_->monitor);
    if (count.status == ArrayStatus::ok && count.count != cells && is_short_property(name, text, count.count)) {
        failed = unreadable("F008", where(slash),
                            "expected " + std::to_string(cells) + " values of " + name + ", found " + std::to_string(count.count));
        return true;
    }
    if (count.status != ArrayStatus::ok || count.count != cells || cells > room_) return false;
    room_ -= cells;
    // One value a cell, but more records after it: a table then, and not a property.
    in().after_slash(slash);
    if (cells < 100 && in().data_follows(false, is_known)) {
        in().jump(start);
        return false;
    }
    if (count.whole) {
        std::vector<std::int32_t> wholes;
        static_cast<void>(read_numbers(text, cells, wholes, options_->monitor));
        failed = store(name, std::move(wholes), {});
    } else {
        static_cast<void>(read_numbers(text, cells, values, options_->monitor));
        failed = store(name, std::move(values), {});
    }
    return true;
}

bool DeckReader::unknown_words(const std::string& name) {
    if (!grid().dims || box_) return false;
    grid().dims_used = true;
    const char* start = in().at();
    const std::uint64_t cells = cells_of(*grid().dims);
    std::vector<std::string> words;
    for (;;) {
        const Item item = in().item();
        const bool ends = item.at != nullptr && !item.quoted && item.text == "/";
        if (ends && words.size() == cells) break;
        if (item.at == nullptr || !item.quoted || words.size() == cells) {
            in().jump(start);
            return false;
        }
        words.emplace_back(item.text);
    }
    grid().arrays.push_back({name, std::move(words), section_});
    return true;
}

}  // namespace geomend::grdecl
