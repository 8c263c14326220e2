// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/stress_error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/vectors.h"

namespace geomend::volumes {

namespace {

using Stress = std::array<double, 6>;

constexpr double least_factor = 0.25;          ///< by which edges become shorter at once
constexpr double share_of_mean_energy = 0.01;  ///< below it a cell's own error says nothing

/// Stress by the strain that goes with it: twice the energy in a unit of volume, for a Young's modulus of 1.
double energy(const Stress& s, double poisson) {
    const double normal = s[0] * s[0] + s[1] * s[1] + s[2] * s[2], mixed = s[0] * s[1] + s[1] * s[2] + s[2] * s[0];
    const double shear = s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
    return normal - 2 * poisson * mixed + 2 * (1 + poisson) * shear;
}

std::array<Vec3, 4> corners_of(const StressField& field, std::size_t cell) {
    std::array<Vec3, 4> p{};
    for (std::size_t k = 0; k < 4; ++k) p[k] = field.points[field.cells[cell][k]];
    return p;
}

double volume_of(const std::array<Vec3, 4>& p) { return std::abs(dot(minus(p[1], p[0]), cross(minus(p[2], p[0]), minus(p[3], p[0])))) / 6; }

/// The edge of a regular tetrahedron with a cell's volume, but no less than some of its mean edge where it is flat.
double edge_of(const std::array<Vec3, 4>& p) {
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t m = k + 1; m < 4; ++m) {
            const Vec3 d = minus(p[m], p[k]);
            sum += std::sqrt(dot(d, d));
        }
    }
    return std::max(std::cbrt(6 * std::sqrt(2.0) * volume_of(p)), 0.7 * sum / 6);
}

std::uint32_t group_of(const StressField& field, std::size_t cell) { return field.groups.empty() ? 0 : field.groups[cell]; }

/// The mean stress of the cells around each point, apart by groups.
class NodalStress {
public:
    explicit NodalStress(const StressField& field) : field_(field) {
        for (std::size_t c = 0; c < field.cells.size(); ++c) {
            for (const std::uint32_t v : field.cells[c]) {
                auto& [sum, count] = sums_[{v, group_of(field, c)}];
                for (std::size_t i = 0; i < 6; ++i) sum[i] += field.stress[c][i];
                count += 1;
            }
        }
    }
    /// What a point's stress differs by from that of a cell.
    Stress difference(std::size_t cell, std::size_t corner) const {
        const auto& [sum, count] = sums_.at({field_.cells[cell][corner], group_of(field_, cell)});
        Stress d{};
        for (std::size_t i = 0; i < 6; ++i) d[i] = sum[i] / count - field_.stress[cell][i];
        return d;
    }

private:
    const StressField& field_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<Stress, double>> sums_;
};

/// Twice the energy of a stress that changes linearly between the corners of a cell of volume 1: its square is integrated exactly.
double energy_of_linear(const std::array<Stress, 4>& at, double poisson) {
    Stress sum{};
    double squares = 0;
    for (const Stress& s : at) {
        for (std::size_t i = 0; i < 6; ++i) sum[i] += s[i];
        squares += energy(s, poisson);
    }
    return (squares + energy(sum, poisson)) / 20;
}

}  // namespace

StressError stress_error(const StressField& field, double allowed) {
    const std::size_t count = field.cells.size();
    const NodalStress nodal(field);
    StressError result;
    std::vector<double> own(count), error(count), volumes(count);
    double all = 0, all_error = 0, volume = 0;
    for (std::size_t c = 0; c < count; ++c) {
        const auto corners = corners_of(field, c);
        std::array<Stress, 4> differences{};
        for (std::size_t k = 0; k < 4; ++k) differences[k] = nodal.difference(c, k);
        volumes[c] = volume_of(corners);
        const double by = volumes[c] / (field.young.empty() ? 1 : field.young[c]);
        own[c] = by * energy(field.stress[c], field.poisson);
        error[c] = by * energy_of_linear(differences, field.poisson);
        all += own[c];
        all_error += error[c];
        volume += volumes[c];
        result.edges.push_back(edge_of(corners));
    }
    if (count == 0) return result;
    const double mean = allowed * std::sqrt((all + all_error) / static_cast<double>(count));
    for (std::size_t c = 0; c < count; ++c) {
        const double eta = error[c] > 0 ? std::sqrt(error[c] / own[c]) : 0, xi = error[c] > 0 ? std::sqrt(error[c]) / mean : 0;
        const bool has_energy = own[c] * volume >= share_of_mean_energy * all * volumes[c] && all > 0;
        if (!has_energy && error[c] > 0) ++result.without_energy;
        if (has_energy) result.largest = std::max(result.largest, eta);
        if (has_energy && eta > allowed) ++result.above;
        result.by_own_energy.push_back(eta);
        result.by_mean.push_back(xi);
        const double times = std::max({1.0, xi, has_energy ? eta / allowed : 0});
        result.wanted.push_back(result.edges[c] * std::max(least_factor, 1 / times));
    }
    result.whole = all > 0 ? std::sqrt(all_error / (all + all_error)) : 0;
    return result;
}

std::vector<SizedPoint> sizes_at_points(const StressField& field, const StressError& error) {
    std::vector<double> least(field.points.size(), HUGE_VAL);
    for (std::size_t c = 0; c < field.cells.size(); ++c) {
        for (const std::uint32_t v : field.cells[c]) least[v] = std::min(least[v], error.wanted[c]);
    }
    std::vector<SizedPoint> sizes;
    for (std::size_t v = 0; v < least.size(); ++v) {
        if (least[v] != HUGE_VAL) sizes.push_back({field.points[v], least[v]});
    }
    return sizes;
}

}  // namespace geomend::volumes
