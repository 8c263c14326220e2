// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/grdecl/kept_text.h"

#include <array>
#include <string_view>

namespace geomend::grdecl {

namespace {

struct TextPart {
    std::string_view keyword, what;
};
constexpr std::array text_parts = {
    TextPart{"RADFIN", "a radial local grid"},
    TextPart{"ADDZCORN", "what ADDZCORN adds to the corner depths"},
    TextPart{"COARSEN", "coarsening (COARSEN)"},
    TextPart{"COLLAPSE", "collapsed cells (COLLAPSE)"},
    TextPart{"THPRESFT", "threshold pressures of faults (THPRESFT)"},
};

}  // namespace

std::vector<Loss> losses_of_text(const Dataset& dataset) {
    std::vector<Loss> losses;
    for (const Object& object : dataset.objects) {
        const ObjectInfo& info = info_of(object);
        for (const Annotation& a : info.annotations) {
            if (!a.key.starts_with("grdecl.record")) continue;
            for (const TextPart& part : text_parts) {
                if (a.value.starts_with(part.keyword))
                    add_loss(losses, {LossClass::substance, info.name, std::string(part.what), "only decks hold it"});
            }
        }
    }
    return losses;
}

}  // namespace geomend::grdecl
