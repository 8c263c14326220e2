// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/stress_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace geomend::volumes {
namespace {

using Stress = std::array<double, 6>;

/// n by n by n cubes of six tetrahedra each.
struct Block {
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 4>> cells;

    explicit Block(std::uint32_t n) {
        const auto at = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) { return (k * (n + 1) + j) * (n + 1) + i; };
        for (std::uint32_t k = 0; k <= n; ++k) {
            for (std::uint32_t j = 0; j <= n; ++j) {
                for (std::uint32_t i = 0; i <= n; ++i) points.push_back({1.0 * i, 1.0 * j, 1.0 * k});
            }
        }
        constexpr std::array<std::array<std::size_t, 3>, 6> orders{{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
        for (std::uint32_t c = 0; c < n * n * n; ++c) {
            for (const auto& order : orders) {
                std::array<std::uint32_t, 3> place{c % n, c / n % n, c / n / n};
                std::array<std::uint32_t, 4>& cell = cells.emplace_back();
                cell[0] = at(place[0], place[1], place[2]);
                for (std::size_t s = 0; s < 3; ++s) {
                    ++place[order[s]];
                    cell[s + 1] = at(place[0], place[1], place[2]);
                }
            }
        }
    }
    double height(std::size_t cell) const {
        double sum = 0;
        for (const std::uint32_t v : cells[cell]) sum += points[v][2] / 4;
        return sum;
    }
};

TEST(StressError, UniformStressHasNoneAndSizesStay) {
    const Block block(3);
    const std::vector<Stress> stress(block.cells.size(), Stress{-3, -1, -2, 0.5, 0.25, -0.125});
    const StressField field{block.points, block.cells, stress, {}, {}, 0.25};
    const StressError error = stress_error(field, 0.05);
    EXPECT_LT(error.whole, 1e-14);
    EXPECT_LT(error.largest, 1e-14);
    EXPECT_EQ(error.above, 0u);
    EXPECT_EQ(error.wanted, error.edges);
    for (const SizedPoint& s : sizes_at_points(field, error)) EXPECT_DOUBLE_EQ(s.size, error.edges.front());
}

// The cells at one end have twice the error that each may have: with linear functions their edges become half as long.
TEST(StressError, TwiceTheErrorHalvesTheEdges) {
    const Block block(3);
    std::vector<Stress> stress;
    for (std::size_t c = 0; c < block.cells.size(); ++c) stress.push_back({0, 0, -10 - 0.1 * block.height(c), 0, 0, 0});
    const StressField field{block.points, block.cells, stress, {}, {}, 0.25};
    const StressError any = stress_error(field, 0.05);
    // By_mean is as one by the error that is allowed: with this one it is 2 in the worst cell.
    const auto worst = static_cast<std::size_t>(std::ranges::max_element(any.by_mean) - any.by_mean.begin());
    const StressError twice = stress_error(field, 0.05 * any.by_mean[worst] / 2);
    EXPECT_NEAR(twice.by_mean[worst], 2, 1e-9);
    EXPECT_NEAR(twice.wanted[worst], std::min(0.5, 0.05 * any.by_mean[worst] / 2 / any.by_own_energy[worst]) * twice.edges[worst],
                1e-9 * twice.edges[worst]);
    EXPECT_NEAR(twice.wanted[worst] / twice.edges[worst], 0.5, 0.05);
}

// A stress that is -1 in one cell and -2 in its only neighbour, worked out by hand: the three common points have -1.5, the others what
// their cell has. Of the differences 0, d, d, d (d = 0.5) at corners of a volume V the square integrates to V (3 d^2 + (3 d)^2) / 20.
TEST(StressError, IsWhatOneWorksOutByHand) {
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    const std::vector<std::array<std::uint32_t, 4>> cells{{0, 1, 2, 3}, {1, 2, 3, 4}};
    const std::vector<Stress> stress{{0, 0, -1, 0, 0, 0}, {0, 0, -2, 0, 0, 0}};
    const StressError error = stress_error({points, cells, stress, {}, {}, 0.25}, 0.05);
    EXPECT_NEAR(error.by_own_energy[0], std::sqrt(0.25 * 12 / 20), 1e-12);
    EXPECT_NEAR(error.by_own_energy[1], std::sqrt(0.25 * 12 / 20) / 2, 1e-12);
    const double small = 1.0 / 6, large = 1.0 / 3, energy = small + 4 * large, wrong = (small + large) * 0.15;
    EXPECT_NEAR(error.by_mean[0], std::sqrt(small * 0.15) / (0.05 * std::sqrt((energy + wrong) / 2)), 1e-12);
    EXPECT_NEAR(error.whole, std::sqrt(wrong / (energy + wrong)), 1e-12);
    EXPECT_EQ(error.above, 2u);
    EXPECT_DOUBLE_EQ(error.wanted[0], 0.25 * error.edges[0]);  // no shorter at once
    const std::vector<std::uint32_t> apart{0, 1};
    EXPECT_EQ(stress_error({points, cells, stress, apart, {}, 0.25}, 0.05).largest, 0);  // of two regions: it may jump
}

TEST(StressError, DoesNotDependOnTheScaleOfStressNorOnTheModulus) {
    const Block block(2);
    std::vector<Stress> stress, larger;
    for (std::size_t c = 0; c < block.cells.size(); ++c) {
        stress.push_back({-1, 0.5, -2 - block.height(c), 0.25 * block.height(c), 0, 0.125});
        larger.push_back(stress.back());
        for (double& s : larger.back()) s *= 1e9;
    }
    const std::vector<double> young(block.cells.size(), 3e10);
    const StressError one = stress_error({block.points, block.cells, stress, {}, {}, 0.3}, 0.05);
    const StressError other = stress_error({block.points, block.cells, larger, {}, young, 0.3}, 0.05);
    ASSERT_GT(one.above, 0u);
    for (std::size_t c = 0; c < block.cells.size(); ++c) {
        EXPECT_NEAR(one.by_own_energy[c], other.by_own_energy[c], 1e-9);
        EXPECT_NEAR(one.by_mean[c], other.by_mean[c], 1e-9);
    }
}

}  // namespace
}  // namespace geomend::volumes
