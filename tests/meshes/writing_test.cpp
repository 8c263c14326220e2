// SPDX-License-Identifier: AGPL-3.0-or-later
// Files of meshes against readers that share nothing with the writers: orders of nodes and faces are those of the programs' manuals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "base/vectors.h"
#include "meshes/cell_samples.h"
#include "meshes/written_mesh.h"
#include "support/temporary_folder.h"

namespace geomend::test {
namespace {

using Ids = std::vector<std::uint32_t>;

/// What an input deck of Abaqus says, read by its manual.
struct Deck {
    struct Element {
        std::string type, set;
        Ids nodes;
    };
    std::map<std::uint32_t, Vec3> nodes;
    std::map<std::uint32_t, Element> elements;
    std::map<std::string, std::vector<std::pair<std::uint32_t, std::string>>> surfaces;
    std::map<std::string, Ids> node_sets;
};

std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields;
    std::istringstream in(line);
    for (std::string field; std::getline(in, field, ',');) {
        field.erase(0, field.find_first_not_of(' '));
        if (!field.empty()) fields.push_back(field);
    }
    return fields;
}

std::string parameter(const std::vector<std::string>& fields, const std::string& key) {
    for (const std::string& f : fields) {
        if (f.starts_with(key + "=")) return f.substr(key.size() + 1);
    }
    return {};
}

Deck read_deck(const std::string& text) {
    Deck deck;
    std::istringstream in(text);
    std::vector<std::string> head;
    std::string rest;
    for (std::string line; std::getline(in, line);) {
        EXPECT_LE(line.size(), 255u);
        if (line.starts_with("**")) continue;
        if (line.starts_with("*")) {
            head = fields_of(line);
            continue;
        }
        if (line.ends_with(",")) {
            rest += line;
            continue;
        }
        const auto f = fields_of(rest + line);
        rest.clear();
        EXPECT_LE(fields_of(line).size(), 16u);
        const auto number = [&](std::size_t i) { return static_cast<std::uint32_t>(std::stoul(f[i])); };
        if (head[0] == "*NODE") deck.nodes[number(0)] = {std::stod(f[1]), std::stod(f[2]), std::stod(f[3])};
        if (head[0] == "*ELEMENT") {
            auto& e = deck.elements[number(0)];
            e = {parameter(head, "TYPE"), parameter(head, "ELSET"), {}};
            for (std::size_t i = 1; i < f.size(); ++i) e.nodes.push_back(number(i));
        }
        if (head[0] == "*SURFACE") deck.surfaces[parameter(head, "NAME")].emplace_back(number(0), f[1]);
        if (head[0] == "*NSET") {
            for (std::size_t i = 0; i < f.size(); ++i) deck.node_sets[parameter(head, "NSET")].push_back(number(i));
        }
    }
    return deck;
}

/// The elements of Abaqus' manual, counted from 1: corners of faces S1, S2, ..., ends of the edges that further nodes stand on.
struct Manual {
    std::size_t corners;
    std::vector<Ids> faces;
    std::vector<std::array<std::uint32_t, 2>> edges;
};

Manual manual_of(const std::string& type) {
    if (type == "C3D4" || type == "C3D10")
        return {4, {{1, 2, 3}, {1, 4, 2}, {2, 4, 3}, {3, 4, 1}}, {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 4}, {3, 4}}};
    if (type == "C3D6" || type == "C3D15")
        return {6,
                {{1, 2, 3}, {4, 6, 5}, {1, 4, 5, 2}, {2, 5, 6, 3}, {3, 6, 4, 1}},
                {{1, 2}, {2, 3}, {3, 1}, {4, 5}, {5, 6}, {6, 4}, {1, 4}, {2, 5}, {3, 6}}};
    return {8,
            {{1, 2, 3, 4}, {5, 8, 7, 6}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 8, 4}, {4, 8, 5, 1}},
            {{1, 2}, {2, 3}, {3, 4}, {4, 1}, {5, 6}, {6, 7}, {7, 8}, {8, 5}, {1, 5}, {2, 6}, {3, 7}, {4, 8}}};
}

double volume_of(const Deck& deck, const Deck::Element& e) {
    std::vector<Vec3> corners;
    for (std::size_t i = 0; i < manual_of(e.type).corners; ++i) corners.push_back(deck.nodes.at(e.nodes[i]));
    return flat_volume(corners);
}

