// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/frontal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <optional>
#include <unordered_map>
#include <utility>

#include "base/cell_number.h"
#include "base/length.h"
#include "base/vectors.h"
#include "remesh/pattern.h"
#include "remesh/polish.h"

namespace geomend::remeshing {

namespace {

/// Points in cells of space, for all within a distance.
class FrontCells {
public:
    explicit FrontCells(double step) : step_(step) {}

    void add(const Vec3& place, std::uint32_t number) { cells_[cell_of(place)].push_back({place, number}); }

    /// Calls visit(number, place) for each point that is no farther than that; until it returns false. \return whether none did
    template <class Visit>
    bool visit(const Vec3& place, double distance, const Visit& visit) const {
        const Cell low = cell_of(minus(place, {distance, distance, distance})), high = cell_of(plus(place, {distance, distance, distance}));
        for (std::int64_t i = low[0]; i <= high[0]; ++i) {
            for (std::int64_t j = low[1]; j <= high[1]; ++j) {
                for (std::int64_t k = low[2]; k <= high[2]; ++k) {
                    const auto found = cells_.find({i, j, k});
                    if (found == cells_.end()) continue;
                    for (const auto& [at, number] : found->second) {
                        const Vec3 away = minus(at, place);
                        if (dot(away, away) <= distance * distance && !visit(number, at)) return false;
                    }
                }
            }
        }
        return true;
    }

private:
    using Cell = std::array<std::int64_t, 3>;
    struct Hash {
        std::size_t operator()(const Cell& c) const {
            return (static_cast<std::size_t>(c[0]) * 0x9e3779b97f4a7c15u ^ static_cast<std::size_t>(c[1])) * 0xbf58476d1ce4e5b9u ^
                   static_cast<std::size_t>(c[2]) * 0x94d049bb133111ebu;
        }
    };
    Cell cell_of(const Vec3& p) const { return {cell_number(p[0] / step_), cell_number(p[1] / step_), cell_number(p[2] / step_)}; }
    double step_;
    std::unordered_map<Cell, std::vector<std::pair<Vec3, std::uint32_t>>, Hash> cells_;
};

Vec3 facing_of(const EdgeMesh& mesh, std::uint32_t triangle) {
    const auto [a, b, c] = mesh.triangle(triangle);
    const Vec3 n = cross(minus(b, a), minus(c, a));
    const double size = length(n);
    return size > 0 ? times(1 / size, n) : Vec3{};
}

/// The step of cells: the mean size at the vertices that stay.
double mean_size(const WorkSurface& work) {
    double sum = 0, count = 0;
    for (std::uint32_t v = 0; v < work.kinds.size(); ++v) {
        if (!work.mesh.has_vertex(v)) continue;
        sum += work.sizes[v];
        ++count;
    }
    return count > 0 && sum > 0 ? sum / count : 1;
}

class FrontalSampler {
public:
    FrontalSampler(const WorkSurface& work, const FrontalRules& rules)
        : work_(work), rules_(rules), step_(mean_size(work)), points_(step_), border_(step_) {}

    std::vector<FrontalPoint> run() {
        take_borders();
        advance();
        const EdgeMesh& surface = *work_.reference;
        for (std::uint32_t v = 0; v < surface.places.size() && !work_.stopped_at(v); ++v) {
            if (surface.has_vertex(v) && seed(v)) advance();
        }
        return std::move(made_);
    }

private:
    struct FrontSample {
        Vec3 place, facing;
        double size;
        std::uint32_t triangle;  ///< of the reference
        std::uint32_t number;    ///< as FrontalPoint::beside has it
    };
    const WorkSurface& work_;
    const FrontalRules& rules_;
    double step_;
    FrontCells points_, border_;
    std::vector<FrontSample> samples_;
    std::deque<std::array<std::uint32_t, 2>> front_;
    std::vector<FrontalPoint> made_;

    void advance() {
        while (!front_.empty() && !work_.stopped() && samples_.size() < work_.most_triangles) {
            const auto [a, b] = front_.front();
            front_.pop_front();
            for (const double side : {1.0, -1.0}) {
                if (const auto at = third_corner(a, b, side)) accept(*at, samples_[a].number);
            }
        }
    }

    /// Begins a front at a vertex of the surface that none came near: where there is no border, or one that is too far from others.
    bool seed(std::uint32_t v) {
        const EdgeMesh& surface = *work_.reference;
        if (work_.kinds[v] != VertexKind::inner) return false;
        const Vec3 facing = facing_of(surface, surface.leaving[v] / 3);
        const bool none_near = points_.visit(surface.places[v], 1.3 * work_.sizes[v],
                                             [&](std::uint32_t i, const Vec3&) { return dot(samples_[i].facing, facing) < 0; });
        if (!none_near) return false;
        const SurfacePoint at = closest_point(surface, surface.places[v], surface.leaving[v] / 3);
        if (!accept(at, v)) return false;
        const std::uint32_t first = made_.back().beside;
        const std::uint32_t number = samples_.back().number;
        bool begun = false;
        visit_leaving(surface, first, [&](std::uint32_t h) {
            if (begun) return;
            const Vec3 way = minus(surface.places[surface.to(h)], at.place);
            const double size = length(way);
            if (size > 0) begun = accept(closest_point(surface, plus(at.place, times(work_.sizes[v] / size, way)), h / 3), number);
        });
        return begun;
    }

    std::uint32_t add_sample(const Vec3& place, std::uint32_t triangle, double size, std::uint32_t number) {
        const auto i = static_cast<std::uint32_t>(samples_.size());
        samples_.push_back({place, facing_of(*work_.reference, triangle), size, triangle, number});
        points_.add(place, i);
        return i;
    }

