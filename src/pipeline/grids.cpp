// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/grids.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>

#include "grid/connections.h"
#include "grid/from_cells.h"
#include "grid/map_axes.h"
#include "grid/quality.h"
#include "grid/simulated_cells.h"
#include "pipeline/grid_connections.h"

namespace geomend {

namespace {

bool is_bare(const CornerPointGrid& grid) { return grid.pillars.empty() && grid.depths.empty(); }

std::string dims_text(const std::array<std::uint32_t, 3>& d) {
    return std::to_string(d[0]) + " x " + std::to_string(d[1]) + " x " + std::to_string(d[2]);
}

Failure usage(const std::string& message) { return failure(FailureKind::usage, "F018", {}, message); }

// Later values of a property replace earlier ones of the same name.
void give(CornerPointGrid& bare, CornerPointGrid& to) {
    for (Attribute& a : bare.info.attributes) {
        std::erase_if(to.info.attributes, [&](const Attribute& old) { return old.name == a.name && old.location == a.location; });
        to.info.attributes.push_back(std::move(a));
    }
    if (to.activity.empty()) to.activity = std::move(bare.activity);
    std::ranges::move(bare.faults, std::back_inserter(to.faults));
    std::ranges::move(bare.connections, std::back_inserter(to.connections));
    std::ranges::move(bare.info.annotations, std::back_inserter(to.info.annotations));
    std::ranges::move(bare.edit_operations, std::back_inserter(to.edit_operations));
    std::ranges::move(bare.connection_factors, std::back_inserter(to.connection_factors));
    std::ranges::move(bare.region_multipliers, std::back_inserter(to.region_multipliers));
    if (to.unit_system.empty()) to.unit_system = bare.unit_system;
    if (bare.least_pore_volume) to.least_pore_volume = bare.least_pore_volume;
    if (bare.pinch) to.pinch = bare.pinch;
}

bool is_same_grid(const CornerPointGrid& a, const CornerPointGrid& b) {
    return a.dims == b.dims && a.host.has_value() == b.host.has_value() && a.pillars == b.pillars && a.depths == b.depths;
}

// INIT and restart files bring their grid along. Given beside it they belong to the one grid, which has the cells that
// are active in both.
void join_same_grids(std::vector<Object>& objects) {
    for (std::size_t n = 1; n < objects.size(); ++n) {
        auto* later = std::get_if<CornerPointGrid>(&objects[n]);
        if (later == nullptr || is_bare(*later)) continue;
        for (std::size_t m = 0; m < n; ++m) {
            auto* first = std::get_if<CornerPointGrid>(&objects[m]);
            if (first == nullptr || !is_same_grid(*first, *later)) continue;
            const bool apart = std::ranges::any_of(later->info.attributes, [&](const Attribute& a) {
                return find_attribute(first->info.attributes, a.name, a.location) != nullptr;
            });
            if (apart || (!first->faults.empty() && !later->faults.empty())) continue;
            if (!later->activity.empty() && active_count(*later) < active_count(*first)) first->activity = std::move(later->activity);
            if (first->connections.size() == later->connections.size()) first->connections.clear();  // they list the same
            give(*later, *first);
            objects.erase(objects.begin() + static_cast<std::ptrdiff_t>(n--));
            break;
        }
    }
}

CornerPointGrid* grid_like(std::vector<Object>& objects, const CornerPointGrid& bare) {
    for (Object& object : objects) {
        auto* grid = std::get_if<CornerPointGrid>(&object);
        if (grid != nullptr && !is_bare(*grid) && grid->dims == bare.dims) return grid;
    }
    return nullptr;
}

// Connections that whoever reads a deck makes of its geometry again.
void leave_to_simulators(CornerPointGrid& grid, bool asked, Dataset& dataset) {
    if (is_bare(grid)) return;
    std::uint64_t count = 0;
    if (dataset.format == "eclipse" && std::ranges::any_of(grid.connections, [](const auto& c) { return c.transmissibility > 0.0; })) {
        const grid::Connections found = grid::connections(grid, grid::simulated_cells(grid));
        std::set<std::pair<std::uint64_t, std::uint64_t>> own;
        for (const auto& pair : found.others) own.insert(std::minmax<std::uint64_t>(pair.first, pair.second));
        for (const auto& pair : found.bridges) own.insert(std::minmax<std::uint64_t>(pair[0], pair[1]));
        count = std::erase_if(grid.connections, [&](const auto& c) { return own.contains(std::minmax(c.first, c.second)); });
    }
    if (count == 0 && !asked) return;
    Finding told = make_finding("F155", {}, {}, std::max<std::uint64_t>(1, count));
    if (!asked) use_other_severity(told);
    told.message =
        "what reads a deck finds the connections of COORD and ZCORN itself and adds those of NNC to them: " +
        (count > 0 ? std::to_string(count) + " that are of the geometry are not written" : std::string("none are computed for it"));
    told.entities.push_back({"grid", grid.info.name, -1});
    dataset.findings.push_back(std::move(told));
}

// What stands on points and lines of a mesh has no place in a grid of cells.
void list_left(const Object& object, std::vector<Loss>& losses) {
    const ObjectInfo& info = info_of(object);
    for (const Attribute& a : info.attributes) {
        if (a.location != AttributeLocation::cell && a.location != AttributeLocation::object)
            add_loss(losses, {LossClass::substance, info.name, "attribute '" + a.name + "'",
                              std::string("a corner-point grid holds values of cells, not of ") + to_string(a.location) + "s", 1});
    }
    for (const NamedSet& set : info.sets)
        add_loss(losses, {LossClass::identity, info.name, "set '" + set.name + "'", "a corner-point grid has no sets", 1});
}

const CornerPointGrid* first_grid(const Dataset& dataset) {
    for (const Object& object : dataset.objects) {
        if (const auto* grid = std::get_if<CornerPointGrid>(&object); grid != nullptr && !is_bare(*grid)) return grid;
    }
    return nullptr;
}

Result<void> put_on_like(Dataset& dataset, const Dataset& like) {
    const CornerPointGrid* model = first_grid(like);
    if (model == nullptr) return usage("--like: the file holds no corner-point grid");
    CornerPointGrid grid = *model;
    grid.info.attributes.clear();
    bool any = false;
    for (const Object& object : dataset.objects) {
        const auto* mesh = std::get_if<CellMesh>(&object);
        if (mesh == nullptr) continue;
        if (auto put = grid::put_attributes(*mesh, grid); !put) return put;
        list_left(object, dataset.losses);
        any = true;
    }
    if (!any) return usage("--like: the inputs hold no mesh of cells whose values could go onto a grid");
    std::erase_if(dataset.objects, [](const Object& o) { return std::holds_alternative<CellMesh>(o); });
    dataset.objects.insert(dataset.objects.begin(), std::move(grid));
    dataset.models.clear();
    return {};
}

}  // namespace

Result<void> join_properties(Dataset& dataset) {
    join_same_grids(dataset.objects);
    for (Object& object : dataset.objects) {
        auto* bare = std::get_if<CornerPointGrid>(&object);
        if (bare == nullptr || !is_bare(*bare)) continue;
        CornerPointGrid* grid = grid_like(dataset.objects, *bare);
        if (grid == nullptr)
            return unreadable("F007", {},
                              "'" + bare->info.name + "' holds properties of a grid of " + dims_text(bare->dims) +
                                  " cells but no geometry: give the grid's own file (EGRID, GRDECL, ROFF) as a further input");
        give(*bare, *grid);
    }
    const auto first = std::stable_partition(dataset.objects.begin(), dataset.objects.end(), [](const Object& o) {
        const auto* grid = std::get_if<CornerPointGrid>(&o);
        return grid == nullptr || !is_bare(*grid);
    });
    dataset.objects.erase(first, dataset.objects.end());
    return {};
}

bool has_guessed_dims(const Dataset& dataset) {
    return std::ranges::any_of(dataset.findings, [](const Finding& f) { return f.code == "F141"; });
}

std::string dims_option_of(const Dataset& dataset) {
    const CornerPointGrid* grid = first_grid(dataset);
    if (grid == nullptr) return {};
    const std::uint32_t layers = grid->dims[2] * (grid->porosity == CornerPointGrid::Porosity::single ? 1 : 2);
    return std::to_string(grid->dims[0]) + "," + std::to_string(grid->dims[1]) + "," + std::to_string(layers);
}

Result<void> apply_grid_options(Dataset& dataset, const Format& target, const FormatOptions& options) {
    const std::string_view map = option_value(options, "map"), connections = option_value(options, "connections");
    if (!map.empty() && map != "apply" && map != "keep") return usage("--option map=" + std::string(map) + ": expected apply or keep");
    if (!connections.empty() && connections != "compute" && connections != "keep")
        return usage("--option connections=" + std::string(connections) + ": expected compute or keep");
    const std::string_view quality = option_value(options, "quality");
    if (!quality.empty() && quality != "add") return usage("--option quality=" + std::string(quality) + ": expected add");
    for (Object& object : dataset.objects) {
        auto* grid = std::get_if<CornerPointGrid>(&object);
        if (grid == nullptr) continue;
        if (quality == "add") {
            std::ranges::move(grid::quality_attributes(*grid), std::back_inserter(grid->info.attributes));
        }
        if (map == "apply") {
            if (auto moved = grid::apply_map_axes(*grid); !moved) return moved;
        }
        if (target.deck) {
            leave_to_simulators(*grid, connections == "compute", dataset);
        } else if (connections == "compute") {
            if (auto computed = compute_connections(*grid, dataset.format == "grdecl", dataset.findings); !computed) return computed;
        }
    }
    return {};
}

Result<void> make_grids(Dataset& dataset, const Format& target, const Dataset* like) {
    if (like != nullptr) return put_on_like(dataset, *like);
    if (target.wants != WriterWants::corner_point) return {};
    for (Object& object : dataset.objects) {
        std::optional<Result<CornerPointGrid>> made;
        if (const auto* lattice = std::get_if<StructuredGrid>(&object)) made = grid::from_structured(*lattice);
        if (const auto* mesh = std::get_if<CellMesh>(&object); mesh != nullptr && grid::has_places(*mesh))
            made = grid::from_tagged_cells(*mesh);
        if (!made) continue;
        if (!*made) return std::move(*made).why();
        list_left(object, dataset.losses);
        object = std::move(**made);
    }
    return {};
}

}  // namespace geomend
