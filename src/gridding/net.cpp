// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/net.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace geomend::gridding {

namespace {

/// Cosine and sine of an angle in degrees, exact for quarter turns.
std::array<double, 2> direction(double degrees) {
    const double turns = degrees / 90;
    if (turns == std::floor(turns)) {
        constexpr std::array<std::array<double, 2>, 4> axes = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
        return axes[static_cast<std::size_t>(((static_cast<long long>(turns) % 4) + 4) % 4)];
    }
    const double angle = degrees * std::numbers::pi / 180;
    return {std::cos(angle), std::sin(angle)};
}

}  // namespace

Net net_of(const Frame& frame, double upper, double lower) {
    Net net;
    net.cells = frame.cells;
    net.lines.resize(6 * net.pillar_count());
    const auto [c, s] = direction(frame.rotation);
    for (std::size_t j = 0; j <= frame.cells[1]; ++j) {
        for (std::size_t i = 0; i <= frame.cells[0]; ++i) {
            const double u = static_cast<double>(i) * frame.size[0], v = static_cast<double>(j) * frame.size[1];
            double* p = net.lines.data() + 6 * net.pillar(i, j);
            p[0] = p[3] = frame.origin[0] + (u * c - v * s);
            p[1] = p[4] = frame.origin[1] + (u * s + v * c);
            p[2] = upper;
            p[5] = lower;
        }
    }
    return net;
}

double dominant_strike(const std::vector<Path>& lines) {
    double c = 0, s = 0;
    for (const Path& line : lines) {
        for (std::size_t i = 1; i < line.size(); ++i) {
            const double x = line[i][0] - line[i - 1][0], y = line[i][1] - line[i - 1][1];
            const double angle = 4 * std::atan2(y, x);
            c += std::hypot(x, y) * std::cos(angle);
            s += std::hypot(x, y) * std::sin(angle);
        }
    }
    if (c == 0 && s == 0) return 0;
    const double angle = std::atan2(s, c) / 4 * 180 / std::numbers::pi;
    const double positive = angle < 0 ? angle + 90 : angle;
    return positive > 90 - 1e-9 || positive < 1e-9 ? 0 : positive;
}

TurnedBox box_around(const std::vector<Point>& points, double rotation) {
    const auto [c, s] = direction(rotation);
    std::array<double, 2> low{1e300, 1e300}, high{-1e300, -1e300};
    for (const Point& p : points) {
        const std::array<double, 2> q{p[0] * c + p[1] * s, p[1] * c - p[0] * s};
        for (std::size_t a = 0; a < 2; ++a) {
            low[a] = std::min(low[a], q[a]);
            high[a] = std::max(high[a], q[a]);
        }
    }
    return {{low[0] * c - low[1] * s, low[0] * s + low[1] * c}, {high[0] - low[0], high[1] - low[1]}};
}

SmallestBox smallest_box(const std::vector<Point>& points) {
    const Path hull = convex_hull(points);
    if (hull.size() < 3) return {};
    SmallestBox best;
    double least = 1e300;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const Point &a = hull[i], &b = hull[(i + 1) % hull.size()];
        double angle = std::atan2(b[1] - a[1], b[0] - a[0]) * 180 / std::numbers::pi;
        angle -= 90 * std::floor(angle / 90);
        if (angle > 90 - 1e-9 || angle < 1e-9) angle = 0;
        const auto box = box_around(hull, angle);
        const double area = box.size[0] * box.size[1];
        if (area < least * (1 - 1e-12)) {
            least = area;
            best = {angle, area_of(hull) / area};
        }
    }
    return best;
}

Path outline_of(const Net& net, double depth) {
    const std::size_t nx = net.cells[0], ny = net.cells[1];
    Path ring;
    for (std::size_t i = 0; i < nx; ++i) ring.push_back(net.at(net.pillar(i, 0), depth));
    for (std::size_t j = 0; j < ny; ++j) ring.push_back(net.at(net.pillar(nx, j), depth));
    for (std::size_t i = nx; i > 0; --i) ring.push_back(net.at(net.pillar(i, ny), depth));
    for (std::size_t j = ny; j > 0; --j) ring.push_back(net.at(net.pillar(0, j), depth));
    return ring;
}

double spacing_of(const Net& net, double depth) {
    double sum = 0;
    const std::size_t nx = net.cells[0], ny = net.cells[1];
    for (std::size_t j = 0; j <= ny; ++j) {
        for (std::size_t i = 0; i <= nx; ++i) {
            const Point p = net.at(net.pillar(i, j), depth);
            if (i < nx) sum += distance(p, net.at(net.pillar(i + 1, j), depth));
            if (j < ny) sum += distance(p, net.at(net.pillar(i, j + 1), depth));
        }
    }
    return sum / static_cast<double>(nx * (ny + 1) + ny * (nx + 1));
}

}  // namespace geomend::gridding
