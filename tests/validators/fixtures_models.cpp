// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "validators/fixtures.h"
#include "validators/layered_model.h"

namespace geomend::testing {

namespace {

using test::ModelMaker;
using Triangles = std::vector<test::Triangle>;

// ---- loose surfaces

Surface loose_surface(const std::string& name, const Triangles& triangles, bool apart = false) {
    Surface surface;
    surface.info.name = name;
    std::map<Vec3, std::uint32_t> known;
    for (const auto& t : triangles) {
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto at = known.find(t[i]);
            corners[i] = apart || at == known.end() ? add_point(surface, t[i]) : at->second;
            known.emplace(t[i], corners[i]);
        }
        surface.polygons.push_back(corners);
    }
    return surface;
}

Dataset loose(const std::vector<Triangles>& surfaces) {
    Dataset data;
    for (std::size_t s = 0; s < surfaces.size(); ++s) data.objects.emplace_back(loose_surface("s" + std::to_string(s + 1), surfaces[s]));
    return data;
}

/// A strip along y from 0 to 1 over a way in the plane of x and z.
Triangles strip(const std::vector<std::array<double, 2>>& way) {
    Triangles all;
    for (std::size_t k = 0; k + 1 < way.size(); ++k) {
        const auto [x, z] = way[k];
        const auto [u, w] = way[k + 1];
        const auto q = test::quad({x, 0, z}, {u, 0, w}, {u, 1, w}, {x, 1, z});
        all.insert(all.end(), q.begin(), q.end());
    }
    return all;
}

/// A hook: it goes out, up, back, and down to a height above its own beginning.
Triangles hook(double end) { return strip({{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, end}}); }
/// The same, with a single triangle that points down.
Triangles hook_with_tip(double height) {
    Triangles all = strip({{0, 0}, {4, 0}, {4, 2}, {2, 2}});
    all.push_back({{{2, 1, 2}, {2, 0, 2}, {2, 0.375, height}}});
    return all;
}
/// A spiral whose end comes back to lie on its beginning, or to hang above it.
Triangles spiral(double height) { return strip({{0, 0}, {4, 0}, {4, 2}, {-1, 2}, {-1, height}, {2, height}}); }

/// 3 x 3 quadrangles; the height of the four inner nodes, and without the middle one where asked.
Triangles sheet(double z, double inner, bool hole = false) {
    Triangles all;
    const auto node = [&](int i, int j) {
        const bool inside = i > 0 && i < 3 && j > 0 && j < 3;
        return Vec3{double(i), double(j), i == 1 && j == 1 ? inner : inside ? (z + inner) / 2 : z};
    };
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            if (hole && i == 1 && j == 1) continue;
            const auto q = test::quad(node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1));
            all.insert(all.end(), q.begin(), q.end());
        }
    }
    return all;
}

/// A box, whole or without its last triangle.
Dataset box_of(std::size_t left_out) {
    Triangles all = test::box({0, 0, 0}, {4, 3, 2});
    all.resize(all.size() - left_out);
    return loose({all});
}

Dataset triangle(double x, double y) { return loose({{{{{0, 0, 0}, {1, 0, 0}, {x, y, 0}}}}}); }
/// Two triangles at one edge that enclose an angle in degrees: of one surface, or of two.
Triangles leaf(double degrees) {
    const double a = degrees * std::numbers::pi / 180;
    return {{{{0, 0, 0}, {1, 0, 0}, {0.5, std::cos(a), std::sin(a)}}}};
}
Dataset book(double degrees, bool one) {
    const Triangles a = leaf(0);
    Triangles b = leaf(degrees);
    std::swap(b[0][0], b[0][1]);
    return one ? loose({test::joined({a, b})}) : loose({a, b});
}

