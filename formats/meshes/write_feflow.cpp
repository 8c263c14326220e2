// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/write_feflow.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/xml_text.h"
#include "formats/meshes/mesh_writing.h"

namespace geomend::meshes {

namespace {

struct FeflowElement {
    CellType type;
    std::uint32_t code;
    std::span<const std::uint8_t> order;  ///< per node of FEFLOW ours: the upper face first, counter-clockwise from outside
};

constexpr std::uint8_t tetrahedron_order[] = {0, 1, 2, 3}, wedge_order[] = {3, 5, 4, 0, 2, 1},
                       hexahedron_order[] = {4, 5, 6, 7, 0, 1, 2, 3};
constexpr std::array elements = {FeflowElement{CellType::tetrahedron, 6, tetrahedron_order}, FeflowElement{CellType::wedge, 7, wedge_order},
                                 FeflowElement{CellType::hexahedron, 8, hexahedron_order}};

const FeflowElement& element_of(CellType type) { return *std::ranges::find(elements, type, &FeflowElement::type); }

void write_head(const VolumeMesh& mesh, OutputFile& file) {
    std::string name = in_a_line(mesh->name);
    file << "PROBLEM: " << name << "\nCLASS (v.7.006.14742)\n   0    0    0    3    0    0    8    8    0    0\nDIMENS\n ";
    file.number(static_cast<std::uint64_t>(mesh->vertices.size())) << ' ';
    file.number(static_cast<std::uint64_t>(mesh->cell_count())) << " 0 1 0 0 0 0 0 1 0 0 0 0 0 0 0\nSCALE\n\n";
}

void write_elements(const VolumeMesh& mesh, OutputFile& file) {
    std::size_t least = 8, most = 4;
    for (const auto& block : mesh->blocks) {
        least = std::min(least, element_of(block.type).order.size());
        most = std::max(most, element_of(block.type).order.size());
    }
    file << "VARNODE\n ";
    file.number(static_cast<std::uint64_t>(mesh->cell_count())) << ' ';
    file.number(static_cast<std::uint64_t>(least)) << ' ';
    file.number(static_cast<std::uint64_t>(most)) << '\n';
    for (const auto& block : mesh->blocks) {
        const FeflowElement& element = element_of(block.type);
        for (std::uint32_t c = block.first; c < block.first + block.count && file.good(); ++c) {
            file << ' ';
            file.number(element.code);
            write_nodes(file, mesh->nodes_of(c), element.order, ' ');
            file << '\n';
        }
    }
}

void write_points(const VolumeMesh& mesh, OutputFile& file) {
    file << "XYZCOOR\n";
    for (const Vec3& p : mesh->vertices) {
        for (std::size_t k = 0; k < 3; ++k) file << (k == 0 ? " " : ", "), file.number(p[k]);
        file << '\n';
    }
}

/// A name that is no single word stands between quotes.
std::string set_name(const std::string& name) {
    std::string text = in_a_line(name);
    std::ranges::replace(text, '"', '\'');
    const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.'; };
    return !text.empty() && std::ranges::all_of(text, is_word) ? text : '"' + text + '"';
}

void write_regions(const VolumeMesh& mesh, OutputFile& file) {
    file << "ELEMENTALSETS\n";
    for (std::size_t b = 0; b < mesh->blocks.size();) {
        const auto& first = mesh->blocks[b];
        std::uint64_t end = first.first;
        for (; b < mesh->blocks.size() && mesh->blocks[b].region == first.region; ++b) end += mesh->blocks[b].count;
        file << ' ' << set_name(mesh->regions[first.region]) << ' ';
        file.number(std::uint64_t{first.first} + 1) << '-';
        file.number(end) << '\n';
    }
}

/// Chains of edges as discrete features.
void write_features(const VolumeMesh& mesh, OutputFile& file) {
    std::uint64_t count = 0;
    for (const auto& set : mesh->edge_sets) count += set.edges.size();
    if (count == 0) return;
    file << "DFE\n <?xml version=\"1.0\" encoding=\"utf-8\" standalone=\"no\" ?>\n <fractures>\n <nop count=\"";
    file.number(count) << "\">\n <![CDATA[";
    for (const auto& set : mesh->edge_sets) {
        for (const auto& edge : set.edges) {
            file << "\n 0, 2, ";
            file.number(edge[0] + std::uint64_t{1}) << ", ";
            file.number(edge[1] + std::uint64_t{1});
        }
    }
    file << "]]>\n </nop>\n <properties>\n </properties>\n <groups count=\"";
    file.number(static_cast<std::uint64_t>(mesh->edge_sets.size())) << "\">\n";
    std::uint64_t first = 1;
    for (const auto& set : mesh->edge_sets) {
        file << " <group name=\"" << xml_attribute(in_a_line(set.name)) << "\" mode=\"unstructured\">\n <elements count=\"";
        file.number(static_cast<std::uint64_t>(set.edges.size())) << "\">\n <![CDATA[ ";
        file.number(first) << '-';
        first += set.edges.size();
        file.number(first - 1) << "]]>\n </elements>\n </group>\n";
    }
    file << " </groups>\n </fractures>\n";
}

}  // namespace

Result<std::vector<Loss>> write_feflow(const VolumeMesh& mesh, OutputSet& out, const WriteOptions&) {
    std::vector<Loss> losses = common_losses(mesh, "FEFLOW");
    OutputFile& file = out.main_file();
    write_head(mesh, file);
    write_elements(mesh, file);
    write_points(mesh, file);
    write_regions(mesh, file);
    write_features(mesh, file);
    file << "END\n";
    return losses;
}

}  // namespace geomend::meshes
