// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "pipeline/load.h"
#include "support/real_data.h"
#include "validators/layered_model.h"
#include "validators/registry.h"

// What is wrong with a model does not depend on the order of its parts, on where it stands, how large it is, or how it is
// turned.

namespace geomend {
namespace {

using namespace testing;
using Random = std::mt19937;

/// Codes with the names of their entities, and the numbers of corners, lines, surfaces and regions.
struct Verdict {
    std::multiset<std::string> findings;
    std::vector<std::size_t> counts;
    bool operator==(const Verdict&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Verdict& v) {
    for (const auto& f : v.findings) out << f << '\n';
    for (const std::size_t c : v.counts) out << c << ' ';
    return out;
}

Verdict verdict(const Dataset& data) {
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
    const auto models = topology::models_to_judge(data, checked->lengths.tolerance);
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
Dataset shuffled(Dataset data, Random& random) {
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
Dataset turned(Dataset data, Random& random) {
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
Dataset other_order(Dataset data, Random& random) {
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

Vec3 rotated(const Vec3& p) {
    constexpr double a = 0.7, b = 0.3;
    const Vec3 q{std::cos(a) * p[0] - std::sin(a) * p[1], std::sin(a) * p[0] + std::cos(a) * p[1], p[2]};
    return {q[0], std::cos(b) * q[1] - std::sin(b) * q[2], std::sin(b) * q[1] + std::cos(b) * q[2]};
}

void expect_one_verdict(const Dataset& data) {
    const Verdict known = verdict(data);
    for (unsigned seed = 0; seed < 5; ++seed) {
        Random random(seed);
        EXPECT_EQ(verdict(shuffled(data, random)), known) << "in another order of triangles and points";
        EXPECT_EQ(verdict(turned(data, random)), known) << "turned over";
        EXPECT_EQ(verdict(other_order(data, random)), known) << "in another order of surfaces";
    }
    for (const double scale : {1e-3, 1e3}) {
        EXPECT_EQ(verdict(moved(data, [&](const Vec3& p) { return Vec3{scale * p[0], scale * p[1], scale * p[2]}; })), known) << scale;
    }
    EXPECT_EQ(verdict(moved(data, rotated)), known) << "rotated";
}

/// In map coordinates and of a kilometre's size.
Dataset on_the_map(const Dataset& data, double scale) {
    return moved(data, [&](const Vec3& p) { return Vec3{scale * p[0] + 461234.5, scale * p[1] + 5932123.25, scale * p[2] - 1750}; });
}

TEST(Verdict, OfASoundModelIsTheSameHoweverItIsWritten) {
    LayeredModel model;
    expect_one_verdict(model.data());
    EXPECT_EQ(verdict(on_the_map(model.data(), 1000)), verdict(model.data()));
}

TEST(Verdict, OfAnUnsoundModelIsTheSameHoweverItIsWritten) {
    LayeredModel model;
    Surface& lower = model.surface("lower");
    lower.points[7][2] += 1;  // through the next horizon
    Surface& east = model.surface("east");
    add_triangle(east, east.polygons.corners[0], east.polygons.corners[1], east.polygons.corners[1]);
    auto& corners = model.surface("west").polygons.corners;
    corners.erase(corners.begin(), corners.begin() + 3);
    for (auto& part : model.surface("west").parts) part.first_polygon -= part.first_polygon > 0 ? 1 : 0;
    const Verdict known = verdict(model.data());
    EXPECT_GE(known.findings.size(), 5u) << known;
    expect_one_verdict(model.data());
    EXPECT_EQ(verdict(on_the_map(model.data(), 1000)), known);
}

TEST(Verdict, OfRealModelsIsTheSameHoweverTheyAreWritten) {
    const auto file = test::real_data("gocad/modelA1.ml");
    if (!file) GTEST_SKIP() << "no real data here";
    const auto data = load(file->string(), {});
    ASSERT_TRUE(data);
    expect_one_verdict(*data);
    EXPECT_EQ(verdict(on_the_map(*data, 1)), verdict(*data));
}

}  // namespace
}  // namespace geomend
