// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/write_pflotran.h"

#include <algorithm>
#include <cmath>

#include "base/vectors.h"
#include "formats/meshes/mesh_writing.h"

namespace geomend::meshes {

namespace {

void write_point(OutputFile& file, const Vec3& p) {
    for (const double x : p) file.number(x) << ' ';
}

void write_region(const VolumeMesh& mesh, std::uint32_t region, OutputFile& file) {
    for (const VolumeMeshData::Block& block : mesh->blocks) {
        if (block.region != region) continue;
        for (std::uint32_t c = block.first; c < block.first + block.count; ++c) file.number(c + 1) << '\n';
    }
}

struct BorderFace {
    std::uint32_t cell;
    Vec3 centre;
    double area;
};

/// A flat face by its triangles around the mean of its corners.
BorderFace measured(const VolumeMesh& mesh, const CellFaceRef& face) {
    const auto nodes = mesh.nodes_of(face);
    Vec3 middle{}, area{};
    for (const std::uint32_t n : nodes) middle = plus(middle, times(1.0 / static_cast<double>(nodes.size()), mesh->vertices[n]));
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Vec3 a = minus(mesh->vertices[nodes[i]], middle), b = minus(mesh->vertices[nodes[(i + 1) % nodes.size()]], middle);
        area = plus(area, times(0.5, cross(a, b)));
    }
    return {face.cell, middle, std::sqrt(dot(area, area))};
}

}  // namespace

Result<std::vector<Loss>> write_pflotran(const VolumeMesh& mesh, OutputSet& out, const WriteOptions&) {
    if (out.is_stream())
        return failure(FailureKind::usage, "F018", {out.main_path().string()},
                       "a grid of PFLOTRAN has files of regions beside it: name an output file");
    std::vector<Loss> losses = common_losses(mesh, "PFLOTRAN");
    const CellNetwork& network = mesh->network;
    OutputFile& file = out.main_file();
    file << "CELLS ";
    file.number(static_cast<std::uint64_t>(mesh->cell_count())) << '\n';
    for (std::size_t c = 0; c < mesh->cell_count() && file.good(); ++c) {
        file.number(static_cast<std::uint64_t>(c + 1)) << ' ';
        write_point(file, network.centres[c]);
        file.number(network.volumes[c]) << '\n';
    }
    file << "CONNECTIONS ";
    file.number(static_cast<std::uint64_t>(network.connections.size())) << '\n';
    for (const auto& c : network.connections) {
        file.number(c.from + 1) << ' ';
        file.number(c.to + 1) << ' ';
        write_point(file, c.centre);
        file.number(std::sqrt(dot(c.area, c.area))) << '\n';
    }
    for (std::uint32_t r = 0; r < mesh->regions.size(); ++r)
        write_region(mesh, r, out.companion(out.stem() + "_" + mesh->regions[r] + ".txt"));
    const std::vector<CellFaceRef> shared = shared_faces(network);
    for (const VolumeMeshData::FaceSet& set : mesh->face_sets) {
        std::vector<BorderFace> border;
        for (const CellFaceRef& face : set.faces) {
            if (!std::ranges::binary_search(shared, face)) border.push_back(measured(mesh, face));
        }
        if (border.size() < set.faces.size())
            add_loss(losses, {LossClass::substance, set.name, "faces between cells", "PFLOTRAN has sets of faces on the border only",
                              set.faces.size() - border.size()});
        if (border.empty()) continue;
        OutputFile& faces = out.companion(out.stem() + "_" + set.name + ".ex");
        faces << "CONNECTIONS ";
        faces.number(static_cast<std::uint64_t>(border.size())) << '\n';
        for (const BorderFace& face : border) {
            faces.number(face.cell + 1) << ' ';
            write_point(faces, face.centre);
            faces.number(face.area) << '\n';
        }
    }
    return losses;
}

}  // namespace geomend::meshes
