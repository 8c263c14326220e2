// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ostream>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "validators/layered_model.h"
#include "validators/registry.h"

// One model written in many ways, and what is said of it.

namespace geomend::testing {

/// Codes with the names of their entities, and the numbers of corners, lines, surfaces and regions.
struct Verdict {
    std::multiset<std::string> findings;
    std::vector<std::size_t> counts;
    bool operator==(const Verdict&) const = default;
};

inline std::ostream& operator<<(std::ostream& out, const Verdict& v) {
    for (const auto& f : v.findings) out << f << '\n';
    for (const std::size_t c : v.counts) out << c << ' ';
    return out;
}

inline Verdict verdict(const Dataset& data) {
    Verdict v;
    auto checked = validators::check_models(data, {});
    EXPECT_TRUE(checked);
    for (const Finding& f : checked->findings) {
        std::string text = f.code;
        std::set<std::string> names;
        for (const EntityRef& e : f.entities) {
            if (e.kind != "line") names.insert(e.kind + " " + e.name);
        }
        for (const auto& name : names) text += "; " + name;
        v.findings.insert(text);
    }
    const auto models = topology::models_to_judge(data, topology::model_sources(data, checked->local));
    EXPECT_TRUE(models);
    for (const auto& m : *models) {
        v.counts = {m.brep->corners.size(), m.brep->lines.size(), m.brep->surfaces.size(), m.brep->regions.size(), m.found.regions.size()};
    }
    return v;
}

template <class Change>
Dataset moved(Dataset data, const Change& change) {
    for (Object& object : data.objects) {
        if (auto* surface = std::get_if<Surface>(&object)) {
            for (Vec3& p : surface->points) p = change(p);
        }
    }
    for (StatedModel& model : data.models) {
        for (auto& face : model.faces) {
            if (!face.key) continue;
            for (Vec3& p : *face.key) p = change(p);
        }
    }
    return data;
}

/// The same model in another order: triangles of each part, their first corners, and points of each part.
inline Dataset shuffled(Dataset data, std::mt19937& random) {
    for (Object& object : data.objects) {
        auto* surface = std::get_if<Surface>(&object);
        if (surface == nullptr) continue;
        const auto bounds = part_bounds(*surface);
        auto& corners = surface->polygons.corners;
        for (std::size_t part = 0; part + 1 < bounds.size(); ++part) {
            std::vector<std::array<std::uint32_t, 3>> t;
            for (std::uint64_t p = bounds[part]; p < bounds[part + 1]; ++p)
                t.push_back({corners[3 * p], corners[3 * p + 1], corners[3 * p + 2]});
            std::ranges::shuffle(t, random);
            for (std::uint64_t p = bounds[part]; p < bounds[part + 1]; ++p) {
                auto& one = t[p - bounds[part]];
                std::ranges::rotate(one, one.begin() + static_cast<std::ptrdiff_t>(random() % 3));
                for (std::size_t i = 0; i < 3; ++i) corners[3 * p + i] = one[i];
            }
            const std::size_t first = surface->parts.empty() ? 0 : surface->parts[part].first_point;
            const std::size_t last = part + 1 < surface->parts.size() ? surface->parts[part + 1].first_point : surface->points.size();
            std::vector<std::uint32_t> to(last - first);
            std::iota(to.begin(), to.end(), static_cast<std::uint32_t>(first));
            std::ranges::shuffle(to, random);
            const std::vector<Vec3> points(surface->points.begin() + static_cast<std::ptrdiff_t>(first),
                                           surface->points.begin() + static_cast<std::ptrdiff_t>(last));
            for (std::size_t i = 0; i < to.size(); ++i) surface->points[to[i]] = points[i];
            for (std::uint32_t& c : corners) {
                if (c >= first && c < last) c = to[c - first];
            }
        }
        surface->alias.clear();
        surface->border_corners.clear();
        surface->border_starts.clear();
        surface->info.attributes.clear();
    }
    return data;
}

/// Each surface turned over: triangles, key triangles, and the signs in the lists of regions.
inline Dataset turned(Dataset data, std::mt19937& random) {
    for (StatedModel& model : data.models) {
        for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
            if (random() % 2 == 0) continue;
            auto& face = model.faces[f];
            auto& surface = std::get<Surface>(data.objects[face.object]);
            const auto bounds = part_bounds(surface);
            for (std::uint64_t p = bounds[face.part]; p < bounds[face.part + 1]; ++p)
                std::swap(surface.polygons.corners[3 * p + 1], surface.polygons.corners[3 * p + 2]);
            if (face.key) std::swap((*face.key)[1], (*face.key)[2]);
            for (auto& region : model.regions) {
                for (auto& side : region.sides) {
                    if (side.face == f) side.front = !side.front;
                }
            }
        }
    }
    return data;
}

/// The objects in another order.
inline Dataset other_order(Dataset data, std::mt19937& random) {
    std::vector<std::uint32_t> order(data.objects.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::shuffle(order, random);
    std::vector<Object> objects(data.objects.size());
    for (std::size_t i = 0; i < order.size(); ++i) objects[order[i]] = std::move(data.objects[i]);
    data.objects = std::move(objects);
    for (StatedModel& model : data.models) {
        for (auto& face : model.faces) face.object = order[face.object];
    }
    return data;
}

inline Vec3 rotated(const Vec3& p) {
    constexpr double a = 0.7, b = 0.3;
    const Vec3 q{std::cos(a) * p[0] - std::sin(a) * p[1], std::sin(a) * p[0] + std::cos(a) * p[1], p[2]};
    return {q[0], std::cos(b) * q[1] - std::sin(b) * q[2], std::sin(b) * q[1] + std::cos(b) * q[2]};
}

/// In map coordinates and of a kilometre's size.
inline Dataset on_the_map(const Dataset& data, double scale) {
    return moved(data, [&](const Vec3& p) { return Vec3{scale * p[0] + 461234.5, scale * p[1] + 5932123.25, scale * p[2] - 1750}; });
}

}  // namespace geomend::testing
