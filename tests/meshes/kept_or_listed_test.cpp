// SPDX-License-Identifier: AGPL-3.0-or-later
// What a mesh has is either in the files or in the list of what was lost, for each format that takes meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "formats/meshes/meshes.h"
#include "meshes/written_mesh.h"
#include "support/temporary_folder.h"

namespace geomend::test {
namespace {

using Losses = std::vector<Loss>;

/// Two regions of a tetrahedron each; the corners of the second one after those of the face that they share.
class TwoTetrahedra {
public:
    TwoTetrahedra(const std::string& first, const std::string& second) {
        mesh.info.name = "two cells";
        mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
        add(CellType::tetrahedron, {0, 1, 2, 3}, first);
        add(CellType::tetrahedron, {1, 2, 3, 4}, second);
    }
    void add(CellType type, std::vector<std::uint32_t> nodes, const std::string& name, FeatureRole role = FeatureRole::unknown) {
        CellMesh::Entity entity;
        entity.dimension = dimension(type);
        entity.tag = static_cast<std::int64_t>(mesh.entities.size()) + 1;
        entity.name = name;
        entity.role = role;
        mesh.entities.push_back(entity);
        mesh.add_cell(type, nodes);
        mesh.cell_entity.push_back(static_cast<std::uint32_t>(mesh.entities.size() - 1));
    }
    /// Every value at a point or of a tetrahedron is `first` plus a number of its own.
    void add_values(const char* name, AttributeLocation location, double first) {
        std::vector<double> values(location == AttributeLocation::point ? mesh.points.size() : mesh.cell_count());
        for (std::size_t i = 0; i < values.size(); ++i) {
            const bool is_none = location == AttributeLocation::cell && mesh.types[i] != CellType::tetrahedron;
            values[i] = is_none ? std::numeric_limits<double>::quiet_NaN() : first + static_cast<double>(i);
        }
        Attribute a;
        a.name = name;
        a.location = location;
        a.values = std::move(values);
        mesh.info.attributes.push_back(std::move(a));
    }

    CellMesh mesh;
};

/// What stands in all files of a folder, and their names.
std::string all_of(const TemporaryFolder& folder) {
    std::string all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
        all += entry.path().filename().string() + '\n';
        if (entry.is_regular_file()) all += read_file(entry.path()) + '\n';
    }
    return all;
}

Losses write_all(CellMesh mesh, std::string_view format, const TemporaryFolder& folder) {
    OutputSet out(folder / "m.out");
    auto losses = write_cells(std::move(mesh), format, out);
    EXPECT_TRUE(losses) << format << (losses ? "" : losses.why().error.message);
    return losses ? *losses : Losses{};
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// As text, or as the eight bytes of a file of Exodus or of CGNS.
bool has_number(const std::string& text, double value) {
    std::string bytes;
    for (int shift = 56; shift >= 0; shift -= 8) bytes += static_cast<char>(std::bit_cast<std::uint64_t>(value) >> shift & 0xFFu);
    const std::string turned(bytes.rbegin(), bytes.rend());
    std::ostringstream words;
    words << value;
    return contains(text, words.str()) || contains(text, bytes) || contains(text, turned);
}

/// Whether what begins with some name is listed as substance that was lost.
bool is_listed(const Losses& losses, const std::string& name) {
    return std::ranges::any_of(losses, [&](const Loss& loss) {
        return loss.loss_class == LossClass::substance && (loss.entity.starts_with(name) || contains(loss.what, "'" + name + "'"));
    });
}

TEST(Needs, ValuesRegionsAndSetsAreInTheFilesOrListedAsLost) {
    TwoTetrahedra two("qwest", "qeast");
    two.add(CellType::triangle, {1, 2, 3}, "qflt", FeatureRole::fault);
    two.add(CellType::triangle, {0, 1, 2}, "qbase");
    two.add(CellType::line, {0, 3}, "qwell");
    two.mesh.info.sets.push_back({"qnode", AttributeLocation::point, {0, 4}});
    two.add_values("qcell", AttributeLocation::cell, 7331.25);
    two.add_values("qpoint", AttributeLocation::point, 9117.5);
    for (const MeshFormat& format : meshes::mesh_formats()) {
        const TemporaryFolder folder;
        const Losses losses = write_all(two.mesh, format.name, folder);
        const std::string text = all_of(folder);
        for (const double value : {7331.25, 7332.25}) EXPECT_NE(has_number(text, value), is_listed(losses, "qcell")) << format.name;
        for (const double value : {9117.5, 9121.5}) EXPECT_NE(has_number(text, value), is_listed(losses, "qpoint")) << format.name;
        for (const char* name : {"qwest", "qeast", "qflt", "qbase", "qwell", "qnode"})
            EXPECT_NE(contains(text, name), is_listed(losses, name)) << format.name << ": " << name;
    }
}

/// Lines that begin with some words, without the rest.
std::vector<std::string> behind(const std::string& text, const std::string& words) {
    std::vector<std::string> found;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with(words)) found.push_back(line.substr(words.size()));
    }
    return found;
}

