// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/grdecl/deck_notes.h"

#include <span>

namespace geomend::grdecl {

namespace {

std::string listed(std::span<const std::string> names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

}  // namespace

void add_findings(const DeckNotes& notes, std::vector<Finding>& findings) {
    const auto add = [&](const char* code, const Noted& noted, std::string message) {
        if (noted.count > 0) findings.push_back(finding(code, noted.first, std::move(message), noted.count));
    };
    add("F102", notes.unknown,
        (notes.unknown.names.size() == 1 ? "a keyword that is not known is kept as it stands: "
                                         : "keywords that are not known are kept as they stand: ") +
            listed(notes.unknown.names));
    add("F149", notes.unread,
        (notes.unread.names.size() == 1 ? "OPM Flow does not know the keyword " : "OPM Flow does not know the keywords: ") +
            listed(notes.unread.names));
    add("F144", notes.remarks, "text behind a keyword on its line is taken as a remark");
    add("F118", notes.stray_slashes, "a '/' ends nothing");
    add("F142", notes.not_applied,
        "operations on arrays that are not there (" + listed(notes.not_applied.names) + ") are kept as they stand, not applied");
}

}  // namespace geomend::grdecl
