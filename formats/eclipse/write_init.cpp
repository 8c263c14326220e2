// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>

#include "formats/eclipse/kept_arrays.h"
#include "formats/eclipse/write_common.h"
#include "formats/eclipse/write_eclipse.h"

namespace geomend::eclipse {

namespace {

using Porosity = CornerPointGrid::Porosity;

constexpr std::string_view title = "INIT";

std::int32_t unit_number(std::string_view system) {
    return system == "METRIC" ? 1 : system == "FIELD" ? 2 : system == "LAB" ? 3 : system == "PVT-M" ? 4 : 0;
}

class InitWriter {
public:
    InitWriter(const CornerPointGrid& grid, OutputFile& file, bool formatted, std::vector<Loss>& losses)
        : grid_(grid), order_(cell_order(grid)), writer_(file, formatted), losses_(losses) {}

    void run() {
        write_heads();
        const bool told = write_pore_volumes();
        if (!told && !grid_.activity.empty()) writer_.integers_of_bytes("ACTNUM", grid_.activity);
        write_cell_arrays(writer_, grid_, order_, true, title, losses_);
        for (const Annotation& a : grid_.info.annotations) {
            const std::string_view name = kept_name(a.value);
            if (a.key == init_key && name != "INTEHEAD" && name != "LOGIHEAD" && name != "DOUBHEAD" && !write_kept(writer_, a.value))
                lose_kept(name);
        }
        write_transmissibilities();
    }

private:
    void lose_kept(std::string_view name) {
        add_loss(losses_, {LossClass::identity, grid_.info.name, "array '" + std::string(name) + "'", "its kept text is damaged"});
    }

    void write_heads() {
        std::vector<std::int32_t> head;
        if (const std::string* text = find_kept(grid_.info.annotations, init_key, "INTEHEAD")) {
            if (auto values = kept_integers(*text, 100000)) head = std::move(*values);
        }
        if (head.size() < 95) {
            head.assign(411, 0);
            head[64] = 1;  // the date is not known: the first day that calendars of simulators have
            head[65] = 1;
            head[66] = 1983;
            head[94] = 100;
        }
        if (const std::int32_t unit = unit_number(grid_.unit_system); unit != 0) head[2] = unit;
        if (head[2] == 0) head[2] = 1;
        head[8] = static_cast<std::int32_t>(grid_.dims[0]);
        head[9] = static_cast<std::int32_t>(grid_.dims[1]);
        head[10] = static_cast<std::int32_t>(grid_.dims[2] * (order_.dual ? 2 : 1));
        head[11] = static_cast<std::int32_t>(order_.active());
        writer_.integers("INTEHEAD", head);
        const std::string* logicals_text = find_kept(grid_.info.annotations, init_key, "LOGIHEAD");
        if (logicals_text == nullptr || !write_kept(writer_, *logicals_text)) {
            std::vector<std::uint8_t> flags(121, 0);
            flags[14] = order_.dual ? 1 : 0;
            flags[15] = grid_.porosity == Porosity::dual_permeability ? 1 : 0;
            writer_.logicals("LOGIHEAD", flags);
        }
        const std::string* doubles_text = find_kept(grid_.info.annotations, init_key, "DOUBHEAD");
        if (doubles_text == nullptr || !write_kept(writer_, *doubles_text)) writer_.doubles("DOUBHEAD", std::vector<double>(229, 0.0));
    }

    /// PORV of all cells, 0 where it is missing. True where just the active cells have any, so that it tells them.
    bool write_pore_volumes() {
        const Attribute* matrix = find_attribute(grid_.info.attributes, "PORV", AttributeLocation::cell);
        const Attribute* fracture = order_.dual ? find_attribute(grid_.info.attributes, "PORV:fracture", AttributeLocation::cell) : nullptr;
        const auto fits = [&](const Attribute* a) {
            return a != nullptr && value_count(*a) == order_.cells && !std::holds_alternative<std::vector<std::string>>(a->values);
        };
        if (!fits(matrix)) return false;
        std::vector<double> values(order_.total(), 0.0);
        bool told = !order_.dual || fits(fracture);
        const auto put = [&](const Attribute& a, std::size_t first, unsigned bit) {
            for (std::size_t c = 0; c < order_.cells; ++c) {
                const double v = value_as_double(a, c);
                values[first + c] = is_no_data(a, v) ? 0.0 : v;
                const unsigned state = grid_.activity.empty() ? 3u : order_.dual ? grid_.activity[c] : grid_.activity[c] != 0 ? 1u : 0u;
                told = told && (values[first + c] > 0) == ((state & bit) != 0);
            }
        };
        put(*matrix, 0, 1);
        if (fits(fracture)) put(*fracture, order_.cells, 2);
        if (std::holds_alternative<std::vector<double>>(matrix->values)) {
            writer_.doubles("PORV", values);
        } else {
            writer_.rounded("PORV", values);
        }
        return told;
    }

    /// In the order of the connections, all of which have to have one.
    void write_transmissibilities() {
        std::vector<double> values;
        for (const auto& c : grid_.connections) {
            if (c.transmissibility) values.push_back(*c.transmissibility);
        }
        if (values.empty()) return;
        if (values.size() != grid_.connections.size()) {
            add_loss(losses_, {LossClass::substance, grid_.info.name, "transmissibilities of connections",
                               "some connections have none, and TRANNNC holds one for each", values.size()});
            return;
        }
        const Rounding rounding = writer_.rounded("TRANNNC", values);
        if (rounding.changed != 0) {
            add_loss(losses_, {LossClass::identity, grid_.info.name, "transmissibilities rounded to single precision",
                               "INIT files store float32", rounding.changed});
        }
    }

    const CornerPointGrid& grid_;
    CellOrder order_;
    ArrayWriter writer_;
    std::vector<Loss>& losses_;
};

Result<std::vector<Loss>> write(const Dataset& dataset, OutputSet& out, bool formatted) {
    std::vector<Loss> losses;
    const auto grids = choose_grids(dataset, title, false, false, out, losses);
    if (!grids) return grids.why();
    const CornerPointGrid& grid = *grids->global;
    const GridKept kept{
        .title = title, .attributes = true, .transmissibilities = true, .porosity = true, .map = false, .unit_system = true};
    add_grid_losses(grid, kept, out, losses);
    const auto lost = [&](std::string what, std::uint64_t count) {
        add_loss(losses, {LossClass::substance, grid.info.name, std::move(what),
                          "INIT files hold properties; the grid is in the EGRID file", count});
    };
    if (!grid.depths.empty()) lost("corners of the cells", grid.cell_count());
    if (!grid.connections.empty()) lost("cells of the connections", grid.connections.size());
    InitWriter(grid, out.main_file(), formatted, losses).run();
    return losses;
}

}  // namespace

Result<std::vector<Loss>> write_init(const Dataset& dataset, OutputSet& out, const WriteOptions&) { return write(dataset, out, false); }
Result<std::vector<Loss>> write_finit(const Dataset& dataset, OutputSet& out, const WriteOptions&) { return write(dataset, out, true); }

}  // namespace geomend::eclipse
