// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/roff/subgrids.h"

#include "formats/roff/document.h"
#include "formats/roff/read_roff.h"
#include "formats/roff/tag_text.h"

namespace geomend::roff {

std::vector<std::int32_t> subgrid_layers(const CornerPointGrid& grid) {
    for (const Annotation& a : grid.info.annotations) {
        if (a.key != tag_key) continue;
        const auto kept = tag_from_text(a.value);
        if (!kept || kept->tags.front().name != "subgrids") continue;
        const Entry* entry = find_entry(kept->tags.front(), "nLayers");
        if (entry == nullptr) continue;
        auto layers = integers(*kept, *entry);
        if (!layers) continue;
        std::int64_t sum = 0;
        bool positive = true;
        for (const std::int32_t n : *layers) {
            sum += n;
            positive = positive && n > 0;
        }
        if (positive && sum == grid.dims[2]) return std::move(*layers);
    }
    return {};
}

std::optional<Attribute> subgrid_attribute(const CornerPointGrid& grid) {
    const std::vector<std::int32_t> layers = subgrid_layers(grid);
    if (layers.size() < 2) return {};
    const std::size_t layer = std::size_t{grid.dims[0]} * grid.dims[1];
    std::vector<std::int32_t> values;
    values.reserve(grid.cell_count());
    for (std::size_t s = 0; s < layers.size(); ++s)
        values.insert(values.end(), layer * static_cast<std::size_t>(layers[s]), static_cast<std::int32_t>(s + 1));
    Attribute a;
    a.name = subgrid_name;
    a.location = AttributeLocation::cell;
    a.values = std::move(values);
    return a;
}

}  // namespace geomend::roff
