// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "validators/layered_model.h"
#include "validators/registry.h"

// One defect of each kind is planted at random in a sealed model; the right code with the right entity must come out,
// whatever the seed.

namespace geomend {
namespace {

using namespace testing;
using Random = std::mt19937;

/// What must be found.
struct Expected {
    std::string code;
    std::string kind, name;  ///< an entity of the finding
};

std::size_t pick(Random& random, std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random); }
double uniform(Random& random, double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }

/// A part of a surface chosen at random.
struct Place {
    Surface* surface;
    std::size_t part;
    std::uint64_t first, last;  // its polygons

    std::string name() const { return surface->info.name + "_" + std::to_string(part + 1); }
    std::array<std::uint32_t, 3> triangle(std::uint64_t p) const {
        return {surface->polygons.corners[3 * p], surface->polygons.corners[3 * p + 1], surface->polygons.corners[3 * p + 2]};
    }
};

Place place_in(LayeredModel& model, Random& random, const std::vector<std::string>& names, bool last_part = false) {
    Surface& surface = model.surface(names[pick(random, names.size())]);
    const auto bounds = part_bounds(surface);
    const std::size_t part = last_part ? bounds.size() - 2 : pick(random, bounds.size() - 1);
    return {&surface, part, bounds[part], bounds[part + 1]};
}

/// A triangle whose three corners are inside of its part, where that has any; the middle of a part is far from lines.
std::uint64_t any_triangle(const Place& place, Random& random) { return place.first + pick(random, place.last - place.first); }

/// Points of a part that are on none of its borders.
std::vector<std::uint32_t> inner_points(const Place& place) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (std::uint64_t p = place.first; p < place.last; ++p) {
        const auto t = place.triangle(p);
        for (std::size_t i = 0; i < 3; ++i) ++edges[std::minmax(t[i], t[(i + 1) % 3])];
    }
    std::map<std::uint32_t, bool> inner;
    for (const auto& [edge, uses] : edges) {
        for (const std::uint32_t v : {edge.first, edge.second}) {
            const auto at = inner.emplace(v, true).first;
            at->second = at->second && uses == 2;
        }
    }
    std::vector<std::uint32_t> points;
    for (const auto& [point, is_inner] : inner) {
        if (is_inner) points.push_back(point);
    }
    return points;
}

const std::vector<std::string> flat_sheets = {"bottom", "lower", "upper", "top"};

Expected degenerate_triangle(LayeredModel& m, Random& random) {
    const Place at = place_in(m, random, layered_names(), true);
    const auto t = at.triangle(any_triangle(at, random));
    const std::size_t twice = pick(random, 3);
    add_triangle(*at.surface, t[twice], t[twice], t[(twice + 1) % 3]);
    return {"B01", "surface", at.name()};
}

Expected repeated_triangle(LayeredModel& m, Random& random) {
    const Place at = place_in(m, random, layered_names(), true);
    auto t = at.triangle(any_triangle(at, random));
    std::ranges::shuffle(t, random);
    add_triangle(*at.surface, t[0], t[1], t[2]);
    return {"M04", "surface", at.name()};
}

Expected reversed_triangle(LayeredModel& m, Random& random) {
    const Place at = place_in(m, random, layered_names());
    const std::uint64_t p = any_triangle(at, random);
    std::swap(at.surface->polygons.corners[3 * p], at.surface->polygons.corners[3 * p + 1]);
    return {"M05", "surface", at.name()};
}

/// Takes a triangle out; the parts behind it move up.
void remove_triangle(Surface& surface, std::uint64_t p) {
    auto& corners = surface.polygons.corners;
    corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(3 * p), corners.begin() + static_cast<std::ptrdiff_t>(3 * p + 3));
    for (auto& part : surface.parts) part.first_polygon -= part.first_polygon > p ? 1 : 0;
}

Expected hole_in_horizon(LayeredModel& m, Random& random) {
    const Place at = place_in(m, random, {"lower", "upper"});
    remove_triangle(*at.surface, any_triangle(at, random));
    return {"B12", "surface", at.name()};
}

Expected hole_in_boundary_leaks(LayeredModel& m, Random& random) {
    const Place at = place_in(m, random, {"bottom", "top", "south", "north", "west", "east"});
    remove_triangle(*at.surface, any_triangle(at, random));
    return {"B12", "surface", at.name()};
}

Expected region_does_not_close(LayeredModel& m, Random& random) {
    const Place at = place_in(m, random, {"south", "north"});
    remove_triangle(*at.surface, any_triangle(at, random));
    return {"B05", "region", "block_" + std::to_string(at.part / 2) + std::to_string(at.part % 2)};
}

