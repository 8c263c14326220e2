// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/surface_job.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>

#include "base/length.h"
#include "base/vectors.h"
#include "remesh/centroidal.h"
#include "remesh/crossings.h"
#include "remesh/frontal.h"
#include "remesh/isotropic.h"

namespace geomend::remeshing {

namespace {

/// A surface of the model as a mesh of its own.
struct Reference {
    EdgeMesh mesh;
    std::vector<std::uint32_t> node_of, vertex_of;  ///< per vertex of the mesh its node, and that of the model
    std::vector<double> sizes, most;                ///< as of VertexSizes
    double growth = 0;
    const std::function<double(const Vec3&)>* limit = nullptr;

    VertexSizes vertex_sizes() const { return {sizes, most, growth, limit}; }
};

Result<Reference> reference_of(const BrepData& brep, const BrepData::Surface& surface, const VertexSizes& sizes) {
    if (!surface.polygons.all_triangles()) return failure(FailureKind::cannot_hold, "F026", {}, "it has polygons that are no triangles");
    std::vector<Vec3> places;
    for (const VertexId v : surface.nodes) places.push_back(brep.vertices[v.value]);
    auto fanned = fanned_mesh(places, surface.polygons.corners, surface.neighbours);
    if (!fanned) return std::move(fanned).why();
    Reference made{std::move(fanned->mesh), std::move(fanned->vertex_of), {}, {}, {}, sizes.growth, sizes.limit};
    for (const std::uint32_t node : made.node_of) {
        made.vertex_of.push_back(surface.nodes[node].value);
        made.sizes.push_back(sizes.at[surface.nodes[node].value]);
        made.most.push_back(sizes.most[surface.nodes[node].value]);
    }
    return made;
}

/// Puts the new vertices of lines onto the borders, and says which of the old ones stay.
/// \return why that cannot be; empty: it could
std::string fit_lines(const Reference& reference, const LinePlan& lines, WorkSurface& work,
                      std::vector<std::array<std::uint32_t, 2>>& nodes, std::vector<std::uint32_t>& stuck) {
    nodes.assign(work.kinds.size(), {no_index, no_index});
    for (std::uint32_t v = 0; v < reference.vertex_of.size(); ++v) {
        const std::uint32_t vertex = reference.vertex_of[v];
        if (lines.stays(vertex)) {
            work.kinds[v] = VertexKind::fixed;
            work.names[v] = vertex;
            nodes[v] = {reference.node_of[v], reference.node_of[v]};
        } else if (!reference.mesh.on_border(v) && lines.on_line(vertex)) {
            stuck.push_back(vertex);
        }
    }
    const EdgeMesh& mesh = reference.mesh;
    for (std::uint32_t h = 0; h < mesh.corners.size(); ++h) {
        if (mesh.twins[h] != no_index) continue;
        const std::uint32_t a = mesh.from(h), b = mesh.to(h);
        const auto use = lines.find(reference.vertex_of[a], reference.vertex_of[b]);
        if (!use) return "a border of it is no line";
        const auto inside = lines.inside(use->line, use->segment);
        std::uint32_t edge = work.mesh.leaving[a];
        for (std::size_t i = 0; i < inside.size(); ++i) {
            const LinePlan::Named& sample = use->forward ? inside[i] : inside[inside.size() - 1 - i];
            const double share = use->forward ? sample.sample.share : 1 - sample.sample.share;
            SurfacePoint at;
            at.triangle = h / 3;
            at.weights[h % 3] = 1 - share;
            at.weights[next_of(h) % 3] = share;
            at.place = lines.place(sample.name);
            const std::uint32_t v = add_on_edge(work, edge, lines.place(sample.name), at, VertexKind::fixed);
            work.names[v] = sample.name;
            const auto [low, high] = std::minmax(reference.node_of[a], reference.node_of[b]);
            nodes.resize(work.kinds.size(), {no_index, no_index});
            nodes[v] = {low, high};
            edge = work.mesh.leaving[v];
        }
    }
    return {};
}

void take_sources(const Reference& reference, const WorkSurface& work, const std::vector<std::uint32_t>& kept, NewSurface& made) {
    for (const std::uint32_t v : kept) {
        const SurfacePoint at = closest_point(reference.mesh, work.mesh.places[v], work.triangles[v]);
        NewSurface::Source source;
        source.weights = at.weights;
        for (std::size_t k = 0; k < 3; ++k) source.rows[k] = reference.node_of[reference.mesh.corners[3 * std::size_t{at.triangle} + k]];
        made.sources.push_back(source);
    }
}

/// The closest point on a mesh; where that seems too far it is looked for all around, as far as to a point of the start triangle.
SurfacePoint measured_point(const EdgeMesh& mesh, const Vec3& point, std::uint32_t start, const Vec3& in_start, double allowed) {
    const SurfacePoint found = closest_point(mesh, point, start);
    if (found.distance <= allowed) return found;
    return closest_point_around(mesh, point, start, length(minus(point, in_start)));
}

/// Marks the vertices of a triangle of the reference where a point of the new surface is too far from it.
class DistanceCheck {
public:
    DistanceCheck(const Reference& reference, double allowed, NewSurface& made) : reference_(reference), allowed_(allowed), made_(made) {}

