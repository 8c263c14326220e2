// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/thickness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/principal_axes.h"
#include "geometry/vectors.h"

namespace geomend::topology {

namespace {

/// Twice the area along the normal.
Vec3 area_vector(const std::array<Vec3, 3>& t) { return cross(minus(t[1], t[0]), minus(t[2], t[0])); }

/// The direction that most of the area faces; its eigenvalue is the largest.
Vec3 facing(std::span<const std::array<Vec3, 3>> triangles) {
    std::array<double, 6> tensor{};
    for (const auto& t : triangles) {
        const Vec3 n = area_vector(t);
        const double length = std::sqrt(dot(n, n));
        if (!(length > 0)) continue;
        std::size_t k = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = i; j < 3; ++j) tensor[k++] += n[i] * (n[j] / length);
        }
    }
    return principal_axes(tensor)[2];
}

/// Sums up what is seen of an area along a direction.
class SeenArea {
public:
    explicit SeenArea(const Vec3& up) {
        const std::size_t k = std::abs(up[0]) <= std::abs(up[1]) && std::abs(up[0]) <= std::abs(up[2]) ? 0
                              : std::abs(up[1]) <= std::abs(up[2])                                     ? 1
                                                                                                       : 2;
        Vec3 axis{};
        axis[k] = 1;
        u_ = cross(up, axis);
        u_ = times(1 / std::sqrt(dot(u_, u_)), u_);
        v_ = cross(up, u_);
    }
    void add(const Vec3& at, double weight) {
        const double x = dot(u_, at), y = dot(v_, at);
        weight_ += weight;
        x_ += weight * x;
        y_ += weight * y;
        xx_ += weight * x * x;
        xy_ += weight * x * y;
        yy_ += weight * y * y;
    }
    double sheets() const {
        if (!(weight_ > 0)) return 0;
        const double x = x_ / weight_, y = y_ / weight_;
        const double xx = xx_ / weight_ - x * x, xy = xy_ / weight_ - x * y, yy = yy_ / weight_ - y * y;
        const double square = xx * yy - xy * xy;  // of a rectangle a twelfth of the area
        return square > 0 ? weight_ / (12 * std::sqrt(square)) : 0;
    }

private:
    Vec3 u_{}, v_{};
    double weight_ = 0, x_ = 0, y_ = 0, xx_ = 0, xy_ = 0, yy_ = 0;
};

/// Pairs of a length and its weight, in bins of lengths: what several quantiles have in common.
class WeightedLengths {
public:
    /// \pre not empty; the lengths must outlive this
    explicit WeightedLengths(std::span<const std::pair<double, double>> lengths) : lengths_(lengths) {
        for (const auto& [length, weight] : lengths) {
            total_ += weight;
            low_ = std::min(low_, length);
            high_ = std::max(high_, length);
        }
        scale_ = high_ > low_ ? bins / (high_ - low_) : 0;
        for (const auto& [length, weight] : lengths) weights_[bin_of(length)] += weight;
    }

    /// The bin that the quantile lies in, then the members of that bin in order.
    double quantile(double share) const {
        double wanted = share * total_;
        std::size_t bin = 0;
        while (bin + 1 < bins && weights_[bin] <= wanted) wanted -= weights_[bin++];
        while (weights_[bin] == 0 && bin > 0) --bin;  // rounding went past the last
        std::vector<std::pair<double, double>> members;
        for (const auto& length : lengths_) {
            if (bin_of(length.first) == bin) members.push_back(length);
        }
        if (members.empty()) return high_;  // no length has a weight
        std::ranges::sort(members);
        for (const auto& [length, weight] : members) {
            if (wanted < weight) return length;
            wanted -= weight;
        }
        return members.back().first;
    }

private:
    static constexpr std::size_t bins = 1024;
    std::span<const std::pair<double, double>> lengths_;
    double total_ = 0, low_ = HUGE_VAL, high_ = -HUGE_VAL, scale_ = 0;
    std::array<double, bins> weights_{};

    std::size_t bin_of(double length) const {
        const double bin = scale_ * (length - low_);
        return bin >= 0 ? static_cast<std::size_t>(std::min(bin, bins - 1.0)) : std::size_t{0};  // no number where the scale overflows
    }
};

}  // namespace

double weighted_quantile(std::span<const std::pair<double, double>> lengths, double share) {
    return WeightedLengths(lengths).quantile(share);
}

Slab slab_of(std::span<const std::array<Vec3, 3>> triangles) {
    constexpr double outer = 0.05;  // share of the area on either side
    Slab slab;
    if (triangles.empty()) return slab;
    const Vec3 up = facing(triangles);
    const Vec3& origin = triangles[0][0];
    std::vector<std::pair<double, double>> heights;  // of the middles of edges, by which a triangle has its first two moments
    heights.reserve(3 * triangles.size());
    SeenArea seen(up);
    for (const auto& t : triangles) {
        const Vec3 n = area_vector(t);
        const double area = 0.5 * std::sqrt(dot(n, n)), ahead = 0.5 * std::abs(dot(n, up));
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 middle = times(0.5, plus(minus(t[k], origin), minus(t[(k + 1) % 3], origin)));
            heights.emplace_back(dot(up, middle), area / 3);
            seen.add(middle, ahead / 3);
        }
    }
    const WeightedLengths spread(heights);
    slab.thickness = spread.quantile(1 - outer) - spread.quantile(outer);
    slab.sheets = seen.sheets();
    return slab;
}

double flatness(const Slab& slab, double diameter) {
    constexpr double thin = 0.2, thinnest = 0.01, all_body = 1.5;
    if (!(diameter > 0) || !(slab.thickness < thin * diameter)) return 1;
    const double body = std::clamp((slab.sheets - 1) / (all_body - 1), 0.0, 1.0);
    return std::pow(std::max(thinnest, slab.thickness / diameter / thin), body);
}

}  // namespace geomend::topology
