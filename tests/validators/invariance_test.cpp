// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <map>

#include "validators/checks_testing.h"

// What is wrong with a grid does not depend on where it stands, in which unit it is measured, or how it is turned.

namespace geomend {
namespace {

using namespace testing;

// A grid with something for most checks.
CornerPointGrid ailing_grid() {
    CornerPointGrid grid = brick_grid(6, 5, 4);
    add_throw(grid, 3, 12.5);
    for (unsigned c = 0; c < 4; ++c) std::swap(corner(grid, 0, 0, 1, c), corner(grid, 0, 0, 1, c + 4));  // C03
    corner(grid, 5, 4, 3, 4) -= 15;                                                                      // C03, twisted
    for (unsigned c = 4; c < 8; ++c) corner(grid, 1, 3, 0, c) += 3;                                      // C04 overlap
    for (unsigned c = 4; c < 8; ++c) corner(grid, 4, 3, 1, c) -= 2;                                      // C04 gap
    for (unsigned c = 0; c < 4; ++c) corner(grid, 2, 2, 2, c) = corner(grid, 2, 2, 2, c + 4);            // C05
    corner(grid, 2, 4, 0, 1) = corner(grid, 2, 4, 0, 5);                                                 // C06
    move_pillar(grid, 0, 5, 70, -75);                                                                    // C07, C08
    pillar(grid, 6, 2)[3] -= 130;                                                                        // C11
    grid.activity.assign(grid.cell_count(), 1);
    for (const std::size_t cell : {1u, 31u, 6u, 36u}) grid.activity[cell] = 0;  // (1,1,1) is alone
    return grid;
}

using Cells = std::multimap<std::string, std::vector<Cell>>;

Cells found_in(const CornerPointGrid& grid, const std::set<std::string>& without) {
    Cells all;
    for (const Finding& f : findings_of(grid)) {
        if (!without.contains(f.code)) all.emplace(f.code + std::to_string(static_cast<int>(f.severity)), cells_of(f));
    }
    return all;
}

template <class Change>
CornerPointGrid changed(CornerPointGrid grid, const Change& change) {
    for (std::size_t p = 0; p < grid.pillars.size(); p += 3) change(grid.pillars[p], grid.pillars[p + 1], grid.pillars[p + 2]);
    for (double& z : grid.depths) {
        double x = 0, y = 0;
        change(x, y, z);
    }
    return grid;
}

TEST(ChecksOfAnAilingGrid, FindManyThings) {
    const Cells found = found_in(ailing_grid(), {});
    std::set<std::string> codes;
    for (const auto& [code, cells] : found) codes.insert(code.substr(0, 3));
    EXPECT_EQ(codes, (std::set<std::string>{"C03", "C04", "C05", "C06", "C07", "C08", "C11", "C17", "C18", "C21"}));
}

TEST(ChecksOfAnAilingGrid, AreTheSameAfterAShiftToMapCoordinates) {
    const CornerPointGrid there = changed(ailing_grid(), [](double& x, double& y, double& z) {
        x += 456000;
        y += 5930000;
        z += 2048;
    });
    EXPECT_EQ(found_in(there, {"C19"}), found_in(ailing_grid(), {"C19"}));
}

TEST(ChecksOfAnAilingGrid, AreTheSameInOtherUnits) {
    for (const double factor : {1e-3, 1e3, 0.3048}) {
        const CornerPointGrid there = changed(ailing_grid(), [&](double& x, double& y, double& z) {
            x *= factor;
            y *= factor;
            z *= factor;
        });
        EXPECT_EQ(found_in(there, {"C19"}), found_in(ailing_grid(), {"C19"})) << factor;
    }
}

TEST(ChecksOfAnAilingGrid, AreTheSameWhenTurned) {
    const CornerPointGrid there = changed(ailing_grid(), [](double& x, double& y, double&) {
        const double u = 0.6 * x - 0.8 * y, v = 0.8 * x + 0.6 * y;
        x = u;
        y = v;
    });
    EXPECT_EQ(found_in(there, {"C19"}), found_in(ailing_grid(), {"C19"}));
}

TEST(ChecksOfAnAilingGrid, AreTheSameWhenMirrored) {
    const CornerPointGrid there = changed(ailing_grid(), [](double&, double& y, double&) { y = -y; });
    EXPECT_EQ(found_in(there, {"C12", "C19"}), found_in(ailing_grid(), {"C12", "C19"})) << "but for the hand of the whole grid";
}

}  // namespace
}  // namespace geomend
