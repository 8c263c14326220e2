// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/mesh.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <set>

#include "base/wording.h"
#include "base/worker.h"
#include "cli/check_arguments.h"
#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/mesh_arguments.h"
#include "pipeline/recombine_cells.h"

namespace geomend::cli {

namespace {

/// How good the tetrahedra of a region are. Those that hexahedra are made of are not in the result: flat ones are wanted there.
std::string quality_text(const volumes::FilledRegion& r) {
    return ", least dihedral angle " + rounded(r.least_dihedral) + " degrees" +
           (r.improvement.bad_after > 0 ? ", " + counted(r.improvement.bad_after, "bad cell", "bad cells") : std::string()) +
           (r.narrow.all > 0 ? ", " + std::to_string(r.narrow.all) + " below 5 degrees (" + std::to_string(r.narrow.forced) +
                                   " of them beside surfaces that are close or meet sharply)"
                             : std::string());
}

/// One line for each region: what it holds, or why it is empty.
std::string region_lines(const MeshReport& report, bool all_tries, const std::string& split) {
    std::string text = report.resized ? resize_text(*report.resized) : std::string();
    std::uint64_t cells = 0;
    for (const auto& r : report.regions) {
        text += "  region " + geomend::quoted(r.name) + ": ";
        if (r.filled()) {
            text += counted(r.cells, "tetrahedron", "tetrahedra") + ", volume " + short_number(r.volume) +
                    (report.recombined ? std::string() : quality_text(r)) + " (" + r.rung + ", " + rounded(r.seconds) + " s)\n";
        } else {
            text += "not filled\n";
        }
        cells += r.cells;
        if (r.filled() && !r.as_asked) text += "    shapes and sizes are not as asked for:\n";
        if (!all_tries && r.filled() && r.as_asked) continue;
        for (const std::string& why : r.why_not) text += "    " + why + '\n';
    }
    text += wells_text(report.wells);
    if (!report.outside.empty())
        text += counted(report.outside.size(), "surface lies", "surfaces lie") +
                " outside of all regions, where there are no cells: " + geomend::quoted(report.outside.front()) +
                (report.outside.size() > 1 ? ", ..." : "") + "\n";
    if (report.remeshed) text += changed_volumes(*report.remeshed);
    if (report.surface_vertices > 0)
        text += counted(report.surface_vertices, "vertex was", "vertices were") +
                " added on surfaces and lines, since no cells could be made without; their shape is as it was\n";
    if (report.recombined) text += recombined_text(*report.recombined);
    if (report.split.surfaces > 0)
        text += "split along " + counted(report.split.surfaces, "surface", "surfaces") + ": " +
                counted(report.split.vertices, "point", "points") + " doubled, " + counted(report.split.pairs, "pair", "pairs") +
                " of faces\n";
    else if (!split.empty() && split != "none" && report.is_written)
        text += split == "faults" ? "nothing is split: no surface is a fault\n" : "nothing is split: there are no surfaces\n";
    if (report.recombined) cells = report.recombined->cell_count();
    std::set<std::string> names;
    for (const auto& block : report.blocks) names.insert(block.region);
    // Regions may share a name.
    const auto filled = std::ranges::count_if(report.regions, [](const auto& r) { return r.cells > 0; });
    const auto regions = std::max<std::uint64_t>(names.size(), static_cast<std::uint64_t>(filled));
    if (report.is_written) text += counted(cells, "cell", "cells") + " in " + counted(regions, "region", "regions") + " written\n";
    return text;
}

/// Exit status 5 where a limit is the reason why a region was not filled.
ExitStatus status_of(const MeshReport& report) {
    if (report.is_written) return ExitStatus::done;
    const bool limit = std::ranges::any_of(report.regions, [](const auto& r) { return !r.filled() && r.hit_limit; });
    return limit ? ExitStatus::limit : ExitStatus::invalid_result;
}

/// Why nothing was written, to standard error.
void say_why_nothing(const MeshReport& made, ExitStatus status) {
    if (made.remeshed && !made.remeshed->why_not.empty())
        std::fprintf(stderr,
                     "geomend: with new triangles the model would not be the same: %s; nothing was written; try another --size or "
                     "--max-distance, or --method keep\n",
                     made.remeshed->why_not.c_str());
    else if (!made.errors.empty()) std::fputs("geomend: the model has errors: nothing was written; geomend repair may mend them\n", stderr);
    else if (status == ExitStatus::limit)
        std::fputs("geomend: not all regions could be filled within --time-limit and --memory-limit: nothing was written\n", stderr);
    else if (!made.is_written) std::fputs("geomend: not all regions could be filled: nothing was written\n", stderr);
}

ExitStatus tell(const MeshArguments& o, const MeshReport& made) {
    ExitStatus status = status_of(made);
    if (o.json) return worse(status, print_about(mesh_json(made), o.output, made.is_written));
    report(made.errors, false);
    if (!o.quiet) {
        report(made.written.losses, o.verbose);
        status = worse(status, print_about(region_lines(made, o.verbose, o.split), o.output, made.is_written));
    }
    say_why_nothing(made, status);
    return status;
}

ExitStatus run(const MeshArguments& o) {
    auto options = format_options(o.options);
    if (!options) return report(options.why());
    if (const auto both = json_in_the_way(o.json, o.output)) return report(*both);
    const ThreadBudget budget(o.threads);
    const Monitor monitor = make_monitor(o);
    auto request = mesh_request(o, &monitor);
    if (!request) return report(request.why());
    auto checks = check_options(o, {}, &monitor);
    if (!checks) return report(checks.why());
    take_files(o, std::move(*options), &monitor, request->files);
    request->checks = std::move(*checks);
    const auto made = mesh(*request);
    if (!made) return report(made.why());
    end_progress();
    return tell(o, *made);
}

}  // namespace

void add_mesh(CLI::App& program, ExitStatus& status) {
    auto* command = program.add_subcommand("mesh", "Fill the regions of a sealed model with tetrahedra, hexahedra or prisms");
    auto o = std::make_shared<MeshArguments>();
    add_mesh_arguments(*command, *o);
    add_common_options(*command, *o, true);
    command->callback([o, command, &status] {
        for (const char* name : {"--ratio", "--max-cells", "--time-limit", "--memory-limit", "--wells"}) {
            if (command->count(name) > 0) o->stated.emplace_back(name);
        }
        status = run(*o);
    });
}

}  // namespace geomend::cli
