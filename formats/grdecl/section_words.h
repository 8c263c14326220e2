// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "formats/grdecl/keywords.h"

namespace geomend::grdecl {

/// Follows a section that is kept as text, line by line, and says which lines name a keyword that OPM Flow does not know. What no grammar
/// is known for is not guessed at: only a line that is nothing but one word, at its beginning, where no record can be open counts.
class SectionWords {
public:
    explicit SectionWords(Section section) : section_(section) {}

    /// \param line without its end
    /// \return the keyword, in upper case; empty where there is none, or a known one
    std::string unknown_in(std::string_view line);

    /// The fault that a record of MULTFLT names in this line of SCHEDULE; empty where there is none.
    std::string fault_in(std::string_view line);

private:
    Section section_;
    bool may_begin_ = true;   ///< a keyword may stand in the next line
    bool in_faults_ = false;  ///< a list of MULTFLT is open
};

}  // namespace geomend::grdecl
