// SPDX-License-Identifier: AGPL-3.0-or-later
// C32: whether cells of local grids lie in the host cells that a file states for them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "validators/checks_testing.h"
#include "validators/local_hosts.h"

namespace geomend {
namespace {

using namespace testing;

/// The host cells (1..2, 1, 0) of a leaning grid, each cut into 2 x 2 x 2, as its reader gives them.
struct Nested {
    CornerPointGrid host = brick_grid(5, 4, 3);
    CornerPointGrid local = brick_grid(4, 2, 2);

    Nested() {
        host.info.name = "main";
        local.info.name = "L1";
        place(host, 0, 0, 100, 10);
        place(local, 100, 100, 50, 5);
        local.host.emplace();
        local.host->first = {1, 1, 0};
        local.host->last = {2, 1, 0};
        for (std::uint32_t k = 0; k < 2; ++k) {
            for (std::uint32_t j = 0; j < 2; ++j) {
                for (std::uint32_t i = 0; i < 4; ++i) local.host->cells.push_back(host.cell(1 + i / 2, 1, 0));
            }
        }
    }

    std::vector<Finding> judge() const {
        std::vector<Finding> findings;
        const std::array<const CornerPointGrid*, 2> grids{&host, &local};
        validators::check_local_hosts(grids, findings);
        return findings;
    }

    /// Bricks of that size from that place on, sheared and dipping, on the map.
    static void place(CornerPointGrid& grid, double x0, double y0, double width, double height) {
        for (std::size_t p = 0; p < grid.pillars.size(); p += 3) {
            const double x = x0 + grid.pillars[p] / 100 * width, y = y0 + grid.pillars[p + 1] / 100 * width, depth = grid.pillars[p + 2];
            const double at = (depth > 1000 ? 1030.0 : 1000.0);
            grid.pillars[p] = 4.5e5 + 0.8 * x - 0.6 * y + 3 * (at - 1000);
            grid.pillars[p + 1] = 6.1e6 + 0.6 * x + 0.8 * y - (at - 1000);
            grid.pillars[p + 2] = at;
        }
        reshape(grid, [&](std::uint32_t i, std::uint32_t j, std::uint32_t k, unsigned c, double) {
            const double x = x0 + width * (i + (c & 1U)), y = y0 + width * (j + ((c >> 1U) & 1U));
            return 1000 + height * (k + (c >> 2U)) + 0.3 * x + 0.1 * y;
        });
    }
};

TEST(LocalHosts, NestedCellsAreInTheirHosts) { EXPECT_TRUE(Nested().judge().empty()); }

TEST(LocalHosts, ACellStatedInTheOneBesideIsNamedWithItsPlaceAndTheCellThatHoldsIt) {
    Nested model;
    model.local.host->cells[1] = model.host.cell(2, 1, 0);  // lies in (2,2,1)
    const auto findings = model.judge();
    const Finding f = find(findings, "C32", Severity::error);
    EXPECT_EQ(cells_of(f), (std::vector<Cell>{{2, 1, 1}}));
    EXPECT_NE(f.message.find("(2,1,1) is stated in (3,2,1)"), std::string::npos) << f.message;
    EXPECT_NE(f.message.find("lies in (2,2,1)"), std::string::npos) << f.message;
    ASSERT_EQ(f.points.size(), 1u);
    EXPECT_NEAR(f.points[0][2], -(1000 + 2.5 + 0.3 * 175 + 0.1 * 125), 1e-9) << "the middle of the cell, as an elevation";
    ASSERT_EQ(f.entities.size(), 2u);
    EXPECT_EQ(f.entities[0].name, "L1");
}

TEST(LocalHosts, HostsInAnotherLayerOrRowAreFound) {
    for (const std::array<std::uint32_t, 3> wrong : {std::array<std::uint32_t, 3>{1, 1, 1}, {1, 2, 0}, {0, 1, 0}, {4, 3, 2}}) {
        Nested model;
        for (auto& cell : model.local.host->cells) cell = model.host.cell(wrong[0], wrong[1], wrong[2]);
        EXPECT_EQ(find(model.judge(), "C32", Severity::error).count, 16u) << wrong[0] << wrong[1] << wrong[2];
    }
}

TEST(LocalHosts, CellsThatReachOverWithTheirCentresAreAWarning) {
    Nested model;
    // The upper local layer is moved down by 3 of the host's 10, so that the lower one reaches into the next layer.
    reshape(model.local, [](std::uint32_t, std::uint32_t, std::uint32_t k, unsigned, double depth) { return k == 1 ? depth + 3 : depth; });
    const auto findings = model.judge();
    EXPECT_EQ(find(findings, "C32", Severity::warning).count, 8u);
    EXPECT_EQ(codes_of(findings), (std::set<std::string>{"C32 warning"}));
}

TEST(LocalHosts, InactiveCellsAndCellsWithoutThicknessAreLeftAlone) {
    Nested model;
    model.local.host->cells[1] = model.host.cell(3, 1, 0);
    model.local.activity.assign(model.local.cell_count(), 1);
    model.local.activity[1] = 0;
    reshape(model.local, [&](std::uint32_t i, std::uint32_t j, std::uint32_t k, unsigned c, double depth) {
        return k == 1 && c >= 4 ? corner(model.local, i, j, k, c - 4) : depth;
    });
    EXPECT_TRUE(model.judge().empty());
}

TEST(LocalHosts, WithoutHostsOfCellsTheBoxIsAskedFor) {
    Nested model;
    model.local.host->cells.clear();
    EXPECT_TRUE(model.judge().empty());
    model.local.host->first = {3, 3, 2};
    model.local.host->last = {4, 3, 2};
    const Finding f = find(model.judge(), "C32", Severity::error);
    EXPECT_GT(f.count, 0u);
    EXPECT_NE(f.message.find("is stated in (4,4,3) to (5,4,3)"), std::string::npos) << f.message;
}

}  // namespace
}  // namespace geomend
