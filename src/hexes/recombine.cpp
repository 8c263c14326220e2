// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/recombine.h"

#include <algorithm>

#include "geometry/cell_volume.h"
#include "hexes/assemble_mesh.h"
#include "hexes/jacobian.h"

namespace geomend::hexes {

namespace {

double volume_of(CellType type, std::span<const Vec3> p, std::span<const std::uint32_t> ids) {
    switch (type) {
        case CellType::tetrahedron:
            return tetrahedron_volume(p[0], p[1], p[2], p[3]);
        case CellType::pyramid:
            return pyramid_volume({p[0], p[1], p[2], p[3], p[4]});
        case CellType::wedge:
            return -prism_volume(p, ids);  // VTK's wedge has its first triangle turned outwards
        case CellType::hexahedron:
            return hexahedron_volume({p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7]});
        default:
            return 0;
    }
}

void measure(const VolumeMesh& mesh, RecombineReport& report) {
    std::vector<Vec3> p;
    for (const auto& block : mesh->blocks) {
        TypeShare share{block.region, block.type, block.count, 0};
        for (std::uint32_t c = block.first; c < block.first + block.count; ++c) {
            const auto nodes = mesh->nodes_of(c);
            p.clear();
            for (const std::uint32_t v : nodes) p.push_back(minus(mesh->vertices[v], mesh->vertices[nodes[0]]));
            share.volume += volume_of(block.type, p, nodes);
            if (!corner_frames(block.type).empty() && !is_valid(block.type, p)) ++report.folded;
            if (block.type != CellType::hexahedron) continue;
            const double jacobian = scaled_jacobian(block.type, p);
            report.least_jacobian = std::min(report.least_jacobian, jacobian);
            ++report.jacobian_by_tenths[static_cast<std::size_t>(std::clamp(jacobian * 10, 0.0, 9.0))];
        }
        report.shares.push_back(share);
    }
}

/// Selects and closes; what cannot be closed without a loss is not selected again.
MixedMesh closed(const TetMesh& tets, const Conflicts& conflicts, std::vector<double>& weights, const RecombineOptions& options,
                 RecombineReport& report) {
    constexpr int rounds = 12;
    for (int round = 1;; ++round) {
        const std::vector<std::uint32_t> selected = select_greedily(conflicts, weights, Greedy::weight);
        std::vector<std::uint32_t> failed;
        report.closing = {};
        report.selected = selected.size();
        MixedMesh mesh = close(tets, conflicts.candidates(), selected, options.closing, report.closing, failed);
        if (failed.empty() || options.closing == Closing::split || round == rounds) return mesh;
        for (const std::uint32_t i : failed) weights[i] = 0;
    }
}

}  // namespace

std::uint64_t RecombineReport::count_of(CellType type) const {
    std::uint64_t count = 0;
    for (const TypeShare& s : shares) count += s.type == type ? s.count : 0;
    return count;
}

std::uint64_t RecombineReport::cell_count() const {
    std::uint64_t count = 0;
    for (const TypeShare& s : shares) count += s.count;
    return count;
}

double RecombineReport::volume_share_of(CellType type) const {
    double part = 0, whole = 0;
    for (const TypeShare& s : shares) {
        whole += s.volume;
        part += s.type == type ? s.volume : 0;
    }
    return whole > 0 ? part / whole : 0;
}

Result<VolumeMesh> recombine(const VolumeMesh& mesh, const RecombineOptions& options, RecombineReport& report) {
    const TetMesh tets = tet_mesh_of(mesh);
    if (tets.tets.empty()) return failure(FailureKind::cannot_hold, "F021", {}, "there are no tetrahedra to make hexahedra of");
    report.tetrahedra = tets.tets.size();
    const QuadTable quads(tets, options.least_quality);
    const SearchOptions search{options.least_quality, {}, options.monitor};
    const Candidates hexahedra = options.thin_only ? thin_cells(tets, quads, search, report.thin) : find_hexahedra(tets, quads, search);
    report.candidates = hexahedra.size();
    const Conflicts conflicts(hexahedra, tets.tets.size());
    std::vector<double> weights = hexahedra.quality;
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] += hexahedra.types[i] == CellType::wedge ? 1 : 0;
    auto made = assemble(mesh, tets, closed(tets, conflicts, weights, options, report));
    if (made) measure(*made, report);
    return made;
}

}  // namespace geomend::hexes
