// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/surface_result.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "exchange/model_from_brep.h"
#include "repair/joined_nodes.h"
#include "repair/region_names.h"
#include "repair/scars.h"
#include "repair/self_joints.h"
#include "repair/soup_measures.h"
#include "repair/surface_values.h"
#include "topology/assemble.h"

namespace geomend::repair {

namespace {

/// Per patch the triangles of the soup, in their order: polygon i of a face is triangle i of its patch.
std::vector<std::vector<std::uint32_t>> triangles_of_patches(const SurfaceModel& model) {
    std::vector<std::vector<std::uint32_t>> of(model.model.patches.size());
    for (std::uint32_t t = 0; t < model.model.soup.triangles.size(); ++t) of[model.model.soup.patches[t]].push_back(t);
    return of;
}

/// Per surface and polygon its triangle of the soup.
std::vector<std::vector<std::uint32_t>> soup_triangles(const SurfaceModel& model, const topology::JudgedModel& judged) {
    const auto of_patch = triangles_of_patches(model);
    std::vector<std::vector<std::uint32_t>> triangles;
    for (std::size_t s = 0; s < judged.brep->surfaces.size(); ++s) {
        const auto& all = of_patch[judged.brep->surfaces[s].source_part];
        if (s >= judged.source_polygons.size() || judged.source_polygons[s].empty()) {
            triangles.push_back(all);
            continue;
        }
        std::vector<std::uint32_t> own;
        for (const std::uint32_t p : judged.source_polygons[s]) own.push_back(all[p]);
        triangles.push_back(std::move(own));
    }
    return triangles;
}

/// Per region its sides as sides of triangles of the soup, which a surface may have turned over.
std::vector<std::vector<TriangleSide>> region_sides(const topology::JudgedModel& judged,
                                                    const std::vector<std::vector<std::uint32_t>>& triangles) {
    std::vector<std::vector<std::uint8_t>> turned(triangles.size());
    for (std::size_t s = 0; s < triangles.size(); ++s) {
        turned[s].assign(triangles[s].size(), 0);
        if (s < judged.turned_polygons.size()) {
            for (const std::uint32_t p : judged.turned_polygons[s]) turned[s][p] = 1;
        }
    }
    std::vector<std::vector<TriangleSide>> sides;
    for (const auto& region : judged.brep->regions) {
        std::vector<TriangleSide> own;
        for (const auto& side : region.sides) {
            const std::size_t s = side.surface.value;
            for (std::size_t p = 0; p < triangles[s].size(); ++p) own.push_back({triangles[s][p], side.front != (turned[s][p] != 0)});
        }
        sides.push_back(std::move(own));
    }
    return sides;
}

/// The soup and its patches, but for those of which nothing is left.
topology::SoupModel without_empty_patches(const SurfaceModel& whole) {
    topology::SoupModel model = whole.model;
    std::vector<std::uint32_t> number(model.patches.size(), no_index);
    for (const std::uint32_t p : model.soup.patches) number[p] = 0;
    if (std::ranges::find(number, no_index) == number.end()) return model;
    std::set<std::string> left;
    std::uint32_t count = 0;
    for (std::uint32_t p = 0; p < number.size(); ++p) {
        if (number[p] == no_index) continue;
        number[p] = count++;
        left.insert(model.patches[p].interface_name);
        if (number[p] != p) model.patches[number[p]] = std::move(model.patches[p]);
    }
    model.patches.resize(count);
    for (std::uint32_t& p : model.soup.patches) p = number[p];
    std::erase_if(model.interfaces, [&](const auto& i) { return !left.contains(i.name); });
    for (auto& feature : model.features) {
        for (std::uint32_t& f : feature.faces) {
            const std::uint32_t now = successor_of(whole, f);
            f = now == no_index ? no_index : number[now];
        }
        std::ranges::sort(feature.faces);
        feature.faces.erase(std::unique(feature.faces.begin(), feature.faces.end()), feature.faces.end());
        std::erase(feature.faces, no_index);
    }
    std::erase_if(model.features, [](const auto& feature) { return feature.faces.empty(); });
    return model;
}

/// Edges become lines, all of one new id.
void part_at(const std::vector<std::array<std::uint32_t, 2>>& edges, topology::SoupModel& model) {
    std::uint32_t id = static_cast<std::uint32_t>(model.line_names.size());
    for (const std::uint32_t used : model.soup.edge_ids) id = std::max(id, used + 1);
    model.soup.edges.insert(model.soup.edges.end(), edges.begin(), edges.end());
    model.soup.edge_ids.resize(model.soup.edges.size(), id);
}

/// The complex of a model that was taken apart, with nodes that state what is cut: its surfaces as faces of their own.
topology::SurfaceComplex with_nodes_of(const BrepData& brep, const topology::JudgedModel& judged, topology::SurfaceComplex complex) {
    std::map<std::uint32_t, std::size_t> face_of;  // by patch
    for (std::size_t f = 0; f < complex.faces.size(); ++f) face_of.emplace(complex.faces[f].surface.source_part, f);
    std::vector<topology::SurfaceComplex::Face> faces;
    for (std::size_t s = 0; s < brep.surfaces.size(); ++s) {
        const auto& own = complex.faces[face_of.at(brep.surfaces[s].source_part)];
        auto& face = faces.emplace_back();
        face.interface_name = own.interface_name;
        face.tolerance = own.tolerance;
        face.surface.name = own.surface.name;
        face.surface.role = own.surface.role;
        face.surface.role_text = own.surface.role_text;
        face.surface.source_object = own.surface.source_object;
        face.surface.source_part = own.surface.source_part;
        face.surface.nodes = brep.surfaces[s].nodes;
        face.surface.polygons = brep.surfaces[s].polygons;
        if (s < judged.source_polygons.size()) face.source_polygons = judged.source_polygons[s];
    }
    complex.faces = std::move(faces);
    complex.take_apart = false;
    complex.lines.shared_nodes = false;
    return complex;
}

Result<topology::JudgedModel> assembled(const SurfaceModel& model) {
    auto left = without_empty_patches(model);
    part_at(self_joints(model), left);
    auto complex = topology::complex_of_soup(std::move(left));
    if (!complex) return std::move(complex).why();
    complex->take_apart = true;
    complex->lines.shared_nodes = true;
    for (auto& face : complex->faces) face.shared_nodes = true;
    auto judged = topology::assemble(*complex, topology::RegionSearch::where_none_are_stated);
    if (!judged) return judged;
    BrepData brep = *judged->brep;
    if (!join_nodes_as_read(model, soup_triangles(model, *judged), brep)) return judged;
    auto joined = topology::assemble(with_nodes_of(brep, *judged, std::move(*complex)), topology::RegionSearch::where_none_are_stated);
    if (joined) joined->turned_polygons = std::move(judged->turned_polygons);
    return joined;
}

}  // namespace

Result<PiecesOfModel> pieces_of(const SurfaceModel& model) {
    auto judged = assembled(model);
    if (!judged) return std::move(judged).why();
    auto triangles = soup_triangles(model, *judged);
    return PiecesOfModel{std::move(judged->brep), std::move(triangles)};
}

Result<TriangleRegions> triangle_regions(const SurfaceModel& model) {
    auto judged = assembled(model);
    if (!judged) return std::move(judged).why();
    const BrepData& brep = *judged->brep;
    TriangleRegions result;
    result.sides.assign(model.model.soup.triangles.size(), {no_index, no_index});
    std::vector<double> area(brep.regions.size(), 0);
    const auto triangles = soup_triangles(model, *judged);
    for (std::size_t s = 0; s < triangles.size(); ++s) {
        const auto& regions = brep.surfaces[s].regions;
        double of_surface = 0;
        for (const std::uint32_t t : triangles[s]) {
            result.sides[t] = {regions[0].value, regions[1].value};
            of_surface += triangle_area(model.model.soup, t);
        }
        for (const RegionId region : regions) {
            if (region.valid()) area[region.value] += of_surface;
        }
    }
    for (std::size_t r = 0; r < brep.regions.size(); ++r) {
        const bool known = brep.regions[r].volume_known && area[r] > 0;
        result.thickness.push_back(known ? 2 * brep.regions[r].volume / area[r] : std::numeric_limits<double>::infinity());
    }
    return result;
}

Result<SurfaceResult> result_of(const SurfaceModel& model) {
    auto judged = assembled(model);
    if (!judged) return std::move(judged).why();
    const auto triangles = soup_triangles(model, *judged);
    BrepData data = *judged->brep;
    for (std::size_t s = 0; s < data.surfaces.size(); ++s) {
        carry_values(model, data.surfaces[s].source_part, triangles[s], data.vertices, data.surfaces[s]);
    }
    auto changes = carry_region_names(model, region_sides(*judged, triangles), data);
    auto brep = Brep::make(std::move(data));
    if (!brep) return std::move(brep).why();
    SurfaceResult result{std::move(*brep), {}, std::move(changes)};
    result.dataset = exchange::faced_model(result.brep, result.dataset.losses);
    return result;
}

}  // namespace geomend::repair
