// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/monitor.h"
#include "base/parallel.h"
#include "cli/exit_status.h"
#include "pipeline/load.h"

namespace geomend::cli {

enum class ProgressMode : std::uint8_t { automatic, always, never };

/// The options that every command takes.
struct CommonOptions {
    std::string from, to;
    bool json = false, quiet = false, verbose = false, accept_unterminated = false;
    std::size_t threads = 0;
    std::string progress = "auto";
    double tolerance = -1, near = -1;  ///< negative: by rule
    std::vector<std::string> options;  ///< KEY=VALUE
};

/// What commands that read inputs as one model and write one output have in common of their request (ConvertRequest).
/// \param monitor may be null; outlives the request
template <class Arguments, class Files>
void take_files(const Arguments& o, FormatOptions options, const Monitor* monitor, Files& files) {
    files.inputs = o.inputs;
    files.output = o.output;
    files.to = o.to;
    files.lossy = o.lossy;
    files.accept_unterminated = o.accept_unterminated;
    files.load = {o.from, std::move(options), monitor};
}

/// Adds them to a command; `writes` adds --to.
void add_common_options(CLI::App& command, CommonOptions& options, bool writes);

/// A check of options: a finite number of at least 0 and at most 1e20.
CLI::Validator is_length();

/// The same, above 0.
CLI::Validator is_positive_length();

/// A number from low to high; one that is no number (nan) is none of them.
CLI::Validator is_number_within(double low, double high);

/// KEY=VALUE texts as pairs; failure (usage) where one has no '='.
Result<FormatOptions> format_options(const std::vector<std::string>& texts);

/// A monitor that shows progress on standard error as asked for, and stops on SIGINT and SIGTERM.
Monitor make_monitor(const CommonOptions& options);
/// Clears the progress line, so that other output starts on a clean one.
void end_progress();
/// Installs the handlers of SIGINT and SIGTERM; a second signal ends the process at once.
void stop_on_signals();

/// Whether text for this descriptor is coloured: on terminals, unless the environment has NO_COLOR.
bool wants_color(int descriptor);

/// Prints a failure (with what else was found) on standard error and gives its exit status.
ExitStatus report(const Failure& failure);
/// Prints findings on standard error: warnings and errors, with `verbose` also information.
void report(const std::vector<Finding>& findings, bool verbose);
/// Prints on standard error what was lost: substance and identity, with `verbose` also style. What many entities lose alike is one line,
/// but with `verbose`.
void report(const std::vector<Loss>& losses, bool verbose);
/// Writes text to standard output; a failure (full disk, closed pipe) is given by the status.
ExitStatus print(const std::string& text);
/// The same of a command that has written `output`, which is named where its report cannot be printed; empty: nothing was written.
ExitStatus print_beside(const std::string& text, const std::string& output);
/// What a command says of its output, which may itself go to standard output: the text goes to standard error then.
ExitStatus print_about(const std::string& text, const std::string& output, bool is_written);
/// Refuses what would be written over an input or over another output of the same run (F018), or into a folder that is not there (F020).
/// Devices and pipes may be named twice; empty names are none.
/// \param beside what is written, in its order  \param taken inputs, and outputs that are not in `beside`
/// \param purpose what `beside` is for, as "a report"
Result<void> keep_places_apart(const std::vector<std::string>& beside, std::vector<std::string> taken, const std::string& purpose);
/// Refuses --json (F018) where the output goes to standard output.
std::optional<Failure> json_in_the_way(bool json, const std::string& output);

}  // namespace geomend::cli
