// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/surface_model.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "base/own_name.h"
#include "model/attribute_operations.h"
#include "topology/assemble.h"
#include "topology/brep_from_dataset.h"
#include "topology/weld.h"

namespace geomend::repair {

namespace {

using topology::SurfaceComplex;

/// Names of loose surfaces: of several with one name the later ones get a number.
class Names {
public:
    std::string of(const SurfaceComplex::Face& face, bool stated) {
        if (stated) return face.interface_name;
        const auto known = given_.find(face.surface.source_object);
        if (known != given_.end()) return known->second;
        const std::string wish = face.interface_name.empty() ? "surface" : face.interface_name;
        return given_.emplace(face.surface.source_object, own_name(wish, used_)).first->second;
    }

private:
    std::map<std::uint32_t, std::string> given_;  // object -> name
    std::set<std::string> used_;
};

/// Attributes of polygons as attributes of the triangles that polygons are fans of.
void fan_attributes(std::vector<Attribute>& attributes, const std::vector<std::uint32_t>& polygon_of, std::size_t polygons) {
    if (polygon_of.size() == polygons) return;
    for (Attribute& attribute : attributes) {
        if (attribute.location == AttributeLocation::polygon) attribute = taken(attribute, polygon_of);
    }
}

class Gatherer {
public:
    Gatherer(SurfaceModel& model, const topology::LocalLengths& lengths) : m_(model), lengths_(lengths) {}

    void add(SurfaceComplex& complex) {
        const auto first_patch = static_cast<std::uint32_t>(m_.model.patches.size());
        if (m_.model.name.empty()) m_.model.name = complex.name;
        if (first_patch == 0) {
            m_.model.crs = complex.crs;
            m_.model.annotations = complex.annotations;
        }
        for (auto& face : complex.faces) add_face(complex, face);
        add_statements(complex, first_patch);
    }

    void finish() {
        m_.model.soup.vertices = welder_.take_positions();
        m_.model.soup.patches = m_.source.patches;
        m_.origin.triangles.resize(m_.source.triangles.size());
        for (std::uint32_t t = 0; t < m_.origin.triangles.size(); ++t) m_.origin.triangles[t] = t;
    }

private:
    std::uint32_t vertex_at(const Vec3& position, std::uint32_t source) {
        const std::uint32_t v = welder_.add(position);
        if (v == m_.origin.vertices.size()) m_.origin.vertices.push_back(Origin::from_vertex(source));
        return v;
    }

    static SurfaceModel::SourcePatch::Cuts cuts_of(const SurfaceComplex& complex, const SurfaceComplex::Face& face) {
        if (!complex.stated) return SurfaceModel::SourcePatch::if_most;
        return face.shared_nodes ? SurfaceModel::SourcePatch::unstated : SurfaceModel::SourcePatch::stated;
    }

    void add_face(const SurfaceComplex& complex, SurfaceComplex::Face& face) {
        const auto patch = static_cast<std::uint32_t>(m_.model.patches.size());
        const auto first = static_cast<std::uint32_t>(m_.source.vertices.size());
        m_.source_patches.push_back({first, static_cast<std::uint32_t>(m_.source.triangles.size()), std::move(face.surface.attributes),
                                     face.surface.source_object, face.number, cuts_of(complex, face),
                                     lengths_.of(face.surface.source_object).diameter});
        std::vector<std::uint32_t> vertex_of;
        for (const VertexId v : face.surface.nodes) {
            vertex_of.push_back(vertex_at(complex.vertices[v.value], static_cast<std::uint32_t>(m_.source.vertices.size())));
            m_.source.vertices.push_back(complex.vertices[v.value]);
        }
        std::vector<std::uint32_t> polygon_of;
        for (std::uint32_t p = 0; p < face.surface.polygons.size(); ++p) {
            const auto polygon = face.surface.polygons[p];
            for (std::size_t k = 2; k < polygon.size(); ++k) {
                m_.source.triangles.push_back({first + polygon[0], first + polygon[k - 1], first + polygon[k]});
                m_.model.soup.triangles.push_back({vertex_of[polygon[0]], vertex_of[polygon[k - 1]], vertex_of[polygon[k]]});
                m_.source.patches.push_back(patch);
                polygon_of.push_back(p);
            }
        }
        fan_attributes(m_.source_patches.back().attributes, polygon_of, face.surface.polygons.size());
        topology::SoupModel::Patch made;
        made.interface_name = names_.of(face, complex.stated);
        made.name = face.surface.name.empty() ? made.interface_name : face.surface.name;
        made.role = face.surface.role;
        made.role_text = face.surface.role_text;
        made.annotations = face.surface.annotations;
        made.source_object = 0;
        made.source_part = patch;
        if (face.surface.source_object != no_index) m_.objects.push_back(face.surface.source_object);
        m_.model.patches.push_back(std::move(made));
    }

