// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/cell_regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "geometry/curved_volume.h"
#include "geometry/measures.h"
#include "model/cell_faces.h"
#include "topology/corner_values.h"
#include "topology/face_volume.h"
#include "topology/faces_from_mesh.h"
#include "topology/faces_from_surfaces.h"

namespace geomend::topology {

namespace {

/// The three lowest of some vertices, put in front.
void lowest_first(std::vector<std::uint32_t>& vertices) {
    std::partial_sort(vertices.begin(), vertices.begin() + std::min<std::ptrdiff_t>(3, static_cast<std::ptrdiff_t>(vertices.size())),
                      vertices.end());
}

Vec3 minus(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

}  // namespace

CellRegions::CellRegions(const BrepData& brep, const CellMesh& mesh, const std::vector<std::uint32_t>& vertex_of)
    : brep_(brep), mesh_(mesh), vertex_of_(vertex_of), first_(brep.vertices.size() + 1, 0) {
    std::vector<std::uint32_t> vertices, next;
    const auto each_polygon = [&](const auto& body) {
        for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
            const auto& surface = brep.surfaces[s];
            for (std::uint32_t p = 0; p < surface.polygons.size(); ++p) {
                vertices.clear();
                for (const std::uint32_t node : surface.polygons[p]) vertices.push_back(surface.nodes[node].value);
                lowest_first(vertices);
                if (vertices.size() >= 3) body(s, p);
            }
        }
    };
    each_polygon([&](std::uint32_t, std::uint32_t) { ++first_[vertices[0] + 1]; });
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    facets_.resize(first_.back());
    next.assign(first_.begin(), first_.end() - 1);
    each_polygon([&](std::uint32_t s, std::uint32_t p) {
        facets_[next[vertices[0]]++] = {vertices[1], vertices[2], static_cast<std::uint32_t>(vertices.size()), s, p};
    });
    for (std::size_t v = 0; v + 1 < first_.size(); ++v) {
        std::sort(facets_.begin() + first_[v], facets_.begin() + first_[v + 1], [](const Facet& a, const Facet& b) {
            return std::tie(a.second, a.third, a.size, a.surface, a.polygon) < std::tie(b.second, b.third, b.size, b.surface, b.polygon);
        });
    }
}

const CellRegions::Facet* CellRegions::find(const std::vector<std::uint32_t>& vertices) const {
    const auto begin = facets_.begin() + first_[vertices[0]], end = facets_.begin() + first_[vertices[0] + 1];
    if (begin == end) return nullptr;
    const Facet wanted{vertices[1], vertices[2], static_cast<std::uint32_t>(vertices.size()), 0, 0};
    const auto found = std::lower_bound(begin, end, wanted, [](const Facet& a, const Facet& b) {
        return std::tie(a.second, a.third, a.size) < std::tie(b.second, b.third, b.size);
    });
    if (found == end || found->second != wanted.second || found->third != wanted.third || found->size != wanted.size) return nullptr;
    return &*found;
}

namespace {

/// Collects on which side of which polygons the cells of a region lie.
class SideVotes {
public:
    explicit SideVotes(const BrepData& brep) : brep_(brep) {}

    void add(std::uint32_t surface_index, std::uint32_t polygon_index, const Vec3& inside) {
        const auto& surface = brep_.surfaces[surface_index];
        const auto polygon = surface.polygons[polygon_index];
        const Vec3 origin = point(surface, polygon[0]);
        Vec3 normal{};
        for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
            const Vec3 u = minus(point(surface, polygon[i]), origin), v = minus(point(surface, polygon[i + 1]), origin);
            normal[0] += u[1] * v[2] - u[2] * v[1];
            normal[1] += u[2] * v[0] - u[0] * v[2];
            normal[2] += u[0] * v[1] - u[1] * v[0];
        }
        // From the middle: a flat cell over a warped polygon may lie behind the plane through one of its corners.
        Vec3 middle{};
        for (const std::uint32_t node : polygon) {
            const Vec3 from_origin = minus(point(surface, node), origin);
            for (std::size_t a = 0; a < 3; ++a) middle[a] += from_origin[a] / static_cast<double>(polygon.size());
        }
        const Vec3 d = minus(minus(inside, origin), middle);
        const double height = normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2];
        if (height != 0) ++votes_[surface_index][height > 0 ? 1 : 0];
    }

    void result(CellRegion& region) const {
        for (const auto& [s, sides] : votes_) {
            const std::size_t size = brep_.surfaces[s].polygons.size();
            for (std::size_t front = 0; front < 2; ++front) {
                if (sides[front] == 0) continue;
                region.region.sides.push_back({SurfaceId(s), front == 1});
                if (sides[front] < size && (region.incomplete.empty() || region.incomplete.back() != SurfaceId(s))) {
                    region.incomplete.emplace_back(s);
                }
            }
        }
    }

private:
    Vec3 point(const BrepData::Surface& surface, std::uint32_t node) const { return brep_.vertices[surface.nodes[node].value]; }

