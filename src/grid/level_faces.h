// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "grid/column_depths.h"
#include "grid/pillar_nodes.h"
#include "grid/plane_faces.h"
#include "model/corner_point.h"

namespace geomend::grid {

/// The planes of a row of pillars, and what is added to the row's own numbers of crossings.
struct ShiftedRow {
    const PlaneRow* row;
    std::uint32_t shift;
};

/// Makes the tops and bottoms of the cells, a row of columns at a time.
class LevelMaker {
public:
    /// \param present as present_cells() gives it
    /// \param depths of the same grid; whoever makes the planes beside has read most of what is needed here
    LevelMaker(const CornerPointGrid& grid, std::span<const std::uint8_t> present, const PillarNodes& nodes, ColumnDepths& depths)
        : grid_(grid), present_(present), nodes_(nodes), depths_(depths) {}

    /// \param j row of columns, 0 .. ny - 1
    /// \param north, south the rows of pillars j and j + 1, whose crossings become corners
    /// \param to loses what it held
    void make(std::uint32_t j, const ShiftedRow& north, const ShiftedRow& south, FaceBatch& to);

private:
    void stack(std::uint32_t i, std::uint32_t j);
    bool touching(std::uint32_t upper, std::uint32_t lower) const;
    void level(std::uint32_t i, std::uint32_t j, std::uint32_t k, std::uint32_t other, CellFace side);
    void along(const ShiftedRow& row, std::size_t plane, const std::array<double, 2>& edge, bool forward);

    const CornerPointGrid& grid_;
    std::span<const std::uint8_t> present_;
    const PillarNodes& nodes_;
    ColumnDepths& depths_;
    std::array<const double*, 4> columns_{};  // of the column at hand, at its four pillars
    ShiftedRow north_{}, south_{};
    FaceBatch* to_ = nullptr;
    std::array<std::uint32_t, 4> last_{};  // points of the level before, where the next are near
    std::vector<std::uint32_t> polygon_;
};

}  // namespace geomend::grid
