// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/write_code_aster.h"

#include <array>

#include "formats/meshes/mesh_writing.h"

namespace geomend::meshes {

namespace {

struct Word {
    CellType type;
    const char* word;
};
// The first triangle of PENTA6 looks into the cell, that of VTK's wedge out of it.
constexpr std::array<std::size_t, 6> penta6_order{0, 2, 1, 3, 5, 4};
constexpr std::array<Word, 4> words{
    {{CellType::tetrahedron, "TETRA4"}, {CellType::pyramid, "PYRAM5"}, {CellType::wedge, "PENTA6"}, {CellType::hexahedron, "HEXA8"}}};

constexpr int names_on_a_line = 6;  // the program reads 80 characters

void write_element(OutputFile& file, std::uint64_t number, std::span<const std::uint32_t> nodes) {
    file << 'M';
    file.number(number);
    for (const std::uint32_t n : nodes) file << " N", file.number(n + 1);
    file << '\n';
}

void write_nodes_of_mesh(const VolumeMesh& mesh, OutputFile& file) {
    file << "COOR_3D\n";
    for (std::size_t v = 0; v < mesh->vertices.size() && file.good(); ++v) {
        file << 'N';
        file.number(static_cast<std::uint64_t>(v + 1));
        for (const double x : mesh->vertices[v]) file << ' ', file.number(x);
        file << '\n';
    }
    file << "FINSF\n";
}

void write_cells(const VolumeMesh& mesh, OutputFile& file) {
    for (const Word& word : words) {
        const auto blocks = blocks_of(mesh, word.type);
        if (blocks.empty()) continue;
        file << word.word << '\n';
        for (const VolumeMeshData::Block& block : blocks) {
            for (std::uint32_t c = block.first; c < block.first + block.count && file.good(); ++c) {
                std::vector<std::uint32_t> nodes(mesh->nodes_of(c).begin(), mesh->nodes_of(c).end());
                if (word.type == CellType::wedge) {
                    for (std::size_t k = 0; k < penta6_order.size(); ++k) nodes[k] = mesh->nodes_of(c)[penta6_order[k]];
                }
                write_element(file, c + 1, nodes);
            }
        }
        file << "FINSF\n";
    }
}

/// Elements on the faces and edges of sets, numbered on from the cells; gives the first number of each set.
class SetElements {
public:
    SetElements(const VolumeMesh& mesh, OutputFile& file) : mesh_(mesh), file_(file), next_(mesh->cell_count() + 1) {}

    void write() {
        write_faces("TRIA3", 3);
        write_faces("QUAD4", 4);
        std::uint64_t edges = 0;
        for (const auto& set : mesh_->edge_sets) edges += set.edges.size();
        if (edges == 0) return;
        file_ << "SEG2\n";
        for (const auto& set : mesh_->edge_sets) {
            edge_elements.push_back({next_, next_ + set.edges.size()});
            for (const auto& edge : set.edges) write_element(file_, next_++, edge);
        }
        file_ << "FINSF\n";
    }

    using Range = std::array<std::uint64_t, 2>;  ///< first, and the one behind the last
    std::vector<std::vector<Range>> face_elements;
    std::vector<Range> edge_elements;

private:
    const VolumeMesh& mesh_;
    OutputFile& file_;
    std::uint64_t next_;

    void write_faces(const char* word, std::size_t corners) {
        face_elements.resize(mesh_->face_sets.size());
        bool is_begun = false;
        for (std::size_t s = 0; s < mesh_->face_sets.size(); ++s) {
            const std::uint64_t first = next_;
            for (const CellFaceRef& face : mesh_->face_sets[s].faces) {
                const auto nodes = mesh_.nodes_of(face);
                if (nodes.size() != corners) continue;
                if (!is_begun) file_ << word << '\n';
                is_begun = true;
                write_element(file_, next_++, nodes);
            }
            if (next_ > first) face_elements[s].push_back({first, next_});
        }
        if (is_begun) file_ << "FINSF\n";
    }
};

void write_group(OutputFile& file, const std::string& name, std::span<const SetElements::Range> ranges) {
    file << "GROUP_MA NOM=" << name << '\n';
    {
        NumberRows names(file, names_on_a_line, "M");
        for (const auto& [first, end] : ranges) {
            for (std::uint64_t i = first; i < end && file.good(); ++i) names.add(i);
        }
    }
    file << "FINSF\n";
}

void write_regions(const VolumeMesh& mesh, OutputFile& file) {
    for (std::uint32_t r = 0; r < mesh->regions.size(); ++r) {
        std::vector<SetElements::Range> ranges;
        for (const VolumeMeshData::Block& block : mesh->blocks) {
            if (block.region == r) ranges.push_back({block.first + 1u, std::uint64_t{block.first} + block.count + 1});
        }
        if (!ranges.empty()) write_group(file, mesh->regions[r], ranges);
    }
}

}  // namespace

Result<std::vector<Loss>> write_code_aster(const VolumeMesh& mesh, OutputSet& out, const WriteOptions&) {
    OutputFile& file = out.main_file();
    file << "TITRE\n" << in_a_line(mesh->name).substr(0, 72) << "\nFINSF\n";
    write_nodes_of_mesh(mesh, file);
    write_cells(mesh, file);
    SetElements elements(mesh, file);
    elements.write();
    write_regions(mesh, file);
    for (std::size_t s = 0; s < mesh->face_sets.size(); ++s) {
        if (!elements.face_elements[s].empty()) write_group(file, mesh->face_sets[s].name, elements.face_elements[s]);
    }
    for (std::size_t s = 0; s < elements.edge_elements.size(); ++s)
        write_group(file, mesh->edge_sets[s].name, std::span(&elements.edge_elements[s], 1));
    for (const auto& set : mesh->node_sets) {
        file << "GROUP_NO NOM=" << set.name << '\n';
        {
            NumberRows names(file, names_on_a_line, "N");
            for (const std::uint32_t n : set.nodes) names.add(n + std::uint64_t{1});
        }
        file << "FINSF\n";
    }
    file << "FIN\n";
    return common_losses(mesh, "Code_Aster");
}

}  // namespace geomend::meshes
