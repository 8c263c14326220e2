// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/grdecl/deck.h"

namespace geomend::grdecl {

/// What comes again and again in a deck and is told once: how often, where first, and by which names.
struct Noted {
    std::uint64_t count = 0;
    Location first;
    std::vector<std::string> names;  ///< each once, the first hundred

    /// \param where gives the place; asked for the first time only, since it counts lines
    template <class Where>
    void add(const Where& where, std::string_view name = {}) {
        if (count++ == 0) first = where();
        if (!name.empty() && names.size() < 100 && std::ranges::find(names, name) == names.end()) names.emplace_back(name);
    }
};

struct DeckNotes {
    Noted unknown;        ///< keywords that were kept as they stand
    Noted unread;         ///< keywords that OPM Flow does not know
    Noted stray_slashes;  ///< that end nothing
    Noted remarks;        ///< text behind keywords on their lines
    Noted not_applied;    ///< operations; the names are those of arrays that are not there
};

/// One finding for each kind that came up.
void add_findings(const DeckNotes& notes, std::vector<Finding>& findings);

}  // namespace geomend::grdecl
