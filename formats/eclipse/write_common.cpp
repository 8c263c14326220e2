// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/eclipse/write_common.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/number_text.h"
#include "formats/eclipse/kept_arrays.h"

namespace geomend::eclipse {

namespace {

using Porosity = CornerPointGrid::Porosity;

/// Half the precision of floats, about, is where rounding is more than a matter of identity.
constexpr double largest_harmless_shift = 1e-6;

double diagonal_of(const CornerPointGrid& grid) {
    Vec3 low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
    for (std::size_t i = 0; i + 2 < grid.pillars.size(); i += 3) {
        for (std::size_t d = 0; d < 3; ++d) {
            low[d] = std::min(low[d], grid.pillars[i + d]);
            high[d] = std::max(high[d], grid.pillars[i + d]);
        }
    }
    if (grid.pillars.empty()) return 0;
    return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

void add_rounding_loss(const Rounding& rounding, const CornerPointGrid& grid, std::string_view title, std::vector<Loss>& losses) {
    if (rounding.changed == 0) return;
    const bool harmless = rounding.largest <= largest_harmless_shift * diagonal_of(grid);
    const char* way_out =
        harmless ? "" : ": --option origin=local lets coordinates count from a round origin near the grid, which MAPAXES states";
    add_loss(losses, {harmless ? LossClass::identity : LossClass::substance, grid.info.name,
                      "coordinates rounded to single precision, by at most " + number_text(rounding.largest),
                      std::string(title) + " files store float32" + way_out, rounding.changed});
}

bool is_head(std::string_view name) { return name == "FILEHEAD" || name == "GRIDHEAD"; }

void add_annotation_losses(const CornerPointGrid& grid, const GridKept& kept, const std::string& why, std::vector<Loss>& losses) {
    std::uint64_t lines = 0;
    for (const Annotation& a : grid.info.annotations) {
        const bool array = a.key == array_key || a.key == init_key || a.key == deck_key;
        const std::string_view own = kept.title == "INIT" ? init_key : kept.title == "EGRID" ? array_key : deck_key;
        if (a.key == own) continue;
        if (array && !is_head(kept_name(a.value))) {
            add_loss(losses, {LossClass::identity, grid.info.name, "array '" + std::string(kept_name(a.value)) + "'", why});
        } else {
            ++lines;
        }
    }
    if (lines != 0) add_loss(losses, {LossClass::style, grid.info.name, "records of the source format", why, lines});
}

}  // namespace

Result<ChosenGrids> choose_grids(const Dataset& dataset, std::string_view title, bool with_local, bool with_geometry, const OutputSet& out,
                                 std::vector<Loss>& losses) {
    const auto cannot = [&](const std::string& message) {
        return failure(FailureKind::cannot_hold, "F021", {out.main_path().string()}, message);
    };
    ChosenGrids chosen;
    std::vector<const CornerPointGrid*> waiting;
    for (const Object& object : dataset.objects) {
        const auto* grid = std::get_if<CornerPointGrid>(&object);
        if (grid != nullptr && !grid->host && chosen.global == nullptr) {
            chosen.global = grid;
        } else if (grid != nullptr && grid->host && with_local) {
            waiting.push_back(grid);
        } else {
            const std::string why = std::string(title) + (grid != nullptr ? " files hold one grid" : " files hold corner-point grids only");
            add_loss(losses, {LossClass::substance, info_of(object).name, kind_name(object), why});
        }
    }
    if (chosen.global == nullptr) return cannot("there is no corner-point grid to write");
    const auto is_chosen = [&](const std::string& name) {
        return name.empty() || name == chosen.global->info.name ||
               std::ranges::any_of(chosen.local, [&](const CornerPointGrid* g) { return g->info.name == name; });
    };
    for (bool more = true; more;) {
        more = false;
        for (auto& grid : waiting) {
            if (grid == nullptr || !is_chosen(grid->host->grid)) continue;
            chosen.local.push_back(grid);
            grid = nullptr;
            more = true;
        }
    }
    for (const CornerPointGrid* grid : waiting) {
        if (grid != nullptr)
            add_loss(losses, {LossClass::substance, grid->info.name, "local grid", "the grid that it refines is not there"});
    }
    std::vector<const CornerPointGrid*> all{chosen.global};
    all.insert(all.end(), chosen.local.begin(), chosen.local.end());
    for (const CornerPointGrid* grid : all) {
        if (!with_geometry && grid->pillars.empty() && grid->depths.empty()) continue;
        if (const std::string why = misfit(*grid); !why.empty()) return cannot("grid '" + grid->info.name + "': " + why);
    }
    for (const StatedModel& model : dataset.models) {
        add_loss(losses, {LossClass::substance, model.name, "regions, contacts and layers", std::string(title) + " files hold no model"});
    }
    if (const std::size_t records = kept_records(dataset); records > 0) {
        add_loss(losses,
                 {LossClass::style, "", "records of the source format", std::string(title) + " files have no place for them", records});
    }
    return chosen;
}

void add_grid_losses(const CornerPointGrid& grid, const GridKept& kept, const OutputSet& out, std::vector<Loss>& losses) {
    const std::string why = std::string(kept.title) + " files have no place for it";
    const auto lost = [&](LossClass c, std::string what, std::uint64_t count = 1) {
        add_loss(losses, {c, grid.info.name, std::move(what), why, count});
    };
    const ObjectInfo& info = grid.info;
    if (!kept.name && !info.name.empty() && info.name != out.stem()) lost(LossClass::identity, "name");
    if (info.role != FeatureRole::unknown || !info.role_text.empty()) lost(LossClass::identity, "role");
    if (!info.feature.empty()) lost(LossClass::identity, "geological feature");
    if (!info.groups.empty()) lost(LossClass::identity, "groups");
    for (const NamedSet& set : info.sets) lost(LossClass::substance, "set '" + set.name + "'");
    if (!kept.attributes) {
        for (const Attribute& a : info.attributes) {
            if (!(kept.corsnum && a.name == "CORSNUM")) lost(LossClass::substance, "attribute '" + a.name + "'");
        }
    }
    const CoordinateSystem& crs = info.crs;
    if (!crs.name.empty() || !crs.projection.empty() || !crs.datum.empty()) lost(LossClass::identity, "coordinate system");
    if (!crs.annotations.empty()) lost(LossClass::style, "further lines of the coordinate system");
    if (!kept.map) {
        if (!crs.axis_units[0].empty()) lost(LossClass::identity, "unit of the axes");
        if (grid.map_axes || !grid.map_unit.empty()) lost(LossClass::identity, "map axes");
        if (!grid.orientation.empty()) lost(LossClass::style, "orientation");
    }
    if (!grid.unit_system.empty() && !kept.unit_system) lost(LossClass::identity, "unit system");
    for (const auto& fault : grid.faults) lost(LossClass::substance, "fault '" + fault.name + "'");
    if (grid.pinch) lost(LossClass::substance, "how thin layers are bridged (PINCH)");
    if (grid.least_pore_volume) lost(LossClass::substance, "least pore volume (MINPV)");
    if (!grid.region_multipliers.empty()) lost(LossClass::substance, "multipliers between regions", grid.region_multipliers.size());
    std::uint64_t values = 0, links = 0;
    for (const auto& c : grid.connections) values += c.transmissibility.has_value();
    for (const auto& link : grid.links) links += link.connections.size();
    if (!kept.connections && !grid.connections.empty() && !kept.transmissibilities)
        lost(LossClass::substance, "connections", grid.connections.size());
    if (!kept.connections && links != 0) lost(LossClass::substance, "connections between grids", links);
    if (kept.connections && !kept.transmissibilities && values != 0)
        lost(LossClass::substance, "transmissibilities of connections", values);
    if (!kept.porosity && grid.porosity != Porosity::single) lost(LossClass::substance, "second porosity");
    if (!kept.sets && grid.reservoirs.size() > 1) lost(LossClass::substance, "sets of coordinate lines", grid.reservoirs.size());
    add_annotation_losses(grid, kept, why, losses);
}

Result<void> write_geometry(ArrayWriter& writer, const CornerPointGrid& grid, std::string_view title, std::vector<Loss>& losses) {
    const bool turned = grid.info.crs.z_positive == ZPositive::elevation;
    Rounding rounding = writer.rounded("COORD", grid.pillars.size(), [&](std::uint64_t first, std::span<double> block) {
        std::copy_n(grid.pillars.data() + first, block.size(), block.data());
        for (std::size_t i = 0; turned && i < block.size(); ++i) {
            if ((first + i) % 3 == 2) block[i] = 0.0 - block[i];
        }
    });
    write_coordinate_systems(writer, grid);
    rounding.add(writer.rounded("ZCORN", grid.depths.size(), [&](std::uint64_t first, std::span<double> block) {
        std::copy_n(grid.depths.data() + first, block.size(), block.data());
        if (!turned) return;
        for (double& z : block) z = 0.0 - z;
    }));
    if (!std::isfinite(rounding.largest))
        return failure(FailureKind::cannot_hold, "F021", {grid.info.name},
                       "coordinates are beyond single precision, which " + std::string(title) + " files store");
    add_rounding_loss(rounding, grid, title, losses);
    return {};
}

void write_map(ArrayWriter& writer, const CornerPointGrid& grid, std::string_view title, std::vector<Loss>& losses) {
    if (!grid.map_unit.empty()) writer.texts("MAPUNITS", std::span(&grid.map_unit, 1));
    if (grid.map_axes) {
        const Rounding rounding = writer.rounded("MAPAXES", *grid.map_axes);
        if (rounding.changed != 0) {
            add_loss(losses, {LossClass::identity, grid.info.name,
                              "map axes rounded to single precision, by at most " + number_text(rounding.largest),
                              std::string(title) + " files store float32", rounding.changed});
        }
    }
    const auto& units = grid.info.crs.axis_units;
    if (!units[0].empty() || grid.map_relative) {
        const std::string words[] = {units[0], grid.map_relative ? "MAP" : ""};
        writer.texts("GRIDUNIT", words);
        if (units[1] != units[0] || units[2] != units[0])
            add_loss(losses, {LossClass::identity, grid.info.name, "units of y and z", "the file has one unit for all axes"});
    }
    if (!grid.orientation.empty()) writer.texts("GDORIENT", grid.orientation);
}

void write_coordinate_systems(ArrayWriter& writer, const CornerPointGrid& grid) {
    if (grid.reservoirs.empty()) return;
    std::vector<std::int32_t> values;
    for (const auto& r : grid.reservoirs) {
        values.insert(values.end(), {static_cast<std::int32_t>(r.first_layer + 1), static_cast<std::int32_t>(r.last_layer + 1),
                                     r.complete_circle ? 1 : 0, r.joined ? 1 : 0, 0, 0});
    }
    writer.integers("COORDSYS", values);
}

}  // namespace geomend::eclipse