Dataset moebius(bool turned) {
    constexpr int n = 12;
    const auto at = [&](int k, double w) {
        const double a = 2 * std::numbers::pi * k / n, b = turned ? a / 2 : 0;
        return Vec3{(2 + w * std::cos(b)) * std::cos(a), (2 + w * std::cos(b)) * std::sin(a), w * std::sin(b)};
    };
    Surface surface;
    surface.info.name = "strip";
    for (int k = 0; k < n; ++k) {
        add_point(surface, at(k, -0.5));
        add_point(surface, at(k, 0.5));
    }
    for (std::uint32_t k = 0; k < n; ++k) {
        const bool last = k + 1 == n;
        const std::uint32_t a = 2 * k, b = a + 1, c = !last ? a + 2 : turned ? 1 : 0, d = !last ? a + 3 : turned ? 0 : 1;
        add_triangle(surface, a, b, d);
        add_triangle(surface, a, d, c);
    }
    Dataset data;
    data.objects.emplace_back(surface);
    return data;
}

Dataset soup(bool apart) {
    Dataset data;
    data.objects.emplace_back(loose_surface("soup", test::box({0, 0, 0}, {1, 1, 1}), apart));
    return data;
}

Dataset far_point(double x) {
    Dataset data = loose({sheet(0, 0)});
    std::get<Surface>(data.objects[0]).points[0][0] = x;
    return data;
}

/// A sheet of which one inner node has another height.
Dataset spiked(double z) {
    Dataset data = loose({sheet(0, 0)});
    for (Vec3& p : std::get<Surface>(data.objects[0]).points) {
        if (p[0] == 1 && p[1] == 1) p[2] = z;
    }
    return data;
}

// ---- the layered model, and what is done to it

Dataset layered() { return LayeredModel().data(); }

template <class Change>
Dataset layered_with(const Change& change) {
    LayeredModel model;
    change(model);
    return model.data();
}

/// The point of a surface at a node of the model; of the last part where several have one.
std::uint32_t point_at(Surface& surface, int i, int j, int sheet_number) {
    const Vec3 at = LayeredModel::node(i, j, sheet_number);
    for (auto p = static_cast<std::uint32_t>(surface.points.size()); p-- > 0;) {
        if (surface.points[p] == at) return p;
    }
    throw std::out_of_range("no such node");
}

std::array<std::uint32_t, 3> last_triangle(const Surface& surface) {
    const auto end = surface.polygons.corners.end();
    return {*(end - 3), *(end - 2), *(end - 1)};
}

void remove_triangle(Surface& surface, std::uint64_t p) {
    auto& corners = surface.polygons.corners;
    corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(3 * p), corners.begin() + static_cast<std::ptrdiff_t>(3 * p + 3));
    for (auto& part : surface.parts) part.first_polygon -= part.first_polygon > p ? 1 : 0;
}

Dataset degenerate() {
    return layered_with([](LayeredModel& m) {
        Surface& top = m.surface("top");
        const auto t = last_triangle(top);
        add_triangle(top, t[0], t[1], t[1]);
    });
}
Dataset fin() {
    return layered_with([](LayeredModel& m) {
        Surface& top = m.surface("top");
        Vec3 tip = LayeredModel::node(4, 1, 3);
        tip[2] -= 0.15;
        add_triangle(top, point_at(top, 4, 1, 3), point_at(top, 4, 2, 3), add_point(top, tip));
    });
}
Dataset part_apart() {
    return layered_with([](LayeredModel& m) {
        Surface& top = m.surface("top");
        add_triangle(top, add_point(top, {0.5, 0.5, 0.3}), add_point(top, {0.6, 0.5, 0.3}), add_point(top, {0.5, 0.6, 0.3}));
    });
}
Dataset hole_in(const char* name) {
    LayeredModel model;
    remove_triangle(model.surface(name), 9);
    return model.data();
}
Dataset hole_in_wall() { return hole_in("south"); }
Dataset hole_in_horizon() { return hole_in("lower"); }

