// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/smooth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace geomend::gridding {

std::array<double, 3> half_cotangents(const Point& a, const Point& b, const Point& c) {
    const auto at = [](const Point& p, const Point& q, const Point& r) {
        const double ux = q[0] - p[0], uy = q[1] - p[1], vx = r[0] - p[0], vy = r[1] - p[1];
        return (ux * vx + uy * vy) / (2 * std::abs(ux * vy - uy * vx));
    };
    return {at(a, b, c), at(b, c, a), at(c, a, b)};
}

DirichletWeights::DirichletWeights(std::span<const Point> places, std::span<const PlanTriangle> triangles) {
    struct Entry {
        std::uint32_t from, to;
        double weight;
    };
    std::vector<Entry> entries;
    entries.reserve(6 * triangles.size());
    for (const PlanTriangle& t : triangles) {
        const auto g = half_cotangents(places[t[0]], places[t[1]], places[t[2]]);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t p = t[(k + 1) % 3], q = t[(k + 2) % 3];
            entries.push_back({p, q, g[k]});
            entries.push_back({q, p, g[k]});
        }
    }
    std::ranges::stable_sort(entries, [](const Entry& a, const Entry& b) { return a.from != b.from ? a.from < b.from : a.to < b.to; });
    first_.assign(places.size() + 1, 0);
    sums_.assign(places.size(), 0);
    for (std::size_t e = 0; e < entries.size(); ++e) {
        sums_[entries[e].from] += entries[e].weight;
        if (e > 0 && entries[e].from == entries[e - 1].from && entries[e].to == entries[e - 1].to) {
            weights_.back() += entries[e].weight;
            continue;
        }
        ++first_[entries[e].from + std::size_t{1}];
        next_.push_back(entries[e].to);
        weights_.push_back(entries[e].weight);
    }
    for (std::size_t v = 0; v < places.size(); ++v) first_[v + 1] += first_[v];
}

double DirichletWeights::weight(std::uint32_t a, std::uint32_t b) const {
    for (std::uint64_t e = first_[a]; e < first_[a + std::size_t{1}]; ++e) {
        if (next_[e] == b) return weights_[e];
    }
    return 0;
}

std::uint64_t DirichletWeights::negative() const {
    return static_cast<std::uint64_t>(std::ranges::count_if(weights_, [](double w) { return w < -1e-12; })) / 2;
}

double DirichletWeights::energy(std::span<const double> values) const {
    double sum = 0;
    for (std::size_t v = 0; v < values.size(); ++v) {
        for (std::uint64_t e = first_[v]; e < first_[v + 1]; ++e) {
            const double d = values[next_[e]] - values[v];
            sum += weights_[e] * d * d;
        }
    }
    return sum / 2;  // each edge was met from both ends
}

void DirichletWeights::make_harmonic(std::span<const std::uint8_t> fixed, std::span<double> values) const {
    const std::size_t n = values.size();
    double largest = 0;
    for (std::size_t v = 0; v < n; ++v) largest = std::max(largest, fixed[v] != 0 ? std::abs(values[v]) : 0.0);
    if (largest == 0) {
        for (std::size_t v = 0; v < n; ++v) values[v] = 0;
        return;
    }
    // The residual of the equation at free vertices.
    const auto apply = [&](std::span<const double> x, std::span<double> out) {
        for (std::size_t v = 0; v < n; ++v) {
            out[v] = 0;
            if (fixed[v] != 0) continue;
            double sum = 0;
            for (std::uint64_t e = first_[v]; e < first_[v + 1]; ++e) sum += weights_[e] * (x[v] - x[next_[e]]);
            out[v] = sum;
        }
    };
    std::vector<double> r(n), z(n), p(n), q(n);
    apply(values, r);
    for (double& x : r) x = -x;
    const auto scale = [&] {
        for (std::size_t v = 0; v < n; ++v) z[v] = fixed[v] != 0 ? 0 : r[v] / std::max(sums_[v], 1e-300);
    };
    const auto product = [&](const std::vector<double>& a, const std::vector<double>& b) {
        double sum = 0;
        for (std::size_t v = 0; v < n; ++v) sum += a[v] * b[v];
        return sum;
    };
    scale();
    p = z;
    double rz = product(r, z);
    for (std::size_t round = 0; round < 20 * n + 100 && rz > 0; ++round) {
        double most = 0;
        for (const double x : z) most = std::max(most, std::abs(x));
        if (most <= 1e-14 * largest) break;
        apply(p, q);
        const double alpha = rz / product(p, q);
        for (std::size_t v = 0; v < n; ++v) {
            values[v] += alpha * p[v];
            r[v] -= alpha * q[v];
        }
        scale();
        const double next = product(r, z);
        for (std::size_t v = 0; v < n; ++v) p[v] = z[v] + next / rz * p[v];
        rz = next;
    }
}

std::vector<PlanTriangle> net_triangles(std::uint32_t nx, std::uint32_t ny) {
    std::vector<PlanTriangle> triangles;
    triangles.reserve(std::size_t{2} * nx * ny);
    const std::uint32_t row = nx + 1;
    for (std::uint32_t j = 0; j < ny; ++j) {
        for (std::uint32_t i = 0; i < nx; ++i) {
            const std::uint32_t a = i + row * j;
            triangles.push_back({a, a + 1, a + row + 1});
            triangles.push_back({a, a + row + 1, a + row});
        }
    }
    return triangles;
}

double right_angledness(const std::array<Point, 4>& p) {
    double least = std::numbers::pi;
    double turned = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const Point &a = p[(k + 3) % 4], &b = p[k], &c = p[(k + 1) % 4];
        const double ux = c[0] - b[0], uy = c[1] - b[1], vx = a[0] - b[0], vy = a[1] - b[1];
        const double side = ux * vy - uy * vx;
        if (side == 0 || turned * side < 0) return 0;
        turned = side;
        least = std::min(least, std::atan2(std::abs(side), ux * vx + uy * vy));
    }
    return std::clamp(least / (std::numbers::pi / 2), 0.0, 1.0);
}

std::uint32_t relax_border(std::vector<Path>& levels, std::span<const std::uint8_t> fixed, double step, double enough) {
    constexpr std::uint32_t most_rounds = 10000;
    const std::size_t count = levels.empty() ? 0 : levels[0].size();
    std::uint32_t round = 0;
    for (double most = enough + 1; most > enough && round < most_rounds; ++round) {
        most = 0;
        const auto before = levels;
        for (std::size_t l = 0; l < count; ++l) {
            if (fixed[l] != 0) continue;
            Point mean{};
            for (const Path& level : before) {
                for (std::size_t a = 0; a < 2; ++a)
                    mean[a] += (level[(l + count - 1) % count][a] + level[(l + 1) % count][a]) / (2 * static_cast<double>(levels.size()));
            }
            for (std::size_t h = 0; h < levels.size(); ++h) {
                for (std::size_t a = 0; a < 2; ++a) {
                    const double move = step * (mean[a] - before[h][l][a]);
                    levels[h][l][a] += move;
                    most = std::max(most, std::abs(move));
                }
            }
        }
    }
    return round;
}

}  // namespace geomend::gridding
