// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/sampling.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "base/cell_number.h"
#include "base/length.h"
#include "base/parallel.h"
#include "base/vectors.h"

namespace geomend::hexes {

namespace {

using remeshing::EdgeMesh;
using remeshing::LineRules;
using remeshing::LineSample;
using remeshing::SurfacePoint;

constexpr double clear = 0.4999;  // of the least step, from borders
constexpr double apart = 0.45;    // of it, between points
constexpr double nothing = 1e-7;  // of an edge: nearer to a vertex than that a point is the vertex, since coordinates are rounded

std::size_t greatest(const Vec3& v) { return static_cast<std::size_t>(std::ranges::max_element(v) - v.begin()); }

/// Whole numbers from a to b, in that order, without the ends.
template <class Visit>
void visit_between(double a, double b, const Visit& visit) {
    if (a < b) {
        for (double k = std::floor(a) + 1; k < b; ++k) visit(k);
    } else {
        for (double k = std::ceil(a) - 1; k > b; --k) visit(k);
    }
}

/// A polyline with its way from the first point.
class Polyline {
public:
    explicit Polyline(std::span<const Vec3> points) : points_(points), way_(points.size(), 0) {
        for (std::size_t i = 1; i < points.size(); ++i) way_[i] = way_[i - 1] + length(minus(points[i], points[i - 1]));
    }
    double way(const LineSample& s) const {
        return s.share == 0 ? way_[s.segment] : way_[s.segment] + s.share * (way_[s.segment + 1] - way_[s.segment]);
    }
    LineSample at(double way) const {
        auto i = static_cast<std::size_t>(std::ranges::upper_bound(way_, way) - way_.begin());
        i = std::clamp<std::size_t>(i, 1, points_.size() - 1) - 1;
        const double length = way_[i + 1] - way_[i];
        const double share = length > 0 ? (way - way_[i]) / length : 0;
        return share >= 1 ? LineSample{static_cast<std::uint32_t>(i + 1), 0}
                          : LineSample{static_cast<std::uint32_t>(i), std::max(share, 0.0)};
    }
    std::size_t size() const { return points_.size(); }

private:
    std::span<const Vec3> points_;
    std::vector<double> way_;
};

/// The vertex itself where that is as good as there.
LineSample sample_at(std::uint32_t segment, double share) {
    if (share < nothing) return {segment, 0};
    return share > 1 - nothing ? LineSample{segment + 1, 0} : LineSample{segment, share};
}

/// Where a function of a share from 0 to 1 is 0. \pre it is above 0 at one end and below at the other, but for rounding
template <class Function>
double zero_of(const Function& function) {
    double low = 0, high = 1, at_low = function(low), at_high = function(high);
    constexpr double none = 1e-11;
    if (std::abs(at_low) < none) return low;
    if (std::abs(at_high) < none) return high;
    double share = low;
    constexpr int most_steps = 60;
    for (int step = 0; step < most_steps; ++step) {  // false position, by Illinois: an end that stays counts by half
        share = (low * at_high - high * at_low) / (at_high - at_low);
        const double value = function(share);
        if (std::abs(value) < none) break;
        if ((value > 0) != (at_high > 0)) {
            low = high;
            at_low = at_high;
        } else {
            at_low /= 2;
        }
        high = share;
        at_high = value;
    }
    return share;
}

/// Where an edge has a coordinate between those of its ends: levels need not change evenly along it, where layers narrow.
double share_at(const Lattice& lattice, const Vec3& from, const Vec3& to, std::size_t axis, double wanted) {
    const auto beside = [&](double share) { return lattice.coordinates(plus(from, times(share, minus(to, from))))[axis] - wanted; };
    if (lattice.layers && axis == 2) return zero_of(beside);
    const double a = beside(0), b = beside(1);
    return a / (a - b);
}

/// Crossings with the planes of the lattice, in order.
std::vector<LineSample> crossings_of(const Lattice& lattice, std::span<const Vec3> points) {
    std::vector<Vec3> at;
    for (const Vec3& p : points) at.push_back(lattice.coordinates(p));
    Vec3 run{};
    for (std::size_t i = 1; i < at.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) run[k] += std::abs(at[i][k] - at[i - 1][k]) * lattice.steps[k];
    }
    const std::size_t most = greatest(run);
    std::vector<LineSample> all;
    for (std::uint32_t i = 0; i + 1 < at.size(); ++i) {
        Vec3 own;
        for (std::size_t k = 0; k < 3; ++k) own[k] = std::abs(at[i + 1][k] - at[i][k]) * lattice.steps[k];
        const double size = length(own);
        const std::size_t axis = own[most] >= 0.5 * size ? most : greatest(own);
        const double a = at[i][axis], b = at[i + 1][axis];
        if (i > 0 && a == std::round(a)) all.push_back({i, 0});
        visit_between(a, b, [&](double k) { all.push_back(sample_at(i, share_at(lattice, points[i], points[i + 1], axis, k))); });
    }
    return all;
}

/// The point of a piece of the polyline that is farthest from the straight edge between two samples.
std::pair<double, std::uint32_t> farthest(std::span<const Vec3> points, const LineSample& from, const LineSample& to) {
    const Vec3 a = remeshing::place_of(points, from), b = remeshing::place_of(points, to), d = minus(b, a);
    const double square = dot(d, d);
    std::pair<double, std::uint32_t> most{0, no_index};
    for (std::uint32_t i = from.segment + 1; i <= to.segment && i < points.size(); ++i) {
        if (i == to.segment && to.share == 0) break;
        const Vec3 p = minus(points[i], a);
        const double along = square > 0 ? std::clamp(dot(p, d) / square, 0.0, 1.0) : 0;
        const double distance = length(minus(p, times(along, d)));
        if (distance > most.first) most = {distance, i};
    }
    return most;
}

/// Adds points of the polyline until the samples from one to another are near enough.
void add_near(std::span<const Vec3> points, const LineSample& from, const LineSample& to, double allowed, std::vector<LineSample>& all) {
    const auto [distance, i] = farthest(points, from, to);
    if (distance > allowed) {
        add_near(points, from, {i, 0}, allowed, all);
        add_near(points, {i, 0}, to, allowed, all);
    } else {
        all.push_back(to);
    }
}

/// Buckets of space in which points and edges are found.
template <class Thing>
class Buckets {
public:
    explicit Buckets(double side) : side_(side) {}

