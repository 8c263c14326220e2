// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/horizon_reader.h"

#include <algorithm>
#include <cmath>

#include "geometry/vectors.h"

namespace geomend::gridding {

MapReader::MapReader(const HorizonMap& map) : map_(map) {
    const Point &a = map.step[0], &b = map.step[1];
    const double d = a[0] * b[1] - a[1] * b[0];
    inverse_ = {Point{b[1] / d, -b[0] / d}, Point{-a[1] / d, a[0] / d}};
    step_ = std::max(std::hypot(a[0], a[1]), std::hypot(b[0], b[1]));
}

std::array<double, 2> MapReader::lattice(const Point& p) const {
    const double x = p[0] - map_.origin[0], y = p[1] - map_.origin[1];
    return {inverse_[0][0] * x + inverse_[0][1] * y, inverse_[1][0] * x + inverse_[1][1] * y};
}

void MapReader::hits(const Point& p, std::vector<Hit>& found) const {
    constexpr double slack = 1e-7;  // steps: what rounding may put a place beside a sample
    const auto at = lattice(p);
    std::array<std::uint32_t, 2> low{};
    std::array<double, 2> part{};
    for (std::size_t a = 0; a < 2; ++a) {
        if (!(at[a] >= -slack && at[a] <= map_.dims[a] - 1.0 + slack)) return;
        const double inside = std::clamp(at[a], 0.0, map_.dims[a] - 1.0);
        low[a] = static_cast<std::uint32_t>(std::min(std::floor(inside), std::max(0.0, map_.dims[a] - 2.0)));
        part[a] = inside - low[a];
        if (part[a] < slack) part[a] = 0;
        if (part[a] > 1 - slack) part[a] = 1;
    }
    Hit hit;
    for (std::uint32_t c = 0; c < 4; ++c) {
        const double weight = ((c & 1u) != 0 ? part[0] : 1 - part[0]) * ((c & 2u) != 0 ? part[1] : 1 - part[1]);
        if (weight == 0) continue;
        const std::uint32_t piece = low[0] + (c & 1u) + map_.dims[0] * (low[1] + (c >> 1));
        hit.depth += weight * map_.depths[piece];
        hit.pieces[hit.count++] = piece;
    }
    if (std::isfinite(hit.depth)) found.push_back(hit);
}

bool MapReader::covers(const Point& p) const {
    std::vector<Hit> found;
    hits(p, found);
    return !found.empty();
}

void MapReader::near(const Point& p, double reach, std::vector<Piece>& found) const {
    const auto at = lattice(p);
    std::array<std::uint32_t, 2> low{}, high{};
    for (std::size_t a = 0; a < 2; ++a) {
        const double wide = reach * std::hypot(inverse_[a][0], inverse_[a][1]);
        if (at[a] + wide < 0 || at[a] - wide > map_.dims[a] - 1.0) return;
        low[a] = static_cast<std::uint32_t>(std::max(0.0, std::ceil(at[a] - wide)));
        high[a] = static_cast<std::uint32_t>(std::min(map_.dims[a] - 1.0, std::floor(at[a] + wide)));
    }
    for (std::uint32_t j = low[1]; j <= high[1]; ++j) {
        for (std::uint32_t i = low[0]; i <= high[0]; ++i) {
            const std::uint32_t piece = i + map_.dims[0] * j;
            const Vec3 q = middle(piece);
            if (std::isfinite(q[2]) && distance(p, {q[0], q[1]}) <= reach) found.push_back({piece, q});
        }
    }
}

Vec3 MapReader::middle(std::uint32_t piece) const {
    const double i = piece % map_.dims[0], j = piece / map_.dims[0];
    return {map_.origin[0] + (i * map_.step[0][0] + j * map_.step[1][0]), map_.origin[1] + (i * map_.step[0][1] + j * map_.step[1][1]),
            map_.depths[piece]};
}

std::span<const Vec3> MapReader::corners(std::uint32_t piece, std::array<Vec3, 3>& room) const {
    room[0] = middle(piece);
    return {room.data(), 1};
}

namespace {

/// Lists of things by bin, from pairs (bin, thing) that `visit` gives twice in the same order.
template <class Visit>
void fill_bins(std::size_t bins, std::vector<std::uint64_t>& first, std::vector<std::uint32_t>& members, const Visit& visit) {
    first.assign(bins + 1, 0);
    visit([&](std::size_t bin, std::uint32_t) { ++first[bin + 1]; });
    for (std::size_t b = 0; b < bins; ++b) first[b + 1] += first[b];
    members.resize(first[bins]);
    std::vector<std::uint64_t> at(first.begin(), first.end() - 1);
    visit([&](std::size_t bin, std::uint32_t thing) { members[at[bin]++] = thing; });
}

}  // namespace

SheetReader::SheetReader(const Sheet& sheet) : sheet_(sheet) {
    Point high{-1e300, -1e300};
    low_ = {1e300, 1e300};
    for (const Vec3& v : sheet.vertices) {
        for (std::size_t a = 0; a < 2; ++a) {
            low_[a] = std::min(low_[a], v[a]);
            high[a] = std::max(high[a], v[a]);
        }
    }
    std::vector<Point> places;
    for (const Triangle& t : sheet.triangles) {
        for (const std::uint32_t v : t) places.push_back({sheet.vertices[v][0], sheet.vertices[v][1]});
    }
    hull_ = convex_hull(std::move(places));
    if (!hull_.empty()) hull_.push_back(hull_.front());
    else hull_.push_back(low_);
    const double n = std::max<double>(1, static_cast<double>(sheet.triangles.size()));
    const double width = std::max(high[0] - low_[0], 1e-300), height = std::max(high[1] - low_[1], 1e-300);
    step_ = std::sqrt(width * height / n) * 1.5;
    bin_ = std::max(step_, std::max(width, height) / 4096);
    if (!(bin_ > 0)) bin_ = 1;
    bins_ = {static_cast<std::uint32_t>(width / bin_) + 1, static_cast<std::uint32_t>(height / bin_) + 1};
    const std::size_t bins = std::size_t{bins_[0]} * bins_[1];
    fill_bins(bins, first_by_box_, by_box_, [&](const auto& add) {
        for (std::uint32_t t = 0; t < sheet.triangles.size(); ++t) {
            std::array<std::array<std::uint32_t, 2>, 2> range{};
            for (std::size_t a = 0; a < 2; ++a) {
                const auto [least, most] = std::minmax({sheet.vertices[sheet.triangles[t][0]][a], sheet.vertices[sheet.triangles[t][1]][a],
                                                        sheet.vertices[sheet.triangles[t][2]][a]});
                widest_ = std::max(widest_, most - least);
                range[a] = {bin_of(least - 1e-6 * bin_, a), bin_of(most + 1e-6 * bin_, a)};
            }
            for (std::uint32_t j = range[1][0]; j <= range[1][1]; ++j) {
                for (std::uint32_t i = range[0][0]; i <= range[0][1]; ++i) add(i + std::size_t{bins_[0]} * j, t);
            }
        }
    });
    fill_bins(bins, first_by_middle_, by_middle_, [&](const auto& add) {
        for (std::uint32_t t = 0; t < sheet.triangles.size(); ++t) {
            const Vec3 m = middle(t);
            add(bin_of(m[0], 0) + std::size_t{bins_[0]} * bin_of(m[1], 1), t);
        }
    });
}

std::uint32_t SheetReader::bin_of(double x, std::size_t axis) const {
    return static_cast<std::uint32_t>(std::clamp((x - low_[axis]) / bin_, 0.0, bins_[axis] - 1.0));
}

void SheetReader::hits(const Point& p, std::vector<Hit>& found) const {
    const std::size_t begin = found.size();
    const std::size_t bin = bin_of(p[0], 0) + std::size_t{bins_[0]} * bin_of(p[1], 1);
    for (std::uint64_t k = first_by_box_[bin]; k < first_by_box_[bin + 1]; ++k) {
        const std::uint32_t t = by_box_[k];
        const Vec3 &a = sheet_.vertices[sheet_.triangles[t][0]], &b = sheet_.vertices[sheet_.triangles[t][1]],
                   &c = sheet_.vertices[sheet_.triangles[t][2]];
        const double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1];
        const double area = bx * cy - by * cx;
        const double longest = std::max({bx * bx + by * by, cx * cx + cy * cy, (cx - bx) * (cx - bx) + (cy - by) * (cy - by)});
        if (std::abs(area) <= 1e-12 * longest) continue;
        const double px = p[0] - a[0], py = p[1] - a[1];
        const double v = (px * cy - py * cx) / area, w = (bx * py - by * px) / area;
        // A place beside an edge by no more than rounding lies on it.
        const double slack = 1e-9 * std::max(1.0, longest / std::abs(area));
        if (v < -slack || w < -slack || v + w > 1 + slack) continue;
        found.push_back({a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2]), {t}, 1});
    }
    std::sort(found.begin() + static_cast<std::ptrdiff_t>(begin), found.end(),
              [](const Hit& a, const Hit& b) { return a.depth != b.depth ? a.depth < b.depth : a.pieces[0] < b.pieces[0]; });
}

