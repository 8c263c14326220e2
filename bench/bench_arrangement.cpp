// SPDX-License-Identifier: AGPL-3.0-or-later
// Cutting a soup of wavy open surfaces, beside CGAL's autorefinement on the same triangles. Processor seconds, one thread.
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>

#include "arrangement/arrange.h"
#include "base/parallel.h"
#ifdef GEOMEND_WITH_CGAL
#include "cgal_arrangement.h"
#endif

namespace {

using geomend::TriangleSoup;
using geomend::Vec3;

template <class Place>
void add_sheet(TriangleSoup& soup, std::uint32_t n, const Place& place) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    const std::uint32_t patch = soup.patches.empty() ? 0 : soup.patches.back() + 1;
    for (std::uint32_t j = 0; j <= n; ++j) {
        for (std::uint32_t i = 0; i <= n; ++i) soup.vertices.push_back(place(i / static_cast<double>(n), j / static_cast<double>(n)));
    }
    for (std::uint32_t j = 0; j < n; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = first + j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            soup.triangles.insert(soup.triangles.end(), {{a, b, d}, {a, d, c}});
            soup.patches.insert(soup.patches.end(), {patch, patch});
        }
    }
}

/// Ten wavy horizons and two families of five wavy faults, all open and across each other: 20 surfaces of 2 n n triangles.
TriangleSoup wavy_surfaces(std::uint32_t n) {
    TriangleSoup soup;
    for (int h = 0; h < 10; ++h) {
        add_sheet(soup, n, [&](double u, double v) {
            return Vec3{1000 * u, 1000 * v, 90.0 * h + 50 + 12 * std::sin(6.1 * u + 0.7 * h) * std::cos(5.3 * v + 0.3 * h)};
        });
    }
    for (int f = 0; f < 10; ++f) {
        add_sheet(soup, n, [&](double u, double v) {
            const double across = 100 + 190.0 * (f % 5) + 60 * (v - 0.5) + 15 * std::sin(7.3 * u + f) + 7 * std::sin(9.1 * v + 2 * f);
            const double along = -20 + 1040 * u, up = -20 + 1010 * v;
            return f < 5 ? Vec3{across, along, up} : Vec3{along, across, up};
        });
    }
    return soup;
}

const TriangleSoup& soup_of(std::uint32_t n) {
    static std::map<std::uint32_t, TriangleSoup> made;
    auto& soup = made[n];
    if (soup.triangles.empty()) soup = wavy_surfaces(n);
    return soup;
}

void cut(benchmark::State& state) {
    const geomend::ThreadBudget threads(static_cast<std::size_t>(state.range(1)));
    const TriangleSoup& soup = soup_of(static_cast<std::uint32_t>(state.range(0)));
    for (auto _ : state) {
        auto result = geomend::arrangement::arrange(soup, {.tolerance = 1.5e-4});
        state.counters["triangles"] = static_cast<double>(soup.triangles.size());
        state.counters["result"] = static_cast<double>(result->soup.triangles.size());
        state.counters["vertices"] = static_cast<double>(result->soup.vertices.size());
        state.counters["rounds"] = result->rounds;
        state.counters["clean"] = result->clean ? 1 : 0;
    }
}
BENCHMARK(cut)
    ->Args({50, 1})
    ->Args({50, 2})
    ->Args({120, 1})
    ->Args({158, 1})
    ->Args({158, 2})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

#ifdef GEOMEND_WITH_CGAL
void cgal_autorefine(benchmark::State& state) {
    const TriangleSoup& soup = soup_of(static_cast<std::uint32_t>(state.range(0)));
    for (auto _ : state) {
        state.PauseTiming();
        geomend::bench::CgalSoup mesh(soup.vertices, soup.triangles);
        state.ResumeTiming();
        state.counters["result"] = static_cast<double>(mesh.autorefine());
    }
}
BENCHMARK(cgal_autorefine)->Arg(50)->Arg(120)->Arg(158)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
#endif

}  // namespace

BENCHMARK_MAIN();
