// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/soup_kinds.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "arrangement/sheets.h"
#include "geometry/vectors.h"

namespace geomend::test {

namespace {

/// Random numbers that are the same on every machine: distributions of the standard library need not be.
class Dice {
public:
    explicit Dice(unsigned seed) : random_(seed) {}
    std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(random_() % n); }
    double between(double low, double high) { return low + (high - low) * (static_cast<double>(random_()) * 0x1p-32); }
    Vec3 point() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }

private:
    std::mt19937 random_;
};

struct Maker {
    Dice& dice;
    double tolerance;
    TriangleSoup soup;

    void add(const Vec3& a, const Vec3& b, const Vec3& c) {
        const auto first = static_cast<std::uint32_t>(soup.vertices.size());
        soup.vertices.insert(soup.vertices.end(), {a, b, c});
        add(Triangle{first, first + 1, first + 2});
    }
    void add(const Triangle& t) {
        soup.patches.push_back(static_cast<std::uint32_t>(soup.triangles.size()));
        soup.triangles.push_back(t);
    }
    std::size_t number() const { return 4 + dice.below(18); }
    /// Shorter than some tolerances, often by less than one.
    Vec3 nudge() const { return times(tolerance * std::pow(10, dice.between(-2.5, 0.7)), dice.point()); }
};

void uniform(Maker& m) {
    for (std::size_t n = m.number(); n > 0; --n) m.add(m.dice.point(), m.dice.point(), m.dice.point());
}

void lattice(Maker& m) {
    const double cells = 2 + m.dice.below(5);
    const auto place = [&] {
        Vec3 p = m.dice.point();
        for (double& x : p) x = std::nearbyint(cells * x) / cells;
        return p;
    };
    for (std::size_t n = m.number(); n > 0; --n) m.add(place(), place(), place());
}

void nearly_coplanar(Maker& m) {
    const double thick = m.tolerance * std::pow(10, m.dice.between(-2, 3)), slope = m.dice.between(-1, 1);
    const auto place = [&] {
        const Vec3 p = m.dice.point();
        return Vec3{p[0], p[1], slope * p[0] + 0.3 * p[1] + thick * p[2]};
    };
    for (std::size_t n = m.number() / 2 + 2; n > 0; --n) m.add(place(), place(), place());
}

void coplanar(Maker& m) {
    const double cells = 3 + m.dice.below(40);
    const auto place = [&] { return Vec3{std::nearbyint(cells * m.dice.between(-1, 1)) / cells, m.dice.between(-1, 1), 0}; };
    for (std::size_t n = m.number() / 2 + 2; n > 0; --n) m.add(place(), place(), place());
}

void shared_vertices(Maker& m) {
    const std::uint32_t vertices = 5 + m.dice.below(8);
    for (std::uint32_t v = 0; v < vertices; ++v) m.soup.vertices.push_back(m.dice.point());
    for (std::size_t n = m.number(); n > 0; --n) {
        const std::uint32_t a = m.dice.below(vertices), b = m.dice.below(vertices), c = m.dice.below(vertices);
        if (a != b && b != c && c != a) m.add(Triangle{a, b, c});
    }
}

void needles(Maker& m) {
    for (std::size_t n = m.number(); n > 0; --n) {
        const Vec3 a = m.dice.point(), b = m.dice.point();
        const double along = m.dice.between(-0.1, 1.1), off = std::pow(10, m.dice.between(-6, -0.5));
        m.add(a, b, plus(plus(a, times(along, minus(b, a))), times(off, m.dice.point())));
    }
}

/// Vertices on or near vertices, edges and faces of what is there.
void near_contacts(Maker& m) {
    m.add(m.dice.point(), m.dice.point(), m.dice.point());
    const auto place = [&] {
        const Triangle& t = m.soup.triangles[m.dice.below(static_cast<std::uint32_t>(m.soup.triangles.size()))];
        const Vec3 &a = m.soup.vertices[t[0]], &b = m.soup.vertices[t[1]], &c = m.soup.vertices[t[2]];
        const double u = m.dice.between(0, 1), v = m.dice.between(0, 1 - u);
        const std::uint32_t on = m.dice.below(4);
        if (on == 3) return m.dice.point();
        const Vec3 p = on == 0 ? a : on == 1 ? plus(a, times(u, minus(b, a))) : plus(a, plus(times(u, minus(b, a)), times(v, minus(c, a))));
        return plus(p, m.nudge());
    };
    for (std::size_t n = m.number() / 2 + 2; n > 0; --n) m.add(place(), place(), place());
}

void duplicates(Maker& m) {
    uniform(m);
    const auto count = static_cast<std::uint32_t>(m.soup.triangles.size());
    for (std::uint32_t n = 0; n < count; ++n) {
        const Triangle t = m.soup.triangles[m.dice.below(count)];
        const bool exact = m.dice.below(2) == 0;
        const auto copy = [&](std::uint32_t v) { return exact ? m.soup.vertices[v] : plus(m.soup.vertices[v], m.nudge()); };
        m.add(copy(t[m.dice.below(2)]), copy(t[2]), copy(t[m.dice.below(2)]));
    }
}

