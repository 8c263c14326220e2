// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/program.h"
#include "support/temporary_folder.h"

// `mesh` with wells as a user runs it. W-1 runs straight down from 25 m above the box to 875 m below its top, W-2 to 775 m.

namespace geomend {
namespace {

using nlohmann::json;
using test::run_geomend;
using test::TemporaryFolder;
using test::write_file;

std::string sample(const std::string& name) { return std::string(GEOMEND_SOURCE_DIR) + "/samples/" + name; }

std::vector<std::string> command(const std::string& out, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"mesh", sample("layered_box.ml"), sample("wells.wl"), "-o", out, "--lossy"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

/// Vertices, named lines and the edges of cells of an MSH 2.2 text, read word by word.
struct MshFile {
    using Pair = std::array<std::size_t, 2>;
    std::map<std::size_t, std::array<double, 3>> vertices;
    std::map<std::string, std::vector<Pair>> lines;
    std::set<Pair> cell_edges;

    explicit MshFile(const std::string& path) {
        std::ifstream in(path);
        std::map<std::size_t, std::string> names;
        std::string word;
        std::size_t count = 0;
        while (in >> word) {
            if (word == "$PhysicalNames") {
                in >> count;
                for (std::size_t i = 0, dimension = 0, number = 0; i < count; ++i) {
                    in >> dimension >> number >> word;
                    if (dimension == 1) names[number] = word.substr(1, word.size() - 2);
                }
            } else if (word == "$Nodes") {
                in >> count;
                for (std::size_t i = 0, number = 0; i < count; ++i) {
                    in >> number;
                    for (double& x : vertices[number]) in >> x;
                }
            } else if (word == "$Elements") {
                in >> count;
                for (std::size_t i = 0; i < count; ++i) read_element(in, names);
            }
        }
    }

    double length_of(const std::string& line) const {
        double sum = 0;
        for (const auto& [a, b] : lines.at(line)) {
            const auto &p = vertices.at(a), &q = vertices.at(b);
            sum += std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
        }
        return sum;
    }

private:
    struct Kind {
        std::size_t nodes;
        std::vector<Pair> edges;
    };
    static const Kind& kind(std::size_t type) {
        static const std::map<std::size_t, Kind> all{
            {1, {2, {}}},
            {2, {3, {}}},
            {3, {4, {}}},
            {4, {4, {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}}},
            {5, {8, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}}},
            {6, {6, {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}}},
            {7, {5, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}}},
            {15, {1, {}}}};
        return all.at(type);
    }
    void read_element(std::istream& in, const std::map<std::size_t, std::string>& names) {
        std::size_t number = 0, type = 0, tags = 0, group = 0, tag = 0;
        in >> number >> type >> tags;
        for (std::size_t i = 0; i < tags; ++i) in >> (i == 0 ? group : tag);
        std::vector<std::size_t> nodes(kind(type).nodes);
        for (std::size_t& n : nodes) in >> n;
        if (type == 1 && names.contains(group)) lines[names.at(group)].push_back({nodes[0], nodes[1]});
        for (const auto& [a, b] : kind(type).edges) {
            cell_edges.insert({nodes[a], nodes[b]});
            cell_edges.insert({nodes[b], nodes[a]});
        }
    }
};

/// Both wells are edges of cells, over their whole way in the box.
void expect_wells_are_edges(const std::string& file, const TemporaryFolder& folder) {
    const std::string text = folder / "as_text.msh";
    ASSERT_EQ(run_geomend({"convert", file, "-o", text, "--lossy", "--option", "version=2.2", "--option", "order=1"}).status, 0);
    const MshFile mesh(text);
    for (const auto& [name, length] : {std::pair<std::string, double>{"W-1", 875}, {"W-2", 775}}) {
        ASSERT_TRUE(mesh.lines.contains(name));
        EXPECT_NEAR(mesh.length_of(name), length, 1e-9 * length) << name;
        for (const auto& e : mesh.lines.at(name)) EXPECT_TRUE(mesh.cell_edges.contains(e)) << name;
    }
}

TEST(MeshWells, AreEdgesOfCellsAndWhatIsOutsideIsSaid) {
    const TemporaryFolder folder;
    const auto run = run_geomend(command(folder / "w.vtu"));
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("well 'W-1'"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("25 of its path lies outside of the model, and is left out"), std::string::npos) << run.out;
    EXPECT_NE(run.err.find("W-1: logs"), std::string::npos) << run.err;
    expect_wells_are_edges(folder / "w.vtu", folder);
}

TEST(MeshWells, AreInTheReportWithVolumesAsTheyWere) {
    const TemporaryFolder folder;
    std::map<std::string, double> before;
    const json model = test::info(sample("layered_box.ml"));
    for (const json& r : model["brep"]["region_volumes"]) before[r["name"]] = r["volume"];
    const json report = json::parse(run_geomend(command(folder / "w.vtu", {"--json"})).out, nullptr, false);
    ASSERT_TRUE(report.is_object());
    ASSERT_EQ(report["wells"].size(), 2u);
    EXPECT_EQ(report["wells"][0]["name"], "W-1");
    EXPECT_DOUBLE_EQ(report["wells"][0]["length"], 900);
    EXPECT_NEAR(report["wells"][0]["inside"].get<double>(), 875, 1e-9);
    EXPECT_GE(report["wells"][0]["crossings"].get<int>(), 3);  // the top and two horizons
    for (const json& r : report["regions"]) EXPECT_NEAR(r["volume"].get<double>(), before.at(r["name"]), 1e-9 * before.at(r["name"]));
    EXPECT_EQ(run_geomend({"validate", folder / "w.vtu"}).status, 0);
}

TEST(MeshWells, StayWithNewTrianglesAndWithSplitSurfaces) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_geomend(command(folder / "i.vtu", {"--size", "120", "--method", "isotropic"})).status, 0);
    expect_wells_are_edges(folder / "i.vtu", folder);
    ASSERT_EQ(run_geomend(command(folder / "s.vtu", {"--split", "fault"})).status, 0);
    expect_wells_are_edges(folder / "s.vtu", folder);
}

