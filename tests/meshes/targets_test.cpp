// SPDX-License-Identifier: AGPL-3.0-or-later
// Meshes for simulators against readers that share nothing with the writers; values of the two boxes were worked out by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "base/vectors.h"
#include "meshes/cell_samples.h"
#include "meshes/written_mesh.h"
#include "support/temporary_folder.h"

namespace geomend::test {
namespace {

constexpr double west = 1.375, east = 1.625;  // volumes; the fault is the plane x = 1 + y / 2 + z / 4
const double fault_area = std::sqrt(1 + 0.25 + 0.0625);

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

std::vector<std::string> words_of(const std::string& line) {
    std::vector<std::string> words;
    std::istringstream in(line);
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

std::vector<Loss> write_into(CellMesh mesh, const char* format, const std::filesystem::path& file) {
    OutputSet out(file);
    auto losses = write_cells(std::move(mesh), format, out);
    EXPECT_TRUE(losses) << (losses ? "" : losses.why().error.message);
    return losses ? *losses : std::vector<Loss>{};
}

bool is_lost(const std::vector<Loss>& losses, const std::string& what) {
    return std::ranges::any_of(losses, [&](const Loss& loss) { return loss.what.find(what) != std::string::npos; });
}

/// Points and cells of a file, however it numbers them.
struct Cells {
    std::map<std::size_t, Vec3> points;
    std::vector<std::vector<std::size_t>> cells;
    std::vector<std::size_t> region;

    std::vector<Vec3> corners(std::size_t cell) const {
        std::vector<Vec3> at;
        for (const std::size_t p : cells[cell]) at.push_back(points.at(p));
        return at;
    }
};

// Abaqus' prism looks into the cell with its first triangle, VTK's wedge looks out of it.
double volume(Cells& cells, std::size_t cell, bool vtk_wedge) {
    auto corners = cells.corners(cell);
    if (corners.size() == 6 && vtk_wedge) std::swap(corners[1], corners[2]), std::swap(corners[4], corners[5]);
    return flat_volume(corners);
}

TEST(Ucd, HasCellsTheRightWayOutWithTheirRegions) {
    for (const SampleCell& sample : sample_cells()) {
        const TemporaryFolder folder;
        write_into(mesh_of(sample), "avs-ucd", folder / "m.ucd");
        std::istringstream in(read_file(folder / "m.ucd").substr(std::string("# material 1: rock\n").size()));
        std::size_t points = 0, count = 0, id = 0, region = 0, rest = 0;
        in >> points >> count >> rest >> rest >> rest;
        ASSERT_EQ(points, sample.corners.size());
        ASSERT_EQ(count, 1u);
        Cells cells;
        for (std::size_t i = 0; i < points; ++i) {
            in >> id;
            in >> cells.points[id][0] >> cells.points[id][1] >> cells.points[id][2];
        }
        std::string word;
        in >> id >> region >> word;
        EXPECT_EQ(region, 1u);
        EXPECT_EQ(word, points == 4 ? "tet" : points == 6 ? "prism" : "hex");
        cells.cells.emplace_back();
        for (std::size_t node = 0; in >> node;) cells.cells[0].push_back(node);
        EXPECT_NEAR(volume(cells, 0, true), sample.volume, 1e-12);
    }
}

TEST(Ucd, HasValuesAtPointsAndInCellsAndListsTexts) {
    CellMesh mesh = two_boxes(false);
    const auto add = [&](const char* name, AttributeLocation location, AttributeValues values, std::uint32_t components) {
        Attribute a;
        a.name = name;
        a.unit = "m";
        a.location = location;
        a.components = components;
        a.values = std::move(values);
        mesh.info.attributes.push_back(std::move(a));
    };
    std::vector<double> height, shift;
    for (const Vec3& p : mesh.points) height.push_back(p[2]), shift.insert(shift.end(), {p[0], p[1]});
    add("height, of points", AttributeLocation::point, height, 1);
    add("shift", AttributeLocation::point, shift, 2);
    add("porosity", AttributeLocation::cell, std::vector<double>{0.25, 0.125, 0, 0, 0}, 1);
    add("rock", AttributeLocation::cell, std::vector<std::string>{"a", "b", "", "", ""}, 1);
    const TemporaryFolder folder;
    EXPECT_TRUE(is_lost(write_into(mesh, "avs-ucd", folder / "m.ucd"), "'rock'"));
    const auto lines = lines_of(read_file(folder / "m.ucd"));
    EXPECT_EQ(lines[2], "12 2 3 1 0");
    EXPECT_EQ(lines[17], "2 1 2");
    EXPECT_EQ(lines[18], "height  of points, m");
    EXPECT_EQ(lines[20 + 5], "6 1 1.25 0");
    EXPECT_EQ(lines[32], "1 1");
    EXPECT_EQ(lines[34], "1 0.25");
    EXPECT_EQ(lines[35], "2 0.125");
}

TEST(Mfem, HasElementsAndBoundaryWithNumbers) {
    const TemporaryFolder folder;
    write_into(two_boxes(false), "mfem", folder / "m.mfem");
    std::string text;
    for (const auto& line : lines_of(read_file(folder / "m.mfem"))) {
        if (!line.starts_with("#")) text += line + '\n';
    }
    std::istringstream in(text);
    Cells cells;
    std::map<std::size_t, std::size_t> faces;  // how many of each attribute
    std::string word;
    while (in >> word) {
        if (word == "elements") {
            std::size_t count = 0, region = 0, kind = 0;
            in >> count;
            for (std::size_t c = 0; c < count; ++c) {
                in >> region >> kind;
                EXPECT_EQ(kind, 5u);
                cells.region.push_back(region);
                cells.cells.emplace_back(8);
                for (std::size_t& node : cells.cells.back()) in >> node;
            }
        } else if (word == "boundary") {
            std::size_t count = 0, attribute = 0, kind = 0, node = 0;
            in >> count;
            for (std::size_t f = 0; f < count; ++f) {
                in >> attribute >> kind >> node >> node >> node >> node;
                EXPECT_EQ(kind, 3u);
                ++faces[attribute];
            }
        } else if (word == "vertices") {
            std::size_t count = 0, dimension = 0;
            in >> count >> dimension;
            for (std::size_t v = 0; v < count; ++v) in >> cells.points[v][0] >> cells.points[v][1] >> cells.points[v][2];
        }
    }
    ASSERT_EQ(cells.cells.size(), 2u);
    EXPECT_EQ(cells.region, (std::vector<std::size_t>{1, 2}));
    EXPECT_NEAR(volume(cells, 0, true), west, 1e-12);
    EXPECT_NEAR(volume(cells, 1, true), east, 1e-12);
    EXPECT_EQ(faces, (std::map<std::size_t, std::size_t>{{1, 1}, {2, 5}, {3, 5}})) << "the fault once, and both outsides";
}

/// The blocks of a Code_Aster text: each with its head, and its words.
std::map<std::string, std::vector<std::string>> read_mail(const std::string& text) {
    std::map<std::string, std::vector<std::string>> blocks;
    std::string head;
    for (const std::string& line : lines_of(text)) {
        EXPECT_LE(line.size(), 80u);
        if (line == "FINSF") head.clear();
        else if (head.empty()) blocks[head = line];
        else
            for (auto& word : words_of(line)) blocks[head].push_back(word);
    }
    return blocks;
}

TEST(CodeAster, IsSplitAlongTheFaultAndHasGroups) {
    const TemporaryFolder folder;
    write_into(two_boxes(false), "code-aster", folder / "m.mail");
    auto blocks = read_mail(read_file(folder / "m.mail"));
    EXPECT_EQ(blocks["COOR_3D"].size(), 16u * 4) << "four points of the fault are there twice";
    const auto& cells = blocks["HEXA8"];
    ASSERT_EQ(cells.size(), 18u);
    Cells read;
    for (std::size_t i = 0; i < blocks["COOR_3D"].size(); i += 4)
        for (std::size_t k = 0; k < 3; ++k)
            read.points[std::stoul(blocks["COOR_3D"][i].substr(1))][k] = std::stod(blocks["COOR_3D"][i + k + 1]);
    std::set<std::string> used;
    for (std::size_t c = 0; c < 2; ++c) {
        read.cells.emplace_back();
        for (std::size_t k = 1; k < 9; ++k) {
            EXPECT_TRUE(used.insert(cells[9 * c + k]).second) << "no node of both boxes";
            read.cells[c].push_back(std::stoul(cells[9 * c + k].substr(1)));
        }
    }
    EXPECT_NEAR(volume(read, 0, true), west, 1e-12);
    EXPECT_NEAR(volume(read, 1, true), east, 1e-12);
    EXPECT_EQ(blocks["GROUP_MA NOM=west"], std::vector<std::string>{"M1"});
    EXPECT_EQ(blocks["GROUP_MA NOM=east"], std::vector<std::string>{"M2"});
    const auto hanging = blocks["GROUP_MA NOM=F_hanging_wall"], foot = blocks["GROUP_MA NOM=F_footwall"];
    ASSERT_EQ(hanging.size(), 1u);
    ASSERT_EQ(foot.size(), 1u);
    const auto& quads = blocks["QUAD4"];
    const auto at = [&](const std::string& name) { return std::ranges::find(quads, name) - quads.begin(); };
    for (std::size_t k = 1; k < 5; ++k) {
        EXPECT_TRUE(std::ranges::count(cells.begin() + 1, cells.begin() + 9, quads[at(hanging[0]) + k]) == 1) << "of the box below";
        EXPECT_TRUE(std::ranges::count(cells.begin() + 10, cells.end(), quads[at(foot[0]) + k]) == 1);
    }
    EXPECT_EQ(blocks["GROUP_MA NOM=W"].size(), 2u);
    EXPECT_EQ(blocks["SEG2"].size(), 6u);
}

TEST(CodeAster, EachTypeIsTheRightWayOut) {
    for (const SampleCell& sample : sample_cells()) {
        if (is_second_order(sample.type)) continue;
        const TemporaryFolder folder;
        write_into(mesh_of(sample), "code-aster", folder / "m.mail");
        auto blocks = read_mail(read_file(folder / "m.mail"));
        Cells read;
        for (std::size_t i = 0; i < blocks["COOR_3D"].size(); i += 4) {
            for (std::size_t k = 0; k < 3; ++k)
                read.points[std::stoul(blocks["COOR_3D"][i].substr(1))][k] = std::stod(blocks["COOR_3D"][i + k + 1]);
        }
        const char* word = sample.corners.size() == 4 ? "TETRA4" : sample.corners.size() == 6 ? "PENTA6" : "HEXA8";
        read.cells.emplace_back();
        for (std::size_t k = 1; k < blocks[word].size(); ++k) read.cells[0].push_back(std::stoul(blocks[word][k].substr(1)));
        EXPECT_NEAR(volume(read, 0, false), sample.volume, 1e-12) << word << ", whose 1 2 3 look towards 4 5 6";
    }
}

/// What stands in brackets behind the head of a file of OpenFOAM, line by line.
std::vector<std::string> foam_list(const std::filesystem::path& file) {
    const auto lines = lines_of(read_file(file));
    const auto first = std::ranges::find(lines, "("), last = std::find(lines.rbegin(), lines.rend(), ")").base() - 1;
    EXPECT_EQ(std::stoul(*(first - 1)), std::size_t(last - first) - 1) << file;
    return {first + 1, last};
}

std::vector<double> numbers_in(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return c == '(' || c == ')'; }, ' ');
    std::vector<double> numbers;
    for (const auto& word : words_of(text)) numbers.push_back(std::stod(word));
    return numbers;
}

/// Volumes of cells by the flux through their faces; each closes.
std::vector<double> foam_volumes(const std::filesystem::path& folder, std::size_t cells) {
    std::vector<Vec3> points;
    for (const auto& line : foam_list(folder / "points")) {
        const auto p = numbers_in(line);
        points.push_back({p[0], p[1], p[2]});
    }
    const auto faces = foam_list(folder / "faces"), owners = foam_list(folder / "owner"), neighbours = foam_list(folder / "neighbour");
    EXPECT_EQ(faces.size(), owners.size());
    std::vector<double> volumes(cells, 0);
    std::vector<Vec3> areas(cells);
    std::pair<std::size_t, std::size_t> before{0, 0};
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const auto nodes = numbers_in(faces[f]);
        double flux = 0;
        Vec3 area{};
        for (std::size_t k = 2; k + 1 < nodes.size(); ++k) {
            const Vec3 &a = points[std::size_t(nodes[1])], &b = points[std::size_t(nodes[k])], &c = points[std::size_t(nodes[k + 1])];
            flux += dot(a, cross(b, c)) / 6;
            area = plus(area, times(0.5, cross(minus(b, a), minus(c, a))));
        }
        const std::size_t owner = std::stoul(owners[f]);
        volumes[owner] += flux;
        areas[owner] = plus(areas[owner], area);
        if (f >= neighbours.size()) continue;
        const std::size_t neighbour = std::stoul(neighbours[f]);
        EXPECT_LT(owner, neighbour);
        EXPECT_TRUE(f == 0 || before < std::pair(owner, neighbour)) << "upper triangular order";
        before = {owner, neighbour};
        volumes[neighbour] -= flux;
        areas[neighbour] = minus(areas[neighbour], area);
    }
    for (const Vec3& area : areas) EXPECT_NEAR(dot(area, area), 0, 1e-24);
    return volumes;
}

