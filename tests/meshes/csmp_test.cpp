// SPDX-License-Identifier: AGPL-3.0-or-later
// The files of CSMP++ against a reader that goes through them as the description of the format says, and shares nothing with the writer.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "meshes/cell_samples.h"
#include "meshes/written_mesh.h"
#include "support/temporary_folder.h"

namespace geomend::test {
namespace {

using Nodes = std::vector<std::size_t>;

/// What the reference elements say: nodes, and the nodes of what lies towards each neighbour.
struct Reference {
    std::string name;
    std::size_t nodes;
    std::vector<Nodes> towards;
};

const Reference& reference(int number) {
    static const std::map<int, Reference> all{
        {2, {"BAR_2", 2, {{0}, {1}}}},
        {8, {"TRI_3", 3, {{1, 2}, {2, 0}, {0, 1}}}},
        {14, {"QUAD_4", 4, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}}},
        {4, {"TETRA_4", 4, {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}}},
        {6, {"HEXA_8", 8, {{0, 1, 2, 3}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}}}},
        {12, {"PENTA_6", 6, {{0, 1, 2}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}, {3, 4, 5}}}},
        {18, {"PYRA_5", 5, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {0, 1, 2, 3}}}}};
    return all.at(number);
}

struct CsmpFiles {
    struct Family {
        std::string name, kind;
        int material = 0;
        std::vector<std::size_t> elements;
    };
    std::vector<Family> families;
    std::vector<Vec3> points;  ///< turned back: the file's y is up
    std::vector<int> flags;
    struct Element {
        int number = 0, material = 0;
        Nodes nodes;
        std::vector<long> neighbours;
    };
    std::vector<Element> elements;
    std::vector<std::string> regions;

    CsmpFiles(const TemporaryFolder& folder, const std::string& stem) {
        read_families(folder / (stem + ".asc"));
        read_data(folder / (stem + ".dat"));
        std::istringstream in(read_file(folder / (stem + "-regions.txt")));
        std::string line;
        std::getline(in, line);
        std::getline(in, line);
        EXPECT_EQ(line, "no properties");
        while (std::getline(in, line)) regions.push_back(line);
    }

    const Family& family(const std::string& name, const std::string& kind) const {
        const auto found = std::ranges::find_if(families, [&](const Family& f) { return f.name == name && f.kind == kind; });
        EXPECT_NE(found, families.end()) << name << ' ' << kind;
        static const Family none;
        return found == families.end() ? none : *found;
    }

private:
    static std::string after_comments(std::istream& in) {
        std::string line;
        while (std::getline(in, line) && line.starts_with('#')) {
        }
        return line;
    }
    void read_families(const std::string& path) {
        std::istringstream in(read_file(path));
        std::string line;
        std::getline(in, line);
        std::getline(in, line);
        EXPECT_FALSE(line.empty() || std::isdigit(static_cast<unsigned char>(line[0])))
            << "the reader looks for the first line with a digit";
        families.resize(std::stoul(after_comments(in)));
        std::vector<std::size_t> counts;
        for (Family& f : families) {
            std::istringstream row(after_comments(in));
            std::size_t count = 0;
            EXPECT_TRUE(row >> f.name >> f.kind >> f.material >> count);
            counts.push_back(count);
        }
        for (std::size_t f = 0; f < families.size(); ++f) {
            std::istringstream row(after_comments(in));
            std::string name, kind;
            std::size_t count = 0;
            row >> name >> kind >> count;
            EXPECT_EQ(name, families[f].name);
            EXPECT_EQ(kind, families[f].kind);
            EXPECT_EQ(count, counts[f]);
            families[f].elements.resize(count);
            for (std::size_t& e : families[f].elements) in >> e;
            std::getline(in, line);  // what is left of the last line
        }
    }
    static std::size_t head(std::istream& in, const char* title) {
        std::size_t count = 0;
        std::string line;
        in >> count;
        std::getline(in, line);
        EXPECT_NE(line.find(title), std::string::npos) << line;
        return count;
    }
    void read_data(const std::string& path) {
        std::istringstream in(read_file(path));
        std::string line;
        points.resize(head(in, "px, py, pz"));
        for (Vec3& p : points) in >> p[0];
        for (Vec3& p : points) in >> p[2];
        for (Vec3& p : points) {
            in >> p[1];
            p[1] = -p[1];
        }
        flags.resize(points.size());
        std::getline(in, line);
        std::getline(in, line);
        EXPECT_EQ(line, "# pbflags");
        for (int& f : flags) in >> f;
        std::getline(in, line);
        std::getline(in, line);
        EXPECT_EQ(line, "# pbvals");
        double value = 0;
        for (std::size_t i = 0; i < points.size(); ++i) in >> value;
        elements.resize(head(in, "pelements"));
        for (Element& e : elements) in >> e.number;
        std::size_t left = head(in, "plist");
        for (Element& e : elements) {
            e.nodes.resize(reference(e.number).nodes);
            for (std::size_t& n : e.nodes) in >> n;
            left -= e.nodes.size();
        }
        EXPECT_EQ(left, 0u);
        left = head(in, "pfverts");
        for (Element& e : elements) {
            e.neighbours.resize(reference(e.number).towards.size());
            for (long& n : e.neighbours) in >> n;
            left -= e.neighbours.size();
        }
        EXPECT_EQ(left, 0u);
        EXPECT_EQ(head(in, "pmaterial"), elements.size());
        for (Element& e : elements) in >> e.material;
        EXPECT_TRUE(static_cast<bool>(in));
    }
};

