// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>

#include "base/finding.h"
#include "model/dataset.h"
#include "pipeline/repair.h"

namespace geomend {

/// The step clean on meshes of cells, where something was found in them that it mends, or where it is named.
/// \param before what was found in the dataset
/// \return true where nothing else is to be done: nothing that steps of surfaces mend was found or asked for, so that the cells, which
/// those steps do not keep, stay
bool mend_cells(Dataset& dataset, std::span<const Finding> before, const RepairRequest& request, RepairReport& report);

}  // namespace geomend
