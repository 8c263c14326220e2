// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/grids.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include "base/number_text.h"
#include "geometry/measures.h"
#include "grid/boundary_model.h"
#include "grid/cell_geometry.h"
#include "grid/cell_mesh.h"
#include "grid/from_cells.h"
#include "grid/map_axes.h"
#include "grid/quality.h"
#include "grid/transmissibility.h"
#include "pipeline/merge.h"

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
    std::ranges::move(bare.region_multipliers, std::back_inserter(to.region_multipliers));
    if (to.unit_system.empty()) to.unit_system = bare.unit_system;
    if (bare.least_pore_volume) to.least_pore_volume = bare.least_pore_volume;
    if (bare.pinch) to.pinch = bare.pinch;
}

CornerPointGrid* grid_like(std::vector<Object>& objects, const CornerPointGrid& bare) {
    for (Object& object : objects) {
        auto* grid = std::get_if<CornerPointGrid>(&object);
        if (grid != nullptr && !is_bare(*grid) && grid->dims == bare.dims) return grid;
    }
    return nullptr;
}

// Attributes TRANX, TRANY, TRANZ.
void set_attribute(CornerPointGrid& grid, const char* name, std::vector<double> values) {
    std::erase_if(grid.info.attributes, [&](const Attribute& a) { return a.name == name && a.location == AttributeLocation::cell; });
    Attribute a;
    a.name = name;
    a.location = AttributeLocation::cell;
    a.values = std::move(values);
    grid.info.attributes.push_back(std::move(a));
}

void add_connection(CornerPointGrid& grid, std::map<std::pair<std::uint64_t, std::uint64_t>, std::size_t>& known, std::uint64_t a,
                    std::uint64_t b, std::optional<double> value) {
    const auto [at, fresh] = known.try_emplace(std::minmax(a, b), grid.connections.size());
    if (fresh) {
        grid.connections.push_back({a, b, value});
    } else if (value) {
        auto& stated = grid.connections[at->second].transmissibility;
        stated = stated.value_or(0) + *value;
    }
}

// Cells that simulators leave out for their pore volume.
void tell_left_out(const CornerPointGrid& grid, const grid::SimulatedCells& cells, std::vector<Finding>& findings) {
    const std::size_t count = cells.without_pores.size() + cells.below_minpv.size();
    if (count == 0) return;
    Finding told;
    told.code = "F153";
    told.severity = Severity::info;
    told.count = count;
    told.element_kind = "cell";
    for (const auto* list : {&cells.without_pores, &cells.below_minpv}) {
        for (std::size_t n = 0; n < list->size() && told.index.size() < 100; ++n)
            told.index.push_back(static_cast<std::int64_t>((*list)[n]));
    }
    const auto [i, j, k] = grid.ijk(static_cast<std::size_t>(told.index.front()));
    told.message = std::to_string(cells.without_pores.size()) + " active cells without pore volume and " +
                   std::to_string(cells.below_minpv.size()) + " below MINPV take no part, as in simulators (the first is (" +
                   std::to_string(i + 1) + "," + std::to_string(j + 1) + "," + std::to_string(k + 1) + ")); " +
                   std::to_string(cells.bridges.size()) + " pairs are joined past them";
    told.entities.push_back({"grid", grid.info.name, -1});
    findings.push_back(std::move(told));
}

Result<void> compute_connections(CornerPointGrid& grid, std::vector<Finding>& findings) {
    constexpr double negligible = 1e-6;
    grid::SimulatedCells cells = grid::simulated_cells(grid);
    tell_left_out(grid, cells, findings);
    const grid::Connections found = grid::connections(grid, std::move(cells));
    std::map<std::pair<std::uint64_t, std::uint64_t>, std::size_t> known;
    for (std::size_t c = 0; c < grid.connections.size(); ++c)
        known.try_emplace(std::minmax(grid.connections[c].first, grid.connections[c].second), c);
    const bool permeable = find_attribute(grid.info.attributes, "PERMX", AttributeLocation::cell) != nullptr;
    if (!permeable) {
        for (const auto& pair : found.others) add_connection(grid, known, pair.first, pair.second, std::nullopt);
        return {};
    }
    auto values = grid::transmissibilities(grid, found);
    if (!values) return std::move(values).why();
    std::uint64_t left_out = 0;
    for (std::size_t c = 0; c < found.others.size(); ++c) {
        if (values->others[c] < negligible) ++left_out;
        else add_connection(grid, known, found.others[c].first, found.others[c].second, values->others[c]);
    }
    set_attribute(grid, "TRANX", std::move(values->x));
    set_attribute(grid, "TRANY", std::move(values->y));
    set_attribute(grid, "TRANZ", std::move(values->z));
    if (left_out == 0) return {};
    Finding told;
    told.code = "F151";
    told.severity = Severity::info;
    told.count = left_out;
    told.message = std::to_string(left_out) + " of " + std::to_string(found.others.size()) +
                   " pairs of cells that touch across layers have a transmissibility below 1e-6: no connection is listed for them";
    told.entities.push_back({"grid", grid.info.name, -1});
    findings.push_back(std::move(told));
    return {};
}

