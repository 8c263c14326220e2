// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/brep.h"

#include <string>

namespace geomend {

namespace {

Failure broken(const std::string& what) {
    return failure(FailureKind::internal, "F113", {}, "inconsistent boundary representation: " + what);
}

std::string check_lines(const BrepData& d) {
    for (const auto& corner : d.corners) {
        if (corner.vertex.value >= d.vertices.size()) return "vertex of corner " + corner.name;
    }
    for (std::size_t i = 0; i < d.lines.size(); ++i) {
        const auto& line = d.lines[i];
        if (line.vertices.size() < 2) return "line " + std::to_string(i) + " has fewer than two vertices";
        for (const VertexId v : line.vertices) {
            if (v.value >= d.vertices.size()) return "vertex of line " + std::to_string(i);
        }
        for (const CornerId c : line.corners) {
            if (c.value >= d.corners.size()) return "corner of line " + std::to_string(i);
        }
    }
    return {};
}

std::string check_surface(const BrepData& d, const BrepData::Surface& s) {
    for (const VertexId v : s.nodes) {
        if (v.value >= d.vertices.size()) return "vertex of surface " + s.name;
    }
    for (const std::uint32_t node : s.polygons.corners) {
        if (node >= s.nodes.size()) return "node of surface " + s.name;
    }
    if (!s.neighbours.empty() && s.neighbours.size() != s.polygons.corners.size()) return "neighbours of surface " + s.name;
    std::size_t at = 0;
    for (std::size_t p = 0; p < s.polygons.size() && !s.neighbours.empty(); ++p) {
        for (std::size_t e = 0; e < s.polygons[p].size(); ++e, ++at) {
            const std::uint32_t q = s.neighbours[at];
            if (q == no_index) continue;
            if (q >= s.polygons.size()) return "neighbour in surface " + s.name;
            const std::size_t first = static_cast<std::size_t>(s.polygons[q].data() - s.polygons.corners.data());
            bool back = false;
            for (std::size_t f = 0; f < s.polygons[q].size(); ++f) back |= s.neighbours[first + f] == p;
            if (!back) return "one-sided adjacency in surface " + s.name;
        }
    }
    for (const auto& border : s.lines) {
        if (border.line.value >= d.lines.size()) return "line of surface " + s.name;
    }
    for (const RegionId r : s.regions) {
        if (r.valid() && r.value >= d.regions.size()) return "region of surface " + s.name;
    }
    if (s.interface_id.valid() && s.interface_id.value >= d.interfaces.size()) return "interface of surface " + s.name;
    return {};
}

std::string check_regions(const BrepData& d) {
    for (const auto& region : d.regions) {
        for (const auto& side : region.sides) {
            if (side.surface.value >= d.surfaces.size()) return "surface of region " + region.name;
        }
        for (const VertexId v : region.nodes) {
            if (v.value >= d.vertices.size()) return "vertex of region " + region.name;
        }
        for (const std::uint32_t node : region.cell_nodes) {
            if (node >= region.nodes.size()) return "cell node of region " + region.name;
        }
        if (region.cell_offsets.size() != region.cell_types.size() + 1) return "cell offsets of region " + region.name;
    }
    for (const auto& side : d.universe) {
        if (side.surface.value >= d.surfaces.size()) return "surface of the Universe";
    }
    return {};
}

}  // namespace

Result<Brep> Brep::make(BrepData data) {
    if (auto wrong = check_lines(data); !wrong.empty()) return broken(wrong);
    for (const auto& surface : data.surfaces) {
        if (auto wrong = check_surface(data, surface); !wrong.empty()) return broken(wrong);
    }
    if (auto wrong = check_regions(data); !wrong.empty()) return broken(wrong);
    return Brep(std::move(data));
}

}  // namespace geomend
