// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/horizon/ijxyz_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace geomend::horizon {

namespace {

constexpr double missing_height = 9999900;

struct Range {
    std::int64_t first = 0, step = 1;
    std::uint64_t count = 1;

    std::uint64_t index(std::int64_t number) const { return static_cast<std::uint64_t>((number - first) / step); }
};

/// First number, largest common step and how many steps there are. \pre numbers is not empty
Range range_of(std::vector<std::int64_t> numbers) {
    std::ranges::sort(numbers);
    Range range{numbers.front(), 0, 1};
    for (const std::int64_t n : numbers) range.step = std::gcd(range.step, n - numbers.front());
    if (range.step == 0) range.step = 1;
    range.count = static_cast<std::uint64_t>((numbers.back() - range.first) / range.step) + 1;
    return range;
}

/// x and y as a plane over the two indices, by least squares about their means.
struct Plane {
    double i0 = 0, j0 = 0;
    std::array<double, 2> mean{}, along_i{}, along_j{};

    std::array<double, 2> at(double i, double j) const {
        return {mean[0] + (i - i0) * along_i[0] + (j - j0) * along_j[0], mean[1] + (i - i0) * along_i[1] + (j - j0) * along_j[1]};
    }
};

std::optional<Plane> plane_through(std::span<const LineSample> samples, const Range& is, const Range& js) {
    Plane plane;
    const auto n = static_cast<double>(samples.size());
    for (const LineSample& s : samples) {
        plane.i0 += static_cast<double>(is.index(s.i)) / n;
        plane.j0 += static_cast<double>(js.index(s.j)) / n;
        for (std::size_t axis = 0; axis < 2; ++axis) plane.mean[axis] += s.position[axis] / n;
    }
    double ii = 0, ij = 0, jj = 0;
    std::array<double, 2> ip{}, jp{};
    for (const LineSample& s : samples) {
        const double i = static_cast<double>(is.index(s.i)) - plane.i0, j = static_cast<double>(js.index(s.j)) - plane.j0;
        ii += i * i;
        ij += i * j;
        jj += j * j;
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const double p = s.position[axis] - plane.mean[axis];
            ip[axis] += i * p;
            jp[axis] += j * p;
        }
    }
    const double determinant = ii * jj - ij * ij;
    if (!(determinant > 1e-9 * ii * jj)) return std::nullopt;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        plane.along_i[axis] = (jj * ip[axis] - ij * jp[axis]) / determinant;
        plane.along_j[axis] = (ii * jp[axis] - ij * ip[axis]) / determinant;
    }
    return plane;
}

}  // namespace

std::optional<LatticeMap> lattice_of_samples(std::span<const LineSample> samples, std::string& why) {
    if (samples.size() < 3) {
        why = "there are fewer than three samples";
        return std::nullopt;
    }
    std::vector<std::int64_t> numbers(samples.size());
    std::ranges::transform(samples, numbers.begin(), &LineSample::i);
    const Range is = range_of(numbers);
    std::ranges::transform(samples, numbers.begin(), &LineSample::j);
    const Range js = range_of(numbers);
    constexpr std::uint64_t most_missing = 100;  // samples of the lattice for one of the file
    if (is.count > most_missing * samples.size() || js.count > most_missing * samples.size() ||
        is.count * js.count > most_missing * samples.size()) {
        why = "the numbers of lines span more than a hundred times as many samples";
        return std::nullopt;
    }
    const auto plane = plane_through(samples, is, js);
    if (!plane) {
        why = "all samples lie on one line";
        return std::nullopt;
    }
    LatticeMap map;
    for (const LineSample& s : samples) {
        const auto at = plane->at(static_cast<double>(is.index(s.i)), static_cast<double>(js.index(s.j)));
        map.moved = std::max(map.moved, std::hypot(at[0] - s.position[0], at[1] - s.position[1]));
    }
    const double step = std::min(std::hypot(plane->along_i[0], plane->along_i[1]), std::hypot(plane->along_j[0], plane->along_j[1]));
    constexpr double share = 0.01;
    if (!(map.moved <= share * step)) {
        why = "x and y do not follow from the numbers of lines";
        return std::nullopt;
    }
    Raster& raster = map.raster;
    raster.dims = {static_cast<std::uint32_t>(is.count), static_cast<std::uint32_t>(js.count), 1};
    const auto origin = plane->at(0, 0);
    raster.origin = {origin[0], origin[1], 0};
    raster.step = {{{plane->along_i[0], plane->along_i[1], 0}, {plane->along_j[0], plane->along_j[1], 0}, {0, 0, 1}}};
    std::vector<double> heights(is.count * js.count, missing_height);
    std::vector<bool> taken(heights.size(), false);
    for (const LineSample& s : samples) {
        const std::uint64_t at = js.index(s.j) * is.count + is.index(s.i);
        if (taken[at]) {
            why = "two samples have the same numbers of lines";
            return std::nullopt;
        }
        taken[at] = true;
        heights[at] = s.position[2];
    }
    Attribute height;
    height.name = "height";
    height.no_data = missing_height;
    height.values = std::move(heights);
    raster.info.attributes.push_back(std::move(height));
    raster.height_attribute = 0;
    return map;
}

}  // namespace geomend::horizon
