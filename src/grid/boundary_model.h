// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "grid/faces.h"
#include "model/dataset.h"

namespace geomend::grid {

/// Which surfaces and regions a model takes from a grid.
struct ModelRequest {
    std::string regions;                  ///< attribute of cells whose values are regions; empty: none
    std::vector<std::uint32_t> horizons;  ///< layers (from 1) below which a horizon lies
};

/// What a surface of such a model was made from.
struct ModelSources {
    struct Side {
        std::uint32_t first, second;  ///< the cells on both sides; second is 0xffffffff where there is none
    };
    std::vector<std::vector<Side>> sides;  ///< per surface (object), per triangle
    std::uint64_t unmatched_columns = 0;   ///< as of GridFaces: there nothing closes
};

/// The boundary representation of a grid, as surfaces and a model stated over them: the outside of the grid (one interface
/// per side), faults (named by FAULTS records, else "unnamed throw"), horizons below the chosen layers and what else
/// divides two regions. Regions are the values of an attribute, cut at horizons where those are given. Surfaces are
/// made of the faces of conforming_faces(), as triangles (face_triangles()): they share their points where they meet, and a
/// region holds exactly what the polyhedra of its cells hold. Each surface hangs together, is wound one way and ends where
/// more than two of its triangles would meet: an interface may have many. Open faces that look opposite ways, and triangles
/// that coincide, are on surfaces apart. Failure (usage) where the attribute is missing or a layer is not in the grid.
/// \param sources where not null: takes what each surface was made from
Result<Dataset> boundary_model(const CornerPointGrid& grid, const ModelRequest& request, ModelSources* sources = nullptr);

/// The name of the fault that FAULTS records put on a face of a cell, or nullptr. Built once per grid.
class FaultFaces {
public:
    explicit FaultFaces(const CornerPointGrid& grid);
    const std::string* find(std::size_t cell, CellFace face) const;

private:
    const CornerPointGrid& grid_;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> faces_;  // 6 cell + face, fault; sorted
};

}  // namespace geomend::grid