void lose(std::vector<Loss>& losses, LossClass c, const CornerPointGrid& grid, std::string what, std::string why, std::uint64_t count = 1) {
    add_loss(losses, {c, grid.info.name, std::move(what), std::move(why), count});
}

// What a mesh of cells does not say of a grid.
void list_losses(const CornerPointGrid& grid, const grid::Cells& cells, std::vector<Loss>& losses) {
    const std::uint64_t inactive = grid.cell_count() - active_count(grid);
    if (inactive > 0) lose(losses, LossClass::identity, grid, "inactive cells", "a mesh holds active cells", inactive);
    if (!cells.collapsed.empty())
        lose(losses, LossClass::identity, grid, "active cells without thickness", "they have no volume and no face",
             cells.collapsed.size());
    if (cells.unmatched_columns > 0)
        lose(losses, LossClass::identity, grid, "the fit of faces between columns",
             "cells overlap or are folded there: see 'geomend validate'", cells.unmatched_columns);
    if (!grid.faults.empty())
        lose(losses, LossClass::substance, grid, "faults", "a mesh of cells has no faces with names", grid.faults.size());
    if (!grid.connections.empty())
        lose(losses, LossClass::substance, grid, "stated connections", "a mesh of cells has none", grid.connections.size());
    if (!grid.links.empty())
        lose(losses, LossClass::substance, grid, "connections with other grids", "a mesh of cells has none", grid.links.size());
    if (grid.map_axes && !grid.map_relative)
        lose(losses, LossClass::identity, grid, "map axes", "the mesh is in the grid's own axes (--option map=apply moves it)");
    if (grid.pinch || grid.least_pore_volume || !grid.region_multipliers.empty())
        lose(losses, LossClass::identity, grid, "rules for simulators (PINCH, MINPV, MULTREGT)", "a mesh has no place for them");
    std::uint64_t pillars = 0;
    for (const Attribute& a : grid.info.attributes) pillars += a.location == AttributeLocation::pillar;
    if (pillars > 0) lose(losses, LossClass::substance, grid, "attributes of pillars", "a mesh has no pillars", pillars);
}

// Cells with the same value of an attribute become an entity of that name.
Result<void> group_by(const std::string& name, const CornerPointGrid& grid, CellMesh& mesh) {
    const Attribute* values = find_attribute(mesh.info.attributes, name, AttributeLocation::cell);
    if (values == nullptr) return usage("--option regions=" + name + ": grid '" + grid.info.name + "' has no such attribute of cells");
    std::set<double> kinds;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) kinds.insert(value_as_double(*values, c));
    if (kinds.size() > 100000)
        return usage("--option regions=" + name + ": " + std::to_string(kinds.size()) + " different values do not make regions");
    std::map<double, std::uint32_t> entity;
    for (const double kind : kinds) {
        entity[kind] = static_cast<std::uint32_t>(mesh.entities.size());
        CellMesh::Entity e;
        e.dimension = 3;
        e.tag = static_cast<std::int64_t>(mesh.entities.size() + 1);
        e.name = name + "_" + number_text(kind);
        mesh.entities.push_back(std::move(e));
    }
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) mesh.cell_entity.push_back(entity[value_as_double(*values, c)]);
    return {};
}

