// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace geomend::grdecl {

enum class Section : std::uint8_t { none, runspec, grid, edit, props, regions, solution, summary, schedule };

/// "RUNSPEC", ...; empty for none.
std::string_view section_name(Section s);
/// The section that a word begins, or none.
Section section_of(std::string_view word);
/// Sections of which nothing concerns the grid: their text is kept as it stands.
inline bool kept_as_text(Section s) { return s == Section::props || s >= Section::solution; }

/// A keyword that is followed by one value for each cell.
struct CellKeyword {
    std::string_view name;
    bool whole = false;             ///< whole numbers
    std::optional<double> initial;  ///< what simulators take where nothing is given
    Section section = Section::grid;
    bool simulated = true;  ///< flow 2022.10 takes it where it stands in that section
};

/// The row of a cell keyword; FIP and anything is a region. Nothing for an unknown one.
std::optional<CellKeyword> cell_keyword(std::string_view name);

/// What follows a keyword that is known but says nothing about the grid: it is kept as text.
enum class Shape : std::uint8_t { unknown, alone, records };
Shape shape_of(std::string_view name);

/// Whether a word is a keyword that this reader knows: of any kind.
bool is_known(std::string_view name);

/// How many items a record of a keyword has at most, and how many of them may be words; 0: not known.
struct ItemCounts {
    std::size_t most = 0, words = 0;
};
ItemCounts item_counts(std::string_view name);

/// What may stand right behind a keyword, on its line.
enum class FirstItem : std::uint8_t { nothing, number, word, path, any };
FirstItem first_item(std::string_view name);

/// Upper case, without blanks; of a word longer than eight letters that is not known the first eight, if those are.
std::string known_name(std::string_view word);

}  // namespace geomend::grdecl
