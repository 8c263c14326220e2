// SPDX-License-Identifier: AGPL-3.0-or-later
// The simulator's own files say which cells it takes as active, their pore volumes, its connections and
// transmissibilities; all of it must be what geomend computes. Its exit status proves nothing.
#include <gtest/gtest.h>

#include <cmath>

#include "clients/flow_case.h"
#include "grid/cell_geometry.h"
#include "grid/map_axes.h"
#include "grid/transmissibility.h"
#include "support/corner_point_grids.h"
#include "support/program.h"
#include "support/real_data.h"

namespace geomend::test {
namespace {

Pairs stated(const CornerPointGrid& grid) {
    Pairs pairs;
    for (const auto& c : grid.connections) pairs[std::minmax(c.first, c.second)] = c.transmissibility.value_or(-1);
    return pairs;
}

void expect_close(double ours, double theirs, const std::string& what) {
    EXPECT_LE(std::abs(ours - theirs), 1e-5 * std::abs(theirs)) << what << ": ours " << ours << ", theirs " << theirs;
}

// Active cells, pore volumes, pairs and all transmissibilities of the deck's grid against those of the simulator.
void expect_same_as_simulator(const FlowCase& c) {
    const CornerPointGrid ours = of_deck(c), theirs = simulated(c);
    ASSERT_EQ(ours.cell_count(), theirs.cell_count());
    const grid::Connections found = grid::connections(ours);
    const auto t = grid::transmissibilities(ours, found);
    ASSERT_TRUE(t.ok());
    const std::vector<double> porv = values(theirs, "PORV"), poro = values(ours, "PORO");
    const std::vector<double> ntg = c.constant_rock ? std::vector<double>(poro.size(), 1.0) : values(ours, "NTG");
    const std::vector<double> volumes = grid::cell_volumes(ours);
    const double metres = grid::metres(ours.info.crs.axis_units[0]), unit = metres == 0 ? 1 : metres * metres * metres;
    const std::array<std::vector<double>, 3> tran{values(theirs, "TRANX"), values(theirs, "TRANY"), values(theirs, "TRANZ")};
    const std::array<const std::vector<double>*, 3> own{&t->x, &t->y, &t->z};
    for (std::size_t cell = 0; cell < ours.cell_count(); ++cell) {
        ASSERT_EQ(found.present[cell] != 0, theirs.is_active(cell)) << "cell " << cell;
        if (found.present[cell] == 0) continue;
        expect_close(unit * std::abs(volumes[cell]) * poro[cell] * ntg[cell], porv[cell], "PORV of cell " + std::to_string(cell));
        for (std::size_t d = 0; d < 3; ++d)
            expect_close((*own[d])[cell], tran[d][cell], std::string("TRAN") + "XYZ"[d] + " of cell " + std::to_string(cell));
        if (::testing::Test::HasFailure()) return;
    }
    Pairs pairs;
    for (std::size_t n = 0; n < found.others.size(); ++n) {
        if (t->others[n] >= 1e-6) pairs[std::minmax<std::uint64_t>(found.others[n].first, found.others[n].second)] = t->others[n];
    }
    const Pairs expected = stated(theirs);
    EXPECT_EQ(pairs.size(), expected.size());
    for (const auto& [pair, value] : expected) {
        const auto at = pairs.find(pair);
        ASSERT_NE(at, pairs.end()) << "the simulator joins cells " << pair.first + 1 << " and " << pair.second + 1;
        expect_close(at->second, value, "connection");
    }
}

// 6 x 4 x 3 bricks on leaning pillars, a throw of one layer and a half between the third and the fourth column, layer 2
// pinched out from the fifth column on, one cell inactive.
CornerPointGrid faulted() {
    CornerPointGrid grid = geomend::testing::brick_grid(6, 4, 3);
    for (std::size_t p = 0; p < grid.pillars.size(); p += 6) {
        grid.pillars[p + 3] += 4;
        grid.pillars[p + 4] += 0.01 * double(p);
    }
    geomend::testing::reshape(grid, [](std::uint32_t i, std::uint32_t j, std::uint32_t k, unsigned c, double depth) {
        if (i >= 4 && (k == 2 || (k == 1 && c >= 4))) depth -= 10;
        return depth + (i >= 3 ? 15 : 0) + 0.7 * (j + ((c >> 1) & 1u)) + 0.3 * (i + (c & 1u));
    });
    grid.activity.assign(grid.cell_count(), 1);
    grid.activity[0] = 0;
    return grid;
}

void write_include(const CornerPointGrid& grid, const std::filesystem::path& file) {
    std::string text =
        "SPECGRID\n " + std::to_string(grid.dims[0]) + ' ' + std::to_string(grid.dims[1]) + ' ' + std::to_string(grid.dims[2]) + " 1 F /\n";
    const auto put = [&](const char* keyword, const auto& values) {
        text += std::string(keyword) + '\n';
        for (const auto v : values) {
            char number[40];
            std::snprintf(number, sizeof number, "%.17g\n", double(v));
            text += number;
        }
        text += "/\n";
    };
    put("COORD", grid.pillars);
    put("ZCORN", grid.depths);
    if (!grid.activity.empty()) put("ACTNUM", grid.activity);
    write_file(file, text);
}

class Flow : public ::testing::Test {
protected:
    void SetUp() override {
        if (!has_flow()) GTEST_SKIP() << "the simulator flow is not installed (scripts/test --clients installs it)";
    }
    TemporaryFolder folder_;
};

TEST_F(Flow, joins_the_cells_of_a_faulted_and_pinched_grid_as_we_do) {
    for (const char* pinch : {"", "PINCH\n/\n"}) {
        const FlowCase c{folder_.path(), {6, 4, 3}, pinch, false};
        write_include(faulted(), folder_ / "GRID.GRDECL");
        write_deck(c);
        ASSERT_TRUE(dry_run(c));
        expect_same_as_simulator(c);
        EXPECT_EQ(simulated(c).connections.size(), 16u) << "12 across the fault, 4 past the pinched step";
    }
}

TEST_F(Flow, multiplies_faults_and_regions_as_we_do) {
    FlowCase c{folder_.path(), {6, 4, 3}, "", false};
    c.grid_section =
        "FAULTS\n 'BIG' 3 3 1 4 1 3 X /\n 'SIDE' 1 6 2 2 1 3 Y /\n/\nMULTFLT\n 'BIG' 0.25 /\n 'SIDE' 3 /\n 'BIG' 0.5 /\n/\n"
        "MULTNUM\n 24*1 24*2 24*3 /\nMULTREGT\n 1 2 0.125 'XYZ' 'ALL' M /\n 2 3 0.5 'Z' 'ALL' M /\n 1 3 0.1 'XYZ' 'NNC' M /\n/\n";
    write_include(faulted(), folder_ / "GRID.GRDECL");
    write_deck(c);
    ASSERT_TRUE(dry_run(c));
    expect_same_as_simulator(c);
}

TEST_F(Flow, takes_grids_that_we_wrote_with_the_same_cells_and_pore_volumes) {
    write_include(faulted(), folder_ / "own.grdecl");
    const auto there = (folder_ / "grid.egrid").string(), back = (folder_ / "GRID.GRDECL").string();
    ASSERT_EQ(run_geomend({"convert", (folder_ / "own.grdecl").string(), "-o", there}).status, 0);
    ASSERT_EQ(run_geomend({"convert", there, "-o", back}).status, 0);
    const FlowCase c{folder_.path(), {6, 4, 3}, "", true};
    write_deck(c);
    ASSERT_TRUE(dry_run(c));
    expect_same_as_simulator(c);
    double sum = 0;
    for (const double v : values(simulated(c), "PORV")) sum += v;
    EXPECT_NEAR(sum, 0.2 * grid::volume(faulted()), 1e-6 * sum);
}

// Quoted names without blanks at their ends: the simulator stops on those.
std::string with_trimmed_names(const std::string& deck) {
    std::string text;
    bool quoted = false;
    for (const char c : deck) {
        if (c == '\'') {
            if (quoted) text.erase(text.find_last_not_of(' ') + 1);
            quoted = !quoted;
        }
        if (c == '\n') quoted = false;
        text += c;
    }
    return text;
}

TEST_F(Flow, runs_spe9_to_its_end_on_a_grid_that_went_through_us_with_the_same_pore_volume) {
    const auto spe9 = real_data("cornerpoint/spe9");
    if (!spe9) GTEST_SKIP() << "no real data: spe9";
    const auto there = (folder_ / "grid.egrid").string();
    ASSERT_EQ(run_geomend({"convert", (*spe9 / "SPE9.GRDECL").string(), "-o", there}).status, 0);
    ASSERT_EQ(run_geomend({"convert", there, "-o", (folder_ / "SPE9.GRDECL").string()}).status, 0);
    write_file(folder_ / "CASE.DATA", with_trimmed_names(read_file(*spe9 / "SPE9_CP.DATA")));
    std::filesystem::copy_file(*spe9 / "PERMVALUES.DATA", folder_ / "PERMVALUES.DATA");
    const FlowCase c{folder_.path(), {24, 25, 15}, "", false};
    const std::string command = "cd '" + folder_.path().string() + "' && flow CASE.DATA --output-dir=out > flow.log 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) << read_file(folder_ / "flow.log");
    double sum = 0;
    for (const double v : values(simulated(c), "PORV")) sum += v;
    EXPECT_EQ(sum, 452912321.484375);
}

// Real grids with their known answers: active cells, pore volume, pairs.
struct Known {
    const char* file;
    std::array<std::uint32_t, 3> dims;
    std::size_t active, pairs;
    double pore_volume, digits;
};

class FlowOnRealGrids : public Flow, public ::testing::WithParamInterface<Known> {};

TEST_P(FlowOnRealGrids, has_our_cells_connections_and_transmissibilities) {
    const Known& known = GetParam();
    const auto file = real_data(std::string("cornerpoint/") + known.file);
    if (!file) GTEST_SKIP() << "no real data: " << known.file;
    ASSERT_EQ(run_geomend({"convert", file->string(), "-o", (folder_ / "GRID.GRDECL").string()}).status, 0);
    for (const bool constant : {true, false}) {
        const FlowCase c{folder_.path(), known.dims, "", constant};
        write_deck(c);
        ASSERT_TRUE(dry_run(c));
        expect_same_as_simulator(c);
        if (!constant) continue;
        const CornerPointGrid theirs = simulated(c);
        double sum = 0;
        for (const double v : values(theirs, "PORV")) sum += v;
        EXPECT_NEAR(sum, known.pore_volume, known.digits);
        EXPECT_EQ(active_count(theirs), known.active);
        EXPECT_EQ(theirs.connections.size(), known.pairs);
    }
}

INSTANTIATE_TEST_SUITE_P(Grids, FlowOnRealGrids,
                         ::testing::Values(Known{"reek/reek_sim_grid.grdecl", {40, 64, 14}, 35838, 2944, 587926191, 60},
                                           Known{"reek3/reek_sim.grdecl", {40, 64, 14}, 35812, 3008, 591419821, 60},
                                           Known{"pygrdecl/20X20X6.GRDECL", {20, 20, 6}, 2351, 530, 614306881623, 60000},
                                           Known{"pygrdecl/40X48x1_3fatults.GRDECL", {20, 30, 3}, 1800, 95, 23292595, 3},
                                           Known{"pygrdecl/CP.GRDECL", {20, 5, 10}, 1000, 80, 1.188e9, 200},
                                           Known{"pygrdecl/Simple20x20x5_Fault.grdecl", {20, 20, 5}, 2000, 80, 0.04850492, 1e-8},
                                           Known{"simpleb8/simpleb8.grdecl", {4, 2, 3}, 22, 3, 5570.3, 0.05},
                                           Known{"small/banal6.grdecl", {4, 2, 3}, 24, 3, 5984.375, 1e-3}));

}  // namespace
}  // namespace geomend::test
