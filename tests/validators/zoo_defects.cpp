// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/zoo_defects.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "geometry/vectors.h"

namespace geomend::testing {

std::size_t pick(Random& random, std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random); }

/// A triangle of a face with what is needed to build beside it.
struct Place {
    Patient& patient;
    std::size_t face;
    std::uint64_t triangle;
    Corners c;
    Vec3 a, b, d, middle, normal;  // unit normal
    double height;                 // the smallest

    Vec3 inside(double u, double v, double lift) const {  // barycentric to b and d
        return plus(plus(plus(a, times(u, minus(b, a))), times(v, minus(d, a))), times(lift, normal));
    }
    std::string name() const { return patient.name(face); }
    /// A length that is small beside the triangle, but not beside the search length.
    double near() const { return patient.near(face); }
    double small() const { return std::max(0.06 * height, 4 * near()); }
    double side() const { return patient.inwards(face); }
};

static Place place_at(Patient& p, std::size_t face, std::uint64_t t) {
    const Corners c = p.corners(face, t);
    Place place{p, face, t, c, p.at(face, c[0]), p.at(face, c[1]), p.at(face, c[2]), {}, {}, 0};
    place.middle = times(1.0 / 3, plus(plus(place.a, place.b), place.d));
    const Vec3 n = cross(minus(place.b, place.a), minus(place.d, place.a));
    const double length = std::sqrt(dot(n, n));
    place.normal = times(1 / length, n);
    double longest = 0;
    for (const Vec3& e : {minus(place.b, place.a), minus(place.d, place.b), minus(place.a, place.d)})
        longest = std::max(longest, dot(e, e));
    place.height = length / std::sqrt(longest);
    return place;
}

