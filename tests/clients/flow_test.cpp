// SPDX-License-Identifier: AGPL-3.0-or-later
// The simulator's own files say which cells it takes as active, their pore volumes, its connections and
// transmissibilities; all of it must be what geomend computes. Its exit status proves nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <sstream>

#include "clients/flow_case.h"
#include "grid/cell_geometry.h"
#include "grid/pore_volume.h"
#include "grid/transmissibility.h"
#include "pipeline/load.h"
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
    const grid::Connections found = grid::connections(ours, grid::simulated_cells(ours));
    const auto t = grid::transmissibilities(ours, found);
    ASSERT_TRUE(t.ok());
    const std::vector<double> porv = values(theirs, "PORV"), own_porv = grid::pore_volumes(ours);
    const std::array<std::vector<double>, 3> tran{values(theirs, "TRANX"), values(theirs, "TRANY"), values(theirs, "TRANZ")};
    const std::array<const std::vector<double>*, 3> own{&t->x, &t->y, &t->z};
    for (std::size_t cell = 0; cell < ours.cell_count(); ++cell) {
        ASSERT_EQ(found.present[cell] != 0, theirs.is_active(cell)) << "cell " << cell;
        if (found.present[cell] == 0) continue;
        expect_close(own_porv[cell], porv[cell], "PORV of cell " + std::to_string(cell));
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

/// What `convert` computes of a deck is what the simulator writes of it, with what section EDIT says.
void expect_same_file(const FlowCase& c) {
    for (const char* name : {"ours.EGRID", "ours.INIT"}) {
        const ProgramRun run = run_geomend(
            {"convert", (c.folder / "CASE.DATA").string(), "-o", (c.folder / name).string(), "--lossy", "--option", "connections=compute"});
        ASSERT_EQ(run.status, 0) << run.err;
    }
    const auto read = load((c.folder / "ours.INIT").string(), {});
    ASSERT_TRUE(read);
    const auto& ours = std::get<CornerPointGrid>(read->objects.front());
    const CornerPointGrid theirs = simulated(c);
    for (const char* name : {"TRANX", "TRANY", "TRANZ"}) {
        const auto a = values(ours, name), b = values(theirs, name);
        ASSERT_EQ(a.size(), b.size()) << name;
        for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-5 * std::abs(b[i])) << name << i;
    }
    const Pairs pairs = stated(ours), expected = stated(theirs);
    ASSERT_EQ(pairs.size(), expected.size());
    for (const auto& [pair, value] : expected) {
        ASSERT_TRUE(pairs.contains(pair)) << pair.first << ' ' << pair.second;
        EXPECT_NEAR(pairs.at(pair), value, 1e-5 * std::abs(value)) << pair.first << ' ' << pair.second;
    }
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

// Cells below MINPV are left out and bridged; what PINCH says of it is tried in all its forms. Layers are bent, between
// leaning pillars, so that areas and centres differ above and below.
struct ThinLayers {
    const char* name;
    std::vector<double> thickness;
    std::vector<int> activity;  // empty: all
    std::string porosity;       // empty: 0.2
    const char* minpv;
};

CornerPointGrid thin_layers(const ThinLayers& t) {
    CornerPointGrid grid = geomend::testing::brick_grid(3, 2, static_cast<std::uint32_t>(t.thickness.size()));
    for (std::size_t p = 0; p < grid.pillars.size(); p += 6) {
        grid.pillars[p + 3] += 4;
        grid.pillars[p + 4] += 0.05 * double(p);
    }
    geomend::testing::reshape(grid, [&](std::uint32_t i, std::uint32_t j, std::uint32_t k, unsigned c, double) {
        const double x = i + (c & 1u), y = j + ((c >> 1) & 1u);
        double depth = 1000 + 3 * x * y + (i >= 2 ? 6 : 0);
        for (std::uint32_t m = 0; m < k + (c >> 2); ++m) depth += t.thickness[m] * (1 + 0.1 * x - 0.05 * m * y);
        return depth;
    });
    for (std::size_t cell = 0; !t.activity.empty() && cell < grid.cell_count(); ++cell)
        grid.activity.push_back(static_cast<std::uint8_t>(t.activity[grid.ijk(cell)[2]]));
    return grid;
}

std::string layered(const char* keyword, const std::string& values) {
    std::string text = std::string(keyword) + '\n';
    std::istringstream words(values);
    for (std::string value; words >> value;) text += " 6*" + value + '\n';
    return text + "/\n";
}

TEST_F(Flow, leaves_out_thin_layers_and_bridges_them_as_we_do) {
    const ThinLayers cases[] = {
        {"one below", {10, 10, 0.5, 10, 10}, {}, "", "MINPV\n 2000 /\n"},
        {"one below by its porosity", {10, 10, 5, 10, 10}, {}, "0.2 0.2 0.001 0.2 0.2", "MINPV\n 2000 /\n"},
        {"two below", {10, 0.5, 0.4, 10, 10}, {}, "", "MINPV\n 2000 /\n"},
        {"top and bottom below", {0.5, 10, 10, 10, 0.5}, {}, "", "MINPV\n 2000 /\n"},
        {"thin inactive ones under it", {10, 10, 0.5, 0.5, 10, 10}, {1, 1, 1, 0, 1, 1}, "", "MINPV\n 2000 /\n"},
        {"thin inactive ones over it", {10, 10, 0.5, 0.5, 10, 10}, {1, 1, 0, 1, 1, 1}, "", "MINPV\n 2000 /\n"},
        {"thin inactive ones over it at the top", {10, 0.5, 0.5, 10, 10}, {1, 0, 1, 1, 1}, "", "MINPV\n 2000 /\n"},
        {"thick inactive ones under it", {10, 10, 0.5, 5, 10}, {1, 1, 1, 0, 1}, "", "MINPV\n 2000 /\n"},
        {"below, thin inactive, below", {10, 10, 0.5, 0.4, 0.5, 10, 10}, {1, 1, 1, 0, 1, 1, 1}, "", "MINPV\n 2000 /\n"},
        {"thick inactive ones under two, a thin one over them",
         {10, 0.8, 0.3, 0.3, 5, 10, 10},
         {1, 1, 1, 1, 0, 1, 1},
         "",
         "MINPV\n 1400 /\n"},
        {"without pores", {10, 10, 0.5, 10, 10}, {}, "0.2 0.2 0 0.2 0.2", "MINPV\n 2000 /\n"},
        {"without pores and without MINPV", {10, 10, 0.5, 10, 10}, {}, "0.2 0.2 0 0.2 0.2", ""},
        {"thin but no MINPV", {10, 10, 0.0005, 10, 10}, {}, "", ""},
        {"no thickness", {10, 10, 0, 10, 10}, {}, "", ""},
        {"no thickness and MINPV", {10, 10, 0, 0.5, 10, 10}, {}, "", "MINPV\n 2000 /\n"},
        {"MINPVV", {10, 10, 0.5, 10, 10}, {}, "", "MINPVV\n 12*0 6*2000 12*0 /\n"},
        {"MINPV before MINPVV", {10, 10, 0.5, 10, 10}, {}, "", "MINPV\n 2000 /\nMINPVV\n 30*10 /\n"},
        {"MULTPV", {10, 10, 0.5, 10, 10}, {}, "", "MINPV\n 2000 /\nMULTPV\n 12*1 3*5 3*0.1 12*1 /\n"},
    };
    for (const char* pinch : {"", "PINCH\n/\n", "PINCH\n 1 GAP 1* TOPBOT ALL /\n", "PINCH\n 0.45 NOGAP 0.1 ALL TOP /\n"}) {
        for (const ThinLayers& t : cases) {
            SCOPED_TRACE(std::string(t.name) + " / " + pinch);
            const CornerPointGrid grid = thin_layers(t);
            FlowCase c{folder_.path(), grid.dims, std::string(pinch) + t.minpv, false};
            const std::size_t n = grid.cell_count();
            const std::string porosity = t.porosity.empty() ? "PORO\n " + std::to_string(n) + "*0.2 /\n" : layered("PORO", t.porosity);
            const auto all = [&](const char* keyword, const char* value) {
                return std::string(keyword) + "\n " + std::to_string(n) + '*' + value + " /\n";
            };
            std::string up = "MULTZ\n", down = "MULTZ-\n";
            const char* factors[] = {"0.5", "0.25", "0.4", "0.125", "0.9", "0.8", "1.1"};
            for (std::size_t k = 0; k < t.thickness.size(); ++k) {
                up += std::string(" 6*") + factors[k];
                down += std::string(" 6*") + factors[6 - k];
            }
            c.rock = porosity + all("PERMX", "200") + all("PERMY", "100") + all("PERMZ", "20") + up + " /\n" + down + " /\n" +
                     "MULTNUM\n 12*1 " + std::to_string(n - 12) + "*2 /\nMULTREGT\n 1 2 0.5 'XYZ' 'ALL' M /\n/\n";
            write_include(grid, folder_ / "GRID.GRDECL");
            write_deck(c);
            ASSERT_TRUE(dry_run(c));
            expect_same_as_simulator(c);
            if (HasFailure()) return;
        }
    }
}

class FlowOnFive : public Flow, public ::testing::WithParamInterface<const char*> {};

// Five cubes on top of each other, with PINCH and MINPV: the grid section of the real deck as it stands, with rock.
TEST_P(FlowOnFive, joins_the_cubes_as_we_do) {
    const auto file = real_data(std::string("cornerpoint/opm/") + GetParam());
    if (!file) GTEST_SKIP() << "no real data: " << GetParam();
    const std::string deck = read_file(*file);
    write_file(folder_ / "GRID.GRDECL", deck.substr(deck.find("COORD")));
    FlowCase c{folder_.path(), {1, 1, 5}, "", false};
    c.rock = "PERMX\n 100 200 300 400 500 /\nPERMZ\n 10 20 30 40 50 /\nMULTZ\n 0.5 0.25 0.75 2 1 /\n";
    write_deck(c);
    ASSERT_TRUE(dry_run(c));
    expect_same_as_simulator(c);
}

INSTANTIATE_TEST_SUITE_P(Decks, FlowOnFive,
                         ::testing::Values("FIVE.DATA", "FIVE_ACTNUM.DATA", "FIVE_PINCH.DATA", "FIVE_PINCH_NOGAP.DATA",
                                           "FIVE_PINCH_NOGAP2.DATA", "FIVE_PINCH_NOGAP3.DATA"));

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

TEST_F(Flow, multiplies_by_all_factors_of_a_connection_as_we_do) {
    FlowCase c{folder_.path(), {6, 4, 3}, "", false};
    c.grid_section =
        "NNC\n 2 1 1 6 4 3 0.75 /\n 1 2 2 6 3 3 0.5 /\n/\nEDIT\nEDITNNC\n 2 1 1 6 4 3 0.5 /\n/\nEDITNNC\n 6 4 3 2 1 1 0.1 /\n 1 2 2 6 3 3 "
        "0.2 /\n/\n";
    write_include(faulted(), folder_ / "GRID.GRDECL");
    write_deck(c);
    ASSERT_TRUE(dry_run(c));
    expect_same_file(c);
}

TEST_F(Flow, changes_no_transmissibility_past_cells_that_are_left_out_as_we_do) {
    const CornerPointGrid grid = thin_layers({"one below", {10, 10, 0.5, 10, 10}, {}, "", ""});
    write_include(grid, folder_ / "GRID.GRDECL");
    const std::array edits = {"ADD\n TRANZ 0.5 /\n/\n", "MULTIPLY\n TRANZ 0.1 /\n/\n", "MAXVALUE\n TRANZ 4 /\n/\n",
                              "EQUALS\n TRANZ 7 /\n/\n"};
    for (const char* edit : edits) {
        const FlowCase c{folder_.path(), grid.dims, std::string("MINPV\n 2000 /\nEDIT\n") + edit, true};
        write_deck(c);
        ASSERT_TRUE(dry_run(c)) << edit;
        expect_same_file(c);
    }
}

TEST_F(Flow, adds_stated_connections_of_neighbours_to_their_transmissibilities_as_we_do) {
    FlowCase c{folder_.path(), {6, 4, 3}, "", false};
    c.grid_section = "NNC\n 1 2 1 2 2 1 5 /\n 2 3 3 2 2 3 7 /\n 2 2 1 2 2 2 0.5 /\n 1 2 2 6 4 3 11 /\n/\n";
    write_include(faulted(), folder_ / "GRID.GRDECL");
    write_deck(c);
    ASSERT_TRUE(dry_run(c));
    expect_same_file(c);
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

TEST_F(Flow, takes_radial_decks_that_we_wrote_with_our_volumes) {
    const std::string runspec =
        "RUNSPEC\nDIMENS\n 3 4 2 /\nOIL\nWATER\nMETRIC\nSTART\n 1 'JAN' 2020 /\nWELLDIMS\n 2 2 2 2 /\nTABDIMS\n /\nEQLDIMS\n /\nUNIFOUT\n";
    const std::string grid =
        "GRID\nINIT\nINRAD\n 0.25 /\nDRV\n 1.0 5.0 20.0 /\nDTHETAV\n 3*90 45 /\nDZ\n 12*10 12*7 /\nTOPS\n 12*2000 /\nPORO\n 24*0.2 "
        "/\nPERMR\n 24*100 /\nPERMTHT\n 24*100 /\nPERMZ\n 24*10 /\n";
    const std::string rest =
        "PROPS\nPVTW\n 200 1.0 4.0E-5 0.5 0 /\nPVDO\n 100 1.1 1.0\n 300 1.0 1.1 /\nROCK\n 200 1E-5 /\nDENSITY\n 800 1000 1 /\nSWOF\n 0.2 0 "
        "1 "
        "0\n 1.0 1 0 0 /\nSOLUTION\nEQUIL\n 2000 200 2500 0 /\nSUMMARY\nSCHEDULE\nTSTEP\n 1 /\n";
    write_file(folder_ / "in.DATA", runspec + "RADIAL\n" + grid + rest);
    ASSERT_EQ(run_geomend({"convert", (folder_ / "in.DATA").string(), "-o", (folder_ / "CASE.DATA").string()}).status, 0);
    const FlowCase c{folder_.path(), {3, 4, 2}, "", true};
    ASSERT_TRUE(dry_run(c));
    double sum = 0;
    for (const double v : values(simulated(c), "PORV")) sum += v;
    EXPECT_NEAR(sum, 0.2 * grid::volume(of_deck(c)), 1e-5 * sum);
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
    // Its restart file becomes a series in time.
    ASSERT_EQ(
        run_geomend({"convert", (folder_ / "out").string() + "/CASE.UNRST", "-o", (folder_ / "series.pvd").string(), "--lossy"}).status, 0);
    const std::string series = read_file(folder_ / "series.pvd");
    EXPECT_NE(series.find("timestep=\"900\""), std::string::npos) << series;
    const auto last = info(folder_ / "series" / "series_0_0.vtu");
    ASSERT_TRUE(last.is_object());
    bool pressure = false;
    for (const auto& a : last["objects"][0]["attributes"]) pressure = pressure || a["name"] == "PRESSURE";
    EXPECT_TRUE(pressure);
}

// Real grids with their known answers: active cells, pore volume, pairs.
struct Known {
    const char* file;
    std::array<std::uint32_t, 3> dims;
    std::size_t active, pairs;
    double pore_volume, digits;
};
void PrintTo(const Known& o, std::ostream* out) { *out << o.file; }

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