TEST(MeshWells, StayEdgesBesideHexahedra) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_geomend(command(folder / "h.vtu", {"--size", "100", "--cells", "hex-dominant"})).status, 0);
    expect_wells_are_edges(folder / "h.vtu", folder);
    ASSERT_EQ(run_geomend(command(folder / "t.vtu", {"--size", "100"})).status, 0);
    ASSERT_EQ(run_geomend({"mesh", folder / "t.vtu", "-o", folder / "r.vtu", "--recombine", "--lossy"}).status, 0);
    expect_wells_are_edges(folder / "r.vtu", folder);
}

TEST(MeshWells, AreChosenByNameAndLeftBesideTheMeshWhereNoneIsWanted) {
    const TemporaryFolder folder;
    const auto wells = [&](const std::string& which, const std::string& out) {
        return json::parse(run_geomend(command(out, {"--json", "--wells", which})).out, nullptr, false)["wells"];
    };
    EXPECT_EQ(wells("W-2", folder / "a.mesh").size(), 1u);
    EXPECT_EQ(wells("W-2,W-1", folder / "b.mesh").size(), 2u);
    EXPECT_EQ(wells("none", folder / "c.vtm").size(), 0u);
    std::size_t beside = 0;
    const json info = test::info(folder / "c.vtm");
    for (const json& object : info["objects"]) beside += object["kind"] == "well" || object["kind"] == "polyline-set" ? 1 : 0;
    EXPECT_EQ(beside, 2u);
    const auto unknown = run_geomend(command(folder / "d.mesh", {"--wells", "W-3"}));
    EXPECT_EQ(unknown.status, 2);
    EXPECT_NE(unknown.err.find("no well or line is called 'W-3'"), std::string::npos) << unknown.err;
    const auto recombined = run_geomend(command(folder / "e.mesh", {"--recombine", "--wells", "all"}));
    EXPECT_EQ(recombined.status, 2);
    EXPECT_NE(recombined.err.find("--wells"), std::string::npos) << recombined.err;
}

