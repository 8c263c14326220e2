// SPDX-License-Identifier: AGPL-3.0-or-later
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/common_options.h"
#include "volume/tetrahedra.h"

namespace {

using geomend::cli::ExitStatus;

ExitStatus usage(const std::string& message) {
    std::fprintf(stderr, "geomend: %s\nRun with --help for more information.\n", message.c_str());
    return ExitStatus::usage;
}

ExitStatus run(int argc, char** argv) {
    CLI::App program("Converts, checks, repairs and meshes geological models: Gocad, VTK, Gmsh, corner-point grids, horizon grids",
                     "geomend");
    program.set_version_flag("-V,--version", "geomend " GEOMEND_VERSION);
    program.require_subcommand(1);
    program.footer(
        "Exit status: 0 done, 1 findings, 2 wrong command line, 3 an input cannot be read, 4 the output cannot be written or hold\n"
        "the model, 5 a limit was hit, 6 repaired but still not valid, or not meshed, 70 internal fault,\n"
        "130 stopped by a signal. See geomend(1).");
    ExitStatus status = ExitStatus::done;
    geomend::cli::add_info(program, status);
    geomend::cli::add_convert(program, status);
    geomend::cli::add_validate(program, status);
    geomend::cli::add_repair(program, status);
    geomend::cli::add_mesh(program, status);
    geomend::cli::add_remesh(program, status);
    geomend::cli::add_grid(program, status);
    geomend::cli::add_formats(program, status);
    geomend::cli::add_checks(program, status);
    geomend::cli::add_completion(program, status);
    auto arguments = geomend::cli::with_command_first(program, std::vector<std::string>(argv + (argc > 0 ? 1 : 0), argv + argc));
    if (arguments.empty()) {
        std::fputs(program.help().c_str(), stderr);
        return ExitStatus::usage;
    }
    if (const auto wrong = geomend::cli::wrong_command(program, arguments)) return usage(*wrong);
    try {
        program.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    } catch (const CLI::ExtrasError&) {
        return usage(geomend::cli::wrong_options(program));
    } catch (const CLI::ParseError& e) {
        // Help and version come this way, too, with success.
        return program.exit(e) == 0 ? ExitStatus::done : ExitStatus::usage;
    }
    return status;
}

// Where memory runs out in a destructor (those of VTK and of the JSON library take some), the process ends at once: then with the
// status and the words of any run that is out of memory.
[[noreturn]] void end_at_once() {
    try {
        if (const auto why = std::current_exception()) std::rethrow_exception(why);
    } catch (const std::bad_alloc&) {
        std::fputs("geomend: out of memory\n", stderr);
        ::_exit(static_cast<int>(ExitStatus::limit));
    } catch (const std::exception& e) {
        std::fprintf(stderr, "geomend: internal fault: %s\n", e.what());
    } catch (...) {
        std::fputs("geomend: internal fault\n", stderr);
    }
    std::abort();
}

}  // namespace

int main(int argc, char** argv) {
    std::set_terminate(end_at_once);
    geomend::cli::stop_on_signals();
    try {
        if (argc > 1 && argv[1] == std::string_view(geomend::volumes::worker_word))
            return geomend::volumes::tetrahedra_worker(std::vector<std::string>(argv + 2, argv + argc));
        return static_cast<int>(run(argc, argv));
    } catch (const std::bad_alloc&) {
        std::fputs("geomend: out of memory\n", stderr);
        return static_cast<int>(ExitStatus::limit);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "geomend: internal fault: %s\nPlease report it with the command line and the file.\n", e.what());
        return static_cast<int>(ExitStatus::internal);
    }
}
