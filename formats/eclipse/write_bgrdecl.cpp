// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>

#include "formats/eclipse/kept_arrays.h"
#include "formats/eclipse/write_common.h"
#include "formats/eclipse/write_eclipse.h"

namespace geomend::eclipse {

namespace {

constexpr std::string_view title = "binary GRDECL";

/// 0 and 1, since decks of one porosity know no others.
std::vector<std::uint8_t> plain_activity(const CornerPointGrid& grid) {
    std::vector<std::uint8_t> activity = grid.activity;
    for (std::uint8_t& a : activity) a = a != 0 ? 1 : 0;
    return activity;
}

}  // namespace

Result<std::vector<Loss>> write_bgrdecl(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    std::vector<Loss> losses;
    const auto grids = choose_grids(dataset, title, false, true, out, losses);
    if (!grids) return grids.why();
    if (options.monitor != nullptr && options.monitor->stopped())
        return failure(FailureKind::cancelled, "F022", {out.main_path().string()}, "stopped");
    const CornerPointGrid& grid = *grids->global;
    add_grid_losses(grid, {.title = title, .attributes = true}, out, losses);
    ArrayWriter writer(out.main_file(), false);
    write_map(writer, grid, title, losses);
    std::vector<std::int32_t> spec;
    for (const std::uint32_t d : grid.dims) spec.push_back(static_cast<std::int32_t>(d));
    spec.push_back(static_cast<std::int32_t>(std::max<std::size_t>(1, grid.reservoirs.size())));
    if (grid.cylindrical) spec.push_back(1);
    writer.integers("SPECGRID", spec);
    if (auto done = write_geometry(writer, grid, title, losses); !done) return done.why();
    const bool dual = grid.porosity != CornerPointGrid::Porosity::single;
    if (!grid.activity.empty()) writer.integers_of_bytes("ACTNUM", dual ? plain_activity(grid) : grid.activity);
    CellOrder order;
    order.cells = grid.cell_count();
    order.all_active = true;
    write_cell_arrays(writer, grid, order, false, title, losses);
    for (const Annotation& a : grid.info.annotations) {
        if (a.key == deck_key && !write_kept(writer, a.value)) {
            add_loss(losses,
                     {LossClass::identity, grid.info.name, "array '" + std::string(kept_name(a.value)) + "'", "its kept text is damaged"});
        }
    }
    return losses;
}

}  // namespace geomend::eclipse
