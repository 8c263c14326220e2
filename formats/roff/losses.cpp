// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/roff/losses.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/number_text.h"

namespace geomend::roff {

namespace {

constexpr double largest_harmless_shift = 1e-6;

}  // namespace

Result<const CornerPointGrid*> choose_grid(const Dataset& dataset, const OutputSet& out, std::vector<Loss>& losses) {
    const CornerPointGrid* chosen = nullptr;
    for (const Object& object : dataset.objects) {
        const auto* grid = std::get_if<CornerPointGrid>(&object);
        if (grid != nullptr && (chosen == nullptr || (chosen->host && !grid->host))) chosen = grid;
    }
    const auto cannot = [&](const std::string& message) {
        return failure(FailureKind::cannot_hold, "F021", {out.main_path().string()}, message);
    };
    if (chosen == nullptr) return cannot("there is no corner-point grid to write");
    for (const Object& object : dataset.objects) {
        const auto* grid = std::get_if<CornerPointGrid>(&object);
        if (grid == chosen) continue;
        add_loss(losses, {LossClass::substance, info_of(object).name, kind_name(object),
                          grid != nullptr ? "ROFF files hold one grid" : "ROFF files hold corner-point grids only"});
    }
    if (!(chosen->pillars.empty() && chosen->depths.empty())) {
        if (const std::string why = misfit(*chosen); !why.empty()) return cannot("grid '" + chosen->info.name + "': " + why);
    }
    if (chosen->reservoirs.size() > 1)
        return cannot("grid '" + chosen->info.name + "' has several sets of coordinate lines; ROFF grids have one");
    if (chosen->cylindrical) return cannot("grid '" + chosen->info.name + "' is radial; ROFF grids are not");
    for (const StatedModel& model : dataset.models) {
        add_loss(losses, {LossClass::substance, model.name, "regions, contacts and layers", "ROFF files hold no model"});
    }
    if (const std::size_t records = kept_records(dataset); records > 0) {
        add_loss(losses, {LossClass::style, "", "records of the source format", "ROFF files have no place for them", records});
    }
    return chosen;
}

void add_grid_losses(const CornerPointGrid& grid, const OutputSet& out, std::vector<Loss>& losses) {
    const std::string why = "ROFF files have no place for it";
    const auto lost = [&](LossClass c, std::string what, std::uint64_t count = 1) {
        add_loss(losses, {c, grid.info.name, std::move(what), why, count});
    };
    const ObjectInfo& info = grid.info;
    if (!info.name.empty() && info.name != out.stem()) lost(LossClass::identity, "name");
    if (info.role != FeatureRole::unknown || !info.role_text.empty()) lost(LossClass::identity, "role");
    if (!info.feature.empty()) lost(LossClass::identity, "geological feature");
    if (!info.groups.empty()) lost(LossClass::identity, "groups");
    for (const NamedSet& set : info.sets) lost(LossClass::substance, "set '" + set.name + "'");
    const CoordinateSystem& crs = info.crs;
    if (!crs.name.empty() || !crs.projection.empty() || !crs.datum.empty()) lost(LossClass::identity, "coordinate system");
    if (!crs.axis_units[0].empty()) lost(LossClass::identity, "unit of the axes");
    if (!crs.annotations.empty()) lost(LossClass::style, "further lines of the coordinate system");
    if (grid.map_axes || !grid.map_unit.empty()) lost(LossClass::identity, "map axes");
    if (!grid.orientation.empty()) lost(LossClass::style, "orientation");
    if (!grid.unit_system.empty()) lost(LossClass::identity, "unit system");
    if (grid.host) lost(LossClass::substance, "cells that the local grid refines");
    if (grid.porosity != CornerPointGrid::Porosity::single) lost(LossClass::substance, "second porosity");
    for (const auto& fault : grid.faults) lost(LossClass::substance, "fault '" + fault.name + "'");
    if (!grid.connections.empty()) lost(LossClass::substance, "connections", grid.connections.size());
    for (const auto& link : grid.links) lost(LossClass::substance, "connections between grids", link.connections.size());
    if (grid.pinch) lost(LossClass::substance, "how thin layers are bridged (PINCH)");
    if (grid.least_pore_volume) lost(LossClass::substance, "least pore volume (MINPV)");
    if (!grid.region_multipliers.empty()) lost(LossClass::substance, "multipliers between regions", grid.region_multipliers.size());
    const auto others = std::ranges::count_if(info.annotations, [](const Annotation& a) { return !a.key.starts_with("roff."); });
    if (others != 0) lost(LossClass::style, "records of the source format", static_cast<std::uint64_t>(others));
}

void add_rounding_loss(const CornerPointGrid& grid, std::uint64_t changed, double largest, std::vector<Loss>& losses) {
    if (changed == 0) return;
    Vec3 low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
    for (std::size_t v = 0; v < grid.pillars.size(); ++v) {
        low[v % 3] = std::min(low[v % 3], grid.pillars[v]);
        high[v % 3] = std::max(high[v % 3], grid.pillars[v]);
    }
    const double diagonal = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    add_loss(losses, {largest <= largest_harmless_shift * diagonal ? LossClass::identity : LossClass::substance, grid.info.name,
                      "coordinates rounded to single precision, by at most " + number_text(largest), "ROFF files store float32", changed});
}

}  // namespace geomend::roff
