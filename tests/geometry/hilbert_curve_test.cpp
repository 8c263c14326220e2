// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/hilbert_curve.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

namespace geomend {
namespace {

using Cell = std::array<std::uint32_t, 3>;

unsigned steps_between(const Cell& a, const Cell& b) {
    unsigned steps = 0;
    for (std::size_t k = 0; k < 3; ++k) steps += a[k] > b[k] ? a[k] - b[k] : b[k] - a[k];
    return steps;
}

TEST(HilbertCurve, GoesThroughEachCellOfACubeOnceFromACellToOneBesideIt) {
    for (unsigned bits = 1; bits <= 5; ++bits) {
        const std::uint32_t side = 1u << bits;
        std::vector<std::optional<Cell>> cells(std::size_t{side} * side * side);
        for (std::uint32_t x = 0; x < side; ++x) {
            for (std::uint32_t y = 0; y < side; ++y) {
                for (std::uint32_t z = 0; z < side; ++z) {
                    auto& cell = cells.at(hilbert_place({x, y, z}, bits));
                    ASSERT_FALSE(cell);
                    cell = Cell{x, y, z};
                }
            }
        }
        EXPECT_EQ(cells.front(), (Cell{0, 0, 0}));
        for (std::size_t n = 1; n < cells.size(); ++n) ASSERT_EQ(steps_between(*cells[n - 1], *cells[n]), 1u);
    }
}

TEST(HilbertCurve, OfAFinerCubeGoesThroughTheCellsOfACoarserOneInTheSameOrder) {
    for (std::uint32_t n = 0; n < 4096; ++n) {
        const Cell fine{n * 7919u & 0xfffffu, n * 104729u & 0xfffffu, n * 15485863u & 0xfffffu};
        const Cell other{n * 6151u & 0xfffffu, n * 12289u & 0xfffffu, n * 24593u & 0xfffffu};
        const auto coarse_place = [](const Cell& c) { return hilbert_place({c[0] >> 2, c[1] >> 2, c[2] >> 2}, 18); };
        ASSERT_EQ(coarse_place(fine), hilbert_place(fine, 20) >> 6);
        ASSERT_EQ(coarse_place(other), hilbert_place(other, 20) >> 6);
    }
}

}  // namespace
}  // namespace geomend