TEST(OpenFoam, FacesLookOutOfTheirOwnersAndCloseEachCell) {
    const TemporaryFolder folder;
    for (const SampleCell& sample : sample_cells()) {
        write_into(mesh_of(sample), "openfoam", folder / "case.foam");
        const auto volumes = foam_volumes(folder / "constant/polyMesh", 1);
        EXPECT_NEAR(volumes[0], sample.volume, 1e-12);
    }
    write_into(two_boxes(false), "openfoam", folder / "case.foam");
    const auto volumes = foam_volumes(folder / "constant/polyMesh", 2);
    EXPECT_NEAR(volumes[0], west, 1e-12);
    EXPECT_NEAR(volumes[1], east, 1e-12);
}

TEST(OpenFoam, ASplitFaultIsTwoPatchesAndAnotherOneAZone) {
    const TemporaryFolder folder;
    for (const char* name : {"a", "b"}) std::filesystem::create_directory(folder / name);
    write_into(two_boxes(false), "openfoam", folder / "a/case.foam");
    std::string boundary = read_file(folder / "a/constant/polyMesh/boundary");
    EXPECT_EQ(boundary.find("F_"), std::string::npos) << boundary;
    EXPECT_NE(boundary.find("    west_outside\n    {\n        type patch;\n        nFaces 5;\n        startFace 1;"), std::string::npos)
        << boundary;
    EXPECT_NE(boundary.find("nFaces 5;\n        startFace 6;"), std::string::npos) << boundary;
    EXPECT_NE(read_file(folder / "a/constant/polyMesh/faceZones").find("faceLabels List<label>\n1\n(\n0\n)"), std::string::npos);
    write_into(two_boxes(true), "openfoam", folder / "b/case.foam");
    boundary = read_file(folder / "b/constant/polyMesh/boundary");
    EXPECT_NE(boundary.find("F_hanging_wall"), std::string::npos) << boundary;
    EXPECT_NE(boundary.find("F_footwall"), std::string::npos) << boundary;
    EXPECT_EQ(foam_list(folder / "b/constant/polyMesh/faceZones").size(), 0u) << "in the place of those of an older mesh";
}

