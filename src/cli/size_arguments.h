// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "remesh/remesh.h"

namespace geomend::cli {

/// The words of --size-of and --size-by, as remesh and mesh have them.
struct SizeArguments {
    std::vector<std::string> size_of, size_by;
};
void add_size_options(CLI::App& command, SizeArguments& arguments);

/// How surfaces get new triangles by a word of --method; nothing where it is none for all surfaces ("lattice").
std::optional<remeshing::Method> surface_method(const std::string& word);

/// Failure (usage, F018) where a word is not as the manual says.
Result<void> take_sizes(const SizeArguments& arguments, remeshing::RemeshOptions& options);

}  // namespace geomend::cli
