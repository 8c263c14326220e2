// SPDX-License-Identifier: AGPL-3.0-or-later
// Intersections of triangle soups, against CGAL's sequential self_intersections on the same triangles. Models: folded
// horizons with faults through them, from 10^4 to 10^7 triangles; and, where the real data is at hand, sixteen copies of modelA4.
//   bench_intersections --check FILE.ml...   compares the pairs found in a file with CGAL's instead, one by one
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

#ifdef GEOMEND_WITH_CGAL
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
int check(const char* path) {
    const Soup soup = copies_of(path, 1);
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
    return wrong == 0 && only_mine == 0 && only_theirs == 0 ? 0 : 1;
}
#endif

void sizes(benchmark::internal::Benchmark* b) {
    b->Unit(benchmark::kMillisecond)->UseRealTime()->ArgNames({"size", "threads"});
    for (const std::int64_t size :
         {std::int64_t{0}, std::int64_t{10000}, std::int64_t{100000}, std::int64_t{1000000}, std::int64_t{10000000}}) {
        b->Args({size, 0})->Args({size, 1});
    }
}
BENCHMARK(ours)->Apply(sizes);
BENCHMARK(tree_only)->Unit(benchmark::kMillisecond)->UseRealTime()->Arg(0)->Arg(1000000);
#ifdef GEOMEND_WITH_CGAL
BENCHMARK(cgal)->Unit(benchmark::kMillisecond)->UseRealTime()->Arg(0)->Arg(10000)->Arg(100000)->Arg(1000000);
#endif

}  // namespace

int main(int argc, char** argv) {
#ifdef GEOMEND_WITH_CGAL
    if (argc > 1 && std::strcmp(argv[1], "--check") == 0) {
        int result = 0;
        for (int i = 2; i < argc; ++i) result |= check(argv[i]);
        return result;
    }
#endif
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
