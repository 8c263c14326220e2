// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/tetrahedra_workers.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "volume/tetrahedra.h"

// Children that stay give what those of one question give, and outlive what goes wrong in one of them.

namespace geomend::volumes {
namespace {

/// A box of n by n squares on each side, each of two triangles.
RegionFacets box(unsigned n) {
    RegionFacets facets;
    std::vector<std::uint32_t> number((n + 1) * (n + 1) * (n + 1), no_index);
    const auto vertex = [&](std::array<unsigned, 3> at) {
        std::uint32_t& v = number[(at[0] * (n + 1) + at[1]) * (n + 1) + at[2]];
        if (v == no_index) {
            v = static_cast<std::uint32_t>(facets.positions.size());
            facets.positions.push_back({double(at[0]), double(at[1]), double(at[2])});
        }
        return v;
    };
    for (unsigned axis = 0; axis < 3; ++axis) {
        for (const unsigned side : {0u, n}) {
            for (unsigned i = 0; i < n; ++i) {
                for (unsigned j = 0; j < n; ++j) {
                    const auto corner = [&](unsigned a, unsigned b) {
                        std::array<unsigned, 3> at{};
                        at[axis] = side;
                        at[(axis + 1) % 3] = i + a;
                        at[(axis + 2) % 3] = j + b;
                        return vertex(at);
                    };
                    facets.triangles.push_back({corner(0, 0), corner(1, 0), corner(1, 1)});
                    facets.triangles.push_back({corner(0, 0), corner(1, 1), corner(0, 1)});
                }
            }
        }
    }
    return facets;
}

ChildLimits alone() {
    ChildLimits limits;
    limits.program = {GEOMEND_PROGRAM};
    return limits;
}

ChildLimits by(TetrahedraWorkers& workers) {
    ChildLimits limits;
    limits.workers = &workers;
    return limits;
}

const char* const few = "QpYq1.4";
const char* const many = "Qpq1.4a0.000002";

TEST(TetrahedraWorkers, AnswersAreThoseOfProcessesOfTheirOwn) {
    TetrahedraWorkers workers({GEOMEND_PROGRAM});
    for (const unsigned n : {1u, 3u, 6u, 2u}) {
        const auto one = tetrahedra_of(box(n), {}, few, {}, alone(), nullptr),
                   same = tetrahedra_of(box(n), {}, few, {}, by(workers), nullptr);
        ASSERT_TRUE(one && same) << n;
        EXPECT_FALSE(one->cells.empty());
        EXPECT_EQ(one->cells, same->cells);
        EXPECT_EQ(one->new_vertices, same->new_vertices);
    }
}

TEST(TetrahedraWorkers, LimitsHoldForOneQuestionAlone) {
    TetrahedraWorkers workers({GEOMEND_PROGRAM});
    const auto expect_filled = [&] { EXPECT_TRUE(tetrahedra_of(box(2), {}, few, {}, by(workers), nullptr)); };
    expect_filled();
    ChildLimits brief = by(workers);
    brief.seconds = 0.2;
    const auto slow = tetrahedra_of(box(2), {}, many, {}, brief, nullptr);
    ASSERT_FALSE(slow);
    EXPECT_EQ(slow.why().error.code, "F023");
    EXPECT_NE(slow.why().error.message.find("did not end"), std::string::npos) << slow.why().error.message;
    expect_filled();
}

#if !defined(__SANITIZE_ADDRESS__)
TEST(TetrahedraWorkers, SoDoesTheLimitOfMemory) {
    TetrahedraWorkers workers({GEOMEND_PROGRAM});
    ChildLimits little = by(workers);
    little.memory_bytes = 60u << 20;
    const auto large = tetrahedra_of(box(2), {}, many, {}, little, nullptr);
    ASSERT_FALSE(large);
    EXPECT_EQ(large.why().error.code, "F023") << large.why().error.message;
    little.memory_bytes = 0;
    EXPECT_TRUE(tetrahedra_of(box(2), {}, few, {}, little, nullptr));
}
#endif

TEST(TetrahedraWorkers, TwoTrianglesThatCrossAreToldAndTheNextIsFilled) {
    TetrahedraWorkers workers({GEOMEND_PROGRAM});
    RegionFacets crossing = box(1);
    const auto first = static_cast<std::uint32_t>(crossing.positions.size());
    for (const Vec3& p : {Vec3{0.5, 0.5, -1}, Vec3{0.6, 0.5, 2}, Vec3{0.5, 0.7, 2}}) crossing.positions.push_back(p);
    crossing.triangles.push_back({first, first + 1, first + 2});
    const auto one = tetrahedra_of(crossing, {}, "QpY", {}, alone(), nullptr),
               same = tetrahedra_of(crossing, {}, "QpY", {}, by(workers), nullptr);
    ASSERT_FALSE(one);
    ASSERT_FALSE(same);
    EXPECT_EQ(one.why().error.message, same.why().error.message);
    EXPECT_TRUE(tetrahedra_of(box(1), {}, few, {}, by(workers), nullptr));
}

TEST(TetrahedraWorkers, ThreadsAskAtTheSameTime) {
    TetrahedraWorkers workers({GEOMEND_PROGRAM});
    std::vector<std::size_t> cells(40, 0);
    parallel_for_each_index(cells.size(), [&](std::size_t i) {
        const auto made = tetrahedra_of(box(1 + i % 4), {}, few, {}, by(workers), nullptr);
        if (made) cells[i] = made->cells.size();
    });
    for (std::size_t i = 0; i < cells.size(); ++i) {
        EXPECT_GT(cells[i], 0u);
        EXPECT_EQ(cells[i], cells[i % 4]);
    }
}

TEST(TetrahedraWorkers, ProgramsThatAreNoneAreFailures) {
    for (const std::vector<std::string>& program :
         {std::vector<std::string>{"/bin/false"}, {"/bin/echo", "no answer"}, {"/there/is/none"}, {GEOMEND_MISBEHAVING, "crash"}}) {
        TetrahedraWorkers workers(program);
        EXPECT_FALSE(tetrahedra_of(box(1), {}, few, {}, by(workers), nullptr)) << program[0];
        EXPECT_FALSE(tetrahedra_of(box(1), {}, few, {}, by(workers), nullptr)) << program[0];
    }
}

TEST(TetrahedraWorkers, RequestsAreReadAsTheyWereAsked) {
    const TetrahedraRequest back = request_of(request_text({"QpYq1.4", "/proc/1/fd/3", 123456789012}));
    EXPECT_EQ(back.switches, "QpYq1.4");
    EXPECT_EQ(back.path, "/proc/1/fd/3");
    EXPECT_EQ(back.memory_bytes, 123456789012u);
}

}  // namespace
}  // namespace geomend::volumes