    void add(const Vec3& low, const Vec3& high, const Thing& thing) {
        visit(low, high, [&](std::vector<Thing>& bucket) { bucket.push_back(thing); });
    }
    const std::vector<Thing>& at(const Vec3& p) const {
        static const std::vector<Thing> none;
        const auto found = buckets_.find(key(number(p[0]), number(p[1]), number(p[2])));
        return found == buckets_.end() ? none : found->second;
    }

private:
    double side_;
    std::unordered_map<std::uint64_t, std::vector<Thing>> buckets_;

    std::int64_t number(double x) const { return cell_number(x / side_); }
    static std::uint64_t key(std::int64_t i, std::int64_t j, std::int64_t k) {
        constexpr std::uint64_t mask = (1u << 21) - 1;
        return (static_cast<std::uint64_t>(i) & mask) << 42 | (static_cast<std::uint64_t>(j) & mask) << 21 |
               (static_cast<std::uint64_t>(k) & mask);
    }
    template <class Visit>
    void visit(const Vec3& low, const Vec3& high, const Visit& visit) {
        for (std::int64_t i = number(low[0]); i <= number(high[0]); ++i) {
            for (std::int64_t j = number(low[1]); j <= number(high[1]); ++j) {
                for (std::int64_t k = number(low[2]); k <= number(high[2]); ++k) visit(buckets_[key(i, j, k)]);
            }
        }
    }
};

/// Space that is taken by borders of a surface and by points.
class Taken {
public:
    Taken(const EdgeMesh& surface, double step) : step_(step), origin_(surface.places.front()), edges_(step), points_(step) {
        for (std::uint32_t h = 0; h < surface.corners.size(); ++h) {
            if (surface.twins[h] != no_index) continue;
            // Long edges in pieces, so that few buckets hold them.
            const Vec3 a = minus(surface.places[surface.from(h)], origin_),
                       d = minus(surface.places[surface.to(h)], surface.places[surface.from(h)]);
            const double pieces = std::max(1.0, std::ceil(length(d) / step));
            for (double k = 0; k < pieces; ++k) {
                const Edge edge{plus(a, times(k / pieces, d)), plus(a, times((k + 1) / pieces, d))};
                const auto [low, high] = box_of(edge.from, edge.to, clear * step);
                edges_.add(low, high, edge);
            }
        }
    }
    void add(const Vec3& place) {
        const Vec3 p = minus(place, origin_);
        const auto [low, high] = box_of(p, p, apart * step_);
        points_.add(low, high, p);
    }
    bool is_free(const Vec3& place) const {
        const Vec3 p = minus(place, origin_);
        for (const Edge& edge : edges_.at(p)) {
            const Vec3 d = minus(edge.to, edge.from), q = minus(p, edge.from);
            const double square = dot(d, d);
            const double along = square > 0 ? std::clamp(dot(q, d) / square, 0.0, 1.0) : 0;
            if (length(minus(q, times(along, d))) < clear * step_) return false;
        }
        return std::ranges::all_of(points_.at(p), [&](const Vec3& other) { return length(minus(p, other)) >= apart * step_; });
    }

private:
    struct Edge {
        Vec3 from, to;
    };
    double step_;
    Vec3 origin_;
    Buckets<Edge> edges_;
    Buckets<Vec3> points_;