CsmpFiles written(CellMesh mesh) {
    const TemporaryFolder folder;
    OutputSet out(folder / "m.asc");
    const auto losses = write_cells(std::move(mesh), "csmp", out);
    EXPECT_TRUE(losses) << (losses ? "" : losses.why().error.message);
    return {folder, "m"};
}

double volume_of(const CsmpFiles& files, const CsmpFiles::Element& e) {
    std::vector<Vec3> p;
    for (const std::size_t n : e.nodes) p.push_back(files.points.at(n));
    if (e.number == 18) return tet_volume(p[0], p[1], p[2], p[4]) + tet_volume(p[0], p[2], p[3], p[4]);
    return flat_volume(p);
}

bool is_cell(const CsmpFiles::Element& e) { return e.number != 2 && e.number != 8 && e.number != 14; }

/// Elements of one kind of things that have all of some nodes, but for one of them.
std::vector<long> others_with(const CsmpFiles& files, const std::set<std::size_t>& nodes, std::size_t but) {
    std::vector<long> all;
    for (std::size_t e = 0; e < files.elements.size(); ++e) {
        const auto& own = files.elements[e].nodes;
        const bool has_all = std::ranges::all_of(nodes, [&](std::size_t n) { return std::ranges::find(own, n) != own.end(); });
        if (e != but && has_all && is_cell(files.elements[e])) all.push_back(static_cast<long>(e));
    }
    return all;
}

/// A hexahedron with a pyramid on top of it, a prism beside it and a tetrahedron on the pyramid; "F" lies between three of them.
CellMesh four_kinds() {
    CellMesh mesh;
    mesh.info.name = "four kinds";
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0},     {0, 1, 0},      {0, 0, 1}, {1, 0, 1},
                   {1, 1, 1}, {0, 1, 1}, {0.5, 0.5, 2}, {0.5, -1, 1.5}, {2, 0, 0}, {2, 1, 0}};
    const auto entity = [&](int d, const std::string& name) {
        CellMesh::Entity e;
        e.dimension = d;
        e.tag = static_cast<std::int64_t>(mesh.entities.size()) + 1;
        e.name = name;
        mesh.entities.push_back(e);
    };
    entity(3, "lower part");
    entity(3, "upper");
    entity(2, "F");
    entity(1, "W");
    const auto add = [&](CellType type, std::vector<std::uint32_t> nodes, std::uint32_t of) {
        mesh.add_cell(type, nodes);
        mesh.cell_entity.push_back(of);
    };
    add(CellType::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}, 0);
    add(CellType::wedge, {1, 10, 5, 2, 11, 6}, 0);
    add(CellType::pyramid, {4, 5, 6, 7, 8}, 1);
    add(CellType::tetrahedron, {4, 5, 8, 9}, 1);
    add(CellType::quad, {4, 5, 6, 7}, 2);
    add(CellType::triangle, {4, 5, 8}, 2);
    add(CellType::line, {3, 7}, 3);
    add(CellType::line, {7, 8}, 3);
    return mesh;
}

TEST(Csmp, CellsOfAllKindsHaveTheirVolumesWithYUp) {
    for (const SampleCell& sample : sample_cells()) {
        if (!sample.edges.empty()) continue;
        const CsmpFiles files = written(mesh_of(sample));
        ASSERT_FALSE(files.elements.empty());
        EXPECT_NEAR(volume_of(files, files.elements[0]), sample.volume, 1e-12);
        EXPECT_EQ(files.points[0], sample.corners[0]);
    }
    const CsmpFiles files = written(four_kinds());
    std::map<int, double> volumes;
    for (const auto& e : files.elements) {
        if (is_cell(e)) volumes[e.number] += volume_of(files, e);
    }
    EXPECT_NEAR(volumes.at(6), 1, 1e-12);
    EXPECT_NEAR(volumes.at(12), 0.5, 1e-12);
    EXPECT_NEAR(volumes.at(18), 1.0 / 3, 1e-12);
    EXPECT_GT(volumes.at(4), 0.1);
}

