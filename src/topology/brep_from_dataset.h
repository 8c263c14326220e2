// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "model/dataset.h"

namespace geomend::topology {

/// Builds the boundary representations of everything in a Dataset that states one: each StatedModel over
/// surfaces, and each CellMesh with entities. Bit-equal positions are one model vertex (zero distance, no
/// tolerance). Fills dataset.breps and adds findings where the file's claims disagree with its geometry.
/// Loose surfaces without a StatedModel make none. Cost: near-linear in triangles and cells.
void build_breps(Dataset& dataset);

}  // namespace geomend::topology
