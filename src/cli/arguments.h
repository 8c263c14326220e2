// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace geomend::cli {

/// The arguments with the command first: options of the command may stand before it (geomend --quiet validate FILE).
std::vector<std::string> with_command_first(const CLI::App& program, std::vector<std::string> arguments);

/// What is wrong where the first argument that is no option names no command, with the nearest one; nothing where it does, or where
/// there is none. \param arguments as of with_command_first()
std::optional<std::string> wrong_command(const CLI::App& program, const std::vector<std::string>& arguments);

/// Options that the command at hand has not, with the nearest it has; empty where there are none. \pre the program has parsed
std::string wrong_options(const CLI::App& program);

}  // namespace geomend::cli
