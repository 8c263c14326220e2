// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/deck_parts.h"

#include <algorithm>
#include <cmath>

#include "formats/eclipse/kept_arrays.h"
#include "formats/grdecl/kept_text.h"
#include "grid/pore_volume.h"

namespace geomend {

namespace {

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
    if (target.family != "eclipse") {
        for (Loss& loss : eclipse::losses_of_arrays(dataset)) add_loss(dataset.losses, std::move(loss));
    }
    if (target.deck) return;
    for (Loss& loss : grdecl::losses_of_text(dataset)) add_loss(dataset.losses, std::move(loss));
}

}  // namespace geomend
