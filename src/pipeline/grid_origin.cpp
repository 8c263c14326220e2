// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/grid_origin.h"

#include <optional>
#include <string>
#include <variant>

#include "base/number_text.h"
#include "grid/local_origin.h"

namespace geomend {

namespace {

Failure usage(const std::string& message) { return failure(FailureKind::usage, "F018", {}, message); }

Finding told(const CornerPointGrid& grid, const grid::LocalFrame& frame, bool had_axes, double rounding) {
    Finding f = make_finding("F154", {}, {}, 0);
    f.entities.push_back({"grid", grid.info.name, -1});
    f.measures = {{"origin_x", frame.origin[0]}, {"origin_y", frame.origin[1]}, {"rounding_of_map_axes", rounding}};
    f.message = "coordinates count from the origin " + number_text(frame.origin[0]) + " " + number_text(frame.origin[1]) +
                " of the map now" + (had_axes ? ", along the same axes" : "") +
                "; MAPAXES says so, and --option map=apply gives back the map's";
    if (grid.map_unit.empty()) f.message += "; MAPUNITS is not written, since the file does not state the unit of its coordinates";
    if (rounding > 0) f.message += " (rounding MAPAXES to single precision moves the grid by up to " + number_text(rounding) + ")";
    return f;
}

}  // namespace

Result<void> move_grid_origins(Dataset& dataset, const Format& target, const FormatOptions& options) {
    const std::string_view origin = option_value(options, "origin");
    if (origin.empty() || origin == "keep") return {};
    if (origin != "local") return usage("--option origin=" + std::string(origin) + ": expected local or keep");
    if (!target.map_axes)
        return usage("--option origin=local: " + std::string(target.title) + " holds no map axes to say where the origin is");
    std::optional<grid::LocalFrame> frame;
    for (Object& object : dataset.objects) {
        auto* grid = std::get_if<CornerPointGrid>(&object);
        if (grid == nullptr || grid->pillars.empty()) continue;
        const bool own = !grid->host || !frame;
        if (own) {
            auto found = grid::local_frame(*grid);
            if (!found) return std::move(found).why();
            frame = *found;
        }
        const bool had_axes = grid->map_axes && !grid->map_relative;
        const auto rounding = grid::move_into(*frame, *grid);
        if (!rounding) return rounding.why();
        if (own) dataset.findings.push_back(told(*grid, *frame, had_axes, *rounding));
    }
    return {};
}

}  // namespace geomend
