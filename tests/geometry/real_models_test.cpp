// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <variant>

#include "formats/gocad/read_gocad.h"
#include "geometry/intersections.h"
#include "geometry/near_misses.h"
#include "geometry/vectors.h"
#include "soups.h"
#include "support/real_data.h"
#include "topology/weld.h"

namespace geomend {
namespace {

using test::Soup;

/// All triangles of a model, welded where positions are equal; one group per surface of the file.
Soup read(const std::filesystem::path& path) {
    Soup s;
    const auto input = Input::open(path.string());
    const auto data = gocad::read_gocad(*input, {});
    topology::Welder welder(1024);
    std::uint32_t group = 0;
    for (const Object& object : data->objects) {
        const auto* surface = std::get_if<Surface>(&object);
        if (surface == nullptr) continue;
        for (std::size_t i = 0; i < surface->polygons.size(); ++i) {
            Triangle t{};
            for (std::size_t k = 0; k < 3; ++k) t[k] = welder.add(surface->points[surface->polygons[i][k]]);
            s.triangles.push_back(t);
            s.groups.push_back(group);
        }
        ++group;
    }
    s.vertices = welder.take_positions();
    return s;
}

double thousandth_of_size(const Soup& s) {
    Vec3 low = s.vertices[0], high = low;
    for (const Vec3& p : s.vertices) {
        for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
    }
    return 1e-3 * std::sqrt(dot(minus(high, low), minus(high, low)));
}

class RealModel : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        const auto path = test::real_data(GetParam());
        if (!path) GTEST_SKIP() << "no real data";
        soup_ = read(*path);
    }
    Soup soup_;
};

// In the first two and the last all surfaces meet along common vertices; CloudSpin fails in its lines, not in its triangles.
INSTANTIATE_TEST_SUITE_P(Models, RealModel,
                         testing::Values("gocad/modelA1.ml", "gocad/modelA4.ml", "gocad/CloudSpin.ml", "gocad/CloudSpin_fixed.ml"));

TEST_P(RealModel, HasNoIntersectionAndNoNearMiss) {
    EXPECT_TRUE(intersections(soup_.vertices, soup_.triangles).empty());
    std::map<std::array<std::uint32_t, 2>, std::vector<std::uint32_t>> uses;
    for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [p, q] = std::minmax(soup_.triangles[t][i], soup_.triangles[t][(i + 1) % 3]);
            uses[{p, q}].push_back(soup_.groups[t]);
        }
    }
    std::vector<std::array<std::uint32_t, 2>> borders;
    std::vector<std::uint32_t> border_groups;
    for (const auto& [edge, groups] : uses) {
        if (groups.size() > 1) continue;
        borders.push_back(edge);
        border_groups.push_back(groups[0]);
    }
    EXPECT_TRUE(near_misses(soup_.vertices, soup_.triangles, soup_.groups, borders, border_groups, thousandth_of_size(soup_)).empty());
}

// One vertex inside a surface is moved through the nearest other surface: exactly the triangles around it must be told.
TEST_P(RealModel, AVertexMovedThroughASurfaceIsFound) {
    const auto close = closest_pairs(soup_.vertices, soup_.triangles, soup_.groups, 10 * thousandth_of_size(soup_)).pairs;
    if (close.empty()) GTEST_SKIP() << "no two surfaces are close";
    const ClosePair& pair = close.front();
    Soup s = soup_;
    const Triangle& t = s.triangles[pair.triangle_a];
    const auto squared = [&](std::uint32_t v) { return dot(minus(s.vertices[v], pair.on_a), minus(s.vertices[v], pair.on_a)); };
    const std::uint32_t moved = *std::min_element(t.begin(), t.end(), [&](auto p, auto q) { return squared(p) < squared(q); });
    s.vertices[moved] = plus(s.vertices[moved], times(1.5, minus(pair.on_b, s.vertices[moved])));
    const auto found = intersections(s.vertices, s.triangles);
    EXPECT_FALSE(found.empty());
    const auto has = [&](std::uint32_t triangle) { return std::ranges::find(s.triangles[triangle], moved) != s.triangles[triangle].end(); };
    for (const TriangleMeetingPair& p : found) EXPECT_TRUE(has(p.a) || has(p.b)) << p.a << " and " << p.b;
}

}  // namespace
}  // namespace geomend
