// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/remesh.h"

#include <cstdio>
#include <memory>

#include "base/wording.h"
#include "cli/check_arguments.h"
#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/size_arguments.h"

namespace geomend::cli {

namespace {

struct RemeshArguments : CommonOptions {
    std::vector<std::string> inputs;
    std::string output;
    SizeArguments sizes;
    double size = 0, growth = -1, max_distance = 0;
    std::uint64_t most_triangles = 20'000'000, sites = 0;
    std::string method = "isotropic";
    bool lossy = false, keep_invalid = false;
};

std::string quality_words(const remeshing::TriangleQuality& q) {
    return counted(q.triangles, "triangle", "triangles") + " (least angle " + rounded(q.least_angle) + " degrees, " +
           rounded(100 * q.share_above_30()) + " % above 30" +
           (q.between_lines > 0 ? ", " + std::to_string(q.between_lines) + " below it between lines" : std::string()) + ", mean quality " +
           rounded(q.mean_quality()) + ")";
}

std::string model_lines(const RemeshReport::Model& model, bool all_surfaces) {
    std::string text;
    remeshing::TriangleQuality before, after;
    double to_old = 0, from_old = 0;
    for (const auto& s : model.made.surfaces) {
        before.add(s.before);
        after.add(s.after);
        to_old = std::max(to_old, s.to_old);
        from_old = std::max(from_old, s.from_old);
        const std::string name = geomend::quoted(s.name.empty() ? s.interface : s.name);
        if (s.kept) text += "  surface " + name + " stays as it was: " + s.why + "\n";
        else if (all_surfaces)
            text += "  surface " + name + ": " + quality_words(s.before) + " became " + quality_words(s.after) + ", at most " +
                    rounded(std::max(s.to_old, s.from_old)) + " away\n";
    }
    text += quality_words(before) + "\n  became " + quality_words(after) + ", " + counted(model.vertices.all, "vertex", "vertices") + "\n";
    text += counted(model.made.line_edges_before, "edge", "edges") + " of lines became " + std::to_string(model.made.line_edges_after) +
            "; the new surfaces are at most " + rounded(to_old) + " away from the old ones, and the old ones " + rounded(from_old) +
            " from the new\n";
    return text;
}

ExitStatus run(const RemeshArguments& o) {
    auto options = format_options(o.options);
    if (!options) return report(options.why());
    RemeshRequest request;
    if (auto taken = take_sizes(o.sizes, request.remesh); !taken) return report(taken.why());
    if (const auto both = json_in_the_way(o.json, o.output)) return report(*both);
    request.remesh.method = *surface_method(o.method);
    if (request.remesh.method == remeshing::Method::keep && (o.size > 0 || o.sites > 0))
        return report(
            failure(FailureKind::usage, "F018", {}, "--method keep leaves surfaces as they are: --size and --sites do not go with it"));
    if (request.remesh.method != remeshing::Method::keep && !(o.size > 0) && o.sites == 0)
        return report(failure(FailureKind::usage, "F018", {},
                              "expected --size, the length that edges should have, or --sites, the number of vertices"));
    const ThreadBudget budget(o.threads);
    const Monitor monitor = make_monitor(o);
    auto checks = check_options(o, {}, &monitor);
    if (!checks) return report(checks.why());
    take_files(o, std::move(*options), &monitor, request.files);
    request.checks = std::move(*checks);
    request.keep_invalid = o.keep_invalid;
    request.remesh.size = o.size;
    request.remesh.sites = o.sites;
    if (o.growth >= 0) request.remesh.growth = o.growth;
    else if (o.method == "cvt") request.remesh.growth = remeshing::centroidal_growth;
    request.remesh.max_distance = o.max_distance;
    request.remesh.most_triangles = o.most_triangles;
    request.remesh.monitor = &monitor;
    const auto made = remesh(request);
    if (!made) return report(made.why());
    end_progress();
    ExitStatus status = made->why_not.empty() ? ExitStatus::done : ExitStatus::invalid_result;
    if (const std::string missed = sites_missed(*made); !missed.empty() && !o.quiet) std::fprintf(stderr, "geomend: %s\n", missed.c_str());
    if (o.json) return worse(status, print_about(remesh_json(*made), o.output, made->is_written));
    if (!made->why_not.empty()) report(made->errors, false);
    if (!o.quiet) {
        report(made->written.losses, o.verbose);
        std::string text;
        for (const auto& model : made->models) text += model_lines(model, o.verbose);
        text += sites_found(*made) + changed_volumes(*made);
        status = worse(status, print_about(text, o.output, made->is_written));
    }
    if (!made->why_not.empty())
        std::fprintf(stderr, "geomend: %s%s\n", made->why_not.c_str(), made->is_written ? "" : ": nothing was written");
    return status;
}

}  // namespace

void add_remesh(CLI::App& program, ExitStatus& status) {
    auto* command = program.add_subcommand("remesh", "Give surfaces and lines new vertices and triangles of a wanted size");
    auto o = std::make_shared<RemeshArguments>();
    command->add_option("IN", o->inputs, "Input files, taken as one model; - is standard input")->required();
    command->add_option("-o,--output", o->output, "Output file; - is standard output")->required()->type_name("OUT");
    auto* size =
        command->add_option("--size", o->size, "Length that edges of triangles should have")->type_name("L")->check(is_positive_length());
    command->add_option("--sites", o->sites, "Number of vertices inside of surfaces, those of lines apart, in place of --size")
        ->type_name("N")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}))
        ->excludes(size);
    command
        ->add_option("--method", o->method,
                     "How: isotropic (default): edges are split, collapsed and turned; cvt: vertices become the centroids of their Voronoi "
                     "cells, with better shapes in a longer time; frontal: equilateral triangles from lines inwards; keep: not at all")
        ->type_name("METHOD")
        ->check(CLI::IsMember({"keep", "isotropic", "frontal", "cvt"}));
    add_size_options(*command, o->sizes);
    command->add_option("--growth", o->growth, "Sizes grow by no more than this share of the way (default 0.3, with cvt 0.1)")
        ->type_name("SHARE")
        ->check(is_length());
    command
        ->add_option("--max-distance", o->max_distance,
                     "Largest distance between new and old surfaces (default: a tenth of the size, 1/200 of the model at most)")
        ->type_name("L")
        ->check(is_positive_length());
    command->add_option("--max-triangles", o->most_triangles, "Most triangles that a size may make (default 20000000)")
        ->type_name("N")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{4'000'000'000}));
    command->add_flag("--keep-invalid", o->keep_invalid, "Write also a result that has errors which the input had not");
    command->add_flag("--lossy", o->lossy, "Write even where the target cannot hold all of the model");
    add_common_options(*command, *o, true);
    command->callback([o, &status] { status = run(*o); });
}

}  // namespace geomend::cli
