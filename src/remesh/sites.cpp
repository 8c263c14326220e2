// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/sites.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/vectors.h"
#include "remesh/length.h"

namespace geomend::remeshing {

namespace {

constexpr unsigned tries_for_sites = 14;
constexpr double near_enough = 0.05;

/// Looks for the size that gives a wanted number of vertices: from a first guess up or down, by ever longer ways where the number hardly
/// changes, until sizes with too many and with too few are known; then between them.
class SizeSearch {
public:
    SizeSearch(double wanted, double first, double largest) : wanted_(wanted), at_(std::log(first)), largest_(std::log(largest)) {}

    double size() const { return std::exp(at_); }

    /// Takes the number that came of the size, and chooses the next one. \return whether there is another one worth a try
    bool take(double count) {
        const double excess = std::log(std::max(count, 0.5) / wanted_);
        (excess > 0 ? many_ : few_) = Try{at_, excess};
        if (many_.at > -HUGE_VAL && few_.at < HUGE_VAL) return go_between();
        way_ = std::min(std::max(std::abs(excess) / 2, 2 * way_), longest_way);  // numbers go with the inverse square of sizes
        if (excess > 0 && at_ >= largest_) return false;
        at_ = excess > 0 ? std::min(at_ + way_, largest_) : at_ - way_;
        return true;
    }

private:
    struct Try {
        double at, excess;  ///< logarithms of the size, and of the number by the wanted one
    };
    static constexpr double longest_way = 1.4, least_way = 0.01;  ///< of the logarithm of the size

    bool go_between() {
        if (few_.at - many_.at < least_way) return false;
        const double share = many_.excess / (many_.excess - few_.excess);
        halves_ = !halves_;  // every second time, as one end may stay for long otherwise
        at_ = many_.at + (few_.at - many_.at) * (halves_ ? std::clamp(share, 0.1, 0.9) : 0.5);
        return true;
    }

    double wanted_, at_, largest_, way_ = 0;
    bool halves_ = false;
    Try many_{-HUGE_VAL, 0}, few_{HUGE_VAL, 0};
};

/// The diagonal of the box around models.
double diagonal_of(std::span<const BrepData* const> models) {
    Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (const BrepData* model : models) {
        for (const Vec3& v : model->vertices) {
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], v[k]);
                high[k] = std::max(high[k], v[k]);
            }
        }
    }
    return length_of(minus(high, low));
}

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
    const double first = std::sqrt(2 * area / (std::sqrt(3.0) * wanted));
    SizeSearch search(wanted, first, std::max(first, 10 * diagonal_of(models)));
    std::vector<Remeshed> best;
    double best_miss = HUGE_VAL, best_size = first;
    for (unsigned tries = 0; tries < tries_for_sites; ++tries) {
        options.size = search.size();
        auto made = with_size(models, options);
        if (!made && !best.empty() && made.why().kind == FailureKind::limit) break;  // too small a size for all the triangles it makes
        if (!made) return made;
        double count = 0;
        for (const Remeshed& one : *made) count += static_cast<double>(vertices_of_surfaces(one.brep).inside);
        const double miss = std::abs(count - wanted) / wanted;
        if (miss < best_miss) {
            best = std::move(*made);
            best_size = options.size;
            best_miss = miss;
        }
        if (best_miss <= near_enough || !search.take(count)) break;
    }
    options.size = best_size;
    return best;
}

}  // namespace geomend::remeshing
