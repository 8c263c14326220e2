// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/sites.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/vectors.h"
#include "remesh/length.h"

namespace geomend::remeshing {

namespace {

constexpr unsigned tries_for_sites = 6;
constexpr double near_enough = 0.05;

double area_of(const BrepData& brep) {
    double area = 0;
    for (const auto& surface : brep.surfaces) {
        for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
            const auto polygon = surface.polygons[p];
            for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
                const auto place = [&](std::size_t i) { return brep.vertices[surface.nodes[polygon[i]].value]; };
                area += length_of(cross(minus(place(k), place(0)), minus(place(k + 1), place(0)))) / 2;
            }
        }
    }
    return area;
}

Result<std::vector<Remeshed>> with_size(std::span<const BrepData* const> models, const RemeshOptions& options) {
    std::vector<Remeshed> made;
    for (const BrepData* model : models) {
        auto one = remesh_model(*model, options);
        if (!one) return std::move(one).why();
        made.push_back(std::move(*one));
    }
    return made;
}

}  // namespace

VertexCounts vertices_of_surfaces(const BrepData& brep) {
    std::vector<std::uint8_t> is_used(brep.vertices.size(), 0), on_line(brep.vertices.size(), 0);
    for (const auto& surface : brep.surfaces) {
        for (const VertexId v : surface.nodes) is_used[v.value] = 1;
    }
    for (const auto& corner : brep.corners) on_line[corner.vertex.value] = 1;
    for (const auto& line : brep.lines) {
        for (const VertexId v : line.vertices) on_line[v.value] = 1;
    }
    VertexCounts counts;
    for (std::size_t v = 0; v < is_used.size(); ++v) {
        counts.all += is_used[v];
        counts.inside += is_used[v] != 0 && on_line[v] == 0 ? 1 : 0;
    }
    return counts;
}

Result<std::vector<Remeshed>> remesh_models(std::span<const BrepData* const> models, RemeshOptions& options) {
    if (options.sites == 0) return with_size(models, options);
    double area = 0;
    for (const BrepData* model : models) area += area_of(*model);
    if (!(area > 0)) return failure(FailureKind::cannot_hold, "F026", {}, "the surfaces have no area");
    const auto wanted = static_cast<double>(options.sites);
    options.size = std::sqrt(2 * area / (std::sqrt(3.0) * wanted));
    std::vector<Remeshed> best;
    double best_miss = HUGE_VAL, best_size = options.size;
    for (unsigned tries = 0; tries < tries_for_sites; ++tries) {
        auto made = with_size(models, options);
        if (!made) return made;
        double count = 0;
        for (const Remeshed& one : *made) count += static_cast<double>(vertices_of_surfaces(one.brep).inside);
        const double miss = std::abs(count - wanted) / wanted;
        const bool better = miss < 0.95 * best_miss;
        if (miss < best_miss) {
            best = std::move(*made);
            best_size = options.size;
            best_miss = miss;
        }
        if (best_miss <= near_enough || !better) break;  // lines that are close need vertices whatever the size
        options.size *= std::clamp(std::sqrt(count / wanted), 0.3, 3.0);
    }
    options.size = best_size;
    return best;
}

}  // namespace geomend::remeshing