    void from_new(const SurfacePoint& at) {
        made_.to_old = std::max(made_.to_old, at.distance);
        if (at.distance <= allowed_) return;
        for (std::size_t k = 0; k < 3; ++k)
            made_.too_far.emplace_back(reference_.vertex_of[reference_.mesh.corners[3 * std::size_t{at.triangle} + k]],
                                       at.distance / allowed_);
    }
    void from_old(std::uint32_t v, double distance) {
        made_.from_old = std::max(made_.from_old, distance);
        if (distance > allowed_) made_.too_far.emplace_back(reference_.vertex_of[v], distance / allowed_);
    }
    /// Where an edge of the new surface passes over one of the old surface.
    void between(const CrossingWalk& walk, const EdgeMesh& mesh, std::uint32_t triangle) {
        const double distance = length(minus(walk.on_surface(), walk.on_edge()));
        if (distance > made_.to_old)
            from_new(measured_point(reference_.mesh, walk.on_edge(), walk.triangle(), walk.on_surface(), allowed_));
        if (!(distance > made_.from_old)) return;
        const double from = measured_point(mesh, walk.on_surface(), triangle, walk.on_edge(), allowed_).distance;
        for (std::size_t k = 0; k < 3; ++k) from_old(reference_.mesh.corners[3 * std::size_t{walk.triangle()} + k], from);
    }

private:
    const Reference& reference_;
    double allowed_;
    NewSurface& made_;
};

/// Per triangle of the reference a triangle of the new mesh that is near: spread from where new vertices lie.
std::vector<std::uint32_t> near_triangles(const Reference& reference, const EdgeMesh& mesh, std::span<const std::uint32_t> triangle_of) {
    std::vector<std::uint32_t> near(reference.mesh.triangle_count(), no_index), queue;
    for (std::uint32_t v = 0; v < mesh.places.size(); ++v) {
        if (near[triangle_of[v]] != no_index) continue;
        near[triangle_of[v]] = mesh.leaving[v] / 3;
        queue.push_back(triangle_of[v]);
    }
    for (std::size_t i = 0; i < queue.size(); ++i) {
        for (std::uint32_t h = 3 * queue[i]; h < 3 * queue[i] + 3; ++h) {
            const std::uint32_t back = reference.mesh.twins[h];
            if (back == no_index || near[back / 3] != no_index) continue;
            near[back / 3] = near[queue[i]];
            queue.push_back(back / 3);
        }
    }
    return near;
}

void measure_distances(const Reference& reference, const EdgeMesh& mesh, std::span<const std::uint32_t> triangle_of,
                       const SurfaceRules& rules, NewSurface& made) {
    const double allowed = rules.max_distance;
    const auto stopped = [&](std::uint32_t i) { return (i & 0xfff) == 0 && rules.monitor != nullptr && rules.monitor->stopped(); };
    DistanceCheck check(reference, allowed, made);
    made.source_triangles.reserve(mesh.triangle_count());
    for (std::uint32_t t = 0; t < mesh.triangle_count() && !stopped(t); ++t) {
        const auto p = mesh.triangle(t);
        const std::uint32_t start = triangle_of[mesh.corners[3 * std::size_t{t}]];
        const SurfacePoint middle = measured_point(reference.mesh, times(1.0 / 3, plus(p[0], plus(p[1], p[2]))), start, p[0], allowed);
        made.source_triangles.push_back(middle.triangle);
        check.from_new(middle);
        for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
            if (mesh.twins[h] != no_index && mesh.twins[h] < h) continue;
            const Vec3 half = times(0.5, plus(p[h % 3], p[next_of(h) % 3]));
            check.from_new(measured_point(reference.mesh, half, triangle_of[mesh.from(h)], p[h % 3], allowed));
            const SurfacePoint below = closest_point(reference.mesh, p[h % 3], triangle_of[mesh.from(h)]);
            visit_crossings(reference.mesh, p[h % 3], p[next_of(h) % 3], below,
                            [&](const CrossingWalk& walk) { check.between(walk, mesh, t); });
        }
    }
    const auto near = near_triangles(reference, mesh, triangle_of);
    for (std::uint32_t v = 0; v < reference.mesh.places.size() && !stopped(v); ++v) {
        const std::uint32_t start = near[reference.mesh.leaving[v] / 3];
        if (start == no_index) continue;  // a part of which nothing is left: told by the caller
        const Vec3& at = reference.mesh.places[v];
        check.from_old(v, measured_point(mesh, at, start, mesh.places[mesh.corners[3 * std::size_t{start}]], allowed).distance);
    }
}

/// Far more triangles than the area and the sizes, or the borders, call for.
std::uint32_t most_triangles(const Reference& reference, const WorkSurface& work) {
    double count = 1000 + 8.0 * work.mesh.triangle_count();
    for (std::uint32_t t = 0; t < reference.mesh.triangle_count(); ++t) {
        const auto at = reference.mesh.triangle(t);
        const Vec3 n = cross(minus(at[1], at[0]), minus(at[2], at[0]));
        double size = HUGE_VAL;
        for (std::size_t k = 0; k < 3; ++k) size = std::min(size, reference.sizes[reference.mesh.corners[3 * std::size_t{t} + k]]);
        count += 10 * std::sqrt(dot(n, n)) / (size * size);
    }
    return static_cast<std::uint32_t>(std::min(count, 1e9));
}

/// Splits inner edges between pairs of named vertices.
void split_bridges(WorkSurface& work, std::span<const std::array<std::uint32_t, 2>> bridges) {
    if (bridges.empty()) return;
    const std::set<std::array<std::uint32_t, 2>> barred(bridges.begin(), bridges.end());
    for (std::uint32_t h = 0; h < work.mesh.corners.size(); ++h) {
        if (work.mesh.corners[h] == no_index || work.mesh.twins[h] == no_index) continue;
        const std::uint32_t a = work.names[work.mesh.from(h)], b = work.names[work.mesh.to(h)];
        if (a == no_index || b == no_index || !barred.contains({std::min(a, b), std::max(a, b)})) continue;
        split_at_middle(work, h);
    }
    move_vertices(work);
}

/// The mesh without holes in its arrays: triangles and vertices keep their order.
EdgeMesh packed(const EdgeMesh& mesh, std::vector<std::uint32_t>& kept) {
    EdgeMesh made;
    std::vector<std::uint32_t> vertex(mesh.places.size(), no_index), triangle(mesh.triangle_count(), no_index);
    for (std::uint32_t v = 0; v < mesh.places.size(); ++v) {
        if (!mesh.has_vertex(v)) continue;
        vertex[v] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(v);
        made.places.push_back(mesh.places[v]);
    }
    std::uint32_t count = 0;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        if (mesh.has_triangle(t)) triangle[t] = count++;
    }
    const auto moved = [&](std::uint32_t h) { return h == no_index ? h : 3 * triangle[h / 3] + h % 3; };
    for (std::uint32_t h = 0; h < mesh.corners.size(); ++h) {
        if (mesh.corners[h] == no_index) continue;
        made.corners.push_back(vertex[mesh.corners[h]]);
        made.twins.push_back(moved(mesh.twins[h]));
    }
    for (const std::uint32_t v : kept) made.leaving.push_back(moved(mesh.leaving[v]));
    return made;
}

}  // namespace

