// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/grdecl/kept_text.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "formats/grdecl/flow_words.h"
#include "formats/grdecl/keywords.h"

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

/// A keyword that no reader of decks knows and that has numbers behind it.
std::string unknown_with_numbers(const Annotation& a) {
    const std::string_view text = a.value;
    const std::size_t end = std::min(text.find_first_of(" \t\r\n/"), text.size());
    const std::string name = known_name(text.substr(0, end));
    if (is_known(name) || flow_reads(name)) return {};
    const std::size_t value = text.find_first_not_of(" \t\r\n", end);
    const bool number = value != std::string_view::npos && std::string_view("0123456789+-.*").find(text[value]) != std::string_view::npos;
    return number ? name : std::string();
}

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
            if (const std::string name = unknown_with_numbers(a); !name.empty())
                add_loss(losses, {LossClass::identity, info.name, "numbers of the unknown keyword " + name, "only decks hold it"});
        }
    }
    return losses;
}

}  // namespace geomend::grdecl