Expected horizon_ends_inside(LayeredModel& m, Random& random) {
    // The part of a horizon in one block loses its edge at the boundary: it ends inside.
    const Place at = place_in(m, random, {"lower", "upper"});
    const auto inner = inner_points(at);
    for (std::uint64_t p = at.last; p-- > at.first;) {
        const auto t = at.triangle(p);
        const bool at_border = std::ranges::none_of(t, [&](std::uint32_t v) { return std::ranges::find(inner, v) != inner.end(); });
        if (at_border) remove_triangle(*at.surface, p);
    }
    return {"B09", "surface", at.name()};
}

Expected horizons_cross(LayeredModel& m, Random& random) {
    const Place at = place_in(m, random, {"lower"});
    const auto inner = inner_points(at);
    at.surface->points[inner[pick(random, inner.size())]][2] += uniform(random, 0.9, 1.1);
    return {"B10", "surface", at.name()};
}

Expected surfaces_cross(LayeredModel& m, Random& random) {
    const Place at = place_in(m, random, {"upper"});
    const auto inner = inner_points(at);
    at.surface->points[inner[pick(random, inner.size())]][2] += uniform(random, 0.9, 1.1);  // through the top
    return {"B08", "surface", at.name()};
}

Expected surface_meets_itself(LayeredModel& m, Random& random) {
    // A triangle that hangs at an inner point and pierces the sheet beside it.
    const Place at = place_in(m, random, flat_sheets, true);
    const auto inner = inner_points(at);
    const std::uint32_t v = inner[pick(random, inner.size())];
    const double turn = uniform(random, 0, 6);
    Vec3 above = at.surface->points[v];
    above[0] += 0.3 * std::cos(turn);
    above[1] += 0.3 * std::sin(turn);
    Vec3 below = above;
    above[2] += 0.2;
    below[2] -= 0.2;
    const std::uint32_t a = add_point(*at.surface, above), b = add_point(*at.surface, below);
    add_triangle(*at.surface, v, a, b);
    return {"B02", "surface", at.name()};
}

Expected fin_on_surface(LayeredModel& m, Random& random) {
    const Place at = place_in(m, random, flat_sheets, true);
    const auto inner = inner_points(at);
    // An edge between two inner points is inside.
    for (std::uint64_t p = at.first; p < at.last; ++p) {
        const auto t = at.triangle(p);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = t[i], b = t[(i + 1) % 3];
            if (std::ranges::find(inner, a) == inner.end() || std::ranges::find(inner, b) == inner.end()) continue;
            Vec3 tip = at.surface->points[a];
            tip[2] += (at.surface->info.name == "top" ? -1 : 1) * uniform(random, 0.1, 0.2);
            add_triangle(*at.surface, a, b, add_point(*at.surface, tip));
            return {"B03", "surface", at.name()};
        }
    }
    return {};
}

Expected pinched_point(LayeredModel& m, Random& random) {
    // A small cone hangs at an inner point of a sheet.
    const Place at = place_in(m, random, flat_sheets, true);
    const auto inner = inner_points(at);
    const std::uint32_t apex = inner[pick(random, inner.size())];
    const double up = at.surface->info.name == "top" ? -0.2 : 0.2;
    std::array<std::uint32_t, 3> rim{};
    for (std::size_t i = 0; i < 3; ++i) {
        Vec3 p = at.surface->points[apex];
        p[0] += 0.05 * std::cos(2.1 * static_cast<double>(i));
        p[1] += 0.05 * std::sin(2.1 * static_cast<double>(i));
        p[2] += up;
        rim[i] = add_point(*at.surface, p);
    }
    for (std::size_t i = 0; i < 3; ++i) add_triangle(*at.surface, apex, rim[i], rim[(i + 1) % 3]);
    add_triangle(*at.surface, rim[2], rim[1], rim[0]);
    return {"B03", "surface", at.name()};
}

Expected part_apart(LayeredModel& m, Random& random) {
    const Place at = place_in(m, random, layered_names(), true);
    const Vec3 o{uniform(random, 0.2, 1.6), uniform(random, 0.2, 2.5), uniform(random, 0.2, 0.4)};
    std::array<std::uint32_t, 3> t{};
    for (std::size_t i = 0; i < 3; ++i) {
        Vec3 p = o;
        p[i] += 0.1;
        t[i] = add_point(*at.surface, p);
    }
    add_triangle(*at.surface, t[0], t[1], t[2]);
    return {"B04", "surface", at.name()};
}