TEST(OpenFoam, CannotGoIntoAStream) {
    OutputSet out("-");
    const auto written = write_cells(two_boxes(false), "openfoam", out);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.why().kind, FailureKind::usage);
}

TEST(Pflotran, HasVolumesAreasAndFilesOfRegionsAndFaces) {
    for (const bool doubled : {false, true}) {
        const TemporaryFolder folder;
        write_into(two_boxes(doubled), "pflotran", folder / "m.uge");
        const auto lines = lines_of(read_file(folder / "m.uge"));
        ASSERT_EQ(lines.size(), 5u);
        EXPECT_EQ(lines[0], "CELLS 2");
        const auto first = numbers_in(lines[1]), second = numbers_in(lines[2]), joint = numbers_in(lines[4]);
        EXPECT_NEAR(first[4], west, 1e-12);
        EXPECT_NEAR(second[4], east, 1e-12);
        EXPECT_NEAR(first[1] * west + second[1] * east, 4.5, 1e-12) << "centre of mass of both";
        EXPECT_NEAR(first[3] * west + second[3] * east, 1.5, 1e-12);
        EXPECT_EQ(lines[3], "CONNECTIONS 1");
        EXPECT_EQ(joint[0], 1);
        EXPECT_EQ(joint[1], 2);
        EXPECT_NEAR(joint[2], 1 + joint[3] / 2 + joint[4] / 4, 1e-12) << "on the fault";
        EXPECT_NEAR(joint[3], 0.5, 1e-12);
        EXPECT_NEAR(joint[5], fault_area, 1e-12);
        EXPECT_EQ(read_file(folder / "m_west.txt"), "1\n");
        EXPECT_EQ(read_file(folder / "m_east.txt"), "2\n");
        const auto faces = lines_of(read_file(folder / "m_west_outside.ex"));
        EXPECT_EQ(faces[0], "CONNECTIONS 5");
        double area = 0;
        for (std::size_t i = 1; i < faces.size(); ++i) area += numbers_in(faces[i])[4];
        EXPECT_NEAR(area, 1 + 1.125 + 1.625 + 1.25 + 1.5, 1e-12);
        EXPECT_FALSE(std::filesystem::exists(folder / "m_F.ex")) << "the fault is between cells";
    }
}

