// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace geomend::hexes {

/// Where a column of a lattice enters a region through a surface across it, and where it leaves.
struct ColumnSpan {
    std::int64_t i, j;
    double low, high;  ///< in steps of the lattice
};

/// Layer coordinates of a region: from its base to its top there are so many layers in each column, whatever its height. Between columns
/// base and height are bilinear; where a column is cut off by a wall they go on as beside it.
class Layers {
public:
    /// Layer coordinates for a region that lies between a base and a top: where most of its columns are whole, and not so different
    /// in height that layers would be much thinner or thicker than a step. Else nothing. Cost: as the columns in its extent.
    /// \param whole columns that have both ends, one for each i, j  \param columns how many there are, whole or not
    static std::shared_ptr<const Layers> of(std::span<const ColumnSpan> whole, std::size_t columns);

    double count() const { return count_; }
    double least_height() const { return least_; }    ///< of a layer, in steps
    double median_height() const { return median_; }  ///< of a layer, in steps
    bool in_all_columns() const { return in_all_; }   ///< but for a fiftieth: no fault cuts them off, and no wall that leans
    /// Whole numbers are layers' borders: 0 at the base, count() at the top.
    double level(double i, double j, double w) const;
    double height(double i, double j, double level) const;

private:
    std::int64_t first_i_ = 0, first_j_ = 0;
    std::size_t ni_ = 0, nj_ = 0;
    std::vector<double> base_, thickness_;  // j fastest
    double count_ = 1, least_ = 1, median_ = 1;
    bool in_all_ = false;

    struct Column {
        double base, thickness;
    };
    Column at(double i, double j) const;
    void go_on(std::vector<double>& values, std::vector<std::uint8_t> known) const;
};

}  // namespace geomend::hexes