std::optional<double> SheetReader::crossing(std::uint32_t piece, const double* pillar) const {
    const Vec3 &a = sheet_.vertices[sheet_.triangles[piece][0]], &b = sheet_.vertices[sheet_.triangles[piece][1]],
               &c = sheet_.vertices[sheet_.triangles[piece][2]];
    const Vec3 from{pillar[0], pillar[1], pillar[2]}, way{pillar[3] - pillar[0], pillar[4] - pillar[1], pillar[5] - pillar[2]};
    const Vec3 normal = cross(minus(b, a), minus(c, a));
    const double size = dot(normal, normal), along = dot(way, normal);
    if (!(std::abs(along) > 1e-9 * std::sqrt(size * dot(way, way)))) return std::nullopt;
    const double t = dot(minus(a, from), normal) / along;
    const Vec3 p = minus({from[0] + t * way[0], from[1] + t * way[1], from[2] + t * way[2]}, a);
    const double v = dot(cross(p, minus(c, a)), normal) / size, w = dot(cross(minus(b, a), p), normal) / size;
    constexpr double slack = 1e-7;
    if (v < -slack || w < -slack || v + w > 1 + slack) return std::nullopt;
    return from[2] + t * way[2];
}

bool SheetReader::covers(const Point& p) const { return is_inside(hull_, p) || nearest_on(hull_, p).distance <= 1e-6 * step_; }