    static std::pair<Vec3, Vec3> box_of(const Vec3& a, const Vec3& b, double margin) {
        Vec3 low, high;
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(a[k], b[k]) - margin;
            high[k] = std::max(a[k], b[k]) + margin;
        }
        return {low, high};
    }
};

/// A triangle with its corners in the coordinates of a lattice.
struct TriangleOnLattice {
    const Lattice& lattice;
    std::array<Vec3, 3> places, at;

    Vec3 place(const Weights& weights) const {
        Vec3 p{};
        for (std::size_t k = 0; k < 3; ++k) p = plus(p, times(weights[k], places[k]));
        return p;
    }
};

/// Weights of the point of a triangle that has coordinates i, j along the axes a, b, if levels change evenly between its corners.
std::optional<Weights> even_weights_at(const TriangleOnLattice& triangle, std::size_t a, std::size_t b, double i, double j) {
    const auto& at = triangle.at;
    const double whole = (at[1][a] - at[0][a]) * (at[2][b] - at[0][b]) - (at[1][b] - at[0][b]) * (at[2][a] - at[0][a]);
    if (whole == 0) return std::nullopt;
    Weights weights{};
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 &p = at[(k + 1) % 3], &q = at[(k + 2) % 3];
        weights[k] = ((q[a] - p[a]) * (j - p[b]) - (q[b] - p[b]) * (i - p[a])) / whole;
    }
    return weights;
}

/// The same where layers narrow: on the straight line over a triangle on which another coordinate is i, at the level j.
std::optional<Weights> weights_at_level(const TriangleOnLattice& triangle, std::size_t axis, double i, double j) {
    constexpr double slack = 1e-9;
    std::array<Weights, 2> ends{};
    std::array<double, 2> levels{HUGE_VAL, -HUGE_VAL};  // the lowest and the highest of the line
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        const double p = triangle.at[k][axis] - i, q = triangle.at[next][axis] - i;
        if (std::min(p, q) > slack || std::max(p, q) < -slack) continue;
        const double share = std::abs(p - q) > slack ? std::clamp(p / (p - q), 0.0, 1.0) : 0;
        Weights weights{};
        weights[next] = share;
        weights[k] = 1 - share;
        const double level = triangle.lattice.coordinates(triangle.place(weights))[2];
        if (level < levels[0]) ends[0] = weights, levels[0] = level;
        if (level > levels[1]) ends[1] = weights, levels[1] = level;
    }
    if (!(levels[0] - slack <= j && j <= levels[1] + slack)) return std::nullopt;
    const auto mixed = [&](double share) {
        Weights weights{};
        for (std::size_t k = 0; k < 3; ++k) weights[k] = (1 - share) * ends[0][k] + share * ends[1][k];
        return weights;
    };
    if (j <= levels[0]) return ends[0];
    if (j >= levels[1]) return ends[1];
    return mixed(zero_of([&](double share) { return triangle.lattice.coordinates(triangle.place(mixed(share)))[2] - j; }));
}