struct Written {
    std::map<std::string, std::string> files;  ///< by extension
    std::vector<Loss> losses;
};

Written write(CellMesh cells, const char* format, const char* extension) {
    const TemporaryFolder folder;
    Written written;
    OutputSet out(folder / (std::string("m") + extension));
    auto done = write_cells(std::move(cells), format, out);
    EXPECT_TRUE(done) << (done ? "" : done.why().error.message);
    if (!done) return written;
    written.losses = std::move(*done);
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        written.files[entry.path().extension().string()] = read_file(entry.path());
    return written;
}

bool loses(const std::vector<Loss>& losses, const std::string& entity, const std::string& what) {
    return std::ranges::any_of(losses, [&](const Loss& l) { return l.entity == entity && l.what == what; });
}

TEST(Abaqus, EachTypeHasItsNodesAndFacesInTheOrderOfTheManual) {
    for (const SampleCell& cell : sample_cells()) {
        const Written written = write(mesh_of(cell), "abaqus", ".inp");
        const Deck deck = read_deck(written.files.at(".inp"));
        ASSERT_EQ(deck.elements.size(), 1u);
        const Deck::Element& e = deck.elements.at(1);
        const Manual manual = manual_of(e.type);
        EXPECT_EQ(e.set, "rock");
        ASSERT_EQ(e.nodes.size(), cell.corners.size() + cell.edges.size()) << e.type;
        EXPECT_DOUBLE_EQ(volume_of(deck, e), cell.volume) << e.type;
        const auto at = [&](std::uint32_t i) { return deck.nodes.at(e.nodes[i - 1]); };
        for (std::size_t i = manual.corners; i < e.nodes.size(); ++i) {
            const auto [a, b] = manual.edges[i - manual.corners];
            EXPECT_EQ(at(static_cast<std::uint32_t>(i + 1)), times(0.5, plus(at(a), at(b)))) << e.type << " node " << i + 1;
        }
        ASSERT_EQ(deck.surfaces.size(), cell.faces.size());
        for (std::size_t f = 0; f < cell.faces.size(); ++f) {
            const auto& surface = deck.surfaces.at("f" + std::to_string(f));
            ASSERT_EQ(surface.size(), 1u);
            std::vector<Vec3> expected, found;
            for (const std::uint32_t n : cell.faces[f]) expected.push_back(cell.corners[n]);
            for (const std::uint32_t n : manual.faces.at(std::stoul(surface[0].second.substr(1)) - 1)) found.push_back(at(n));
            std::ranges::sort(expected);
            std::ranges::sort(found);
            EXPECT_EQ(found, expected) << e.type << " f" << f;
        }
        EXPECT_TRUE(written.losses.empty()) << written.losses.front().what;
    }
}

TEST(Abaqus, CellsThatAreInsideOutAreTurned) {
    for (SampleCell cell : sample_cells()) {
        for (Vec3& p : cell.corners) p[2] = -p[2];
        const Deck deck = read_deck(write(mesh_of(cell), "abaqus", ".inp").files.at(".inp"));
        const Deck::Element& e = deck.elements.at(1);
        EXPECT_DOUBLE_EQ(volume_of(deck, e), cell.volume) << e.type;
        const Manual manual = manual_of(e.type);
        for (std::size_t i = manual.corners; i < e.nodes.size(); ++i) {
            const auto [a, b] = manual.edges[i - manual.corners];
            EXPECT_EQ(deck.nodes.at(e.nodes[i]), times(0.5, plus(deck.nodes.at(e.nodes[a - 1]), deck.nodes.at(e.nodes[b - 1]))));
        }
    }
}

TEST(Abaqus, BothSidesOfAFaultAreSurfacesAndLinesAreSetsOfNodes) {
    for (const bool doubled : {false, true}) {
        const Written written = write(two_boxes(doubled), "abaqus", ".inp");
        const Deck deck = read_deck(written.files.at(".inp"));
        EXPECT_EQ(deck.nodes.size(), doubled ? 16u : 12u);
        EXPECT_EQ(deck.elements.at(1).set, "west");
        EXPECT_EQ(deck.elements.at(2).set, "east");
        using Faces = std::vector<std::pair<std::uint32_t, std::string>>;
        EXPECT_EQ(deck.surfaces.at("F_hanging_wall"), (Faces{{1, "S4"}}));
        EXPECT_EQ(deck.surfaces.at("F_footwall"), (Faces{{2, "S6"}}));
        EXPECT_EQ(deck.surfaces.at("west_outside").size(), 5u);
        EXPECT_EQ(deck.surfaces.at("east_outside").size(), 5u);
        EXPECT_EQ(deck.surfaces.size(), 4u);
        EXPECT_EQ(deck.node_sets.at("W"), (Ids{1, 5, 8}));
        EXPECT_TRUE(loses(written.losses, "W", "edges"));
        EXPECT_EQ(loses(written.losses, "two boxes", "pairs of doubled faces"), doubled);
    }
}