namespace {

Found spoiled(Place& at, const std::string& code) {
    Found all{{code, "surface", at.name()}};
    for (const std::string& region : at.patient.regions_at(at.face)) all.push_back({"B18", "region", region});
    return all;
}

Found degenerate(Place& at, Random& random) {
    const std::size_t i = pick(random, 3);
    at.patient.add_triangle(at.face, {at.c[i], at.c[i], at.c[(i + 1) % 3]});
    return spoiled(at, "B01");
}
Found repeated(Place& at, Random& random) {
    Corners c = at.c;
    std::ranges::shuffle(c, random);
    at.patient.add_triangle(at.face, c);
    return spoiled(at, "M04");
}
Found reversed(Place& at, Random&) {
    if (at.patient.last(at.face) - at.patient.first(at.face) < 3 || at.name() == "strip") return {};  // which has one side anyway
    auto& c = at.patient.surface(at.face).polygons.corners;
    std::swap(c[3 * at.triangle], c[3 * at.triangle + 1]);
    return spoiled(at, "M05");
}
Found hole_that_leaks(Place& at, Random&) {
    if (!at.patient.separates(at.face) || at.patient.last(at.face) - at.patient.first(at.face) < 2) return {};
    at.patient.remove_triangle(at.face, at.triangle);
    return {{"B12", "surface", at.name()}};
}
Found small_hole(Place& at, Random&) {
    // A small triangle in the middle is left out.
    const std::array<Vec3, 3> ring{at.inside(0.3, 0.3, 0), at.inside(0.4, 0.3, 0), at.inside(0.3, 0.4, 0)};
    Corners r{};
    for (std::size_t i = 0; i < 3; ++i) r[i] = at.patient.add_point(at.face, ring[i]);
    const Corners c = at.patient.corners(at.face, at.triangle);
    at.patient.remove_triangle(at.face, at.triangle);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        at.patient.add_triangle(at.face, {c[i], c[j], r[j]});
        at.patient.add_triangle(at.face, {c[i], r[j], r[i]});
    }
    if (!at.patient.separates(at.face)) return {{"M07", "surface", at.name()}};
    return {{"B12", "surface", at.name()}};
}
Found horizon_ends_inside(Place& at, Random&) {
    const FeatureRole role = at.patient.surface(at.face).info.role;
    if (role != FeatureRole::horizon && role != FeatureRole::unconformity) return {};
    if (at.patient.regions_at(at.face).size() != 2) return {};
    const auto inner = at.patient.inner_points(at.face);
    std::size_t left = 0;
    const auto at_border = [&](std::uint64_t t) {
        return std::ranges::count_if(at.patient.corners(at.face, t), [&](auto v) { return std::ranges::find(inner, v) == inner.end(); }) >=
               2;
    };
    for (std::uint64_t t = at.patient.first(at.face); t < at.patient.last(at.face); ++t) left += at_border(t) ? 0 : 1;
    if (left == 0) return {};
    for (std::uint64_t t = at.patient.last(at.face); t-- > at.patient.first(at.face);) {
        if (at_border(t)) at.patient.remove_triangle(at.face, t);
    }
    return {{"B09", "surface", at.name()}};
}
Found part_apart(Place& at, Random&) {
    const double s = at.small();
    const Vec3 o = plus(at.middle, times(at.side() * s, at.normal));
    Corners t{};
    for (std::size_t i = 0; i < 3; ++i) {
        Vec3 p = o;
        p[i] += s / 2;
        t[i] = at.patient.add_point(at.face, p);
    }
    at.patient.add_triangle(at.face, t);
    return spoiled(at, "B04");
}
Found part_by_a_corner(Place& at, Random&) {
    // A further triangle that shares a single point with the rest, on the border or inside.
    const double s = at.small();
    const std::uint32_t p = at.patient.add_point(at.face, at.inside(0.3, 0.3, at.side() * s));
    const std::uint32_t q = at.patient.add_point(at.face, at.inside(0.3, 0.2, at.side() * 2 * s));
    at.patient.add_triangle(at.face, {at.patient.corners(at.face, at.triangle)[0], p, q});
    return spoiled(at, "B04");
}
Found unused_point(Place& at, Random&) {
    at.patient.add_point(at.face, plus(at.middle, times(at.side() * at.small(), at.normal)));
    return {{"M02", "surface", at.name()}};
}
Found flat_triangle(Place& at, Random&) {
    const std::uint32_t p = at.patient.add_point(at.face, at.inside(0.4, 1e-9, 0));
    at.patient.add_triangle(at.face, {at.patient.corners(at.face, at.triangle)[0], at.patient.corners(at.face, at.triangle)[1], p});
    return {{"M03", "surface", at.name()}};
}
Found fin(Place& at, Random&) {
    // On an edge that another triangle of the face has, too.
    const auto inner = at.patient.inner_points(at.face);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t v = at.c[i], w = at.c[(i + 1) % 3];
        if (std::ranges::find(inner, v) == inner.end() || std::ranges::find(inner, w) == inner.end()) continue;
        const Vec3 half = times(0.5, plus(at.patient.at(at.face, v), at.patient.at(at.face, w)));
        const std::uint32_t tip = at.patient.add_point(at.face, plus(half, times(at.side() * at.small(), at.normal)));
        const Corners now = at.patient.corners(at.face, at.triangle);
        at.patient.add_triangle(at.face, {now[i], now[(i + 1) % 3], tip});
        return spoiled(at, "B03");
    }
    return {};
}
Found meets_itself(Place& at, Random&) {
    // Hangs at a corner of a triangle and goes through it.
    const double s = at.small();
    const std::uint32_t p = at.patient.add_point(at.face, at.inside(0.3, 0.3, s));
    const std::uint32_t q = at.patient.add_point(at.face, at.inside(0.3, 0.3, -s));
    at.patient.add_triangle(at.face, {at.patient.corners(at.face, at.triangle)[0], p, q});
    return spoiled(at, "B02");
}
Found seam(Place& at, Random&) {
    const auto inner = at.patient.inner_points(at.face);
    for (std::size_t i = 0; i < 3; ++i) {
        if (std::ranges::find(inner, at.c[i]) == inner.end()) continue;
        const std::uint32_t twin = at.patient.add_point(at.face, at.patient.at(at.face, at.c[i]));
        at.patient.surface(at.face).polygons.corners[3 * at.triangle + i] = twin;
        return spoiled(at, "B07");
    }
    return {};
}
Found needle(Place& at, Random&) {
    const std::uint32_t p = at.patient.add_point(at.face, at.inside(0.45, 0.001, 0));
    const Corners c = at.patient.corners(at.face, at.triangle);
    at.patient.remove_triangle(at.face, at.triangle);
    for (std::size_t i = 0; i < 3; ++i) at.patient.add_triangle(at.face, {c[i], c[(i + 1) % 3], p});
    return {{"Q01", "surface", at.name()}};
}
Found short_edge(Place& at, Random&) {
    const Vec3 way = minus(at.middle, at.a);
    const double far = 0.3 * at.near() / std::sqrt(dot(way, way));
    const std::uint32_t p = at.patient.add_point(at.face, plus(at.a, times(far, way)));
    const Corners c = at.patient.corners(at.face, at.triangle);
    at.patient.remove_triangle(at.face, at.triangle);
    for (std::size_t i = 0; i < 3; ++i) at.patient.add_triangle(at.face, {c[i], c[(i + 1) % 3], p});
    return {{"Q02", "surface", at.name()}};
}
Found pierced(Place& at, Random&) {
    const double s = at.small();
    const std::string extra = at.patient.add_extra({{at.inside(0.3, 0.3, s), at.inside(0.3, 0.3, -s), at.inside(0.4, 0.3, s)}});
    return {{"B08", "surface", at.name()}, {"B08", "surface", extra}};
}
Found foot_on_it(Place& at, Random&) {
    const double s = at.side() * at.small();
    const std::string extra = at.patient.add_extra({{at.inside(0.3, 0.3, 0), at.inside(0.5, 0.3, 0), at.inside(0.4, 0.3, s)}});
    return {{"B11", "surface", at.name()}, {"B11", "surface", extra}};
}
Found lies_on_it(Place& at, Random&) {
    const std::string extra = at.patient.add_extra({{at.inside(0.2, 0.2, 0), at.inside(0.5, 0.2, 0), at.inside(0.2, 0.5, 0)}});
    return {{"B20", "surface", at.name()}, {"B20", "surface", extra}};
}
Found stands_on_a_point(Place& at, Random&) {
    const double s = at.side() * at.small();
    const std::string extra = at.patient.add_extra({{at.inside(0.3, 0.3, 0), at.inside(0.35, 0.3, s), at.inside(0.3, 0.4, s)}});
    return {{"B22", "surface", at.name()}, {"B22", "surface", extra}};
}
Found border_near_it(Place& at, Random&) {
    const double s = at.side() * at.small(), gap = at.side() * 0.4 * at.near();
    const std::string extra = at.patient.add_extra({{at.inside(0.3, 0.3, gap), at.inside(0.5, 0.3, gap), at.inside(0.4, 0.3, s + gap)}});
    return {{"B23", "surface", at.name()}, {"B23", "surface", extra}};
}
Found tent_near_it(Place& at, Random&) {
    const double s = at.side() * at.small(), gap = at.side() * 0.4 * at.near();
    const Vec3 tip = at.inside(0.33, 0.33, gap), p = at.inside(0.25, 0.25, s + gap), q = at.inside(0.5, 0.25, s + gap),
               r = at.inside(0.25, 0.5, s + gap);
    const std::string extra = at.patient.add_extra({{tip, p, q}, {tip, q, r}, {tip, r, p}});
    return {{"B24", "surface", at.name()}, {"B24", "surface", extra}};
}
Found sheet_beside_it(Place& at, Random&) {
    if (!at.patient.has_regions() || at.small() > 0.1 * at.height) return {};  // else it may reach through a neighbour
    const double s = at.side() * at.small();
    return {{"B25", "surface", at.patient.add_extra({{at.inside(0.3, 0.3, s), at.inside(0.5, 0.3, s), at.inside(0.4, 0.3, 1.5 * s)}})}};
}
Found grazing_sheet(Place& at, Random&) {
    // Leaves an edge of the face at three degrees.
    const Vec3 ab = minus(at.b, at.a);
    const Vec3 into = across(minus(at.d, at.a), ab);
    const double length = 0.4 * std::sqrt(dot(into, into));
    const Vec3 tip = plus(at.inside(0.5, 0, 0), plus(times(0.4, into), times(at.side() * length * std::tan(0.052), at.normal)));
    const std::string extra = at.patient.add_extra({{at.a, at.b, tip}});
    return {{"Q04", "surface", at.name()}, {"Q04", "surface", extra}};
}
Found beside_it_along_a_line(Place& at, Random&) {
    // Starts from an edge of the face in the same direction as the face does.
    at.patient.add_extra({{at.a, at.b, at.inside(0.3, 0.5, 0)}});
    return {{"B17", "line", ""}};
}
Found far_away(Place& at, Random&) {
    if (!at.patient.has_regions()) return {};
    const double far = 2000 * at.patient.largest_near();  // two diameters
    std::array<Vec3, 3> t{at.a, at.b, at.d};
    for (Vec3& p : t) p[2] += far;
    return {{"B16|B06", "surface", at.patient.add_extra({t})}};  // B06: where another defect opens the only region
}
Found one_sided(Place& at, Random&) {
    const double s = at.small(), lift = at.side() * 2 * s;
    std::vector<std::array<Vec3, 3>> strip;
    constexpr int n = 9;
    const auto point = [&](int k, int end) {
        const double turn = 2 * 3.14159265358979 * (k % n) / n, w = (k >= n ? -1 : 1) * (end == 0 ? -0.25 : 0.25) * s;
        const double r = s + w * std::cos(turn / 2);
        return plus(at.middle, Vec3{r * std::cos(turn), r * std::sin(turn), w * std::sin(turn / 2) + lift});
    };
    for (int k = 0; k < n; ++k) {
        strip.push_back({point(k, 0), point(k, 1), point(k + 1, 1)});
        strip.push_back({point(k, 0), point(k + 1, 1), point(k + 1, 0)});
    }
    return {{"M06", "surface", at.patient.add_extra(strip)}};
}
Found wrong_border(Place& at, Random&) {
    Surface& s = at.patient.surface(at.face);
    if (!s.border_starts.empty()) return {};
    const std::uint32_t p = at.patient.add_point(at.face, plus(at.middle, times(at.side() * at.small(), at.normal)));
    s.border_starts.push_back({7, at.patient.corners(at.face, at.triangle)[0], p});
    const bool alone = s.parts.empty();
    return {{"B19", alone ? "surface|interface" : "interface", s.info.name}};
}

