// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "model/corner_point.h"

namespace geomend::grid {

/// Gathers the corners of cells (x, y, depth) and makes the grid on whose pillars they lie.
class PillarFit {
public:
    /// \param rounding by which coordinates may be off, relative to their size (2^-23 for single precision)
    PillarFit(std::array<std::uint32_t, 3> dims, double rounding);

    /// Eight corners in the order of corner_index. \pre cell < nx ny nz
    void add(std::size_t cell, const std::array<Vec3, 8>& corners);
    /// Points of a cell whose corners partly coincide; they are sorted onto the pillars in finish(). Where three pillars of
    /// such a cell are known, by hexahedra or in this way, its other points make the fourth. Points beside all pillars are
    /// passed over where `loose`, else they do not fit.
    void add_points(std::size_t cell, std::vector<Vec3> points, bool loose);

    /// The grid; cells that were not added are inactive. Failure F021 names the first cell (by number) that is off its
    /// pillars.
    Result<CornerPointGrid> finish();

private:
    struct Pinched {
        std::size_t cell;
        std::vector<Vec3> points;
        bool loose;
    };
    std::size_t pillar(std::size_t cell, unsigned corner) const;
    void fit_pillars();
    double distance(std::size_t pillar, const Vec3& p) const;
    double allowed(std::size_t pillar, const Vec3& p) const;
    std::vector<Vec3> points_of_unknown_pillar(const Pinched& pinched, std::size_t& unknown) const;
    bool fit_pillars_of_pinched();
    bool sort_onto_pillars(const Pinched& pinched);
    void fill_missing_pillars();
    void fill_missing_cells();
    Failure misfit_of(std::size_t cell, const std::string& what) const;

    CornerPointGrid grid_;
    double rounding_;
    std::vector<std::size_t> cells_;
    std::vector<std::array<Vec3, 8>> corners_;
    std::vector<Pinched> pinched_;
    std::vector<std::uint8_t> known_;  // per pillar
};

}  // namespace geomend::grid
