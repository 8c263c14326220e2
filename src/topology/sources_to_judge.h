// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "topology/brep_from_dataset.h"

namespace geomend::topology {

/// model_sources() as checks take them: meshes of faces without volumes are loose surfaces, which may be in several parts and meet those
/// of other objects; their entities, and arrays called after surfaces, tell them apart, as such arrays do in surfaces.
std::vector<ModelSource> sources_to_judge(const Dataset& dataset);

}  // namespace geomend::topology