bool is_renamed(const Losses& losses, const std::string& from, const std::string& to) {
    return std::ranges::any_of(losses, [&](const Loss& loss) {
        return loss.loss_class == LossClass::identity && loss.entity == from && contains(loss.why, "'" + to + "'");
    });
}

TEST(Names, OfTwoRegionsOfOneNameOneGetsANumber) {
    const TwoTetrahedra two("R", "R");
    for (const MeshFormat& format : meshes::mesh_formats()) {
        if (find_mesh_needs(format.target)->names == Naming::numbers) continue;
        const TemporaryFolder folder;
        const Losses losses = write_all(two.mesh, format.name, folder);
        EXPECT_TRUE(contains(all_of(folder), "R_2")) << format.name;
        EXPECT_TRUE(is_renamed(losses, "R", "R_2")) << format.name;
    }
    const TemporaryFolder pflotran, openfoam;
    write_all(two.mesh, "pflotran", pflotran);
    EXPECT_EQ(read_file(pflotran / "m_R.txt"), "1\n");
    EXPECT_EQ(read_file(pflotran / "m_R_2.txt"), "2\n");
    write_all(two.mesh, "openfoam", openfoam);
    const std::string zones = read_file(openfoam / "constant/polyMesh/cellZones");
    EXPECT_EQ(behind(zones, "R"), (std::vector<std::string>{"", "_2"}));
}

TEST(Names, ARegionMayHaveTheNameThatAnotherWouldGet) {
    TwoTetrahedra two("R_2", "R");
    two.mesh.points.push_back({2, 2, 2});
    two.add(CellType::tetrahedron, {2, 3, 4, 5}, "R");
    const TemporaryFolder folder;
    write_all(two.mesh, "openfoam", folder);
    EXPECT_EQ(behind(read_file(folder / "constant/polyMesh/cellZones"), "R"), (std::vector<std::string>{"_2", "", "_3"}));
}

TEST(Names, GroupsOfAllKindsOfElementsDifferInCodeAster) {
    TwoTetrahedra two("A", "B");
    two.add(CellType::triangle, {0, 1, 2}, "a");
    two.add(CellType::line, {0, 3}, "A");
    two.mesh.info.sets.push_back({"A", AttributeLocation::point, {0, 4}});
    const TemporaryFolder folder;
    const Losses losses = write_all(two.mesh, "code-aster", folder);
    const std::string text = read_file(folder / "m.out");
    const auto groups = behind(text, "GROUP_MA NOM=");
    EXPECT_EQ(std::set<std::string>(groups.begin(), groups.end()),
              (std::set<std::string>{"A", "B", "A_outside", "B_outside", "A_B", "a_2", "A_3"}));
    EXPECT_EQ(groups.size(), 7u);
    EXPECT_EQ(behind(text, "GROUP_NO NOM="), std::vector<std::string>{"A"}) << "groups of nodes have names of their own";
    EXPECT_TRUE(is_renamed(losses, "a", "a_2"));
    EXPECT_TRUE(is_renamed(losses, "A", "A_3"));
    for (const char* format : {"abaqus", "exodus"}) {
        const TemporaryFolder other;
        EXPECT_FALSE(is_renamed(write_all(two.mesh, format, other), "A", "A_3")) << format << " has names by kind";
    }
}