TEST(Abaqus, CoordinatesKeepAllDigitsThatTwentyCharactersHold) {
    SampleCell cell = sample_cells()[0];
    cell.corners[1] = {123456.78901234567, 1e-5, 0.1};
    cell.corners[3][0] = -6.123233995736766e-17;
    const Written written = write(mesh_of(cell), "abaqus", ".inp");
    const Deck deck = read_deck(written.files.at(".inp"));
    EXPECT_EQ(deck.nodes.at(2), cell.corners[1]);
    EXPECT_NE(deck.nodes.at(4)[0], cell.corners[3][0]);
    EXPECT_NEAR(deck.nodes.at(4)[0], cell.corners[3][0], 1e-13 * 6.2e-17);
    EXPECT_NE(written.files.at(".inp").find("-6.1232339957368e-17"), std::string::npos);
    EXPECT_TRUE(loses(written.losses, "", "last digits of coordinates"));
}

TEST(Abaqus, PyramidsAreCollapsedHexahedraAndValuesAreLost) {
    CellMesh mesh = two_boxes(false);
    mesh.points.push_back({0.5, 0.5, 2});
    mesh.add_cell(CellType::pyramid, Ids{4, 5, 6, 7, 12});
    mesh.cell_entity.push_back(0);
    Attribute phi;
    phi.name = "phi";
    phi.location = AttributeLocation::cell;
    phi.values = std::vector<double>(mesh.cell_count(), 0.25);
    mesh.info.attributes.push_back(phi);
    const Written written = write(mesh, "abaqus", ".inp");
    const Deck deck = read_deck(written.files.at(".inp"));
    ASSERT_EQ(deck.elements.size(), 3u);
    EXPECT_EQ(deck.nodes.size(), 13u);
    std::map<Ids, std::string> types;
    for (const auto& [number, element] : deck.elements) types[element.nodes] = element.type;
    EXPECT_EQ(types[(Ids{5, 6, 7, 8, 13, 13, 13, 13})], "C3D8");
    EXPECT_FALSE(loses(written.losses, "west", "cells: pyramid"));
    EXPECT_TRUE(loses(written.losses, "", "attribute 'phi'"));
}

/// Numbers of a text, comments left out.
std::vector<double> numbers_after(const std::string& text, const std::string& keyword) {
    std::vector<double> numbers;
    const std::size_t at = keyword.empty() ? 0 : text.find(keyword + "\n");
    if (at == std::string::npos) return numbers;
    std::istringstream in(text.substr(at + (keyword.empty() ? 0 : keyword.size() + 1)));
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with("#")) continue;
        std::istringstream words(line);
        double x = 0;
        if (!(words >> x)) break;
        do numbers.push_back(x);
        while (words >> x);
    }
    return numbers;
}

TEST(Medit, CellsFacesAndEdgesHaveNumbersOfRegionsAndSets) {
    const Written written = write(two_boxes(false), "medit", ".mesh");
    const std::string& text = written.files.at(".mesh");
    EXPECT_EQ(numbers_after(text, "Hexahedra"), (std::vector<double>{2, 1, 2, 3, 4, 5, 6, 7, 8, 1, 2, 9, 10, 3, 6, 11, 12, 7, 2}));
    const auto quads = numbers_after(text, "Quadrilaterals");
    ASSERT_EQ(quads.size(), 1 + 11 * 5u) << "the fault once, and what lies outside";
    EXPECT_EQ(std::vector<double>(quads.begin() + 1, quads.begin() + 6), (std::vector<double>{2, 3, 7, 6, 1}));
    EXPECT_EQ(numbers_after(text, "Edges"), (std::vector<double>{2, 1, 5, 1, 5, 8, 1}));
    EXPECT_NE(text.find("# region 2: east\n"), std::string::npos);
    EXPECT_NE(text.find("# face set 1: F\n"), std::string::npos);
    EXPECT_TRUE(loses(written.losses, "west", "name of the region"));
    EXPECT_TRUE(loses(written.losses, "F_footwall", "side of faces"));
}

