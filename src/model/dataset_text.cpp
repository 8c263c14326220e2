// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/dataset_text.h"

namespace geomend {

std::string dataset_text(const Dataset&) { return "{}"; }
bool apply_dataset_text(std::string_view, Dataset&) { return false; }

}  // namespace geomend
