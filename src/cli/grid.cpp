// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "base/number_text.h"
#include "base/output.h"
#include "base/wording.h"
#include "cli/commands.h"
#include "cli/common_options.h"
#include "drawing/grid_page.h"
#include "drawing/grid_pictures.h"
#include "pipeline/make_grid.h"

namespace geomend::cli {

namespace {

struct GridCommand : CommonOptions {
    std::vector<std::string> inputs;
    std::string output, cells, size, layers, area, pillars_of, map, section, page;
    std::vector<std::string> horizons, fault_polygons, erosion, onlap, leave_out, properties_of, properties;
    std::vector<double> box;
    double rotation = 0, least_dip = 30, min_thickness = 0;
    bool rotated = false, allow_repeated = false, pinch = false, lossy = false;
    std::string fault_sides = "one", pillars = "follow-faults";
};

Failure wrong(const char* option, const std::string& expected, const std::string& found) {
    return failure(FailureKind::usage, "F018", {}, std::string(option) + ": expected " + expected + ", found " + geomend::quoted(found));
}

Result<std::array<std::uint32_t, 2>> cells_in(const std::string& text) {
    const std::size_t cross = text.find('x');
    std::uint64_t n = 0, m = 0;
    if (cross == std::string::npos || parse_integer(std::string_view(text).substr(0, cross), n) != NumberStatus::ok ||
        parse_integer(std::string_view(text).substr(cross + 1), m) != NumberStatus::ok || n == 0 || m == 0 || n > 1000000 || m > 1000000)
        return wrong("--cells", "two numbers NIxNJ of 1 to 1000000", text);
    return std::array{static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(m)};
}

Result<std::array<double, 2>> size_in(const std::string& text) {
    const std::size_t comma = text.find(',');
    std::array<double, 2> size{};
    if (parse_real(std::string_view(text).substr(0, comma), size[0]) != NumberStatus::ok ||
        (comma != std::string::npos && parse_real(std::string_view(text).substr(comma + 1), size[1]) != NumberStatus::ok))
        return wrong("--size", "one or two lengths DX,DY", text);
    if (comma == std::string::npos) size[1] = size[0];
    if (!(size[0] > 0 && size[1] > 0 && size[0] < 1e20 && size[1] < 1e20)) return wrong("--size", "lengths above 0", text);
    return size;
}

Result<GridRequest> request_of(const GridCommand& o) {
    auto options = format_options(o.options);
    if (!options) return std::move(options).why();
    GridRequest request;
    take_files(o, std::move(*options), nullptr, request.files);
    request.structure.horizons = o.horizons;
    request.structure.fault_polygons = o.fault_polygons;
    request.structure.erodes = o.erosion;
    request.structure.lapped = o.onlap;
    request.structure.leave_out = o.leave_out;
    request.structure.least_dip = o.least_dip;
    request.layers = o.layers;
    request.area = o.area;
    request.pillars_of = o.pillars_of;
    request.properties = {o.properties_of, o.properties};
    if (o.rotated) request.rotation = o.rotation;
    request.options.min_thickness = o.min_thickness;
    request.options.allow_repeated = o.allow_repeated;
    request.options.pinch = o.pinch;
    request.options.follow_faults = o.pillars == "follow-faults";
    request.options.fault_sides_both = o.fault_sides == "both";
    if (!o.box.empty()) {
        if (!(o.box[0] < o.box[1] && o.box[2] < o.box[3]))
            return failure(FailureKind::usage, "F018", {}, "--area-box: expected x0,x1,y0,y1 with x0 < x1 and y0 < y1");
        request.box = {o.box[0], o.box[1], o.box[2], o.box[3]};
    }
    if (!o.cells.empty()) {
        auto cells = cells_in(o.cells);
        if (!cells) return std::move(cells).why();
        request.cells = *cells;
    }
    if (!o.size.empty()) {
        auto size = size_in(o.size);
        if (!size) return std::move(size).why();
        request.size = *size;
    }
    return request;
}

std::string fault_line(const gridding::FaultReport& r) {
    std::string text = "  fault " + geomend::quoted(r.name) + ": ";
    if (!r.why_not.empty()) return text + "left out: " + r.why_not + "\n";
    text += counted(r.faces, "face", "faces") + ", " + rounded(r.mean_deviation_cells) + " cells from its trace on average, " +
            rounded(r.max_deviation_cells) + " at most, throw up to " + rounded(r.max_throw);
    for (const std::string& other : r.ends_on) text += ", ends on " + geomend::quoted(other);
    if (r.max_lean > 0) text += ", pillars lean by up to " + rounded(r.max_lean);
    if (!r.why_upright.empty()) text += ", pillars are upright: " + r.why_upright;
    if (r.shared > 0) text += ", " + counted(r.shared, "face", "faces") + " shared with others";
    return text + "\n";
}

/// "0.2 % above", "3 % below", "equal to": less than a millionth part is none.
std::string differs(double share) {
    if (std::abs(share) < 1e-6) return "equal to";
    return rounded(100 * std::abs(share)) + (share > 0 ? " % above" : " % below");
}

std::string summary(const GridMade& made) {
    std::string text = std::to_string(made.dims[0]) + " x " + std::to_string(made.dims[1]) + " x " + std::to_string(made.dims[2]) +
                       " cells, " + std::to_string(made.made.active) + " active, " +
                       counted(made.made.blocks, "fault block", "fault blocks") + ", I turned by " + short_number(made.rotation) +
                       " degrees\n";
    for (std::size_t z = 0; z < made.made.zones.size(); ++z) {
        const auto& r = made.made.zones[z];
        text +=
            "  zone " + std::to_string(z + 1) + " " + geomend::quoted(r.name) + ": " +
            (r.last_layer == r.first_layer ? "layer " + std::to_string(r.first_layer + 1)
                                           : "layers " + std::to_string(r.first_layer + 1) + " to " + std::to_string(r.last_layer + 1)) +
            ", volume " + short_number(r.volume);
        if (z < made.map_volumes.size() && made.map_volumes[z].maps > 0)
            text +=
                " (where the maps have values " + differs(made.map_volumes[z].grid / made.map_volumes[z].maps - 1) + " that between them)";
        if (r.without_thickness > 0) text += ", " + counted(r.without_thickness, "cell", "cells") + " without thickness";
        text += "\n";
    }
    for (const auto& r : made.made.horizons) {
        text += "  horizon " + geomend::quoted(r.name) + ": read at " + std::to_string(r.read) + " nodes, continued to " +
                std::to_string(r.extended) + ", no value at " + std::to_string(r.filled) + "; at most " + rounded(r.max_difference) +
                " off at unfaulted pillars\n";
    }
    for (const auto& r : made.made.faults) text += fault_line(r);
    if (made.made.mean_angles_after < 1) {
        text += "  columns in plan: right-angled to " + rounded(made.made.mean_angles_after) + " on average, " +
                rounded(made.made.least_angles_after) + " at least; before " + rounded(made.made.mean_angles_before) + " and " +
                rounded(made.made.least_angles_before) +
                (made.made.border_relaxed ? "; the border was relaxed towards upright columns\n" : "\n");
    }
    for (const auto& p : made.properties) {
        text +=
            "  property " + geomend::quoted(p.name) + ": " + to_string(p.how) + ", in " + counted(p.with, "active cell", "active cells");
        if (p.without > 0) text += ", no value in " + std::to_string(p.without);
        text += "\n";
    }
    for (const auto& l : made.left_out) text += "  " + geomend::quoted(l.name) + " left out: " + l.why + "\n";
    if (made.made.joined_cells > 0) text += "  " + counted(made.made.joined_cells, "thin cell", "thin cells") + " joined with neighbours\n";
    for (std::size_t r = 0; r < made.regions.size(); ++r)
        text += "  region " + std::to_string(r + 1) + ": " + geomend::quoted(made.regions[r]) + "\n";
    if (made.nnc) text += "  " + counted(*made.nnc, "non-neighbour connection", "non-neighbour connections") + "\n";
    if (!made.beside.empty()) text += "  faults and regions are in " + made.beside + "\n";
    if (!made.deck.empty()) text += "  deck: " + made.deck + "\n";
    for (const std::string& note : made.notes) text += "  note: " + note + "\n";
    return text;
}

Result<void> write_whole(const std::string& path, const std::string& text) {
    if (path.empty()) return {};
    OutputSet output{path};
    output.main_file() << text;
    return output.commit();
}

/// The pictures and the page that are asked for.
Result<void> write_pictures(const GridCommand& o, GridMade& made) {
    if (!made.grid || !made.structure) return {};
    const GridDrawing drawing{std::move(*made.grid), std::move(*made.structure), made.made.zones};
    const GridRow row = telling_row(drawing.grid);
    const bool all = !o.page.empty();
    GridPage page{"Grid " + o.output, summary(made), {}, {}};
    if (all || !o.map.empty()) page.map = grid_map(drawing, row);
    if (all || !o.section.empty()) page.section = grid_section(drawing, row);
    if (auto done = write_whole(o.map, page.map); !done) return done;
    if (auto done = write_whole(o.section, page.section); !done) return done;
    return all ? write_whole(o.page, grid_page(page)) : Result<void>();
}

/// What is written beside the grid, under names made of its own: the deck, values and includes.
std::vector<std::string> companions_of(const GridCommand& o) {
    if (o.output == "-") return {};
    std::vector<std::string> names;
    const std::filesystem::path path(o.output);
    const auto with = [&](const std::string& ending) { return (path.parent_path() / (path.stem().string() + ending)).string(); };
    if (std::ranges::any_of(o.options, [](const std::string& option) { return option == "deck=yes"; })) names.push_back(with(".DATA"));
    names.push_back(with(".properties.grdecl"));
    names.push_back(with(".include.grdecl"));
    return names;
}

/// No file that is read or written is written over.
Result<void> check_places(const GridCommand& o) {
    std::vector<std::string> read = o.inputs;
    read.insert(read.end(), o.properties_of.begin(), o.properties_of.end());
    read.push_back(o.area);
    read.push_back(o.pillars_of);
    std::vector<std::string> taken = companions_of(o);
    if (auto beside = keep_places_apart(taken, read, "what is written beside the grid"); !beside) return beside;
    taken.insert(taken.end(), read.begin(), read.end());
    return keep_places_apart({o.output, o.map, o.section, o.page}, std::move(taken), "the grid, a picture or a page");
}

ExitStatus run(const GridCommand& o) {
    if (auto places = check_places(o); !places) return report(places.why());
    if (const auto both = json_in_the_way(o.json, o.output)) return report(*both);
    auto request = request_of(o);
    if (!request) return report(request.why());
    const ThreadBudget budget(o.threads);
    const Monitor monitor = make_monitor(o);
    request->files.load.monitor = &monitor;
    request->options.monitor = &monitor;
    request->count_connections = o.json || o.verbose;
    request->keep_made = !o.map.empty() || !o.section.empty() || !o.page.empty();
    auto made = make_grid(std::move(*request));
    if (!made) return report(made.why());
    if (auto drawn = write_pictures(o, *made); !drawn) return report(drawn.why());
    end_progress();
    if (o.json) return print_about(grid_json(*made), o.output, true);
    if (o.quiet) return ExitStatus::done;
    report(made->written.findings, o.verbose);
    report(made->written.losses, o.verbose);
    const std::string text = summary(*made);
    return print_about(text, o.output, true);
}

}  // namespace

void add_grid(CLI::App& program, ExitStatus& status) {
    auto* command = program.add_subcommand("grid", "Make a corner-point grid of horizons and faults");
    auto o = std::make_shared<GridCommand>();
    command->add_option("IN", o->inputs, "Input files, taken as one model; - is standard input");
    command->add_option("-o,--output", o->output, "Output file; - is standard output")->required()->type_name("OUT");
    auto* cells = command->add_option("--cells", o->cells, "Numbers of columns along I and J")->type_name("NIxNJ");
    command->add_option("--size", o->size, "Lengths of columns along I and J")->type_name("DX,DY")->excludes(cells);
    command->add_option("--layers", o->layers, "Layers of each zone: proportional:N, from-top:T[:N], from-base:T[:N]")
        ->type_name("ZONE=RULE,...");
    auto* rotation = command->add_option("--rotate", o->rotation, "Angle from x to I, to the left (default: of faults, or of the box)")
                         ->type_name("DEGREES")
                         ->check(is_number_within(-360, 360));
    command->add_option("--horizons", o->horizons, "Files or names of horizons, from top to base (default: all)")
        ->delimiter(',')
        ->type_name("A,B,...");
    command->add_option("--fault-polygons", o->fault_polygons, "Files or names of fault polygons, one per horizon; - for none")
        ->delimiter(',')
        ->type_name("A,B,...");
    command->add_option("--erosion", o->erosion, "Horizons that cut off what lies below")->delimiter(',')->type_name("A,B,...");
    command->add_option("--onlap", o->onlap, "Horizons that cut off what lies above")->delimiter(',')->type_name("A,B,...");
    command->add_option("--leave-out", o->leave_out, "Horizons and faults that are not taken")->delimiter(',')->type_name("A,B,...");
    command->add_option("--area-box", o->box, "What the grid covers (default: the horizons)")
        ->delimiter(',')
        ->expected(4)
        ->type_name("X0,X1,Y0,Y1");
    command->add_option("--area", o->area, "File or name of a ring: columns outside are inactive")->type_name("NAME");
    command->add_option("--pillars-of", o->pillars_of, "File with a corner-point grid whose pillars are taken")
        ->type_name("GRID")
        ->excludes(cells);
    command->add_option("--properties-of", o->properties_of, "Files whose properties the cells get")->delimiter(',')->type_name("A,B,...");
    command
        ->add_option("--properties", o->properties,
                     "Which, and how: nearest, mean, majority or harmonic (default: all, codes by majority, other values by mean)")
        ->delimiter(',')
        ->type_name("NAME=METHOD,...");
    command->add_option("--pillars", o->pillars, "Whether pillars on faults lean as these do (default follow-faults)")
        ->type_name("vertical|follow-faults")
        ->check(CLI::IsMember({"vertical", "follow-faults"}));
    command->add_option("--min-thickness", o->min_thickness, "Thinner cells are joined with a neighbour of their zone (default 0)")
        ->type_name("L")
        ->check(is_length());
    command->add_option("--least-dip", o->least_dip, "Faults that are flatter are refused (default 30)")
        ->type_name("DEGREES")
        ->check(is_number_within(0, 90));
    command->add_option("--fault-sides", o->fault_sides, "Whether FAULTS names faces from one cell or both (default one)")
        ->type_name("one|both")
        ->check(CLI::IsMember({"one", "both"}));
    command->add_option("--map", o->map, "A picture of the grid from above, over the faults of the model (PNG)")->type_name("FILE");
    command->add_option("--section", o->section, "A picture of the row that crosses most faults, over the model (PNG)")->type_name("FILE");
    command->add_option("--report", o->page, "A page with the report and both pictures (HTML)")->type_name("FILE");
    command->add_flag("--pinch", o->pinch, "Let simulators join cells past others without thickness (PINCH)");
    command->add_flag("--allow-repeated", o->allow_repeated, "Take one depth where a pillar meets a horizon more than once");
    command->add_flag("--lossy", o->lossy, "Write even where the target cannot hold all of the grid");
    add_common_options(*command, *o, true);
    command->callback([o, rotation, &status] {
        o->rotated = rotation->count() > 0;
        status = run(*o);
    });
}

}  // namespace geomend::cli
