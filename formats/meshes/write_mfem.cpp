// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/write_mfem.h"

#include "formats/meshes/mesh_writing.h"

namespace geomend::meshes {

namespace {

// Kinds of elements as MFEM numbers them.
constexpr int triangle = 2, quadrangle = 3, tetrahedron = 4, hexahedron = 5;

void write_elements(const VolumeMesh& mesh, OutputFile& file) {
    file << "\nelements\n";
    file.number(static_cast<std::uint64_t>(mesh->cell_count())) << '\n';
    for (const VolumeMeshData::Block& block : mesh->blocks) {
        for (std::uint32_t c = block.first; c < block.first + block.count && file.good(); ++c) {
            file.number(block.region + 1) << ' ';
            file.number(block.type == CellType::tetrahedron ? tetrahedron : hexahedron);
            for (const std::uint32_t n : mesh->nodes_of(c)) file << ' ', file.number(n);
            file << '\n';
        }
    }
}

void write_boundary(const VolumeMesh& mesh, OutputFile& file) {
    std::uint64_t count = 0;
    for (const auto& set : mesh->face_sets) count += set.faces.size();
    file << "\nboundary\n";
    file.number(count) << '\n';
    for (std::size_t s = 0; s < mesh->face_sets.size(); ++s) {
        for (const CellFaceRef& face : mesh->face_sets[s].faces) {
            const auto nodes = mesh.nodes_of(face);
            file.number(static_cast<std::uint64_t>(s + 1)) << ' ';
            file.number(nodes.size() == 3 ? triangle : quadrangle);
            for (const std::uint32_t n : nodes) file << ' ', file.number(n);
            file << '\n';
        }
    }
}

}  // namespace

Result<std::vector<Loss>> write_mfem(const VolumeMesh& mesh, OutputSet& out, const WriteOptions&) {
    OutputFile& file = out.main_file();
    file << "MFEM mesh v1.0\n\n";
    for (std::size_t r = 0; r < mesh->regions.size(); ++r) {
        file << "# element attribute ";
        file.number(static_cast<std::uint64_t>(r + 1)) << ": " << in_a_line(mesh->regions[r]) << '\n';
    }
    for (std::size_t s = 0; s < mesh->face_sets.size(); ++s) {
        file << "# boundary attribute ";
        file.number(static_cast<std::uint64_t>(s + 1)) << ": " << in_a_line(mesh->face_sets[s].name) << '\n';
    }
    file << "\ndimension\n3\n";
    write_elements(mesh, file);
    write_boundary(mesh, file);
    file << "\nvertices\n";
    file.number(static_cast<std::uint64_t>(mesh->vertices.size())) << "\n3\n";
    for (const Vec3& p : mesh->vertices) {
        file.number(p[0]) << ' ';
        file.number(p[1]) << ' ';
        file.number(p[2]) << '\n';
    }
    return common_losses(mesh, "MFEM");
}

}  // namespace geomend::meshes
