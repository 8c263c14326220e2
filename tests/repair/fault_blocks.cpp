// SPDX-License-Identifier: AGPL-3.0-or-later
#include "fault_blocks.h"

#include <numeric>
#include <random>

#include "convex_cells.h"

namespace geomend::test {

namespace {

/// Numbers that are the same on every machine.
class Dice {
public:
    explicit Dice(std::uint32_t seed) : engine_(seed) {}
    double between(double low, double high) { return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0); }
    int upto(int most) { return 1 + static_cast<int>(engine_() % static_cast<std::uint32_t>(most)); }
    bool coin() { return engine_() % 2 == 0; }

private:
    std::mt19937 engine_;
};

/// Triangles over a convex outline: edges longer than a length are split at random places until there are none.
void triangulate(const Outline& outline, double longest, Dice& dice, std::vector<Vec3>& points, Polygons& triangles) {
    std::vector<std::array<std::uint32_t, 3>> all;
    points = outline;
    for (std::uint32_t i = 2; i < outline.size(); ++i) all.push_back({0, i - 1, i});
    while (points.size() < 4000) {
        double most = longest * longest;
        std::uint32_t a = 0, b = 0;
        for (const auto& t : all) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 d = minus(points[t[k]], points[t[(k + 1) % 3]]);
                if (dot(d, d) <= most) continue;
                most = dot(d, d);
                a = t[k];
                b = t[(k + 1) % 3];
            }
        }
        if (a == b) break;
        const auto middle = static_cast<std::uint32_t>(points.size());
        points.push_back(plus(points[a], times(dice.between(0.35, 0.65), minus(points[b], points[a]))));
        for (std::size_t i = 0, n = all.size(); i < n; ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t p = all[i][k], q = all[i][(k + 1) % 3], r = all[i][(k + 2) % 3];
                if (!((p == a && q == b) || (p == b && q == a))) continue;
                all[i] = {p, middle, r};
                all.push_back({middle, q, r});
                break;
            }
        }
    }
    for (const auto& t : all) triangles.push_back(t);
}

Outline without_repeats(const Outline& outline, double least) {
    Outline kept;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec3 d = minus(outline[i], outline[(i + outline.size() - 1) % outline.size()]);
        if (dot(d, d) > least * least) kept.push_back(outline[i]);
    }
    return kept;
}

struct Maker {
    Dice dice;
    Ending ending;
    Vec3 lowest_moved;
    FaultBlocks made;
    Vec3 high{}, offset{};
    std::vector<Plane> faults;
    std::vector<Plane> sides;  // low and high of each axis
    bool usable = true;

    double size() const { return made.size; }

    void add(const Outline& whole, const std::string& name) {
        const Outline outline = without_repeats(whole, 1e-9 * size());
        if (outline.size() < 3) return;
        Surface surface;
        surface.info.name = name;
        triangulate(outline, dice.between(0.15, 0.4) * size(), dice, surface.points, surface.polygons);
        for (Vec3& p : surface.points) p = plus(p, offset);
        made.dataset.objects.emplace_back(std::move(surface));
    }

    /// A large square of a plane.
    Outline square(const Plane& plane) const {
        const Vec3 n = times(1 / std::sqrt(dot(plane.normal, plane.normal)), plane.normal);
        const Vec3 helper = std::abs(n[0]) < 0.8 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        Vec3 u = cross(n, helper);
        u = times(3 * size() / std::sqrt(dot(u, u)), u);
        const Vec3 v = cross(n, u);
        const Vec3 middle = times(0.5, high);
        const Vec3 c = minus(middle, times(plane.height(middle) / std::sqrt(dot(plane.normal, plane.normal)), n));
        return {minus(minus(c, u), v), minus(plus(c, u), v), plus(plus(c, u), v), plus(minus(c, u), v)};
    }

    Outline in_box(Outline outline, double more) const {
        for (std::size_t s = 0; s < 6; ++s) outline = clipped(outline, sides[s], s % 2 == 0 ? 1 : -1, more);
        return outline;
    }

    double beyond_box() {
        if (ending == Ending::out_of_box) return 0.02 * size();
        return ending == Ending::short_of ? -0.005 * size() * dice.between(0, 1) : 0;
    }
    double beyond_fault() {
        if (ending == Ending::through_faults) return 0.03 * size() * dice.between(0.1, 1);
        return ending == Ending::short_of ? -0.005 * size() * dice.between(0, 1) : 0;
    }

    void make_box() {
        const double scale = dice.coin() ? 1 : 100;
        high = {10 * scale, 8 * scale, 4 * scale};
        made.size = high[0];
        if (dice.coin()) offset = {512345, 6234567, -2500};
        for (std::size_t k = 0; k < 3; ++k) {
            Vec3 axis{};
            axis[k] = 1;
            sides.push_back({axis, 0});
            sides.push_back({axis, high[k]});
        }
        for (std::size_t s = 0; s < 6; ++s) {
            Outline face = square(sides[s]);
            for (std::size_t t = 0; t < 6; ++t) {
                if (t / 2 != s / 2) face = clipped(face, sides[t], t % 2 == 0 ? 1 : -1);
            }
            add(face, "side_" + std::to_string(s));
        }
    }

