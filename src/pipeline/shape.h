// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "base/result.h"
#include "formats/format.h"
#include "model/brep.h"
#include "model/dataset.h"

namespace geomend {

/// Brings a Dataset into the shape that a writer wants (Format::wants) where that is exact: builds boundary
/// representations, turns tagged meshes into faced models and the other way round. A Dataset that already has the
/// shape, or that states no model, stays as it is. Losses of the change are added to dataset.losses.
void shape_for(Dataset& dataset, const Format& target);

/// Puts boundary representations that were found in a Dataset into it as models over surfaces, in the place of the objects that they
/// were made from. Models that it states become such ones, too; other objects follow behind them.
void state_models(Dataset& dataset, std::vector<Brep> found);

/// Gives meshes of cells with regions the surfaces around these that they leave out, between regions and around all. What a model
/// stated of their sides does not know these surfaces: it goes, as a loss.
void surround_regions(Dataset& dataset);

/// Takes meshes that have no volumes and no entities apart into surfaces, polylines and point sets.
void flatten_meshes(Dataset& dataset);

}  // namespace geomend