TEST(Tough2, IsReadByItsColumns) {
    const TemporaryFolder folder;
    write_into(two_boxes(false), "tough2", folder / "MESH");
    const auto lines = lines_of(read_file(folder / "MESH"));
    ASSERT_EQ(lines.size(), 7u);
    EXPECT_EQ(lines[0], "ELEME");
    const auto field = [](const std::string& line, std::size_t from, std::size_t size) { return line.substr(from, size); };
    EXPECT_EQ(field(lines[1], 0, 5), "A0000");
    EXPECT_EQ(field(lines[2], 0, 5), "A0001");
    EXPECT_EQ(field(lines[1], 15, 5), "west ");
    EXPECT_NEAR(std::stod(field(lines[1], 20, 10)), west, 1e-4);
    EXPECT_NEAR(std::stod(field(lines[2], 20, 10)), east, 1e-4);
    const double x = std::stod(field(lines[1], 50, 10)), z = std::stod(field(lines[1], 70, 10));
    const double x2 = std::stod(field(lines[2], 50, 10)), z2 = std::stod(field(lines[2], 70, 10)), y2 = std::stod(field(lines[2], 60, 10)),
                 y = std::stod(field(lines[1], 60, 10));
    EXPECT_EQ(lines[3], "");
    EXPECT_EQ(lines[4], "CONNE");
    EXPECT_EQ(field(lines[5], 0, 10), "A0000A0001");
    EXPECT_EQ(field(lines[5], 25, 5), "    1");
    const double first = std::stod(field(lines[5], 30, 10)), second = std::stod(field(lines[5], 40, 10));
    EXPECT_NEAR(first + second, std::hypot(x2 - x, y2 - y, z2 - z), 2e-3);
    EXPECT_NEAR(std::stod(field(lines[5], 50, 10)), fault_area, 1e-4);
    EXPECT_NEAR(std::stod(field(lines[5], 60, 10)), (z - z2) / (first + second), 2e-3);
    EXPECT_EQ(lines[6], "");
}

