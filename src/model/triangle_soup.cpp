// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/triangle_soup.h"

#include <cmath>
#include <string>

#include "model/objects.h"

namespace geomend {

namespace {

Failure bad_soup(const char* what, std::size_t at) {
    return failure(FailureKind::internal, "", {}, std::string("triangle soup: ") + what + " " + std::to_string(at));
}

}  // namespace

Result<void> check(const TriangleSoup& soup) {
    const std::size_t n = soup.vertices.size();
    if (n >= no_index || soup.triangles.size() >= no_index) return bad_soup("more items than a number can name:", n);
    if (soup.patches.size() != soup.triangles.size()) return bad_soup("patches do not match the triangles:", soup.patches.size());
    if (soup.edge_ids.size() != soup.edges.size()) return bad_soup("edge ids do not match the edges:", soup.edge_ids.size());
    for (std::size_t i = 0; i < n; ++i) {
        for (const double x : soup.vertices[i]) {
            if (!std::isfinite(x)) return bad_soup("no finite position: vertex", i);
        }
    }
    for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
        for (const std::uint32_t v : soup.triangles[i]) {
            if (v >= n) return bad_soup("vertex out of range: triangle", i);
        }
    }
    for (std::size_t i = 0; i < soup.edges.size(); ++i) {
        const auto& [a, b] = soup.edges[i];
        if (a >= n || b >= n) return bad_soup("vertex out of range: edge", i);
        if (a == b) return bad_soup("two equal ends: edge", i);
    }
    return {};
}

}  // namespace geomend