/// Every part shrinks about its middle.
Dataset shrunk() {
    return layered_with([](LayeredModel& m) {
        for (const std::string& name : layered_names()) {
            Surface& surface = m.surface(name);
            const auto bounds = part_bounds(surface);
            for (std::size_t part = 0; part + 1 < bounds.size(); ++part) {
                std::vector<std::uint32_t> points(surface.polygons.corners.begin() + static_cast<std::ptrdiff_t>(3 * bounds[part]),
                                                  surface.polygons.corners.begin() + static_cast<std::ptrdiff_t>(3 * bounds[part + 1]));
                std::ranges::sort(points);
                points.erase(std::unique(points.begin(), points.end()), points.end());
                Vec3 middle{};
                for (const std::uint32_t p : points) {
                    for (std::size_t k = 0; k < 3; ++k) middle[k] += surface.points[p][k] / static_cast<double>(points.size());
                }
                for (const std::uint32_t p : points) {
                    for (std::size_t k = 0; k < 3; ++k) surface.points[p][k] += 0.1 * (middle[k] - surface.points[p][k]);
                }
            }
        }
    });
}

/// The triangles on one side of a way through the top get a point of their own.
Dataset open_seam() {
    return layered_with([](LayeredModel& m) {
        Surface& top = m.surface("top");
        const Vec3 at = LayeredModel::node(1, 2, 3);
        const std::uint32_t point = point_at(top, 1, 2, 3), twin = add_point(top, at);
        for (std::size_t p = 0; p < top.polygons.size(); ++p) {
            double middle = 0;
            for (std::size_t i = 0; i < 3; ++i) middle += top.points[top.polygons.corners[3 * p + i]][0] / 3;
            for (std::size_t i = 0; i < 3 && middle > at[0]; ++i) {
                if (top.polygons.corners[3 * p + i] == point) top.polygons.corners[3 * p + i] = twin;
            }
        }
    });
}

template <int sheet_number>
Dataset raised(double by) {
    LayeredModel model;
    Surface& surface = model.surface(sheet_number == 1 ? "lower" : "upper");
    surface.points[point_at(surface, 1, 2, sheet_number)][2] += by;
    return model.data();
}
Dataset upper_through_top() { return raised<2>(1); }
Dataset upper_below_top() { return raised<2>(0.1); }
Dataset lower_through_upper() { return raised<1>(1); }
Dataset lower_below_upper() { return raised<1>(0.1); }

/// The part of a horizon in one block loses all triangles that have no inner point.
Dataset horizon_ends_inside() {
    return layered_with([](LayeredModel& m) {
        Surface& lower = m.surface("lower");
        std::vector<std::uint8_t> inner(lower.points.size(), 0);
        for (const int i : {1, 2}) {
            for (const int j : {1, 2, 3}) inner[point_at(lower, i, j, 1)] = 1;
        }
        for (std::uint64_t p = part_bounds(lower)[1]; p-- > 0;) {
            const auto c = lower.polygons[p];
            if (inner[c[0]] + inner[c[1]] + inner[c[2]] == 0) remove_triangle(lower, p);
        }
    });
}

Dataset with_extra(FeatureRole role, const test::Triangle& t) {
    LayeredModel model;
    model.maker.add("extra", role, {t});
    return model.data();
}
/// A small triangle that stands on the bottom, or hangs above it.
template <int eighths>
Dataset standing() {
    const double z = 0.125 * eighths;
    return with_extra(FeatureRole::fault, {{{0.375, 0.3125, z}, {0.4375, 0.34375, z}, {0.375, 0.3125, z + 0.25}}});
}
template <int eighths>
Dataset lying() {
    const double z = 0.125 * eighths;
    return with_extra(FeatureRole::fault, {{{0.375, 0.3125, z}, {0.625, 0.3125, z}, {0.375, 0.5625, z}}});
}
template <int eighths>
Dataset pointing() {
    const double z = 0.125 * eighths;
    return with_extra(FeatureRole::fault, {{{0.375, 0.3125, z}, {0.625, 0.3125, z + 0.25}, {0.375, 0.4375, z + 0.25}}});
}
Dataset outside() { return with_extra(FeatureRole::fault, {{{1, 0, 3}, {1.3, 0, 3}, {1, 0.3, 3.2}}}); }
Dataset inside() { return with_extra(FeatureRole::fault, {{{1, 0.4, 0.3}, {1.3, 0.4, 0.3}, {1, 0.7, 0.5}}}); }

