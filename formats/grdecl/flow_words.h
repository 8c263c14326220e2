// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "formats/grdecl/deck.h"

// What OPM Flow 2022.10 does not take of a deck although it can be understood: it stops there. Tried with the program.

namespace geomend::grdecl {

/// Whether OPM Flow 2022.10 knows a keyword, in any section. \pre in upper case
bool flow_reads(std::string_view keyword);

/// Whether it takes an array as the one that EQUALS, ADD, MULTIPLY, COPY and their like change.
bool flow_operates_on(std::string_view array);

/// Whether OPERATER of OPM Flow 2022.10 takes a word as its array of regions: the name of one of whole numbers, never M, F or O.
bool flow_takes_regions(std::string_view array);

/// Reports (F149) what OPM Flow stops at. The same message is counted, not repeated.
void note_flow_stops(std::vector<Finding>& findings, const Location& where, const std::string& message);

/// Item `i` as simulators compare words: in upper case. Where it is not written so (lower case, or blanks within its
/// quotes) it is reported as F146: `what` says what it is, as "the face of a fault".
std::string take_word(const Scanner& in, const Record& record, std::size_t i, std::string_view what, std::vector<Finding>& findings);

}  // namespace geomend::grdecl
