// SPDX-License-Identifier: AGPL-3.0-or-later
#include "rough_faults.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <utility>

#include "cut_soups.h"

namespace geomend {
namespace {

using namespace test;
using Edge = std::pair<std::uint32_t, std::uint32_t>;

double length_of(const TriangleSoup& soup, const Edge& edge) {
    const Vec3 d = minus(soup.vertices[edge.first], soup.vertices[edge.second]);
    return std::sqrt(dot(d, d));
}

/// Per patch, how long the edges are that only one of its triangles has.
std::map<std::uint32_t, double> border_lengths(const TriangleSoup& soup) {
    std::map<std::pair<std::uint32_t, Edge>, int> uses;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) ++uses[{soup.patches[t], std::minmax(soup.triangles[t][k], soup.triangles[t][(k + 1) % 3])}];
    }
    std::map<std::uint32_t, double> lengths;
    for (const auto& [edge, count] : uses) {
        if (count == 1) lengths[edge.first] += length_of(soup, edge.second);
    }
    return lengths;
}

std::uint32_t size_asked() {
    const char* asked = std::getenv("GEOMEND_ROUGH_FAULTS");  // cells along a side of the topography
    return asked != nullptr ? static_cast<std::uint32_t>(std::strtoul(asked, nullptr, 10)) : 90;
}

TEST(RoughFaults, AreCutThroughATopographyWithoutAHoleAndWithoutATurnedFace) {
    const std::uint32_t n = size_asked();
    const TriangleSoup soup = rough_faults_through_topography(n, n * 158 / 707);
    const double tolerance = 0.003;
    const Arrangement cut = expect_arranged(soup, tolerance);
    EXPECT_GT(cut.made, n);
    std::vector<Vec3> sums(soup.triangles.size());
    std::size_t turned = 0;
    for (std::size_t t = 0; t < cut.soup.triangles.size(); ++t) {
        const std::uint32_t from = cut.origin.triangles[t];
        const Vec3 piece = area_vector_of(cut.soup, t);
        if (dot(piece, area_vector_of(soup, from)) <= 0) ++turned;
        sums[from] = plus(sums[from], piece);
    }
    EXPECT_EQ(turned, 0u);
    for (std::size_t t = 0; t < sums.size(); ++t) {  // the pieces of each triangle cover it but for its shaken rim
        const Vec3 d = minus(sums[t], area_vector_of(soup, t));
        EXPECT_LE(std::sqrt(dot(d, d)), 2000 * tolerance) << "triangle " << t;
    }
    const auto before = border_lengths(soup), after = border_lengths(cut.soup);
    for (const auto& [patch, length] : before) EXPECT_NEAR(after.at(patch), length, 1e-6 * length) << "patch " << patch;
}

}  // namespace
}  // namespace geomend
