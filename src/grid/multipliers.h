// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "model/corner_point.h"

namespace geomend::grid {

/// What transmissibilities are multiplied by: MULTX and its kin, faults and pairs of regions.
class Multipliers {
public:
    explicit Multipliers(const CornerPointGrid& grid);

    /// Of the face of one cell.
    double of_face(std::size_t cell, CellFace face) const {
        const std::vector<double>& values = faces_[static_cast<std::size_t>(face)];
        return values.empty() ? 1.0 : values[cell];
    }
    /// Of a connection between two cells; `face` is that of the first one, `neighbours` whether they are so by (i,j,k).
    double between(std::size_t first, std::size_t second, CellFace face, bool neighbours) const {
        return rules_.empty() ? 1.0 : of_rules(first, second, face, neighbours);
    }

private:
    void take_faults(const CornerPointGrid& grid);
    double of_rules(std::size_t first, std::size_t second, CellFace face, bool neighbours) const;

    struct RegionRule {
        const CornerPointGrid::RegionMultiplier* rule;
        const std::vector<double>* regions;
    };
    std::array<std::vector<double>, 6> faces_;  ///< empty where all are 1
    std::array<std::vector<double>, 3> regions_;
    std::vector<RegionRule> rules_;
};

}  // namespace geomend::grid
