// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/deck_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "grid/pore_volume.h"

namespace geomend {

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

void list_losses_of(const ObjectInfo& info, std::vector<Loss>& losses) {
    for (const Annotation& a : info.annotations) {
        if (!a.key.starts_with("grdecl.record")) continue;
        for (const TextPart& part : text_parts) {
            if (a.value.starts_with(part.keyword))
                add_loss(losses, {LossClass::substance, info.name, std::string(part.what), "only decks hold it"});
        }
    }
}

bool acts_on_pores(const CornerPointGrid& grid) {
    return std::ranges::any_of(grid.edit_operations, [](const auto& op) { return op.array == "PORV"; });
}

bool has_gaps(const CornerPointGrid& grid, const Attribute& a) {
    for (std::size_t c = 0; c < grid.cell_count(); ++c) {
        const double v = value_as_double(a, c);
        if (grid.is_active(c) && (std::isnan(v) || is_no_data(a, v))) return true;
    }
    return false;
}

}  // namespace

void complete_pore_volumes(Dataset& dataset) {
    for (Object& object : dataset.objects) {
        auto* grid = std::get_if<CornerPointGrid>(&object);
        if (grid == nullptr || grid->porosity != CornerPointGrid::Porosity::single || grid->depths.empty() || !misfit(*grid).empty())
            continue;
        auto& attributes = grid->info.attributes;
        const Attribute* stated = find_attribute(attributes, "PORV", AttributeLocation::cell);
        const bool gaps =
            stated != nullptr && stated->components == 1 && value_count(*stated) == grid->cell_count() && has_gaps(*grid, *stated);
        if (!(gaps || acts_on_pores(*grid)) || !grid::knows_pore_volumes(*grid)) continue;
        Attribute volumes;
        volumes.name = "PORV";
        volumes.location = AttributeLocation::cell;
        std::vector<double> values = grid::pore_volumes(*grid);
        for (std::size_t c = 0; c < values.size(); ++c) {
            if (!grid->is_active(c)) values[c] = 0;
        }
        volumes.values = std::move(values);
        std::erase_if(attributes, [](const Attribute& a) { return a.name == "PORV" && a.location == AttributeLocation::cell; });
        attributes.push_back(std::move(volumes));
    }
}

void list_text_losses(Dataset& dataset, const Format& target) {
    if (target.family == "grdecl") return;
    for (const Object& object : dataset.objects) list_losses_of(info_of(object), dataset.losses);
}

}  // namespace geomend
