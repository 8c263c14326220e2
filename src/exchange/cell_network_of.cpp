// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/cell_network_of.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

#include "base/vectors.h"
#include "exchange/inner_faces.h"
#include "model/each_face.h"

namespace geomend::exchange {

namespace {

Vec3 mean_of(const VolumeMeshData& mesh, std::span<const std::uint32_t> nodes) {
    Vec3 sum{};
    for (const std::uint32_t n : nodes) sum = plus(sum, mesh.vertices[n]);
    return times(1.0 / static_cast<double>(nodes.size()), sum);
}

/// Volume and moment of cells, summed over the tetrahedra between a point inside and the triangles of the faces.
void measure_cells(const VolumeMeshData& mesh, CellNetwork& network) {
    network.volumes.assign(mesh.cell_count(), 0);
    network.centres.assign(mesh.cell_count(), Vec3{});
    std::vector<Vec3> inside;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) inside.push_back(mean_of(mesh, mesh.nodes_of(c)));
    for (const VolumeMeshData::Block& block : mesh.blocks) {
        each_face(mesh, block, [&](const CellFaceRef& face, const std::vector<std::uint32_t>& nodes) {
            const Vec3& from = inside[face.cell];
            const Vec3 middle = minus(mean_of(mesh, nodes), from);
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                const Vec3 a = minus(mesh.vertices[nodes[i]], from), b = minus(mesh.vertices[nodes[(i + 1) % nodes.size()]], from);
                const double volume = dot(middle, cross(a, b)) / 6;
                network.volumes[face.cell] += volume;
                network.centres[face.cell] = plus(network.centres[face.cell], times(volume / 4, plus(plus(a, b), middle)));
            }
        });
    }
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        const double volume = network.volumes[c];
        network.centres[c] = volume != 0 ? plus(inside[c], times(1 / volume, network.centres[c])) : inside[c];
    }
}

CellNetwork::Connection connection(const VolumeMeshData& mesh, const InnerFace& face) {
    const auto nodes = nodes_of(mesh, face[0]);
    const Vec3 middle = mean_of(mesh, nodes);
    Vec3 area{}, moment{};
    double size = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Vec3 a = minus(mesh.vertices[nodes[i]], middle), b = minus(mesh.vertices[nodes[(i + 1) % nodes.size()]], middle);
        const Vec3 part = times(0.5, cross(a, b));
        const double part_size = std::sqrt(dot(part, part));
        area = plus(area, part);
        moment = plus(moment, times(part_size / 3, plus(a, b)));
        size += part_size;
    }
    return {face[0].cell, face[1].cell, face[0].face, face[1].face, area, size > 0 ? plus(middle, times(1 / size, moment)) : middle};
}

}  // namespace

CellNetwork cell_network_of(const VolumeMeshData& mesh) {
    CellNetwork network;
    measure_cells(mesh, network);
    for (const InnerFace& face : inner_faces(mesh)) network.connections.push_back(connection(mesh, face));
    std::ranges::sort(network.connections, [](const auto& p, const auto& q) {
        return std::tie(p.from, p.to, p.from_face) < std::tie(q.from, q.to, q.from_face);
    });
    return network;
}

}  // namespace geomend::exchange
