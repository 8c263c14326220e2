// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/write_medit_binary.h"

#include <bit>

#include "formats/meshes/medit_binary.h"
#include "formats/meshes/mesh_writing.h"

namespace geomend::meshes {

namespace {

/// Numbers go out with their lowest byte first; where a section ends is worked out before it is written.
class Sections {
public:
    explicit Sections(OutputFile& file) : file_(file) {
        whole(1);
        whole(3);
        begin(static_cast<std::int32_t>(MeditSection::dimension), 4);
        whole(3);
    }

    /// Begins a section with a count and so many bytes behind it.
    void begin_counted(std::int32_t number, std::uint64_t count, std::uint64_t bytes_each) {
        begin(number, 4 + count * bytes_each);
        whole(static_cast<std::int32_t>(count));
    }
    void end() {
        whole(static_cast<std::int32_t>(MeditSection::end));
        bytes(0, 8);
    }
    void whole(std::int32_t n) { bytes(static_cast<std::uint32_t>(n), 4); }
    void real(double x) { bytes(std::bit_cast<std::uint64_t>(x), 8); }

private:
    OutputFile& file_;
    std::uint64_t at_ = 0;

    void begin(std::int32_t number, std::uint64_t size) {
        whole(number);
        bytes(at_ + 8 + size, 8);
    }
    void bytes(std::uint64_t value, unsigned count) {
        for (unsigned b = 0; b < count; ++b) file_ << static_cast<char>(value >> (8 * b) & 0xff);
        at_ += count;
    }
};

void write_cells(const VolumeMesh& mesh, const MeditCells& section, Sections& to) {
    const auto blocks = blocks_of(mesh, section.type);
    if (blocks.empty()) return;
    const std::size_t nodes = node_count(section.type);
    to.begin_counted(section.number, cells_in(blocks), 4 * nodes + 4);
    for (const VolumeMeshData::Block& block : blocks) {
        for (std::uint32_t c = block.first; c < block.first + block.count; ++c) {
            for (std::size_t k = 0; k < nodes; ++k) to.whole(static_cast<std::int32_t>(mesh->nodes_of(c)[section.order[k]] + 1));
            to.whole(static_cast<std::int32_t>(block.region + 1));
        }
    }
}

void write_faces(const VolumeMesh& mesh, const MeditCells& section, Sections& to) {
    const std::size_t corners = node_count(section.type);
    std::vector<std::int32_t> numbers;
    for (std::size_t s = 0; s < mesh->face_sets.size(); ++s) {
        for (const CellFaceRef& face : mesh->face_sets[s].faces) {
            const auto nodes = mesh.nodes_of(face);
            if (nodes.size() != corners) continue;
            for (const std::uint32_t n : nodes) numbers.push_back(static_cast<std::int32_t>(n + 1));
            numbers.push_back(static_cast<std::int32_t>(s + 1));
        }
    }
    if (numbers.empty()) return;
    to.begin_counted(section.number, numbers.size() / (corners + 1), 4 * corners + 4);
    for (const std::int32_t n : numbers) to.whole(n);
}

void write_edges(const VolumeMesh& mesh, const MeditCells& section, Sections& to) {
    std::uint64_t count = 0;
    for (const auto& set : mesh->edge_sets) count += set.edges.size();
    if (count == 0) return;
    to.begin_counted(section.number, count, 12);
    for (std::size_t s = 0; s < mesh->edge_sets.size(); ++s) {
        for (const auto& edge : mesh->edge_sets[s].edges) {
            for (const std::uint32_t n : edge) to.whole(static_cast<std::int32_t>(n + 1));
            to.whole(static_cast<std::int32_t>(s + 1));
        }
    }
}

}  // namespace

Result<std::vector<Loss>> write_medit_binary(const VolumeMesh& mesh, OutputSet& out, const WriteOptions&) {
    if (mesh->vertices.size() > 0x7fffffff || mesh->cell_count() > 0x7fffffff)
        return failure(FailureKind::cannot_hold, "F021", {out.main_path().string()}, "more points or cells than numbers of 32 bits");
    Sections to(out.main_file());
    to.begin_counted(static_cast<std::int32_t>(MeditSection::vertices), mesh->vertices.size(), 28);
    for (const Vec3& p : mesh->vertices) {
        for (const double x : p) to.real(x);
        to.whole(0);
    }
    for (const MeditCells& section : medit_cells) {
        if (dimension(section.type) == 3) write_cells(mesh, section, to);
        else if (dimension(section.type) == 2) write_faces(mesh, section, to);
        else write_edges(mesh, section, to);
    }
    to.end();
    std::vector<Loss> losses = common_losses(mesh, "Medit");
    const std::uint64_t names = mesh->regions.size() + mesh->face_sets.size() + mesh->edge_sets.size();
    if (names > 0)
        add_loss(losses, {LossClass::identity, mesh->name, "names of regions and sets", "binary Medit files have numbers", names});
    return losses;
}

}  // namespace geomend::meshes
