// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/lengths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/parallel.h"
#include "topology/clusters.h"
#include "topology/outlying_points.h"
#include "topology/sources_to_judge.h"
#include "topology/thickness.h"

namespace geomend::topology {

namespace {

constexpr double far_off = 10;         // diameters
constexpr double least_share = 1e-12;  // of the tolerance, along any axis

/// What is known of one cluster.
struct Cluster {
    std::vector<std::uint32_t> parts;
    Vec3 centroid{}, steps{};
    double radius = 0, edge = 0, flatness = 1;
};

/// The middle one of the three edges.
double middle_edge(const std::array<Vec3, 3>& t) {
    const auto square = [&](std::size_t i, std::size_t j) {
        const Vec3 d = minus(t[i], t[j]);
        return dot(d, d);
    };
    const double a = square(0, 1), b = square(1, 2), c = square(2, 0);
    return std::sqrt(std::max(std::min(a, b), std::min(std::max(a, b), c)));
}

/// The tolerance as given, or by rule (negative). \pre lengths.diameter is set
void set_tolerance(Lengths& lengths, double given, const Vec3& steps) {
    const double least = 1e-7 * lengths.diameter;
    lengths.tolerance = given >= 0 ? given : std::max(least, std::ranges::max(steps));
    if (given >= 0 || lengths.tolerance <= 0) return;
    for (std::size_t k = 0; k < 3; ++k) lengths.shares[k] = std::max(least_share, std::max(least, steps[k]) / lengths.tolerance);
}

/// Everything that lengths are worked out from.
class Survey {
public:
    explicit Survey(const Dataset& dataset) : dataset_(dataset), used_(used_points(dataset)), parts_(hanging_parts(used_)) {
        marks_ = find_outlying(used_, parts_);
        left_out_.resize(marks_.size());
        measure();
        if (take_back()) measure();
    }

    LocalLengths lengths(const LengthRules& rules) const;

private:
    const Dataset& dataset_;
    UsedPoints used_;
    HangingParts parts_;
    std::vector<Outlying> marks_;
    std::vector<std::uint8_t> left_out_;
    std::vector<PartExtent> extents_;
    std::vector<std::uint32_t> cluster_of_;  // per part
    std::vector<Cluster> clusters_;

    void measure();
    bool take_back();
    void measure_cluster(Cluster& cluster) const;
    std::vector<std::uint32_t> clusters_of_objects() const;
    std::vector<OutlyingPoint> outlying() const;

    double distance(const Cluster& cluster, std::uint32_t vertex) const {
        const Vec3 d = minus(used_.positions[vertex], cluster.centroid);
        return std::sqrt(dot(d, d));
    }
    const Cluster& cluster_of_vertex(std::uint32_t v) const { return clusters_[cluster_of_[parts_.of_vertex[v]]]; }

