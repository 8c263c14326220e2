// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gridding/plan.h"

// Positions of nodes of a net in plan between those that are fixed.

namespace geomend::gridding {

using PlanTriangle = std::array<std::uint32_t, 3>;

/// Half the cotangent of the angle of a triangle at each of its corners: what the edge opposite to it weighs in the Dirichlet energy
/// (Pinkall and Polthier 1993). 0.5, 0.5, 0 for a right isosceles triangle; negative beyond a right angle. \pre not degenerate
std::array<double, 3> half_cotangents(const Point& a, const Point& b, const Point& c);

/// The matrix of the Dirichlet energy of functions on triangles in plan: weights of edges, per vertex and neighbour.
class DirichletWeights {
public:
    DirichletWeights(std::span<const Point> places, std::span<const PlanTriangle> triangles);

    /// Weight of the edge between two vertices; 0 where there is none.
    double weight(std::uint32_t a, std::uint32_t b) const;
    /// Edges whose weight is negative: angles across them are together larger than 180 degrees, and maps may fold.
    std::uint64_t negative() const;
    /// The energy of a function: the sum over triangles of their areas times the square of its gradient.
    double energy(std::span<const double> values) const;
    /// Replaces the values of vertices that are not fixed by the harmonic ones: those of least energy. Conjugate gradients, to 1e-13 of
    /// the largest value. \pre each part that hangs together has a fixed vertex
    void make_harmonic(std::span<const std::uint8_t> fixed, std::span<double> values) const;

private:
    std::vector<std::uint64_t> first_;
    std::vector<std::uint32_t> next_;
    std::vector<double> weights_;
    std::vector<double> sums_;  // per vertex
};

/// The triangles of a net of nx by ny quadrangles, each cut from its first to its third corner.
std::vector<PlanTriangle> net_triangles(std::uint32_t nx, std::uint32_t ny);

/// How right-angled a quadrangle (in cyclic order) is: its least angle by 90 degrees, 1 at most; 0 where it is collapsed or turned over.
double right_angledness(const std::array<Point, 4>& corners);

/// Nodes of a border at several levels, relaxed towards upright columns: each node that is not fixed moves by `step` of its way to the
/// mean, over levels, of the midpoints between its two neighbours, until none moves by more than `enough`. `levels[h][l]` is node l at
/// level h; the border is closed. \pre the same number of nodes at each level. Returns the rounds it took.
std::uint32_t relax_border(std::vector<Path>& levels, std::span<const std::uint8_t> fixed, double step, double enough);

}  // namespace geomend::gridding
