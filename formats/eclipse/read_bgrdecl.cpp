// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>

#include "base/number_text.h"
#include "formats/eclipse/cell_arrays.h"
#include "formats/eclipse/grid_arrays.h"
#include "formats/eclipse/kept_arrays.h"
#include "formats/eclipse/property_file.h"
#include "formats/eclipse/read_egrid.h"

namespace geomend::eclipse {

namespace {

Result<void> take_spec(const ArrayFile& file, const Array& array, GridParts& parts) {
    const auto values = integers(file, array);
    if (!values) return values.why();
    if (values->size() < 3) {
        return unreadable("F008", place_of(file, array), "expected at least 3 values of SPECGRID, found " + std::to_string(values->size()));
    }
    if (auto done = set_dims(file, array, values->at(0), values->at(1), values->at(2), parts); !done) return done;
    const std::int32_t sets = values->size() > 3 ? values->at(3) : 1;
    if (sets < 0 || sets > values->at(2)) {
        return unreadable("F014", place_of(file, array),
                          "expected at most a set of coordinate lines for each layer, found " + std::to_string(sets));
    }
    parts.pillar_sets = static_cast<std::size_t>(std::max(1, sets));
    parts.grid.cylindrical = values->size() > 4 && values->at(4) == 1;
    return {};
}

/// The numbers of cells of a file of properties, which does not state them.
Result<void> take_dims_option(const ArrayFile& file, const ReadOptions& options, GridParts& parts) {
    std::string_view text = option_value(options.options, "dims");
    if (text.empty())
        return unreadable("F024", {file.input.name()},
                          "the file holds properties, but not the numbers of cells: give them with --option dims=NX,NY,NZ, or the grid's "
                          "own file as the first input");
    std::array<std::int32_t, 3> dims{};
    for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t comma = std::min(text.find(','), text.size());
        std::int64_t number = 0;
        const bool ok = parse_integer(text.substr(0, comma), number) == NumberStatus::ok && number >= 1 && number <= 2'000'000'000;
        dims[a] = static_cast<std::int32_t>(number);
        if (!ok || (comma == text.size()) != (a == 2))
            return failure(FailureKind::usage, "F018", {},
                           "option dims: expected three numbers of cells NX,NY,NZ, found '" +
                               std::string(option_value(options.options, "dims")) + "'");
        text.remove_prefix(std::min(comma + 1, text.size()));
    }
    return set_dims(file, file.arrays.front(), dims[0], dims[1], dims[2], parts);
}

/// A grid of properties alone.
Result<CornerPointGrid> bare_grid(const ArrayFile& file, GridParts&& parts) {
    CornerPointGrid& grid = parts.grid;
    if (parts.activity != nullptr && parts.activity->count != grid.cell_count())
        return unreadable(
            "F008", place_of(file, *parts.activity),
            "expected " + std::to_string(grid.cell_count()) + " values of 'ACTNUM', found " + std::to_string(parts.activity->count));
    grid.info.crs.z_positive = ZPositive::depth;
    grid.info.crs.z_positive_stated = true;
    return std::move(grid);
}

/// In a file that holds nothing but properties.
bool may_be_property(const Array& array) { return array.count > 0 && array.type != ArrayType::message && !is_no_cell_array(array.name); }

void tell_unknown(const ArrayFile& file, const std::vector<const Array*>& unknown, std::vector<Finding>& findings) {
    if (unknown.empty()) return;
    Finding f =
        make_finding("F102", "arrays that are not of the grid are kept as they are:", place_of(file, *unknown.front()), unknown.size());
    for (std::size_t i = 0; i < std::min<std::size_t>(100, unknown.size()); ++i) {
        f.message += ' ' + unknown[i]->name;
        f.entities.push_back({"array", unknown[i]->name});
    }
    findings.push_back(std::move(f));
}

}  // namespace

Result<Dataset> read_bgrdecl(const Input& input, const ReadOptions& options) {
    const auto file = find_arrays(input, options.monitor);
    if (!file) return file.why();
    Dataset data;
    data.format = "eclipse";
    data.variant = file->formatted ? "formatted GRDECL" : "binary GRDECL";
    GridParts parts;
    parts.grid.info.name = stem_of(input);
    std::vector<const Array*> later;
    for (const Array& array : file->arrays) {
        if (options.monitor != nullptr && options.monitor->stopped())
            return failure(FailureKind::cancelled, "F022", {input.name()}, "stopped");
        if (array.name == "SPECGRID") {
            if (auto done = take_spec(*file, array, parts); !done) return done.why();
            continue;
        }
        const auto taken = take_grid_array(*file, array, parts);
        if (!taken) return taken.why();
        if (!*taken) later.push_back(&array);
    }
    for (const Array* array : later) {
        if (array->name != "COORDSYS" || parts.dims == nullptr) continue;
        if (auto done = take_coordinate_systems(*file, *array, parts); !done) return done.why();
    }
    const bool bare = parts.pillars == nullptr && parts.depths == nullptr && !later.empty();
    if (bare && parts.dims == nullptr) {
        if (auto done = take_dims_option(*file, options, parts); !done) return done.why();
    }
    auto grid = bare ? bare_grid(*file, std::move(parts)) : finish_grid(*file, std::move(parts), data.findings);
    if (!grid) return grid.why();
    CellOrder order;
    order.cells = grid->cell_count();
    order.all_active = true;
    std::vector<const Array*> unknown;
    for (const Array* array : later) {
        if (array->name == "COORDSYS") continue;
        if (fits_cells(*array, order)) {
            if (auto done = take_cell_array(*file, *array, order, array->name, *grid, data.findings); !done) return done.why();
            continue;
        }
        if (is_cell_property(array->name) || (bare && may_be_property(*array))) return wrong_cell_count(*file, *array, order);
        auto kept = kept_array(*file, *array, deck_key);
        if (!kept) return kept.why();
        grid->info.annotations.push_back(std::move(*kept));
        unknown.push_back(array);
    }
    tell_unknown(*file, unknown, data.findings);
    data.objects.emplace_back(std::move(*grid));
    return data;
}

}  // namespace geomend::eclipse