// Volumes of conformal cells follow triangles, those of the grid bilinear faces: the difference per region is told.
void tell_volumes(const CornerPointGrid& grid, const grid::Cells& cells, std::string_view region_name, std::vector<Finding>& findings) {
    const Attribute* regions =
        region_name.empty() ? nullptr : find_attribute(cells.mesh.info.attributes, std::string(region_name), AttributeLocation::cell);
    std::map<double, std::array<double, 2>> sums;
    for (std::size_t c = 0; c < cells.source.size(); ++c) {
        const auto [i, j, k] = grid.ijk(cells.source[c]);
        auto& sum = sums[regions == nullptr ? 0.0 : value_as_double(*regions, c)];
        sum[0] += std::abs(cell_volume(cells.mesh, c));
        sum[1] += std::abs(grid::cell_volume(grid, i, j, k));
    }
    for (const auto& [region, sum] : sums) {
        Finding told;
        told.code = "F152";
        told.severity = Severity::info;
        told.entities.push_back(regions == nullptr ? EntityRef{"grid", grid.info.name, -1}
                                                   : EntityRef{"region", std::string(region_name) + "_" + number_text(region), -1});
        told.measures = {{"volume_polyhedra", sum[0]}, {"volume_trilinear", sum[1]}, {"difference", sum[0] - sum[1]}};
        told.message = (regions == nullptr ? "all cells" : std::string(region_name) + " " + number_text(region)) + ": the polyhedra hold " +
                       number_text(sum[0]) + ", the trilinear cells " + number_text(sum[1]) + " (difference " +
                       number_text(sum[0] - sum[1]) + ")";
        findings.push_back(std::move(told));
    }
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

Result<std::vector<std::uint32_t>> layers(std::string_view text) {
    std::vector<std::uint32_t> numbers;
    while (!text.empty()) {
        const std::size_t comma = std::min(text.find(','), text.size());
        std::uint32_t n = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + comma, n);
        if (error != std::errc() || end != text.data() + comma)
            return usage("--option horizons=" + std::string(text) + ": expected layers such as 3,7");
        numbers.push_back(n);
        text.remove_prefix(std::min(comma + 1, text.size()));
    }
    std::ranges::sort(numbers);
    return numbers;
}

Result<void> to_boundary_models(Dataset& dataset, const FormatOptions& options) {
    auto horizons = layers(option_value(options, "horizons"));
    if (!horizons) return std::move(horizons).why();
    const grid::ModelRequest request{std::string(option_value(options, "regions")), *horizons};
    std::vector<CornerPointGrid> grids;
    for (Object& object : dataset.objects) {
        if (auto* grid = std::get_if<CornerPointGrid>(&object)) grids.push_back(std::move(*grid));
    }
    if (grids.empty()) return {};
    std::erase_if(dataset.objects, [](const Object& o) { return std::holds_alternative<CornerPointGrid>(o); });
    for (const CornerPointGrid& grid : grids) {
        auto model = grid::boundary_model(grid, request);
        if (!model) return std::move(model).why();
        lose(dataset.losses, LossClass::substance, grid, "cells", "a boundary representation holds surfaces and regions",
             active_count(grid));
        if (!grid.info.attributes.empty())
            lose(dataset.losses, LossClass::substance, grid, "attributes of cells", "a boundary representation holds no cells",
                 grid.info.attributes.size());
        merge(dataset, std::move(*model));
    }
    return {};
}

}  // namespace

Result<void> join_properties(Dataset& dataset) {
    std::vector<Object> kept;
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

Result<void> apply_grid_options(Dataset& dataset, const FormatOptions& options) {
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
        if (connections == "compute") {
            if (auto computed = compute_connections(*grid, dataset.findings); !computed) return computed;
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

Result<void> shape_grids(Dataset& dataset, const Format& target, const FormatOptions& options) {
    if (target.wants == WriterWants::corner_point) return {};
    const std::string_view as = option_value(options, "as");
    if (!as.empty() && as != "brep" && as != "cells") return usage("--option as=" + std::string(as) + ": expected brep or cells");
    if (as == "brep" || (as.empty() && target.wants == WriterWants::faced_model)) return to_boundary_models(dataset, options);
    const std::string_view faces = option_value(options, "faces"), regions = option_value(options, "regions");
    if (!faces.empty() && faces != "conformal" && faces != "plain")
        return usage("--option faces=" + std::string(faces) + ": expected plain or conformal");
    for (Object& object : dataset.objects) {
        const auto* grid = std::get_if<CornerPointGrid>(&object);
        if (grid == nullptr) continue;
        grid::Cells cells = faces == "conformal" ? grid::conforming_cells(*grid) : grid::plain_cells(*grid);
        list_losses(*grid, cells, dataset.losses);
        if (faces == "conformal") tell_volumes(*grid, cells, regions, dataset.findings);
        if (!regions.empty()) {
            if (auto grouped = group_by(std::string(regions), *grid, cells.mesh); !grouped) return grouped;
        }
        object = std::move(cells.mesh);
    }
    return {};
}

}  // namespace geomend
