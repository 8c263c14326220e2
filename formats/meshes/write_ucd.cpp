// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/write_ucd.h"

#include <algorithm>
#include <array>

#include "formats/meshes/mesh_writing.h"

namespace geomend::meshes {

namespace {

struct CellWords {
    CellType type;
    const char* word;
    std::vector<std::uint8_t> order;  ///< per node of the file its number in ours
};

// As VTK's reader of this format takes them: ours, but for the tip of a pyramid, which comes first.
const std::array<CellWords, 4>& cell_words() {
    static const std::array<CellWords, 4> words{{{CellType::tetrahedron, "tet", {0, 1, 2, 3}},
                                                 {CellType::pyramid, "pyr", {4, 0, 1, 2, 3}},
                                                 {CellType::wedge, "prism", {0, 1, 2, 3, 4, 5}},
                                                 {CellType::hexahedron, "hex", {0, 1, 2, 3, 4, 5, 6, 7}}}};
    return words;
}

void write_cells(const VolumeMesh& mesh, OutputFile& file) {
    for (const VolumeMeshData::Block& block : mesh->blocks) {
        const CellWords& words = *std::ranges::find(cell_words(), block.type, &CellWords::type);
        for (std::uint32_t c = block.first; c < block.first + block.count && file.good(); ++c) {
            file.number(c + 1) << ' ';
            file.number(block.region + 1) << ' ' << words.word;
            write_nodes(file, mesh->nodes_of(c), words.order, ' ');
            file << '\n';
        }
    }
}

std::vector<const Attribute*> numbers_at(const VolumeMesh& mesh, AttributeLocation location) {
    std::vector<const Attribute*> found;
    for (const Attribute& a : mesh->attributes) {
        if (a.location == location && !is_text(a)) found.push_back(&a);
    }
    return found;
}

std::uint64_t columns_of(std::span<const Attribute* const> attributes) {
    std::uint64_t columns = 0;
    for (const Attribute* a : attributes) columns += a->components;
    return columns;
}

/// A label of the file ends at the comma.
std::string label(std::string_view name) {
    std::string text = in_a_line(name);
    std::ranges::replace(text, ',', ' ');
    return text;
}

void write_values(OutputFile& file, std::span<const Attribute* const> attributes, std::size_t things) {
    if (attributes.empty()) return;
    file.number(static_cast<std::uint64_t>(attributes.size()));
    for (const Attribute* a : attributes) file << ' ', file.number(static_cast<std::uint64_t>(a->components));
    file << '\n';
    for (const Attribute* a : attributes) file << label(a->name) << ", " << label(a->unit) << '\n';
    for (std::size_t i = 0; i < things && file.good(); ++i) {
        file.number(static_cast<std::uint64_t>(i + 1));
        for (const Attribute* a : attributes) write_attribute_values(file, *a, i);
        file << '\n';
    }
}

}  // namespace

Result<std::vector<Loss>> write_ucd(const VolumeMesh& mesh, OutputSet& out, const WriteOptions&) {
    std::vector<Loss> losses = common_losses(mesh, "AVS UCD");
    for (const Attribute& a : mesh->attributes) {
        if (is_text(a)) add_loss(losses, {LossClass::substance, "", "attribute '" + a.name + "'", "AVS UCD holds numbers only", 1});
    }
    const auto points = numbers_at(mesh, AttributeLocation::point), cells = numbers_at(mesh, AttributeLocation::cell);
    OutputFile& file = out.main_file();
    for (std::size_t r = 0; r < mesh->regions.size(); ++r) {
        file << "# material ";
        file.number(static_cast<std::uint64_t>(r + 1)) << ": " << in_a_line(mesh->regions[r]) << '\n';
    }
    file.number(static_cast<std::uint64_t>(mesh->vertices.size())) << ' ';
    file.number(static_cast<std::uint64_t>(mesh->cell_count())) << ' ';
    file.number(columns_of(points)) << ' ';
    file.number(columns_of(cells)) << " 0\n";
    for (std::size_t v = 0; v < mesh->vertices.size() && file.good(); ++v) {
        file.number(static_cast<std::uint64_t>(v + 1));
        for (const double x : mesh->vertices[v]) file << ' ', file.number(x);
        file << '\n';
    }
    write_cells(mesh, file);
    write_values(file, points, mesh->vertices.size());
    write_values(file, cells, mesh->cell_count());
    return losses;
}

}  // namespace geomend::meshes
