// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/horizon/lattice_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/text_cursor.h"

namespace geomend::horizon {

namespace {

Vec3 frame_position(const GridFrame& frame, double i, double j) {
    const auto steps = steps_of(frame);
    return {frame.x0 + i * steps[0][0] + j * steps[1][0], frame.y0 + i * steps[0][1] + j * steps[1][1], 0};
}

double distance(const Vec3& a, const Vec3& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// Step vectors of a raster; those of evenly spaced coordinates where it has any. Directions with one sample have
/// any step: the one that suits is across the other.
std::optional<std::array<Vec3, 2>> raster_steps(const Raster& raster) {
    std::array<Vec3, 2> steps{raster.step[0], raster.step[1]};
    if (!raster.coordinates[0].empty()) {
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const auto& c = raster.coordinates[axis];
            const double step = c.size() > 1 ? (c.back() - c.front()) / static_cast<double>(c.size() - 1) : 1;
            const double slack = 4 * std::numeric_limits<double>::epsilon() * std::max(std::abs(c.front()), std::abs(c.back()));
            for (std::size_t i = 0; i < c.size(); ++i) {
                if (std::abs(c.front() + static_cast<double>(i) * step - c[i]) > slack) return std::nullopt;
            }
            steps[axis] = {axis == 0 ? step : 0, axis == 1 ? step : 0, 0};
        }
    }
    const auto across = [](const Vec3& other, double sign) { return Vec3{-sign * other[1], sign * other[0], 0}; };
    if (raster.dims[0] == 1 && raster.dims[1] == 1) return std::array<Vec3, 2>{{{1, 0, 0}, {0, 1, 0}}};
    if (raster.dims[0] == 1) steps[0] = across(steps[1], -1);
    if (raster.dims[1] == 1) steps[1] = across(steps[0], 1);
    return steps;
}

/// The numbers that a file stated, where they still give these very steps.
std::optional<GridFrame> stated_frame(const Raster& raster, const std::array<Vec3, 2>& steps) {
    for (const Annotation& a : raster.info.annotations) {
        if (a.key != "horizon.frame") continue;
        TextCursor cursor(a.value);
        GridFrame frame;
        if (!cursor.next_line() || cursor.real(frame.xinc) != NumberStatus::ok || cursor.real(frame.yinc) != NumberStatus::ok ||
            cursor.real(frame.rotation) != NumberStatus::ok) {
            continue;
        }
        if (steps_of(frame) == steps) return frame;
    }
    return std::nullopt;
}

GridFrame computed_frame(const std::array<Vec3, 2>& steps) {
    GridFrame frame;
    frame.xinc = std::hypot(steps[0][0], steps[0][1]);
    const double turn = steps[0][0] * steps[1][1] - steps[0][1] * steps[1][0];
    frame.yinc = std::copysign(std::hypot(steps[1][0], steps[1][1]), turn);
    frame.rotation = std::atan2(steps[0][1], steps[0][0]) * 180 / std::numbers::pi;
    if (frame.rotation < 0) frame.rotation += 360;
    return frame;
}

/// Axes along x and y, with positive steps: samples are listed another way round where needed.
bool align(const Raster& raster, const std::array<Vec3, 2>& steps, LatticeFit& fit) {
    const bool plain = steps[0][1] == 0 && steps[1][0] == 0;
    const bool crossed = steps[0][0] == 0 && steps[1][1] == 0;
    if (!plain && !crossed) return false;
    fit.transposed = !plain;
    for (std::size_t side = 0; side < 2; ++side) {
        const std::size_t direction = fit.transposed ? 1 - side : side;
        const double step = steps[direction][side];
        fit.direction[side] = step < 0 ? -1 : 1;
        fit.first[direction] = step < 0 ? raster.dims[direction] - 1 : 0;
        (side == 0 ? fit.frame.xinc : fit.frame.yinc) = std::abs(step);
        (side == 0 ? fit.frame.nx : fit.frame.ny) = raster.dims[direction];
    }
    return true;
}

std::array<std::uint32_t, 2> raster_indices(const LatticeFit& fit, std::uint32_t i, std::uint32_t j) {
    const std::array<std::uint32_t, 2> along = fit.transposed ? std::array{j, i} : std::array{i, j};
    std::array<std::uint32_t, 2> index{};
    for (std::size_t d = 0; d < 2; ++d) {
        const int way = fit.direction[fit.transposed ? 1 - d : d];
        index[d] = way > 0 ? fit.first[d] + along[d] : fit.first[d] - along[d];
    }
    return index;
}

}  // namespace

std::size_t LatticeFit::sample(const Raster& raster, std::uint32_t i, std::uint32_t j) const {
    const auto index = raster_indices(*this, i, j);
    return std::size_t{index[1]} * raster.dims[0] + index[0];
}

std::optional<LatticeFit> fit_lattice(const Raster& raster, bool rotation_allowed, std::string& why) {
    if (raster.dims[2] != 1) {
        why = "it has more than one layer of samples";
        return std::nullopt;
    }
    const auto steps = raster_steps(raster);
    if (!steps) {
        why = "its samples are not evenly spaced";
        return std::nullopt;
    }
    LatticeFit fit;
    if (!align(raster, *steps, fit)) {
        if (!rotation_allowed) {
            why = "its axes do not lie along x and y";
            return std::nullopt;
        }
        const auto stated = stated_frame(raster, *steps);
        fit.frame = stated ? *stated : computed_frame(*steps);
        fit.frame.nx = raster.dims[0];
        fit.frame.ny = raster.dims[1];
    } else if (rotation_allowed) {
        if (const auto stated = stated_frame(raster, *steps)) {
            fit = {};
            fit.frame = *stated;
            fit.frame.nx = raster.dims[0];
            fit.frame.ny = raster.dims[1];
        }
    }
    const Vec3 origin = sample_position(raster, fit.first[0], fit.first[1], 0);
    fit.frame.x0 = origin[0];
    fit.frame.y0 = origin[1];
    if (fit.frame.xinc == 0 || fit.frame.yinc == 0) {
        why = "its samples lie upon each other";
        return std::nullopt;
    }
    double largest = 0;
    for (unsigned corner = 0; corner < 4; ++corner) {
        const std::uint32_t i = (corner & 1) != 0 ? fit.frame.nx - 1 : 0, j = (corner & 2) != 0 ? fit.frame.ny - 1 : 0;
        const auto index = raster_indices(fit, i, j);
        const Vec3 p = sample_position(raster, index[0], index[1], 0);
        largest = std::max({largest, std::abs(p[0]), std::abs(p[1])});
        fit.moved = std::max(fit.moved, distance(p, frame_position(fit.frame, i, j)));
    }
    fit.tolerance = 4 * std::numeric_limits<double>::epsilon() * largest;
    if (fit.moved > fit.tolerance) {
        why = "its axes are not at right angles";
        return std::nullopt;
    }
    return fit;
}

double corner_distance(const GridFrame& a, const GridFrame& b) {
    double moved = 0;
    for (unsigned corner = 0; corner < 4; ++corner) {
        const double i = (corner & 1) != 0 ? a.nx - 1.0 : 0, j = (corner & 2) != 0 ? a.ny - 1.0 : 0;
        moved = std::max(moved, distance(frame_position(a, i, j), frame_position(b, i, j)));
    }
    return moved;
}

}  // namespace geomend::horizon
