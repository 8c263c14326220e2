// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/info.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <new>
#include <set>

#include "formats/registry.h"
#include "geometry/measures.h"
#include "grid/boundary_model.h"
#include "grid/cell_geometry.h"
#include "grid/connections.h"
#include "pipeline/command_options.h"
#include "pipeline/found_models.h"
#include "pipeline/grids.h"
#include "topology/brep_from_dataset.h"

namespace geomend {

namespace {

void count_object(const PointSet& o, ObjectSummary& s) { s.counts["points"] = o.points.size(); }

void count_object(const PolylineSet& o, ObjectSummary& s) {
    s.counts["points"] = o.points.size();
    s.counts["edges"] = o.edges.size();
    if (o.parts.size() > 1) s.counts["parts"] = o.parts.size();
}

void count_polygon(std::size_t corners, ObjectSummary& s) {
    ++s.counts["polygons"];
    if (corners == 3) ++s.counts["triangles"];
    if (corners == 4) ++s.counts["quads"];
}

void count_object(const Surface& o, ObjectSummary& s) {
    s.counts["points"] = o.points.size();
    s.counts["polygons"] = s.counts["triangles"] = 0;
    if (o.polygons.all_triangles()) s.counts["polygons"] = s.counts["triangles"] = o.polygons.size();
    else
        for (std::size_t i = 0; i < o.polygons.size(); ++i) count_polygon(o.polygons[i].size(), s);
    if (o.parts.size() > 1) s.counts["parts"] = o.parts.size();
    s.area = area(o);
}

void count_object(const CellMesh& o, ObjectSummary& s) {
    s.counts["points"] = o.points.size();
    s.counts["elements"] = o.cell_count();
    s.counts["cells"] = 0;
    bool any_volume = false, any_area = false;
    for (std::size_t i = 0; i < o.cell_count(); ++i) {
        switch (dimension(o.types[i])) {
            case 0:
                ++s.counts["vertices"];
                break;
            case 1:
                ++s.counts["edges"];
                break;
            case 2:
                count_polygon(o.cell_nodes(i).size() == 3 || linear_type(o.types[i]) == CellType::triangle ? 3
                              : linear_type(o.types[i]) == CellType::quad                                  ? 4
                                                                                                           : o.cell_nodes(i).size(),
                              s);
                any_area = true;
                break;
            default:
                ++s.counts["cells"];
                ++s.cell_types[to_string(o.types[i])];
                any_volume = true;
        }
    }
    if (any_area) s.area = area(o);
    if (!any_volume) return;
    s.volume = volume_by_tetrahedra(o);
    const double exact = volume(o);
    if (std::abs(exact - *s.volume) > 1e-12 * std::abs(exact)) s.volume_trilinear = exact;
}

void count_lattice(const std::array<std::uint32_t, 3>& dims, ObjectSummary& s) {
    s.dims = dims;
    s.counts["points"] = sample_count(dims);
    const int directions = int(dims[0] > 1) + int(dims[1] > 1) + int(dims[2] > 1);
    if (directions == 3) s.counts["cells"] = lattice_cell_count(dims);
    if (directions == 2) s.counts["polygons"] = lattice_cell_count(dims);
}

void count_object(const StructuredGrid& o, ObjectSummary& s) {
    count_lattice(o.dims, s);
    if (!s.counts.contains("cells")) return;
    std::uint64_t dead = 0;
    for (const std::uint8_t d : o.dead_cells) dead += d != 0;
    if (dead > 0) s.counts["active_cells"] = s.counts["cells"] - dead;
    s.cell_types["hexahedron"] = s.counts["cells"];
    s.volume = volume(o);
}

void count_object(const Raster& o, ObjectSummary& s) {
    count_lattice(o.dims, s);
    if (s.counts.contains("cells")) s.volume = volume(o);
}

void count_object(const Well& o, ObjectSummary& s) {
    s.counts["points"] = o.path.size();
    s.counts["edges"] = o.path.empty() ? 0 : o.path.size() - 1;
    if (!o.markers.empty()) s.counts["markers"] = o.markers.size();
    if (!o.zones.empty()) s.counts["zones"] = o.zones.size();
    if (!o.curves.empty()) s.counts["curves"] = o.curves.size();
}

void count_object(const CornerPointGrid& o, ObjectSummary& s) {
    s.dims = o.dims;
    s.counts["cells"] = o.cell_count();
    s.counts["active_cells"] = active_count(o);
    if (!o.faults.empty()) s.counts["faults"] = o.faults.size();
    if (!o.connections.empty()) s.counts["stated_connections"] = o.connections.size();
    if (o.pillars.empty()) return;  // properties without geometry
    s.volume = grid::volume(o);
}

// The sign of z in the file itself.
ZPositive frame_of(const Dataset& dataset, const CoordinateSystem& crs) {
    const Format* format = format_by_name(dataset.format);
    return format != nullptr && format->elevations ? ZPositive::elevation : crs.z_positive;
}

void into_frame(std::array<Vec3, 2>& box, ZPositive frame) {
    if (frame == ZPositive::elevation) return;
    const double low = box[0][2], high = box[1][2];
    box[0][2] = 0.0 - high;
    box[1][2] = 0.0 - low;
}

// The file's word for an object's role: its own, else that of the faces that a model makes of it where all have the same.
std::string role_of(const Dataset& dataset, std::size_t object) {
    const ObjectInfo& info = info_of(dataset.objects[object]);
    std::string word = info.role_text;
    if (word.empty() && info.role != FeatureRole::unknown) word = to_string(info.role);
    if (word.empty()) {
        std::set<std::string_view> words;
        for (const StatedModel& model : dataset.models) {
            for (const StatedModel::Face& face : model.faces) {
                if (face.object == object) words.insert(face.role_text);
            }
        }
        if (words.size() == 1) word = *words.begin();
    }
    return word == "none" ? std::string() : word;
}

ObjectSummary summarise_object(const Dataset& dataset, std::size_t index) {
    const Object& object = dataset.objects[index];
    ObjectSummary s;
    const ObjectInfo& info = info_of(object);
    s.name = info.name;
    s.kind = kind_name(object);
    s.role = role_of(dataset, index);
    s.feature = info.feature;
    s.groups = info.groups;
    s.units = info.crs.axis_units;
    s.z_positive = frame_of(dataset, info.crs);
    std::visit([&](const auto& o) { count_object(o, s); }, object);
    if (!axis_units_agree(info.crs)) s.area = s.volume = s.volume_trilinear = std::nullopt;
    s.bounds = bounds(object);
    if (s.bounds) into_frame(*s.bounds, s.z_positive);
    for (const Attribute& a : info.attributes)
        s.attributes.push_back({a.name, to_string(a.location), type_name(a.values), a.unit, a.components});
    for (const NamedSet& set : info.sets) s.sets.push_back({set.name, to_string(set.location), set.members.size()});
    return s;
}

std::vector<BrepSummary::GroupRow> group_rows(std::span<const BrepData::RegionList> lists,
                                              std::span<const BrepSummary::RegionRow> regions) {
    std::vector<BrepSummary::GroupRow> rows;
    for (const BrepData::RegionList& list : lists) {
        BrepSummary::GroupRow& row = rows.emplace_back();
        row.name = list.name;
        row.volume = 0;
        for (const RegionId region : list.regions) {
            if (region.value >= regions.size()) continue;
            row.regions.push_back(region.value);
            const auto& volume = regions[region.value].volume;
            row.volume = row.volume && volume ? std::optional(*row.volume + *volume) : std::nullopt;
        }
        if (row.regions.empty()) row.volume.reset();
    }
    return rows;
}

BrepSummary summarise_brep(const BrepData& b) {
    BrepSummary s;
    s.name = b.name;
    s.corners = b.corners.size();
    s.lines = b.lines.size();
    s.surfaces = b.surfaces.size();
    s.regions = b.regions.size();
    s.vertices = b.vertices.size();
    for (const auto& surface : b.surfaces) {
        s.polygons += surface.polygons.size();
        for (std::size_t p = 0; p < surface.polygons.size(); ++p) s.triangles += surface.polygons[p].size() == 3;
    }
    for (const char* role : {"fault", "horizon", "boundary", "unknown"}) s.features[role] = 0;
    for (const auto& i : b.interfaces) ++s.features[to_string(i.role)];
    s.interfaces = b.interfaces.size();
    s.contacts = b.contacts.size();
    s.layers = b.layers.size();
    s.fault_blocks = b.fault_blocks.size();
    s.internal_lines_of_regions = b.internal_lines_of_regions;
    s.internal_lines_of_surfaces = b.internal_lines_of_surfaces;
    const bool measurable = axis_units_agree(b.crs);
    for (const auto& region : b.regions) {
        BrepSummary::RegionRow row{region.name, std::nullopt, region.cell_types.size()};
        if (measurable && region.volume_known && std::isfinite(region.volume)) row.volume = std::abs(region.volume);
        s.region_volumes.push_back(std::move(row));
    }
    s.layer_rows = group_rows(b.layers, s.region_volumes);
    s.block_rows = group_rows(b.fault_blocks, s.region_volumes);
    const auto& units = b.crs.axis_units;
    if (measurable && !units[0].empty()) s.volume_unit = units[0] + "3";
    if (measurable && !b.universe.empty() && std::isfinite(b.universe_volume)) s.universe_volume = std::abs(b.universe_volume);
    return s;
}

}  // namespace

FileSummary summarise(const std::string& path, const Dataset& dataset) {
    FileSummary summary;
    summary.file = path;
    summary.format = dataset.format;
    summary.variant = dataset.variant;
    for (std::size_t i = 0; i < dataset.objects.size(); ++i) summary.objects.push_back(summarise_object(dataset, i));
    for (const Object& object : dataset.objects) {
        const auto* grid = std::get_if<CornerPointGrid>(&object);
        if (grid == nullptr || grid->pillars.empty()) continue;
        const grid::Connections found = grid::connections(*grid);
        if (!summary.connections) summary.connections = FileSummary::ConnectionCounts{};
        summary.connections->internal += found.internal;
        summary.connections->nnc += found.others.size();
    }
    for (const Brep& brep : dataset.breps) summary.breps.push_back(summarise_brep(*brep));
    const auto take = [&](const CoordinateSystem& crs) {
        if (summary.crs.stated || !crs.stated) return;
        summary.crs = crs;
        summary.crs.z_positive = frame_of(dataset, crs);
    };
    for (const StatedModel& model : dataset.models) take(model.crs);
    for (const Object& object : dataset.objects) take(info_of(object).crs);
    summary.findings = dataset.findings;
    summary.losses = dataset.losses;
    return summary;
}

namespace {

/// Adds what option as=brep asks for; how many there are.
Result<std::size_t> add_found_models(Dataset& dataset, const FormatOptions& options, double tolerance) {
    const std::string_view as = option_value(options, "as");
    if (as.empty() || as == "cells") return std::size_t{0};
    if (as != "brep") return failure(FailureKind::usage, "F018", {}, "--option as=" + std::string(as) + ": expected brep or cells");
    const auto request = model_request(options);
    if (!request) return request.why();
    auto found = models_in_loose_surfaces(dataset, tolerance);
    if (!found) return std::move(found).why();
    for (const Object& object : dataset.objects) {
        const auto* grid = std::get_if<CornerPointGrid>(&object);
        if (grid == nullptr || grid->pillars.empty()) continue;
        auto model = grid::boundary_model(*grid, *request);
        if (!model) return std::move(model).why();
        topology::build_breps(*model);
        std::ranges::move(model->breps, std::back_inserter(found->breps));
    }
    std::ranges::move(found->breps, std::back_inserter(dataset.breps));
    return found->breps.size();
}

}  // namespace

FileSummary summarise(const std::string& path, const LoadOptions& options, const complexity::ComplexityOptions* complexity,
                      double tolerance) {
    FileSummary failed;
    failed.file = path;
    LoadOptions reading = options;
    if (reading.command.empty()) reading.command = info_option_rows();
    auto dataset = load(path, reading);
    if (!dataset) {
        failed.error = std::move(dataset).why();
        return failed;
    }
    try {
        topology::build_breps(*dataset);
        const auto found = add_found_models(*dataset, reading.options, tolerance);
        if (!found) {
            failed.error = found.why();
            return failed;
        }
        FileSummary summary = summarise(path, *dataset);
        for (std::size_t b = summary.breps.size() - *found; b < summary.breps.size(); ++b) summary.breps[b].is_found = true;
        for (std::size_t b = 0; complexity != nullptr && b < dataset->breps.size(); ++b)
            summary.breps[b].complexity = complexity::measure(*dataset->breps[b], *complexity);
        if (complexity != nullptr && complexity->monitor != nullptr && complexity->monitor->stopped())
            summary.error = failure(FailureKind::cancelled, "F022", {path}, "measuring was stopped");
        return summary;
    } catch (const std::bad_alloc&) {
        failed.error = failure(FailureKind::limit, "F023", {path}, "there is not enough memory for this model");
        return failed;
    }
}

}  // namespace geomend
