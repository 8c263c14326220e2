// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <initializer_list>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "model/dataset.h"

namespace geomend::test {

using Triangle = std::array<Vec3, 3>;

/// Two triangles for a quadrangle a b c d.
inline std::vector<Triangle> quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) { return {{a, b, c}, {a, c, d}}; }

inline std::vector<Triangle> joined(std::initializer_list<std::vector<Triangle>> pieces) {
    std::vector<Triangle> all;
    for (const auto& piece : pieces) all.insert(all.end(), piece.begin(), piece.end());
    return all;
}

/// Makes a Dataset with one StatedModel over surfaces of loose triangles. Equal positions are one point in a part.
class ModelMaker {
public:
    ModelMaker() { data.models.emplace_back().name = "made"; }

    /// Adds a surface of one part; the number of its face is the number of faces so far.
    std::uint32_t add(const std::string& name, FeatureRole role, const std::vector<Triangle>& triangles) {
        return add_parts(name, role, {triangles})[0];
    }

    std::vector<std::uint32_t> add_parts(const std::string& name, FeatureRole role, const std::vector<std::vector<Triangle>>& parts) {
        Surface surface;
        surface.info.name = name;
        surface.info.role = role;
        const auto object = static_cast<std::uint32_t>(data.objects.size());
        std::vector<std::uint32_t> numbers;
        for (std::uint32_t p = 0; p < parts.size(); ++p) {
            if (parts.size() > 1) surface.parts.push_back({static_cast<std::uint32_t>(surface.points.size()), surface.polygons.size()});
            std::map<Vec3, std::uint32_t> known;
            for (const Triangle& t : parts[p]) {
                std::array<std::uint32_t, 3> corners{};
                for (std::size_t i = 0; i < 3; ++i) {
                    const auto [at, is_new] = known.emplace(t[i], static_cast<std::uint32_t>(surface.points.size()));
                    if (is_new) surface.points.push_back(t[i]);
                    corners[i] = at->second;
                }
                surface.polygons.push_back(corners);
            }
            StatedModel::Face face;
            face.number = static_cast<std::int64_t>(model().faces.size()) + 1;
            face.object = object;
            face.part = p;
            face.interface_name = name;
            face.role = role;
            if (!parts[p].empty()) face.key = parts[p][0];
            numbers.push_back(static_cast<std::uint32_t>(model().faces.size()));
            model().faces.push_back(face);
        }
        data.objects.emplace_back(std::move(surface));
        return numbers;
    }

    /// Signs as in a Gocad REGION list; faces count from 1.
    void region(const std::string& name, std::initializer_list<int> faces) {
        StatedModel::Region r;
        r.name = name;
        r.universe = name == "Universe";
        for (const int f : faces) r.sides.push_back({static_cast<std::uint32_t>(std::abs(f)) - 1, f > 0});
        model().regions.push_back(std::move(r));
    }

    StatedModel& model() { return data.models.front(); }
    Surface& surface(std::size_t object) { return std::get<Surface>(data.objects[object]); }

    Dataset data;
};

/// Two unit cubes on top of each other with a horizon between them: normals of the skin point outwards.
inline ModelMaker two_blocks() {
    ModelMaker m;
    const auto at = [](double x, double y, double z) { return Vec3{x, y, z}; };
    m.add("bottom", FeatureRole::boundary, quad(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)));
    m.add("top", FeatureRole::boundary, quad(at(0, 0, 2), at(1, 0, 2), at(1, 1, 2), at(0, 1, 2)));
    m.add("middle", FeatureRole::horizon, quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)));
    const auto side = [&](double x0, double y0, double x1, double y1) {
        return std::vector<std::vector<Triangle>>{quad(at(x0, y0, 0), at(x1, y1, 0), at(x1, y1, 1), at(x0, y0, 1)),
                                                  quad(at(x0, y0, 1), at(x1, y1, 1), at(x1, y1, 2), at(x0, y0, 2))};
    };
    m.add_parts("south", FeatureRole::boundary, side(0, 0, 1, 0));  // faces 4, 5
    m.add_parts("east", FeatureRole::boundary, side(1, 0, 1, 1));   // 6, 7
    m.add_parts("north", FeatureRole::boundary, side(1, 1, 0, 1));  // 8, 9
    m.add_parts("west", FeatureRole::boundary, side(0, 1, 0, 0));   // 10, 11
    m.region("Universe", {1, 2, 4, 5, 6, 7, 8, 9, 10, 11});
    m.region("Lower", {-1, -3, -4, -6, -8, -10});
    m.region("Upper", {3, -2, -5, -7, -9, -11});
    m.model().layers.push_back({"Base", {1}, {}});
    m.model().layers.push_back({"Cover", {2}, {}});
    return m;
}

/// A box with outward normals, as one closed surface.
inline std::vector<Triangle> box(const Vec3& low, const Vec3& high) {
    const auto at = [&](int x, int y, int z) {
        return Vec3{x != 0 ? high[0] : low[0], y != 0 ? high[1] : low[1], z != 0 ? high[2] : low[2]};
    };
    return joined({quad(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)), quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)),
                   quad(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)), quad(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)),
                   quad(at(1, 1, 0), at(0, 1, 0), at(0, 1, 1), at(1, 1, 1)), quad(at(0, 1, 0), at(0, 0, 0), at(0, 0, 1), at(0, 1, 1))});
}

inline std::size_t count_code(const Dataset& data, const std::string& code) {
    return static_cast<std::size_t>(
        std::count_if(data.findings.begin(), data.findings.end(), [&](const Finding& f) { return f.code == code; }));
}

}  // namespace geomend::test