TEST(Medit, CornersOfEachTypeAreInTheOrderThatMakesItsVolumePositive) {
    const std::map<CellType, std::string> keywords{
        {CellType::tetrahedron, "Tetrahedra"}, {CellType::wedge, "Prisms"}, {CellType::hexahedron, "Hexahedra"}};
    for (const SampleCell& cell : sample_cells()) {
        if (is_second_order(cell.type)) continue;
        const std::string text = write(mesh_of(cell), "medit", ".mesh").files.at(".mesh");
        const auto vertices = numbers_after(text, "Vertices"), cells = numbers_after(text, keywords.at(cell.type));
        ASSERT_EQ(cells.size(), cell.corners.size() + 2);
        std::vector<Vec3> corners;
        for (std::size_t i = 1; i + 1 < cells.size(); ++i) {
            const auto at = 4 * static_cast<std::size_t>(cells[i] - 1) + 1;
            corners.push_back({vertices[at], vertices[at + 1], vertices[at + 2]});
        }
        EXPECT_DOUBLE_EQ(flat_volume(corners), cell.volume);
    }
}

TEST(TetGen, FilesOfOneNameHaveNumbersOfRegionsAndSetsAndValuesOfPoints) {
    CellMesh mesh = mesh_of(sample_cells()[0]);
    Attribute heat;
    heat.name = "heat";
    heat.values = std::vector<double>{0.5, 1, 1.5, 2};
    mesh.info.attributes.push_back(heat);
    const Written written = write(mesh, "tetgen", ".ele");
    ASSERT_EQ(written.files.size(), 4u);
    EXPECT_EQ(numbers_after(written.files.at(".node"), ""),
              (std::vector<double>{4, 3, 1, 0, 1, 0, 0, 0, 0.5, 2, 2, 0, 0, 1, 3, 0, 2, 0, 1.5, 4, 0, 0, 3, 2}));
    EXPECT_EQ(numbers_after(written.files.at(".ele"), ""), (std::vector<double>{1, 4, 1, 1, 1, 2, 3, 4, 1}));
    EXPECT_EQ(numbers_after(written.files.at(".face"), ""),
              (std::vector<double>{4, 1, 1, 1, 3, 2, 1, 2, 1, 2, 4, 2, 3, 2, 3, 4, 3, 4, 1, 4, 3, 4}));
}

TEST(TetGen, FurtherNodesStandWhereTetGenPutsThem) {
    const Written written = write(mesh_of(sample_cells()[3]), "tetgen", ".node");
    const auto points = numbers_after(written.files.at(".node"), ""), cells = numbers_after(written.files.at(".ele"), "");
    ASSERT_EQ(cells.size(), 3 + 12u);
    const auto at = [&](std::size_t i) {
        const auto p = static_cast<std::size_t>(cells[4 + i] - 1) * 4 + 5;
        return Vec3{points[p], points[p + 1], points[p + 2]};
    };
    // As `tetgen -o2` numbers them (1.6.0).
    const std::size_t ends[6][2] = {{2, 3}, {3, 0}, {0, 1}, {1, 2}, {1, 3}, {2, 0}};
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(at(4 + i), times(0.5, plus(at(ends[i][0]), at(ends[i][1]))));
}

TEST(TetGen, HasNoPlaceInAStream) {
    OutputSet out("/dev/null");
    const auto done = write_cells(mesh_of(sample_cells()[0]), "tetgen", out);
    ASSERT_FALSE(done);
    EXPECT_EQ(done.why().kind, FailureKind::usage);
}

TEST(Meshes, AFileWithoutCellsIsRefused) {
    for (const Format& format : meshes::formats()) {
        OutputSet out("/dev/null");
        const auto done = write_cells(CellMesh{}, format.name, out);
        ASSERT_FALSE(done);
        EXPECT_EQ(done.why().kind, FailureKind::cannot_hold);
        EXPECT_FALSE(format.write({}, out, {})) << "a dataset is not a prepared mesh";
    }
}

}  // namespace
}  // namespace geomend::test
