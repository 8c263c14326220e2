// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/sites.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/length.h"
#include "base/vectors.h"

namespace geomend::remeshing {

namespace {

constexpr unsigned tries_for_sites = 14;
constexpr double near_enough = 0.05;

/// Looks for the size that gives a wanted number of vertices: from a first guess up or down, by ever longer ways while the number comes
/// nearer or hardly changes, until sizes with too many and with too few are known; then between them. Where the number runs away (surfaces
/// that are too small for a size stay as they were, with all their vertices) it turns back, by ever shorter ways.
class SizeSearch {
public:
    SizeSearch(double wanted, double first, double largest) : wanted_(wanted), at_(std::log(first)), largest_(std::log(largest)) {}

    double size() const { return std::exp(at_); }

    /// Takes the number that came of the size, and chooses the next one. \return whether there is another one worth a try
    bool take(double count) {
        const Try now{at_, std::log(std::max(count, 0.5) / wanted_)};
        const bool is_many = now.excess > 0;
        if (direction_ == 0) {  // the first one
            direction_ = is_many ? 1 : -1;
            best_ = now;
            begins_many_ = is_many;
        }
        if (is_many != begins_many_) {
            beyond_ = now;
            has_both_ = true;
        } else if (has_both_) {
            best_ = now;
        } else {
            return go_on(now);
        }
        return go_between();
    }

private:
    struct Try {
        double at = 0, excess = 0;  ///< logarithms of the size, and of the number by the wanted one
    };
    static constexpr double longest_way = 1.4, shortest_way = 0.05, least_gap = 0.01, noise = 0.1;  ///< of these logarithms

    bool go_on(const Try& now) {
        const double miss = std::abs(now.excess), best_miss = std::abs(best_.excess);
        const bool runs_away = miss > best_miss + (has_turned_ ? 0 : noise);
        if (miss < best_miss) best_ = now;
        if (!runs_away && !has_turned_) way_ = std::min(std::max(miss / 2, 2 * way_), longest_way);  // sizes go with the root of numbers
        if (runs_away || (direction_ > 0 && now.at >= largest_)) {
            has_turned_ = true;
            direction_ = -direction_;
            way_ /= 2;
            if (way_ < shortest_way) return false;
        }
        at_ = std::min((runs_away ? best_.at : now.at) + direction_ * way_, largest_);
        return true;
    }

    bool go_between() {
        if (std::abs(beyond_.at - best_.at) < least_gap) return false;
        const double share = best_.excess / (best_.excess - beyond_.excess);
        halves_ = !halves_;  // every second time, as one end may stay for long otherwise
        at_ = best_.at + (beyond_.at - best_.at) * (halves_ ? std::clamp(share, 0.1, 0.9) : 0.5);
        return true;
    }

    double wanted_, at_, largest_, way_ = 0, direction_ = 0;
    bool begins_many_ = false, has_both_ = false, has_turned_ = false, halves_ = false;
    Try best_, beyond_;
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
    return length(minus(high, low));
}

double area_of(const BrepData& brep) {
    double area = 0;
    for (const auto& surface : brep.surfaces) {
        for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
            const auto polygon = surface.polygons[p];
            for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
                const auto place = [&](std::size_t i) { return brep.vertices[surface.nodes[polygon[i]].value]; };
                area += length(cross(minus(place(k), place(0)), minus(place(k + 1), place(0)))) / 2;
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