    template <class Visit>
    void each_triangle(const Cluster& cluster, const Visit& visit) const {
        for (const std::uint32_t p : cluster.parts) {
            for (const std::uint32_t t : parts_[p]) {
                const auto& corners = used_.triangles[t];
                if (left_out_[corners[0]] == 0 && left_out_[corners[1]] == 0 && left_out_[corners[2]] == 0) visit(t);
            }
        }
    }
};

void Survey::measure() {
    for (std::size_t v = 0; v < marks_.size(); ++v) left_out_[v] = marks_[v] != Outlying::no;
    extents_ = part_extents(dataset_, used_, parts_, left_out_);
    cluster_of_ = cluster_parts(used_, parts_, extents_, left_out_);
    clusters_.clear();
    for (std::uint32_t p = 0; p < cluster_of_.size(); ++p) {
        if (cluster_of_[p] >= clusters_.size()) clusters_.resize(cluster_of_[p] + 1);
        clusters_[cluster_of_[p]].parts.push_back(p);
    }
    parallel_for_each_index(clusters_.size(), [&](std::size_t c) { measure_cluster(clusters_[c]); });
}

/// What is far off for the part that it hangs together with, but not for the whole cluster, belongs to it.
bool Survey::take_back() {
    bool any = false;
    for (std::uint32_t v = 0; v < marks_.size(); ++v) {
        if (marks_[v] != Outlying::far) continue;
        const Cluster& cluster = cluster_of_vertex(v);
        if (distance(cluster, v) >= far_off * 2 * cluster.radius) continue;
        marks_[v] = Outlying::no;
        any = true;
    }
    return any;
}

void Survey::measure_cluster(Cluster& cluster) const {
    double weight = 0, count = 0;
    Vec3 weighted{}, plain{};
    const Vec3& origin = extents_[cluster.parts[0]].centroid;
    for (const std::uint32_t p : cluster.parts) {
        const PartExtent& part = extents_[p];
        if (part.empty) continue;
        const Vec3 d = minus(part.centroid, origin);
        weight += part.weight;
        count += 1;
        weighted = plus(weighted, times(part.weight, d));
        plain = plus(plain, d);
        const Vec3 steps = stored_steps(part);
        for (std::size_t k = 0; k < 3; ++k) cluster.steps[k] = std::max(cluster.steps[k], steps[k]);
    }
    if (count == 0) return;
    cluster.centroid = plus(origin, weight > 0 ? times(1 / weight, weighted) : times(1 / count, plain));
    std::size_t triangles = 0;
    for (const std::uint32_t p : cluster.parts) triangles += parts_[p].size();
    std::vector<std::pair<double, double>> edges;
    std::vector<std::array<Vec3, 3>> faces;
    edges.reserve(triangles);
    faces.reserve(triangles);
    each_triangle(cluster, [&](std::uint32_t t) {
        const auto corners = used_.corners(t);
        for (const Vec3& p : corners) {
            const Vec3 d = minus(p, cluster.centroid);
            cluster.radius = std::max(cluster.radius, dot(d, d));
        }
        if (!used_.is_weighted(t)) return;
        edges.emplace_back(middle_edge(corners), used_.weights[t]);
        if (used_.volumes[used_.object[t]].empty()) faces.push_back(corners);
    });
    cluster.radius = std::sqrt(cluster.radius);
    if (!edges.empty()) cluster.edge = weighted_quantile(edges, 0.5);
    cluster.flatness = flatness(slab_of(faces), 2 * cluster.radius);
}

/// Per object the cluster in which most of it is; of equal ones the largest.
std::vector<std::uint32_t> Survey::clusters_of_objects() const {
    std::vector<std::uint32_t> of(dataset_.objects.size(), no_index);
    for (std::uint32_t o = 0; o < of.size(); ++o) {
        std::map<std::uint32_t, double> weights;
        for (std::uint32_t t = used_.first_triangle[o]; t < used_.first_triangle[o + 1]; ++t) {
            const auto& corners = used_.triangles[t];
            const bool counts = std::ranges::none_of(corners, [&](std::uint32_t v) { return left_out_[v] != 0; });
            weights[cluster_of_[parts_.of_vertex[corners[0]]]] += counts ? used_.weights[t] : 0;
        }
        const auto larger = [&](const auto& a, const auto& b) {
            return std::pair(a.second, clusters_[a.first].radius) < std::pair(b.second, clusters_[b.first].radius);
        };
        if (!weights.empty()) of[o] = std::ranges::max_element(weights, larger)->first;
    }
    return of;
}

/// The points of objects at the positions of outlying vertices.
std::vector<OutlyingPoint> Survey::outlying() const {
    std::map<Vec3, std::uint32_t> at;
    for (std::uint32_t v = 0; v < marks_.size(); ++v) {
        if (marks_[v] != Outlying::no) at.emplace(used_.positions[v], v);
    }
    std::vector<OutlyingPoint> found;
    if (at.empty()) return found;
    for (std::uint32_t o = 0; o < dataset_.objects.size(); ++o) {
        const auto* surface = std::get_if<Surface>(&dataset_.objects[o]);
        const auto* mesh = std::get_if<CellMesh>(&dataset_.objects[o]);
        if (surface == nullptr && mesh == nullptr) continue;
        const auto& points = surface != nullptr ? surface->points : mesh->points;
        for (std::uint32_t p = 0; p < points.size(); ++p) {
            const auto v = at.find(points[p]);
            if (v == at.end()) continue;
            const Cluster& cluster = cluster_of_vertex(v->second);
            const double times = cluster.radius > 0 ? distance(cluster, v->second) / (2 * cluster.radius) : 0;
            found.push_back({o, p, times, marks_[v->second] == Outlying::usual});
        }
    }
    return found;
}

LocalLengths Survey::lengths(const LengthRules& rules) const {
    LocalLengths local;
    local.cluster_of = clusters_of_objects();
    local.outlying = outlying();
    std::vector<std::uint32_t> number(clusters_.size(), no_index);
    for (std::uint32_t& cluster : local.cluster_of) {
        if (cluster == no_index) continue;
        if (number[cluster] == no_index) {
            number[cluster] = static_cast<std::uint32_t>(local.clusters.size());
            const Cluster& c = clusters_[cluster];
            Lengths lengths;
            lengths.diameter = 2 * c.radius;
            set_tolerance(lengths, rules.tolerance, c.steps);
            lengths.flatness = c.flatness;
            double near = 1e-3 * c.flatness * lengths.diameter;
            if (c.edge > 0) near = std::min(near, c.edge / 4);
            lengths.near = rules.near >= 0 ? rules.near : std::max(10 * lengths.tolerance, near);
            local.clusters.push_back(lengths);
        }
        cluster = number[cluster];
    }
    for (const Lengths& lengths : local.clusters) {
        local.largest.diameter = std::max(local.largest.diameter, lengths.diameter);
        local.largest.tolerance = std::max(local.largest.tolerance, lengths.tolerance);
        local.largest.near = std::max(local.largest.near, lengths.near);
    }
    if (local.clusters.empty()) {
        local.largest.tolerance = std::max(0.0, rules.tolerance);
        local.largest.near = std::max(0.0, rules.near);
    }
    return local;
}

}  // namespace

std::vector<ModelSource> model_sources(const Dataset& dataset, const LocalLengths& lengths) {
    auto sources = sources_to_judge(dataset);
    for (ModelSource& source : sources) {
        std::map<std::pair<double, std::uint32_t>, WeldGroup> groups;
        const bool same = std::ranges::all_of(lengths.clusters, [&](const Lengths& l) {
            return l.tolerance == lengths.largest.tolerance && l.shares == lengths.clusters[0].shares;
        });
        for (const WeldGroup& group : source.groups) {
            for (const std::uint32_t o : group.objects) {
                const bool clustered = o < lengths.cluster_of.size() && lengths.cluster_of[o] != no_index, apart = clustered && !same;
                WeldGroup& to = groups[{lengths.of(o).tolerance, apart ? lengths.cluster_of[o] : no_index}];
                to.tolerance = lengths.of(o).tolerance;
                if (clustered) to.shares = lengths.of(o).shares;
                to.objects.push_back(o);
            }
        }
        source.groups.clear();
        for (auto& [key, group] : groups) source.groups.push_back(std::move(group));
    }
    return sources;
}

LocalLengths local_lengths(const Dataset& dataset, const LengthRules& rules) { return Survey(dataset).lengths(rules); }

}  // namespace geomend::topology
