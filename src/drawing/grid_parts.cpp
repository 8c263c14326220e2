// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include "drawing/parts.h"
#include "grid/boundary_model.h"
#include "grid/pillar_nodes.h"

namespace geomend::scene {

namespace {

// Corners of the six sides in the order of CellFace, each once round.
constexpr std::array<std::array<unsigned, 4>, 6> side_corners{
    {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}}};
// The same corners as the cell on the other side counts them.
constexpr std::array<std::array<unsigned, 4>, 6> facing_corners{
    {{1, 3, 7, 5}, {0, 2, 6, 4}, {2, 3, 7, 6}, {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 1, 3, 2}}};

class Sides {
public:
    explicit Sides(const CornerPointGrid& grid) : grid_(grid), stated_(grid), present_(grid::present_cells(grid)) {
        for (std::size_t cell = 0; cell < present_.size(); ++cell) {
            if (present_[cell] == 0) continue;
            const auto [i, j, k] = grid.ijk(cell);
            if (!is_finite(cell_corners(grid, i, j, k))) present_[cell] = 0;
        }
    }

    void add(std::vector<ScenePart>& parts) {
        for (std::size_t cell = 0; cell < present_.size(); ++cell) {
            if (present_[cell] == 0) continue;
            for (unsigned side = 0; side < 6; ++side) look_at(cell, static_cast<CellFace>(side));
        }
        for (auto& [name, part] : parts_) {
            put_points_together(part);
            if (!part.triangles.empty()) parts.push_back(std::move(part));
        }
    }

private:
    using Place = std::array<std::uint32_t, 3>;

    // The place beyond a side; false at the edge of the grid.
    bool beyond(const Place& at, CellFace side, Place& next) const {
        const unsigned axis = static_cast<unsigned>(side) / 2;
        const bool up = (static_cast<unsigned>(side) & 1u) != 0;
        if (up ? at[axis] + 1 >= grid_.dims[axis] : at[axis] == 0) return false;
        next = at;
        next[axis] = up ? at[axis] + 1 : at[axis] - 1;
        return true;
    }

    void look_at(std::size_t cell, CellFace side) {
        const Place at = grid_.ijk(cell);
        Place next{};
        const bool inside = beyond(at, side, next);
        const bool faced = inside && present_[grid_.cell(next[0], next[1], next[2])] != 0;
        const std::string* fault = stated_.find(cell, side);
        if (fault == nullptr && faced)
            fault = stated_.find(grid_.cell(next[0], next[1], next[2]), static_cast<CellFace>(static_cast<unsigned>(side) ^ 1u));
        if (fault != nullptr) return add_side(at, side, *fault, FeatureRole::fault);
        if (faced && touches(at, next, side)) return;
        static constexpr std::array names{"boundary I-", "boundary I+", "boundary J-", "boundary J+", "top", "base"};
        if (!inside) return add_side(at, side, names[static_cast<std::size_t>(side)], FeatureRole::boundary);
        const bool level = side >= CellFace::k_minus;
        if (!faced) return add_side(at, side, level ? names[static_cast<std::size_t>(side)] : "boundary inside", FeatureRole::boundary);
        if (level) add_side(at, side, "gap or overlap of layers", FeatureRole::unknown);
        else add_side(at, side, "unnamed throw", FeatureRole::fault);
    }

    // Both cells have the same corners there.
    bool touches(const Place& at, const Place& next, CellFace side) const {
        for (unsigned c = 0; c < 4; ++c) {
            const double own = grid_.depths[corner_index(grid_.dims, at[0], at[1], at[2], side_corners[static_cast<std::size_t>(side)][c])];
            const double other =
                grid_.depths[corner_index(grid_.dims, next[0], next[1], next[2], facing_corners[static_cast<std::size_t>(side)][c])];
            if (own != other) return false;
        }
        return true;
    }

    void add_side(const Place& at, CellFace side, const std::string& name, FeatureRole role) {
        ScenePart& part = parts_[name];
        if (part.points.empty()) {
            part.kind = "side";
            part.name = name;
            part.role = role;
        }
        const auto corners = elevated_corners(grid_, at[0], at[1], at[2]);
        const auto first = static_cast<std::uint32_t>(part.points.size());
        for (const unsigned c : side_corners[static_cast<std::size_t>(side)]) part.points.push_back(corners[c]);
        part.triangles.push_back({first, first + 1, first + 2});
        part.triangles.push_back({first, first + 2, first + 3});
    }

    // Bit-equal points become one, triangles without area go.
    static void put_points_together(ScenePart& part) {
        std::vector<std::uint32_t> order(part.points.size()), becomes(part.points.size());
        std::iota(order.begin(), order.end(), 0u);
        std::ranges::sort(order, {}, [&](std::uint32_t i) { return part.points[i]; });
        std::vector<Vec3> points;
        for (const std::uint32_t i : order) {
            if (points.empty() || points.back() != part.points[i]) points.push_back(part.points[i]);
            becomes[i] = static_cast<std::uint32_t>(points.size() - 1);
        }
        for (auto& triangle : part.triangles) {
            for (std::uint32_t& corner : triangle) corner = becomes[corner];
        }
        std::erase_if(part.triangles, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
        part.points = std::move(points);
    }

    const CornerPointGrid& grid_;
    grid::FaultFaces stated_;
    std::vector<std::uint8_t> present_;
    std::map<std::string, ScenePart> parts_;
};

}  // namespace

bool is_finite(const std::array<Vec3, 8>& corners) {
    return std::ranges::all_of(corners, [](const Vec3& p) { return std::ranges::all_of(p, [](double v) { return std::abs(v) < 1e20; }); });
}

std::array<Vec3, 8> elevated_corners(const CornerPointGrid& grid, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    auto corners = cell_corners(grid, i, j, k);
    for (Vec3& p : corners) p[2] = -p[2];
    return corners;
}

void add_parts(const CornerPointGrid& grid, std::vector<ScenePart>& parts) {
    if (grid.pillars.empty() || grid.depths.empty() || !misfit(grid).empty()) return;
    Sides(grid).add(parts);
}

}  // namespace geomend::scene
