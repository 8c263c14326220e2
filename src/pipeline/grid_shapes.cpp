// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include "base/number_text.h"
#include "base/parallel.h"
#include "geometry/measures.h"
#include "grid/boundary_model.h"
#include "grid/cell_geometry.h"
#include "grid/cell_mesh.h"
#include "pipeline/grids.h"
#include "pipeline/merge.h"

// Corner-point grids as cells of a mesh, and as boundary representation.

namespace geomend {

namespace {

Failure usage(const std::string& message) { return failure(FailureKind::usage, "F018", {}, message); }

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

// The sides of radial cells are arcs; straight ones between the same pillars hold less.
void lose_round_sides(const CornerPointGrid& grid, std::span<const double> volumes, const CellMesh& mesh, std::vector<Loss>& losses) {
    if (!grid.cylindrical) return;
    double round = 0, straight = 0;
    for (std::size_t c = 0; c < volumes.size(); ++c) round += grid.is_active(c) ? std::abs(volumes[c]) : 0;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) straight += std::abs(cell_volume(mesh, c));
    if (std::abs(round - straight) <= 1e-6 * round) return;
    lose(losses, LossClass::substance, grid, "volume of radial cells: " + number_text(round) + " becomes " + number_text(straight),
         "their sides are arcs, and those of the cells written are straight between the same pillars");
}

// Where pillars are pinched so that faces warp, cells with fewer corners have not quite the volume of the grid's cell.
void lose_pinched_volume(const CornerPointGrid& grid, const grid::Cells& cells, std::vector<Loss>& losses) {
    double own = 0, written = 0;
    std::uint64_t count = 0;
    for (std::size_t c = 0; c < cells.source.size(); ++c) {
        if (cells.mesh.types[c] == CellType::hexahedron) continue;
        const auto [i, j, k] = grid.ijk(cells.source[c]);
        const double before = std::abs(grid::cell_volume(grid, i, j, k)), after = std::abs(cell_volume(cells.mesh, c));
        if (std::abs(before - after) <= 1e-6 * std::max(before, after)) continue;
        own += before;
        written += after;
        ++count;
    }
    if (count == 0) return;
    lose(losses, LossClass::identity, grid,
         "volume of pinched cells with warped faces: " + number_text(own) + " becomes " + number_text(written),
         "wedges, pyramids, tetrahedra and polyhedra stand for them, whose faces between the same corners are others", count);
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
void tell_volumes(const std::string& grid_name, std::span<const double> trilinear, const grid::Cells& cells, std::string_view region_name,
                  std::vector<Finding>& findings) {
    const Attribute* regions =
        region_name.empty() ? nullptr : find_attribute(cells.mesh.info.attributes, std::string(region_name), AttributeLocation::cell);
    std::vector<double> polyhedra(cells.source.size());
    parallel_blocks(polyhedra.size(), 4096, [&](std::size_t first, std::size_t last) {
        for (std::size_t c = first; c < last; ++c) polyhedra[c] = cell_volume(cells.mesh, c);
    });
    std::map<double, std::array<double, 2>> sums;
    for (std::size_t c = 0; c < cells.source.size(); ++c) {
        auto& sum = sums[regions == nullptr ? 0.0 : value_as_double(*regions, c)];
        sum[0] += std::abs(polyhedra[c]);
        sum[1] += std::abs(trilinear[cells.source[c]]);
    }
    for (const auto& [region, sum] : sums) {
        Finding told = make_finding("F152", {}, {}, 0);
        told.entities.push_back(regions == nullptr ? EntityRef{"grid", grid_name, -1}
                                                   : EntityRef{"region", std::string(region_name) + "_" + number_text(region), -1});
        told.measures = {{"volume_polyhedra", sum[0]}, {"volume_trilinear", sum[1]}, {"difference", sum[0] - sum[1]}};
        told.message = (regions == nullptr ? "all cells" : std::string(region_name) + " " + number_text(region)) + ": the polyhedra hold " +
                       number_text(sum[0]) + ", the trilinear cells " + number_text(sum[1]) + " (difference " +
                       number_text(sum[0] - sum[1]) + ")";
        findings.push_back(std::move(told));
    }
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
    const auto request = model_request(options);
    if (!request) return request.why();
    std::vector<CornerPointGrid> grids;
    for (Object& object : dataset.objects) {
        if (auto* grid = std::get_if<CornerPointGrid>(&object)) grids.push_back(std::move(*grid));
    }
    if (grids.empty()) return {};
    std::erase_if(dataset.objects, [](const Object& o) { return std::holds_alternative<CornerPointGrid>(o); });
    for (const CornerPointGrid& grid : grids) {
        if (grid.cylindrical) lose_round_sides(grid, grid::cell_volumes(grid), grid::plain_cells(grid).mesh, dataset.losses);
        auto model = grid::boundary_model(grid, *request);
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

Result<grid::ModelRequest> model_request(const FormatOptions& options) {
    auto horizons = layers(option_value(options, "horizons"));
    if (!horizons) return std::move(horizons).why();
    return grid::ModelRequest{std::string(option_value(options, "regions")), std::move(*horizons)};
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
        auto* grid = std::get_if<CornerPointGrid>(&object);
        if (grid == nullptr) continue;
        const bool conformal = faces == "conformal";
        const std::vector<double> volumes = conformal || grid->cylindrical ? grid::cell_volumes(*grid) : std::vector<double>();
        grid::Cells cells = conformal ? grid::take_conforming_cells(*grid) : grid::plain_cells(*grid);
        list_losses(*grid, cells, dataset.losses);
        lose_round_sides(*grid, volumes, cells.mesh, dataset.losses);
        if (!conformal && !grid->cylindrical) lose_pinched_volume(*grid, cells, dataset.losses);
        if (conformal) tell_volumes(grid->info.name, volumes, cells, regions, dataset.findings);
        if (!regions.empty()) {
            if (auto grouped = group_by(std::string(regions), *grid, cells.mesh); !grouped) return grouped;
        }
        object = std::move(cells.mesh);
    }
    return {};
}

}  // namespace geomend