TEST(Tough2, GravityIsWithTheLineToADeeperElement) {
    CellMesh mesh = two_boxes(false);
    for (Vec3& p : mesh.points) p = {p[1], p[2], -p[0]};  // the second box below the first
    const TemporaryFolder folder;
    write_into(mesh, "tough2", folder / "MESH");
    const std::string connection = lines_of(read_file(folder / "MESH"))[5];
    EXPECT_EQ(connection.substr(25, 5), "    3");
    EXPECT_GT(std::stod(connection.substr(60, 10)), 0.9);
}

TEST(Modflow, ConnectionsAreSymmetricAndGiveAreasOfFaces) {
    const TemporaryFolder folder;
    write_into(two_boxes(false), "modflow-disu", folder / "m.disu");
    std::map<std::string, std::vector<double>> lists;
    std::string name;
    for (const auto& line : lines_of(read_file(folder / "m.disu"))) {
        const auto words = words_of(line);
        if (words.empty() || words[0] == "#" || words[0] == "BEGIN" || words[0] == "END" || words[0] == "INTERNAL") continue;
        if (words[0] == "NODES" || words[0] == "NJA") lists[words[0]] = {std::stod(words[1])};
        else if (std::isalpha(words[0][0]) != 0) name = words[0];
        else
            for (const auto& word : words) lists[name].push_back(std::stod(word));
    }
    EXPECT_EQ(lists["NODES"], std::vector<double>{2});
    EXPECT_EQ(lists["NJA"], std::vector<double>{4});
    EXPECT_EQ(lists["IAC"], (std::vector<double>{2, 2}));
    EXPECT_EQ(lists["JA"], (std::vector<double>{1, 2, 2, 1}));
    EXPECT_EQ(lists["IHC"], (std::vector<double>{1, 1, 1, 1}));
    for (std::size_t c = 0; c < 2; ++c) EXPECT_NEAR(lists["AREA"][c] * (lists["TOP"][c] - lists["BOT"][c]), c == 0 ? west : east, 1e-12);
    EXPECT_EQ(lists["HWVA"][1], lists["HWVA"][3]);
    EXPECT_NEAR(lists["HWVA"][1] * 1, fault_area, 1e-12) << "both boxes are 1 high";
    EXPECT_GT(lists["CL12"][1], 0.5);
}

