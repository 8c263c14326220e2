// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/surface_values.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "base/vectors.h"
#include "model/attribute_operations.h"
#include "topology/weld.h"

namespace geomend::repair {

namespace {

/// Where the values of a node come from: a patch as it was read, and rows of it.
struct NodeSource {
    std::uint32_t patch = no_index;
    Sample sample{{no_index, no_index, no_index}, {}};
    double off = INFINITY;  ///< how far from the node the rows with their shares are
};

/// Positions of the nodes of some patches as they were read.
class SourceNodes {
public:
    SourceNodes(const SurfaceModel& model, std::span<const std::uint32_t> patches) : welder_(0) {
        for (const std::uint32_t p : patches) {
            const std::size_t first = model.source_patches[p].first_vertex;
            const std::size_t last =
                p + 1 < model.source_patches.size() ? model.source_patches[p + 1].first_vertex : model.source.vertices.size();
            for (std::size_t v = first; v < last; ++v) {
                if (welder_.add(model.source.vertices[v]) == at_.size()) at_.push_back({p, static_cast<std::uint32_t>(v - first)});
            }
        }
    }
    /// The patch and row of the node at a position, if there is one.
    std::optional<std::pair<std::uint32_t, std::uint32_t>> find(const Vec3& position) const {
        const std::uint32_t i = welder_.find(position);
        if (i == no_index) return std::nullopt;
        return at_[i];
    }

private:
    topology::Welder welder_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> at_;
};

/// What a corner of a triangle of the soup has from the triangle that it is a piece of.
NodeSource corner_source(const SurfaceModel& model, std::uint32_t t, unsigned corner) {
    const std::uint32_t from = model.origin.triangles[t];
    NodeSource source;
    source.patch = model.source.patches[from];
    source.sample.weights = corner_weights(model.origin, model.source, model.model.soup, t, corner);
    Vec3 off = times(-1, model.model.soup.vertices[model.model.soup.triangles[t][corner]]);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t v = model.source.triangles[from][i];
        source.sample.rows[i] = v - model.source_patches[source.patch].first_vertex;
        off = plus(off, times(source.sample.weights[i], model.source.vertices[v]));
    }
    source.off = std::sqrt(dot(off, off));
    return source;
}

/// Per node where its value comes from: the first triangle whose source has the node's place; where none has it (the triangle took
/// the place of several), the node that was read there.
std::vector<NodeSource> node_sources(const SurfaceModel& model, std::span<const std::uint32_t> patches,
                                     std::span<const std::uint32_t> triangles, std::span<const Vec3> vertices,
                                     const BrepData::Surface& surface) {
    const TriangleSoup& soup = model.model.soup;
    const double near = 4 * model.lengths.tolerance;
    std::vector<NodeSource> sources(surface.nodes.size());
    for (std::size_t p = 0; p < triangles.size(); ++p) {
        const std::uint32_t t = triangles[p];
        if (model.origin.triangles[t] == no_index) continue;
        for (const std::uint32_t node : surface.polygons[p]) {
            if (sources[node].off <= near) continue;
            const Vec3& position = vertices[surface.nodes[node].value];
            for (unsigned k = 0; k < 3; ++k) {
                if (soup.vertices[soup.triangles[t][k]] != position) continue;
                if (const NodeSource own = corner_source(model, t, k); own.off < sources[node].off) sources[node] = own;
                break;
            }
        }
    }
    std::optional<SourceNodes> nodes;
    for (std::size_t n = 0; n < sources.size(); ++n) {
        if (sources[n].patch == no_index || sources[n].off <= near) continue;
        if (!nodes) nodes.emplace(model, patches);
        if (const auto found = nodes->find(vertices[surface.nodes[n].value]))
            sources[n] = {found->first, {{found->second, found->second, found->second}, {1, 0, 0}}, 0};
    }
    return sources;
}

/// The patches that triangles come from, ascending.
std::vector<std::uint32_t> source_patches_of(const SurfaceModel& model, std::span<const std::uint32_t> triangles) {
    std::vector<std::uint32_t> patches;
    for (const std::uint32_t t : triangles) {
        if (model.origin.triangles[t] == no_index) continue;
        const std::uint32_t p = model.source.patches[model.origin.triangles[t]];
        if (patches.empty() || patches.back() != p) patches.push_back(p);
    }
    std::ranges::sort(patches);
    patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
    return patches;
}

/// Values of some rows of an attribute that is the same one of another part of a surface; of another type they are left.
void take_rows(Attribute& to, const Attribute& from, const std::vector<std::uint8_t>& rows) {
    if (to.components != from.components) return;
    std::visit(
        [&](auto& values) {
            const auto* others = std::get_if<std::decay_t<decltype(values)>>(&from.values);
            if (others == nullptr) return;
            for (std::size_t i = 0; i < values.size(); ++i) {
                if (rows[i / to.components] != 0) values[i] = (*others)[i];
            }
        },
        to.values);
}

/// What the nodes and polygons of a surface have from one patch as it was read; 1 in `nodes` and `polygons` for those that it is.
struct Part {
    std::uint32_t patch;
    std::vector<Sample> samples;
    std::vector<std::uint32_t> rows;
    std::vector<std::uint8_t> nodes, polygons;
};

Part part_of(const SurfaceModel& model, std::uint32_t patch, const std::vector<NodeSource>& sources,
             std::span<const std::uint32_t> triangles) {
    Part part{patch, {}, {}, {}, {}};
    for (const NodeSource& s : sources) {
        part.nodes.push_back(s.patch == patch ? 1 : 0);
        part.samples.push_back(s.patch == patch ? s.sample : Sample{{no_index, no_index, no_index}, {}});
    }
    for (const std::uint32_t t : triangles) {
        const std::uint32_t from = model.origin.triangles[t];
        const bool own = from != no_index && model.source.patches[from] == patch;
        part.polygons.push_back(own ? 1 : 0);
        part.rows.push_back(own ? from - model.source_patches[patch].first_triangle : no_index);
    }
    return part;
}

Attribute values_of(const Attribute& attribute, const Part& part) {
    if (attribute.location == AttributeLocation::point) return interpolated(attribute, part.samples);
    if (attribute.location == AttributeLocation::polygon) return taken(attribute, part.rows);
    return attribute;
}

}  // namespace

void carry_values(const SurfaceModel& model, std::uint32_t patch, std::span<const std::uint32_t> triangles, std::span<const Vec3> vertices,
                  BrepData::Surface& surface) {
    surface.attributes.clear();
    auto patches = source_patches_of(model, triangles);
    if (patches.empty()) patches.push_back(patch);
    if (std::ranges::all_of(patches, [&](std::uint32_t p) { return model.source_patches[p].attributes.empty(); })) return;
    const auto sources = node_sources(model, patches, triangles, vertices, surface);
    for (const std::uint32_t p : patches) {
        const Part part = part_of(model, p, sources, triangles);
        for (const Attribute& attribute : model.source_patches[p].attributes) {
            Attribute own = values_of(attribute, part);
            const auto same = std::ranges::find_if(surface.attributes,
                                                   [&](const Attribute& a) { return a.name == own.name && a.location == own.location; });
            if (same == surface.attributes.end()) surface.attributes.push_back(std::move(own));
            else if (own.location != AttributeLocation::object)
                take_rows(*same, own, own.location == AttributeLocation::point ? part.nodes : part.polygons);
        }
    }
}

}  // namespace geomend::repair
