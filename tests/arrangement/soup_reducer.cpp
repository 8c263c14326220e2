// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/soup_reducer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <istream>
#include <ostream>
#include <sstream>

#include "model/objects.h"

namespace geomend::test {

namespace {

std::string shortest(double x) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), x).ptr;
    return {text.data(), end};
}

/// The triangles that are kept, over the vertices that they and the embedded edges use, in their order.
TriangleSoup with_triangles(const TriangleSoup& soup, const std::vector<std::uint32_t>& kept) {
    TriangleSoup part;
    std::vector<std::uint32_t> number(soup.vertices.size(), no_index);
    for (const std::uint32_t t : kept) {
        for (const std::uint32_t v : soup.triangles[t]) number[v] = 0;
    }
    for (const auto& edge : soup.edges) number[edge[0]] = number[edge[1]] = 0;
    for (std::size_t v = 0; v < number.size(); ++v) {
        if (number[v] == no_index) continue;
        number[v] = static_cast<std::uint32_t>(part.vertices.size());
        part.vertices.push_back(soup.vertices[v]);
    }
    for (const std::uint32_t t : kept) {
        const auto& [a, b, c] = soup.triangles[t];
        part.triangles.push_back({number[a], number[b], number[c]});
        part.patches.push_back(soup.patches[t]);
    }
    for (const auto& edge : soup.edges) part.edges.push_back({number[edge[0]], number[edge[1]]});
    part.edge_ids = soup.edge_ids;
    return part;
}

/// Takes `next` where it fails, too.
bool take(TriangleSoup& soup, TriangleSoup next, const SoupFails& fails) {
    if (!fails(next)) return false;
    soup = std::move(next);
    return true;
}

bool leave_out_triangles(TriangleSoup& soup, const SoupFails& fails) {
    bool any = false;
    for (std::size_t share = (soup.triangles.size() + 1) / 2; share > 0; share = share == 1 ? 0 : (share + 1) / 2) {
        for (bool again = true; again;) {
            again = false;
            for (std::size_t from = 0; from < soup.triangles.size() && soup.triangles.size() > 1;) {
                const std::size_t to = std::min(soup.triangles.size(), from + share);
                std::vector<std::uint32_t> kept;
                for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
                    if (t < from || t >= to) kept.push_back(t);
                }
                if (!kept.empty() && take(soup, with_triangles(soup, kept), fails)) any = again = true;
                else from = to;
            }
        }
    }
    return any;
}

/// Vertices at the same place become one, where it fails then, too: fewer numbers to read.
bool join_vertices(TriangleSoup& soup, const SoupFails& fails) {
    bool any = false;
    for (std::uint32_t v = 0; v < soup.vertices.size(); ++v) {
        for (std::uint32_t w = v + 1; w < soup.vertices.size(); ++w) {
            if (soup.vertices[v] != soup.vertices[w]) continue;
            TriangleSoup next = soup;
            const auto renumber = [&](std::uint32_t& u) { u = u == w ? v : u > w ? u - 1 : u; };
            next.vertices.erase(next.vertices.begin() + w);
            for (Triangle& t : next.triangles) std::ranges::for_each(t, renumber);
            for (auto& edge : next.edges) std::ranges::for_each(edge, renumber);
            if (std::ranges::any_of(next.edges, [](const auto& e) { return e[0] == e[1]; })) continue;
            if (take(soup, std::move(next), fails)) any = true, --w;
        }
    }
    return any;
}

/// To so many digits behind the point of the unit, a power of ten around the soup's size.
double rounded_to(double x, double step) {
    const double r = std::nearbyint(x / step) * step;
    std::array<char, 64> text{};
    const int digits = std::clamp(static_cast<int>(-std::log10(step) + 0.5), 0, 40);
    const auto end = std::to_chars(text.data(), text.data() + text.size(), r, std::chars_format::fixed, digits).ptr;
    double value = r;
    std::from_chars(text.data(), end, value);
    return value == 0 ? 0 : value;
}

