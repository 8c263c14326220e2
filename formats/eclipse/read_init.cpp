// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/eclipse/kept_arrays.h"
#include "formats/eclipse/property_file.h"
#include "formats/eclipse/read_egrid.h"

namespace geomend::eclipse {

namespace {

/// Transmissibilities of the connections that the grid file states, in its order. True where they were taken.
Result<bool> take_transmissibilities(const ArrayFile& file, const Array& array, CornerPointGrid& grid) {
    std::vector<CornerPointGrid::Connection>* to = nullptr;
    if (array.name == "TRANNNC") to = &grid.connections;
    if (array.name == "TRANGL") {
        for (CornerPointGrid::Link& link : grid.links) {
            if (link.grid.empty()) to = &link.connections;
        }
    }
    if (to == nullptr || to->empty() || to->size() != array.count) return false;
    const auto values = reals(file, array);
    if (!values) return values.why();
    for (std::size_t i = 0; i < to->size(); ++i) (*to)[i].transmissibility = (*values)[i];
    return true;
}

Result<void> take_part(const ArrayFile& file, const PropertyPart& part, const ReadOptions& options, PropertyGrids& grids) {
    const auto place = grids.grid_of(part);
    if (!place) return place.why();
    CornerPointGrid& grid = grids.grids[place->index];
    for (std::size_t i = part.first; i < part.last; ++i) {
        if (options.monitor != nullptr && options.monitor->stopped())
            return failure(FailureKind::cancelled, "F022", {file.input.name()}, "stopped");
        const Array& array = file.arrays[i];
        if (array.name == "LGR" || array.name == "ENDLGR" || array.name == "LGRSGONE" || array.name == "ACTNUM") continue;
        if (!is_no_cell_array(array.name) && fits_cells(array, place->order)) {
            if (auto done = take_cell_array(file, array, place->order, array.name, grid, grids.findings); !done) return done;
            continue;
        }
        if (is_cell_property(array.name)) return wrong_cell_count(file, array, place->order);
        const auto taken = take_transmissibilities(file, array, grid);
        if (!taken) return taken.why();
        if (*taken) continue;
        auto kept = kept_array(file, array, init_key);
        if (!kept) return kept.why();
        grid.info.annotations.push_back(std::move(*kept));
    }
    return {};
}

}  // namespace

Result<Dataset> read_init(const Input& input, const ReadOptions& options) {
    const auto file = find_arrays(input, options.monitor);
    if (!file) return file.why();
    const auto parts = property_parts(*file, 0, file->arrays.size());
    if (!parts) return parts.why();
    PropertyGrids grids(*file, options);
    if (auto done = grids.find_companion(*parts); !done) return done.why();
    for (const PropertyPart& part : *parts) {
        if (auto done = take_part(*file, part, options, grids); !done) return done.why();
    }
    Dataset data;
    data.format = "eclipse";
    data.variant = file->formatted ? "FINIT" : "INIT";
    data.findings = std::move(grids.findings);
    data.annotations = std::move(grids.annotations);
    data.losses = std::move(grids.losses);
    for (CornerPointGrid& grid : grids.grids) data.objects.emplace_back(std::move(grid));
    return data;
}

}  // namespace geomend::eclipse