/// Calls visit(weights) for each line of the lattice along an axis that crosses a triangle or touches it.
template <class Visit>
void visit_crossings(const TriangleOnLattice& triangle, std::size_t axis, const Visit& visit) {
    constexpr double slack = 1e-9;
    const auto& at = triangle.at;
    const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
    const bool uneven = triangle.lattice.layers && (a == 2 || b == 2);
    // Between its corners a triangle may be at higher or lower levels than they are.
    const auto beyond = [&](std::size_t k) { return k == 2 && uneven ? 0.5 : slack; };
    const auto low = [&](std::size_t k) { return std::ceil(std::min({at[0][k], at[1][k], at[2][k]}) - beyond(k)); };
    const auto high = [&](std::size_t k) { return std::floor(std::max({at[0][k], at[1][k], at[2][k]}) + beyond(k)); };
    const auto weights_at = [&](double i, double j) {
        if (!uneven) return even_weights_at(triangle, a, b, i, j);
        return a == 2 ? weights_at_level(triangle, b, j, i) : weights_at_level(triangle, a, i, j);
    };
    for (double i = low(a); i <= high(a); ++i) {
        for (double j = low(b); j <= high(b); ++j) {
            auto weights = weights_at(i, j);
            if (!weights || std::ranges::any_of(*weights, [&](double w) { return w < -slack; })) continue;
            double sum = 0;
            for (double& w : *weights) sum += w = w < nothing ? 0 : w;
            for (double& w : *weights) w /= sum;
            visit(*weights);
        }
    }
}

}  // namespace

std::vector<LineSample> lattice_line(const Lattice& lattice, std::span<const Vec3> points, const LineRules& rules) {
    std::vector<Vec3> at;
    for (const Vec3& p : points) at.push_back(lattice.coordinates(p));
    const Polyline line(at);  // its way is in steps, whatever their lengths
    std::vector<LineSample> stays;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        if (i == 0 || i + 1 == points.size() || (!rules.stays.empty() && rules.stays[i] != 0)) stays.push_back({i, 0});
    }
    const auto crossings = crossings_of(lattice, points);
    std::vector<LineSample> spaced{stays.front()};
    auto next = crossings.begin();
    const auto part_gap = [&](const LineSample& to) {
        const double from = line.way(spaced.back()), gap = line.way(to) - from;
        const double parts = std::round(gap);
        for (double k = 1; gap > 1.5 && k < parts; ++k) spaced.push_back(line.at(from + k * gap / parts));
        spaced.push_back(to);
    };
    for (std::size_t s = 1; s < stays.size(); ++s) {
        const double end = line.way(stays[s]);
        for (; next != crossings.end() && line.way(*next) < end; ++next) {
            const double way = line.way(*next);
            if (way - line.way(spaced.back()) >= clear && end - way >= clear) part_gap(*next);
        }
        part_gap(stays[s]);
    }
    while (spaced.size() <= rules.fewest && line.way(spaced.back()) > 0) {  // the longest gap in two
        std::size_t longest = 0;
        for (std::size_t k = 1; k + 1 < spaced.size(); ++k) {
            if (line.way(spaced[k + 1]) - line.way(spaced[k]) > line.way(spaced[longest + 1]) - line.way(spaced[longest])) longest = k;
        }
        const double middle = (line.way(spaced[longest]) + line.way(spaced[longest + 1])) / 2;
        spaced.insert(spaced.begin() + static_cast<std::ptrdiff_t>(longest) + 1, line.at(middle));
    }
    std::vector<LineSample> all{spaced.front()};
    for (std::size_t k = 1; k < spaced.size(); ++k) add_near(points, spaced[k - 1], spaced[k], rules.max_distance, all);
    return all;
}

