// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/edge_mesh.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "made_surfaces.h"
#include "remesh/isotropic.h"

// Any sequence of operations leaves a mesh of the same topology.

namespace geomend::remeshing {
namespace {

using test::numbers_of;

/// One operation at a half-edge, if it can be done there.
void operate(EdgeMesh& mesh, unsigned what, std::uint32_t h) {
    if (mesh.corners[h] == no_index) return;
    const Vec3 &a = mesh.places[mesh.from(h)], &b = mesh.places[mesh.to(h)];
    if (what % 5 == 4) {
        const Vec3& c = mesh.places[mesh.tip(h)];
        split_face(mesh, h / 3, {(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, (a[2] + b[2] + c[2]) / 3});
    } else if (what % 4 == 0) {
        split_edge(mesh, h, {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2});
    } else if (what % 4 == 1) {
        if (can_flip(mesh, h)) flip_edge(mesh, h);
    } else {
        const std::uint32_t gone = what % 4 == 2 ? mesh.from(h) : mesh.to(h);
        if (can_collapse(mesh, h, gone)) collapse_edge(mesh, h, gone);
    }
}

void stays_what_it_is(EdgeMesh mesh, bool collapses_only) {
    const auto before = numbers_of(mesh);
    ASSERT_TRUE(is_consistent(mesh));
    const auto steps = *rc::gen::container<std::vector<std::pair<unsigned, std::uint32_t>>>(
        200, rc::gen::pair(rc::gen::inRange(0u, 20u), rc::gen::inRange(0u, 1u << 20)));
    for (const auto& [what, where] : steps) {
        operate(mesh, collapses_only ? 2 + what % 2 : what, where % static_cast<std::uint32_t>(mesh.corners.size()));
        RC_ASSERT(is_consistent(mesh));
        RC_ASSERT(numbers_of(mesh).euler == before.euler);
    }
}

RC_GTEST_PROP(EdgeMesh, ASheetStaysASheetWhateverIsDone, ()) { stays_what_it_is(test::sheet(3, 4), false); }
RC_GTEST_PROP(EdgeMesh, ASheetStaysASheetWhereAllCollapses, ()) { stays_what_it_is(test::sheet(3, 4), true); }
RC_GTEST_PROP(EdgeMesh, ACubeStaysClosedWhateverIsDone, ()) { stays_what_it_is(test::closed_cube(2), false); }
RC_GTEST_PROP(EdgeMesh, ACubeStaysClosedWhereAllCollapses, ()) { stays_what_it_is(test::closed_cube(2), true); }

TEST(EdgeMesh, TrianglesThatTurnOppositeWaysAreRefused) {
    const std::vector<Vec3> places{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const std::vector<std::uint32_t> corners{0, 1, 2, 0, 3, 2}, neighbours{no_index, no_index, 1, no_index, no_index, 0};
    EXPECT_FALSE(fanned_mesh(places, corners, neighbours).ok());
}

TEST(EdgeMesh, TwoFansAtAVertexBecomeTwoVertices) {
    const std::vector<Vec3> places{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
    const std::vector<std::uint32_t> corners{0, 1, 2, 0, 3, 4}, neighbours(6, no_index);
    const auto made = fanned_mesh(places, corners, neighbours);
    ASSERT_TRUE(made.ok());
    EXPECT_EQ(made->mesh.places.size(), 6u);
    EXPECT_TRUE(is_consistent(made->mesh));
}

}  // namespace
}  // namespace geomend::remeshing
