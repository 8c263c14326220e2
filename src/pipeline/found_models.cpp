// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/found_models.h"

#include <algorithm>

#include "base/number_text.h"
#include "pipeline/shape.h"
#include "topology/brep_from_dataset.h"
#include "validators/model_scope.h"

namespace geomend {

Result<FoundModels> models_in_loose_surfaces(const Dataset& dataset, double tolerance) {
    validators::CheckOptions options;
    options.tolerance = tolerance;
    auto sources = topology::model_sources(dataset, validators::lengths_of(dataset, options));
    std::erase_if(sources, [](const topology::ModelSource& s) { return s.kind != topology::ModelSource::loose_surfaces; });
    auto models = topology::models_to_judge(dataset, sources);
    if (!models) return std::move(models).why();
    FoundModels found;
    for (topology::JudgedModel& model : *models) {
        found.points_welded += model.points_welded;
        found.tolerance = std::max(found.tolerance, model.tolerance);
        found.breps.push_back(std::move(model.brep));
    }
    return found;
}

Result<void> state_found_models(Dataset& dataset, double tolerance) {
    auto found = models_in_loose_surfaces(dataset, tolerance);
    if (!found) return std::move(found).why();
    if (found->points_welded > 0)
        add_loss(dataset.losses,
                 {LossClass::identity, "", "positions of points",
                  "they are welded to others within the tolerance " + short_number(found->tolerance), found->points_welded});
    state_models(dataset, std::move(found->breps));
    return {};
}

}  // namespace geomend
