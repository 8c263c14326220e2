// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>

#include "gridding/chains.h"
#include "gridding/made_models.h"
#include "gridding/split.h"

namespace geomend::gridding {
namespace {

using namespace test;

RC_GTEST_PROP(GriddingProperty, ChainsAreConnectedAndNearTheirTraces, ()) {
    const std::uint32_t nx = *rc::gen::inRange(3u, 25u), ny = *rc::gen::inRange(3u, 25u);
    const Net pillars = net(nx, ny, 40, 60, *rc::gen::inRange(0, 90));
    std::vector<Path> traces;
    for (int t = *rc::gen::inRange(1, 4); t > 0; --t) {
        Path trace;
        for (int n = *rc::gen::inRange(2, 5); n > 0; --n)
            trace.push_back({static_cast<double>(*rc::gen::inRange(-1000, 1500)), static_cast<double>(*rc::gen::inRange(-500, 2000))});
        traces.push_back(std::move(trace));
    }
    const auto made = make_chains(pillars, traces, 0);
    for (const Chain& chain : made.chains) {
        RC_ASSERT(chain.pillars.empty() == !chain.why_not.empty());
        std::set<std::uint32_t> seen;
        for (std::size_t k = 0; k < chain.pillars.size(); ++k) {
            RC_ASSERT(seen.insert(chain.pillars[k]).second);
            if (k == 0) continue;
            const std::uint32_t a = std::min(chain.pillars[k - 1], chain.pillars[k]), b = std::max(chain.pillars[k - 1], chain.pillars[k]);
            RC_ASSERT((b - a == 1 && a % (nx + 1) != nx) || b - a == nx + 1);
        }
        RC_ASSERT(chain.max_deviation <= 3.2 * 60);
        RC_ASSERT(chain.mean_deviation <= chain.max_deviation + 1e-9);
    }
    // Columns on both sides of an edge without a fault are in one block.
    const auto blocks = fault_blocks(pillars, made.edges);
    for (std::uint32_t j = 0; j < ny; ++j) {
        for (std::uint32_t i = 1; i < nx; ++i) {
            if (made.edges.along_j[i + (nx + 1) * j] == ChainEdges::no_fault)
                RC_ASSERT(blocks.of[pillars.column(i, j)] == blocks.of[pillars.column(i - 1, j)]);
        }
    }
    const auto split = split_pillars(pillars, made.edges);
    const auto graph = node_graph(pillars, split);
    for (std::uint32_t n = 0; n < split.node_count(); ++n) {
        for (const std::uint32_t m : graph.of(n)) RC_ASSERT(std::ranges::find(graph.of(m), n) != graph.of(m).end());
    }
}

RC_GTEST_PROP(GriddingProperty, CellsNeverTurnOverAndHorizonsAreMet, ()) {
    const auto number = [](int least, int most) { return *rc::gen::inRange(least, most) / 100.0; };
    std::vector<Horizon> horizons;
    for (int h = 0; h < 3; ++h) {
        const double a = number(-20, 20), b = number(-20, 20), w = number(0, 3000);
        horizons.push_back(map("h" + std::to_string(h), 21, 21, 50,
                               [&](double x, double y) { return 1000 + 20 * h + a * x + b * y + w * std::sin(x / 130 + y / 170); }));
    }
    horizons[static_cast<std::size_t>(*rc::gen::inRange(0, 3))].erodes = *rc::gen::arbitrary<bool>();
    const Structure structure{horizons, {}};
    GridOptions options;
    options.zones = {proportional(*rc::gen::inRange(1u, 5u)),
                     {"", ZoneLayers::Rule::from_top, *rc::gen::inRange(1u, 6u), number(100, 900)}};
    options.min_thickness = number(0, 600);
    const auto made = build_grid(structure, net(9, 8, 100, 100), options);
    RC_ASSERT(made.ok());
    RC_ASSERT(misfit(made->grid).empty());
    for (std::uint32_t j = 0; j < 8; ++j) {
        for (std::uint32_t i = 0; i < 9; ++i) {
            for (std::uint32_t k = 0; k < made->grid.dims[2]; ++k) {
                const auto corners = cell_corners(made->grid, i, j, k);
                for (unsigned c = 0; c < 4; ++c) {
                    RC_ASSERT(corners[c + 4][2] >= corners[c][2]);
                    if (k > 0) RC_ASSERT(corners[c][2] == made->grid.depths[corner_index(made->grid.dims, i, j, k - 1, c + 4)]);
                }
            }
        }
    }
}

}  // namespace
}  // namespace geomend::gridding
