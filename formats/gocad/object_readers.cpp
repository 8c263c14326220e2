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
        Row{"TSolid", read_tsolid},
        Row{"LightTSolid", read_light_tsolid},
        Row{"Voxet", read_voxet},
        Row{"SGrid", read_sgrid},
        Row{"GSurf", read_grid2d},
        Row{"Grid2D", read_grid2d},
        Row{"2DGrid", read_grid2d},
        Row{"Well", read_well},
    };
    for (const auto& [word, reader] : rows) {
        if (same_word(type, word)) return reader;
    }
    return nullptr;
}

}  // namespace geomend::gocad
