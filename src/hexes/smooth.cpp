// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/smooth.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "base/vectors.h"
#include "geometry/cell_volume.h"
#include "hexes/jacobian.h"
#include "model/cell_faces.h"

namespace geomend::hexes {

namespace {

class Smoother {
public:
    Smoother(MixedMesh& mesh, double least_hexahedron) : mesh_(mesh), least_(least_hexahedron), first_(mesh.positions.size() + 1, 0) {
        for (const auto& cell : mesh.cells) {
            for (const std::uint32_t v : corners_of(cell)) ++first_[v + 1];
        }
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        around_.resize(first_.back());
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (std::uint32_t c = 0; c < mesh.cells.size(); ++c) {
            for (const std::uint32_t v : corners_of(mesh.cells[c])) around_[next[v]++] = c;
        }
        has_changed_.assign(mesh.positions.size(), 1);
    }

    /// \return how many moves of a vertex there were; none where nothing around it has moved since it was tried in vain
    std::uint64_t improve(std::uint32_t v) {
        if (has_changed_[v] == 0) return 0;
        const std::uint64_t moves = (move(v) ? 1u : 0u) + (grow_hexahedra(v) ? 1u : 0u);
        has_changed_[v] = 0;
        for (std::size_t k = 0; moves > 0 && k < cells_at(v).size(); ++k) {
            for (const std::uint32_t w : corners_of(mesh_.cells[cells_at(v)[k]])) has_changed_[w] = 1;
        }
        return moves;
    }

private:
    /// Whether a move made the worst cell around a vertex better.
    bool move(std::uint32_t v) {
        const Vec3 before = mesh_.positions[v], goal = middle_of_neighbours(v);
        const double worst = worst_around(v, -1);
        for (const double part : {1.0, 0.5, 0.25, 0.1}) {
            mesh_.positions[v] = plus(before, times(part, minus(goal, before)));
            if (worst_around(v, worst + 1e-3) > worst + 1e-3) return true;
        }
        mesh_.positions[v] = before;
        return false;
    }

    /// Whether a move made the hexahedra around a vertex larger together, at the cost of other cells, and the worst cell no worse.
    bool grow_hexahedra(std::uint32_t v) {
        const Vec3 before = mesh_.positions[v], by_place = growth_of_hexahedra(v);
        const double rate = std::sqrt(dot(by_place, by_place)), size = distance_to_neighbours(v), worst = worst_around(v, -1);
        if (!(rate > 1e-6 * size * size) || !(worst > 0)) return false;
        for (const double part : {0.2, 0.1, 0.05}) {
            mesh_.positions[v] = plus(before, times(part * size / rate, by_place));
            if (worst_around(v, worst * (1 - 1e-12)) >= worst) return true;
        }
        mesh_.positions[v] = before;
        return false;
    }

    /// By how much the volume of the hexahedra around a vertex grows with its place: it is linear in that.
    Vec3 growth_of_hexahedra(std::uint32_t v) const {
        Vec3 growth{};
        for (const std::uint32_t c : cells_at(v)) {
            const auto& cell = mesh_.cells[c];
            if (cell.type != CellType::hexahedron) continue;
            std::array<Vec3, 8> p{};
            std::size_t own = 0;
            for (std::size_t k = 0; k < 8; ++k) {
                p[k] = minus(mesh_.positions[cell.corners[k]], mesh_.positions[v]);
                if (cell.corners[k] == v) own = k;
            }
            const double volume = hexahedron_volume(p), unit = std::sqrt(dot(p[own ^ 1], p[own ^ 1]));
            for (std::size_t axis = 0; axis < 3; ++axis) {
                p[own] = {};
                p[own][axis] = unit;
                growth[axis] += (hexahedron_volume(p) - volume) / unit;
            }
        }
        return growth;
    }

    double distance_to_neighbours(std::uint32_t v) {
        middle_of_neighbours(v);
        double sum = 0;
        for (const std::uint32_t n : neighbours_) {
            const Vec3 e = minus(mesh_.positions[n], mesh_.positions[v]);
            sum += std::sqrt(dot(e, e));
        }
        return sum / static_cast<double>(std::max<std::size_t>(1, neighbours_.size()));
    }

    std::span<const std::uint32_t> corners_of(const MixedMesh::Cell& cell) const { return {cell.corners.data(), node_count(cell.type)}; }
    std::span<const std::uint32_t> cells_at(std::uint32_t v) const { return {around_.data() + first_[v], around_.data() + first_[v + 1]}; }

    Vec3 middle_of_neighbours(std::uint32_t v) {
        neighbours_.clear();
        for (const std::uint32_t c : cells_at(v)) {
            const auto& cell = mesh_.cells[c];
            for (const auto& e : edges_of(cell.type)) {
                if (cell.corners[e[0]] == v) neighbours_.push_back(cell.corners[e[1]]);
                else if (cell.corners[e[1]] == v) neighbours_.push_back(cell.corners[e[0]]);
            }
        }
        std::ranges::sort(neighbours_);
        neighbours_.erase(std::ranges::unique(neighbours_).begin(), neighbours_.end());
        Vec3 sum{};
        for (const std::uint32_t n : neighbours_) sum = plus(sum, minus(mesh_.positions[n], mesh_.positions[v]));
        return plus(mesh_.positions[v], times(1 / static_cast<double>(std::max<std::size_t>(1, neighbours_.size())), sum));
    }

    /// The least shape of the cells around a vertex; -1 where one is folded, or a hexahedron worse than it may be; or anything that is
    /// not more than `enough` where it is not.
    double worst_around(std::uint32_t v, double enough) const {
        double worst = 2;
        for (const std::uint32_t c : cells_at(v)) {
            const auto& cell = mesh_.cells[c];
            std::array<Vec3, 8> p{};
            const auto corners = corners_of(cell);
            for (std::size_t k = 0; k < corners.size(); ++k) p[k] = mesh_.positions[corners[k]];
            const std::span<const Vec3> points(p.data(), corners.size());
            const double shape = scaled_jacobian(cell.type, points);
            worst = std::min(worst, shape);
            if (worst <= enough) return worst;
            if (enough >= 0 && ((cell.type == CellType::hexahedron && shape < least_) || !is_valid(cell.type, points))) return -1;
        }
        return worst;
    }

    MixedMesh& mesh_;
    double least_;
    std::vector<std::uint32_t> first_, around_, neighbours_;
    std::vector<std::uint8_t> has_changed_;  ///< per vertex: it, or something around it, since it was tried
};

}  // namespace

std::vector<std::uint8_t> fixed_vertices(const TetMesh& mesh) {
    std::vector<std::uint8_t> fixed(mesh.positions.size(), 0);
    for (std::uint32_t f = 0; f < 4 * mesh.tets.size(); ++f) {
        if (mesh.wall[f / 4][f % 4] == TetMesh::no_wall) continue;
        for (const std::uint32_t v : mesh.facet(f)) fixed[v] = 1;
    }
    for (std::uint32_t v = 0; v < fixed.size(); ++v) {
        if (mesh.lines.has(v)) fixed[v] = 1;
    }
    return fixed;
}

std::uint64_t smooth(MixedMesh& mesh, const std::vector<std::uint8_t>& fixed, double least_hexahedron, int passes) {
    Smoother smoother(mesh, least_hexahedron);
    std::uint64_t moves = 0;
    for (int pass = 0; pass < passes; ++pass) {
        const std::uint64_t before = moves;
        for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
            if (v < fixed.size() && fixed[v] != 0) continue;
            moves += smoother.improve(v);
        }
        if (moves == before) break;
    }
    return moves;
}

}  // namespace geomend::hexes