Dataset regions_merged() {
    return layered_with([](LayeredModel& m) {
        auto& regions = m.maker.model().regions;
        const std::uint32_t between = regions[1].sides[1].face;
        std::erase_if(regions[1].sides, [&](const auto& side) { return side.face == between; });
        for (const auto& side : regions[3].sides) {
            if (side.face != between) regions[1].sides.push_back(side);
        }
    });
}
Dataset side_twice() {
    return layered_with([](LayeredModel& m) {
        auto& regions = m.maker.model().regions;
        regions[4].sides.push_back(regions[1].sides[0]);
    });
}
Dataset lowest_layer(double thickness) {
    LayeredModel model;
    for (const std::string& name : layered_names()) {
        for (Vec3& p : model.surface(name).points) {
            for (int i = 0; i <= LayeredModel::nx; ++i) {
                for (int j = 0; j <= LayeredModel::ny; ++j) {
                    if (p == LayeredModel::node(i, j, 1)) p[2] = thickness;
                }
            }
        }
    }
    return model.data();
}
Dataset thin_layer() { return lowest_layer(0.001); }
Dataset thick_layer() { return lowest_layer(0.1); }

Dataset stated_border(bool along_edge) {
    LayeredModel model;
    Surface& top = model.surface("top");
    const auto t = last_triangle(top);
    const auto first = top.polygons[part_bounds(top)[1]];
    top.border_starts.push_back({7, t[0], along_edge ? t[1] : first[0]});
    return model.data();
}
Dataset wrong_border() { return stated_border(false); }
Dataset right_border() { return stated_border(true); }

Dataset drawn_back() {
    return layered_with([](LayeredModel& m) {
        Surface& lower = m.surface("lower");
        const double x = LayeredModel::node(LayeredModel::fault, 0, 0)[0];
        const std::uint64_t end = part_bounds(lower)[1];
        std::vector<std::uint8_t> used(lower.points.size(), 0);
        for (std::uint64_t c = 0; c < 3 * end; ++c) used[lower.polygons.corners[c]] = 1;
        for (std::size_t p = 0; p < used.size(); ++p) {
            if (used[p] != 0 && lower.points[p][0] == x) lower.points[p][0] -= 0.002;
        }
    });
}

Dataset two_blocks() { return test::two_blocks().data; }
/// The horizon is there a second time, with the same vertices.
Dataset doubled_horizon() {
    ModelMaker m = test::two_blocks();
    m.add("again", FeatureRole::horizon, test::quad({0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}));
    return m.data;
}

template <class Rename>
Dataset renamed(const Rename& rename) {
    LayeredModel model;
    rename(model.maker.model());
    return model.data();
}
Dataset region_name_twice() {
    return renamed([](StatedModel& m) { m.regions[2].name = m.regions[1].name; });
}
Dataset region_name_in_capitals() {
    return renamed([](StatedModel& m) { m.regions[2].name = "BLOCK_00"; });
}
Dataset region_named_like_a_surface() {
    return renamed([](StatedModel& m) { m.regions[2].name = "upper"; });
}
Dataset side_turned() {
    return renamed([](StatedModel& m) { m.regions[1].sides[1].front = !m.regions[1].sides[1].front; });
}
Dataset universe_open() {
    return renamed([](StatedModel& m) { m.regions[0].sides.pop_back(); });
}
Dataset layers_swapped_across_the_fault() {
    return renamed([](StatedModel& m) { std::swap(m.layers[0].regions[1], m.layers[1].regions[1]); });
}
/// A surface that the model does not state, at a distance from its lowest layer or through its bottom.
Dataset beside_the_model(double low) {
    LayeredModel model;
    model.data().objects.emplace_back(loose_surface("beside", {{{{1, 0.4, low}, {1.5, 0.4, low}, {1, 1, 0.4}}}}));
    return model.data();
}
/// The same, at a height above the bottom of the model, which lies at 0.
Dataset level_beside_the_model(double z) {
    LayeredModel model;
    model.data().objects.emplace_back(loose_surface("beside", {{{{1, 0.4, z}, {1.5, 0.4, z}, {1, 1, z}}}}));
    return model.data();
}
Dataset layer_without_region() {
    return renamed([](StatedModel& m) { m.layers[1].regions.clear(); });
}
Dataset region_in_two_layers() {
    return renamed([](StatedModel& m) { m.layers[1].regions.push_back(m.layers[0].regions[0]); });
}

