// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <variant>

#include "exchange/attribute_merge.h"
#include "exchange/connected_surfaces.h"
#include "exchange/model_from_brep.h"
#include "exchange/statements.h"

namespace geomend::exchange {

namespace {

/// Makes one Surface of all B-Rep surfaces of an interface: a part each, in order. A node at a vertex that
/// the interface has used before is a twin of the first node there.
class InterfaceWriter {
public:
    InterfaceWriter(const BrepData& brep, std::vector<Loss>& losses) : brep_(brep), losses_(losses) {}

    Surface make(const BrepData::Interface& interface) {
        Surface out;
        out.info.name = interface.name;
        out.info.role = interface.role;
        out.info.role_text = interface.role_text;
        out.info.feature = interface.feature;
        out.info.crs = brep_.crs;
        out.info.annotations = interface.annotations;
        first_at_.clear();
        std::size_t nodes = 0, corners = 0;
        for (const SurfaceId s : interface.surfaces) {
            nodes += brep_.surfaces[s.value].nodes.size();
            corners += brep_.surfaces[s.value].polygons.corners.size();
        }
        out.points.reserve(nodes);
        out.polygons.corners.reserve(corners);
        AttributeMerge merge;
        for (const SurfaceId s : interface.surfaces) add_part(brep_.surfaces[s.value], out, merge);
        out.info.attributes = merge.finish(interface.name, losses_);
        if (interface.surfaces.size() <= 1) out.parts.clear();
        if (std::all_of(out.alias.begin(), out.alias.end(), [](std::uint32_t a) { return a == no_index; })) out.alias.clear();
        add_border_corners(interface, out);
        return out;
    }

private:
    void add_part(const BrepData::Surface& surface, Surface& out, AttributeMerge& merge) {
        const auto first = static_cast<std::uint32_t>(out.points.size());
        out.parts.push_back({first, out.polygons.size()});
        for (std::uint32_t n = 0; n < surface.nodes.size(); ++n) {
            const std::uint32_t v = surface.nodes[n].value;
            const auto [at, is_new] = first_at_.emplace(v, first + n);
            out.points.push_back(brep_.vertices[v]);
            out.alias.push_back(is_new ? no_index : at->second);
        }
        const std::size_t polygons_before = out.polygons.size();
        std::vector<std::uint32_t> polygon;
        for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
            polygon.clear();
            for (const std::uint32_t node : surface.polygons[p]) polygon.push_back(first + node);
            out.polygons.push_back(polygon);
        }
        merge.add(surface.attributes, AttributeLocation::point, first, surface.nodes.size());
        merge.add(surface.attributes, AttributeLocation::polygon, polygons_before, surface.polygons.size());
        merge.add(surface.attributes, AttributeLocation::object, 0, 1);
    }

    /// Corners of the model are the border corners of its surfaces.
    void add_border_corners(const BrepData::Interface& interface, Surface& out) const {
        std::unordered_map<std::uint32_t, std::uint8_t> corners;
        for (const SurfaceId s : interface.surfaces) {
            for (const auto& use : brep_.surfaces[s.value].lines) {
                for (const CornerId c : brep_.lines[use.line.value].corners) corners.emplace(brep_.corners[c.value].vertex.value, 1);
            }
        }
        std::size_t point = 0;
        for (const SurfaceId s : interface.surfaces) {
            for (const VertexId v : brep_.surfaces[s.value].nodes) {
                if (corners.contains(v.value)) out.border_corners.push_back(static_cast<std::uint32_t>(point));
                ++point;
            }
        }
    }

    const BrepData& brep_;
    std::vector<Loss>& losses_;
    std::unordered_map<std::uint32_t, std::uint32_t> first_at_;  // vertex -> point
};

/// How many lines without a name run inside of a single surface that is not cut there: its triangles do not show where.
std::uint64_t embedded_lines_without_name(const BrepData& brep) {
    std::vector<std::uint32_t> uses(brep.lines.size(), 0), sides(brep.lines.size(), 0);
    for (const auto& surface : brep.surfaces) {
        for (const auto& use : surface.lines) {
            ++uses[use.line.value];
            if (use.internal) ++sides[use.line.value];
        }
    }
    std::uint64_t count = 0;
    for (const auto& surface : brep.surfaces) {
        std::unordered_map<std::uint32_t, std::uint32_t> nodes_at;
        for (const auto& use : surface.lines) {
            const std::uint32_t l = use.line.value;
            if (uses[l] != 2 || sides[l] != 2 || !brep.lines[l].name.empty()) continue;
            sides[l] = 0;  // its other side is the same line
            if (nodes_at.empty()) {
                for (const VertexId v : surface.nodes) ++nodes_at[v.value];
            }
            if (std::ranges::all_of(brep.lines[l].vertices, [&](VertexId v) { return nodes_at[v.value] == 1; })) ++count;
        }
    }
    return count;
}

void list_losses(const BrepData& brep, std::vector<Loss>& losses) {
    for (const auto& region : brep.regions) {
        if (!region.cell_types.empty()) {
            add_loss(losses, {LossClass::substance, region.name, "cells", "a model of surfaces holds no cells", region.cell_types.size()});
        }
        for (const Attribute& a : region.attributes) {
            add_loss(losses, {LossClass::substance, region.name, "attribute '" + a.name + "'", "a model of surfaces holds no cells", 1});
        }
    }
    for (const auto& line : brep.lines) {
        if (!line.name.empty())
            add_loss(losses, {LossClass::identity, line.name, "name of a line", "a model of surfaces names no lines", 1});
    }
    if (const auto embedded = embedded_lines_without_name(brep); embedded > 0)
        add_loss(losses,
                 {LossClass::identity, "", "lines inside of surfaces", "a model of surfaces has lines where these end or meet", embedded});
    std::vector<std::uint8_t> on_surface(brep.lines.size(), 0);
    for (const auto& surface : brep.surfaces) {
        for (const auto& use : surface.lines) on_surface[use.line.value] = 1;
    }
    const auto loose = static_cast<std::uint64_t>(std::count(on_surface.begin(), on_surface.end(), 0));
    if (loose > 0) add_loss(losses, {LossClass::substance, "", "lines away from surfaces", "a model of surfaces holds no lines", loose});
}

}  // namespace

Dataset faced_model(const Brep& brep, std::vector<Loss>& losses) {
    Dataset result;
    const auto in_parts = with_connected_surfaces(*brep);
    const BrepData& b = in_parts ? *in_parts : *brep;
    InterfaceWriter writer(b, losses);
    for (const auto& interface : b.interfaces) result.objects.emplace_back(writer.make(interface));
    std::vector<FacePlace> places;
    for (std::uint32_t i = 0; i < b.interfaces.size(); ++i) {
        std::uint32_t part = 0;
        for (const SurfaceId s : b.interfaces[i].surfaces) places.push_back({s, i, part++});
    }
    list_losses(*brep, losses);
    result.models.push_back(stated_model(b, places));
    return result;
}

}  // namespace geomend::exchange