constexpr Defect defects[] = {
    {"degenerate", degenerate},
    {"repeated", repeated},
    {"reversed", reversed},
    {"hole_that_leaks", hole_that_leaks},
    {"small_hole", small_hole},
    {"horizon_ends_inside", horizon_ends_inside},
    {"part_apart", part_apart},
    {"part_by_a_corner", part_by_a_corner},
    {"unused_point", unused_point},
    {"flat_triangle", flat_triangle},
    {"fin", fin},
    {"meets_itself", meets_itself},
    {"seam", seam},
    {"needle", needle},
    {"short_edge", short_edge},
    {"pierced", pierced},
    {"foot_on_it", foot_on_it},
    {"lies_on_it", lies_on_it},
    {"stands_on_a_point", stands_on_a_point},
    {"border_near_it", border_near_it},
    {"tent_near_it", tent_near_it},
    {"sheet_beside_it", sheet_beside_it},
    {"grazing_sheet", grazing_sheet},
    {"beside_it_along_a_line", beside_it_along_a_line},
    {"far_away", far_away},
    {"one_sided", one_sided},
    {"wrong_border", wrong_border},
};

}  // namespace

std::span<const Defect> all_defects() { return defects; }

Found plant(Patient& patient, const Defect& defect, Random& random) {
    for (int attempt = 0; attempt < 10; ++attempt) {
        const std::size_t face = pick(random, patient.faces());
        if (!patient.is_free(face)) continue;
        const std::uint64_t first = patient.first(face), last = patient.last(face);
        Place place = place_at(patient, face, first + pick(random, last - first));
        if (place.height < 20 * place.near()) continue;
        auto found = defect.plant(place, random);
        if (found.empty()) continue;
        patient.take(face);
        return found;
    }
    return {};
}

unsigned wanted_seeds(unsigned usual) {
    const char* wanted = std::getenv("GEOMEND_SEEDS");  // for a longer campaign
    return wanted != nullptr ? static_cast<unsigned>(std::strtoul(wanted, nullptr, 10)) : usual;
}

}  // namespace geomend::testing
