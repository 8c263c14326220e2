// SPDX-License-Identifier: AGPL-3.0-or-later
// A deck made of a deck has every keyword that was not understood, word for word, or lists it as lost: never neither.
#include <gtest/gtest.h>
//
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <sstream>

#include "grdecl/grdecl_support.h"

namespace geomend::test {

namespace {

/// A keyword with its records, as it stands in a section.
struct Piece {
    std::string name, text;
};

std::string number_or_word() {
    return *rc::gen::oneOf(rc::gen::map(rc::gen::inRange(0, 5000), [](int n) { return std::to_string(n); }),
                           rc::gen::map(rc::gen::inRange(1, 99), [](int n) { return std::to_string(n) + ".25E-2"; }),
                           rc::gen::element<std::string>("'NAME'", "'a b'", "2*", "3*7", "'with / in it'", "1*"));
}

/// A word and a number at its front: with numbers only, one for each cell, it would be a property.
std::string record() {
    std::string text = " 'FIRST' " + std::to_string(*rc::gen::inRange(0, 100));
    const auto items = *rc::gen::inRange(0, 6);
    for (int i = 0; i < items; ++i) text += ' ' + number_or_word();
    return text + " /\n";
}

/// Keywords with records: unknown ones, and such as simulators know and this program keeps.
Piece with_records(std::vector<std::string> names) {
    Piece piece;
    piece.name = *rc::gen::elementOf(names);
    piece.text = piece.name + '\n';
    const bool list = *rc::gen::arbitrary<bool>();
    const auto records = list ? *rc::gen::inRange(1, 4) : 1;
    for (int r = 0; r < records; ++r) piece.text += record();
    if (list) piece.text += "/\n";
    return piece;
}

Piece alone(std::vector<std::string> names) {
    const std::string name = *rc::gen::elementOf(names);
    return {name, name + '\n'};
}

std::vector<Piece> pieces_of(const std::vector<std::string>& with, const std::vector<std::string>& without) {
    std::vector<Piece> pieces;
    const auto count = *rc::gen::inRange(0, 5);
    for (int i = 0; i < count; ++i) {
        Piece piece = !without.empty() && *rc::gen::inRange(0, 3) == 0 ? alone(without) : with_records(with);
        const bool there = std::ranges::any_of(pieces, [&](const Piece& p) { return p.name == piece.name; });
        if (!there) pieces.push_back(std::move(piece));
    }
    return pieces;
}

std::string text_of(const std::vector<Piece>& pieces) {
    std::string text;
    for (const Piece& p : pieces) text += p.text + '\n';
    return text;
}

/// Words of a text, so that blanks and line ends do not count.
std::string words_of(const std::string& text) {
    std::istringstream in(text);
    std::string words, word;
    while (in >> word) words += word + ' ';
    return words;
}

const std::string grid_text =
    "COORD\n 0 0 0 0 0 9 1 0 0 1 0 9 2 0 0 2 0 9 0 1 0 0 1 9 1 1 0 1 1 9 2 1 0 2 1 9 /\nZCORN\n 8*1 8*2 8*2 8*3 /\nPORO\n 4*0.2 /\n";

}  // namespace

RC_GTEST_PROP(KeptKeywords, EveryOneIsThereOrListed, ()) {
    const auto run = pieces_of({"WELLDIMS", "TABDIMS", "MARVEL1", "REGDIMS", "GRIDOPTS"}, {"OIL", "WATER", "UNIFOUT", "CO2STORE"});
    const auto grid = pieces_of({"MARVEL2", "COARSEN", "THPRESFT", "AQUCON", "JFUNC", "MINRV", "GLORP", "PINCHREG", "RPTGRID"},
                                {"INIT", "HALFTRAN", "NEWTRAN", "NODPPM"});
    const auto edit = pieces_of({"MARVEL3", "EDITNNCR", "MULTREGD", "AQUANCON"}, {});
    const auto props = pieces_of({"MARVEL4", "PVTW", "SWOF", "ROCK"}, {"FILLEPS"});
    const auto regions = pieces_of({"MARVEL5", "RPTREGS", "THPRES"}, {});
    const auto schedule = pieces_of({"MARVEL6", "TSTEP", "WELSPECS"}, {"NOSIM"});
    const std::string deck = "RUNSPEC\nDIMENS\n 2 1 2 /\n" + text_of(run) + "GRID\n" + grid_text + text_of(grid) + "EDIT\n" +
                             text_of(edit) + "PROPS\n" + text_of(props) + "REGIONS\n" + text_of(regions) + "SOLUTION\nSUMMARY\nSCHEDULE\n" +
                             text_of(schedule) + "END\n";
    const auto d = row("data").read(Input::from_memory(deck, "a.DATA"), {});
    RC_ASSERT(d.ok());
    const TemporaryFolder folder;
    OutputSet out(folder / "b.DATA");
    const auto losses = row("data").write(*d, out, {});
    RC_ASSERT(losses.ok());
    RC_ASSERT(out.commit().ok());
    const std::string written = words_of(read_file(folder / "b.DATA"));
    for (const auto* part : {&run, &grid, &edit, &props, &regions, &schedule}) {
        for (const Piece& p : *part) {
            const bool kept = written.find(words_of(p.text)) != std::string::npos;
            const auto names_it = [&](const Loss& l) { return l.what.find(p.name) != std::string::npos; };
            const bool listed = std::ranges::any_of(d->losses, names_it) || std::ranges::any_of(*losses, names_it);
            if (!kept && !listed) RC_FAIL("neither kept nor listed:\n" + p.text + "\nof\n" + deck + "\nin\n" + written);
        }
    }
    // And once more: what was made of it says the same.
    const auto again = read_path(folder / "b.DATA");
    RC_ASSERT(again.ok());
    RC_ASSERT(same(grid_of(*d).depths, grid_of(*again).depths));
}

}  // namespace geomend::test
