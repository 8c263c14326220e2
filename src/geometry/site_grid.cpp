// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/site_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geomend {

namespace {

double squared_distance(const Vec3& a, const Vec3& b) {
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
}

}  // namespace

SiteGrid::SiteGrid(std::span<const Vec3> sites) : sites_(sites), low_(sites.front()) {
    Vec3 high = low_;
    for (const Vec3& s : sites) {
        for (std::size_t a = 0; a < 3; ++a) {
            low_[a] = std::min(low_[a], s[a]);
            high[a] = std::max(high[a], s[a]);
        }
    }
    // About two sites in a box; flat and long clouds have boxes along what they extend in only.
    double extent = 1;
    int directions = 0;
    const double longest = std::max({high[0] - low_[0], high[1] - low_[1], high[2] - low_[2]});
    for (std::size_t a = 0; a < 3; ++a) {
        if (high[a] - low_[a] <= 1e-6 * longest) continue;
        extent *= high[a] - low_[a];
        ++directions;
    }
    if (directions > 0) step_ = std::pow(extent * 2 / static_cast<double>(sites.size()), 1.0 / directions);
    step_ = std::max({step_, longest / 1000, std::numeric_limits<double>::min()});
    for (std::size_t a = 0; a < 3; ++a) dims_[a] = static_cast<std::ptrdiff_t>((high[a] - low_[a]) / step_) + 1;

    first_.assign(static_cast<std::size_t>(dims_[0] * dims_[1] * dims_[2]) + 1, 0);
    const auto number = [&](const Vec3& s) {
        const auto b = box_of(s);
        return static_cast<std::size_t>(b[0] + dims_[0] * (b[1] + dims_[1] * b[2]));
    };
    for (const Vec3& s : sites) ++first_[number(s) + 1];
    for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
    members_.resize(sites.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t s = 0; s < sites.size(); ++s) members_[next[number(sites[s])]++] = s;
}

// Of points outside the box that is nearest.
std::array<std::ptrdiff_t, 3> SiteGrid::box_of(const Vec3& p) const {
    std::array<std::ptrdiff_t, 3> b;
    for (std::size_t a = 0; a < 3; ++a) {
        const double at = std::clamp((p[a] - low_[a]) / step_, 0.0, static_cast<double>(dims_[a] - 1));
        b[a] = static_cast<std::ptrdiff_t>(at);
    }
    return b;
}

template <class Look>
void SiteGrid::box(std::ptrdiff_t i, std::ptrdiff_t j, std::ptrdiff_t k, const Look& look) const {
    const auto b = static_cast<std::size_t>(i + dims_[0] * (j + dims_[1] * k));
    for (std::uint32_t m = first_[b]; m < first_[b + 1]; ++m) look(members_[m]);
}

// The boxes r steps away from a box, in any direction.
template <class Look>
void SiteGrid::ring(const std::array<std::ptrdiff_t, 3>& c, std::ptrdiff_t r, const Look& look) const {
    const auto from = [&](std::size_t a) { return std::max<std::ptrdiff_t>(0, c[a] - r); };
    const auto to = [&](std::size_t a) { return std::min(dims_[a] - 1, c[a] + r); };
    for (std::ptrdiff_t k = from(2); k <= to(2); ++k) {
        for (std::ptrdiff_t j = from(1); j <= to(1); ++j) {
            const bool shell = std::abs(k - c[2]) == r || std::abs(j - c[1]) == r;
            if (shell) {
                for (std::ptrdiff_t i = from(0); i <= to(0); ++i) box(i, j, k, look);
            } else {
                if (c[0] - r >= 0) box(c[0] - r, j, k, look);
                if (r > 0 && c[0] + r < dims_[0]) box(c[0] + r, j, k, look);
            }
        }
    }
}

std::uint32_t SiteGrid::nearest(const Vec3& p) const {
    const auto centre = box_of(p);
    double best = std::numeric_limits<double>::max();
    std::uint32_t found = members_.front();
    const std::ptrdiff_t last = std::max({dims_[0], dims_[1], dims_[2]});
    for (std::ptrdiff_t r = 0; r <= last; ++r) {
        ring(centre, r, [&](std::uint32_t s) {
            const double d = squared_distance(p, sites_[s]);
            if (d < best || (d == best && s < found)) {
                best = d;
                found = s;
            }
        });
        // What is in the next ring is at least as far as the walls of this one. A point outside lies beyond them.
        double wall = std::numeric_limits<double>::max();
        for (std::size_t a = 0; a < 3; ++a) {
            const double below = p[a] - (low_[a] + static_cast<double>(centre[a] - r) * step_);
            const double above = low_[a] + static_cast<double>(centre[a] + r + 1) * step_ - p[a];
            if (centre[a] - r > 0) wall = std::min(wall, std::max(0.0, below));
            if (centre[a] + r + 1 < dims_[a]) wall = std::min(wall, std::max(0.0, above));
        }
        if (best < wall * wall) break;
    }
    return found;
}

void SiteGrid::within(const Vec3& p, double distance, std::vector<std::uint32_t>& found) const {
    found.clear();
    const auto first = box_of({p[0] - distance, p[1] - distance, p[2] - distance});
    const auto last = box_of({p[0] + distance, p[1] + distance, p[2] + distance});
    for (std::ptrdiff_t k = first[2]; k <= last[2]; ++k) {
        for (std::ptrdiff_t j = first[1]; j <= last[1]; ++j) {
            for (std::ptrdiff_t i = first[0]; i <= last[0]; ++i) {
                box(i, j, k, [&](std::uint32_t s) {
                    if (squared_distance(p, sites_[s]) <= distance * distance) found.push_back(s);
                });
            }
        }
    }
    std::ranges::sort(found);
}

}  // namespace geomend