TEST(MeshWells, LinesAreEdgesWhereTheyAreNamed) {
    const TemporaryFolder folder;
    std::ofstream(folder / "line.pl") << "GOCAD PLine 1\nHEADER {\nname:gallery\n}\nILINE\nVRTX 1 100 400 -50\nVRTX 2 300 400 -50\n"
                                         "VRTX 3 300 700 -100\nSEG 1 2\nSEG 2 3\nEND\n";
    const auto run = [&](const std::string& which) {
        return json::parse(run_geomend({"mesh", sample("layered_box.ml"), folder / "line.pl", "-o", folder / "l.msh", "--json", "--option",
                                        "version=2.2", "--lossy", "--wells", which})
                               .out,
                           nullptr, false)["wells"];
    };
    EXPECT_EQ(run("all").size(), 0u);
    const json wells = run("gallery");
    ASSERT_EQ(wells.size(), 1u);
    EXPECT_NEAR(wells[0]["inside"].get<double>(), 200 + std::hypot(300, 50), 1e-9);
    EXPECT_NEAR(MshFile(folder / "l.msh").length_of("gallery"), 200 + std::hypot(300, 50), 1e-9);
}

/// A vertical well from (x, 200, -100) on, by measured depths and heights.
std::string vertical_well(const std::string& name, double x, const std::vector<std::pair<double, double>>& stations) {
    std::string text = "GOCAD Well 1\nHEADER {\nname:" + name + "\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME X Y Z\n" +
                       "AXIS_UNIT m m m\nZPOSITIVE Elevation\nEND_ORIGINAL_COORDINATE_SYSTEM\nWREF " + std::to_string(x) + " 200 -100\n";
    for (const auto& [depth, z] : stations) text += "PATH " + std::to_string(depth) + " " + std::to_string(z) + " 0 0\n";
    return text + "END\n";
}

TEST(MeshWells, ThatTurnBackAreNotSaidToLeaveTheModel) {
    const TemporaryFolder folder;
    write_file(folder / "back.wl", vertical_well("back", 200, {{0, -100}, {400, -500}, {600, -300}}));
    const auto run = run_geomend({"mesh", sample("layered_box.ml"), folder / "back.wl", "-o", folder / "out.vtu", "--lossy", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const auto wells = json::parse(run.out)["wells"];
    EXPECT_NEAR(wells[0]["length"].get<double>(), 600, 1e-9);
    EXPECT_NEAR(wells[0]["inside"].get<double>(), 400, 1e-9);
    EXPECT_NEAR(wells[0]["repeated"].get<double>(), 200, 1e-9);
    const auto text = run_geomend({"mesh", sample("layered_box.ml"), folder / "back.wl", "-o", folder / "out.vtu", "--lossy"}).out;
    EXPECT_NE(text.find("200 of its path runs along edges that it has already"), std::string::npos) << text;
    EXPECT_EQ(text.find("outside of the model"), std::string::npos) << text;
}

TEST(MeshWells, OfOneNameStayTwoAndTheNumberOfTheSecondIsListed) {
    const TemporaryFolder folder;
    write_file(folder / "two.wl", vertical_well("A", 200, {{0, -100}, {400, -500}}) + vertical_well("A", 300, {{0, -100}, {300, -400}}));
    const auto run = run_geomend({"mesh", sample("layered_box.ml"), folder / "two.wl", "-o", folder / "out.vtu", "--lossy", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const auto report = json::parse(run.out);
    ASSERT_EQ(report["wells"].size(), 2u);
    EXPECT_EQ(report["wells"][1]["name"], "A_2");
    EXPECT_NEAR(report["wells"][1]["inside"].get<double>(), 300, 1e-9);
    const std::string losses = report["loss"].dump();
    EXPECT_NE(losses.find("its edges are called 'A_2'"), std::string::npos) << losses;
}

TEST(MeshWells, FormatsWithoutEdgesListThemAsLost) {
    const TemporaryFolder folder;
    const auto run = run_geomend(command(folder / "w.foam"));
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.err.find("W-1: edge set"), std::string::npos) << run.err;
    ASSERT_EQ(run_geomend(command(folder / "w.so")).status, 0);
    std::size_t wells = 0;  // a solid has no edges: the wells stay beside it
    const json info = test::info(folder / "w.so");
    for (const json& object : info["objects"]) wells += object["kind"] == "well" ? 1 : 0;
    EXPECT_EQ(wells, 2u);
}

}  // namespace
}  // namespace geomend