TEST(TetGenNeighbours, AreBeyondTheFaceOppositeToTheirCornerAndMutual) {
    CellMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {-1, 0, 0}};
    for (const std::vector<std::uint32_t>& cell : {std::vector<std::uint32_t>{0, 1, 2, 3}, {1, 2, 3, 4}, {0, 3, 2, 5}})
        mesh.add_cell(CellType::tetrahedron, cell);
    const TemporaryFolder folder;
    write_into(mesh, "tetgen", folder / "m.node");
    const auto cells = lines_of(read_file(folder / "m.ele")), beyond = lines_of(read_file(folder / "m.neigh"));
    EXPECT_EQ(beyond[0], "3 4");
    std::map<std::size_t, std::vector<std::string>> nodes;
    for (const auto& line : cells) {
        const auto words = words_of(line);
        if (words.size() == 6 && words[0] != "#") nodes[std::stoul(words[0])] = {words.begin() + 1, words.begin() + 5};
    }
    ASSERT_EQ(nodes.size(), 3u);
    std::size_t shared = 0;
    for (std::size_t c = 1; c <= 3; ++c) {
        const auto words = words_of(beyond[c]);
        for (std::size_t k = 0; k < 4; ++k) {
            if (words[k + 1] == "-1") continue;
            ++shared;
            const std::size_t other = std::stoul(words[k + 1]);
            for (std::size_t m = 0; m < 4; ++m) {
                const std::ptrdiff_t wanted = m == k ? 0 : 1;
                EXPECT_EQ(std::ranges::count(nodes[other], nodes[c][m]), wanted) << "corners of the face are shared, the other one is not";
            }
            const auto back = words_of(beyond[other]);
            EXPECT_EQ(std::count(back.begin() + 1, back.end(), std::to_string(c)), 1);
        }
    }
    EXPECT_EQ(shared, 4u) << "two faces, from both sides";
}

TEST(Gprs, HasPipesVolumesCentresAndAreas) {
    const TemporaryFolder folder;
    write_into(two_boxes(false), "gprs", folder / "m.gprs");
    EXPECT_EQ(read_file(folder / "m.gprs"), "1\n0 1\n");
    const auto volumes = lines_of(read_file(folder / "m_vol.in"));
    EXPECT_EQ(volumes[0], "2");
    EXPECT_NEAR(std::stod(volumes[1]), west, 1e-12);
    EXPECT_NEAR(std::stod(lines_of(read_file(folder / "m_area.in"))[1]), fault_area, 1e-12);
    EXPECT_EQ(lines_of(read_file(folder / "m.xyz")).size(), 2u);
}

}  // namespace
}  // namespace geomend::test