/// A box from x = 0 to 2 with a fault at x = 1; the horizon lies at 0.8 before it, and by the throw higher behind it.
Dataset faulted_box(double fault_throw) {
    const std::set<double> heights{0, 0.8, 0.8 + fault_throw, 2};
    const std::vector<double> on_fault(heights.begin(), heights.end());
    const auto at = [](double x, double z, bool back) { return Vec3{x, back ? 1.0 : 0.0, z}; };
    const auto along_y = [&](double x, double z, double u, double w) {
        return test::quad(at(x, z, false), at(u, w, false), at(u, w, true), at(x, z, true));
    };
    // One side of a block: a fan from its outer corner over the points on the fault.
    const auto side = [&](double x, double low, double high, bool back) {
        std::vector<Vec3> corners{at(x, low, back)};
        for (const double z : on_fault) {
            if (z >= low && z <= high) corners.push_back(at(1, z, back));
        }
        corners.push_back(at(x, high, back));
        Triangles all;
        for (std::size_t k = 1; k + 1 < corners.size(); ++k) all.push_back({corners[0], corners[k], corners[k + 1]});
        return all;
    };
    ModelMaker m;
    const double left = 0.8, right = 0.8 + fault_throw;
    m.add_parts("bottom", FeatureRole::boundary, {along_y(0, 0, 1, 0), along_y(1, 0, 2, 0)});
    m.add_parts("top", FeatureRole::boundary, {along_y(0, 2, 1, 2), along_y(1, 2, 2, 2)});
    m.add_parts("horizon", FeatureRole::horizon, {along_y(0, left, 1, left), along_y(1, right, 2, right)});
    m.add_parts("west", FeatureRole::boundary, {along_y(0, 0, 0, left), along_y(0, left, 0, 2)});
    m.add_parts("east", FeatureRole::boundary, {along_y(2, 0, 2, right), along_y(2, right, 2, 2)});
    for (const bool back : {false, true}) {
        m.add_parts(back ? "north" : "south", FeatureRole::boundary,
                    {side(0, 0, left, back), side(0, left, 2, back), side(2, 0, right, back), side(2, right, 2, back)});
    }
    std::vector<Triangles> fault;
    for (std::size_t k = 0; k + 1 < on_fault.size(); ++k) fault.push_back(along_y(1, on_fault[k], 1, on_fault[k + 1]));
    m.add_parts("fault", FeatureRole::fault, fault);
    return m.data;
}
Dataset fault_without_throw() { return faulted_box(0); }
Dataset fault_with_throw() { return faulted_box(0.4); }

Dataset horizons_change_places() {
    return layered_with([](LayeredModel& m) {
        for (auto& face : m.maker.model().faces) {
            if (face.part != 1) continue;
            if (face.interface_name == "lower") face.interface_name = "upper";
            else if (face.interface_name == "upper") face.interface_name = "lower";
        }
    });
}

/// Two horizons that share a line: they pass through each other, or touch as a roof and a bowl.
Dataset horizons_at_a_line(bool pass) {
    const auto half = [](double x, double z) { return test::quad({x, 0, z}, {1, 0, 1}, {1, 1, 1}, {x, 1, z}); };
    ModelMaker m;
    m.add_parts("A", FeatureRole::horizon, {half(0, 0.5), half(2, pass ? 1.5 : 0.5)});
    m.add_parts("B", FeatureRole::horizon, {half(0, 1.5), half(2, pass ? 0.5 : 1.5)});
    return m.data;
}

Dataset near_points() {
    return layered_with([](LayeredModel& m) {
        Surface& top = m.surface("top");
        top.points[point_at(top, 6, 4, 3)][0] += 1e-7;  // the tolerance is 5.4e-7
    });
}
Dataset unused_point() {
    return layered_with([](LayeredModel& m) { add_point(m.surface("top"), {1, 1, 1}); });
}
Dataset flat_triangle() { return triangle(0.5, 1e-8); }
Dataset sound_triangle() { return triangle(0.5, 0.5); }
Dataset repeated_triangle() {
    return layered_with([](LayeredModel& m) {
        Surface& top = m.surface("top");
        const auto t = last_triangle(top);
        add_triangle(top, t[1], t[2], t[0]);
    });
}
Dataset turned_triangle() {
    return layered_with([](LayeredModel& m) {
        auto& corners = m.surface("top").polygons.corners;
        std::swap(corners[30], corners[31]);
    });
}

