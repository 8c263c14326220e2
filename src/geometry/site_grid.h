// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace geomend {

/// Points in boxes of equal size, for the nearest one and all within a distance.
class SiteGrid {
public:
    /// The points outlive the grid and are not empty. Cost: linear.
    explicit SiteGrid(std::span<const Vec3> sites);

    /// Number of the nearest site; of several at one distance the lowest.
    std::uint32_t nearest(const Vec3& p) const;
    /// Numbers of all sites at most so far away, ascending.
    void within(const Vec3& p, double distance, std::vector<std::uint32_t>& found) const;

private:
    std::array<std::ptrdiff_t, 3> box_of(const Vec3& p) const;
    template <class Look>
    void ring(const std::array<std::ptrdiff_t, 3>& centre, std::ptrdiff_t r, const Look& look) const;
    template <class Look>
    void box(std::ptrdiff_t i, std::ptrdiff_t j, std::ptrdiff_t k, const Look& look) const;

    std::span<const Vec3> sites_;
    Vec3 low_{};
    double step_ = 1;
    std::array<std::ptrdiff_t, 3> dims_{1, 1, 1};
    std::vector<std::uint32_t> first_, members_;
};

}  // namespace geomend
