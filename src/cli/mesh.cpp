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
#include "cli/size_arguments.h"
#include "hexes/heuristics.h"
#include "pipeline/recombine_cells.h"

namespace geomend::cli {

namespace {

struct MeshOptions : CommonOptions {
    std::vector<std::string> inputs;
    std::string output, split = "none", wells = "all", method, cells, select = "search";
    std::vector<std::string> stated;  ///< options for filling that were given
    double size = 0, ratio = 1.4, seconds = 120, megabytes = 0, max_distance = 0;
    std::uint64_t most_cells = 20'000'000;
    SizeArguments sizes;
    ResizeRequest resize;
    bool lossy = false, recombine = false;
};

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

std::string heuristics_but_search() {
    std::string all;
    for (const std::string_view name : hexes::heuristic_names) {
        if (name != "search") all += (all.empty() ? "" : ", ") + std::string(name);
    }
    return all;
}

ExitStatus run(const MeshOptions& o) {
    auto options = format_options(o.options);
    if (!options) return report(options.why());
    if (const auto both = json_in_the_way(o.json, o.output)) return report(*both);
    const std::string cells = !o.cells.empty() ? o.cells : o.recombine ? "hex-dominant" : "tet";
    const bool hexes = cells != "tet";
    if (o.recombine && !hexes)
        return report(failure(FailureKind::usage, "F018", {},
                              "--recombine makes hexahedra or, with --cells hybrid, prisms: --cells tet does not go with it"));
    if (o.recombine && !o.stated.empty())
        return report(failure(FailureKind::usage, "F018", {},
                              "--recombine takes the tetrahedra as they are: " + o.stated.front() + " is for filling regions"));
    if (o.select != "search" && cells != "hex-dominant")
        return report(failure(FailureKind::usage, "F018", {}, "--select is for hexahedra: --cells hex-dominant or --recombine"));
    constexpr double least_ratio = 0.6124;  // of a regular tetrahedron, the least there is
    if (o.ratio > 0 && o.ratio < least_ratio)
        return report(
            failure(FailureKind::usage, "F018", {},
                    "--ratio " + geomend::rounded(o.ratio) + ": no cell has less than 0.6124, that of a regular tetrahedron; 0 is any"));
    const bool resizes = !o.resize.file.empty();
    const std::string method = !o.method.empty() ? o.method : hexes && !o.recombine ? "lattice" : resizes ? "isotropic" : "keep";
    if (resizes && hexes)
        return report(failure(FailureKind::usage, "F018", {}, "--resize-by is for tetrahedra: --cells and --recombine do not go with it"));
    if (resizes && method == "lattice")
        return report(
            failure(FailureKind::usage, "F018", {}, "--method lattice has cells of one size: --resize-by needs isotropic, cvt or keep"));
    if ((method == "isotropic" || method == "frontal" || method == "cvt") && !(o.size > 0) && !resizes)
        return report(failure(FailureKind::usage, "F018", {}, "--method " + method + " needs --size, the length that edges should have"));
    if (hexes && !(o.sizes.size_of.empty() && o.sizes.size_by.empty()))
        return report(
            failure(FailureKind::usage, "F018", {}, "--size-of and --size-by are for tetrahedra: hexahedra have those of a lattice"));
    if (method == "keep" && o.max_distance > 0)
        return report(failure(FailureKind::usage, "F018", {}, "--max-distance is for new triangles: surfaces are kept as they are"));
    if (o.recombine && (method != "keep" || o.size > 0))
        return report(
            failure(FailureKind::usage, "F018", {}, "--recombine takes the tetrahedra as they are: --size and --method do not go with it"));
    if (!o.sizes.size_by.empty() && !(o.size > 0) && !resizes)
        return report(failure(FailureKind::usage, "F018", {}, "--size-by needs --size, the length that edges should have elsewhere"));
    remeshing::RemeshOptions sizes;
    if (auto taken = take_sizes(o.sizes, sizes); !taken) return report(taken.why());
    const bool by_curvature = std::ranges::any_of(
        sizes.size_by, [](const remeshing::SizeRule& rule) { return rule.kind != remeshing::SizeRule::Kind::distance; });
    if (by_curvature && method != "isotropic" && method != "frontal" && method != "cvt")
        return report(failure(FailureKind::usage, "F018", {},
                              "--size-by curvature and property give sizes to surfaces: they need --method isotropic or cvt"));
    const ThreadBudget budget(o.threads);
    const Monitor monitor = make_monitor(o);
    auto checks = check_options(o, {}, &monitor);
    if (!checks) return report(checks.why());
    MeshRequest request;
    take_files(o, std::move(*options), &monitor, request.files);
    request.checks = std::move(*checks);
    request.split = o.split;
    request.wells = o.wells;
    request.fill.size = o.size;
    request.fill.ratio = o.ratio;
    request.fill.limits.seconds = o.seconds;
    request.fill.limits.memory_bytes = o.megabytes > 0 && o.megabytes < 1e12 ? static_cast<std::uint64_t>(o.megabytes * 1e6) : 0;
    request.fill.monitor = &monitor;
    request.on_lattice = method == "lattice" || (hexes && !o.recombine);
    request.remesh_on_lattice = method == "lattice";
    request.size_of = std::move(sizes.size_of);
    request.size_by = std::move(sizes.size_by);
    if (resizes) request.resize = o.resize;
    if (method != "keep") {
        request.remesh.emplace();
        request.remesh->method = surface_method(method).value_or(remeshing::Method::isotropic);
        if (method == "cvt") request.remesh->growth = remeshing::centroidal_growth;
        request.remesh->size = o.size;
        request.remesh->max_distance = o.max_distance;
        request.remesh->monitor = &monitor;
    }
    request.most_cells = o.most_cells;
    request.fills = !o.recombine;
    if (hexes) {
        request.recombine.emplace();
        request.recombine->thin_only = cells == "hybrid";
        request.recombine->select = hexes::heuristic_named(o.select).value_or(hexes::Heuristic::search);
        request.recombine->monitor = &monitor;
    }
    const auto made = mesh(request);
    if (!made) return report(made.why());
    end_progress();
    ExitStatus status = status_of(*made);
    if (o.json) return worse(status, print_about(mesh_json(*made), o.output, made->is_written));
    report(made->errors, false);
    if (!o.quiet) {
        report(made->written.losses, o.verbose);
        const std::string text = region_lines(*made, o.verbose, o.split);
        status = worse(status, print_about(text, o.output, made->is_written));
    }
    if (made->remeshed && !made->remeshed->why_not.empty())
        std::fprintf(stderr,
                     "geomend: with new triangles the model would not be the same: %s; nothing was written; try another --size or "
                     "--max-distance, or --method keep\n",
                     made->remeshed->why_not.c_str());
    else if (!made->errors.empty())
        std::fputs("geomend: the model has errors: nothing was written; geomend repair may mend them\n", stderr);
    else if (status == ExitStatus::limit)
        std::fputs("geomend: not all regions could be filled within --time-limit and --memory-limit: nothing was written\n", stderr);
    else if (!made->is_written) std::fputs("geomend: not all regions could be filled: nothing was written\n", stderr);
    return status;
}

}  // namespace

void add_mesh(CLI::App& program, ExitStatus& status) {
    auto* command = program.add_subcommand("mesh", "Fill the regions of a sealed model with tetrahedra, hexahedra or prisms");
    auto o = std::make_shared<MeshOptions>();
    command->add_option("IN", o->inputs, "Input files, taken as one model; - is standard input")->required();
    command->add_option("-o,--output", o->output, "Output file; - is standard output")->required()->type_name("OUT");
    command
        ->add_option("--size", o->size,
                     "Edges of cells inside of regions, as far as surfaces allow (default: the median edge of the triangles around each)")
        ->type_name("L")
        ->check(is_positive_length());
    command
        ->add_option("--method", o->method,
                     "What becomes of surfaces: keep (default) leaves them as they are; isotropic, frontal and cvt give them new triangles "
                     "of --size first; "
                     "lattice (default for hex-dominant) makes halves of squares of them that agree with cells inside")
        ->type_name("METHOD")
        ->check(CLI::IsMember({"keep", "isotropic", "frontal", "cvt", "lattice"}));
    command
        ->add_option(
            "--max-distance", o->max_distance,
            "Largest distance between new and old surfaces with --method isotropic, frontal, cvt or lattice (default: a tenth of the size, "
            "1/200 of the model at most)")
        ->type_name("L")
        ->check(is_positive_length());
    add_size_options(*command, o->sizes);
    command
        ->add_option("--resize-by", o->resize.file,
                     "Sizes by the error of a calculation: a file of tetrahedra with their stress; new triangles for surfaces, too")
        ->type_name("FILE");
    command->add_option("--error", o->resize.allowed, "With --resize-by: the error that is allowed, as a share (default 0.05)")
        ->type_name("SHARE")
        ->check(is_number_within(1e-6, 1));
    command->add_option("--poisson", o->resize.poisson, "With --resize-by: Poisson's ratio (default 0.25)")
        ->type_name("RATIO")
        ->check(is_number_within(0, 0.4999));
    command->add_option("--ratio", o->ratio, "Most radius of the sphere around a cell by its shortest edge; 0 is any (default 1.4)")
        ->type_name("R")
        ->check(is_length());
    command
        ->add_option("--cells", o->cells,
                     "Cells that are wanted: tet (default); hex-dominant: hexahedra where tetrahedra make some, and prisms and pyramids; "
                     "hybrid: prisms and pyramids in parts that are thin for their size")
        ->type_name("CELLS")
        ->check(CLI::IsMember({"tet", "hex-dominant", "hybrid"}));
    command->add_flag("--recombine", o->recombine, "Fill nothing: make hexahedra of the tetrahedra of the inputs");
    command
        ->add_option("--select", o->select,
                     "How hexahedra are selected: search (default), or by a heuristic for comparison: " + heuristics_but_search())
        ->type_name("RULE")
        ->check(CLI::IsMember(std::vector<std::string>(hexes::heuristic_names.begin(), hexes::heuristic_names.end())));
    command->add_option("--split", o->split, "Double the points along surfaces: none (default), faults, all, or names between commas")
        ->type_name("WHICH");
    command
        ->add_option("--wells", o->wells,
                     "Wells that become chains of edges of cells: all (default), none, or names of wells and lines between commas")
        ->type_name("WHICH");
    command->add_option("--max-cells", o->most_cells, "Most cells that sizes may make, by an estimate (default 20000000)")
        ->type_name("N")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{4'000'000'000}));
    command->add_option("--time-limit", o->seconds, "Most time for one try to fill a region; 0 is no limit (default 120)")
        ->type_name("SECONDS")
        ->check(is_length());
    command->add_option("--memory-limit", o->megabytes, "Most memory for it; 0 is no limit (default)")->type_name("MB")->check(is_length());
    command->add_flag("--lossy", o->lossy, "Write even where the target cannot hold all of the model");
    add_common_options(*command, *o, true);
    command->callback([o, command, &status] {
        for (const char* name : {"--ratio", "--max-cells", "--time-limit", "--memory-limit", "--wells"}) {
            if (command->count(name) > 0) o->stated.emplace_back(name);
        }
        status = run(*o);
    });
}

}  // namespace geomend::cli