std::vector<SurfacePoint> lattice_surface(const Lattice& lattice, const EdgeMesh& surface, std::span<const Vec3> taken) {
    std::vector<SurfacePoint> points;
    if (surface.places.empty()) return points;
    std::vector<Vec3> at;
    for (const Vec3& p : surface.places) at.push_back(lattice.coordinates(p));
    const auto corners = [&](std::uint32_t t) {
        const std::size_t c = 3 * std::size_t{t};
        return std::array<Vec3, 3>{at[surface.corners[c]], at[surface.corners[c + 1]], at[surface.corners[c + 2]]};
    };
    // Areas that triangles show along each axis.
    const auto shown = [&](std::uint32_t t) {
        const auto p = corners(t);
        const Vec3 n = cross(minus(p[1], p[0]), minus(p[2], p[0]));
        const Vec3& s = lattice.steps;
        return Vec3{std::abs(n[0]) * s[1] * s[2], std::abs(n[1]) * s[2] * s[0], std::abs(n[2]) * s[0] * s[1]};
    };
    Vec3 sum{};
    for (std::uint32_t t = 0; t < surface.triangle_count(); ++t) {
        if (const Vec3 own = shown(t); length(own) > 0) {
            for (std::size_t k = 0; k < 3; ++k) sum[k] += own[k] * own[k] / length(own);
        }
    }
    const std::size_t most = greatest(sum);
    Taken space(surface, lattice.least_step());
    for (const Vec3& p : taken) space.add(p);
    for (const bool steep : {false, true}) {
        for (std::uint32_t t = 0; t < surface.triangle_count(); ++t) {
            const Vec3 own = shown(t);
            if ((own[most] < 0.5 * length(own)) != steep) continue;
            const std::size_t c = 3 * std::size_t{t};
            const TriangleOnLattice triangle{
                lattice,
                {surface.places[surface.corners[c]], surface.places[surface.corners[c + 1]], surface.places[surface.corners[c + 2]]},
                corners(t)};
            visit_crossings(triangle, steep ? greatest(own) : most, [&](const Weights& weights) {
                const SurfacePoint point = remeshing::point_at(surface, t, weights);
                if (!space.is_free(point.place)) return;
                space.add(point.place);
                points.push_back(point);
            });
        }
    }
    return points;
}

RegionLattices region_lattices(const BrepData& brep, std::span<const volumes::RegionFacets> regions, const Lattice& common) {
    RegionLattices made;
    made.common = common;
    made.of_region.assign(brep.regions.size(), common);
    made.of_surface.assign(brep.surfaces.size(), no_index);
    made.of_line.assign(brep.lines.size(), no_index);
    parallel_for_each_index(regions.size(), [&](std::size_t r) {
        if (regions[r].region < brep.regions.size()) made.of_region[regions[r].region] = lattice_of_region(regions[r], common);
    });
    for (const volumes::RegionFacets& facets : regions) {
        if (facets.region >= brep.regions.size() || !made.of_region[facets.region].layers) continue;
        for (const std::uint32_t s : facets.surfaces) made.of_surface[s] = std::min(made.of_surface[s], facets.region);
    }
    for (std::size_t s = 0; s < brep.surfaces.size(); ++s) {
        for (const auto& use : brep.surfaces[s].lines)
            made.of_line[use.line.value] = std::min(made.of_line[use.line.value], made.of_surface[s]);
    }
    return made;
}

remeshing::Pattern lattice_pattern(const RegionLattices& lattices) {
    remeshing::Pattern pattern;
    pattern.on_line = [&](std::uint32_t line, std::span<const Vec3> points, const LineRules& rules) {
        return lattice_line(lattices.at(line < lattices.of_line.size() ? lattices.of_line[line] : no_index), points, rules);
    };
    pattern.on_surface = [&](std::uint32_t surface, const EdgeMesh& mesh, std::span<const Vec3> taken) {
        return lattice_surface(lattices.at(surface < lattices.of_surface.size() ? lattices.of_surface[surface] : no_index), mesh, taken);
    };
    pattern.straightened = [&](std::uint32_t surface, std::span<const Vec3> places) {
        return along_layers(lattices.at(surface < lattices.of_surface.size() ? lattices.of_surface[surface] : no_index), places);
    };
    pattern.is_better = [&](std::uint32_t surface, const Vec3& from, const Vec3& to) {
        const Lattice& lattice = lattices.at(surface < lattices.of_surface.size() ? lattices.of_surface[surface] : no_index);
        const Vec3 d = minus(lattice.coordinates(to), lattice.coordinates(from));
        const Vec3 along{std::abs(d[0]), std::abs(d[1]), std::abs(d[2])};
        const auto least = static_cast<std::size_t>(std::ranges::min_element(along) - along.begin());
        return d[(least + 1) % 3] * d[(least + 2) % 3] > 0;
    };
    return pattern;
}

}  // namespace geomend::hexes