Expected open_seam(LayeredModel& m, Random& random) {
    // The triangles on one side of a way through a sheet get points of their own, between its first and last node.
    const Place at = place_in(m, random, flat_sheets);
    Surface& surface = *at.surface;
    const auto inner = inner_points(at);
    std::vector<std::uint32_t> row;  // inner points of one column, by y
    const double x = surface.points[inner[pick(random, inner.size())]][0];
    for (const std::uint32_t v : inner) {
        if (surface.points[v][0] == x) row.push_back(v);
    }
    std::ranges::sort(row, {}, [&](std::uint32_t v) { return surface.points[v][1]; });
    const std::uint32_t between = row[1];  // the way runs over three points; only the middle one is doubled
    const std::uint32_t twin = add_point(surface, surface.points[between]);
    for (std::uint64_t p = at.first; p < at.last; ++p) {
        double middle = 0;
        const auto t = at.triangle(p);
        for (const std::uint32_t v : t) middle += surface.points[v][0] / 3;
        for (std::size_t i = 0; i < 3 && middle > x; ++i) {
            if (t[i] == between) surface.polygons.corners[3 * p + i] = twin;
        }
    }
    return {"B07", "surface", at.name()};
}

Expected near_points(LayeredModel& m, Random& random) {
    const Place at = place_in(m, random, layered_names());
    const auto t = at.triangle(any_triangle(at, random));
    const auto inner = inner_points(at);
    for (const std::uint32_t v : t) {
        if (std::ranges::find(inner, v) != inner.end()) continue;  // one on a border, where another surface has it, too
        at.surface->points[v][pick(random, 3)] += 1e-7;            // the tolerance is 5.4e-7
        return {"M01", "model", "made"};
    }
    return near_points(m, random);
}

Expected border_nearly_meets(LayeredModel& m, Random& random) {
    // A horizon draws back from the fault by less than the search length.
    const Place at = place_in(m, random, {"lower", "upper"});
    const double x = LayeredModel::node(LayeredModel::fault, 0, 0)[0];
    std::vector<std::uint8_t> used(at.surface->points.size(), 0);
    for (std::uint64_t p = at.first; p < at.last; ++p) {
        for (const std::uint32_t v : at.triangle(p)) used[v] = 1;
    }
    for (std::uint32_t v = 0; v < used.size(); ++v) {
        Vec3& p = at.surface->points[v];
        if (used[v] != 0 && p[0] == x) p[0] += (at.part == 0 ? -1 : 1) * 0.002;  // near is 0.0054
    }
    return {"B23", "surface", at.name()};
}

Expected unused_point(LayeredModel& m, Random& random) {
    const Place at = place_in(m, random, layered_names(), true);
    add_point(*at.surface, {uniform(random, 0, 4), uniform(random, 0, 3), uniform(random, 0, 2)});
    return {"M02", "surface", at.name()};
}

Expected flat_triangle(LayeredModel& m, Random& random) {
    const Place at = place_in(m, random, layered_names(), true);
    const auto t = at.triangle(any_triangle(at, random));
    Vec3 middle{};
    for (std::size_t k = 0; k < 3; ++k) middle[k] = 0.4 * at.surface->points[t[0]][k] + 0.6 * at.surface->points[t[1]][k];
    middle[pick(random, 3)] += 1e-8;
    add_triangle(*at.surface, t[0], t[1], add_point(*at.surface, middle));
    return {"M03", "surface", at.name()};
}

Expected side_in_two_regions(LayeredModel& m, Random& random) {
    auto& regions = m.maker.model().regions;
    const std::size_t a = 1 + pick(random, 6), b = 1 + (a + pick(random, 5)) % 6;
    regions[b].sides.push_back(regions[a].sides[pick(random, regions[a].sides.size())]);
    return {"B14", "region", regions[a].name};
}

Expected side_not_stated(LayeredModel& m, Random& random) {
    auto& region = m.maker.model().regions[1 + pick(random, 6)];
    region.sides.erase(region.sides.begin() + static_cast<std::ptrdiff_t>(pick(random, region.sides.size())));
    return {"B05", "region", region.name};
}

Expected regions_swap_sides(LayeredModel& m, Random& random) {
    // Two regions one above the other are stated as one and nothing in between: both blocks' sides in one list.
    auto& regions = m.maker.model().regions;
    const std::size_t below = 1 + pick(random, 4);
    auto& lower = regions[below];
    const auto& upper = regions[below + 2];
    const std::uint32_t between = lower.sides[1].face;
    std::erase_if(lower.sides, [&](const auto& side) { return side.face == between; });
    for (const auto& side : upper.sides) {
        if (side.face != between) lower.sides.push_back(side);
    }
    return {"B13", "region", lower.name};
}

