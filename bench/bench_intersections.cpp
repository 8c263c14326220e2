// SPDX-License-Identifier: AGPL-3.0-or-later
// Intersections of triangle soups, against CGAL's sequential self_intersections on the same triangles. Models: folded
// horizons with faults through them, from 10^4 to 10^7 triangles; and, where the real data is at hand, sixteen copies of modelA4.
//   bench_intersections --check FILE.ml...   compares the pairs found in a file, and in two copies of it a
//   little apart, with CGAL's instead, one by one
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <map>
#include <set>
#include <string>

#include "base/parallel.h"
#include "geometry/intersections.h"
#include "geometry/near_misses.h"
#include "peak_memory.h"
#include "soup_models.h"
#include "support/real_data.h"
#ifdef GEOMEND_WITH_CGAL
#include "cgal_intersections.h"
#endif

namespace {

using namespace geomend;
using namespace geomend::bench;

std::string real_file(const char* name) {
    const auto path = test::real_data(std::string("gocad/") + name);
    return path ? path->string() : std::string();
}

/// 0 stands for the copies of modelA4.
const Soup& model(std::int64_t size) {
    static std::map<std::int64_t, Soup> models;
    const auto [at, added] = models.try_emplace(size);
    if (added) at->second = size == 0 ? copies_of(real_file("modelA4.ml"), 16) : crossed_folds(static_cast<std::size_t>(size));
    return at->second;
}

void tell(benchmark::State& state, std::size_t triangles, std::size_t pairs) {
    state.counters["triangles"] = double(triangles);
    state.counters["pairs"] = double(pairs);
    state.counters["us_per_triangle"] =
        benchmark::Counter(double(triangles) / 1e6, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void ours(benchmark::State& state) {
    const Soup& soup = model(state.range(0));
    if (soup.triangles.empty()) return state.SkipWithError("no real data");
    const ThreadBudget budget(static_cast<std::size_t>(state.range(1)));
    std::size_t pairs = 0;
    for (auto _ : state) pairs = intersections(soup.vertices, soup.triangles).size();
    tell(state, soup.triangles.size(), pairs);
}

void tree_only(benchmark::State& state) {
    const Soup& soup = model(state.range(0));
    if (soup.triangles.empty()) return state.SkipWithError("no real data");
    for (auto _ : state) benchmark::DoNotOptimize(TriangleTree(soup.vertices, soup.triangles));
    tell(state, soup.triangles.size(), 0);
}

void borders(benchmark::State& state) {
    const Soup& soup = model(state.range(0));
    if (soup.triangles.empty()) return state.SkipWithError("no real data");
    const Borders free = free_borders(soup);
    const TriangleTree tree(soup.vertices, soup.triangles);
    const ThreadBudget budget(static_cast<std::size_t>(state.range(1)));
    std::size_t misses = 0;
    for (auto _ : state) misses = near_misses(SurfaceDistance(tree, soup.groups), free.edges, free.groups, near_length(soup)).size();
    tell(state, soup.triangles.size(), misses);
}

void insides(benchmark::State& state) {
    const Soup& soup = model(state.range(0));
    if (soup.triangles.empty()) return state.SkipWithError("no real data");
    const TriangleTree tree(soup.vertices, soup.triangles);
    const ThreadBudget budget(static_cast<std::size_t>(state.range(1)));
    std::size_t found = 0;
    const std::vector<double> near(soup.triangles.size(), near_length(soup));
    for (auto _ : state) found = closest_pairs(SurfaceDistance(tree, soup.groups), near).pairs.size();
    tell(state, soup.triangles.size(), found);
}

/// The pairs that meet, one by one: their features alone, and with positions made of them.
template <class How>
void pairs_alone(benchmark::State& state, const How& how) {
    const Soup& soup = model(state.range(0));
    const auto pairs = intersections(soup.vertices, soup.triangles);
    for (auto _ : state) {
        for (const auto& p : pairs) benchmark::DoNotOptimize(how(soup, soup.triangles[p.a], soup.triangles[p.b]));
    }
    state.counters["ns_per_pair"] =
        benchmark::Counter(double(pairs.size()) / 1e9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
void contacts(benchmark::State& state) {
    pairs_alone(state, [](const Soup& soup, const Triangle& a, const Triangle& b) { return contact(soup.vertices, a, b); });
}
void meetings(benchmark::State& state) {
    pairs_alone(state, [](const Soup& soup, const Triangle& a, const Triangle& b) { return meeting(soup.vertices, a, b); });
}

#ifdef GEOMEND_WITH_CGAL
void say_near(const Soup& soup) {
    const Borders free = free_borders(soup);
    const TriangleTree tree(soup.vertices, soup.triangles);
    for (const double part : {1.0, 5.0, 0.1}) {
        const double near = part * near_length(soup);
        const auto misses = near_misses(SurfaceDistance(tree, soup.groups), free.edges, free.groups, near);
        const auto close = closest_pairs(soup.vertices, soup.triangles, soup.groups, near).pairs;
        std::printf("  within %g: %zu of %zu free border edges, %zu pairs of surfaces\n", near, misses.size(), free.edges.size(),
                    close.size());
        for (std::size_t i = 0; i < std::min<std::size_t>(misses.size(), 5); ++i) {
            const NearMiss& m = misses[i];
            std::printf("    surface %u edge %u-%u, surface %u triangle %u: %g at %g %g %g\n", free.groups[m.border_edge],
                        free.edges[m.border_edge][0], free.edges[m.border_edge][1], soup.groups[m.triangle], m.triangle, m.distance,
                        m.on_edge[0], m.on_edge[1], m.on_edge[2]);
        }
        for (std::size_t i = 0; i < std::min<std::size_t>(close.size(), 5); ++i) {
            const ClosePair& c = close[i];
            std::printf("    surfaces %u and %u: %g at %g %g %g\n", c.group_a, c.group_b, c.distance, c.on_a[0], c.on_a[1], c.on_a[2]);
        }
    }
}

void cgal(benchmark::State& state) {
    const Soup& soup = model(state.range(0));
    if (soup.triangles.empty()) return state.SkipWithError("no real data");
    const CgalMesh mesh(soup.vertices, soup.triangles);
    std::size_t pairs = 0;
    for (auto _ : state) pairs = mesh.self_intersections().size();
    tell(state, soup.triangles.size(), pairs);
}

/// What is left of a common part where vertices and edges that are shared by number do not count.
bool more_than_shared(const Soup& soup, const std::array<std::uint32_t, 2>& pair) {
    const Triangle &a = soup.triangles[pair[0]], &b = soup.triangles[pair[1]];
    long shared = 0;
    for (const std::uint32_t v : a) shared += std::count(b.begin(), b.end(), v);
    return common_dimension_by_cgal(soup.vertices, a, b) > shared || shared == 3;
}

/// Says how the pairs differ; 0 where they are the same.
int check(const char* path, std::size_t copies, double spacing) {
    const Soup soup = copies_of(path, copies, spacing);
    std::set<std::array<std::uint32_t, 2>> mine, theirs;
    std::array<std::size_t, 5> kinds{};
    int wrong = 0;
    for (const auto& p : intersections(soup.vertices, soup.triangles)) {
        mine.insert({p.a, p.b});
        ++kinds[static_cast<std::size_t>(p.how.kind)];
        static constexpr std::array<int, 5> dimension{0, 1, 2, 2, 3};
        if (common_dimension_by_cgal(soup.vertices, soup.triangles[p.a], soup.triangles[p.b]) !=
            dimension[static_cast<std::size_t>(p.how.kind)])
            ++wrong;
    }
    std::size_t all = 0;
    for (const auto& pair : CgalMesh(soup.vertices, soup.triangles).self_intersections()) {
        ++all;
        if (more_than_shared(soup, pair)) theirs.insert(pair);
    }
    std::size_t only_mine = 0, only_theirs = 0;
    for (const auto& pair : mine) only_mine += theirs.count(pair) == 0;
    for (const auto& pair : theirs) only_theirs += mine.count(pair) == 0;
    std::printf("%s: %zu triangles, %zu pairs (%zu point, %zu touch, %zu crossing, %zu overlap), %d of another dimension than CGAL's\n",
                path, soup.triangles.size(), mine.size(), kinds[1], kinds[2], kinds[3], kinds[4], wrong);
    std::printf("  CGAL's mesh: %zu pairs, %zu of them in more than vertices and edges of equal position; %zu only here, %zu only there\n",
                all, theirs.size(), only_mine, only_theirs);
    if (copies == 1) say_near(soup);
    return wrong == 0 && only_mine == 0 && only_theirs == 0 ? 0 : 1;
}
#endif

void sizes(benchmark::internal::Benchmark* b) {
    b->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime()->ArgNames({"size", "threads"});
    for (const std::int64_t size :
         {std::int64_t{0}, std::int64_t{10000}, std::int64_t{100000}, std::int64_t{1000000}, std::int64_t{10000000}}) {
        b->Args({size, 0})->Args({size, 1});
    }
}
BENCHMARK(ours)->Apply(sizes);
BENCHMARK(borders)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime()->Args({0, 0})->Args({0, 1});
BENCHMARK(insides)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime()->Args({0, 0})->Args({0, 1});
BENCHMARK(contacts)->Unit(benchmark::kMillisecond)->Arg(100000);
BENCHMARK(meetings)->Unit(benchmark::kMillisecond)->Arg(100000);
BENCHMARK(tree_only)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime()->Arg(0)->Arg(1000000);
#ifdef GEOMEND_WITH_CGAL
BENCHMARK(cgal)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime()->Arg(0)->Arg(10000)->Arg(100000)->Arg(1000000);
#endif

}  // namespace

int main(int argc, char** argv) {
#ifdef GEOMEND_WITH_CGAL
    if (argc > 1 && std::strcmp(argv[1], "--check") == 0) {
        int result = 0;
        for (int i = 2; i < argc; ++i) result |= check(argv[i], 1, 0) | check(argv[i], 2, 0.0137);
        return result;
    }
#endif
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
