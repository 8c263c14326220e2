// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/vec3.h"

// Models of layers in a box, as files of Gocad surfaces.

namespace geomend::test {

/// Sheets of squares as a file of Gocad surfaces.
class Sheets {
public:
    using Map = std::function<Vec3(const Vec3&)>;
    explicit Sheets(Map map = [](const Vec3& p) { return p; }) : map_(std::move(map)) { text_.precision(17); }

    /// The squares between places a[i], b[j], each of two triangles; those with two equal corners are one triangle.
    void add(const std::string& name, const std::vector<double>& a, const std::vector<double>& b,
             const std::function<Vec3(double, double)>& place) {
        std::map<Vec3, std::size_t> number;
        std::ostringstream triangles;
        text_ << "GOCAD TSurf 1\nHEADER {\nname:" << name << "\n}\nTFACE\n";
        const auto vertex = [&](const Vec3& p) {
            const auto [at, is_new] = number.emplace(p, number.size() + 1);
            const Vec3 q = map_(p);
            if (is_new) text_ << "VRTX " << at->second << ' ' << q[0] << ' ' << q[1] << ' ' << q[2] << '\n';
            return at->second;
        };
        const auto triangle = [&](std::size_t p, std::size_t q, std::size_t r) {
            if (p != q && q != r && r != p) triangles << "TRGL " << p << ' ' << q << ' ' << r << '\n';
        };
        for (std::size_t j = 0; j + 1 < b.size(); ++j) {
            for (std::size_t i = 0; i + 1 < a.size(); ++i) {
                const std::size_t p = vertex(place(a[i], b[j])), q = vertex(place(a[i + 1], b[j])), r = vertex(place(a[i + 1], b[j + 1])),
                                  s = vertex(place(a[i], b[j + 1]));
                triangle(p, q, r);
                triangle(p, r, s);
            }
        }
        text_ << triangles.str() << "END\n";
    }
    std::string text() const { return text_.str(); }

private:
    Map map_;
    std::ostringstream text_;
};

inline std::vector<double> parts(double length, int n) {
    std::vector<double> all;
    for (int i = 0; i <= n; ++i) all.push_back(length * i / n);
    return all;
}

/// Layers between heights over a box of 1000 by 800. \param height of border k at a place \param ends per layer where it ends along x
inline std::string layers(
    std::size_t count, const std::function<double(std::size_t, double)>& height, const std::vector<double>& ends,
    const Sheets::Map& map = [](const Vec3& p) { return p; }) {
    Sheets sheets(map);
    const auto xs = parts(1000, 20), ys = parts(800, 16);
    const auto upto = [&](double end) {
        std::vector<double> own;
        for (const double x : xs) {
            if (x <= end) own.push_back(x);
        }
        return own;
    };
    for (std::size_t k = 0; k < count; ++k)
        sheets.add("h" + std::to_string(k), k > 0 ? upto(ends[k - 1]) : xs, ys, [&](double x, double y) {
            return Vec3{x, y, height(k, x)};
        });
    for (std::size_t k = 0; k + 1 < count; ++k) {
        const std::vector<double> sides{0, 1};
        const auto z = [&](double x, double side) { return height(side == 0 ? k : k + 1, x); };
        const std::string name = "side" + std::to_string(k);
        sheets.add(name + "s", upto(ends[k]), sides, [&](double x, double side) { return Vec3{x, 0, z(x, side)}; });
        sheets.add(name + "n", upto(ends[k]), sides, [&](double x, double side) { return Vec3{x, 800, z(x, side)}; });
        sheets.add(name + "w", ys, sides, [&](double y, double side) { return Vec3{0, y, z(0, side)}; });
        if (ends[k] == 1000) sheets.add(name + "e", ys, sides, [&](double y, double side) { return Vec3{1000, y, z(1000, side)}; });
    }
    return sheets.text();
}

}  // namespace geomend::test
