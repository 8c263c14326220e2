// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <limits>

#include "formats/eclipse/kept_arrays.h"
#include "formats/eclipse/write_common.h"
#include "formats/eclipse/write_eclipse.h"

namespace geomend::eclipse {

namespace {

using Porosity = CornerPointGrid::Porosity;

constexpr std::string_view title = "EGRID";
constexpr std::size_t head_size = 100;

std::int32_t number(std::uint32_t value) { return static_cast<std::int32_t>(value); }

/// The head that a file had, or zeros.
std::vector<std::int32_t> kept_head(const CornerPointGrid& grid, std::string_view name, std::size_t least) {
    std::vector<std::int32_t> head;
    if (const std::string* text = find_kept(grid.info.annotations, array_key, name)) {
        if (auto values = kept_integers(*text, 100000)) head = std::move(*values);
    }
    if (head.size() < least) head.assign(head_size, 0);
    return head;
}

class EgridWriter {
public:
    EgridWriter(const ChosenGrids& grids, OutputFile& file, bool formatted, const WriteOptions& options, std::vector<Loss>& losses)
        : grids_(grids), writer_(file, formatted), options_(options), losses_(losses) {}

    Result<void> run() {
        write_file_head();
        write_map(writer_, *grids_.global, title, losses_);
        if (auto done = write_grid(*grids_.global, 0); !done) return done;
        writer_.integers("ENDGRID", {});
        for (std::size_t i = 0; i < grids_.local.size(); ++i) {
            const CornerPointGrid& grid = *grids_.local[i];
            writer_.texts("LGR", std::span(&grid.info.name, 1));
            const std::string parent = grid.host->grid == grids_.global->info.name ? "" : grid.host->grid;
            writer_.texts("LGRPARNT", std::span(&parent, 1));
            if (auto done = write_grid(grid, i + 1); !done) return done;
            write_hosts(grid);
            writer_.integers("ENDGRID", {});
            writer_.integers("ENDLGR", {});
        }
        write_all_connections();
        return {};
    }

private:
    /// As the usual simulators write it: version 3 of 2007, corner points.
    void write_file_head() {
        std::vector<std::int32_t> head = kept_head(*grids_.global, "FILEHEAD", 7);
        if (head[0] == 0) {
            head[0] = 3;
            head[1] = 2007;
            head[6] = 1;
        }
        head[4] = 0;
        head[5] = grids_.global->porosity == Porosity::dual_porosity ? 1 : grids_.global->porosity == Porosity::dual_permeability ? 2 : 0;
        writer_.integers("FILEHEAD", head);
    }

    Result<void> write_grid(const CornerPointGrid& grid, std::size_t grid_number) {
        if (options_.monitor != nullptr && options_.monitor->stopped())
            return failure(FailureKind::cancelled, "F022", {grid.info.name}, "stopped");
        std::vector<std::int32_t> head = kept_head(grid, "GRIDHEAD", 33);
        if (head[0] == 0) head[24] = 1;
        head[0] = 1;
        for (std::size_t d = 0; d < 3; ++d) {
            head[1 + d] = number(grid.dims[d]);
            head[27 + d] = grid.host ? number(grid.host->first[d] + 1) : 0;
            head[30 + d] = grid.host ? number(grid.host->last[d] + 1) : 0;
        }
        head[4] = static_cast<std::int32_t>(grid_number);
        if (grid.reservoirs.size() > 1) head[24] = static_cast<std::int32_t>(grid.reservoirs.size());
        if (grid.reservoirs.size() <= 1 && head[24] > 1) head[24] = 1;
        head[26] = grid.cylindrical ? 1 : 0;
        writer_.integers("GRIDHEAD", head);
        for (const Annotation& a : grid.info.annotations) {
            const std::string_view name = kept_name(a.value);
            if (a.key == array_key && name != "FILEHEAD" && name != "GRIDHEAD" && !write_kept(writer_, a.value))
                add_loss(losses_, {LossClass::identity, grid.info.name, "array '" + std::string(name) + "'", "its kept text is damaged"});
        }
        if (auto done = write_geometry(writer_, grid, title, losses_); !done) return done;
        if (!grid.activity.empty()) writer_.integers_of_bytes("ACTNUM", grid.activity);
        const Attribute* coarse = find_attribute(grid.info.attributes, "CORSNUM", AttributeLocation::cell);
        if (coarse != nullptr && std::holds_alternative<std::vector<std::int32_t>>(coarse->values))
            writer_.integers("CORSNUM", std::get<std::vector<std::int32_t>>(coarse->values));
        return {};
    }

    void write_hosts(const CornerPointGrid& grid) {
        if (grid.host->cells.empty()) return;
        std::vector<std::int32_t> hosts;
        hosts.reserve(grid.host->cells.size());
        for (const std::uint64_t cell : grid.host->cells) hosts.push_back(static_cast<std::int32_t>(cell + 1));
        writer_.integers("HOSTNUM", hosts);
    }