Expected nothing_closes(LayeredModel& m, Random& random) {
    // Every part shrinks about its middle.
    const double scale = uniform(random, 0.7, 0.95);
    for (const std::string& name : layered_names()) {
        Surface& surface = m.surface(name);
        const auto bounds = part_bounds(surface);
        for (std::size_t part = 0; part + 1 < bounds.size(); ++part) {
            std::vector<std::uint32_t> points;
            for (std::uint64_t c = 3 * bounds[part]; c < 3 * bounds[part + 1]; ++c) points.push_back(surface.polygons.corners[c]);
            std::ranges::sort(points);
            points.erase(std::unique(points.begin(), points.end()), points.end());
            Vec3 middle{};
            for (const std::uint32_t v : points) {
                for (std::size_t k = 0; k < 3; ++k) middle[k] += surface.points[v][k] / static_cast<double>(points.size());
            }
            for (const std::uint32_t v : points) {
                for (std::size_t k = 0; k < 3; ++k) surface.points[v][k] = middle[k] + scale * (surface.points[v][k] - middle[k]);
            }
        }
    }
    return {"B06", "model", "made"};
}

/// Adds a surface of one triangle that is no part of any region.
std::string add_loose_triangle(LayeredModel& m, FeatureRole role, const std::array<Vec3, 3>& t) {
    m.maker.add("extra", role, {t});
    return "extra";
}

Expected border_on_surface(LayeredModel& m, Random& random) {
    // Stands on the bottom, away from its vertices; all numbers are exact.
    const double x = 0.125 + 0.25 * static_cast<double>(pick(random, 5)), y = 0.0625 + 0.125 * static_cast<double>(pick(random, 20));
    return {"B11", "surface", add_loose_triangle(m, FeatureRole::fault, {{{x, y, 0}, {x + 0.0625, y + 0.03125, 0}, {x, y, 0.25}}})};
}

Expected surface_on_surface(LayeredModel& m, Random& random) {
    const double x = 0.125 + 0.25 * static_cast<double>(pick(random, 5)), y = 0.0625 + 0.125 * static_cast<double>(pick(random, 20));
    return {"B20", "surface", add_loose_triangle(m, FeatureRole::fault, {{{x, y, 0}, {x + 0.25, y, 0}, {x, y + 0.25, 0}}})};
}

Expected point_on_surface(LayeredModel& m, Random& random) {
    const double x = 0.125 + 0.25 * static_cast<double>(pick(random, 5)), y = 0.0625 + 0.125 * static_cast<double>(pick(random, 20));
    return {"B22", "surface", add_loose_triangle(m, FeatureRole::fault, {{{x, y, 0}, {x + 0.25, y, 0.25}, {x, y + 0.125, 0.25}}})};
}

Expected surface_outside(LayeredModel& m, Random& random) {
    const double x = uniform(random, 0, 4);
    return {"B16", "surface", add_loose_triangle(m, FeatureRole::fault, {{{x, 0, 3}, {x + 0.3, 0, 3}, {x, 0.3, 3.2}}})};
}

Expected sheet_inside(LayeredModel& m, Random& random) {
    const double x = uniform(random, 0.2, 1.5);
    return {"B25", "surface", add_loose_triangle(m, FeatureRole::fracture, {{{x, 0.3, 0.2}, {x + 0.3, 0.3, 0.2}, {x, 0.6, 0.4}}})};
}

Expected wrong_border(LayeredModel& m, Random& random) {
    const Place at = place_in(m, random, layered_names());
    const auto t = at.triangle(at.first), u = at.triangle(at.last - 1);
    at.surface->border_starts.push_back({7, t[0], u[2]});
    return {"B19", "interface", at.surface->info.name};
}

Expected one_name_twice(LayeredModel& m, Random& random) {
    auto& regions = m.maker.model().regions;
    const std::size_t a = 1 + pick(random, 6), b = 1 + (a + pick(random, 5)) % 6;
    regions[b].name = regions[a].name;
    return {"G01", "region", regions[a].name};
}

Expected empty_layer(LayeredModel& m, Random& random) {
    auto& layer = m.maker.model().layers[pick(random, 3)];
    layer.regions.clear();
    return {"G02", "layer", layer.name};
}

