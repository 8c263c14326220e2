// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/dataset.h"
#include "topology/assemble.h"
#include "topology/welded_points.h"

namespace geomend::topology {

/// Builds the boundary representations of everything in a Dataset that states one: each StatedModel over
/// surfaces, and each CellMesh with entities. Bit-equal positions are one model vertex (zero distance, no
/// tolerance). Fills dataset.breps and adds findings where the file's claims disagree with its geometry.
/// Loose surfaces without a StatedModel make none. Cost: near-linear in triangles and cells.
void build_breps(Dataset& dataset);

/// One model to be judged: what it is made of, and at which tolerances its points are welded.
struct ModelSource {
    enum Kind : std::uint8_t { stated_model, tagged_mesh, loose_surfaces } kind = loose_surfaces;
    std::uint32_t model = no_index;  ///< a stated model's number in the Dataset
    /// The objects of the model, in groups with a tolerance each: points of two groups are welded where they are equal only.
    std::vector<WeldGroup> groups;
};

/// The models of a Dataset, each of one group at tolerance 0: those that the file states, then meshes with entities that none
/// of them is about, then one of all surfaces that belong to none. What would make no surface and no region is left out.
std::vector<ModelSource> model_sources(const Dataset& dataset);

/// The surfaces of each source over welded vertices, in the order of the sources: what assemble() takes. \pre as of models_to_judge().
std::vector<SurfaceComplex> complexes_of(const Dataset& dataset, std::span<const ModelSource> sources);

/// Builds what checks judge, in the order of the sources. Points closer than the tolerance of their group are one vertex: they
/// take the position of the one that comes first. Loose surfaces are taken apart where lines cut them and where they do not
/// hang together, and wound one way.
/// \pre sources are those of model_sources(), whose groups may be split and given tolerances, and whose loose surfaces may be
/// split into several sources. Failure (internal) where indices are out of range. Cost: near-linear in triangles and cells.
Result<std::vector<JudgedModel>> models_to_judge(const Dataset& dataset, std::span<const ModelSource> sources);

/// The same for all models at one tolerance; 0: only equal positions.
Result<std::vector<JudgedModel>> models_to_judge(const Dataset& dataset, double tolerance);

}  // namespace geomend::topology