    struct Cells {
        std::vector<std::int32_t> first, second;
        void add(std::uint64_t a, std::uint64_t b) {
            first.push_back(static_cast<std::int32_t>(a + 1));
            second.push_back(static_cast<std::int32_t>(b + 1));
        }
    };

    /// Of connections whose cells can be numbered in 32 bits; others are a loss.
    Cells cells_of(const CornerPointGrid& grid, const std::vector<CornerPointGrid::Connection>& connections, bool turned) {
        Cells cells;
        constexpr std::uint64_t most = std::numeric_limits<std::int32_t>::max() - 1;
        for (const auto& c : connections) {
            if (c.first > most || c.second > most) {
                add_loss(losses_, {LossClass::substance, grid.info.name, "connections", "the number of a cell does not fit 32 bits"});
            } else if (turned) {
                cells.add(c.second, c.first);
            } else {
                cells.add(c.first, c.second);
            }
        }
        return cells;
    }

    bool is_global(const std::string& name) const { return name.empty() || name == grids_.global->info.name; }

    void write_connections(const CornerPointGrid& grid, std::size_t grid_number) {
        const Cells inside = cells_of(grid, grid.connections, false);
        Cells with_global;
        const auto append = [&](const Cells& more) {
            with_global.first.insert(with_global.first.end(), more.first.begin(), more.first.end());
            with_global.second.insert(with_global.second.end(), more.second.begin(), more.second.end());
        };
        if (grid_number != 0) {
            for (const auto& link : grid.links) {
                if (is_global(link.grid)) append(cells_of(grid, link.connections, false));
            }
            for (const auto& link : grids_.global->links) {
                if (link.grid == grid.info.name) append(cells_of(grid, link.connections, true));
            }
        }
        if (inside.first.empty() && with_global.first.empty()) return;
        std::vector<std::int32_t> head(10, 0);
        head[0] = static_cast<std::int32_t>(inside.first.size());
        head[1] = static_cast<std::int32_t>(grid_number);
        writer_.integers("NNCHEAD", head);
        writer_.integers("NNC1", inside.first);
        writer_.integers("NNC2", inside.second);
        if (with_global.first.empty()) return;
        writer_.integers("NNCL", with_global.first);
        writer_.integers("NNCG", with_global.second);
    }

    void write_links_between(const CornerPointGrid& grid, std::size_t grid_number) {
        for (const auto& link : grid.links) {
            if (is_global(link.grid)) continue;
            const auto other = std::ranges::find_if(grids_.local, [&](const CornerPointGrid* g) { return g->info.name == link.grid; });
            if (other == grids_.local.end()) {
                add_loss(losses_, {LossClass::substance, grid.info.name, "connections with '" + link.grid + "'", "that grid is not there",
                                   link.connections.size()});
                continue;
            }
            if (grid_number == 0) continue;  // written with the other grid
            const Cells cells = cells_of(grid, link.connections, false);
            std::vector<std::int32_t> head(10, 0);
            head[0] = static_cast<std::int32_t>(grid_number);
            head[1] = static_cast<std::int32_t>(other - grids_.local.begin() + 1);
            writer_.integers("NNCHEADA", head);
            writer_.integers("NNA1", cells.first);
            writer_.integers("NNA2", cells.second);
        }
    }

    void write_all_connections() {
        write_connections(*grids_.global, 0);
        for (std::size_t i = 0; i < grids_.local.size(); ++i) write_connections(*grids_.local[i], i + 1);
        write_links_between(*grids_.global, 0);
        for (std::size_t i = 0; i < grids_.local.size(); ++i) write_links_between(*grids_.local[i], i + 1);
    }

    const ChosenGrids& grids_;
    ArrayWriter writer_;
    const WriteOptions& options_;
    std::vector<Loss>& losses_;
};

Result<std::vector<Loss>> write(const Dataset& dataset, OutputSet& out, const WriteOptions& options, bool formatted) {
    std::vector<Loss> losses;
    const auto grids = choose_grids(dataset, title, true, true, out, losses);
    if (!grids) return grids.why();
    const GridKept kept{.title = title, .connections = true, .porosity = true, .corsnum = true};
    add_grid_losses(*grids->global, kept, out, losses);
    GridKept kept_local = kept;
    kept_local.name = true;
    for (const CornerPointGrid* grid : grids->local) {
        add_grid_losses(*grid, kept_local, out, losses);
        if (grid->info.name.size() > 8)
            add_loss(losses, {LossClass::identity, grid->info.name, "name", "names of local grids have at most 8 characters"});
    }
    if (auto done = EgridWriter(*grids, out.main_file(), formatted, options, losses).run(); !done) return done.why();
    return losses;
}

}  // namespace

Result<std::vector<Loss>> write_egrid(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    return write(dataset, out, options, false);
}
Result<std::vector<Loss>> write_fegrid(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    return write(dataset, out, options, true);
}

}  // namespace geomend::eclipse