constexpr Fixture fixtures[] = {
    {"B01", degenerate, layered},
    {"B02", [] { return loose({hook(-2)}); }, [] { return loose({hook(0.5)}); }},
    {"B03", fin, layered},
    {"B04", part_apart, layered},
    {"B05", hole_in_wall, layered},
    {"B06", shrunk, layered},
    {"B07", open_seam, layered},
    {"B08", upper_through_top, upper_below_top},
    {"B09", horizon_ends_inside, layered},
    {"B10", lower_through_upper, lower_below_upper},
    {"B11", standing<0>, standing<1>},
    {"B12", hole_in_horizon, layered},
    {"B13", regions_merged, layered},
    {"B14", side_twice, layered},
    {"B15", thin_layer, thick_layer},
    {"B16", outside, inside},
    {"B17", doubled_horizon, two_blocks},
    {"B18", degenerate, layered},
    {"B19", wrong_border, right_border},
    {"B20", lying<0>, lying<1>},
    {"B22", pointing<0>, pointing<1>},
    {"B23", drawn_back, layered},
    {"B24",
     [] {
         return loose({sheet(0, 0), sheet(1, 0.001)});
     },
     [] {
         return loose({sheet(0, 0), sheet(1, 0.1)});
     }},
    {"B25", inside, layered},
    {"B26", [] { return loose({spiral(0)}); }, [] { return loose({spiral(0.5)}); }},
    {"B27", [] { return loose({hook(0)}); }, [] { return loose({hook(0.5)}); }},
    {"B28", [] { return loose({hook_with_tip(0)}); }, [] { return loose({hook_with_tip(0.5)}); }},
    {"B29", [] { return box_of(1); }, [] { return box_of(0); }},
    {"B30", side_turned, layered},
    {"B31", universe_open, layered},
    {"B32", [] { return beside_the_model(-0.4); }, [] { return beside_the_model(0.2); }},
    {"B33", [] { return level_beside_the_model(0); }, [] { return level_beside_the_model(0.2); }},
    {"G01", region_name_twice, layered},
    {"G02", layer_without_region, layered},
    {"G03", fault_without_throw, fault_with_throw},
    {"G04", horizons_change_places, layered},
    {"G05", [] { return horizons_at_a_line(true); }, [] { return horizons_at_a_line(false); }},
    {"G06", region_name_in_capitals, layered},
    {"G07", region_in_two_layers, layered},
    {"G08", region_named_like_a_surface, layered},
    {"G09", layers_swapped_across_the_fault, layered},
    {"M01", near_points, layered},
    {"M02", unused_point, layered},
    {"M03", flat_triangle, sound_triangle},
    {"M04", repeated_triangle, layered},
    {"M05", turned_triangle, layered},
    {"M06", [] { return moebius(true); }, [] { return moebius(false); }},
    {"M07", [] { return loose({sheet(0, 0, true)}); }, [] { return loose({sheet(0, 0)}); }},
    {"M08", [] { return soup(true); }, [] { return soup(false); }},
    {"M09", [] { return far_point(1e20); }, [] { return far_point(-1); }},
    {"M15", [] { return spiked(-99999); }, [] { return spiked(-1); }},
    {"Q01", [] { return triangle(0.5, 0.008); }, [] { return triangle(0.5, 0.01); }},
    {"Q02", [] { return triangle(0, 0.001); }, [] { return triangle(0, 0.01); }},
    {"Q03", [] { return book(9, true); }, [] { return book(11, true); }},
    {"Q04", [] { return book(4.5, false); }, [] { return book(5.5, false); }},
};

}  // namespace

std::span<const Fixture> model_fixtures() { return fixtures; }

}  // namespace geomend::testing
