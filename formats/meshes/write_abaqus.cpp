// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/write_abaqus.h"

#include <algorithm>
#include <charconv>
#include <set>

#include "base/text_cursor.h"
#include "formats/meshes/abaqus_elements.h"
#include "formats/meshes/mesh_writing.h"

namespace geomend::meshes {

namespace {

constexpr std::size_t longest_number = 20;

/// Appends a number in as many digits as are read. \return whether it was rounded
bool append_coordinate(std::string& line, double value) {
    const std::size_t before = line.size();
    append_number(line, value);
    if (line.size() - before <= longest_number) return false;
    line.resize(before);
    char text[64];
    for (int digits = 16; digits > 0; --digits) {
        const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, digits - 1).ptr;
        if (static_cast<std::size_t>(end - text) > longest_number) continue;
        line.append(text, end);
        break;
    }
    return true;
}

void write_head(const VolumeMesh& mesh, OutputFile& file) {
    file << "*HEADING\n";
    const std::string name = in_a_line(mesh->name);
    file << (name.empty() || name.front() == '*' ? "mesh " : "") << name << '\n';
}

/// \return how many coordinates were rounded
std::uint64_t write_nodes_part(const VolumeMesh& mesh, OutputFile& file) {
    std::uint64_t rounded = 0;
    std::string line;
    file << "*NODE\n";
    for (std::size_t v = 0; v < mesh->vertices.size() && file.good(); ++v) {
        line.clear();
        append_number(line, static_cast<std::uint64_t>(v + 1));
        for (const double x : mesh->vertices[v]) {
            line += ", ";
            if (append_coordinate(line, x)) ++rounded;
        }
        file << line << '\n';
    }
    return rounded;
}

/// Numbers after each other; a line holds so many, and goes on in the next one where it ends with a comma.
class NumberLines {
public:
    NumberLines(OutputFile& file, std::size_t a_line) : file_(file), a_line_(a_line) {}

    void add(std::uint64_t number) {
        if (in_line_ > 0) file_ << (in_line_ % a_line_ == 0 ? ",\n" : ", ");
        file_.number(number);
        ++in_line_;
    }
    void end() {
        if (in_line_ > 0) file_ << '\n';
        in_line_ = 0;
    }

private:
    OutputFile& file_;
    std::size_t a_line_, in_line_ = 0;
};

void write_elements(const VolumeMesh& mesh, OutputFile& file) {
    NumberLines line(file, 11);
    for (const VolumeMeshData::Block& block : mesh->blocks) {
        const AbaqusElement& element = *abaqus_element_written(block.type);
        file << "*ELEMENT, TYPE=" << element.name << ", ELSET=" << mesh->regions[block.region] << '\n';
        for (std::uint32_t c = block.first; c < block.first + block.count && file.good(); ++c) {
            const auto nodes = mesh->nodes_of(c);
            line.add(c + std::uint64_t{1});
            for (const std::uint8_t i : element.order) line.add(nodes[i] + std::uint64_t{1});
            line.end();
        }
    }
}

void write_surfaces(const VolumeMesh& mesh, OutputFile& file) {
    for (const auto& set : mesh->face_sets) {
        file << "*SURFACE, NAME=" << set.name << ", TYPE=ELEMENT\n";
        for (const CellFaceRef& face : set.faces) {
            file.number(face.cell + 1) << ", S";
            file.number(std::uint32_t{abaqus_element_written(mesh.block_of(face.cell).type)->faces[face.face]}) << '\n';
        }
    }
}

void write_node_set(OutputFile& file, const std::string& name, std::span<const std::uint32_t> nodes) {
    file << "*NSET, NSET=" << name << '\n';
    constexpr std::size_t a_line = 16;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        file.number(nodes[i] + 1) << (i + 1 == nodes.size() || (i + 1) % a_line == 0 ? "\n" : ", ");
    }
}

/// Node sets, and edge sets as the nodes along them.
void write_node_sets(const VolumeMesh& mesh, OutputFile& file, std::vector<Loss>& losses) {
    std::set<std::string> used;
    for (const auto& set : mesh->node_sets) {
        used.insert(lower_case(set.name));
        write_node_set(file, set.name, set.nodes);
    }
    for (const auto& set : mesh->edge_sets) {
        std::string name = set.name;
        for (int n = 1; !used.insert(lower_case(name)).second; ++n) name = set.name.substr(0, 70) + "_edges" + std::to_string(n);
        std::vector<std::uint32_t> nodes;
        for (const auto& edge : set.edges) nodes.insert(nodes.end(), edge.begin(), edge.end());
        std::ranges::sort(nodes);
        nodes.erase(std::ranges::unique(nodes).begin(), nodes.end());
        write_node_set(file, name, nodes);
        add_loss(losses, {LossClass::identity, set.name, "edges", "Abaqus has the set of their nodes", set.edges.size()});
    }
}

}  // namespace

Result<std::vector<Loss>> write_abaqus(const VolumeMesh& mesh, OutputSet& out, const WriteOptions&) {
    std::vector<Loss> losses = common_losses(mesh, "Abaqus");
    OutputFile& file = out.main_file();
    write_head(mesh, file);
    const std::uint64_t rounded = write_nodes_part(mesh, file);
    write_elements(mesh, file);
    write_surfaces(mesh, file);
    write_node_sets(mesh, file, losses);
    if (rounded > 0)
        add_loss(losses, {LossClass::identity, "", "last digits of coordinates", "Abaqus reads 20 characters of a number", rounded});
    return losses;
}

}  // namespace geomend::meshes
