// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/merge.h"

#include <iterator>

#include "model/append_objects.h"

namespace geomend {

namespace {

// The first coordinate system that a dataset states; systems of one file are not compared with each other.
const CoordinateSystem* stated_crs(const Dataset& dataset) {
    for (const StatedModel& model : dataset.models) {
        if (model.crs.stated) return &model.crs;
    }
    for (const Object& object : dataset.objects) {
        if (info_of(object).crs.stated) return &info_of(object).crs;
    }
    return nullptr;
}

template <class T>
void append(std::vector<T>& into, std::vector<T>& more) {
    into.insert(into.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

void merge(Dataset& into, Dataset more) {
    append_objects(into, more);
    append(into.groups, more.groups);
    append(into.annotations, more.annotations);
    append(into.findings, more.findings);
    for (Loss& loss : more.losses) add_loss(into.losses, std::move(loss));
    if (into.format != more.format) into.format = into.variant = {};
}

Result<void> check_agreement(const Dataset& a, const std::string& file_a, const Dataset& b, const std::string& file_b) {
    const CoordinateSystem* first = stated_crs(a);
    const CoordinateSystem* second = stated_crs(b);
    if (first == nullptr || second == nullptr) return {};
    const bool both_signs = first->z_positive_stated && second->z_positive_stated;
    const std::string what = disagreement(*first, *second, both_signs);
    if (what.empty()) return {};
    return failure(FailureKind::usage, "F016", {file_b},
                   "disagrees with " + file_a + " in " + what + "; --option crs=ignore takes them together as they are");
}

}  // namespace geomend
