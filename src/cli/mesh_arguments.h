// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "base/monitor.h"
#include "base/result.h"
#include "cli/common_options.h"
#include "cli/size_arguments.h"
#include "pipeline/mesh.h"

namespace geomend::cli {

/// What the command mesh takes.
struct MeshArguments : CommonOptions {
    std::vector<std::string> inputs;
    std::string output, split = "none", wells = "all", method, cells, select = "search";
    std::vector<std::string> stated;  ///< options for filling that were given
    double size = 0, ratio = 1.4, seconds = 120, megabytes = 0, max_distance = 0;
    std::uint64_t most_cells = 20'000'000;
    SizeArguments sizes;
    ResizeRequest resize;
    bool lossy = false, recombine = false;
};

/// \param arguments must live until the command line is read
void add_mesh_arguments(CLI::App& command, MeshArguments& arguments);

/// What is asked for, without the files and checks. Failure (usage, F018) where arguments do not go together.
Result<MeshRequest> mesh_request(const MeshArguments& arguments, const Monitor* monitor);

}  // namespace geomend::cli
