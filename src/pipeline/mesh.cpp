// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <type_traits>

#include "base/nearest_word.h"
#include "base/wording.h"
#include "exchange/model_from_brep.h"
#include "geometry/site_grid.h"
#include "hexes/lattice.h"
#include "hexes/sampling.h"
#include "pipeline/cell_number.h"
#include "pipeline/command_options.h"
#include "pipeline/inner_sizes.h"
#include "pipeline/json_parts.h"
#include "pipeline/recombine_cells.h"
#include "pipeline/record_places.h"
#include "pipeline/validate.h"
#include "remesh/rule_sizes.h"
#include "topology/brep_from_dataset.h"
#include "topology/lengths.h"

namespace geomend {

namespace {

/// \param measure by which advice fits the reason; empty: none
Failure cannot_fill(const std::string& file, const std::string& why, const char* measure = "") {
    Failure f = failure(FailureKind::cannot_hold, "F026", {file}, why);
    if (*measure != 0) f.error.measures.emplace_back(measure, 1);
    return f;
}

/// Why a file without regions has none, and the measure of that.
Failure no_region(const std::string& file, const Dataset& dataset) {
    const auto any = [&]<class Shape>(std::type_identity<Shape>) {
        return std::ranges::any_of(dataset.objects, [](const Object& o) { return std::holds_alternative<Shape>(o); });
    };
    if (any(std::type_identity<Surface>{}) || any(std::type_identity<CellMesh>{}))
        return cannot_fill(file, "no surfaces enclose a region: there is nothing to fill");
    if (any(std::type_identity<CornerPointGrid>{}) || any(std::type_identity<StructuredGrid>{}))
        return cannot_fill(file, "a grid has its cells: mesh fills the regions between surfaces", "grid");
    return cannot_fill(file, "there are no surfaces: mesh fills the regions between surfaces", "no_surfaces");
}

/// Errors of the model, which is not filled where there are any.
Result<std::vector<Finding>> errors_of(const Dataset& dataset, const MeshRequest& request) {
    auto judged = validate(request.files.inputs.front(), dataset, request.checks);
    if (!judged) return std::move(judged).why();
    std::erase_if(judged->findings, [](const Finding& f) { return f.severity != Severity::error; });
    if (request.files.inputs.size() == 1) give_lines(request.files.inputs.front(), dataset, judged->names, judged->findings);
    return std::move(judged->findings);
}

/// The one model of a Dataset that has regions.
Result<topology::JudgedModel> model_to_fill(const Dataset& dataset, const MeshRequest& request) {
    const std::string& file = request.files.inputs.front();
    const auto lengths = validators::lengths_of(dataset, request.checks);
    auto models = topology::models_to_judge(dataset, topology::model_sources(dataset, lengths));
    if (!models) return std::move(models).why();
    std::erase_if(*models, [](const topology::JudgedModel& m) { return m.found.regions.empty(); });
    if (models->empty()) return no_region(file, dataset);
    if (models->size() > 1)
        return cannot_fill(file, std::to_string(models->size()) + " models with regions, where one is expected", "several_models");
    return std::move(models->front());
}

/// The filled model, and beside it what was not a part of it. \param wells objects that are edges of the model
Result<void> put_in_place(Dataset& dataset, volumes::Filled filled, std::span<const std::uint32_t> wells) {
    std::vector<std::uint8_t> is_part(dataset.objects.size(), 0);
    for (const auto& surface : filled.brep.surfaces) {
        if (surface.source_object < is_part.size()) is_part[surface.source_object] = 1;
    }
    for (const auto& region : filled.brep.regions) {
        if (region.source_object < is_part.size()) is_part[region.source_object] = 1;
    }
    for (const std::uint32_t o : wells) {
        is_part[o] = 1;
        list_well_losses(dataset.objects[o], dataset.losses);
    }
    auto brep = Brep::make(std::move(filled.brep));
    if (!brep) return std::move(brep).why();
    Dataset made = exchange::tagged_model(*brep, dataset.losses);
    if (!wells.empty()) add_wells(std::get<CellMesh>(made.objects.front()), filled.wells);
    for (std::size_t o = 0; o < dataset.objects.size(); ++o) {
        if (is_part[o] == 0) made.objects.push_back(std::move(dataset.objects[o]));
    }
    dataset.objects = std::move(made.objects);
    dataset.models = std::move(made.models);
    dataset.breps.clear();
    dataset.findings.clear();
    return {};
}

void list_face_sets(const BrepData& brep, MeshReport& report) {
    for (const auto& surface : brep.surfaces) {
        if (!surface.regions[0].valid() && !surface.regions[1].valid()) report.outside.push_back(surface.name);
        for (std::size_t side = 0; side < 2; ++side) {
            if (!surface.regions[side].valid()) continue;
            report.face_sets.push_back({surface.name, surface.role, side == 0 ? "back" : "front", surface.polygons.size()});
        }
    }
}

/// New triangles for the surfaces that bound regions. \param lattices on which their vertices lie, or none
Result<void> remesh_before(Dataset& dataset, const Format& target, const MeshRequest& request, const hexes::RegionLattices* lattices,
                           MeshReport& report) {
    RemeshRequest first;
    first.files = request.files;
    first.checks = request.checks;
    first.remesh = *request.remesh;
    std::optional<remeshing::Pattern> pattern;
    if (lattices != nullptr && request.remesh_on_lattice) {
        pattern = hexes::lattice_pattern(*lattices);
        first.remesh.pattern = &*pattern;
        if (!(first.remesh.size > 0)) first.remesh.size = lattices->common.least_step();
    }
    return remesh(dataset, target, first, report.remeshed.emplace());
}

void list_blocks(MeshReport& report) {
    std::uint64_t first = 0;
    for (const auto& region : report.regions) {
        report.blocks.push_back({region.name, CellType::tetrahedron, first, region.cells});
        first += region.cells;
    }
}

/// Hexahedra of the tetrahedra, and what the report says of blocks and sets of faces.
Result<void> recombine(Dataset& dataset, const MeshRequest& request, MeshReport& report) {
    auto made = recombine_cells(dataset, *request.recombine, report.recombined.emplace(), dataset.losses);
    if (!made) return std::move(made).why();
    report.blocks.clear();
    for (const auto& b : (*made)->blocks) report.blocks.push_back({(*made)->regions[b.region], b.type, b.first, b.count});
    for (const auto& s : report.recombined->shares) {
        const std::string& name = (*made)->regions[s.region];
        if (report.mixed_regions.empty() || report.mixed_regions.back().name != name) report.mixed_regions.push_back({name, 0, {}});
        report.mixed_regions.back().volume += s.volume;
        report.mixed_regions.back().cells.emplace_back(s.type, s.count);
    }
    report.face_sets.clear();
    for (const auto& set : (*made)->face_sets)
        report.face_sets.push_back({set.name, set.role, set.side == FaceSide::none ? "" : to_string(set.side), set.faces.size()});
    return {};
}

/// What coordinates cannot tell apart, for models whose points are to be the same only where they are equal.
double least_tolerance(const BrepData& brep) {
    double far = 0;
    for (const Vec3& p : brep.vertices) {
        for (const double x : p) far = std::max(far, std::abs(x));
    }
    return 1e-12 * (far > 0 ? far : 1);
}

/// Sizes by names go to regions, or to the new triangles of surfaces; all names are there.
Result<void> part_sizes(const Dataset& dataset, MeshRequest& request) {
    if (request.size_of.empty() && request.size_by.empty()) return {};
    auto model = model_to_fill(dataset, request);
    if (!model) return std::move(model).why();
    std::vector<std::string_view> regions, surfaces;
    for (const auto& region : model->brep->regions) regions.push_back(region.name);
    for (const auto& surface : model->brep->surfaces) surfaces.push_back(surface.name);
    for (const auto& interface : model->brep->interfaces) surfaces.push_back(interface.name);
    for (const auto& [name, size] : request.size_of) {
        const bool is_region = std::ranges::find(regions, name) != regions.end();
        const bool is_surface = std::ranges::find(surfaces, name) != surfaces.end();
        if (is_region) request.fill.size_of.emplace_back(name, size);
        if (is_surface && request.remesh) request.remesh->size_of.emplace_back(name, size);
        if (is_region || (is_surface && request.remesh)) continue;
        if (is_surface)
            return failure(FailureKind::usage, "F018", {}, "--size-of " + name + ": surfaces get new sizes with --method isotropic or cvt");
        regions.insert(regions.end(), surfaces.begin(), surfaces.end());
        return failure(FailureKind::usage, "F018", {},
                       "--size-of: no region, surface or interface is called '" + name + "'" + nearest_hint(name, regions));
    }
    for (const remeshing::SizeRule& rule : request.size_by) {
        if (rule.kind != remeshing::SizeRule::Kind::distance || std::ranges::find(surfaces, rule.name) != surfaces.end()) continue;
        return failure(FailureKind::usage, "F018", {},
                       "--size-by: no surface or interface is called '" + rule.name + "'" + nearest_hint(rule.name, surfaces));
    }
    return {};
}

/// Whether the sizes that are asked for make no more cells than are allowed, which is known before anything is made.
Result<void> check_sizes(const BrepData& brep, const MeshRequest& request, const MeshReport& report) {
    const double by_stress = report.resized ? report.resized->wanted_cells : 0;
    return check_cell_number(brep, {request.resize ? 0 : request.fill.size, request.fill.size_of, request.size_by, by_stress},
                             request.most_cells);
}

/// The nearest of points with sizes: a rule for surfaces.
remeshing::SizeRule nearest_size(const std::vector<volumes::SizedPoint>& sizes) {
    struct Field {
        std::vector<Vec3> places;
        std::vector<double> sizes;
        std::optional<SiteGrid> grid;
    };
    auto field = std::make_shared<Field>();
    for (const auto& s : sizes) {
        field->places.push_back(s.place);
        field->sizes.push_back(s.size);
    }
    field->grid.emplace(field->places);
    remeshing::SizeRule rule;
    rule.kind = remeshing::SizeRule::Kind::field;
    rule.field = [field](const Vec3& at) { return field->sizes[field->grid->nearest(at)]; };
    return rule;
}

/// Takes sizes by the error of a calculation, which new triangles get, too.
Result<std::vector<volumes::SizedPoint>> take_resize(const Dataset& dataset, MeshRequest& request, MeshReport& report) {
    if (!request.resize) return std::vector<volumes::SizedPoint>();
    std::vector<Vec3> points;
    for (const Object& object : dataset.objects) {
        if (const auto* surface = std::get_if<Surface>(&object))
            points.insert(points.end(), surface->points.begin(), surface->points.end());
    }
    auto resized = sizes_by_stress(*request.resize, request.files.load, points);
    if (!resized) return std::move(resized).why();
    report.resized = resized->report;
    if (!(request.fill.size > 0)) request.fill.size = resized->report.largest_size;
    for (auto& s : resized->sizes) s.size = std::min(s.size, request.fill.size);
    if (request.remesh) {
        request.remesh->size = request.fill.size;
        request.remesh->size_by.push_back(nearest_size(resized->sizes));
    }
    return std::move(resized->sizes);
}

/// Sizes inside of regions by rules for places, and by points. \pre the request has a size where it has either \param rules of the model
/// that is filled; they outlive what is returned
std::function<std::vector<volumes::SizedPoint>(const volumes::RegionFacets&)> inner_sizes(const remeshing::RuleSizes& rules,
                                                                                          const MeshRequest& request,
                                                                                          std::span<const volumes::SizedPoint> points) {
    if (points.empty() && !rules.has_places()) return {};
    return [&rules, &request, points](const volumes::RegionFacets& facets) {
        const auto at = [&](const Vec3& place) { return std::min(request.fill.size, rules.at(place)); };
        double step = request.fill.size;
        for (const auto& rule : request.size_by) {
            if (rule.kind == remeshing::SizeRule::Kind::distance) step = std::min(step, rule.size);
        }
        std::vector<volumes::SizedPoint> sizes;
        if (points.empty()) return lattice_of_sizes(facets, step, at);
        sizes = sizes_around(facets, points);
        for (auto& s : sizes) s.size = std::min(s.size, at(s.place));
        return sizes;
    };
}

Result<void> fill(Dataset& dataset, const Format& target, const MeshRequest& asked, MeshReport& report) {
    MeshRequest request = asked;
    auto errors = errors_of(dataset, request);
    if (!errors) return std::move(errors).why();
    report.errors = std::move(*errors);
    if (!report.errors.empty()) return cannot_fill(request.files.inputs.front(), "the model has errors");
    if (auto parted = part_sizes(dataset, request); !parted) return parted;
    if (auto known = chosen_wells(dataset, request.wells); !known) return std::move(known).why();
    if (request.remesh) request.remesh->size_by = request.size_by;
    const auto points = take_resize(dataset, request, report);
    if (!points) return points.why();
    std::optional<hexes::RegionLattices> lattices;
    if (request.on_lattice) {
        auto model = model_to_fill(dataset, request);
        if (!model) return std::move(model).why();
        const hexes::Lattice lattice = hexes::lattice_of(*model->brep, request.fill.size);
        if (auto fits = check_lattice(*model->brep, lattice.steps, request.most_cells); !fits) return fits;
        auto facets = volumes::facets_of_regions(*model);
        if (!facets) return std::move(facets).why();
        lattices = hexes::region_lattices(*model->brep, *facets, lattice);
    }
    if (request.remesh && !request.on_lattice) {
        auto model = model_to_fill(dataset, request);
        if (!model) return std::move(model).why();
        if (auto fits = check_sizes(*model->brep, request, report); !fits) return fits;
    }
    if (request.remesh) {
        auto remeshed = remesh_before(dataset, target, request, lattices ? &*lattices : nullptr, report);
        if (!remeshed && report.remeshed && !report.remeshed->why_not.empty()) report.errors = report.remeshed->errors;
        if (!remeshed) return remeshed;
    }
    auto model = model_to_fill(dataset, request);
    if (!model) return std::move(model).why();
    if (!request.remesh && !request.on_lattice) {
        if (auto fits = check_sizes(*model->brep, request, report); !fits) return fits;
    }
    volumes::FillOptions how = request.fill;
    if (lattices) {
        how.points = [&](const volumes::RegionFacets& facets) { return hexes::points_inside(facets, lattices->at(facets.region)); };
        how.straightened = [&](const volumes::RegionFacets& facets, std::span<const Vec3> places) {
            return hexes::along_layers(lattices->at(facets.region), places);
        };
        how.improve = request.recombine && request.recombine->thin_only;  // else it would move points off their lattice
    }
    const remeshing::RuleSizes rules(*model->brep, request.size_by, request.fill.size);
    how.sizes = inner_sizes(rules, request, *points);
    auto wells = chosen_wells(dataset, request.wells);  // once more: with new triangles there are other objects
    if (!wells) return std::move(wells).why();
    how.wells = paths_of(dataset, *wells, dataset.losses);
    how.well_tolerance = model->tolerance > 0 ? model->tolerance : least_tolerance(*model->brep);
    if (!has_edges(target)) wells->clear();
    auto filled = volumes::fill_dividing_surfaces(*model->brep, model->found, how);
    if (!filled) return std::move(filled).why();
    report.regions = std::move(filled->regions);
    report.surface_vertices = filled->surface_vertices;
    report.wells = mesh_wells(filled->wells);
    for (Loss& loss : filled->losses) add_loss(dataset.losses, std::move(loss));
    list_face_sets(filled->brep, report);
    if (!std::ranges::all_of(report.regions, &volumes::FilledRegion::filled))
        return cannot_fill(request.files.inputs.front(), "not all regions could be filled");
    list_blocks(report);
    return put_in_place(dataset, std::move(*filled), *wells);
}

Result<void> make_cells(Dataset& dataset, const Format& target, const MeshRequest& request, MeshReport& report) {
    if (request.fills) {
        if (auto filled = fill(dataset, target, request, report); !filled) return filled;
    }
    if (request.recombine) {
        if (auto recombined = recombine(dataset, request, report); !recombined) return recombined;
    }
    auto split = split_mesh(dataset, request.split, dataset.losses);
    if (!split) return std::move(split).why();
    report.split = *split;
    return {};
}

Json mixed_region_json(const MeshRegion& region) {
    Json cells = Json::object();
    for (const auto& [type, count] : region.cells) cells[to_string(type)] = count;
    return {{"name", region.name}, {"volume", region.volume}, {"cells", std::move(cells)}};
}

/// What is said of the cells of a filled region is that of the cells that are written.
void put_mixed_regions(const MeshReport& report, Json& regions) {
    for (const MeshRegion& mixed : report.mixed_regions) {
        const Json now = mixed_region_json(mixed);
        const auto found = std::ranges::find_if(regions, [&](const Json& r) { return r["name"] == mixed.name; });
        if (found == regions.end()) regions.push_back(now);
        else found->update(now);
    }
}

}  // namespace

Result<MeshReport> mesh(const MeshRequest& request) {
    MeshReport report;
    bool judged = false;
    auto converted = convert(request.files, [&](Dataset& dataset, const Format& target) {
        auto done = make_cells(dataset, target, request, report);
        const bool worse_anew = !done && report.remeshed && !report.remeshed->why_not.empty();
        judged = !report.errors.empty() || worse_anew ||
                 (!done && std::ranges::any_of(report.regions, [](const auto& r) { return !r.filled(); }));
        return done;
    });
    if (!converted) {
        if (judged) return report;
        return std::move(converted).why();
    }
    report.written = std::move(*converted);
    report.is_written = true;
    return report;
}

std::string mesh_json(const MeshReport& report) {
    Json regions = Json::array(), blocks = Json::array(), sets = Json::array();
    double least = 180;
    volumes::ShapeCounts shapes;
    for (const auto& r : report.regions) {
        Json region{{"name", r.name},
                    {"volume", r.volume},
                    {"surface_volume", r.surface_volume},
                    {"cells", {{"tetrahedron", r.cells}}},
                    {"new_vertices", r.new_vertices},
                    {"rung", r.rung},
                    {"as_asked", r.as_asked},
                    {"seconds", r.seconds},
                    {"min_dihedral", r.least_dihedral},
                    {"below_5_degrees", {{"cells", r.narrow.all}, {"forced_by_surfaces", r.narrow.forced}}},
                    {"bad_cells", {{"before", r.improvement.bad_before}, {"after", r.improvement.bad_after}}},
                    {"flips", r.improvement.flips},
                    {"moves", r.improvement.moves}};
        if (!r.why_not.empty()) region["why_not"] = r.why_not;
        regions.push_back(std::move(region));
        if (r.filled()) least = std::min(least, r.least_dihedral);
        for (std::size_t i = 0; i < shapes.least_dihedral.size(); ++i) shapes.least_dihedral[i] += r.shapes.least_dihedral[i];
        for (std::size_t i = 0; i < shapes.shape.size(); ++i) shapes.shape[i] += r.shapes.shape[i];
    }
    put_mixed_regions(report, regions);
    for (const MeshBlock& b : report.blocks)
        blocks.push_back({{"region", b.region}, {"type", to_string(b.type)}, {"first", b.first}, {"count", b.count}});
    for (const MeshFaceSet& s : report.face_sets)
        sets.push_back({{"name", s.name}, {"role", to_string(s.role)}, {"side", s.side}, {"count", s.count}});
    Json all{
        {"written", report.is_written}, {"regions", std::move(regions)}, {"blocks", std::move(blocks)}, {"face_sets", std::move(sets)}};
    if (report.is_written) {
        all["quality"] = Json::object();
        if (!report.regions.empty())
            all["quality"] = {
                {"min_dihedral", least}, {"min_dihedral_by_5_degrees", shapes.least_dihedral}, {"shape_by_tenths", shapes.shape}};
        if (report.recombined) {
            all["quality"]["min_scaled_jacobian"] = report.recombined->least_jacobian;
            all["quality"]["scaled_jacobian_by_tenths"] = report.recombined->jacobian_by_tenths;
            all["quality"]["shares"] = shares_json(*report.recombined);
        }
        all["loss"] = losses_json(report.written.losses);
    }
    Json wells = Json::array();
    for (const MeshWell& w : report.wells)
        wells.push_back({{"name", w.name},
                         {"length", w.length},
                         {"inside", w.inside},
                         {"repeated", w.repeated},
                         {"edges", w.edges},
                         {"on_surfaces", w.on_surfaces},
                         {"crossings", w.crossings}});
    all["wells"] = std::move(wells);
    all["surfaces_outside_regions"] = report.outside;
    all["surface_vertices_added"] = report.surface_vertices;
    all["split"] = {{"surfaces", report.split.surfaces}, {"vertices", report.split.vertices}, {"pairs", report.split.pairs}};
    if (report.recombined) all["recombine"] = recombined_json(*report.recombined);
    if (report.resized) all["resize"] = resize_json(*report.resized);
    if (report.remeshed) all["remesh"] = remesh_json_value(*report.remeshed);
    Json errors = Json::array();
    for (const Finding& f : report.errors) errors.push_back(finding_json(f));
    all["errors"] = std::move(errors);
    return json_text(all);
}

}  // namespace geomend