    void add_statements(const SurfaceComplex& complex, std::uint32_t first_patch) {
        for (const auto& said : complex.interfaces) m_.model.interfaces.push_back(said);
        for (auto feature : complex.features) {
            for (std::uint32_t& face : feature.faces) face += first_patch;
            m_.model.features.push_back(std::move(feature));
        }
        for (const auto& corner : complex.corner_names) {
            const std::uint32_t v = welder_.find(complex.vertices[corner.vertex]);
            if (v != no_index) m_.model.corners.push_back({v, corner.name});
        }
        const auto first_line = static_cast<std::uint32_t>(m_.model.line_names.size());
        m_.model.line_names.insert(m_.model.line_names.end(), complex.line_names.begin(), complex.line_names.end());
        for (const auto& edge : complex.lines.edges) {
            const std::uint32_t from = welder_.find(complex.vertices[edge.from]), to = welder_.find(complex.vertices[edge.to]);
            if (from == no_index || to == no_index || from == to) continue;
            m_.model.soup.edges.push_back({from, to});
            m_.model.soup.edge_ids.push_back(first_line + edge.line);
        }
    }

    SurfaceModel& m_;
    const topology::LocalLengths& lengths_;
    topology::Welder welder_{0};
    Names names_;
};

/// What is stated of regions, over patches: as the boundary representation has it, where it could be made.
void take_regions(const BrepData& brep, std::uint32_t first_patch, SurfaceModel& model) {
    const auto first_region = static_cast<std::uint32_t>(model.regions.size());
    for (const auto& region : brep.regions) {
        topology::StatedRegion stated{region.name, false, region.sides};
        for (auto& side : stated.sides) side.surface = SurfaceId(side.surface.value + first_patch);
        model.regions.push_back(std::move(stated));
        if (!region.cell_types.empty()) {
            add_loss(model.losses,
                     {LossClass::substance, region.name, "cells", "only the surfaces of a model are mended", region.cell_types.size()});
        }
    }
    const auto take = [&](const std::vector<BrepData::RegionList>& lists, std::vector<SurfaceComplex::RegionList>& to) {
        for (const auto& list : lists) {
            SurfaceComplex::RegionList made{list.name, {}, list.unresolved};
            for (const RegionId r : list.regions) made.regions.push_back(first_region + r.value);
            to.push_back(std::move(made));
        }
    };
    take(brep.layers, model.layers);
    take(brep.fault_blocks, model.fault_blocks);
}

void take_stray_points(const Dataset& dataset, const topology::LocalLengths& lengths, SurfaceModel& model) {
    for (const auto& [object, point, times, usual] : lengths.outlying) {
        if (const auto* surface = std::get_if<Surface>(&dataset.objects[object])) {
            model.stray.push_back({surface->info.name, surface->points[point]});
        } else if (const auto* mesh = std::get_if<CellMesh>(&dataset.objects[object])) {
            model.stray.push_back({mesh->info.name, mesh->points[point]});
        }
    }
}

}  // namespace

Result<SurfaceModel> surface_model_of(const Dataset& dataset, const topology::LengthRules& rules) {
    SurfaceModel model;
    model.rules = rules;
    const auto lengths = topology::local_lengths(dataset, rules);
    model.lengths = lengths.largest;
    model.diameter = lengths.largest.diameter;
    take_stray_points(dataset, lengths, model);
    const auto sources = topology::model_sources(dataset);
    auto complexes = topology::complexes_of(dataset, sources);
    Gatherer gatherer(model, lengths);
    for (std::size_t i = 0; i < complexes.size(); ++i) {
        const auto first_patch = static_cast<std::uint32_t>(model.model.patches.size());
        gatherer.add(complexes[i]);
        if (!complexes[i].stated) continue;
        auto judged = topology::assemble(topology::complexes_of(dataset, std::span(sources).subspan(i, 1)).front(),
                                         topology::RegionSearch::where_none_are_stated);
        if (judged && judged->regions_stated) take_regions(*judged->brep, first_patch, model);
    }
    gatherer.finish();
    if (model.model.soup.triangles.empty())
        return failure(FailureKind::usage, "F018", {}, "there is no surface with triangles that could be mended");
    std::ranges::sort(model.objects);
    model.objects.erase(std::unique(model.objects.begin(), model.objects.end()), model.objects.end());
    return model;
}

void measure_lengths(SurfaceModel& model, std::uint32_t patches) {
    const TriangleSoup& soup = model.model.soup;
    std::vector<Surface> surfaces(model.model.patches.size());
    std::vector<std::uint32_t> last_patch(soup.vertices.size(), no_index), point(soup.vertices.size());
    std::vector<std::uint32_t> order(soup.triangles.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t t) { return soup.patches[t]; });
    for (const std::uint32_t t : order) {
        Surface& surface = surfaces[soup.patches[t]];
        for (const std::uint32_t v : soup.triangles[t]) {
            if (last_patch[v] != soup.patches[t]) {
                last_patch[v] = soup.patches[t];
                point[v] = static_cast<std::uint32_t>(surface.points.size());
                surface.points.push_back(soup.vertices[v]);
            }
            surface.polygons.corners.push_back(point[v]);
        }
    }
    Dataset whole;
    for (Surface& surface : surfaces) whole.objects.emplace_back(std::move(surface));
    const auto lengths = topology::local_lengths(whole, model.rules);
    for (std::uint32_t p = 0; p < patches; ++p) {
        const topology::Lengths& own = lengths.of(p);
        if (own.diameter > model.lengths.diameter) model.lengths = own;
    }
    // What is removed later moves the centroid, from which sizes are measured.
    constexpr double margin = 1.25;
    if (model.rules.tolerance < 0) model.lengths.tolerance *= margin;
}

void take_soup(SurfaceModel& model, TriangleSoup soup, const Origin& origin) {
    std::map<std::uint32_t, std::uint32_t> result_of;  // of the vertices that have a name
    for (const auto& corner : model.model.corners) result_of.emplace(corner.vertex, no_index);
    for (std::uint32_t v = 0; v < origin.vertices.size() && !result_of.empty(); ++v) {
        if (const auto found = result_of.find(origin.vertices[v].vertex); found != result_of.end()) found->second = v;
    }
    for (auto& corner : model.model.corners) corner.vertex = result_of[corner.vertex];
    std::erase_if(model.model.corners, [](const auto& corner) { return corner.vertex == no_index; });
    if (!model.added.empty()) {
        std::vector<std::uint8_t> added;
        added.reserve(origin.triangles.size());
        for (const std::uint32_t t : origin.triangles) added.push_back(t == no_index ? 1 : model.added[t]);
        model.added = std::move(added);
    }
    model.origin = composed(model.origin, origin, model.source, model.model.soup);
    model.model.soup = std::move(soup);
}

}  // namespace geomend::repair
