// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/write_tetgen.h"

#include <algorithm>
#include <array>

#include "base/text_cursor.h"
#include "formats/meshes/mesh_writing.h"
#include "model/cell_faces.h"

namespace geomend::meshes {

namespace {

// The further nodes of TetGen stand on the edges 2-3, 3-0, 0-1, 1-2, 1-3, 2-0 of its corners.
constexpr std::array<std::uint8_t, 10> node_order{0, 1, 2, 3, 9, 7, 4, 5, 8, 6};

/// The three files; the one that the user named is the main output.
class Files {
public:
    explicit Files(OutputSet& out) : out_(out) {
        const std::string extension = lower_case(out.main_path().extension() == ".gz" ? out.main_path().stem().extension().string()
                                                                                      : out.main_path().extension().string());
        main_ = extension == ".ele" || extension == ".face" ? extension : ".node";
    }
    OutputFile& file(const std::string& extension) {
        return extension == main_ ? out_.main_file() : out_.companion(out_.stem() + extension);
    }

private:
    OutputSet& out_;
    std::string main_;
};

std::vector<const Attribute*> number_attributes(const VolumeMesh& mesh) {
    std::vector<const Attribute*> found;
    for (const Attribute& a : mesh->attributes) {
        if (a.location == AttributeLocation::point && !is_text(a)) found.push_back(&a);
    }
    return found;
}

void write_nodes_file(const VolumeMesh& mesh, OutputFile& file) {
    const auto attributes = number_attributes(mesh);
    std::uint64_t columns = 0;
    for (const Attribute* a : attributes) {
        file << "# attribute ";
        file.number(columns + 1) << ": " << in_a_line(a->name) << '\n';
        columns += a->components;
    }
    file.number(static_cast<std::uint64_t>(mesh->vertices.size())) << " 3 ";
    file.number(columns) << " 0\n";
    for (std::size_t v = 0; v < mesh->vertices.size() && file.good(); ++v) {
        file.number(static_cast<std::uint64_t>(v + 1));
        for (const double x : mesh->vertices[v]) file << ' ', file.number(x);
        for (const Attribute* a : attributes) write_attribute_values(file, *a, v);
        file << '\n';
    }
}

void write_names(OutputFile& file, const char* kind, std::uint64_t number, const std::string& name) {
    file << "# " << kind << ' ';
    file.number(number) << ": " << in_a_line(name) << '\n';
}

void write_cells_file(const VolumeMesh& mesh, std::size_t nodes, OutputFile& file) {
    for (std::size_t r = 0; r < mesh->regions.size(); ++r) write_names(file, "region", r + 1, mesh->regions[r]);
    file.number(static_cast<std::uint64_t>(mesh->cell_count())) << ' ';
    file.number(static_cast<std::uint64_t>(nodes)) << " 1\n";
    for (const VolumeMeshData::Block& block : mesh->blocks) {
        for (std::uint32_t c = block.first; c < block.first + block.count && file.good(); ++c) {
            file.number(c + 1);
            write_nodes(file, mesh->nodes_of(c), std::span(node_order).first(nodes), ' ');
            file << ' ', file.number(block.region + 1) << '\n';
        }
    }
}

void write_faces_file(const VolumeMesh& mesh, OutputFile& file) {
    std::uint64_t count = 0, number = 0;
    for (std::size_t s = 0; s < mesh->face_sets.size(); ++s) {
        write_names(file, "face set", s + 1, mesh->face_sets[s].name);
        count += mesh->face_sets[s].faces.size();
    }
    file.number(count) << " 1\n";
    for (std::size_t s = 0; s < mesh->face_sets.size(); ++s) {
        for (const CellFaceRef& face : mesh->face_sets[s].faces) {
            file.number(++number);
            for (const std::uint32_t n : mesh.nodes_of(face)) file << ' ', file.number(n + 1);
            file << ' ', file.number(static_cast<std::uint64_t>(s + 1)) << '\n';
        }
    }
}

/// For each cell the cells beyond the faces opposite to its corners, -1 where there is none.
void write_neighbours_file(const VolumeMesh& mesh, OutputFile& file) {
    std::vector<std::array<std::int64_t, 4>> beyond(mesh->cell_count(), {-1, -1, -1, -1});
    const auto opposite = [](std::uint32_t face) {
        std::size_t sum = 0;
        for (const std::uint8_t corner : faces_of(CellType::tetrahedron)[face].corners()) sum += corner;
        return 6 - sum;  // of 0 + 1 + 2 + 3
    };
    for (const auto& c : mesh->network.connections) {
        beyond[c.from][opposite(c.from_face)] = c.to + std::int64_t{1};
        beyond[c.to][opposite(c.to_face)] = c.from + std::int64_t{1};
    }
    file.number(static_cast<std::uint64_t>(mesh->cell_count())) << " 4\n";
    for (std::size_t c = 0; c < beyond.size() && file.good(); ++c) {
        file.number(static_cast<std::uint64_t>(c + 1));
        for (const std::int64_t other : beyond[c]) file << ' ', file.number(other);
        file << '\n';
    }
}

void list_attribute_losses(const VolumeMesh& mesh, std::vector<Loss>& losses) {
    for (const Attribute& a : mesh->attributes) {
        if (a.location != AttributeLocation::point) continue;
        if (is_text(a)) add_loss(losses, {LossClass::substance, "", "attribute '" + a.name + "'", "TetGen holds numbers only", 1});
        else add_loss(losses, {LossClass::identity, "", "name and unit of attribute '" + a.name + "'", "TetGen holds numbers only", 1});
    }
}

}  // namespace

Result<std::vector<Loss>> write_tetgen(const VolumeMesh& mesh, OutputSet& out, const WriteOptions&) {
    if (out.is_stream())
        return failure(FailureKind::usage, "F018", {out.main_path().string()},
                       "a mesh of TetGen is several files with one name: name an output file");
    const auto second = [](const VolumeMeshData::Block& block) { return is_second_order(block.type); };
    const bool all_second = std::ranges::all_of(mesh->blocks, second);
    std::vector<Loss> losses = common_losses(mesh, "TetGen");
    if (!all_second && std::ranges::any_of(mesh->blocks, second))
        add_loss(losses, {LossClass::substance, mesh->name, "nodes on edges", "cells of one file of TetGen have one order", 1});
    list_attribute_losses(mesh, losses);
    Files files(out);
    write_nodes_file(mesh, files.file(".node"));
    write_cells_file(mesh, all_second ? 10 : 4, files.file(".ele"));
    write_neighbours_file(mesh, files.file(".neigh"));
    if (!mesh->face_sets.empty()) write_faces_file(mesh, files.file(".face"));
    return losses;
}

}  // namespace geomend::meshes
