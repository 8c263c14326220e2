// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/object_readers.h"

#include <array>
#include <utility>

namespace geomend::gocad {

ObjectReader object_reader(std::string_view type) {
    using Row = std::pair<std::string_view, ObjectReader>;
    static constexpr std::array rows{
        Row{"VSet", read_vset},
        Row{"PLine", read_pline},
        Row{"TSurf", read_tsurf},
        Row{"Voxet", read_voxet},
    };
    for (const auto& [word, reader] : rows) {
        if (same_word(type, word)) return reader;
    }
    return nullptr;
}

}  // namespace geomend::gocad
