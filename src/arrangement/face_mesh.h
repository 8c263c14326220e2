// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "geometry/triangle_pair.h"

namespace geomend::arrangement {

/// The triangulation of one cut triangle, seen along the axis that its normal follows most: all turns are exact, so that it
/// stays a valid triangulation whatever the rounding of its points. Delaunay by angles in space, between fixed edges; where
/// four points leave that open, the diagonal at the smallest name: two copies of a polygon are triangulated alike. Flat triangles,
/// which looking through the result again would find, come only where nothing else fits.
class FaceMesh {
public:
    /// Begins anew with one triangle of points 0, 1, 2. \pre they turn counter-clockwise as seen, or the mesh is not usable
    /// \param points in space \param names of the points, for ties \param axis 0..2 that is dropped \param turn +1 or -1
    /// \param ways per point a bit for each side and segment that it stands on: points of one way get no edge past those between, since
    /// what stands on a way may lie off its straight course, and looking through the result again would find it there
    /// \param reach triangles that are not higher than this are avoided, too
    bool begin(std::span<const Vec3> points, std::span<const std::uint32_t> names, std::span<const std::uint64_t> ways, unsigned axis,
               int turn, double reach);

    /// Puts points, in order, on the border from one corner to the next; false, and the mesh is spoilt, where one lies so far off
    /// that a triangle would turn over.
    bool add_on_border(std::uint32_t from, std::uint32_t to, std::span<const std::uint32_t> chain);
    /// False where the point is not strictly inside, or is seen where another one is; then nothing changes.
    bool add_inside(std::uint32_t point);
    /// Makes a segment an edge that stays, or several where it passes through points. False where it cannot, since a fixed edge or
    /// the border is crossed or an end is not in the mesh; then a part of it may be fixed.
    bool fix(std::uint32_t from, std::uint32_t to);

    std::span<const Triangle> triangles() const { return triangles_; }

private:
    struct Place {
        std::uint32_t triangle, edge;
    };
    std::span<const Vec3> points_;
    std::span<const std::uint32_t> names_;
    std::span<const std::uint64_t> ways_;
    unsigned axis_ = 2;
    int turn_ = 1;
    double reach_ = 0;
    std::vector<Triangle> triangles_;
    std::vector<std::array<std::uint32_t, 3>> neighbours_;  ///< across edge corner i -> i + 1
    std::vector<std::array<std::uint8_t, 3>> fixed_;
    std::vector<std::uint32_t> at_;  ///< per point a triangle that has it
    std::vector<Place> stack_;
    std::uint32_t last_ = 0;  ///< where the search for a point begins

    bool is_seen_at(std::uint32_t a, std::uint32_t b) const;
    int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
    std::uint32_t corner_of(std::uint32_t triangle, std::uint32_t point) const;
    void join(std::uint32_t triangle, std::uint32_t edge, std::uint32_t other);
    std::uint32_t edge_towards(std::uint32_t triangle, std::uint32_t other) const;
    void set(std::uint32_t triangle, const Triangle& corners);
    Place find_edge(std::uint32_t from, std::uint32_t to) const;
    void flip(Place place);
    bool can_flip(Place place) const;
    bool wants_flip(Place place) const;
    bool is_flat(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
    int fault_of(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const;
    void settle();
    void split_triangle(std::uint32_t triangle, std::uint32_t point);
    void split_edge(Place place, std::uint32_t point);
    Place first_crossing(std::uint32_t from, std::uint32_t to, std::uint32_t& through) const;
    bool fix_edge(std::uint32_t from, std::uint32_t to);
};

}  // namespace geomend::arrangement