void SheetReader::near(const Point& p, double reach, std::vector<Piece>& found) const {
    for (std::uint32_t j = bin_of(p[1] - reach, 1); j <= bin_of(p[1] + reach, 1); ++j) {
        for (std::uint32_t i = bin_of(p[0] - reach, 0); i <= bin_of(p[0] + reach, 0); ++i) {
            const std::size_t bin = i + std::size_t{bins_[0]} * j;
            for (std::uint64_t k = first_by_middle_[bin]; k < first_by_middle_[bin + 1]; ++k) {
                const Vec3 q = middle(by_middle_[k]);
                if (distance(p, {q[0], q[1]}) <= reach) found.push_back({by_middle_[k], q});
            }
        }
    }
}

Vec3 SheetReader::middle(std::uint32_t piece) const {
    Vec3 sum{};
    for (const std::uint32_t v : sheet_.triangles[piece]) {
        for (std::size_t a = 0; a < 3; ++a) sum[a] += sheet_.vertices[v][a] / 3;
    }
    return sum;
}

std::span<const Vec3> SheetReader::corners(std::uint32_t piece, std::array<Vec3, 3>& room) const {
    for (std::size_t a = 0; a < 3; ++a) room[a] = sheet_.vertices[sheet_.triangles[piece][a]];
    return room;
}

}  // namespace geomend::gridding
