// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/worker_message.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace geomend::volumes {
namespace {

RC_GTEST_PROP(WorkerMessage, TetrahedraComeThroughBitByBit, ()) {
    const auto known = *rc::gen::inRange<std::size_t>(4, 20);
    const auto doubles = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-1000, 1000));
    Tetrahedra all;
    for (std::size_t i = 0; i + 3 <= doubles.size(); i += 3)
        all.new_vertices.push_back({doubles[i] / 7.0, doubles[i + 1] / 3.0, doubles[i + 2] + 0.1});
    const auto vertices = static_cast<std::uint32_t>(known + all.new_vertices.size());
    const auto corners = *rc::gen::container<std::vector<std::uint32_t>>(rc::gen::inRange(0u, vertices));
    for (std::size_t i = 0; i + 4 <= corners.size(); i += 4)
        all.cells.push_back({corners[i], corners[i + 1], corners[i + 2], corners[i + 3]});
    const auto back = worker_tetrahedra(worker_answer(all), known);
    RC_ASSERT(back.has_value());
    RC_ASSERT(back->new_vertices == all.new_vertices);
    RC_ASSERT(back->cells == all.cells);
}

RC_GTEST_PROP(WorkerMessage, DamagedAnswersAreRefusedOrInRange, ()) {
    std::string bytes = worker_answer({{{1, 2, 3}}, {{0, 1, 2, 3}, {1, 2, 3, 4}}});
    const auto at = *rc::gen::inRange<std::size_t>(0, bytes.size());
    bytes[at] = *rc::gen::arbitrary<char>();
    bytes.resize(*rc::gen::element(bytes.size(), at, bytes.size() + 8));
    const auto read = worker_tetrahedra(bytes, 4);
    if (!read) return;
    for (const auto& cell : read->cells) {
        for (const std::uint32_t v : cell) RC_ASSERT(v < 4 + read->new_vertices.size());
    }
}

TEST(WorkerMessage, QuestionsAreReadAsTheyWereAsked) {
    const std::vector<Vec3> positions = {{0, 0, 0}, {1e9 + 0.1, 0, 0}, {0, 1, -1e-300}};
    const std::vector<Triangle> triangles = {{0, 1, 2}};
    const std::vector<Vec3> points = {{4, 5, 6}};
    const std::vector<SizedPoint> sizes = {{{7, 8, 9}, 0.5}, {{-1, 0, 2}, 3}};
    const std::vector<std::array<std::uint32_t, 2>> edges = {{0, 2}, {2, 1}};
    const auto read = worker_facets(worker_question({positions, triangles, points, sizes, edges}));
    ASSERT_TRUE(read.has_value());
    ASSERT_EQ(read->sizes.size(), 2u);
    EXPECT_EQ(read->sizes[1].place, sizes[1].place);
    EXPECT_EQ(read->sizes[1].size, 3);
    EXPECT_EQ(read->points, points);
    EXPECT_EQ(read->positions, positions);
    EXPECT_EQ(read->triangles, triangles);
    EXPECT_EQ(read->edges, edges);
    const std::vector<Triangle> beyond = {{0, 1, 3}};
    EXPECT_FALSE(worker_facets(worker_question({positions, beyond, points, sizes, edges})).has_value());
    EXPECT_FALSE(worker_facets(worker_question({positions, triangles, points, {{{7, 8, 9}, -1}}, edges})).has_value());
    EXPECT_FALSE(worker_facets(worker_question({positions, triangles, points, sizes, {{0, 3}}})).has_value());
}

}  // namespace
}  // namespace geomend::volumes
