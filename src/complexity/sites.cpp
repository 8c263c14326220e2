// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/parallel.h"
#include "complexity/parts.h"
#include "geometry/site_grid.h"

// Sites whose Voronoi cells divide a model's volume evenly: Lloyd's iterations over points that fill it.

namespace geomend::complexity {

namespace {

// Points for each site: fewer where there are many sites, because time goes with points and iterations.
double sample_count(double sites) { return std::min(100 * sites, std::max(20 * sites, 200000.0)); }

// A fixed sequence: the same cells in every run. (SplitMix64 of Steele, Lea and Flood 2014.)
std::uint64_t mixed(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

double fraction(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    return static_cast<double>(mixed(mixed(mixed(a) ^ b) ^ c) >> 11) * 0x1p-53;
}

// Upright rays, one in each square of a lattice, each at a place of its own in its square.
class Rays {
public:
    Rays(const MeasuredModel& model, double step) : height_(step * step * step) {
        constexpr double far = std::numeric_limits<double>::max();
        low_ = {far, far, far};
        Vec3 high{-far, -far, -far};
        for (const Vec3& p : model.points) {
            for (std::size_t a = 0; a < 3; ++a) {
                low_[a] = std::min(low_[a], p[a]);
                high[a] = std::max(high[a], p[a]);
            }
        }
        // A model as flat as a leaf or as thin as a thread has more squares than points: they are made larger.
        const double width = high[0] - low_[0], depth = high[1] - low_[1];
        step_ = std::max({step, std::sqrt(width / most_rays * depth), width / most_rays, depth / most_rays});
        if (!std::isfinite(step_) || !(step_ > 0) || !(height_ > 0)) return;
        for (std::size_t a = 0; a < 2; ++a) dims_[a] = static_cast<std::int64_t>((high[a] - low_[a]) / step_) + 1;
        height_ /= step_ * step_;
        hits_.resize(static_cast<std::size_t>(dims_[0] * dims_[1]));
    }

    void cast(const MeasuredModel& model) {
        for (std::size_t s = 0; s < model.surfaces.size(); ++s) {
            const auto& regions = model.brep.surfaces[s].regions;
            for (const auto& t : model.surfaces[s].triangles) cast(model, t, regions);
        }
    }

    /// None where there would be more than `most`: the regions' volumes are not those that their sides enclose.
    std::vector<Vec3> points_inside(double most) {
        std::vector<Vec3> points;
        for (std::size_t ray = 0; ray < hits_.size(); ++ray) {
            if (static_cast<double>(points.size()) > most) return {};
            auto& hits = hits_[ray];
            std::ranges::stable_sort(hits, {}, &Hit::z);
            for (std::size_t h = 0; h + 1 < hits.size(); ++h) {
                if (!hits[h].above.valid() || hits[h].above != hits[h + 1].below) continue;
                if ((hits[h + 1].z - hits[h].z) / height_ > most) return {};
                fill(ray, hits[h].z, hits[h + 1].z, points);
            }
        }
        return points;
    }

private:
    struct Hit {
        double z;
        RegionId below, above;
    };

    Vec3 place(std::int64_t i, std::int64_t j) const {
        const auto a = static_cast<std::uint64_t>(i), b = static_cast<std::uint64_t>(j);
        return {low_[0] + (static_cast<double>(i) + fraction(a, b, 1)) * step_,
                low_[1] + (static_cast<double>(j) + fraction(a, b, 2)) * step_, 0};
    }

    // Twice the area of a, b and p seen from above; the same number with the other sign for the triangle across.
    static double turn(const MeasuredModel& model, std::uint32_t a, std::uint32_t b, const Vec3& p) {
        if (a > b) return -turn(model, b, a, p);
        const Vec3 &u = model.points[a], &v = model.points[b];
        const double area = (v[0] - u[0]) * (p[1] - u[1]) - (v[1] - u[1]) * (p[0] - u[0]);
        return area == 0 ? std::numeric_limits<double>::min() : area;
    }

    void cast(const MeasuredModel& model, const std::array<std::uint32_t, 3>& t, const std::array<RegionId, 2>& regions) {
        const Vec3 normal = model.area_vector(t);
        if (normal[2] == 0 || !std::isfinite(normal[2]) || hits_.empty()) return;
        std::array<std::int64_t, 2> first, last;
        for (std::size_t a = 0; a < 2; ++a) {
            const auto [least, most] = std::minmax({model.points[t[0]][a], model.points[t[1]][a], model.points[t[2]][a]});
            first[a] = std::max<std::int64_t>(0, static_cast<std::int64_t>((least - low_[a]) / step_));
            last[a] = std::min(dims_[a] - 1, static_cast<std::int64_t>((most - low_[a]) / step_));
        }
        const bool up = normal[2] > 0;
        for (std::int64_t j = first[1]; j <= last[1]; ++j) {
            for (std::int64_t i = first[0]; i <= last[0]; ++i) {
                const Vec3 p = place(i, j);
                const bool a = turn(model, t[0], t[1], p) > 0, b = turn(model, t[1], t[2], p) > 0, c = turn(model, t[2], t[0], p) > 0;
                if (a != b || b != c) continue;
                const Vec3& o = model.points[t[0]];
                const double z = o[2] - (normal[0] * (p[0] - o[0]) + normal[1] * (p[1] - o[1])) / normal[2];
                hits_[static_cast<std::size_t>(i + dims_[0] * j)].push_back({z, regions[up ? 0 : 1], regions[up ? 1 : 0]});
            }
        }
    }

    // One point in each step of height, at a place of its own.
    void fill(std::size_t ray, double from, double to, std::vector<Vec3>& points) const {
        const auto i = static_cast<std::int64_t>(ray) % dims_[0], j = static_cast<std::int64_t>(ray) / dims_[0];
        Vec3 p = place(i, j);
        const double begin = std::floor((from - low_[2]) / height_);
        for (double k = std::max(0.0, begin); low_[2] + k * height_ < to; ++k) {
            p[2] = low_[2] + (k + fraction(ray, static_cast<std::uint64_t>(k), 3)) * height_;
            if (p[2] >= from && p[2] < to) points.push_back(p);
        }
    }

    static constexpr double most_rays = 4e6;
    double step_ = 1, height_;  ///< of a square, and between points of a ray
    Vec3 low_{};
    std::array<std::int64_t, 2> dims_{};
    std::vector<std::vector<Hit>> hits_;
};

std::vector<Vec3> some_of(std::vector<Vec3> points, std::size_t count) {
    count = std::min(count, points.size());
    for (std::size_t i = 0; i < count; ++i) std::swap(points[i], points[i + mixed(i) % (points.size() - i)]);
    points.resize(count);
    return points;
}

// Each site goes to the middle of the points that are nearest to it.
void even_out(std::span<const Vec3> points, std::vector<Vec3>& sites) {
    const SiteGrid grid(sites);
    std::vector<std::uint32_t> owner(points.size());
    parallel_blocks(points.size(), 4096, [&](std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p) owner[p] = grid.nearest(points[p]);
    });
    std::vector<Vec3> sums(sites.size());
    std::vector<std::uint32_t> counts(sites.size());
    for (std::size_t p = 0; p < points.size(); ++p) {
        ++counts[owner[p]];
        sums[owner[p]] = moved(sums[owner[p]], points[p]);
    }
    for (std::size_t s = 0; s < sites.size(); ++s) {
        if (counts[s] > 0) sites[s] = {sums[s][0] / counts[s], sums[s][1] / counts[s], sums[s][2] / counts[s]};
    }
}

}  // namespace

std::vector<Vec3> volume_sites(const MeasuredModel& model, const ComplexityOptions& options) {
    const double samples = sample_count(options.sites);
    Rays rays(model, std::cbrt(model.volume / samples));
    rays.cast(model);
    const std::vector<Vec3> points = rays.points_inside(4 * samples + 1000);
    std::vector<Vec3> sites = some_of(points, options.sites);
    for (std::uint32_t i = 0; i < options.iterations && !sites.empty(); ++i) {
        if (options.monitor != nullptr) {
            if (options.monitor->stopped()) break;
            options.monitor->progress("complexity", 0.9 * i / options.iterations);
        }
        even_out(points, sites);
    }
    return sites;
}

}  // namespace geomend::complexity