    void make_fault(double azimuth, const Vec3& through) {
        const double dip = dice.between(55, 85) * M_PI / 180 * (dice.coin() ? 1 : -1);
        const Vec3 normal{std::cos(azimuth) * std::sin(dip), std::sin(azimuth) * std::sin(dip), std::cos(dip)};
        faults.push_back({normal, dot(normal, through)});
        const double beyond = ending == Ending::short_of && dice.coin() ? 0 : beyond_box();
        add(in_box(square(faults.back()), beyond), "fault_" + std::to_string(faults.size()));
    }

    void make_faults() {
        const double strike = dice.between(-0.4, 0.4);
        const bool two_families = dice.coin();
        const int first = dice.upto(two_families ? 2 : 3), second = two_families ? dice.upto(2) : 0;
        for (int i = 1; i <= first; ++i)
            make_fault(strike, {high[0] * (i / (first + 1.0) + dice.between(-0.04, 0.04)), high[1] / 2, high[2] / 2});
        for (int i = 1; i <= second; ++i) {
            make_fault(strike + M_PI / 2 + dice.between(-0.3, 0.3),
                       {high[0] / 2, high[1] * (i / 3.0 + dice.between(-0.05, 0.05)), high[2] / 2});
        }
    }

    /// The horizons of the block on the given sides of the faults, and its regions.
    void make_block(std::uint32_t signs, int horizons, double slope_x, double slope_y) {
        ConvexCell block = box_cell({0, 0, 0}, high);
        double throw_here = 0;
        for (std::size_t f = 0; f < faults.size(); ++f) {
            const double side = (signs >> f & 1) != 0 ? 1 : -1;
            block = clipped(block, faults[f], side);
            if (side > 0) throw_here += 0.03 * high[2] * static_cast<double>(f + 1);
        }
        const double whole = high[0] * high[1] * high[2];
        if (block.empty() || block.volume() < 1e-12 * whole) return;
        usable = usable && block.volume() > 1e-4 * whole;
        ConvexCell rest = block;
        for (int h = 0; h < horizons; ++h) {
            const double z = high[2] * (0.15 + 0.55 * (h + 1) / (horizons + 1)) + throw_here;
            const Vec3 normal{-slope_x, -slope_y, 1};
            const Plane plane{normal, dot(normal, {high[0] / 2, high[1] / 2, z})};
            Outline patch = in_box(square(plane), beyond_box());
            for (std::size_t f = 0; f < faults.size(); ++f) {
                const Vec3 across_both = cross(faults[f].normal, normal);
                const double sine =
                    std::sqrt(dot(across_both, across_both) / dot(faults[f].normal, faults[f].normal) / dot(normal, normal));
                patch = clipped(patch, faults[f], (signs >> f & 1) != 0 ? 1 : -1, beyond_fault() * sine);
            }
            add(patch, "horizon_" + std::to_string(h + 1) + "_block_" + std::to_string(signs));
            Plane boundary = plane;
            if (h == 0) boundary.level += dot(normal, lowest_moved);
            take_region(clipped(rest, boundary, -1));
            rest = clipped(rest, boundary, 1);
        }
        take_region(rest);
    }

    void take_region(const ConvexCell& cell) {
        if (cell.empty()) return;
        const double volume = cell.volume(), whole = high[0] * high[1] * high[2];
        if (volume < 1e-12 * whole) return;
        usable = usable && volume > 1e-5 * whole;
        made.volumes.push_back(volume);
    }
};

}  // namespace

FaultBlocks fault_blocks(std::uint32_t seed, Ending ending, const Vec3& lowest_moved) {
    for (std::uint32_t trial = 0;; ++trial) {
        Maker maker{Dice(seed + 7919 * trial), ending, lowest_moved, {}, {}, {}, {}, {}, true};
        maker.make_box();
        maker.make_faults();
        const int horizons = maker.dice.upto(4);
        const double slope_x = maker.dice.between(-0.03, 0.03), slope_y = maker.dice.between(-0.03, 0.03);
        for (std::uint32_t signs = 0; signs < 1u << maker.faults.size(); ++signs) maker.make_block(signs, horizons, slope_x, slope_y);
        if (!maker.usable) continue;
        std::sort(maker.made.volumes.begin(), maker.made.volumes.end());
        if (ending == Ending::through_faults) maker.made.max_gap = 0.04 * maker.made.size;
        if (ending == Ending::short_of) maker.made.max_gap = 0.01 * maker.made.size;
        return std::move(maker.made);
    }
}

void shuffle(Dataset& dataset, std::uint32_t seed) {
    std::mt19937 engine(seed);
    std::shuffle(dataset.objects.begin(), dataset.objects.end(), engine);
    for (Object& object : dataset.objects) {
        auto& surface = std::get<Surface>(object);
        std::vector<std::uint32_t> place(surface.points.size());
        std::iota(place.begin(), place.end(), 0u);
        std::shuffle(place.begin(), place.end(), engine);
        std::vector<Vec3> points(place.size());
        for (std::size_t i = 0; i < place.size(); ++i) points[place[i]] = surface.points[i];
        surface.points = std::move(points);
        std::vector<std::array<std::uint32_t, 3>> triangles;
        for (std::size_t t = 0; t < surface.polygons.size(); ++t) {
            const auto p = surface.polygons[t];
            triangles.push_back({place[p[1]], place[p[2]], place[p[0]]});
        }
        std::shuffle(triangles.begin(), triangles.end(), engine);
        surface.polygons = {};
        for (const auto& t : triangles) surface.polygons.push_back(t);
    }
}

}  // namespace geomend::test
