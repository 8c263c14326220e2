// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/grdecl/grdecl.h"

#include <algorithm>
#include <array>

#include "base/text_cursor.h"
#include "formats/grdecl/deck_reader.h"
#include "formats/grdecl/writing.h"

namespace geomend::grdecl {

namespace {

constexpr std::string_view include_extensions[] = {".grdecl", ".inc", ".prop"};
constexpr std::string_view deck_extensions[] = {".data"};

/// The first keyword of a text.
struct FirstKeyword {
    std::string name;       ///< empty where the text begins in another way
    bool is_upper = false;  ///< written in capitals
    bool is_alone = false;  ///< on its line
};

FirstKeyword first_keyword(std::string_view head) {
    std::size_t line = 0;
    while (line < head.size()) {
        const std::size_t end = std::min(head.find('\n', line), head.size());
        std::string_view text = trimmed(head.substr(line, end - line));
        line = end + 1;
        const std::size_t comment = text.find("--");
        if (comment != std::string_view::npos) text = trimmed(text.substr(0, comment));
        if (text.empty()) continue;
        const std::string_view word = text.substr(0, text.find_first_of(" \t"));
        if (!is_keyword(word)) return {};
        const bool is_upper = std::ranges::none_of(word, [](char c) { return c >= 'a' && c <= 'z'; });
        return {std::string(known_name(word)), is_upper, word.size() == text.size()};
    }
    return {};
}

bool is_text(std::string_view head) { return head.find('\0') == std::string_view::npos; }

int sniff_include(std::string_view head, std::string_view) {
    if (!is_text(head)) return 0;
    const auto [word, is_upper, is_alone] = first_keyword(head);
    if (word.empty() || !is_known(word)) return 0;
    constexpr std::array strong = {"SPECGRID", "COORD",  "ZCORN", "MAPAXES", "MAPUNITS", "GRIDUNIT",
                                   "ACTNUM",   "NOECHO", "PINCH", "FAULTS",  "GRID",     "INCLUDE"};
    // "import os", "copy files" and "title" begin other texts.
    if (std::ranges::find(strong, word) != strong.end()) return is_upper || is_alone ? 90 : 0;
    return is_upper && is_alone ? 60 : 0;
}

int sniff_deck(std::string_view head, std::string_view) { return is_text(head) && first_keyword(head).name == "RUNSPEC" ? 95 : 0; }

constexpr Keeps grid_keeps() {
    Keeps keeps;
    keeps.corner_point_grids = Keeping::yes;
    keeps.fault_faces = Keeping::yes;
    keeps.connections = Keeping::yes;
    keeps.several_objects = Keeping::partly;
    keeps.names = Keeping::yes;
    keeps.attributes = Keeping::yes;
    keeps.units = Keeping::partly;
    keeps.no_data = Keeping::yes;
    keeps.crs = Keeping::partly;
    keeps.exact_coordinates = Keeping::yes;
    return keeps;
}

constexpr std::string_view note =
    "substance: other objects, a second grid, connections between grids, values that are not of cells; identity: units of properties, "
    "names of codes, coordinate system, in includes the other sections of a deck";
constexpr std::string_view tried = "real files";

constexpr std::array options{
    OptionRow{"dims", OptionUse::reading, OptionValue::whole_numbers, "NX,NY,NZ",
              "numbers of cells, for property files that do not state them"},
    OptionRow{"includes", OptionUse::reading, OptionValue::words, "all|skip",
              "whether a missing include is an error (the default) or passed over"},
    OptionRow{"max-values", OptionUse::reading, OptionValue::whole_number, "N", "most values that repeat counts may stand for"},
    OptionRow{"content", OptionUse::writing, OptionValue::words, "all|properties",
              "the grid with all that it holds, or its properties only"},
    OptionRow{"properties", OptionUse::writing, OptionValue::words, "beside|inside", "where properties go that a simulator does not know"},
};

constexpr std::array rows = {
    Format{"grdecl", "grdecl", "GRDECL, grid section of a deck", include_extensions, sniff_include, read_deck, write_include,
           WriterWants::corner_point, grid_keeps(), note, tried, options, true, true},
    Format{"data", "grdecl", "whole simulator deck", deck_extensions, sniff_deck, read_deck, write_whole_deck, WriterWants::corner_point,
           grid_keeps(), note, tried, options, true, true},
};

}  // namespace

std::span<const Format> formats() { return rows; }

}  // namespace geomend::grdecl
