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

void forget_companion(const DeckCompanion& companion, ObjectInfo& info, std::vector<Loss>& losses) {
    const std::string lost = companion_loss(companion.keyword, companion.path);
    std::erase_if(losses, [&](const Loss& loss) { return loss.what == lost; });
    std::erase_if(info.annotations, [&](const Annotation& a) {
        return a.key == "grdecl.record" && a.value.starts_with(companion.keyword) && a.value.find(companion.path) != std::string::npos;
    });
}

}  // namespace geomend::grdecl
