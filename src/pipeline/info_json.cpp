// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/info.h"
#include "pipeline/json_parts.h"

namespace geomend {

namespace {

Json units_json(const std::array<std::string, 3>& units) { return Json::array({units[0], units[1], units[2]}); }

const char* sign_name(ZPositive z) { return z == ZPositive::depth ? "depth" : "elevation"; }

bool any_stated(const std::array<std::string, 3>& units) { return !units[0].empty() || !units[1].empty() || !units[2].empty(); }

Json object_json(const ObjectSummary& o) {
    Json j{{"name", o.name}, {"kind", o.kind}};
    if (!o.role.empty()) j["role"] = o.role;
    if (!o.feature.empty()) j["feature"] = o.feature;
    if (!o.groups.empty()) j["groups"] = o.groups;
    Json counts = Json::object();
    for (const auto& [what, n] : o.counts) counts[what] = n;
    if (!o.cell_types.empty()) {
        Json types = Json::object();
        for (const auto& [type, n] : o.cell_types) types[type] = n;
        counts["cell_types"] = std::move(types);
    }
    j["counts"] = std::move(counts);
    if (o.dims) j["dims"] = *o.dims;
    if (o.bounds) j["bounds"] = Json::array({(*o.bounds)[0], (*o.bounds)[1]});
    j["z_positive"] = sign_name(o.z_positive);
    if (any_stated(o.units)) j["units"] = units_json(o.units);
    if (o.area) j["area"] = *o.area;
    if (o.volume) j["volume"] = *o.volume;
    if (o.volume_trilinear) j["volume_trilinear"] = *o.volume_trilinear;
    Json attributes = Json::array();
    for (const auto& a : o.attributes) {
        Json one{{"name", a.name}, {"location", a.location}, {"components", a.components}, {"type", a.type}};
        if (!a.unit.empty()) one["unit"] = a.unit;
        attributes.push_back(std::move(one));
    }
    j["attributes"] = std::move(attributes);
    if (!o.sets.empty()) {
        Json sets = Json::array();
        for (const auto& s : o.sets) sets.push_back(Json{{"name", s.name}, {"location", s.location}, {"members", s.members}});
        j["sets"] = std::move(sets);
    }
    return j;
}

Json groups_json(const std::vector<BrepSummary::GroupRow>& groups, const BrepSummary& b) {
    Json all = Json::array();
    for (const auto& group : groups) {
        Json names = Json::array();
        for (const std::uint32_t r : group.regions) names.push_back(b.region_volumes[r].name);
        Json one{{"name", group.name}, {"regions", std::move(names)}};
        if (group.volume) one["volume"] = *group.volume;
        all.push_back(std::move(one));
    }
    return all;
}

Json brep_json(const BrepSummary& b, bool named) {
    Json j = Json::object();
    if (named) j["name"] = b.name;
    j["corners"] = b.corners;
    j["lines"] = b.lines;
    j["surfaces"] = b.surfaces;
    j["regions"] = b.regions;
    j["vertices"] = b.vertices;
    j["triangles"] = b.triangles;
    if (b.polygons != b.triangles) j["polygons"] = b.polygons;
    Json features = Json::object();
    for (const auto& [role, n] : b.features) features[role] = n;
    j["features"] = std::move(features);
    j["interfaces"] = b.interfaces;
    j["contacts"] = b.contacts;
    j["layers"] = b.layers;
    if (b.fault_blocks > 0) j["fault_blocks"] = b.fault_blocks;
    j["internal_lines"] = Json{{"region", b.internal_lines_of_regions}, {"surface", b.internal_lines_of_surfaces}};
    Json volumes = Json::array();
    for (const auto& r : b.region_volumes) {
        Json one{{"name", r.name}};
        if (r.volume) one["volume"] = *r.volume;
        if (r.cells > 0) one["cells"] = r.cells;
        volumes.push_back(std::move(one));
    }
    j["region_volumes"] = std::move(volumes);
    if (!b.layer_rows.empty()) j["layer_list"] = groups_json(b.layer_rows, b);
    if (!b.block_rows.empty()) j["fault_block_list"] = groups_json(b.block_rows, b);
    if (b.is_found) j["found"] = true;
    if (b.universe_volume) j["universe_volume"] = *b.universe_volume;
    if (named && b.complexity) j["complexity"] = complexity_json(*b.complexity);
    return j;
}

void add_groups(const std::vector<BrepSummary::GroupRow>& groups, std::size_t first_region, std::vector<BrepSummary::GroupRow>& to) {
    for (BrepSummary::GroupRow group : groups) {
        for (std::uint32_t& r : group.regions) r += static_cast<std::uint32_t>(first_region);
        to.push_back(std::move(group));
    }
}

BrepSummary sum_of(const std::vector<BrepSummary>& all) {
    BrepSummary sum;
    for (const BrepSummary& b : all) {
        sum.corners += b.corners;
        sum.lines += b.lines;
        sum.surfaces += b.surfaces;
        sum.regions += b.regions;
        sum.vertices += b.vertices;
        sum.triangles += b.triangles;
        sum.polygons += b.polygons;
        for (const auto& [role, n] : b.features) sum.features[role] += n;
        sum.interfaces += b.interfaces;
        sum.contacts += b.contacts;
        sum.layers += b.layers;
        sum.fault_blocks += b.fault_blocks;
        sum.internal_lines_of_regions += b.internal_lines_of_regions;
        sum.internal_lines_of_surfaces += b.internal_lines_of_surfaces;
        add_groups(b.layer_rows, sum.region_volumes.size(), sum.layer_rows);
        add_groups(b.block_rows, sum.region_volumes.size(), sum.block_rows);
        sum.region_volumes.insert(sum.region_volumes.end(), b.region_volumes.begin(), b.region_volumes.end());
        sum.is_found = sum.is_found || b.is_found;
        if (b.universe_volume) sum.universe_volume = sum.universe_volume.value_or(0) + *b.universe_volume;
    }
    return sum;
}

Json crs_json(const CoordinateSystem& crs) {
    Json j{{"name", crs.name}};
    if (!crs.projection.empty()) j["projection"] = crs.projection;
    if (!crs.datum.empty()) j["datum"] = crs.datum;
    if (any_stated(crs.axis_names)) j["axis_names"] = units_json(crs.axis_names);
    if (any_stated(crs.axis_units)) j["axis_units"] = units_json(crs.axis_units);
    j["z_positive"] = sign_name(crs.z_positive);
    return j;
}

Json file_json(const FileSummary& f) {
    Json j{{"file", f.file}};
    if (f.error) {
        j["error"] = failure_json(*f.error);
        return j;
    }
    j["format"] = f.format;
    if (!f.variant.empty()) j["variant"] = f.variant;
    Json objects = Json::array();
    for (const ObjectSummary& o : f.objects) objects.push_back(object_json(o));
    j["objects"] = std::move(objects);
    if (!f.breps.empty()) j["brep"] = brep_json(sum_of(f.breps), false);
    if (f.breps.size() > 1) {
        Json each = Json::array();
        for (const BrepSummary& b : f.breps) each.push_back(brep_json(b, true));
        j["breps"] = std::move(each);
    }
    if (f.breps.size() == 1 && f.breps[0].complexity) j["complexity"] = complexity_json(*f.breps[0].complexity);
    if (f.connections) j["connections"] = Json{{"internal", f.connections->internal}, {"nnc", f.connections->nnc}};
    if (f.crs.stated) j["crs"] = crs_json(f.crs);
    Json findings = Json::array();
    for (const Finding& finding : f.findings) findings.push_back(finding_json(finding));
    if (!findings.empty()) j["findings"] = std::move(findings);
    j["loss"] = losses_json(f.losses);
    return j;
}

}  // namespace

std::string info_json(std::span<const FileSummary> files) {
    Json all = Json::array();
    for (const FileSummary& f : files) all.push_back(file_json(f));
    return json_text(all);
}

}  // namespace geomend
