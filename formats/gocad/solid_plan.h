// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/loss.h"
#include "model/objects.h"
#include "model/stated_model.h"

namespace geomend::gocad {

/// How a CellMesh goes out as a solid: its tetrahedra by volume, its triangles by face, names that are unique.
struct SolidPlan {
    struct Volume {
        std::string name;
        std::vector<std::uint32_t> cells;
        std::int64_t model_face = 0;  ///< index of a face + 1, negative where the volume lies behind it; 0: none
    };
    struct Face {
        std::string surface;
        std::vector<std::uint32_t> cells;  ///< triangles
        std::size_t key = 0;               ///< which of them gives the KEYVERTICES
    };
    std::vector<Volume> volumes;
    std::vector<Face> faces;               ///< faces of one surface stand together
    std::vector<std::uint32_t> volume_of;  ///< per cell; no_index for cells that are no tetrahedra
    std::uint64_t tetrahedra = 0;
    std::vector<Loss> losses;

    /// Per cell number of the tetrahedron (in cell order) -> 4 tags; names in facet_names.
    std::vector<CellMesh::FacetTag> facet_tags;
    std::vector<std::string> facet_names;
};

/// Makes the plan. Facet tags are those of the mesh, or, where it has none, follow from its triangles: a facet and a
/// triangle with the same positions (bit by bit) belong together.
/// Cost: proportional to cells, with hashing where tags or model regions have to be found.
SolidPlan plan_solid(const CellMesh& mesh, const StatedModel* model);

}  // namespace geomend::gocad