NewSurface surface_as_it_was(const BrepData& brep, std::uint32_t s) {
    const auto& surface = brep.surfaces[s];
    NewSurface made;
    made.kept = true;
    for (std::uint32_t n = 0; n < surface.nodes.size(); ++n) {
        made.places.push_back(brep.vertices[surface.nodes[n].value]);
        made.names.push_back(surface.nodes[n].value);
        made.nodes.push_back({n, n});
        made.sources.push_back({{n, n, n}, {1, 0, 0}});
    }
    made.corners = surface.polygons.corners;
    made.neighbours = surface.neighbours;
    for (std::uint32_t t = 0; t < surface.polygons.size(); ++t) made.source_triangles.push_back(t);
    return made;
}

NewSurface remeshed_surface(const BrepData& brep, std::uint32_t s, const LinePlan& lines, const VertexSizes& sizes,
                            const SurfaceRules& rules) {
    const auto keep = [&](std::string why) {
        NewSurface kept = surface_as_it_was(brep, s);
        kept.why = std::move(why);
        return kept;
    };
    const auto reference = reference_of(brep, brep.surfaces[s], sizes);
    if (!reference) return keep(reference.why().error.message);
    WorkSurface work = work_surface(reference->mesh, reference->vertex_sizes());
    NewSurface made;
    std::vector<std::array<std::uint32_t, 2>> nodes;
    if (std::string why = fit_lines(*reference, lines, work, nodes, made.stuck); !why.empty()) return keep(std::move(why));
    work.most_triangles = most_triangles(*reference, work);
    work.monitor = rules.monitor;
    if (rules.pattern != nullptr) remesh_to_pattern(work, *rules.pattern, s, rules.size);
    else if (rules.method == Method::centroidal) remesh_centroidal(work, {});
    else if (rules.method == Method::frontal) remesh_frontal(work, {});
    else remesh_isotropic(work, {});
    if (work.stopped()) return keep("stopped");
    if (work.mesh.triangle_count() >= work.most_triangles)
        return keep("its triangles are too narrow for the size: it would have very many");
    split_bridges(work, rules.bridges);

    std::vector<std::uint32_t> kept;
    EdgeMesh mesh = packed(work.mesh, kept);
    std::vector<std::uint32_t> triangle_of;
    for (const std::uint32_t v : kept) {
        if (work.kinds[v] == VertexKind::old) made.stuck.push_back(reference->vertex_of[v]);
        made.names.push_back(work.names[v]);
        made.nodes.push_back(work.names[v] != no_index ? nodes[v] : std::array{no_index, no_index});
        triangle_of.push_back(work.triangles[v]);
    }
    take_sources(*reference, work, kept, made);
    measure_distances(*reference, mesh, triangle_of, rules, made);
    made.places = std::move(mesh.places);
    made.corners = std::move(mesh.corners);
    for (const std::uint32_t h : mesh.twins) made.neighbours.push_back(h == no_index ? h : h / 3);
    return made;
}

}  // namespace geomend::remeshing
