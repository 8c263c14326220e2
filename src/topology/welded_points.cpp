// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/welded_points.h"

#include <algorithm>
#include <numeric>

#include "topology/near_weld.h"

namespace geomend::topology {

namespace {

constexpr std::size_t most_positions = 100;

const std::vector<Vec3>& points_of(const Object& object) {
    if (const auto* mesh = std::get_if<CellMesh>(&object)) return mesh->points;
    return std::get<Surface>(object).points;
}

const std::vector<std::uint32_t>& alias_of(const Object& object) {
    if (const auto* mesh = std::get_if<CellMesh>(&object)) return mesh->alias;
    return std::get<Surface>(object).alias;
}

/// The vertices of some objects, ascending.
std::vector<std::uint32_t> vertices_of(const WeldedPoints& welded, std::span<const std::uint32_t> objects) {
    std::vector<std::uint32_t> vertices;
    for (const std::uint32_t o : objects) vertices.insert(vertices.end(), welded.of.at(o).begin(), welded.of.at(o).end());
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

/// The clusters of positions within the tolerance of a group: of positions that are drawn out along each axis where only a part
/// of it holds.
std::vector<std::uint32_t> clusters_of_group(const WeldGroup& group, std::span<const Vec3> positions) {
    if (group.shares == Vec3{1, 1, 1}) return clusters_within(positions, group.tolerance);
    std::vector<Vec3> drawn_out(positions.begin(), positions.end());
    for (Vec3& p : drawn_out) {
        for (std::size_t k = 0; k < 3; ++k) p[k] /= group.shares[k];
    }
    return clusters_within(drawn_out, group.tolerance);
}

/// Gives vertices of a group that are nearer than its tolerance to others the number of the first of them.
void weld_near(const WeldGroup& group, bool alone, WeldedPoints& welded) {
    const auto& positions = welded.welder.positions();
    std::vector<std::uint32_t> vertices, first;
    if (alone) {
        first = clusters_of_group(group, positions);
    } else {
        vertices = vertices_of(welded, group.objects);
        std::vector<Vec3> own;
        own.reserve(vertices.size());
        for (const std::uint32_t v : vertices) own.push_back(positions[v]);
        first = clusters_of_group(group, own);
    }
    for (std::uint32_t i = 0; i < first.size(); ++i) {
        if (first[i] == i) continue;
        const std::uint32_t from = alone ? i : vertices[i];
        if (welded.near.empty()) {
            welded.near.resize(positions.size());
            std::iota(welded.near.begin(), welded.near.end(), 0u);
        }
        welded.near[from] = alone ? first[i] : vertices[first[i]];
        ++welded.near_welded;
        if (welded.near_positions.size() < most_positions) welded.near_positions.push_back(positions[from]);
    }
}

}  // namespace

std::uint32_t WeldedPoints::at(const Vec3& position) const {
    const std::uint32_t v = welder.find(position);
    return v == no_index || near.empty() ? v : near[v];
}

WeldedPoints weld_points(const Dataset& dataset, std::span<const WeldGroup> groups) {
    std::vector<std::uint32_t> objects;
    WeldedPoints welded;
    for (const WeldGroup& group : groups) {
        objects.insert(objects.end(), group.objects.begin(), group.objects.end());
        for (const std::uint32_t o : group.objects) welded.tolerance.emplace(o, group.tolerance);
    }
    std::sort(objects.begin(), objects.end());
    objects.erase(std::unique(objects.begin(), objects.end()), objects.end());
    std::size_t total = 0;
    for (const std::uint32_t o : objects) total += points_of(dataset.objects[o]).size();
    welded.welder = Welder(total);
    welded.points = total;
    for (const std::uint32_t o : objects) {
        const auto& points = points_of(dataset.objects[o]);
        auto& vertices = welded.of[o];
        vertices.reserve(points.size());
        for (const Vec3& p : points) vertices.push_back(welded.welder.add(p));
        const auto& alias = alias_of(dataset.objects[o]);
        welded.aliases += static_cast<std::uint64_t>(alias.size() - std::ranges::count(alias, no_index));
    }
    for (const WeldGroup& group : groups) {
        if (group.tolerance > 0) weld_near(group, groups.size() == 1, welded);
    }
    if (!welded.near.empty()) {
        for (auto& [object, vertices] : welded.of) {
            for (std::uint32_t& v : vertices) v = welded.near[v];
        }
    }
    return welded;
}

void give_vertices(WeldedPoints& points, SurfaceComplex& complex) {
    complex.vertices = points.welder.take_positions();
    complex.points_welded = points.near_welded;
    complex.welded_positions = std::move(points.near_positions);
}

void report_welding(const WeldedPoints& points, SurfaceComplex& complex) {
    const std::uint64_t welded = points.points - points.welder.positions().size();
    if (welded == 0) return;
    Finding finding = make_finding("F111", std::to_string(welded) + " points at positions of others were welded at zero distance", {}, 0);
    if (points.aliases > 0) finding.message += " (" + std::to_string(points.aliases) + " of them are stated as such)";
    if (!complex.name.empty()) finding.entities.push_back({"model", complex.name, -1});
    finding.count = welded;
    finding.element_kind = "point";
    complex.findings.push_back(std::move(finding));
}

}  // namespace geomend::topology
