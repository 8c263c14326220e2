// SPDX-License-Identifier: AGPL-3.0-or-later
// The same cells as programs read them: Gmsh and VTK number wedges in opposite senses, and each file is to have its own program's order.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "support/program.h"

namespace geomend::test {

namespace {

using Point = std::array<double, 3>;

double triple(const Point& o, const Point& a, const Point& b, const Point& c) {
    const auto d = [&](const Point& p, std::size_t k) { return p[k] - o[k]; };
    return d(c, 0) * (d(a, 1) * d(b, 2) - d(a, 2) * d(b, 1)) + d(c, 1) * (d(a, 2) * d(b, 0) - d(a, 0) * d(b, 2)) +
           d(c, 2) * (d(a, 0) * d(b, 1) - d(a, 1) * d(b, 0));
}

/// An affine map without mirroring, of integers so that volumes are exact.
struct Frame {
    std::array<std::array<double, 3>, 3> m;
    Point origin;

    Point of(double x, double y, double z) const {
        Point p = origin;
        for (std::size_t k = 0; k < 3; ++k) p[k] += m[k][0] * x + m[k][1] * y + m[k][2] * z;
        return p;
    }
};

using Random = std::mt19937;

int below(Random& random, int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); }

Frame random_frame(Random& random) {
    Frame f;
    do {
        for (auto& row : f.m) {
            for (double& v : row) v = below(random, 19) - 9;
        }
        for (double& v : f.origin) v = std::array{0.0, 431000.0, -2300.0}[static_cast<std::size_t>(below(random, 3))];
    } while (triple({0, 0, 0}, {f.m[0][0], f.m[1][0], f.m[2][0]}, {f.m[0][1], f.m[1][1], f.m[2][1]}, {f.m[0][2], f.m[1][2], f.m[2][2]}) <
             1);
    return f;
}

struct Mesh {
    std::vector<Point> points;
    std::vector<std::vector<std::size_t>> cells;
    int type = 6;
    double volume = 0;

    std::size_t add(const Point& p) {
        points.push_back(p);
        return points.size() - 1;
    }
    std::size_t middle(std::size_t a, std::size_t b) {
        Point p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = (points[a][k] + points[b][k]) / 2;
        return add(p);
    }
};

/// Wedges on each other as Gmsh numbers them, some of them by another corner first; of second order with nodes of their own.
Mesh wedges(const Frame& f, std::size_t count, bool second_order, Random& random) {
    Mesh mesh;
    mesh.type = second_order ? 18 : 6;
    std::array<std::size_t, 3> lower{mesh.add(f.of(0, 0, 0)), mesh.add(f.of(1, 0, 0)), mesh.add(f.of(0, 1, 0))};
    for (std::size_t c = 0; c < count; ++c) {
        const double z = static_cast<double>(c + 1);
        std::array<std::size_t, 3> above{mesh.add(f.of(0, 0, z)), mesh.add(f.of(1, 0, z)), mesh.add(f.of(0, 1, z))};
        const auto turn = static_cast<std::size_t>(below(random, 3));
        std::vector<std::size_t> cell;
        for (const std::array<std::size_t, 3>* ring : {&lower, &above}) {
            for (std::size_t k = 0; k < 3; ++k) cell.push_back((*ring)[(k + turn) % 3]);
        }
        if (second_order) {  // Gmsh's order of edges
            constexpr std::size_t ends[9][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}};
            for (const auto& [a, b] : ends) cell.push_back(mesh.middle(cell[a], cell[b]));
        }
        mesh.cells.push_back(std::move(cell));
        lower = above;
    }
    mesh.volume = static_cast<double>(count) / 2 * triple(f.of(0, 0, 0), f.of(1, 0, 0), f.of(0, 1, 0), f.of(0, 0, 1));
    return mesh;
}

Mesh tetrahedra(const Frame& f) {
    Mesh mesh;
    mesh.type = 4;
    for (const auto& [x, y, z] :
         std::initializer_list<Point>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}})
        mesh.add(f.of(x, y, z));
    mesh.cells = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
    mesh.volume = triple(f.of(0, 0, 0), f.of(1, 0, 0), f.of(0, 1, 0), f.of(0, 0, 1));
    return mesh;
}

std::string msh_of(const Mesh& mesh) {
    std::ostringstream out;
    out.precision(17);
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"rock\"\n$EndPhysicalNames\n$Nodes\n"
        << mesh.points.size() << '\n';
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        out << i + 1 << ' ' << mesh.points[i][0] << ' ' << mesh.points[i][1] << ' ' << mesh.points[i][2] << '\n';
    out << "$EndNodes\n$Elements\n" << mesh.cells.size() << '\n';
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        out << c + 1 << ' ' << mesh.type << " 2 1 1";
        for (const std::size_t node : mesh.cells[c]) out << ' ' << node + 1;
        out << '\n';
    }
    out << "$EndElements\n";
    return out.str();
}

double volume_of(const std::filesystem::path& file) { return info(file)["objects"][0]["volume"].get<double>(); }

bool near(double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(b); }

