// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/write_medit.h"

#include <array>
#include <filesystem>

#include "base/text_cursor.h"
#include "formats/meshes/mesh_writing.h"
#include "formats/meshes/write_medit_binary.h"

namespace geomend::meshes {

namespace {

constexpr std::array<std::uint8_t, 4> tetrahedron_order{0, 1, 2, 3};
// The first triangle of a prism looks into the cell, that of VTK's wedge out of it.
constexpr std::array<std::uint8_t, 6> prism_order{0, 2, 1, 3, 5, 4};
constexpr std::array<std::uint8_t, 8> hexahedron_order{0, 1, 2, 3, 4, 5, 6, 7};

void write_names(const VolumeMesh& mesh, OutputFile& file) {
    const auto name = [&](const char* kind, std::size_t i, const std::string& text) {
        file << "# " << kind << ' ';
        file.number(static_cast<std::uint64_t>(i + 1)) << ": " << in_a_line(text) << '\n';
    };
    for (std::size_t i = 0; i < mesh->regions.size(); ++i) name("region", i, mesh->regions[i]);
    for (std::size_t i = 0; i < mesh->face_sets.size(); ++i) name("face set", i, mesh->face_sets[i].name);
    for (std::size_t i = 0; i < mesh->edge_sets.size(); ++i) name("edge set", i, mesh->edge_sets[i].name);
}

void write_head(OutputFile& file, const char* keyword, std::uint64_t count) {
    file << keyword << '\n';
    file.number(count) << '\n';
}

void write_vertices(const VolumeMesh& mesh, OutputFile& file) {
    write_head(file, "Vertices", mesh->vertices.size());
    for (const Vec3& p : mesh->vertices) {
        for (const double x : p) file.number(x) << ' ';
        file << "0\n";
    }
}

template <class Order>
void write_cells(const VolumeMesh& mesh, OutputFile& file, const char* keyword, CellType type, const Order& order) {
    const auto blocks = blocks_of(mesh, type);
    if (blocks.empty()) return;
    write_head(file, keyword, cells_in(blocks));
    for (const VolumeMeshData::Block& block : blocks) {
        for (std::uint32_t c = block.first; c < block.first + block.count && file.good(); ++c) {
            for (const std::uint8_t i : order) file.number(mesh->nodes_of(c)[i] + 1) << ' ';
            file.number(block.region + 1) << '\n';
        }
    }
}

void write_faces(const VolumeMesh& mesh, OutputFile& file, const char* keyword, std::size_t corners) {
    struct Line {
        std::vector<std::uint32_t> nodes;
        std::uint64_t set;
    };
    std::vector<Line> lines;
    for (std::size_t s = 0; s < mesh->face_sets.size(); ++s) {
        for (const CellFaceRef& face : mesh->face_sets[s].faces) {
            auto nodes = mesh.nodes_of(face);
            if (nodes.size() == corners) lines.push_back({std::move(nodes), s + 1});
        }
    }
    if (lines.empty()) return;
    write_head(file, keyword, lines.size());
    for (const Line& line : lines) {
        for (const std::uint32_t n : line.nodes) file.number(n + 1) << ' ';
        file.number(line.set) << '\n';
    }
}

void write_edges(const VolumeMesh& mesh, OutputFile& file) {
    std::uint64_t count = 0;
    for (const auto& set : mesh->edge_sets) count += set.edges.size();
    if (count == 0) return;
    write_head(file, "Edges", count);
    for (std::size_t s = 0; s < mesh->edge_sets.size(); ++s) {
        for (const auto& edge : mesh->edge_sets[s].edges) {
            file.number(edge[0] + 1) << ' ';
            file.number(edge[1] + 1) << ' ';
            file.number(static_cast<std::uint64_t>(s + 1)) << '\n';
        }
    }
}

}  // namespace

Result<std::vector<Loss>> write_medit(const VolumeMesh& mesh, OutputSet& out, const WriteOptions& options) {
    const std::filesystem::path name = out.main_path().filename();
    if (lower_case((name.extension() == ".gz" ? name.stem() : name).extension().string()) == ".meshb")
        return write_medit_binary(mesh, out, options);
    OutputFile& file = out.main_file();
    file << "MeshVersionFormatted 2\nDimension 3\n";
    write_names(mesh, file);
    write_vertices(mesh, file);
    write_cells(mesh, file, "Tetrahedra", CellType::tetrahedron, tetrahedron_order);
    write_cells(mesh, file, "Prisms", CellType::wedge, prism_order);
    write_cells(mesh, file, "Hexahedra", CellType::hexahedron, hexahedron_order);
    write_faces(mesh, file, "Triangles", 3);
    write_faces(mesh, file, "Quadrilaterals", 4);
    write_edges(mesh, file);
    file << "End\n";
    return common_losses(mesh, "Medit");
}

}  // namespace geomend::meshes
