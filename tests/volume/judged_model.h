// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "topology/brep_from_dataset.h"

namespace geomend::test {

/// The model that loose surfaces are, which is one.
inline topology::JudgedModel model_of(std::vector<Surface> surfaces) {
    Dataset dataset;
    for (Surface& s : surfaces) dataset.objects.emplace_back(std::move(s));
    auto models = topology::models_to_judge(dataset, 1e-9);
    EXPECT_TRUE(models && models->size() == 1);
    return std::move(models->front());
}

}  // namespace geomend::test