/// Least triple product of the first corners of the wedges of a text MSH 2.2 file: positive for Gmsh.
double least_in_gmsh(const std::string& text) {
    std::istringstream in(text.substr(text.find("$Nodes") + 6));
    std::size_t count = 0, id = 0;
    in >> count;
    std::map<std::size_t, Point> points;
    for (std::size_t i = 0; i < count; ++i) {
        in >> id;
        for (double& v : points[id]) in >> v;
    }
    std::istringstream elements(text.substr(text.find("$Elements") + 9));
    elements >> count;
    double least = HUGE_VAL;
    std::string line;
    std::getline(elements, line);
    for (std::size_t i = 0; i < count && std::getline(elements, line); ++i) {
        std::istringstream words(line);
        std::size_t number = 0, type = 0, tags = 0, skipped = 0;
        words >> number >> type >> tags;
        for (std::size_t t = 0; t < tags; ++t) words >> skipped;
        std::array<std::size_t, 4> n{};
        for (std::size_t& node : n) words >> node;
        if (type == 6 || type == 18) least = std::min(least, triple(points[n[0]], points[n[1]], points[n[2]], points[n[3]]));
    }
    return least;
}

/// The numbers of a text array of a VTK XML file.
std::vector<double> numbers_of(const std::string& text, const std::string& name) {
    const std::size_t begin = text.find('>', text.find(name)) + 1;
    std::istringstream in(text.substr(begin, text.find('<', begin) - begin));
    std::vector<double> numbers;
    for (double v = 0; in >> v;) numbers.push_back(v);
    return numbers;
}

/// The same of a text VTK XML file, where the first triangle looks out of the cell: positive for VTK.
double least_in_vtk(const std::string& text) {
    const auto xyz = numbers_of(text, "Name=\"Points\""), nodes = numbers_of(text, "Name=\"connectivity\""),
               ends = numbers_of(text, "Name=\"offsets\"");
    const auto point = [&](std::size_t i) {
        const auto n = static_cast<std::size_t>(nodes[i]);
        return Point{xyz[3 * n], xyz[3 * n + 1], xyz[3 * n + 2]};
    };
    double least = HUGE_VAL;
    std::size_t first = 0;
    for (const double end : ends) {
        least = std::min(least, triple(point(first), point(first + 2), point(first + 1), point(first + 3)));
        first = static_cast<std::size_t>(end);
    }
    return least;
}

void convert(const std::filesystem::path& from, const std::filesystem::path& to, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"convert", from.string(), "-o", to.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = run_geomend(arguments);
    ASSERT_EQ(run.status, 0) << run.err;
}

// Cells do not go into a model of surfaces: what surrounds them there has to close.
TEST(CellsBetweenPrograms, ASolidThatLeavesOutAFaceIsAModelWhoseRegionsClose) {
    const TemporaryFolder folder;
    std::string solid = read_file(std::string(GEOMEND_SOURCE_DIR) + "/samples/layered_box.so");
    const std::size_t face = solid.find("TFACE 5\n"), next = solid.find("TFACE 6\n");
    ASSERT_LT(face, next);
    solid.erase(face, next - face);
    write_file(folder / "part.so", solid);
    const std::string model = (folder / "part.ml").string();
    ASSERT_EQ(run_geomend({"convert", (folder / "part.so").string(), "-o", model, "--lossy"}).status, 0);
    EXPECT_EQ(run_geomend({"validate", model}).status, 0);
    const auto told = nlohmann::json::parse(run_geomend({"info", "--json", model}).out);
    ASSERT_EQ(told[0]["brep"]["region_volumes"].size(), 6u);
    for (const auto& region : told[0]["brep"]["region_volumes"]) EXPECT_TRUE(region["volume"].is_number()) << region;
    // As a solid it stays as it is.
    ASSERT_EQ(run_geomend({"convert", (folder / "part.so").string(), "-o", (folder / "again.so").string(), "--lossy"}).status, 0);
    const std::string again = read_file(folder / "again.so");
    EXPECT_EQ(again.find("TFACE 31"), std::string::npos);
}

}  // namespace

TEST(CellsBetweenPrograms, WedgesKeepTheirVolumesAndTheOrderOfEachProgram) {
    for (unsigned seed = 1; seed <= 24; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const Frame frame = random_frame(random);
        const auto count = static_cast<std::size_t>(1 + below(random, 3));
        const Mesh mesh = wedges(frame, count, seed % 2 == 0, random);
        const TemporaryFolder folder;
        write_file(folder / "a.msh", msh_of(mesh));
        convert(folder / "a.msh", folder / "b.vtu", {"--option", "encoding=ascii"});
        convert(folder / "b.vtu", folder / "c.msh", {"--option", "version=2.2", "--option", "order=2"});
        convert(folder / "c.msh", folder / "d.vtk");
        for (const char* name : {"a.msh", "b.vtu", "c.msh", "d.vtk"}) EXPECT_TRUE(near(volume_of(folder / name), mesh.volume)) << name;
        EXPECT_GT(least_in_gmsh(read_file(folder / "a.msh")), 0);
        EXPECT_GT(least_in_vtk(read_file(folder / "b.vtu")), 0);
        EXPECT_GT(least_in_gmsh(read_file(folder / "c.msh")), 0);
    }
}

TEST(CellsBetweenPrograms, TetrahedraKeepTheirVolumesThroughASolid) {
    for (unsigned seed = 1; seed <= 12; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const Mesh mesh = tetrahedra(random_frame(random));
        const TemporaryFolder folder;
        write_file(folder / "a.msh", msh_of(mesh));
        convert(folder / "a.msh", folder / "b.so");
        convert(folder / "b.so", folder / "c.vtu", {"--lossy"});
        convert(folder / "c.vtu", folder / "d.msh");
        for (const char* name : {"a.msh", "b.so", "c.vtu", "d.msh"}) EXPECT_TRUE(near(volume_of(folder / name), mesh.volume)) << name;
    }
}

}  // namespace geomend::test
