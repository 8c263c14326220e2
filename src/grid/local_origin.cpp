// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/local_origin.h"

#include <algorithm>
#include <cmath>

#include "grid/map_axes.h"

namespace geomend::grid {

namespace {

using Pair = std::array<double, 2>;

// From the grid to the map: origin + scale (x u + y v).
struct Placement {
    Pair origin{0, 0}, u{1, 0}, v{0, 1};
    double scale = 1;

    Pair to_map(double x, double y) const { return {origin[0] + scale * (x * u[0] + y * v[0]), origin[1] + scale * (x * u[1] + y * v[1])}; }
    Pair to_grid(double x, double y) const {
        const double dx = (x - origin[0]) / scale, dy = (y - origin[1]) / scale, turn = u[0] * v[1] - u[1] * v[0];
        return {(dx * v[1] - dy * v[0]) / turn, (dy * u[0] - dx * u[1]) / turn};
    }
};

Pair direction(double x, double y) {
    const double length = std::hypot(x, y);
    return {x / length, y / length};
}

// Where MAPAXES puts a grid. \pre map axes that apply_map_axes() takes
Placement placed(const std::array<double, 6>& axes, double scale) {
    const auto& [x1, y1, x2, y2, x3, y3] = axes;
    return {{x2, y2}, direction(x3 - x2, y3 - y2), direction(x1 - x2, y1 - y2), scale};
}

// apply_map_axes() knows what cannot be applied: it is asked with a grid of one pillar.
Result<void> check(const CornerPointGrid& grid) {
    CornerPointGrid probe;
    probe.info.name = grid.info.name;
    probe.info.crs.axis_units = grid.info.crs.axis_units;
    probe.map_axes = grid.map_axes;
    probe.map_unit = grid.map_unit;
    probe.map_relative = grid.map_relative;
    probe.cylindrical = grid.cylindrical;
    return apply_map_axes(probe);
}

Result<Placement> placement_of(const CornerPointGrid& grid) {
    if (grid.cylindrical) return unreadable("F013", {}, "grid '" + grid.info.name + "' is cylindrical: it cannot get another origin");
    if (grid.map_relative || !grid.map_axes) return Placement{};
    if (auto fits = check(grid); !fits) return std::move(fits).why();
    const double own = metres(grid.info.crs.axis_units[0]), map = metres(grid.map_unit);
    return placed(*grid.map_axes, own > 0 && map > 0 && grid.map_unit != grid.info.crs.axis_units[0] ? own / map : 1.0);
}

// The box of the pillars on the map, along its axes.
std::array<Pair, 2> map_box(const CornerPointGrid& grid, const Placement& at) {
    std::array<Pair, 2> box{Pair{INFINITY, INFINITY}, Pair{-INFINITY, -INFINITY}};
    for (std::size_t p = 0; p + 2 < grid.pillars.size(); p += 3) {
        const Pair on_map = at.to_map(grid.pillars[p], grid.pillars[p + 1]);
        for (std::size_t d = 0; d < 2; ++d) {
            box[0][d] = std::min(box[0][d], on_map[d]);
            box[1][d] = std::max(box[1][d], on_map[d]);
        }
    }
    return box;
}

bool exact_as_float(double value) { return static_cast<double>(static_cast<float>(value)) == value; }

double round_origin(double middle, double extent) {
    double step = 1;
    while (step * 10 <= extent) step *= 10;
    double origin = std::round(middle / step) * step;
    while (!exact_as_float(origin)) {
        step *= 10;
        origin = std::round(middle / step) * step;
    }
    return origin + 0.0;
}

// Whole numbers up to a million that run as nearly as they can in a direction: best fractions of its slope.
Pair whole_direction(const Pair& u) {
    const bool steep = std::abs(u[1]) > std::abs(u[0]);
    const double slope = steep ? std::abs(u[0] / u[1]) : std::abs(u[1] / u[0]);
    double rest = slope, p = 0, q = 1, last_p = 1, last_q = 0;
    for (int term = 0; term < 40 && rest * 1e12 >= 1; ++term) {
        const double whole = std::floor(1 / rest), next_p = whole * p + last_p, next_q = whole * q + last_q;
        if (next_q > 1e6) break;
        rest = 1 / rest - whole;
        last_p = std::exchange(p, next_p);
        last_q = std::exchange(q, next_q);
        if (std::abs(p / q - slope) < 1e-14) break;
    }
    const double scale = std::max(1.0, std::ceil(1000 / q));
    const double x = std::copysign((steep ? p : q) * scale, u[0]), y = std::copysign((steep ? q : p) * scale, u[1]);
    return {x + 0.0, y + 0.0};
}

double moved_by_rounding(const Placement& exact, const std::array<double, 6>& axes, const std::array<Pair, 2>& box) {
    std::array<double, 6> stored;
    std::ranges::transform(axes, stored.begin(), [](double v) { return static_cast<double>(static_cast<float>(v)); });
    const Placement rounded = placed(stored, exact.scale);
    double worst = 0;
    for (unsigned corner = 0; corner < 4; ++corner) {
        const Pair on_map{box[corner & 1u][0], box[corner >> 1][1]}, local = exact.to_grid(on_map[0], on_map[1]);
        const Pair again = rounded.to_map(local[0], local[1]);
        worst = std::max(worst, std::hypot(again[0] - on_map[0], again[1] - on_map[1]));
    }
    // What is left of an exact answer is the rounding of this very sum.
    const double unit = 8 * 2.3e-16 * std::max({std::abs(box[0][0]), std::abs(box[1][0]), std::abs(box[0][1]), std::abs(box[1][1])});
    return worst <= unit ? 0 : worst;
}

}  // namespace

Result<LocalFrame> local_frame(const CornerPointGrid& grid) {
    const auto at = placement_of(grid);
    if (!at) return at.why();
    const auto box = map_box(grid, *at);
    const double extent = std::max(box[1][0] - box[0][0], box[1][1] - box[0][1]);
    LocalFrame frame;
    for (std::size_t d = 0; d < 2; ++d) frame.origin[d] = round_origin(box[0][d] + (box[1][d] - box[0][d]) / 2, extent);
    const Pair u = whole_direction(at->u), v = whole_direction(at->v);
    frame.map_axes = {frame.origin[0] + v[0], frame.origin[1] + v[1], frame.origin[0],
                      frame.origin[1],        frame.origin[0] + u[0], frame.origin[1] + u[1]};
    return frame;
}

Result<double> move_into(const LocalFrame& frame, CornerPointGrid& grid) {
    const auto from = placement_of(grid);
    if (!from) return from.why();
    const Placement to = placed(frame.map_axes, from->scale);
    const auto box = map_box(grid, *from);
    for (std::size_t p = 0; p + 2 < grid.pillars.size(); p += 3) {
        const Pair on_map = from->to_map(grid.pillars[p], grid.pillars[p + 1]);
        const Pair local = to.to_grid(on_map[0], on_map[1]);
        grid.pillars[p] = local[0];
        grid.pillars[p + 1] = local[1];
    }
    grid.map_axes = frame.map_axes;
    grid.map_relative = false;
    const std::string& unit = grid.info.crs.axis_units[0];
    if (grid.map_unit.empty() && (unit == "METRES" || unit == "FEET" || unit == "CM")) grid.map_unit = unit;
    return moved_by_rounding(to, frame.map_axes, box);
}

}  // namespace geomend::grid