TEST(Csmp, FamiliesAreRegionsByKindSurfacesAndLines) {
    const CsmpFiles files = written(four_kinds());
    EXPECT_EQ(files.family("lower_part", "HEXA_8").elements.size(), 1u);
    EXPECT_EQ(files.family("lower_part", "PENTA_6").elements.size(), 1u);
    EXPECT_EQ(files.family("upper", "PYRA_5").elements.size(), 1u);
    EXPECT_EQ(files.family("upper", "TETRA_4").elements.size(), 1u);
    EXPECT_EQ(files.family("F", "QUAD_4").elements.size(), 1u);
    EXPECT_EQ(files.family("F", "TRI_3").elements.size(), 1u);
    EXPECT_EQ(files.family("W", "BAR_2").elements.size(), 2u);
    std::set<std::size_t> all;
    for (const auto& family : files.families) {
        for (const std::size_t e : family.elements) {
            ASSERT_LT(e, files.elements.size());
            EXPECT_TRUE(all.insert(e).second) << "an element is in one family";
            EXPECT_EQ(reference(files.elements[e].number).name, family.kind);
            EXPECT_EQ(files.elements[e].material, family.material);
        }
    }
    EXPECT_EQ(all.size(), files.elements.size());
    EXPECT_EQ(files.family("lower_part", "HEXA_8").material, 1);
    EXPECT_EQ(files.family("upper", "TETRA_4").material, 2);
    for (const char* name : {"lower_part", "upper", "F", "W"}) EXPECT_EQ(std::ranges::count(files.regions, name), 1) << name;
}

TEST(Csmp, NeighboursOfCellsHaveTheNodesOfTheFaceAndBoundariesAreFlagged) {
    for (const CellMesh& mesh : {four_kinds(), two_boxes(false), two_boxes(true)}) {
        const CsmpFiles files = written(mesh);
        std::set<std::size_t> boundary;
        std::size_t joined = 0;
        for (std::size_t e = 0; e < files.elements.size(); ++e) {
            const auto& element = files.elements[e];
            if (!is_cell(element)) continue;
            for (std::size_t f = 0; f < element.neighbours.size(); ++f) {
                std::set<std::size_t> nodes;
                for (const std::size_t n : reference(element.number).towards[f]) nodes.insert(element.nodes[n]);
                const auto others = others_with(files, nodes, e);
                if (others.empty()) boundary.insert(nodes.begin(), nodes.end());
                else ++joined;
                EXPECT_EQ(element.neighbours[f], others.empty() ? -28 : others.front()) << e << ' ' << f;
            }
        }
        EXPECT_EQ(joined > 0, mesh.points.size() != two_boxes(true).points.size());
        for (std::size_t v = 0; v < files.flags.size(); ++v) EXPECT_EQ(files.flags[v], boundary.contains(v) ? -28 : 0) << v;
    }
}

TEST(Csmp, NeighboursOfFacesLieOppositeToCornersAndThoseOfEdgesAlongTheChain) {
    // A tetrahedron whose faces are one surface: each triangle has three neighbours.
    CellMesh mesh;
    mesh.info.name = "closed";
    mesh.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 3}};
    for (const auto& [d, name] : {std::pair{3, "rock"}, std::pair{2, "skin"}, std::pair{1, "W"}}) {
        CellMesh::Entity e;
        e.dimension = d;
        e.tag = d;
        e.name = name;
        mesh.entities.push_back(e);
    }
    const auto add = [&](CellType type, std::vector<std::uint32_t> nodes, std::uint32_t of) {
        mesh.add_cell(type, nodes);
        mesh.cell_entity.push_back(of);
    };
    add(CellType::tetrahedron, {0, 1, 2, 3}, 0);
    for (const std::vector<std::uint32_t>& t : std::vector<std::vector<std::uint32_t>>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
        add(CellType::triangle, t, 1);
    add(CellType::line, {0, 1}, 2);
    add(CellType::line, {1, 2}, 2);
    add(CellType::line, {2, 3}, 2);
    const CsmpFiles files = written(mesh);
    for (const std::size_t e : files.family("skin", "TRI_3").elements) {
        const auto& triangle = files.elements[e];
        for (std::size_t k = 0; k < 3; ++k) {
            ASSERT_GE(triangle.neighbours[k], 0);
            const auto& other = files.elements.at(static_cast<std::size_t>(triangle.neighbours[k]));
            ASSERT_EQ(other.number, 8);
            EXPECT_EQ(std::ranges::count(other.nodes, triangle.nodes[k]), 0);
        }
    }
    const auto& bars = files.family("W", "BAR_2").elements;
    ASSERT_EQ(bars.size(), 3u);
    EXPECT_EQ(files.elements[bars[0]].neighbours, (std::vector<long>{-28, static_cast<long>(bars[1])}));
    EXPECT_EQ(files.elements[bars[1]].neighbours, (std::vector<long>{static_cast<long>(bars[0]), static_cast<long>(bars[2])}));
    EXPECT_EQ(files.elements[bars[2]].neighbours, (std::vector<long>{static_cast<long>(bars[1]), -28}));
}

}  // namespace
}  // namespace geomend::test
