// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/make_grid.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>

#include "base/output.h"
#include "base/place_words.h"
#include "base/wording.h"
#include "formats/option_row.h"
#include "formats/options.h"
#include "formats/registry.h"
#include "grid/connections.h"
#include "grid/map_axes.h"
#include "gridding/brep_regions.h"
#include "gridding/map_volumes.h"
#include "pipeline/command_options.h"
#include "pipeline/flow_deck.h"
#include "topology/brep_from_dataset.h"

namespace geomend {

namespace {

using gridding::FoundStructure;
using gridding::Net;
using gridding::Path;
using gridding::Point;

/// What is written beside the grid.
struct Beside {
    CornerPointGrid grid;  ///< without geometry: what the format has no place for
    std::string deck;
};

/// A name given on the command line is that of a file, whose object has the name of the file without its extension, or of an object.
void take_file(std::string& name, std::vector<std::string>& inputs) {
    std::error_code ignored;
    if (name.empty() || name == "-" || !std::filesystem::is_regular_file(name, ignored)) return;
    if (std::ranges::find(inputs, name) == inputs.end()) inputs.push_back(name);
    name = std::filesystem::path(name).stem().string();
}

/// The number of the object whose lines have a name.
Result<std::size_t> lines_called(const Dataset& dataset, const std::string& name, const char* option) {
    for (std::size_t o = 0; o < dataset.objects.size(); ++o) {
        const auto* set = std::get_if<PolylineSet>(&dataset.objects[o]);
        if (set != nullptr && set->info.name == name) return o;
    }
    return failure(FailureKind::usage, "F018", {}, std::string(option) + ": no lines are called " + geomend::quoted(name));
}

Result<Net> net_like(const GridRequest& request) {
    LoadOptions options = request.files.load;
    options.from.clear();
    options.one_of_many = true;
    auto dataset = load(request.pillars_of, options);
    if (!dataset) return std::move(dataset).why();
    for (Object& object : dataset->objects) {
        auto* grid = std::get_if<CornerPointGrid>(&object);
        if (grid == nullptr || grid->host || grid->cylindrical) continue;
        if (auto moved = grid::apply_map_axes(*grid); !moved) return std::move(moved).why();
        Net net;
        net.cells = {grid->dims[0], grid->dims[1]};
        net.lines.assign(grid->pillars.begin(), grid->pillars.begin() + static_cast<std::ptrdiff_t>(6 * pillar_count(grid->dims)));
        return net;
    }
    return failure(FailureKind::usage, "F018", {request.pillars_of}, "--pillars-of: the file holds no corner-point grid");
}

std::vector<Point> wanted_outline(const GridRequest& request, const FoundStructure& found, const Path& area) {
    if (request.box) {
        const auto& b = *request.box;
        return {{b[0], b[2]}, {b[1], b[2]}, {b[1], b[3]}, {b[0], b[3]}};
    }
    return area.empty() ? found.outline : area;
}

double rotation_of(const GridRequest& request, const FoundStructure& found, const std::vector<Point>& outline) {
    if (request.rotation) return *request.rotation;
    const auto box = gridding::smallest_box(outline);
    if (request.box || (found.is_boxed && box.share > 0.98)) return request.box ? 0 : box.rotation;
    std::vector<Path> traces;
    for (const auto& fault : found.structure.faults) traces.push_back(fault.trace);
    return traces.empty() ? box.rotation : gridding::dominant_strike(traces);
}

Result<gridding::Frame> frame_of(const GridRequest& request, const FoundStructure& found, const Path& area) {
    const auto outline = wanted_outline(request, found, area);
    gridding::Frame frame;
    frame.rotation = rotation_of(request, found, outline);
    const auto box = gridding::box_around(outline, frame.rotation);
    frame.origin = box.origin;
    for (std::size_t a = 0; a < 2; ++a) {
        if (!(box.size[a] > 0)) return failure(FailureKind::cannot_hold, "F027", {}, "the area of the grid has no extent");
        if (request.cells) {
            frame.cells[a] = (*request.cells)[a];
            frame.size[a] = box.size[a] / frame.cells[a];
        } else {
            frame.size[a] = (*request.size)[a];
            const double count = std::ceil(box.size[a] / frame.size[a] - 1e-9);
            if (count > 1e6) return failure(FailureKind::usage, "F018", {}, "--size: more than a million cells along one axis");
            frame.cells[a] = static_cast<std::uint32_t>(std::max(1.0, count));
        }
    }
    if (request.size) {  // the box lies in the middle
        const double angle = frame.rotation * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
        const double u = (box.size[0] - frame.cells[0] * frame.size[0]) / 2, v = (box.size[1] - frame.cells[1] * frame.size[1]) / 2;
        frame.origin = {box.origin[0] + u * c - v * s, box.origin[1] + u * s + v * c};
    }
    return frame;
}

/// The rule of each zone: in order, or by name; one for all.
Result<std::vector<gridding::ZoneLayers>> zones_of(const GridRequest& request, const FoundStructure& found) {
    const std::size_t count = found.structure.horizons.size() - 1;
    std::vector<gridding::ZoneLayers> zones;
    if (!request.layers.empty()) {
        auto parsed = gridding::parse_layers(request.layers);
        if (!parsed) return std::move(parsed).why();
        zones = std::move(*parsed);
    }
    if (zones.empty()) zones.emplace_back();
    if (zones.size() == 1 && zones[0].zone.empty()) zones.resize(count, zones[0]);
    if (zones.size() != count)
        return failure(FailureKind::usage, "F018", {},
                       "--layers: " + counted(zones.size(), "rule", "rules") + " for " + counted(count, "zone", "zones") + " between " +
                           counted(count + 1, "horizon", "horizons"));
    return zones;
}

CoordinateSystem system_of(const Dataset& dataset, const FoundStructure& found) {
    CoordinateSystem crs;
    for (const Object& object : dataset.objects) {
        const ObjectInfo& info = info_of(object);
        if (std::ranges::any_of(found.structure.horizons, [&](const auto& h) { return h.name == info.name; })) {
            crs = info.crs;
            break;
        }
    }
    crs.z_positive = ZPositive::depth;
    crs.z_positive_stated = true;
    return crs;
}

/// The deck beside the grid, as text; FIPNUM goes from the grid into it.
std::string deck_of(CornerPointGrid& grid, const gridding::GridReport& report, const std::string& output, std::vector<std::string>& notes) {
    std::vector<FipLayers> layers;
    for (std::uint32_t z = 0; z < report.zones.size(); ++z)
        layers.push_back({z + 1, report.zones[z].first_layer, report.zones[z].last_layer});
    for (std::string& note : fit_for_deck(grid)) notes.push_back(std::move(note));
    const std::filesystem::path path(output);
    return flow_deck(grid, path.stem().string(), path.filename().string(), layers);
}

Result<void> write_deck(const std::string& text, const GridRequest& request, GridMade& made) {
    if (text.empty()) return {};
    std::filesystem::path path(request.files.output);
    path.replace_extension(".DATA");
    OutputSet output(path);
    output.main_file() << text;
    made.deck = path.string();
    return output.commit(request.files.load.monitor);
}

/// Takes off a grid what the target has no place for, as a grid of its own without geometry: an include holds it beside.
CornerPointGrid taken_off(CornerPointGrid& grid, const Format& target) {
    CornerPointGrid beside;
    beside.info.name = grid.info.name;
    beside.info.crs = grid.info.crs;
    beside.dims = grid.dims;
    if (target.keeps.fault_faces == Keeping::no) {
        beside.faults = std::exchange(grid.faults, {});
        beside.pinch = std::exchange(grid.pinch, {});
    }
    if (target.keeps.attributes == Keeping::no) beside.info.attributes = std::exchange(grid.info.attributes, {});
    return beside;
}

/// Writes an include of what was taken off, where there is anything.
Result<void> write_beside(CornerPointGrid grid, const GridRequest& request, GridMade& made) {
    if (request.files.output == "-" || (grid.faults.empty() && grid.info.attributes.empty() && !grid.pinch)) return {};
    std::filesystem::path path(request.files.output);
    path.replace_filename(path.stem().string() + ".include.grdecl");
    Dataset dataset;
    dataset.format = "grid";
    dataset.objects.emplace_back(std::move(grid));
    OutputSet output(path);
    auto written = format_by_name("grdecl")->write(dataset, output, {{}, request.files.load.monitor});
    if (!written) return std::move(written).why();
    for (Loss& loss : *written) add_loss(made.written.losses, std::move(loss));
    made.beside = path.string();
    return output.commit(request.files.load.monitor);
}

/// Why a grid has no active cell: nobody could use it.
Failure without_active_cells(const gridding::GridReport& made, const GridRequest& request, const CornerPointGrid& grid) {
    std::string why = "no cell is active: ";
    const auto has_no_value = [](const gridding::HorizonReport& h) { return h.read + h.extended == 0; };
    const auto without = std::ranges::find_if(made.horizons, has_no_value);
    if (without != made.horizons.end()) {
        std::array<double, 4> box{grid.pillars[0], grid.pillars[0], grid.pillars[1], grid.pillars[1]};
        for (std::size_t p = 0; p < grid.pillars.size(); p += 6) {
            box = {std::min(box[0], grid.pillars[p]), std::max(box[1], grid.pillars[p]), std::min(box[2], grid.pillars[p + 1]),
                   std::max(box[3], grid.pillars[p + 1])};
        }
        why += "horizon " + geomend::quoted(without->name) + " has no value where the grid lies, from x " + coordinate(box[0]) + " to " +
               coordinate(box[1]) + ", y " + coordinate(box[2]) + " to " + coordinate(box[3]);
    } else if (std::ranges::any_of(made.zones, [](const auto& zone) { return zone.without_thickness == 0; })) {
        why +=
            request.area.empty() ? "no column has a value of all horizons" : "no column lies in the area " + geomend::quoted(request.area);
    } else {
        why += "the horizons lie on each other, or one has no value, in every column";
    }
    Failure failed = failure(FailureKind::cannot_hold, "F027", {}, std::move(why));
    failed.error.measures.emplace_back("no_active_cells", 1);
    return failed;
}

/// The lines of --area, as the structure and the options want them.
Result<void> take_area(const Dataset& dataset, GridRequest& request) {
    if (request.area.empty()) return {};
    const auto lines = lines_called(dataset, request.area, "--area");
    if (!lines) return lines.why();
    request.structure.area = *lines;
    for (const Vec3& p : std::get<PolylineSet>(dataset.objects[*lines]).points) request.options.area.push_back({p[0], p[1]});
    return {};
}

/// Pillars like those of another grid, or upright ones in a frame.
Result<Net> pillars_for(GridRequest& request, const FoundStructure& found, GridMade& report) {
    if (!request.pillars_of.empty()) {
        request.options.follow_faults = false;  // the pillars are as they are wanted
        return net_like(request);
    }
    auto frame = frame_of(request, found, request.options.area);
    if (!frame) return std::move(frame).why();
    report.rotation = frame->rotation;
    const double level = gridding::mid_level(found.structure);
    return gridding::net_of(*frame, level, level + 1);
}

/// What the cells of the grid get besides their corners: regions of the model, properties, a coordinate system.
Result<void> give_values(const Dataset& dataset, const FoundStructure& found, const GridRequest& request, CornerPointGrid& grid,
                         GridMade& report) {
    if (dataset.breps.size() == 1 && !dataset.breps[0]->regions.empty()) {
        grid.info.attributes.push_back(gridding::brep_regions(grid, *dataset.breps[0]));
        for (const auto& region : dataset.breps[0]->regions) report.regions.push_back(region.name);
    }
    grid.info.crs = system_of(dataset, found);
    auto sampled = add_properties(request.properties, request.files.load, grid);
    if (!sampled) return std::move(sampled).why();
    report.properties = std::move(sampled->report);
    report.notes.insert(report.notes.end(), sampled->notes.begin(), sampled->notes.end());
    return {};
}

/// The deck beside the grid, where one is asked for, and the number of connections as its reader counts them.
Result<void> add_deck(const Format& target, const GridRequest& request, CornerPointGrid& grid, GridMade& report, Beside& beside) {
    if (request.count_connections) report.nnc = grid::connections(grid).others.size();
    if (option_value(request.files.load.options, "deck") != "yes") return {};
    if (target.name != std::string_view("grdecl") || request.files.output == "-")
        return failure(FailureKind::usage, "F018", {}, "--option deck=yes: the grid must go into a GRDECL file");
    beside.deck = deck_of(grid, report.made, request.files.output, report.notes);
    if (!request.count_connections) return {};
    const auto in_deck = connections_in_deck(grid);
    if (!in_deck) return in_deck.why();
    report.nnc = *in_deck;
    return {};
}

Result<void> replace_by_grid(Dataset& dataset, const Format& target, GridRequest& request, GridMade& report, Beside& beside) {
    const bool has_cells = std::ranges::any_of(dataset.objects, [](const Object& o) { return std::holds_alternative<CellMesh>(o); });
    if (has_cells || !dataset.models.empty()) topology::build_breps(dataset);
    if (auto taken = take_area(dataset, request); !taken) return taken.why();
    auto found = gridding::structure_of(dataset, request.structure);
    if (!found) return std::move(found).why();
    auto zones = zones_of(request, *found);
    if (!zones) return std::move(zones).why();
    request.options.zones = std::move(*zones);
    const auto net = pillars_for(request, *found, report);
    if (!net) return net.why();
    auto made = gridding::build_grid(found->structure, *net, request.options);
    if (!made) return std::move(made).why();
    if (made->report.active == 0) return without_active_cells(made->report, request, made->grid);
    report.map_volumes = gridding::map_volumes(found->structure, made->grid, made->report.zones);
    report.made = std::move(made->report);
    report.dims = made->grid.dims;
    report.left_out = std::move(found->left_out);
    report.notes = std::move(found->notes);
    if (auto given = give_values(dataset, *found, request, made->grid, report); !given) return given.why();
    if (auto done = add_deck(target, request, made->grid, report, beside); !done) return done.why();
    if (request.keep_made) {
        report.grid = made->grid;
        report.structure = std::move(found->structure);
    }
    if (request.files.output != "-") beside.grid = taken_off(made->grid, target);
    Dataset only;
    only.format = "grid";
    only.losses = std::move(dataset.losses);
    only.findings = std::move(dataset.findings);
    only.objects.emplace_back(std::move(made->grid));
    dataset = std::move(only);
    return {};
}

}  // namespace

Result<GridMade> make_grid(GridRequest request) {
    for (std::string& name : request.structure.horizons) take_file(name, request.files.inputs);
    for (std::string& name : request.structure.fault_polygons) take_file(name, request.files.inputs);
    take_file(request.area, request.files.inputs);
    if (!request.cells && !request.size && request.pillars_of.empty())
        return failure(FailureKind::usage, "F018", {}, "say how fine the grid is: --cells NIxNJ or --size DX,DY");
    request.files.load.command = grid_option_rows();
    GridMade made;
    Beside beside;
    auto written = convert(request.files,
                           [&](Dataset& dataset, const Format& target) { return replace_by_grid(dataset, target, request, made, beside); });
    if (!written) return std::move(written).why();
    made.written = std::move(*written);
    if (auto done = write_beside(std::move(beside.grid), request, made); !done) return std::move(done).why();
    if (auto done = write_deck(beside.deck, request, made); !done) return std::move(done).why();
    return made;
}

}  // namespace geomend
