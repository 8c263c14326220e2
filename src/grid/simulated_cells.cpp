// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/simulated_cells.h"

#include <algorithm>

#include "grid/map_axes.h"
#include "grid/pillar_nodes.h"
#include "grid/pore_volume.h"

namespace geomend::grid {

namespace {

// One column of cells as the walk from a cell that is left out sees them.
struct Column {
    struct Cell {
        bool kept;     // active, with enough pore volume
        bool dropped;  // active, with too little
        double thickness;
    };
    std::vector<Cell> cells;
    double threshold = 0;
    bool gap = true;

    bool active(std::size_t k) const { return cells[k].kept || cells[k].dropped; }

    /// Next to a cell that is left out: further ones of the kind are passed, with NOGAP thin ones only.
    bool passed(std::size_t k) const {
        const bool thin = cells[k].thickness < threshold;
        return cells[k].dropped ? gap || thin : !active(k) && thin;
    }
    bool stops(std::size_t k, double thickness) const {
        if (cells[k].kept) return true;
        return thickness > threshold && (!active(k) || !gap);
    }

    /// The upper end of a bridge past layer k.
    std::size_t above(std::size_t k) const {
        std::size_t upper = k - 1;
        if (!passed(upper)) return upper;
        while (upper > 1) {
            --upper;
            if (stops(upper, cells[upper].thickness)) break;
        }
        return upper;
    }

    /// The lower end, or the number of layers. A thin cell above lets a thick inactive one below be passed.
    std::size_t below(std::size_t k, std::size_t upper) const {
        std::size_t lower = k + 1;
        while (lower < cells.size() && !active(lower) && cells[lower].thickness <= threshold) ++lower;
        if (lower == cells.size() || !passed(lower)) return lower;
        while (++lower < cells.size()) {
            if (stops(lower, cells[upper].thickness)) break;
        }
        return lower;
    }
};

double mean_thickness(const CornerPointGrid& grid, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    double sum = 0;
    for (unsigned c = 0; c < 4; ++c)
        sum += grid.depths[corner_index(grid.dims, i, j, k, c + 4)] - grid.depths[corner_index(grid.dims, i, j, k, c)];
    return sum / 4;
}

// PINCH states its threshold in the unit of the deck, which need not be that of the grid.
double threshold_of(const CornerPointGrid& grid) {
    if (!grid.pinch) return 0;
    const double own = metres(grid.info.crs.axis_units[0]);
    if (own == 0 || grid.unit_system.empty()) return grid.pinch->threshold;
    const double deck = grid.unit_system == "FIELD" ? 0.3048 : grid.unit_system == "LAB" ? 0.01 : 1.0;
    return grid.pinch->threshold * deck / own;
}

class Chooser {
public:
    explicit Chooser(const CornerPointGrid& grid) : grid_(grid) {}

    SimulatedCells choose() {
        result_.present = present_cells(grid_);
        // With two porosities a cell may have its pores in the fracture.
        if (!knows_pore_volumes(grid_) || grid_.porosity != CornerPointGrid::Porosity::single) return std::move(result_);
        volumes_ = pore_volumes(grid_);
        own_least_ = fitting_values(grid_, "MINPVV", 0);
        for (std::size_t cell = 0; cell < volumes_.size(); ++cell) {
            if (result_.present[cell] == 0) continue;
            if (volumes_[cell] == 0) result_.without_pores.push_back(cell);
            else if (volumes_[cell] < least(cell)) result_.below_minpv.push_back(cell);
        }
        for (const auto* cells : {&result_.without_pores, &result_.below_minpv}) {
            for (const std::size_t cell : *cells) result_.present[cell] = 0;
        }
        bridge();
        return std::move(result_);
    }

private:
    double least(std::size_t cell) const {
        if (grid_.least_pore_volume) return *grid_.least_pore_volume;
        return own_least_.empty() ? 0 : own_least_[cell];
    }

    void bridge() {
        const std::size_t columns = std::size_t{grid_.dims[0]} * grid_.dims[1];
        std::vector<bool> concerned(result_.below_minpv.empty() ? 0 : columns, false);
        for (const std::size_t cell : result_.below_minpv) concerned[cell % columns] = true;
        for (std::size_t column = 0; column < concerned.size(); ++column) {
            if (!concerned[column]) continue;
            load(column, columns);
            for (std::size_t k = 1; k < column_.cells.size(); ++k) {
                if (!column_.cells[k].dropped) continue;
                const std::size_t upper = column_.above(k), lower = column_.below(k, upper);
                if (lower < column_.cells.size() && column_.cells[upper].kept && column_.cells[lower].kept)
                    result_.bridges.push_back({column + upper * columns, column + lower * columns});
            }
        }
        std::ranges::sort(result_.bridges);
        result_.bridges.erase(std::ranges::unique(result_.bridges).begin(), result_.bridges.end());
    }

    void load(std::size_t column, std::size_t columns) {
        const auto i = static_cast<std::uint32_t>(column % grid_.dims[0]), j = static_cast<std::uint32_t>(column / grid_.dims[0]);
        column_.threshold = threshold_of(grid_);
        column_.gap = !grid_.pinch || grid_.pinch->gap;
        column_.cells.clear();
        for (std::uint32_t k = 0; k < grid_.dims[2]; ++k) {
            const std::size_t cell = column + k * columns;
            const bool active = grid_.is_active(cell) && volumes_[cell] > 0;
            const bool dropped = active && volumes_[cell] < least(cell);
            column_.cells.push_back({active && !dropped, dropped, mean_thickness(grid_, i, j, k)});
        }
    }

    const CornerPointGrid& grid_;
    std::vector<double> volumes_, own_least_;
    Column column_;
    SimulatedCells result_;
};

}  // namespace

SimulatedCells simulated_cells(const CornerPointGrid& grid) { return Chooser(grid).choose(); }

}  // namespace geomend::grid
