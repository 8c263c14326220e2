// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "repair/surface_model.h"

namespace geomend::repair {

/// What became of the name of a region.
struct NameChange {
    enum Kind : std::uint8_t { lost, made, parted } kind;
    std::string name;  ///< lost: that it had; made, parted: that it has
    std::string from;  ///< parted: the region that it was a part of
    bool operator==(const NameChange&) const = default;
};

/// A mended model as it can be judged and written.
struct SurfaceResult {
    Brep brep;
    Dataset dataset;                  ///< one surface for each interface, with a model stated over them
    std::vector<NameChange> changes;  ///< of regions; in no run of a kind sorted by name
};

/// The pieces and regions of a model as it is now.
struct PiecesOfModel {
    Brep brep;
    std::vector<std::vector<std::uint32_t>> triangles;  ///< per surface its triangles in model.model.soup
};
/// Failure (internal) where the result is inconsistent. Cost: near-linear.
Result<PiecesOfModel> pieces_of(const SurfaceModel& model);

/// Makes the boundary representation of a model: surfaces are one for each piece between lines, regions are found by walking
/// along them. Attributes come from where triangles come from. A region that was read gives its name to that of the new ones
/// with which it shares most area; others that share most with it are named after it. Layers and fault blocks follow.
/// Failure (internal) where the result is inconsistent. Cost: near-linear.
Result<SurfaceResult> result_of(const SurfaceModel& model);

/// What lies on both sides of the triangles of a soup.
struct TriangleRegions {
    std::vector<std::array<std::uint32_t, 2>> sides;  ///< per triangle; no_index: the outside, or nothing that is closed
    std::vector<double> thickness;                    ///< per region: twice its volume by its area; infinite where it is not known

    /// Whether both regions, or a region and the outside, stay only where this triangle stays.
    bool parts(std::size_t triangle) const { return sides[triangle][0] != sides[triangle][1]; }
};
/// Failure (internal) where the model cannot be assembled. Cost: near-linear.
Result<TriangleRegions> triangle_regions(const SurfaceModel& model);

}  // namespace geomend::repair