TEST(Sets, OnTheSameFacesAreListedWhereAFaceIsInOneOnly) {
    TwoTetrahedra two("west", "east");
    two.add(CellType::triangle, {1, 2, 3}, "S1");
    two.add(CellType::triangle, {1, 2, 3}, "S2");
    two.add(CellType::triangle, {0, 1, 2}, "B1");
    two.add(CellType::triangle, {0, 1, 2}, "B2");
    const std::set<std::string> once{"csmp", "medit", "mfem", "openfoam", "tetgen"};
    for (const MeshFormat& format : meshes::mesh_formats()) {
        if (!find_mesh_needs(format.target)->face_sets) continue;
        const TemporaryFolder folder;
        const Losses losses = write_all(two.mesh, format.name, folder);
        const std::string text = all_of(folder);
        for (const char* name : {"S1", "S2", "B1", "B2"})
            EXPECT_NE(contains(text, name), is_listed(losses, name)) << format.name << ": " << name;
        EXPECT_EQ(is_listed(losses, "B2"), once.contains(std::string(format.name))) << format.name;
        EXPECT_FALSE(is_listed(losses, "B1")) << format.name;
    }
}

TEST(Sets, TheOtherSideOfASurfaceIsNoLossOfFaces) {
    TwoTetrahedra two("west", "east");
    two.add(CellType::triangle, {1, 2, 3}, "S");
    const TemporaryFolder folder;
    const Losses losses = write_all(two.mesh, "openfoam", folder);
    EXPECT_EQ(behind(read_file(folder / "constant/polyMesh/faceZones"), "S_").size(), 1u);
    EXPECT_FALSE(is_listed(losses, "S"));
    EXPECT_TRUE(
        std::ranges::any_of(losses, [](const Loss& loss) { return loss.what == "side of faces" && loss.entity.starts_with("S_"); }));
}

TEST(Sets, RolesOfSurfacesAreListed) {
    TwoTetrahedra two("west", "east");
    two.add(CellType::triangle, {1, 2, 3}, "S", FeatureRole::fault);
    const TwoTetrahedra plain("west", "east");
    const auto lists_roles = [](const CellMesh& mesh, std::string_view format) {
        const TemporaryFolder folder;
        return std::ranges::any_of(write_all(mesh, format, folder), [](const Loss& loss) { return loss.what == "roles of surfaces"; });
    };
    for (const MeshFormat& format : meshes::mesh_formats()) {
        EXPECT_EQ(lists_roles(two.mesh, format.name), find_mesh_needs(format.target)->face_sets) << format.name;
        EXPECT_FALSE(lists_roles(plain.mesh, format.name)) << format.name;
    }
}

TEST(Modflow, SaysTheUnitOfTheModel) {
    for (const auto& [unit, line] : std::vector<std::pair<std::string, std::vector<std::string>>>{
             {"m", {"METERS"}}, {"ft", {"FEET"}}, {"cm", {"CENTIMETERS"}}, {"", {}}, {"km", {}}, {"m m ft", {}}}) {
        TwoTetrahedra two("west", "east");
        auto& units = two.mesh.info.crs.axis_units;
        units = {unit, unit, unit};
        if (unit == "m m ft") units = {"m", "m", "ft"};
        const TemporaryFolder folder;
        write_all(two.mesh, "modflow-disu", folder);
        EXPECT_EQ(behind(read_file(folder / "m.out"), "  LENGTH_UNITS "), line) << unit;
    }
}

}  // namespace
}  // namespace geomend::test
