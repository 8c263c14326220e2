// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/surface_values.h"

#include "model/attribute_operations.h"

namespace geomend::repair {

namespace {

/// Per node where its value comes from, in rows of the patch as it was read.
std::vector<Sample> node_samples(const SurfaceModel& model, std::uint32_t first_vertex, std::span<const std::uint32_t> triangles,
                                 std::span<const Vec3> vertices, const BrepData::Surface& surface) {
    const TriangleSoup& soup = model.model.soup;
    std::vector<Sample> samples(surface.nodes.size(), Sample{{no_index, no_index, no_index}, {}});
    for (std::size_t p = 0; p < triangles.size(); ++p) {
        const std::uint32_t t = triangles[p], from = model.origin.triangles[t];
        if (from == no_index) continue;
        for (const std::uint32_t node : surface.polygons[p]) {
            if (samples[node].rows[0] != no_index) continue;
            const Vec3& position = vertices[surface.nodes[node].value];
            for (unsigned k = 0; k < 3; ++k) {
                if (soup.vertices[soup.triangles[t][k]] != position) continue;
                for (std::size_t i = 0; i < 3; ++i) samples[node].rows[i] = model.source.triangles[from][i] - first_vertex;
                samples[node].weights = corner_weights(model.origin, model.source, soup, t, k);
                break;
            }
        }
    }
    return samples;
}

}  // namespace

void carry_values(const SurfaceModel& model, std::uint32_t patch, std::span<const std::uint32_t> triangles, std::span<const Vec3> vertices,
                  BrepData::Surface& surface) {
    const auto& source = model.source_patches[patch];
    surface.attributes.clear();
    if (source.attributes.empty()) return;
    const auto samples = node_samples(model, source.first_vertex, triangles, vertices, surface);
    std::vector<std::uint32_t> rows;
    rows.reserve(triangles.size());
    for (const std::uint32_t t : triangles) {
        const std::uint32_t from = model.origin.triangles[t];
        rows.push_back(from == no_index ? no_index : from - source.first_triangle);
    }
    for (const Attribute& attribute : source.attributes) {
        if (attribute.location == AttributeLocation::point) surface.attributes.push_back(interpolated(attribute, samples));
        else if (attribute.location == AttributeLocation::polygon) surface.attributes.push_back(taken(attribute, rows));
        else surface.attributes.push_back(attribute);
    }
}

}  // namespace geomend::repair
