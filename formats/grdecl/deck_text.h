// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/input.h"
#include "base/result.h"
#include "formats/byte_order_mark.h"

// The text of decks: blanks and commas part items, "--" begins a comment, "/" ends a record, N*value repeats and N*
// defaults. Rules: section 1 of the reference of the format (Eclipse's free format as OPM reads it).

namespace geomend::grdecl {

/// Blank, tab, comma, line ends, VT, FF and SOH part items.
bool is_separator(char c);
/// Letters, digits, '-', '_' and '+', beginning with a letter.
bool is_keyword(std::string_view word);

/// One item of a record.
struct Item {
    std::string_view text;  ///< without quotes
    const char* at = nullptr;
    bool quoted = false;
    bool given = true;  ///< false: defaulted by N*
};

/// The items before one '/'. Repeats are written out; items that are left away at the end are not there.
struct Record {
    std::vector<Item> items;
    const char* begin = nullptr;
    const char* slash = nullptr;
    bool slash_missing = false;  ///< it has all its items, and the next line goes on with something else: `slash` is there

    bool given(std::size_t i) const { return i < items.size() && items[i].given; }
    std::string_view text(std::size_t i) const { return given(i) ? items[i].text : std::string_view{}; }
};

/// What the record of a keyword may hold.
struct RecordRule {
    std::size_t most = 0;                       ///< items; 0: not known
    std::size_t words = 0;                      ///< so many items at its front may be words that are keywords, too
    bool (*known)(std::string_view) = nullptr;  ///< tells keywords
    bool may_lack_slash = false;                ///< complete at a line end, it may end there
};

/// Where a byte of an input stands. Cost: counts the lines before it.
Location location_of(const Input& input, const char* at);
/// "'1.2.3'", cut to a length fit for a message.
std::string shown(std::string_view token);
/// The first '/' that is not in a comment, or end. Quotes are not looked at: for arrays of numbers.
const char* find_slash(const char* at, const char* end);

/// Walks over one input.
class Scanner {
public:
    /// Begins behind a byte-order mark.
    explicit Scanner(const Input& input);

    const Input& input() const { return *input_; }
    const char* at() const { return at_; }
    const char* end() const { return end_; }
    void jump(const char* to) { at_ = to; }
    Location here() const { return location_of(*input_, at_); }
    Location location(const char* at) const { return location_of(*input_, at); }

    /// Goes over separators and comments; false at the end.
    bool skip();
    /// The next item, or "/" as text for a slash; nothing (at == nullptr) at the end.
    Item item();
    /// The items up to the next '/', which is taken. F004 at the end of the file, F012 for a bad repeat count.
    /// A keyword on a line of its own before the record is complete, and items beyond the
    /// most that it may have, are F008.
    Result<Record> record(std::string_view keyword, const RecordRule& rule = {});
    /// Whether the next word is unquoted, begins its line and is alone on it.
    bool word_alone_follows(std::string_view& word);
    /// Goes behind a '/': what follows it in its line is a remark.
    void after_slash(const char* slash);
    /// Takes a lone '/' where it is next.
    bool take_slash();
    /// Goes to the start of the next line.
    void skip_line();
    /// The text from here to the end of the line.
    std::string_view rest_of_line() const;
    /// Whether what comes next belongs to a keyword of unknown kind: `first` right after it, else after a record of it.
    bool data_follows(bool first, bool (*known)(std::string_view));

private:
    const Input* input_;
    const char* at_;
    const char* end_;
};

}  // namespace geomend::grdecl
