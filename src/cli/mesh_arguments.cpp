// SPDX-License-Identifier: AGPL-3.0-or-later
#include "cli/mesh_arguments.h"

#include <algorithm>
#include <span>
#include <utility>

#include "base/wording.h"
#include "hexes/heuristics.h"

namespace geomend::cli {

namespace {

std::string heuristics_but_search() {
    std::string all;
    for (const std::string_view name : hexes::heuristic_names) {
        if (name != "search") all += (all.empty() ? "" : ", ") + std::string(name);
    }
    return all;
}

/// The cells that are wanted and what becomes of surfaces, in words of --cells and --method: as stated, or as it follows from the rest.
struct Wanted {
    std::string cells, method;
    bool hexes, resizes;
    bool remeshes() const { return method == "isotropic" || method == "frontal" || method == "cvt"; }
};

Wanted wanted_by(const MeshArguments& a) {
    Wanted wanted;
    wanted.cells = !a.cells.empty() ? a.cells : a.recombine ? "hex-dominant" : "tet";
    wanted.hexes = wanted.cells != "tet";
    wanted.resizes = !a.resize.file.empty();
    wanted.method = !a.method.empty() ? a.method : wanted.hexes && !a.recombine ? "lattice" : wanted.resizes ? "isotropic" : "keep";
    return wanted;
}

/// Something that arguments may not be, and what is said then.
struct Rule {
    bool broken;
    std::string says;
};

Result<void> hold(std::span<const Rule> rules) {
    const auto broken = std::ranges::find(rules, true, &Rule::broken);
    if (broken != rules.end()) return failure(FailureKind::usage, "F018", {}, broken->says);
    return {};
}

Result<void> check_cells(const MeshArguments& a, const Wanted& w) {
    constexpr double least_ratio = 0.6124;  // of a regular tetrahedron, the least there is
    const Rule rules[] = {
        {a.recombine && !w.hexes, "--recombine makes hexahedra or, with --cells hybrid, prisms: --cells tet does not go with it"},
        {a.recombine && !a.stated.empty(),
         "--recombine takes the tetrahedra as they are: " + (a.stated.empty() ? "" : a.stated.front()) + " is for filling regions"},
        {a.select != "search" && w.cells != "hex-dominant", "--select is for hexahedra: --cells hex-dominant or --recombine"},
        {a.ratio > 0 && a.ratio < least_ratio,
         "--ratio " + geomend::rounded(a.ratio) + ": no cell has less than 0.6124, that of a regular tetrahedron; 0 is any"},
    };
    return hold(rules);
}

Result<void> check_sizes(const MeshArguments& a, const Wanted& w) {
    const Rule rules[] = {
        {w.resizes && w.hexes, "--resize-by is for tetrahedra: --cells and --recombine do not go with it"},
        {w.resizes && w.method == "lattice", "--method lattice has cells of one size: --resize-by needs isotropic, cvt or keep"},
        {w.remeshes() && !(a.size > 0) && !w.resizes, "--method " + w.method + " needs --size, the length that edges should have"},
        {w.hexes && !(a.sizes.size_of.empty() && a.sizes.size_by.empty()),
         "--size-of and --size-by are for tetrahedra: hexahedra have those of a lattice"},
        {w.method == "keep" && a.max_distance > 0, "--max-distance is for new triangles: surfaces are kept as they are"},
        {a.recombine && (w.method != "keep" || a.size > 0),
         "--recombine takes the tetrahedra as they are: --size and --method do not go with it"},
        {!a.sizes.size_by.empty() && !(a.size > 0) && !w.resizes, "--size-by needs --size, the length that edges should have elsewhere"},
    };
    return hold(rules);
}

Result<void> check_rules_of_sizes(std::span<const remeshing::SizeRule> size_by, const Wanted& w) {
    const bool of_surfaces =
        std::ranges::any_of(size_by, [](const remeshing::SizeRule& rule) { return rule.kind != remeshing::SizeRule::Kind::distance; });
    const Rule rules[] = {{of_surfaces && !w.remeshes(),
                           "--size-by curvature and property give sizes to surfaces: they need --method isotropic, frontal or cvt"}};
    return hold(rules);
}

void ask_for_filling(const MeshArguments& a, const Monitor* monitor, MeshRequest& request) {
    request.fills = !a.recombine;
    request.fill.size = a.size;
    request.fill.ratio = a.ratio;
    request.fill.limits.seconds = a.seconds;
    request.fill.limits.memory_bytes = a.megabytes > 0 && a.megabytes < 1e12 ? static_cast<std::uint64_t>(a.megabytes * 1e6) : 0;
    request.fill.monitor = monitor;
    request.most_cells = a.most_cells;
}

void ask_for_triangles(const MeshArguments& a, const Wanted& w, const Monitor* monitor, MeshRequest& request) {
    request.on_lattice = w.method == "lattice" || (w.hexes && !a.recombine);
    request.remesh_on_lattice = w.method == "lattice";
    if (w.method == "keep") return;
    auto& to = request.remesh.emplace();
    to.method = surface_method(w.method).value_or(remeshing::Method::isotropic);
    if (w.method == "cvt") to.growth = remeshing::centroidal_growth;
    to.size = a.size;
    to.max_distance = a.max_distance;
    to.monitor = monitor;
}

void ask_for_hexahedra(const MeshArguments& a, const Wanted& w, const Monitor* monitor, MeshRequest& request) {
    if (!w.hexes) return;
    auto& to = request.recombine.emplace();
    to.thin_only = w.cells == "hybrid";
    to.select = hexes::heuristic_named(a.select).value_or(hexes::Heuristic::search);
    to.monitor = monitor;
}

void add_sizes(CLI::App& command, MeshArguments& a) {
    command
        .add_option("--size", a.size,
                    "Edges of cells inside of regions, as far as surfaces allow (default: the median edge of the triangles around each)")
        ->type_name("L")
        ->check(is_positive_length());
    command
        .add_option("--method", a.method,
                    "What becomes of surfaces: keep (default) leaves them as they are; isotropic, frontal and cvt give them new triangles "
                    "of --size first; "
                    "lattice (default for hex-dominant and hybrid) makes halves of squares of them that agree with cells inside")
        ->type_name("METHOD")
        ->check(CLI::IsMember({"keep", "isotropic", "frontal", "cvt", "lattice"}));
    command
        .add_option(
            "--max-distance", a.max_distance,
            "Largest distance between new and old surfaces with --method isotropic, frontal, cvt or lattice (default: a tenth of the size, "
            "1/200 of the model at most)")
        ->type_name("L")
        ->check(is_positive_length());
    add_size_options(command, a.sizes);
    command
        .add_option("--resize-by", a.resize.file,
                    "Sizes by the error of a calculation: a file of tetrahedra with their stress; new triangles for surfaces, too")
        ->type_name("FILE");
    command.add_option("--error", a.resize.allowed, "With --resize-by: the error that is allowed, as a share (default 0.05)")
        ->type_name("SHARE")
        ->check(is_number_within(1e-6, 1));
    command.add_option("--poisson", a.resize.poisson, "With --resize-by: Poisson's ratio (default 0.25)")
        ->type_name("RATIO")
        ->check(is_number_within(0, 0.4999));
}

void add_cells(CLI::App& command, MeshArguments& a) {
    command.add_option("--ratio", a.ratio, "Most radius of the sphere around a cell by its shortest edge; 0 is any (default 1.4)")
        ->type_name("R")
        ->check(is_length());
    command
        .add_option("--cells", a.cells,
                    "Cells that are wanted: tet (default); hex-dominant: hexahedra where tetrahedra make some, and prisms and pyramids; "
                    "hybrid: prisms and pyramids in parts that are thin for their size")
        ->type_name("CELLS")
        ->check(CLI::IsMember({"tet", "hex-dominant", "hybrid"}));
    command.add_flag("--recombine", a.recombine, "Fill nothing: make hexahedra of the tetrahedra of the inputs");
    command
        .add_option("--select", a.select,
                    "How hexahedra are selected: search (default), or by a heuristic for comparison: " + heuristics_but_search())
        ->type_name("RULE")
        ->check(CLI::IsMember(std::vector<std::string>(hexes::heuristic_names.begin(), hexes::heuristic_names.end())));
    command.add_option("--split", a.split, "Double the points along surfaces: none (default), faults, all, or names between commas")
        ->type_name("WHICH");
    command
        .add_option("--wells", a.wells,
                    "Wells that become chains of edges of cells: all (default), none, or names between commas, of lines, too")
        ->type_name("WHICH");
    command.add_option("--max-cells", a.most_cells, "Most cells that sizes may make, by an estimate (default 20000000)")
        ->type_name("N")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{4'000'000'000}));
    command.add_option("--time-limit", a.seconds, "Most time for one try to fill a region; 0 is no limit (default 120)")
        ->type_name("SECONDS")
        ->check(is_length());
    command.add_option("--memory-limit", a.megabytes, "Most memory for it; 0 is no limit (default)")->type_name("MB")->check(is_length());
    command.add_flag("--lossy", a.lossy, "Write even where the target cannot hold all of the model");
}

}  // namespace

Result<MeshRequest> mesh_request(const MeshArguments& arguments, const Monitor* monitor) {
    const Wanted wanted = wanted_by(arguments);
    if (auto good = check_cells(arguments, wanted); !good) return good.why();
    if (auto good = check_sizes(arguments, wanted); !good) return good.why();
    remeshing::RemeshOptions sizes;
    if (auto taken = take_sizes(arguments.sizes, sizes); !taken) return taken.why();
    if (auto good = check_rules_of_sizes(sizes.size_by, wanted); !good) return good.why();
    MeshRequest request;
    request.split = arguments.split;
    request.wells = arguments.wells;
    request.size_of = std::move(sizes.size_of);
    request.size_by = std::move(sizes.size_by);
    if (wanted.resizes) request.resize = arguments.resize;
    ask_for_filling(arguments, monitor, request);
    ask_for_triangles(arguments, wanted, monitor, request);
    ask_for_hexahedra(arguments, wanted, monitor, request);
    return request;
}

void add_mesh_arguments(CLI::App& command, MeshArguments& arguments) {
    command.add_option("IN", arguments.inputs, "Input files, taken as one model; - is standard input")->required();
    command.add_option("-o,--output", arguments.output, "Output file; - is standard output")->required()->type_name("OUT");
    add_sizes(command, arguments);
    add_cells(command, arguments);
}

}  // namespace geomend::cli