Expected thin_region(LayeredModel& m, Random& random) {
    // A horizon comes down to just above the bottom, in both blocks and along all walls.
    const double gap = uniform(random, 0.0005, 0.002);
    const double height[] = {0, gap};
    for (const std::string& name : layered_names()) {
        for (Vec3& p : m.surface(name).points) {
            for (int i = 0; i <= LayeredModel::nx; ++i) {
                for (int j = 0; j <= LayeredModel::ny; ++j) {
                    if (p == LayeredModel::node(i, j, 1)) p[2] = height[1];
                }
            }
        }
    }
    return {"B15", "region", "block_00"};
}

using Plant = Expected (*)(LayeredModel&, Random&);
struct Defect {
    const char* name;
    Plant plant;
};
constexpr Defect defects[] = {
    {"degenerate_triangle", degenerate_triangle},
    {"repeated_triangle", repeated_triangle},
    {"reversed_triangle", reversed_triangle},
    {"hole_in_horizon", hole_in_horizon},
    {"hole_in_boundary_leaks", hole_in_boundary_leaks},
    {"region_does_not_close", region_does_not_close},
    {"horizon_ends_inside", horizon_ends_inside},
    {"horizons_cross", horizons_cross},
    {"surfaces_cross", surfaces_cross},
    {"surface_meets_itself", surface_meets_itself},
    {"fin_on_surface", fin_on_surface},
    {"pinched_point", pinched_point},
    {"part_apart", part_apart},
    {"open_seam", open_seam},
    {"near_points", near_points},
    {"border_nearly_meets", border_nearly_meets},
    {"unused_point", unused_point},
    {"flat_triangle", flat_triangle},
    {"side_in_two_regions", side_in_two_regions},
    {"side_not_stated", side_not_stated},
    {"regions_swap_sides", regions_swap_sides},
    {"nothing_closes", nothing_closes},
    {"border_on_surface", border_on_surface},
    {"surface_on_surface", surface_on_surface},
    {"point_on_surface", point_on_surface},
    {"surface_outside", surface_outside},
    {"sheet_inside", sheet_inside},
    {"wrong_border", wrong_border},
    {"one_name_twice", one_name_twice},
    {"empty_layer", empty_layer},
    {"thin_region", thin_region},
};

std::string codes_in(const std::vector<Finding>& findings) {
    std::string text;
    for (const Finding& f : findings) text += f.code + (f.entities.empty() ? "" : " " + f.entities[0].name) + "; ";
    return text;
}

class PlantedDefect : public ::testing::TestWithParam<Defect> {};

TEST_P(PlantedDefect, IsFoundWithItsCodeAndEntity) {
    const char* wanted = std::getenv("GEOMEND_SEEDS");  // for a longer campaign
    const unsigned seeds = wanted != nullptr ? static_cast<unsigned>(std::strtoul(wanted, nullptr, 10)) : 60;
    for (unsigned seed = 0; seed < seeds; ++seed) {
        Random random(seed);
        LayeredModel model;
        const Expected expected = GetParam().plant(model, random);
        const auto checked = validators::check_models(model.data(), {});
        ASSERT_TRUE(checked);
        const bool found = std::ranges::any_of(checked->findings, [&](const Finding& f) {
            return f.code == expected.code &&
                   std::ranges::any_of(f.entities, [&](const EntityRef& e) { return e.kind == expected.kind && e.name == expected.name; });
        });
        ASSERT_TRUE(found) << "seed " << seed << ": expected " << expected.code << " of " << expected.kind << " " << expected.name
                           << ", found " << codes_in(checked->findings);
    }
}

INSTANTIATE_TEST_SUITE_P(Model, PlantedDefect, ::testing::ValuesIn(defects), [](const auto& defect) { return defect.param.name; });

TEST(SoundModel, HasNoErrorAndNoWarning) {
    LayeredModel model;
    const auto checked = validators::check_models(model.data(), {});
    ASSERT_TRUE(checked);
    for (const Finding& f : checked->findings) EXPECT_EQ(f.severity, Severity::info) << f.code << " " << f.message;
    const auto models = topology::models_to_judge(model.data(), topology::model_sources(model.data(), checked->local));
    ASSERT_TRUE(models && models->size() == 1);
    const BrepData& b = *models->front().brep;
    EXPECT_EQ(b.surfaces.size(), 8u + 12u + 6u + 3u);
    EXPECT_EQ(b.regions.size(), 6u);
    EXPECT_EQ(b.corners.size(), 24u);
    double sum = 0;
    for (const auto& region : b.regions) sum += region.volume;
    EXPECT_NEAR(sum, 24, 1e-12);
    EXPECT_NEAR(b.universe_volume, 24, 1e-12);
}

}  // namespace
}  // namespace geomend
