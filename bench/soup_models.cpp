// SPDX-License-Identifier: AGPL-3.0-or-later
#include "soup_models.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "base/input.h"
#include "formats/gocad/read_gocad.h"
#include "geometry/vectors.h"
#include "topology/weld.h"

namespace geomend::bench {

namespace {

template <class Place>
void add_sheet(Soup& soup, std::uint32_t n, const Place& place) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    const std::uint32_t group = soup.groups.empty() ? 0 : soup.groups.back() + 1;
    for (std::uint32_t j = 0; j <= n; ++j) {
        for (std::uint32_t i = 0; i <= n; ++i) soup.vertices.push_back(place(double(i) / n, double(j) / n));
    }
    for (std::uint32_t j = 0; j < n; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = first + j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            soup.triangles.insert(soup.triangles.end(), {{a, b, d}, {a, d, c}});
            soup.groups.insert(soup.groups.end(), {group, group});
        }
    }
}

}  // namespace

Borders free_borders(const Soup& soup) {
    std::vector<std::pair<std::array<std::uint32_t, 2>, std::uint32_t>> uses;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [p, q] = std::minmax(soup.triangles[t][i], soup.triangles[t][(i + 1) % 3]);
            uses.push_back({{p, q}, soup.groups[t]});
        }
    }
    std::sort(uses.begin(), uses.end());
    Borders borders;
    for (std::size_t i = 0; i < uses.size(); ++i) {
        const bool again = (i > 0 && uses[i - 1].first == uses[i].first) || (i + 1 < uses.size() && uses[i + 1].first == uses[i].first);
        if (again) continue;
        borders.edges.push_back(uses[i].first);
        borders.groups.push_back(uses[i].second);
    }
    return borders;
}

double near_length(const Soup& soup) {
    Vec3 centre{};
    for (const Vec3& p : soup.vertices) centre = plus(centre, times(1.0 / double(soup.vertices.size()), p));
    double largest = 0;
    for (const Vec3& p : soup.vertices) largest = std::max(largest, dot(minus(p, centre), minus(p, centre)));
    return 1e-3 * 2 * std::sqrt(largest);
}

Soup crossed_folds(std::size_t triangles) {
    Soup soup;
    const auto n = static_cast<std::uint32_t>(std::sqrt(double(triangles) / 2 / 12));
    for (int k = 0; k < 8; ++k) {
        add_sheet(soup, n, [k](double u, double v) {
            return Vec3{5000 * u, 5000 * v, 200 * k + 60 * std::sin(9 * u + 0.3 * k) + 50 * std::cos(11 * v)};
        });
    }
    for (int k = 0; k < 4; ++k) {
        add_sheet(soup, n, [k](double u, double v) {
            return Vec3{700 + 1100 * k + 500 * v + 40 * std::sin(7 * u), -13 + 5026 * u, -300 + 2000 * v};
        });
    }
    return soup;
}

Soup copies_of(const std::string& path, std::size_t copies, double spacing) {
    Soup once;
    const auto input = Input::open(path);
    if (!input) return once;
    const auto data = gocad::read_gocad(*input, {});
    if (!data) return once;
    topology::Welder welder(1024);
    std::uint32_t group = 0;
    for (const Object& object : data->objects) {
        const auto* surface = std::get_if<Surface>(&object);
        if (surface == nullptr) continue;
        for (std::size_t i = 0, part = 0; i < surface->polygons.size(); ++i) {
            while (part + 1 < surface->parts.size() && i >= surface->parts[part + 1].first_polygon) ++part;
            const auto polygon = surface->polygons[i];
            Triangle t{};
            for (std::size_t k = 0; k < 3; ++k) t[k] = welder.add(surface->points[polygon[k]]);
            once.triangles.push_back(t);
            once.groups.push_back(group + static_cast<std::uint32_t>(part));
        }
        group += static_cast<std::uint32_t>(std::max<std::size_t>(1, surface->parts.size()));
    }
    once.vertices = welder.take_positions();
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Vec3& p : once.vertices) low = std::min(low, p[0]), high = std::max(high, p[0]);
    Soup all;
    for (std::size_t copy = 0; copy < copies; ++copy) {
        const auto first = static_cast<std::uint32_t>(all.vertices.size());
        const double shift = spacing * (high - low) * double(copy);
        for (const Vec3& p : once.vertices) all.vertices.push_back({p[0] + shift, p[1], p[2]});
        for (const Triangle& t : once.triangles) all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
        for (const std::uint32_t g : once.groups) all.groups.push_back(static_cast<std::uint32_t>(copy) * group + g);
    }
    return all;
}

}  // namespace geomend::bench
