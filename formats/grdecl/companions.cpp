// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/grdecl/companions.h"

#include "base/text_cursor.h"

namespace geomend::grdecl {

namespace {

// The first item behind the keyword of a kept record.
std::string first_item_of(std::string_view record) {
    record.remove_prefix(std::min(record.find_first_of(" \t\r\n"), record.size()));
    record = trimmed(record);
    if (!record.empty() && (record[0] == '\'' || record[0] == '"')) {
        const std::size_t end = record.find(record[0], 1);
        return std::string(trimmed(record.substr(1, end == std::string_view::npos ? end : end - 1)));
    }
    return std::string(record.substr(0, record.find_first_of(" \t\r\n")));
}

}  // namespace

std::vector<DeckCompanion> deck_companions(const Dataset& dataset) {
    std::vector<DeckCompanion> companions;
    for (const Object& object : dataset.objects) {
        for (const Annotation& a : info_of(object).annotations) {
            if (a.key != "grdecl.record") continue;
            const std::string_view word = std::string_view(a.value).substr(0, a.value.find_first_of(" \t\r\n"));
            if (word == "GDFILE" || word == "IMPORT") companions.push_back({std::string(word), first_item_of(a.value)});
        }
    }
    return companions;
}

std::string companion_loss(std::string_view keyword, std::string_view path) {
    return (keyword == "GDFILE" ? "the geometry, which GDFILE takes from " : "what IMPORT takes from ") + std::string(path);
}

}  // namespace geomend::grdecl
