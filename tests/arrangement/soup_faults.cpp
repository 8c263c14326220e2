// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/soup_faults.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "arrangement/arrange.h"
#include "arrangement/exact_pairs.h"
#include "base/parallel.h"
#include "geometry/vectors.h"

namespace geomend::test {

namespace {

constexpr std::array<const char*, 10> names{"none",           "crashed",     "slow",       "refused",   "not_clean",
                                            "crossing_pairs", "near_points", "bad_origin", "lost_area", "changed_again"};

double length(const Vec3& v) { return std::sqrt(dot(v, v)); }

double area(const TriangleSoup& soup, const Triangle& t) {
    return 0.5 * length(cross(minus(soup.vertices[t[1]], soup.vertices[t[0]]), minus(soup.vertices[t[2]], soup.vertices[t[0]])));
}

bool has_near_points(const TriangleSoup& soup, double tolerance) {
    std::vector<std::uint8_t> used(soup.vertices.size(), 0);
    for (const Triangle& t : soup.triangles) {
        for (const std::uint32_t v : t) used[v] = 1;
    }
    std::vector<Vec3> points;
    for (std::size_t v = 0; v < used.size(); ++v) {
        if (used[v] != 0) points.push_back(soup.vertices[v]);
    }
    std::sort(points.begin(), points.end());
    // Points are compared on a grid and keep their own places where they were there before: a share of the tolerance finer.
    const double least = tolerance * (1 - 1e-2);
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = i + 1; j < points.size() && points[j][0] - points[i][0] < least; ++j) {
            if (length(minus(points[j], points[i])) < least) return true;
        }
    }
    return false;
}

/// Pieces of each triangle together against the triangle, in what a border that moved by a few tolerances changes. Where doubles were
/// left out of patches, only patches of one triangle are judged: what lies on each other in others is there once.
bool loses_area(const TriangleSoup& soup, const arrangement::Arrangement& cut, double tolerance) {
    std::vector<double> after(soup.triangles.size(), 0);
    std::vector<std::uint32_t> in_patch;
    for (const std::uint32_t p : soup.patches) {
        if (p >= in_patch.size()) in_patch.resize(p + 1, 0);
        ++in_patch[p];
    }
    for (std::size_t t = 0; t < cut.soup.triangles.size(); ++t) after[cut.origin.triangles[t]] += area(cut.soup, cut.soup.triangles[t]);
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        if (cut.doubled > 0 && in_patch[soup.patches[t]] > 1) continue;
        const Triangle& c = soup.triangles[t];
        double border = 0;
        for (std::size_t i = 0; i < 3; ++i) border += length(minus(soup.vertices[c[i]], soup.vertices[c[(i + 1) % 3]]));
        if (std::abs(after[t] - area(soup, c)) > 4 * tolerance * (border + tolerance)) return true;
    }
    return false;
}

}  // namespace

std::string to_string(SoupFault fault) { return names[static_cast<std::size_t>(fault)]; }

SoupFault fault_named(const std::string& name) {
    const auto at = std::ranges::find(names, name);
    return at == names.end() ? SoupFault::none : static_cast<SoupFault>(at - names.begin());
}

SoupFault fault_of(const TriangleSoup& soup, double tolerance) {
    const auto cut = arrangement::arrange(soup, {.tolerance = tolerance});
    if (!cut || !check(cut->soup)) return SoupFault::refused;
    if (!cut->clean) return SoupFault::not_clean;
    if (has_near_points(cut->soup, tolerance)) return SoupFault::near_points;
    if (!check(cut->origin, soup, cut->soup)) return SoupFault::bad_origin;
    if (loses_area(soup, *cut, tolerance)) return SoupFault::lost_area;
    const auto again = arrangement::arrange(cut->soup, {.tolerance = tolerance});
    if (!again || again->soup.triangles != cut->soup.triangles || again->soup.vertices != cut->soup.vertices)
        return SoupFault::changed_again;
    return pairs_that_meet_exactly(cut->soup, 1) > 0 ? SoupFault::crossing_pairs : SoupFault::none;
}

SoupFault fault_in_child(const TriangleSoup& soup, double tolerance, unsigned seconds) {
    const pid_t child = fork();
    if (child == 0) {
        const rlimit limit{seconds, seconds + 1};
        setrlimit(RLIMIT_CPU, &limit);
        const ThreadBudget alone(1);
        _exit(static_cast<int>(fault_of(soup, tolerance)));
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child) return SoupFault::crashed;
    if (WIFEXITED(status)) return static_cast<SoupFault>(WEXITSTATUS(status));
    return WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL ? SoupFault::slow : SoupFault::crashed;
}

}  // namespace geomend::test