double size_of(const TriangleSoup& soup) {
    double size = 0;
    for (const Vec3& p : soup.vertices) size = std::max({size, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
    return size;
}

bool try_step(TriangleSoup& soup, const SoupFails& fails, double step, bool all_at_once) {
    bool any = false;
    const auto rounded_vertex = [&](const Vec3& p) { return Vec3{rounded_to(p[0], step), rounded_to(p[1], step), rounded_to(p[2], step)}; };
    if (all_at_once) {
        TriangleSoup next = soup;
        for (Vec3& p : next.vertices) p = rounded_vertex(p);
        return next.vertices != soup.vertices && take(soup, std::move(next), fails);
    }
    for (std::size_t v = 0; v < soup.vertices.size(); ++v) {
        TriangleSoup next = soup;
        next.vertices[v] = rounded_vertex(next.vertices[v]);
        if (next.vertices[v] == soup.vertices[v]) continue;
        if (take(soup, std::move(next), fails)) {
            any = true;
            continue;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            next = soup;
            next.vertices[v][k] = rounded_to(next.vertices[v][k], step);
            if (next.vertices[v] != soup.vertices[v]) any |= take(soup, std::move(next), fails);
        }
    }
    return any;
}

/// From the coarsest step to the finest: what a coarse one does not break is as simple as it gets.
bool round_coordinates(TriangleSoup& soup, const SoupFails& fails) {
    const double size = size_of(soup);
    if (!(size > 0)) return false;
    bool any = false;
    const double largest = std::pow(10, std::ceil(std::log10(size)));
    constexpr int most_digits = 17;
    for (int digits = 0; digits < most_digits; ++digits) {
        if (!try_step(soup, fails, largest * std::pow(10, -digits), true)) continue;
        any = true;
        break;
    }
    for (int digits = 0; digits < most_digits; ++digits) any |= try_step(soup, fails, largest * std::pow(10, -digits), false);
    return any;
}

}  // namespace

TriangleSoup reduced(const TriangleSoup& soup, const SoupFails& fails) {
    TriangleSoup now = soup;
    if (!now.edges.empty()) {
        TriangleSoup next = now;
        next.edges.clear();
        next.edge_ids.clear();
        take(now, std::move(next), fails);
    }
    constexpr int most_passes = 6;
    bool changed = true;
    for (int pass = 0; changed && pass < most_passes; ++pass) {
        changed = leave_out_triangles(now, fails);
        changed |= round_coordinates(now, fails);
        changed |= join_vertices(now, fails);
    }
    return now;
}

void write_soup(std::ostream& out, const TriangleSoup& soup) {
    for (const Vec3& p : soup.vertices) out << "v " << shortest(p[0]) << ' ' << shortest(p[1]) << ' ' << shortest(p[2]) << '\n';
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        const auto& [a, b, c] = soup.triangles[t];
        out << "f " << soup.patches[t] << ' ' << a << ' ' << b << ' ' << c << '\n';
    }
}

std::optional<TriangleSoup> read_soup(std::istream& in) {
    TriangleSoup soup;
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string kind;
        if (!(words >> kind)) continue;
        if (kind == "v") {
            std::string text;
            Vec3 p{};
            for (double& x : p) {
                if (!(words >> text) || std::from_chars(text.data(), text.data() + text.size(), x).ec != std::errc()) return std::nullopt;
            }
            soup.vertices.push_back(p);
        } else if (kind == "f") {
            std::uint32_t patch = 0;
            Triangle t{};
            if (!(words >> patch >> t[0] >> t[1] >> t[2])) return std::nullopt;
            soup.triangles.push_back(t);
            soup.patches.push_back(patch);
        } else {
            return std::nullopt;
        }
    }
    if (!check(soup)) return std::nullopt;
    return soup;
}

std::string as_code(const TriangleSoup& soup) {
    std::string text = "soup_of({";
    for (std::size_t v = 0; v < soup.vertices.size(); ++v) {
        const Vec3& p = soup.vertices[v];
        text += (v > 0 ? ", {" : "{") + shortest(p[0]) + ", " + shortest(p[1]) + ", " + shortest(p[2]) + "}";
    }
    text += "},\n{";
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        const auto& [a, b, c] = soup.triangles[t];
        text += (t > 0 ? ", {" : "{") + std::to_string(a) + ", " + std::to_string(b) + ", " + std::to_string(c) + "}";
    }
    text += "},\n{";
    for (std::size_t t = 0; t < soup.patches.size(); ++t) text += (t > 0 ? ", " : "") + std::to_string(soup.patches[t]);
    return text + "})";
}

}  // namespace geomend::test
