// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include "validators/rewritten.h"
#include "validators/zoo.h"

// The models with known answers in other orders, other places, other sizes and other directions: the answers stay.

namespace geomend {
namespace {

using namespace testing;

/// What does not depend on the names of parts, which follow their order where no one states them.
Verdict nameless(const Dataset& data) {
    Verdict v = verdict(data);
    std::multiset<std::string> codes;
    for (const std::string& f : v.findings) codes.insert(f.substr(0, f.find(';')));
    codes.erase("F111");
    v.findings = std::move(codes);
    return v;
}

struct Way {
    std::string name;
    Dataset data;
};

Vec3 turned_by(const Vec3& p, const std::array<double, 3>& angles) {
    Vec3 q = p;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
        const double cosine = std::cos(angles[axis]), sine = std::sin(angles[axis]), x = q[b], y = q[c];
        q[b] = cosine * x - sine * y;
        q[c] = sine * x + cosine * y;
    }
    return q;
}

/// As a VTK file with points in single precision holds it.
Dataset in_single_precision(Dataset data) {
    data = moved(std::move(data), [](const Vec3& p) { return Vec3{double(float(p[0])), double(float(p[1])), double(float(p[2]))}; });
    for (Object& object : data.objects) info_of(object).precision = CoordinatePrecision::single_precision;
    return data;
}

std::vector<Way> ways_of(const Dataset& data) {
    std::vector<Way> ways;
    std::mt19937 random(7);
    for (int k = 0; k < 2; ++k) {
        ways.push_back({"other order of triangles and points", shuffled(data, random)});
        ways.push_back({"turned over", turned(data, random)});
        ways.push_back({"other order of surfaces", other_order(data, random)});
        ways.push_back({"all of that", other_order(turned(shuffled(data, random), random), random)});
        std::array<double, 3> angles{};
        for (double& a : angles) a = std::uniform_real_distribution<double>(0, 6.28)(random);
        ways.push_back({"rotated", moved(data, [&](const Vec3& p) { return turned_by(p, angles); })});
        ways.push_back({"rotated and on the map", on_the_map(moved(data, [&](const Vec3& p) { return turned_by(p, angles); }), 1)});
    }
    for (const double scale : {1e-3, 1e3}) {
        const auto scaled = [&](const Vec3& p) { return Vec3{scale * p[0], scale * p[1], scale * p[2]}; };
        ways.push_back({"scaled by " + std::to_string(scale), moved(data, scaled)});
    }
    ways.push_back({"on the map", on_the_map(data, 1)});
    ways.push_back({"on the map, in kilometres", on_the_map(data, 1000)});
    ways.push_back({"on the map, in kilometres, single precision", in_single_precision(on_the_map(data, 1000))});
    return ways;
}

class RewrittenZoo : public ::testing::TestWithParam<Species> {};

TEST_P(RewrittenZoo, IsJudgedTheSame) {
    const Animal animal = GetParam().make();
    const Verdict known = verdict(animal.model.data);
    for (const Way& way : ways_of(animal.model.data)) EXPECT_EQ(verdict(way.data), known) << way.name;
}

TEST_P(RewrittenZoo, IsJudgedTheSameAsABasinManyTimesWiderThanThick) {
    const Animal animal = GetParam().make();
    const Verdict known = nameless(animal.model.data);
    const bool is_body = animal.counts.regions > 0;  // single sheets have no thickness
    for (const double wide : {5.0, 30.0, is_body ? 200.0 : 30.0}) {
        Verdict basin = nameless(moved(animal.model.data, [&](const Vec3& p) { return Vec3{wide * p[0], wide * p[1], p[2]}; }));
        for (const char* angle : {"Q01", "Q03", "Q04"}) {  // angles are smaller ones there
            if (!known.findings.contains(angle)) basin.findings.erase(angle);
        }
        EXPECT_EQ(basin, known) << wide;
    }
}

/// One triangle of each surface divided again and again, without new points on its edges.
Dataset refined(Dataset data, int times) {
    for (Object& object : data.objects) {
        auto& surface = std::get<Surface>(object);
        auto& corners = surface.polygons.corners;
        // The new ones go to the end, so it is a triangle of the last part.
        const std::uint64_t chosen = corners.size() / 3 - 1;
        for (int k = 0; k < times; ++k) {
            const std::array<std::uint32_t, 3> t{corners[3 * chosen], corners[3 * chosen + 1], corners[3 * chosen + 2]};
            Vec3 middle{};
            for (const std::uint32_t v : t) {
                for (std::size_t x = 0; x < 3; ++x) middle[x] += surface.points[v][x] / 3;
            }
            const auto m = static_cast<std::uint32_t>(surface.points.size());
            surface.points.push_back(middle);
            corners[3 * chosen + 2] = m;
            corners.insert(corners.end(), {t[1], t[2], m, t[2], t[0], m});
        }
        surface.labels = {};
        surface.alias.clear();
        surface.border_corners.clear();
        surface.border_starts.clear();
        surface.info.attributes.clear();
    }
    return data;
}

/// Without what is said of the shape of triangles.
std::multiset<std::string> without_quality(Verdict v) {
    std::erase_if(v.findings, [](const std::string& f) { return f.starts_with("Q") || f.starts_with("F111"); });
    return v.findings;
}

TEST_P(RewrittenZoo, IsJudgedTheSameWhereOneTriangleIsRefined) {
    const Animal animal = GetParam().make();
    EXPECT_EQ(without_quality(verdict(refined(animal.model.data, 6))), without_quality(verdict(animal.model.data)));
}

TEST_P(RewrittenZoo, IsJudgedTheSameBesideAStrayPart) {
    const Animal animal = GetParam().make();
    for (const double distance : {60.0, 1e4, 1e7}) {
        Surface stray;
        stray.info.name = "stray";
        stray.points = {{distance, 1, 1}, {distance + 0.3, 1, 1.2}, {distance, 1.4, 1}};
        stray.polygons.corners = {0, 1, 2};
        Dataset alone, both = animal.model.data;
        alone.objects.emplace_back(stray);
        both.objects.emplace_back(stray);
        auto known = without_quality(verdict(animal.model.data));
        known.merge(without_quality(verdict(alone)));
        EXPECT_EQ(without_quality(verdict(both)), known) << distance;
    }
}

TEST_P(RewrittenZoo, IsJudgedTheSameWithoutItsRegionLists) {
    const Animal animal = GetParam().make();
    const Dataset data = without_lists(animal.model.data);
    const Verdict known = nameless(data);
    for (const Way& way : ways_of(data)) EXPECT_EQ(nameless(way.data), known) << way.name;
}

TEST_P(RewrittenZoo, IsJudgedTheSameAsLooseSurfaces) {
    const Animal animal = GetParam().make();
    const Dataset data = loose_surfaces(animal.model.data);
    const Verdict known = nameless(data);
    for (const Way& way : ways_of(data)) EXPECT_EQ(nameless(way.data), known) << way.name;
}

/// Each triangle a surface's own points, as STL files have it.
Dataset as_soup(const Dataset& data) {
    Dataset soup = data;
    for (Object& object : soup.objects) {
        auto& surface = std::get<Surface>(object);
        std::vector<Vec3> points;
        for (std::uint32_t& corner : surface.polygons.corners) {
            points.push_back(surface.points[corner]);
            corner = static_cast<std::uint32_t>(points.size() - 1);
        }
        surface.points = std::move(points);
    }
    return soup;
}

TEST_P(RewrittenZoo, IsJudgedTheSameAsASoup) {
    const Animal animal = GetParam().make();
    const Dataset data = loose_surfaces(animal.model.data);
    Verdict known = nameless(data), soup = nameless(as_soup(data));
    soup.findings.erase("M08");
    EXPECT_EQ(soup, known);
}

TEST_P(RewrittenZoo, IsJudgedTheSameWhateverWayLooseTrianglesAreWound) {
    const Animal animal = GetParam().make();
    const Dataset data = loose_surfaces(animal.model.data);
    const Verdict known = nameless(data);
    std::mt19937 random(11);
    Dataset wound = data;
    for (Object& object : wound.objects) {
        auto& corners = std::get<Surface>(object).polygons.corners;
        for (std::size_t t = 0; t < corners.size(); t += 3) {
            if (random() % 2 == 0) std::swap(corners[t], corners[t + 1]);
        }
    }
    Verdict found = nameless(wound);
    found.findings.erase("M05");
    EXPECT_EQ(found, known);
}

TEST(ABodyThatTouchesTheSkinInAPoint, IsInsideWhicheverOfItsPointsComesFirst) {
    for (const Species& species : shell_species()) {
        if (std::string(species.name).find("in_a_point") == std::string::npos) continue;
        const Animal animal = species.make();
        const Verdict known = verdict(animal.model.data);
        for (std::size_t object = 0; object < animal.model.data.objects.size(); ++object) {
            const std::size_t count = std::get<Surface>(animal.model.data.objects[object]).polygons.size();
            for (std::size_t first = 0; first < 3 * count; first += 5) {
                Dataset data = animal.model.data;
                auto& corners = std::get<Surface>(data.objects[object]).polygons.corners;
                std::ranges::rotate(corners, corners.begin() + static_cast<std::ptrdiff_t>(first / 3 * 3));
                std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(first % 3), corners.begin() + 3);
                ASSERT_EQ(verdict(data), known) << species.name << ", corner " << first;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Models, RewrittenZoo, ::testing::ValuesIn(whole_zoo()), [](const auto& species) { return species.param.name; });

}  // namespace
}  // namespace geomend
