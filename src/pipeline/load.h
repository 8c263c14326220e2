// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "base/monitor.h"
#include "formats/format.h"
#include "model/dataset.h"

namespace geomend {

/// What the user says of the inputs.
struct LoadOptions {
    std::string from;  ///< format or family name; empty: by content, then by extension
    FormatOptions options;
    const Monitor* monitor = nullptr;
};

/// Reads one file ("-" is standard input) with the format that fits it. No topology is built.
/// \param companions gets the paths of the further files that were read for it, ascending; nullptr: nobody asks
Result<Dataset> load(const std::string& path, const LoadOptions& options, std::vector<std::string>* companions = nullptr);

}  // namespace geomend
