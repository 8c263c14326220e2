// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "grid/connections.h"
#include "grid/edge_crossings.h"
#include "grid/faces.h"
#include "grid/pillar_nodes.h"

namespace geomend::grid {

/// Faces on their way into GridFaces.
struct FaceBatch {
    std::vector<GridFaces::Face> faces;
    std::vector<std::uint32_t> sizes;  ///< corners of each face
    std::vector<std::uint32_t> nodes;

    void add(const GridFaces::Face& face, std::span<const std::uint32_t> polygon) {
        faces.push_back(face);
        sizes.push_back(static_cast<std::uint32_t>(polygon.size()));
        nodes.insert(nodes.end(), polygon.begin(), polygon.end());
    }
    void clear() {
        faces.clear();
        sizes.clear();
        nodes.clear();
    }
};

/// A crossing of two edges, as one of them sees it.
struct EdgeCrossing {
    std::array<double, 2> edge;  ///< depths on pillars a and b
    double u;                    ///< fraction from a to b
    std::uint32_t node;          ///< number of points on pillars + place in PlaneRow::points
};

/// The faces in the planes of one row of pillars: between the columns of row j, and between row j-1 and row j.
struct PlaneRow {
    FaceBatch batch;
    std::vector<Vec3> points;             ///< of crossings off the pillars, elevation-up
    std::vector<EdgeCrossing> crossings;  ///< plane by plane, each plane's sorted by edge, then from a to b
    std::vector<std::uint64_t> first;     ///< per plane, see plane_across_i() and plane_across_j(); one more behind the last
    std::uint64_t unmatched = 0;          ///< as in GridFaces

    /// Places in `first`: of the plane at pillar i across which cells are neighbours in I, and of that behind pillar i
    /// across which they are neighbours in J.
    static std::size_t plane_across_i(std::uint32_t i) { return 2 * std::size_t{i}; }
    static std::size_t plane_across_j(std::uint32_t i) { return 2 * std::size_t{i} + 1; }
    std::span<const EdgeCrossing> of_plane(std::size_t plane) const {
        return {crossings.data() + first[plane], static_cast<std::size_t>(first[plane + 1] - first[plane])};
    }
    void clear() {
        batch.clear();
        points.clear();
        crossings.clear();
        first.clear();
        unmatched = 0;
    }
};

/// Adds a shift to the numbers of crossings: those from `pillar_nodes` on.
void shift_crossings(FaceBatch& batch, std::uint32_t pillar_nodes, std::uint32_t shift);

/// Makes the rows of a grid, one after the other; rows may be made at the same time by makers of their own.
class PlaneMaker {
public:
    /// \param present as present_cells() gives it
    PlaneMaker(const CornerPointGrid& grid, std::span<const std::uint8_t> present, const PillarNodes& nodes)
        : grid_(grid), present_(present), nodes_(nodes), sides_(grid) {}

    /// \param j row of pillars, 0 .. ny
    /// \param to loses what it held; its arrays are used again. Cost: linear in layers for columns that are in order.
    void make(std::uint32_t j, PlaneRow& to);

    /// Holds the rows of depths that were last read: after make(j), those of the columns of row j - 1 and j.
    ColumnDepths& depths() { return sides_.depths; }

private:
    // The pillars at both ends of a plane, without the shift of the set of coordinate lines.
    struct Between {
        std::size_t pillar_a, pillar_b;
    };
    // Points at the corners of a side.
    struct SideNodes {
        std::uint32_t top_a, top_b, bottom_a, bottom_b;
    };
    struct Numbered {
        Side side;
        SideNodes nodes;
    };

    void across_i(std::uint32_t i, std::uint32_t j);
    void across_j(std::uint32_t i, std::uint32_t j);
    void border(std::uint32_t i, std::uint32_t j, CellFace face, const Between& between);
    void pair(const ColumnPair& columns, const Between& between);
    void unmatched(std::uint32_t first, std::uint32_t second, CellFace face, CellFace back);
    void number(std::span<const Side> sides, std::span<const std::uint8_t> active, const Between& between,
                std::vector<SideNodes>& to) const;
    void find_voids(const std::vector<Side>& sides, const std::vector<std::uint8_t>& active, const std::vector<SideNodes>& nodes,
                    const std::array<double, 2>& range);
    std::array<double, 2> depth_range() const;
    void free_sides(const std::vector<Side>& sides, const std::vector<std::uint8_t>& active, const std::vector<SideNodes>& nodes,
                    std::uint32_t column, CellFace face, const Between& between);
    void whole(const Side& side, const SideNodes& nodes, std::uint32_t first, std::uint32_t second, CellFace face);
    void share(const Numbered& one, const Numbered& two, std::uint32_t first, std::uint32_t second, CellFace face, const Between& between);
    std::uint32_t crossing_node(const OverlapCorner& corner, const Between& between);
    void add(std::uint32_t first, std::uint32_t second, CellFace side);
    std::vector<std::uint32_t> joined_crossings() const;
    void join_crossings();
    void end_plane();

    const CornerPointGrid& grid_;
    std::span<const std::uint8_t> present_;
    const PillarNodes& nodes_;
    PlaneRow row_;
    CrossingTable table_;                             // of the plane at hand, as are:
    std::size_t plane_points_ = 0, plane_faces_ = 0;  // where its points and faces start
    PairSides sides_;
    std::vector<SideNodes> first_nodes_, second_nodes_;
    std::vector<Numbered> voids_;
    std::vector<std::uint32_t> polygon_;
};

}  // namespace geomend::grid
