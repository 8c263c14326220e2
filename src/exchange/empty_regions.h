// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <vector>

#include "model/brep.h"
#include "model/loss.h"

namespace geomend::exchange {

/// Takes the cells out of all regions of a model, with their values, and lists them; values for the whole of a region stay.
/// \param cells the class of losing the cells themselves \param why they go. Linear.
void empty_regions(BrepData& brep, LossClass cells, const char* why, std::vector<Loss>& losses);

}  // namespace geomend::exchange
