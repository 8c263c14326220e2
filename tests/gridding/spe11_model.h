// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "model/objects.h"

// The section of the eleventh SPE comparative solution project, as its Gmsh geometry states it: polygons of facies, upright, made a slab.

namespace geomend::gridding::test {

using Corner = std::array<double, 2>;

/// Polygons and the facies of each, x along and y up.
struct Spe11Section {
    std::vector<std::vector<Corner>> polygons;
    std::vector<int> facies;
    /// By the polygon formula.
    std::map<int, double> areas() const;
};

inline double area_of_polygon(const std::vector<Corner>& p) {
    double twice = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Corner &a = p[i], &b = p[(i + 1) % p.size()];
        twice += a[0] * b[1] - b[0] * a[1];
    }
    return twice / 2;
}

inline std::map<int, double> Spe11Section::areas() const {
    std::map<int, double> sums;
    for (std::size_t i = 0; i < polygons.size(); ++i) sums[facies[i]] += std::abs(area_of_polygon(polygons[i]));
    return sums;
}

/// Reads points, lines, loops, surfaces and physical surfaces; each of their statements stands on a line of its own.
inline Spe11Section read_spe11(const std::filesystem::path& path) {
    std::map<int, Corner> points;
    std::map<int, std::vector<int>> lines, loops, surfaces, physical;
    const std::regex statement(R"(^\s*(Point|Line|Curve Loop|Plane Surface|Physical Surface)\((?:"[^"]*", *)?(\d+)\) *= *\{([^}]*)\};)");
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        std::smatch parts;
        if (!std::regex_search(line, parts, statement)) continue;
        const std::string kind = parts[1], list = parts[3];
        std::vector<double> numbers;
        std::size_t at = 0;
        while (at < list.size()) {
            const std::size_t end = std::min(list.find(',', at), list.size());
            numbers.push_back(std::atof(list.substr(at, end - at).c_str()));
            at = end + 1;
        }
        const int tag = std::stoi(parts[2]);
        const std::vector<int> whole(numbers.begin(), numbers.end());
        if (kind == "Point") points[tag] = {numbers[0], numbers[1]};
        else if (kind == "Line") lines[tag] = whole;
        else if (kind == "Curve Loop") loops[tag] = whole;
        else if (kind == "Plane Surface") surfaces[tag] = whole;
        else physical[tag] = whole;
    }
    Spe11Section section;
    for (const auto& [facies, parts] : physical) {
        for (const int surface : parts) {
            std::vector<Corner> polygon;
            for (const int edge : loops.at(surfaces.at(surface).at(0)))
                polygon.push_back(points.at(lines.at(std::abs(edge)).at(edge > 0 ? 0 : 1)));
            section.polygons.push_back(std::move(polygon));
            section.facies.push_back(facies);
        }
    }
    return section;
}

/// Triangles of a simple polygon by cutting off ears.
inline std::vector<std::array<std::size_t, 3>> ears_of(const std::vector<Corner>& p) {
    std::vector<std::size_t> left(p.size());
    const bool turns_left = area_of_polygon(p) > 0;
    for (std::size_t i = 0; i < p.size(); ++i) left[i] = turns_left ? i : p.size() - 1 - i;
    const auto turn = [&](std::size_t a, std::size_t b, std::size_t c) {
        return (p[b][0] - p[a][0]) * (p[c][1] - p[a][1]) - (p[c][0] - p[a][0]) * (p[b][1] - p[a][1]);
    };
    std::vector<std::array<std::size_t, 3>> triangles;
    while (left.size() > 2) {
        bool cut = false;
        for (std::size_t i = 0; i < left.size() && !cut; ++i) {
            const std::size_t a = left[(i + left.size() - 1) % left.size()], b = left[i], c = left[(i + 1) % left.size()];
            if (turn(a, b, c) <= 0) continue;
            cut = true;
            for (const std::size_t q : left) {
                if (q == a || q == b || q == c) continue;
                if (turn(a, b, q) >= 0 && turn(b, c, q) >= 0 && turn(c, a, q) >= 0) cut = false;
            }
            if (!cut) continue;
            triangles.push_back({a, b, c});
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
        }
        if (!cut) break;
    }
    return triangles;
}

/// The section as a slab of wedges between y = 0 and a width, upright, with an attribute FACIES.
inline CellMesh spe11_slab(const Spe11Section& section, double width) {
    CellMesh mesh;
    mesh.info.name = "facies";
    std::vector<std::int32_t> facies;
    for (std::size_t i = 0; i < section.polygons.size(); ++i) {
        const auto first = static_cast<std::uint32_t>(mesh.points.size());
        const auto& polygon = section.polygons[i];
        const auto n = static_cast<std::uint32_t>(polygon.size());
        for (const double y : {0.0, width}) {
            for (const Corner& c : polygon) mesh.points.push_back({c[0], y, c[1]});
        }
        for (const auto& t : ears_of(polygon)) {
            const auto a = first + static_cast<std::uint32_t>(t[0]), b = first + static_cast<std::uint32_t>(t[1]),
                       c = first + static_cast<std::uint32_t>(t[2]);
            mesh.add_cell(CellType::wedge, std::vector<std::uint32_t>{a, b, c, a + n, b + n, c + n});
            facies.push_back(section.facies[i]);
        }
    }
    Attribute attribute;
    attribute.name = "FACIES";
    attribute.location = AttributeLocation::cell;
    attribute.values = std::move(facies);
    mesh.info.attributes.push_back(std::move(attribute));
    return mesh;
}

}  // namespace geomend::gridding::test
