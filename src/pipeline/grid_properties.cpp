// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/grid_properties.h"

#include <iterator>
#include <utility>

#include "base/text_cursor.h"
#include "base/wording.h"
#include "grid/map_axes.h"

namespace geomend {

namespace {

Result<std::vector<Object>> sources_of(const PropertyRequest& request, const LoadOptions& load_options) {
    std::vector<Object> sources;
    LoadOptions options = load_options;
    options.from.clear();
    options.one_of_many = true;
    for (const std::string& file : request.files) {
        auto dataset = load(file, options);
        if (!dataset) return std::move(dataset).why();
        for (Object& object : dataset->objects) {
            if (auto* grid = std::get_if<CornerPointGrid>(&object)) {
                if (auto moved = grid::apply_map_axes(*grid); !moved) return std::move(moved).why();
            }
            sources.push_back(std::move(object));
        }
    }
    return sources;
}

}  // namespace

Result<gridding::SampledProperties> add_properties(const PropertyRequest& request, const LoadOptions& load_options, CornerPointGrid& grid) {
    gridding::SampledProperties none;
    if (request.files.empty()) {
        if (request.properties.empty()) return none;
        return failure(FailureKind::usage, "F018", {}, "--properties: say with --properties-of which files have them");
    }
    const auto rules = gridding::parse_properties(request.properties);
    if (!rules) return rules.why();
    const auto sources = sources_of(request, load_options);
    if (!sources) return sources.why();
    auto sampled = gridding::sample_properties(grid, *sources, *rules);
    if (!sampled) return std::move(sampled).why();
    for (std::size_t a = 0; a < sampled->attributes.size();) {
        const std::string name = sampled->attributes[a].name;
        // ACTNUM is no property among others: which cells take part is the grid's own.
        if (!same_word(name, "ACTNUM") && find_attribute(grid.info.attributes, name, AttributeLocation::cell) == nullptr) {
            ++a;
            continue;
        }
        sampled->notes.push_back("property " + geomend::quoted(name) + " is not sampled: the grid has its own");
        sampled->attributes.erase(sampled->attributes.begin() + static_cast<std::ptrdiff_t>(a));
        sampled->report.erase(sampled->report.begin() + static_cast<std::ptrdiff_t>(a));
    }
    auto& own = grid.info.attributes;
    own.insert(own.end(), std::make_move_iterator(sampled->attributes.begin()), std::make_move_iterator(sampled->attributes.end()));
    sampled->attributes.clear();
    return sampled;
}

}  // namespace geomend
