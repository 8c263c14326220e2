// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

#include "cli/exit_status.h"

namespace geomend::cli {

/// Each adds one command to the program; `status` gets the result when the command was the one given.
void add_info(CLI::App& program, ExitStatus& status);
void add_convert(CLI::App& program, ExitStatus& status);
void add_formats(CLI::App& program, ExitStatus& status);
void add_validate(CLI::App& program, ExitStatus& status);
void add_repair(CLI::App& program, ExitStatus& status);
void add_grid(CLI::App& program, ExitStatus& status);
void add_mesh(CLI::App& program, ExitStatus& status);
void add_remesh(CLI::App& program, ExitStatus& status);
void add_checks(CLI::App& program, ExitStatus& status);
/// The last one: it tells of all others.
void add_completion(CLI::App& program, ExitStatus& status);

}  // namespace geomend::cli
