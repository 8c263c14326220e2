// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/soup_front.h"

#include <algorithm>

#include "topology/weld.h"

namespace geomend::topology {

namespace {

Failure unfit(const std::string& what) { return failure(FailureKind::internal, "F113", {}, "inconsistent triangle soup: " + what); }

/// What is wrong with what is stated over a soup; empty: nothing.
std::string check_statements(const SoupModel& model) {
    const std::size_t patches = model.patches.size();
    if (std::ranges::any_of(model.soup.patches, [&](std::uint32_t p) { return p >= patches; })) return "patch of a triangle";
    if (std::ranges::any_of(model.corners, [&](const auto& c) { return c.vertex >= model.soup.vertices.size(); }))
        return "vertex of a corner";
    for (const auto& feature : model.features) {
        if (std::ranges::any_of(feature.faces, [&](std::uint32_t f) { return f >= patches; })) return "patch of feature " + feature.name;
    }
    for (const auto& region : model.regions) {
        if (std::ranges::any_of(region.sides, [&](const auto& s) { return s.surface.value >= patches; })) {
            return "patch of region " + region.name;
        }
    }
    return {};
}

void state_lines(const SoupModel& model, const std::vector<std::uint32_t>& vertex_of, SurfaceComplex& complex) {
    std::uint32_t lines = static_cast<std::uint32_t>(model.line_names.size());
    for (const std::uint32_t id : model.soup.edge_ids) lines = std::max(lines, id + 1);
    complex.line_names = model.line_names;
    complex.line_names.resize(lines);
    for (std::size_t e = 0; e < model.soup.edges.size(); ++e) {
        const auto& [from, to] = model.soup.edges[e];
        complex.lines.edges.push_back({vertex_of[from], vertex_of[to], model.soup.edge_ids[e]});
    }
    for (const auto& corner : model.corners) {
        complex.lines.corners.push_back(vertex_of[corner.vertex]);
        complex.corner_names.push_back({vertex_of[corner.vertex], corner.name});
    }
}

void make_faces(SoupModel& model, const std::vector<std::uint32_t>& vertex_of, SurfaceComplex& complex) {
    const auto vertices = patch_vertices(model.soup, model.patches.size());
    complex.faces.resize(model.patches.size());
    for (std::size_t p = 0; p < model.patches.size(); ++p) {
        auto& patch = model.patches[p];
        auto& face = complex.faces[p];
        face.interface_name = patch.interface_name.empty() ? patch.name : std::move(patch.interface_name);
        if (patch.name != face.interface_name) face.surface.name = std::move(patch.name);  // else assemble() tells the pieces apart
        face.surface.role = patch.role;
        face.surface.role_text = std::move(patch.role_text);
        face.surface.attributes = std::move(patch.attributes);
        face.surface.annotations = std::move(patch.annotations);
        face.surface.source_object = patch.source_object;
        face.surface.source_part = patch.source_part;
        face.surface.nodes.reserve(vertices[p].size());
        for (const std::uint32_t v : vertices[p]) face.surface.nodes.emplace_back(vertex_of[v]);
    }
    for (std::size_t t = 0; t < model.soup.triangles.size(); ++t) {
        const std::uint32_t p = model.soup.patches[t];
        for (const std::uint32_t v : model.soup.triangles[t]) {
            const auto node = std::ranges::lower_bound(vertices[p], v) - vertices[p].begin();
            complex.faces[p].surface.polygons.corners.push_back(static_cast<std::uint32_t>(node));
        }
    }
}

}  // namespace

std::vector<std::vector<std::uint32_t>> patch_vertices(const TriangleSoup& soup, std::size_t patches) {
    std::vector<std::vector<std::uint32_t>> vertices(patches);
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        auto& own = vertices[soup.patches[t]];
        own.insert(own.end(), soup.triangles[t].begin(), soup.triangles[t].end());
    }
    for (auto& own : vertices) {
        std::ranges::sort(own);
        own.erase(std::unique(own.begin(), own.end()), own.end());
    }
    return vertices;
}

Result<SurfaceComplex> complex_of_soup(SoupModel model) {
    if (auto good = check(model.soup); !good) return std::move(good).why();
    if (auto wrong = check_statements(model); !wrong.empty()) return unfit(wrong);
    SurfaceComplex complex;
    complex.name = std::move(model.name);
    complex.crs = std::move(model.crs);
    complex.annotations = std::move(model.annotations);
    Welder welder(model.soup.vertices.size());
    std::vector<std::uint32_t> vertex_of;
    vertex_of.reserve(model.soup.vertices.size());
    for (const Vec3& p : model.soup.vertices) vertex_of.push_back(welder.add(p));
    complex.vertices = welder.take_positions();
    make_faces(model, vertex_of, complex);
    state_lines(model, vertex_of, complex);
    complex.interfaces = std::move(model.interfaces);
    complex.features = std::move(model.features);
    complex.regions = std::move(model.regions);
    complex.layers = std::move(model.layers);
    complex.fault_blocks = std::move(model.fault_blocks);
    return complex;
}

}  // namespace geomend::topology
