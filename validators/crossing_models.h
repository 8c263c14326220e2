// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "validators/model_scope.h"

namespace geomend::validators {

/// B32: surfaces of different models of one file, or of a model and of surfaces that it does not state, that run through each
/// other by more than the search length: each pair once, with the line. B33: surfaces that no model states and that lie on those of a
/// model, as copies do. What only touches or lies on another model is no finding: models may stand side by side. Cost: n log n in the
/// triangles of all models where there are several. \pre the scopes are of one Dataset
void report_crossing_models(std::span<const ModelScope* const> models, std::vector<Finding>& findings);

}  // namespace geomend::validators