    /// The edges between the vertices of borders that stay are the first front; points along borders keep others away.
    void take_borders() {
        const EdgeMesh& mesh = work_.mesh;
        std::vector<std::uint32_t> sample(mesh.places.size(), no_index), next(mesh.places.size(), no_index);
        for (std::uint32_t v = 0; v < mesh.places.size(); ++v) {
            if (mesh.has_vertex(v) && work_.kinds[v] == VertexKind::fixed)
                sample[v] = add_sample(mesh.places[v], work_.triangles[v], work_.sizes[v], v);
        }
        for (std::uint32_t h = 0; h < mesh.corners.size(); ++h) {
            if (mesh.corners[h] == no_index || mesh.twins[h] != no_index) continue;
            next[mesh.from(h)] = mesh.to(h);
            const Vec3 a = mesh.places[mesh.from(h)], d = minus(mesh.places[mesh.to(h)], a);
            const double parts =
                std::clamp(std::ceil(4 * length(d) / std::min(work_.sizes[mesh.from(h)], work_.sizes[mesh.to(h)])), 1.0, 1e5);
            for (double i = 0; i < parts; ++i) border_.add(plus(a, times(i / parts, d)), h);
        }
        for (std::uint32_t v = 0; v < next.size(); ++v) {
            if (sample[v] == no_index || next[v] == no_index) continue;
            std::uint32_t to = next[v];
            for (std::size_t steps = 0; to != no_index && sample[to] == no_index && steps < next.size(); ++steps) to = next[to];
            if (to != no_index && to != v && sample[to] != no_index) front_.push_back({sample[v], sample[to]});
        }
    }

    /// Where the circle around the middle of an edge, across it, meets the surface on one side, for an equilateral triangle.
    std::optional<SurfacePoint> third_corner(std::uint32_t first, std::uint32_t second, double side) const {
        const EdgeMesh& surface = *work_.reference;
        const FrontSample &a = samples_[first], &b = samples_[second];
        const Vec3 edge = minus(b.place, a.place), middle = plus(a.place, times(0.5, edge));
        const double square = dot(edge, edge);
        const SurfacePoint from = closest_point(surface, middle, a.triangle);
        const double size = size_at(work_, from), radius = std::sqrt(std::abs(size * size - square / 4));
        Vec3 across = times(side, cross(facing_of(surface, from.triangle), edge));
        SurfacePoint at;
        for (int round = 0; round < 4; ++round) {
            const double size_across = length(across);
            if (!(size_across > 0)) return std::nullopt;
            at = closest_point(surface, plus(middle, times(radius / size_across, across)), round == 0 ? from.triangle : at.triangle);
            across = minus(at.place, middle);
            across = minus(across, times(dot(across, edge) / square, edge));
            if (at.distance < 0.01 * radius) break;
        }
        if (std::abs(length(minus(at.place, middle)) - radius) > 0.1 * radius) return std::nullopt;  // a border is there, or a fold
        return at;
    }

    /// \param beside as of FrontalPoint \return whether there was room
    bool accept(const SurfacePoint& at, std::uint32_t beside) {
        const double size = size_at(work_, at);
        const Vec3 facing = facing_of(*work_.reference, at.triangle);
        const auto is_far = [&](std::uint32_t i, const Vec3&) { return dot(samples_[i].facing, facing) < 0; };
        if (!points_.visit(at.place, rules_.apart * size, is_far)) return false;
        const auto never = [](std::uint32_t, const Vec3&) { return false; };
        if (!border_.visit(at.place, rules_.from_border * size, never)) return false;
        const auto number = static_cast<std::uint32_t>(work_.kinds.size() + made_.size());
        made_.push_back({at, beside, size});
        const std::uint32_t own = add_sample(at.place, at.triangle, size, number);
        points_.visit(at.place, (2 - rules_.apart) * size, [&](std::uint32_t i, const Vec3&) {
            if (i != own && dot(samples_[i].facing, facing) > 0) front_.push_back({own, i});
            return true;
        });
        return true;
    }
};

}  // namespace

std::vector<FrontalPoint> frontal_points(const WorkSurface& work, const FrontalRules& rules) { return FrontalSampler(work, rules).run(); }

void remesh_frontal(WorkSurface& work, const FrontalRules& rules) {
    const auto points = frontal_points(work, rules);
    const auto first = static_cast<std::uint32_t>(work.kinds.size());
    for (const FrontalPoint& point : points) {
        if (point.beside < first && work.kinds[point.beside] == VertexKind::inner) work.kinds[point.beside] = VertexKind::fixed;
    }
    even_out(work, rules.start);           // a mesh of as many triangles, which takes the points well
    std::vector<std::uint32_t> vertex_of;  // per point; where one could not be put that of the one beside it
    for (const FrontalPoint& point : points) {
        const std::uint32_t beside = point.beside < first ? point.beside : vertex_of[point.beside - first];
        const std::uint32_t v = put_vertex(work, point.at, work.mesh.leaving[beside] / 3);
        vertex_of.push_back(v != no_index ? v : beside);
    }
    leave_fixed_vertices(work);
    for (std::uint32_t v = 0; v < work.kinds.size(); ++v) {
        if (work.mesh.has_vertex(v) && work.kinds[v] == VertexKind::fixed && work.names[v] == no_index) work.kinds[v] = VertexKind::inner;
    }
    for (unsigned round = 0; round < rules.relaxing && !work.stopped(); ++round) {
        if (round == 0 && split_long_edges(work) > 0) {  // between lines where no point had room
            flip_edges(work);
            collapse_short_edges(work);
            flip_edges(work);
        }
        move_vertices(work);
        flip_edges(work);
    }
    polish_triangles(work, rules.polished_below);
}

}  // namespace geomend::remeshing
