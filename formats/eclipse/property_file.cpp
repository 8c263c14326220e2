// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/eclipse/property_file.h"

#include <algorithm>

#include "base/wording.h"
#include "formats/eclipse/grid_arrays.h"
#include "formats/eclipse/read_egrid.h"

namespace geomend::eclipse {

namespace {

using Porosity = CornerPointGrid::Porosity;

// Places in INTEHEAD and LOGIHEAD, from 0.
constexpr std::size_t unit_item = 2, dims_item = 8, active_item = 11, day_item = 64, month_item = 65, year_item = 66, dual_item = 14;

std::string dims_text(const std::array<std::int32_t, 3>& d) {
    return std::to_string(d[0]) + " x " + std::to_string(d[1]) + " x " + std::to_string(d[2]);
}

/// Whether a grid is the one that a head speaks of.
std::string misfit_with(const CornerPointGrid& grid, const PropertyHead& head) {
    const bool dual = grid.porosity != Porosity::single;
    const std::array<std::int32_t, 3> dims = {static_cast<std::int32_t>(grid.dims[0]), static_cast<std::int32_t>(grid.dims[1]),
                                              static_cast<std::int32_t>(grid.dims[2] * (dual ? 2 : 1))};
    if (dims != head.dims) return "it has " + dims_text(dims) + " cells, the file speaks of " + dims_text(head.dims);
    if (head.active < 0) return {};
    std::size_t active = 0;
    for (std::size_t c = 0; c < grid.cell_count(); ++c) {
        const unsigned state = grid.activity.empty() ? (dual ? 3u : 1u) : grid.activity[c];
        active += dual ? (state & 1u) + (state >> 1 & 1u) : state != 0;
    }
    if (static_cast<std::int64_t>(active) == head.active) return {};
    return "it has " + std::to_string(active) + " active cells, the file speaks of " + std::to_string(head.active);
}

/// Names of grid files, the first that is there counts.
std::optional<std::string> companion_name(const Input& input, bool formatted) {
    const std::string stem = stem_of(input);
    if (stem.empty()) return std::nullopt;
    std::vector<std::string> endings = {"EGRID", "FEGRID", "GRID", "FGRID", "egrid", "fegrid", "grid", "fgrid"};
    if (formatted) std::swap(endings[0], endings[1]);
    for (const std::string& ending : endings) {
        std::string name = stem + "." + ending;
        if (input.has_companion(name)) return name;
    }
    return std::nullopt;
}

bool has_pores(double volume) { return volume > 0; }

/// Activity from pore volumes: of both porosities where there are two.
Result<void> activity_from_volumes(const ArrayFile& file, const Array& array, bool dual, CornerPointGrid& grid) {
    const auto volumes = reals(file, array);
    if (!volumes) return volumes.why();
    const std::size_t cells = grid.cell_count();
    grid.activity.assign(cells, 0);
    for (std::size_t c = 0; c < cells; ++c) {
        if ((*volumes)[c] > 0) grid.activity[c] |= 1u;
        if (dual && (*volumes)[cells + c] > 0) grid.activity[c] |= 2u;
    }
    return {};
}

}  // namespace

bool is_no_cell_array(std::string_view name) {
    constexpr std::string_view names[] = {"INTEHEAD", "LOGIHEAD", "DOUBHEAD", "TABDIMS",  "TAB",      "CON",      "TRANNNC",
                                          "TRANGL",   "TRANLL",   "LGR",      "LGRHEADI", "LGRHEADQ", "LGRHEADD", "LGRNAMES",
                                          "LGRJOIN",  "LGRSGONE", "STARTSOL", "ENDSOL",   "SEQNUM",   "ENDLGR",   "NNC1",
                                          "NNC2",     "NNCHEAD",  "FIPFAMNA", "REGDIMS"};
    return std::ranges::find(names, name) != std::end(names);
}

std::string unit_system_name(std::int32_t unit) {
    constexpr const char* names[] = {"METRIC", "FIELD", "LAB", "PVT-M"};
    return unit >= 1 && unit <= 4 ? names[unit - 1] : "";
}

const Array* find_array(const ArrayFile& file, const PropertyPart& part, std::string_view name) {
    for (std::size_t i = part.first; i < part.last; ++i) {
        if (file.arrays[i].name == name) return &file.arrays[i];
    }
    return nullptr;
}

Result<std::vector<PropertyPart>> property_parts(const ArrayFile& file, std::size_t first, std::size_t last) {
    std::vector<PropertyPart> parts{{"", first, last}};
    for (std::size_t i = first; i < last; ++i) {
        const Array& array = file.arrays[i];
        if ((array.name == "LGRSGONE" || array.name == "ENDLGR") && !parts.back().grid.empty()) {  // the main grid again
            parts.back().last = i + 1;
            parts.push_back({"", i + 1, last});
            continue;
        }
        if (array.name != "LGR" || array.type != ArrayType::text) continue;
        const auto words = texts(file, array);
        if (!words) return words.why();
        if (words->empty() || words->front().empty())
            return unreadable("F012", place_of(file, array), "expected the name of a local grid, found none");
        parts.back().last = i;
        parts.push_back({words->front(), i, last});
    }
    std::erase_if(parts, [](const PropertyPart& p) { return p.first == p.last; });
    return parts;
}

Result<std::optional<PropertyHead>> property_head(const ArrayFile& file, const PropertyPart& part) {
    const Array* array = find_array(file, part, "INTEHEAD");
    if (array == nullptr) return std::optional<PropertyHead>{};
    const auto ints = integers(file, *array);
    if (!ints) return ints.why();
    if (ints->size() <= active_item)
        return unreadable("F008", place_of(file, *array), "expected 12 values of INTEHEAD or more, found " + std::to_string(ints->size()));
    PropertyHead head;
    std::copy_n(ints->begin() + dims_item, 3, head.dims.begin());
    head.active = ints->at(active_item);
    head.unit = ints->at(unit_item);
    if (ints->size() > year_item) head.date = {ints->at(year_item), ints->at(month_item), ints->at(day_item)};
    if (const Array* logicals_array = find_array(file, part, "LOGIHEAD")) {
        const auto flags = logicals(file, *logicals_array);
        if (!flags) return flags.why();
        head.dual = flags->size() > dual_item && flags->at(dual_item) != 0;
    }
    return std::optional<PropertyHead>{head};
}

Result<void> PropertyGrids::find_companion(const std::vector<PropertyPart>& parts) {
    const auto name = companion_name(file_.input, file_.formatted);
    if (!name) return {};
    const auto unused = [&](const std::string& why) {
        findings.push_back(make_finding("F133", "the grid '" + *name + "' is not used: " + why, {file_.input.name()}));
    };
    const auto input = file_.input.neighbour(*name);
    if (!input) {
        unused(input.why().error.message);
        return {};
    }
    const auto first = first_array(input->bytes().substr(0, 4096));
    auto read = first && first->name == "FILEHEAD" ? read_egrid(*input, options_) : read_old_grid(*input, options_);
    if (!read) {
        if (read.why().kind == FailureKind::cancelled) return read.why();
        unused(to_string(read.why().error.where) + ": " + read.why().error.message);
        return {};
    }
    std::vector<CornerPointGrid> found;
    for (Object& object : read->objects) {
        if (auto* grid = std::get_if<CornerPointGrid>(&object)) found.push_back(std::move(*grid));
    }
    for (const PropertyPart& part : parts) {
        const auto head = property_head(file_, part);
        if (!head) return head.why();
        if (!*head) continue;
        const auto grid = std::ranges::find_if(
            found, [&](const CornerPointGrid& g) { return part.grid.empty() ? !g.host.has_value() : g.info.name == part.grid; });
        if (grid != found.end()) {
            if (auto done = take_pores_as_activity(part, **head, *grid); !done) return done;
        }
        const std::string why = grid == found.end() ? "it has no grid '" + part.grid + "'" : misfit_with(*grid, **head);
        if (!why.empty()) {
            unused(why);
            return {};
        }
    }
    grids = std::move(found);
    findings.insert(findings.end(), read->findings.begin(), read->findings.end());
    annotations = std::move(read->annotations);
    losses = std::move(read->losses);
    return {};
}

/// INTERSECT writes ACTNUM before it removes cells: those with pore volume are left. Nothing where that does not give
/// as many cells as the head says.
Result<void> PropertyGrids::take_pores_as_activity(const PropertyPart& part, const PropertyHead& head, CornerPointGrid& grid) {
    if (head.active < 0 || misfit_with(grid, head).find("active") == std::string::npos) return {};
    const auto take = [&](const ArrayFile& file, const PropertyPart& from) -> Result<bool> {
        const bool dual = grid.porosity != Porosity::single;
        const Array* volumes = find_array(file, from, "PORV");
        if (volumes == nullptr || volumes->count != grid.cell_count() * (dual ? 2 : 1)) return false;
        const auto values = reals(file, *volumes);
        if (!values) return values.why();
        if (std::ranges::count_if(*values, has_pores) != head.active) return false;
        for (std::size_t c = 0; c < grid.cell_count() && !dual; ++c) {
            if (has_pores((*values)[c]) && !grid.is_active(c)) return false;
        }
        const std::size_t before = active_count(grid);
        if (auto done = activity_from_volumes(file, *volumes, dual, grid); !done) return done.why();
        const std::size_t idle = before - active_count(grid);
        findings.push_back(make_finding(
            "F134",
            counted(idle, "cell is", "cells are") + " active in the grid file, but without pore volume and values here: taken as inactive",
            {file_.input.name()}, idle));
        return true;
    };
    const auto own = take(file_, part);
    if (!own) return own.why();
    if (*own) return {};
    for (const char* ending : {".INIT", ".FINIT", ".init", ".finit"}) {
        const std::string name = stem_of(file_.input) + ending;
        if (!file_.input.has_companion(name)) continue;
        const auto input = file_.input.neighbour(name);
        const auto file = input ? find_arrays(*input, options_.monitor) : Result<ArrayFile>(input.why());
        const auto parts = file ? property_parts(*file, 0, file->arrays.size()) : Result<std::vector<PropertyPart>>(file.why());
        if (!parts) return {};  // a file that cannot be read helps nobody; what is wrong with it is told where it is asked for
        for (const PropertyPart& other : *parts) {
            if (other.grid != part.grid) continue;
            const auto taken = take(*file, other);
            if (!taken || *taken) return {};
        }
    }
    return {};
}

Result<void> PropertyGrids::make_grid(const PropertyPart& part, const PropertyHead& head, CornerPointGrid& grid) const {
    const Location where = place_of(file_, *find_array(file_, part, "INTEHEAD"));
    GridParts sized;
    const std::int32_t nz = head.dual ? head.dims[2] / 2 : head.dims[2];
    if (auto done = set_dims(file_, *find_array(file_, part, "INTEHEAD"), head.dims[0], head.dims[1], nz, sized); !done) return done;
    grid.dims = sized.grid.dims;
    if (head.dual) grid.porosity = Porosity::dual_porosity;
    const std::size_t cells = grid.cell_count(), total = cells * (head.dual ? 2 : 1);
    if (head.active == static_cast<std::int64_t>(total)) {
        if (head.dual) grid.activity.assign(cells, 3);
        return {};
    }
    const Array* actnum = find_array(file_, part, "ACTNUM");
    const Array* volumes = find_array(file_, part, "PORV");
    if (actnum != nullptr && actnum->count == cells && actnum->type == ArrayType::integer) {
        const auto values = integers(file_, *actnum);
        if (!values) return values.why();
        grid.activity.resize(cells);
        for (std::size_t c = 0; c < cells; ++c) grid.activity[c] = static_cast<std::uint8_t>((*values)[c] & 3);
    } else if (volumes != nullptr && volumes->count == total) {
        if (auto done = activity_from_volumes(file_, *volumes, head.dual, grid); !done) return done;
    } else {
        return unreadable(
            "F010", where,
            "the file does not say which cells are active: the grid file (" + stem_of(file_.input) + ".EGRID) has to stand beside it");
    }
    if (const std::string why = misfit_with(grid, head); !why.empty() && head.active >= 0) {
        return unreadable("F010", where,
                          "which cells are active is not certain from pore volumes (" + why + "): the grid file (" + stem_of(file_.input) +
                              ".EGRID) has to stand beside it");
    }
    return {};
}

Result<PropertyGrids::Place> PropertyGrids::grid_of(const PropertyPart& part) {
    const auto head = property_head(file_, part);
    if (!head) return head.why();
    const auto known = std::ranges::find_if(
        grids, [&](const CornerPointGrid& g) { return part.grid.empty() ? !g.host.has_value() : g.info.name == part.grid; });
    if (known != grids.end()) {
        if (*head && known->unit_system.empty()) known->unit_system = unit_system_name((*head)->unit);
        Place place{static_cast<std::size_t>(known - grids.begin()), cell_order(*known)};
        if (*head) {
            const std::string why = misfit_with(*known, **head);
            if (!why.empty())
                return unreadable("F008", place_of(file_, *find_array(file_, part, "INTEHEAD")), "this part does not fit the grid: " + why);
        }
        return place;
    }
    if (!*head) {
        return unreadable(
            "F012", {file_.input.name()},
            "expected INTEHEAD, which has the numbers of cells" + (part.grid.empty() ? "" : " of '" + part.grid + "'") + ", found none");
    }
    CornerPointGrid grid;
    grid.info.name = part.grid.empty() ? stem_of(file_.input) : part.grid;
    if (!part.grid.empty()) grid.host = CornerPointGrid::Host{};
    grid.unit_system = unit_system_name((*head)->unit);
    grid.info.precision = CoordinatePrecision::single_precision;
    grid.info.crs.z_positive = ZPositive::depth;
    grid.info.crs.z_positive_stated = true;
    if (auto done = make_grid(part, **head, grid); !done) return done.why();
    grids.push_back(std::move(grid));
    return Place{grids.size() - 1, cell_order(grids.back())};
}

}  // namespace geomend::eclipse
