// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "base/bounds.h"
#include "report/scene.h"

namespace geomend {

namespace {

void take(Bounds& bounds, const Vec3& p) {
    if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])) bounds.add(p);
}

Bounds bounds_of(const Scene& scene) {
    Bounds bounds;
    for (const ScenePart& part : scene.parts) std::ranges::for_each(part.points, [&](const Vec3& p) { take(bounds, p); });
    if (!bounds.empty()) return bounds;
    for (const SceneMark& mark : scene.marks) {
        std::ranges::for_each(mark.points, [&](const Vec3& p) { take(bounds, p); });
        for (const auto& line : mark.polylines) std::ranges::for_each(line, [&](const Vec3& p) { take(bounds, p); });
    }
    return bounds.empty() ? Bounds{{}, {}} : bounds;
}

std::size_t count_triangles(const Scene& scene) {
    std::size_t count = 0;
    for (const ScenePart& part : scene.parts) count += part.triangles.size();
    return count;
}

// Boxes of a lattice over the scene; heights have boxes as many as lengths, because models are flat.
class Lattice {
public:
    Lattice(const Bounds& bounds, double boxes) : low_(bounds.low) {
        for (std::size_t a = 0; a < 3; ++a) {
            const double size = bounds.high[a] - bounds.low[a];
            scale_[a] = size > 0 ? boxes / size : 0;
        }
    }
    std::uint64_t box(const Vec3& p) const {
        std::uint64_t key = 0;
        for (std::size_t a = 0; a < 3; ++a) {
            const double at = (p[a] - low_[a]) * scale_[a];
            key = key << 21 | (at > 0 && at < 2097151 ? static_cast<std::uint64_t>(at) : 0);
        }
        return key;
    }

private:
    Vec3 low_, scale_{};
};

// The first point in each box stands for all of them, whatever part they are in.
using Representatives = std::unordered_map<std::uint64_t, Vec3>;

Representatives representatives(const Scene& scene, const Lattice& lattice) {
    Representatives first;
    for (const ScenePart& part : scene.parts) {
        for (const Vec3& p : part.points) first.try_emplace(lattice.box(p), p);
    }
    return first;
}

std::size_t triangles_left(const Scene& scene, const Lattice& lattice) {
    std::size_t left = 0;
    std::vector<std::uint64_t> boxes;
    for (const ScenePart& part : scene.parts) {
        boxes.resize(part.points.size());
        std::ranges::transform(part.points, boxes.begin(), [&](const Vec3& p) { return lattice.box(p); });
        for (const auto& [a, b, c] : part.triangles) left += boxes[a] != boxes[b] && boxes[b] != boxes[c] && boxes[c] != boxes[a];
    }
    return left;
}

void thin_part(ScenePart& part, const Lattice& lattice, const Representatives& positions) {
    std::unordered_map<std::uint64_t, std::uint32_t> number;
    std::vector<std::uint32_t> becomes(part.points.size());
    std::vector<Vec3> points;
    std::vector<float> moved;
    for (std::size_t i = 0; i < part.points.size(); ++i) {
        const std::uint64_t box = lattice.box(part.points[i]);
        const auto [at, is_new] = number.try_emplace(box, static_cast<std::uint32_t>(points.size()));
        if (is_new) points.push_back(positions.at(box));
        if (is_new && !part.moved.empty()) moved.push_back(0);
        becomes[i] = at->second;
        if (!part.moved.empty()) moved[at->second] = std::max(moved[at->second], part.moved[i]);
    }
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const auto& [a, b, c] : part.triangles) {
        const std::uint32_t p = becomes[a], q = becomes[b], r = becomes[c];
        if (p != q && q != r && r != p) triangles.push_back({p, q, r});
    }
    for (auto& line : part.polylines) {
        for (std::uint32_t& n : line) n = becomes[n];
        line.erase(std::ranges::unique(line).begin(), line.end());
    }
    std::erase_if(part.polylines, [](const auto& line) { return line.size() < 2; });
    part.points = std::move(points);
    part.moved = std::move(moved);
    part.triangles = std::move(triangles);
}

}  // namespace

const char* to_string(PartChange change) {
    constexpr const char* words[] = {"none", "added", "cut", "joined", "removed", "erased"};
    return words[static_cast<std::size_t>(change)];
}

void finish(Scene& scene) {
    const Bounds bounds = bounds_of(scene);
    for (std::size_t a = 0; a < 3; ++a) scene.origin[a] = std::round(0.5 * bounds.low[a] + 0.5 * bounds.high[a]);
    scene.triangles = count_triangles(scene);
}

void thin(Scene& scene, std::size_t most_triangles) {
    if (count_triangles(scene) <= most_triangles) return;
    const Bounds bounds = bounds_of(scene);
    // A sheet across the lattice has twice as many triangles as boxes on its side squared.
    double boxes = std::min(2e6, std::max(2.0, 2 * std::sqrt(double(most_triangles))));
    while (boxes > 2 && triangles_left(scene, Lattice(bounds, boxes)) > most_triangles) boxes *= 0.8;
    const Lattice lattice(bounds, boxes);
    const Representatives positions = representatives(scene, lattice);
    for (ScenePart& part : scene.parts) thin_part(part, lattice, positions);
    scene.simplified = true;
}

}  // namespace geomend