/// Planes and half-planes through one line, and fans with corners on it.
void common_line(Maker& m) {
    const Vec3 from = m.dice.point(), along = m.dice.point();
    const auto on_line = [&] { return plus(from, times(m.dice.between(-1, 1), along)); };
    for (std::size_t n = m.number() / 2 + 2; n > 0; --n) {
        const Vec3 side = m.dice.point(), a = on_line(), b = on_line();
        if (m.dice.below(2) == 0) m.add(a, b, side);
        else m.add(plus(a, minus(side, from)), plus(b, minus(from, side)), plus(b, times(0.6, minus(side, from))));
    }
}

/// Sheets of a few cells on each other, shifted by cells, shares of cells or tolerances: each one patch.
void grids(Maker& m) {
    const std::uint32_t sheets = 2 + m.dice.below(2);
    for (std::uint32_t s = 0; s < sheets; ++s) {
        const std::uint32_t nu = 1 + m.dice.below(5), nv = 1 + m.dice.below(5);
        const std::uint32_t kind = m.dice.below(4);
        const Vec3 shift = kind == 0 ? Vec3{} : kind == 1 ? Vec3{0.25, 0.5, 0} : kind == 2 ? m.nudge() : m.dice.point();
        const double tilt = m.dice.below(3) == 0 ? m.dice.between(-1, 1) : 0, bend = m.dice.below(3) == 0 ? m.dice.between(0, 0.3) : 0;
        add_sheet(m.soup, nu, nv, [&](double u, double v) {
            return plus(shift, Vec3{2 * u - 1, 2 * v - 1, tilt * (u - 0.5) + bend * std::sin(5 * u) * std::cos(4 * v)});
        });
    }
    if (m.dice.below(2) == 0) {
        const Triangle t{m.dice.below(4), m.dice.below(4), static_cast<std::uint32_t>(m.soup.vertices.size() - 1)};
        if (t[0] == t[1]) return;
        m.soup.triangles.push_back(t);
        m.soup.patches.push_back(m.soup.patches.back() + 1);
    }
}

/// A few points around which everything is, at distances of a few tolerances.
void clusters(Maker& m) {
    const std::uint32_t centres = 3 + m.dice.below(3);
    std::vector<Vec3> centre;
    for (std::uint32_t c = 0; c < centres; ++c) centre.push_back(m.dice.point());
    const auto place = [&] {
        return plus(centre[m.dice.below(centres)], times(m.tolerance * std::pow(10, m.dice.between(-1, 2.5)), m.dice.point()));
    };
    for (std::size_t n = m.number() / 2 + 2; n > 0; --n) m.add(place(), place(), place());
}

void mixed(Maker& m) {
    for (const auto& make : {uniform, needles, common_line, coplanar}) {
        Maker part{m.dice, m.tolerance, {}};
        make(part);
        for (std::size_t t = 0; t < std::min<std::size_t>(part.soup.triangles.size(), 5); ++t) {
            const auto& [a, b, c] = part.soup.triangles[t];
            m.add(part.soup.vertices[a], part.soup.vertices[b], part.soup.vertices[c]);
        }
    }
}

struct Kind {
    const char* name;
    void (*make)(Maker&);
};
constexpr std::array<Kind, 13> kinds{{{"uniform", uniform},
                                      {"lattice", lattice},
                                      {"nearly_coplanar", nearly_coplanar},
                                      {"coplanar", coplanar},
                                      {"shared_vertices", shared_vertices},
                                      {"needles", needles},
                                      {"near_contacts", near_contacts},
                                      {"duplicates", duplicates},
                                      {"common_line", common_line},
                                      {"grids", grids},
                                      {"clusters", clusters},
                                      {"mixed", mixed},
                                      {"flat_box", [](Maker& m) {
                                           uniform(m);
                                           for (Vec3& p : m.soup.vertices) p[2] *= 1e-3;
                                       }}}};

}  // namespace

const std::vector<std::string>& soup_kinds() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const Kind& k : kinds) all.emplace_back(k.name);
        return all;
    }();
    return names;
}

RandomSoup random_soup(const std::string& kind, unsigned seed) {
    const auto at = std::ranges::find(kinds, kind, &Kind::name);
    Dice dice(seed * 2654435761u + static_cast<unsigned>(at - kinds.begin()));
    const double tolerance = std::array{1e-7, 1e-6, 1e-5, 1e-4, 1e-3}[seed % 5];
    Maker maker{dice, tolerance, {}};
    at->make(maker);
    // Each fourth one is huge, tiny or far away, where doubles still have some thousand steps a tolerance.
    const double scale = std::array{1.0, 1.0, 1.0, 1e9, 1.0, 1e-9}[(seed / 5) % 6];
    const double away = seed % 5 >= 2 && (seed / 5) % 6 == 4 ? 4e5 : 0;
    for (Vec3& p : maker.soup.vertices) p = plus(times(scale, p), Vec3{away, 10 * away, -0.01 * away});
    return {std::move(maker.soup), tolerance * scale};
}

}  // namespace geomend::test
