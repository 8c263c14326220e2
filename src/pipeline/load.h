// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
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
    std::span<const OptionRow> command = {};  ///< options that are not the reader's but the caller's
    bool one_of_many = false;                 ///< options of other formats are no mistake: another file may be theirs
};

/// A file whose format is known, before it is read.
struct OpenedInput {
    Input input;
    const Format* format;
};

/// Opens a file ("-" is standard input) and looks at its first bytes.
Result<OpenedInput> open_input(const std::string& path, const LoadOptions& options);

/// Reads it. Its options are taken as they are: see checked_options(). No topology is built.
/// \param companions gets the paths of the further files that were read for it, ascending; nullptr: nobody asks
Result<Dataset> load(const OpenedInput& opened, const LoadOptions& options, std::vector<std::string>* companions = nullptr);

/// Opens a file, checks the options against what its format and the caller know, and reads it.
/// \param companions gets the paths of the further files that were read for it, ascending; nullptr: nobody asks
Result<Dataset> load(const std::string& path, const LoadOptions& options, std::vector<std::string>* companions = nullptr);

}  // namespace geomend
