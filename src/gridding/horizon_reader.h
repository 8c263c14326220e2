// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gridding/structure.h"

// Depths of horizons below places in plan. Both readers have the same functions, so that one piece of code uses either.

namespace geomend::gridding {

/// A depth of a horizon, and the pieces of it (samples of a map, a triangle of a sheet) that it was worked out from.
struct Hit {
    double depth = 0;
    std::array<std::uint32_t, 4> pieces{};
    unsigned count = 0;
};

/// A piece of a horizon and where its middle is.
struct Piece {
    std::uint32_t number = 0;
    Vec3 at{};
};

/// Bilinear between the samples of a map. The map outlives its reader.
class MapReader {
public:
    explicit MapReader(const HorizonMap& map);
    /// One depth, or none where samples that count have none.
    void hits(const Point& p, std::vector<Hit>& found) const;
    /// Whether the horizon reaches a place, be it torn there.
    bool covers(const Point& p) const;
    /// The samples with depths not farther from a place than `reach`.
    void near(const Point& p, double reach, std::vector<Piece>& found) const;
    Vec3 middle(std::uint32_t piece) const;
    /// Nothing: samples are not met by lines.
    std::optional<double> crossing(std::uint32_t, const double*) const { return std::nullopt; }
    /// The corners of a piece: its own place.
    std::span<const Vec3> corners(std::uint32_t piece, std::array<Vec3, 3>& room) const;
    double step() const { return step_; }
    /// The largest extent of a piece in plan.
    double widest() const { return widest_; }

private:
    const HorizonMap& map_;
    std::array<Point, 2> inverse_{};  // rows of the inverse of the steps
    double step_ = 0, widest_ = 0;
    std::array<double, 2> lattice(const Point& p) const;
};

/// The triangles of a sheet above and below a place. The sheet outlives its reader. Cost to make: linear in triangles.
class SheetReader {
public:
    explicit SheetReader(const Sheet& sheet);
    /// All depths, ascending; equal ones once for each triangle. Triangles that stand upright give none.
    void hits(const Point& p, std::vector<Hit>& found) const;
    /// The depth at which a pillar (six values) passes through a triangle, its border included; rounding may put it beside.
    std::optional<double> crossing(std::uint32_t piece, const double* pillar) const;
    /// Whether a place lies in the hull of the sheet.
    bool covers(const Point& p) const;
    void near(const Point& p, double reach, std::vector<Piece>& found) const;
    Vec3 middle(std::uint32_t piece) const;
    std::span<const Vec3> corners(std::uint32_t piece, std::array<Vec3, 3>& room) const;
    double step() const { return step_; }
    /// The largest extent of a piece in plan.
    double widest() const { return widest_; }

private:
    const Sheet& sheet_;
    Path hull_;  // closed
    Point low_{};
    double bin_ = 1, step_ = 0, widest_ = 0;
    std::array<std::uint32_t, 2> bins_{1, 1};
    std::vector<std::uint64_t> first_by_box_, first_by_middle_;
    std::vector<std::uint32_t> by_box_, by_middle_;
    std::uint32_t bin_of(double x, std::size_t axis) const;
};

}  // namespace geomend::gridding
