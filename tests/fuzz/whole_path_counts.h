// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "formats/format.h"
#include "model/dataset.h"

namespace geomend::test {

/// Which count of objects, points, polygons or cells differs between a dataset and what was read from the file it was written
/// to, where the format keeps such things as they are and no loss was listed; empty where none does.
std::string what_got_lost(const Dataset& before, const Dataset& after, const Format& format, const std::vector<Loss>& losses);

}  // namespace geomend::test
