// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "base/result.h"
#include "model/dataset.h"

namespace geomend {

/// Moves all objects and models of `more` behind those of `into`, with indices corrected. Neither has breps yet.
void merge(Dataset& into, Dataset more);

/// Failure F016 when two datasets state units, signs of Z or coordinate systems that disagree.
Result<void> check_agreement(const Dataset& a, const std::string& file_a, const Dataset& b, const std::string& file_b);

}  // namespace geomend
