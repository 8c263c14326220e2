// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "base/vectors.h"
#include "exchange/prepare_mesh.h"
#include "exchange/volume_mesh_of.h"
#include "formats/meshes/meshes.h"
#include "topology/brep_from_dataset.h"

namespace geomend::test {

/// Makes, prepares and prints a mesh of cells, and commits the output. \return what was lost on the way
inline Result<std::vector<Loss>> write_cells(CellMesh cells, std::string_view format, OutputSet& out) {
    const auto rows = meshes::mesh_formats();
    const MeshFormat& row = *std::ranges::find(rows, format, &MeshFormat::name);
    Dataset data;
    data.objects.emplace_back(std::move(cells));
    topology::build_breps(data);
    std::vector<Loss> losses;
    const BrepData* model = data.breps.empty() ? nullptr : &*data.breps[0];
    auto mesh = exchange::volume_mesh_of(std::get<CellMesh>(data.objects[0]), model, losses);
    if (!mesh) return std::move(mesh).why();
    auto prepared = exchange::prepare(*mesh, *find_mesh_needs(row.target));
    if (!prepared) return std::move(prepared).why();
    auto written = row.write(prepared->mesh, out, {});
    if (!written) return written;
    if (auto committed = out.commit(); !committed) return std::move(committed).why();
    losses.insert(losses.end(), prepared->losses.begin(), prepared->losses.end());
    losses.insert(losses.end(), written->begin(), written->end());
    return losses;
}

inline double tet_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return dot(minus(b, a), cross(minus(c, a), minus(d, a))) / 6;
}

/// Volume of a tetrahedron, prism or hexahedron with flat faces in the order that Abaqus, Gmsh and Medit share: positive where the
/// first face looks into the cell and the corners opposite to it follow in its order.
inline double flat_volume(const std::vector<Vec3>& p) {
    const auto prism = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d, std::size_t e, std::size_t f) {
        return tet_volume(p[a], p[b], p[c], p[d]) + tet_volume(p[b], p[c], p[d], p[e]) + tet_volume(p[c], p[d], p[e], p[f]);
    };
    if (p.size() == 4) return tet_volume(p[0], p[1], p[2], p[3]);
    if (p.size() == 6) return prism(0, 1, 2, 3, 4, 5);
    return prism(0, 1, 2, 4, 5, 6) + prism(0, 2, 3, 4, 6, 7);
}

}  // namespace geomend::test