    const BrepData& brep_;
    std::map<std::uint32_t, std::array<std::size_t, 2>> votes_;  // behind, in front
};

Vec3 middle_of(const CellMesh& mesh, std::span<const std::uint32_t> nodes) {
    const Vec3& origin = mesh.points[nodes[0]];
    Vec3 sum{};
    for (const std::uint32_t p : nodes) {
        for (std::size_t a = 0; a < 3; ++a) sum[a] += mesh.points[p][a] - origin[a];
    }
    for (std::size_t a = 0; a < 3; ++a) sum[a] = origin[a] + sum[a] / static_cast<double>(nodes.size());
    return sum;
}

template <class Body>
void for_each_facet(const CellMesh& mesh, std::uint32_t cell, std::vector<std::uint32_t>& facet, const Body& body) {
    if (mesh.types[cell] == CellType::polyhedron && !mesh.cell_faces.empty()) {
        for (std::uint64_t f = mesh.cell_faces[cell]; f < mesh.cell_faces[cell + 1]; ++f) {
            facet.assign(mesh.face_nodes.begin() + static_cast<std::ptrdiff_t>(mesh.face_offsets[f]),
                         mesh.face_nodes.begin() + static_cast<std::ptrdiff_t>(mesh.face_offsets[f + 1]));
            body();
        }
        return;
    }
    const auto nodes = mesh.cell_nodes(cell);
    for (const LocalFace& face : faces_of(mesh.types[cell])) {
        facet.clear();
        for (const std::uint8_t i : face.corners()) facet.push_back(nodes[i]);
        body();
    }
}

/// The nodes, cells and attributes of a region: copies of its share of the mesh.
void fill(BrepData::Region& region, const CellMesh& mesh, const std::vector<std::uint32_t>& cells,
          const std::vector<std::uint32_t>& vertex_of) {
    std::vector<std::uint32_t> points;
    for (const std::uint32_t c : cells) {
        const auto nodes = mesh.cell_nodes(c);
        points.insert(points.end(), nodes.begin(), nodes.end());
    }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    const auto node_of = [&](std::uint32_t p) {
        return static_cast<std::uint32_t>(std::lower_bound(points.begin(), points.end(), p) - points.begin());
    };
    for (const std::uint32_t p : points) region.nodes.emplace_back(vertex_of[p]);
    for (const std::uint32_t c : cells) {
        region.cell_types.push_back(mesh.types[c]);
        for (const std::uint32_t p : mesh.cell_nodes(c)) region.cell_nodes.push_back(node_of(p));
        region.cell_offsets.push_back(region.cell_nodes.size());
        if (mesh.cell_faces.empty()) continue;
        if (region.cell_faces.empty()) region.cell_faces.push_back(0), region.face_offsets.push_back(0);
        for (std::uint64_t f = mesh.cell_faces[c]; f < mesh.cell_faces[c + 1]; ++f) {
            for (std::uint64_t k = mesh.face_offsets[f]; k < mesh.face_offsets[f + 1]; ++k) {
                region.face_nodes.push_back(node_of(mesh.face_nodes[k]));
            }
            region.face_offsets.push_back(region.face_nodes.size());
        }
        region.cell_faces.push_back(region.face_offsets.size() - 1);
    }
    for (const Attribute& a : mesh.info.attributes) {
        if (a.location == AttributeLocation::point) region.attributes.push_back(restricted(a, points, a.location));
        if (a.location != AttributeLocation::cell) continue;
        if (components_per_corner(a) > 0 && missing_in(a, cells)) continue;  // values of surfaces
        region.attributes.push_back(restricted(a, cells, a.location));
    }
}

}  // namespace

CellRegion CellRegions::make(const std::vector<std::uint32_t>& cells) const {
    CellRegion result;
    fill(result.region, mesh_, cells, vertex_of_);
    SideVotes votes(brep_);
    PreciseSum volume;
    std::vector<std::uint32_t> facet;
    for (const std::uint32_t c : cells) {
        volume.add(unsigned_volume(mesh_, c));
        const Vec3 inside = middle_of(mesh_, corner_nodes(mesh_, c));
        for_each_facet(mesh_, c, facet, [&] {
            for (std::uint32_t& v : facet) v = vertex_of_[v];
            lowest_first(facet);
            if (facet.size() < 3) return;
            const Facet* first = find(facet);
            if (first == nullptr) return;
            const Facet* end = facets_.data() + first_[facet[0] + 1];
            for (const Facet* f = first; f != end && f->second == first->second && f->third == first->third && f->size == first->size;
                 ++f) {
                votes.add(f->surface, f->polygon, inside);
            }
        });
    }
    votes.result(result);
    result.region.volume = volume.value();
    result.region.volume_known = true;
    return result;
}

}  // namespace geomend::topology
