// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "pipeline/load.h"

namespace geomend {

/// What the user wants of a conversion.
struct ConvertRequest {
    std::vector<std::string> inputs;   ///< at least one; "-" is standard input
    std::string output;                ///< "-" is standard output
    std::string to;                    ///< format name; empty: by the output's extension
    std::string like;                  ///< a file whose corner-point grid takes the values of the inputs' cells; may be empty
    double tolerance = -1;             ///< of welding with option as=brep; negative: that of validate
    bool lossy = false;                ///< substance may be lost
    bool accept_unterminated = false;  ///< a last object without END is taken as it is
    LoadOptions load;
};

/// What came of it.
struct ConvertReport {
    std::string format;  ///< name of the format written
    std::vector<Loss> losses;
    std::vector<Finding> findings;  ///< of the inputs and of what was built between
};

/// Reads all inputs, brings them into the shape that the target format wants where that is exact, writes, and
/// puts the output in place as a whole. Without `lossy` nothing is written when substance would be lost: the
/// failure (cannot_hold) then lists each loss in `also`. Inputs that disagree in units, vertical sign or coordinate
/// system are refused (F016) unless option crs=ignore.
Result<ConvertReport> convert(const ConvertRequest& request);

/// What is done to a Dataset between reading and writing it in a format.
using DatasetChange = std::function<Result<void>(Dataset&, const Format& target)>;

/// The same with a change between; its failure ends the conversion.
Result<ConvertReport> convert(const ConvertRequest& request, const DatasetChange& change);

}  // namespace geomend
