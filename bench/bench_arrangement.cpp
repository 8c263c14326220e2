// SPDX-License-Identifier: AGPL-3.0-or-later
// Cutting a soup of wavy open surfaces, beside CGAL's autorefinement on the same triangles. Processor seconds, one thread.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "arrangement/arrange.h"
#include "arrangement/rough_faults.h"
#include "asked.h"
#include "base/parallel.h"
#include "peak_memory.h"
#ifdef GEOMEND_WITH_CGAL
#include "cgal_arrangement.h"
#endif

namespace {

using geomend::TriangleSoup;
using geomend::Vec3;
using geomend::test::add_sheet;

/// Ten wavy horizons and two families of five wavy faults, all open and across each other: 20 surfaces of 2 n n triangles.
TriangleSoup wavy_surfaces(std::uint32_t n) {
    TriangleSoup soup;
    for (int h = 0; h < 10; ++h) {
        add_sheet(soup, n, n, [&](double u, double v) {
            return Vec3{1000 * u, 1000 * v, 90.0 * h + 50 + 12 * std::sin(6.1 * u + 0.7 * h) * std::cos(5.3 * v + 0.3 * h)};
        });
    }
    for (int f = 0; f < 10; ++f) {
        add_sheet(soup, n, n, [&](double u, double v) {
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

double megabytes(const TriangleSoup& soup) {
    return 1e-6 * static_cast<double>(24 * soup.vertices.size() + 12 * soup.triangles.size() + 4 * soup.patches.size());
}

/// Soups that most cutters do badly on, of some 20,000 triangles each.
std::vector<std::pair<const char*, TriangleSoup>> degenerate_soups() {
    std::vector<std::pair<const char*, TriangleSoup>> soups;
    const auto add = [&](const char* name) -> TriangleSoup& { return soups.emplace_back(name, TriangleSoup{}).second; };
    const auto flat = [](double u, double v) { return Vec3{1000 * u, 1000 * v, 0}; };
    TriangleSoup& twice = add("one sheet twice");
    for (int k = 0; k < 2; ++k) add_sheet(twice, 70, 70, flat);
    TriangleSoup& plane = add("two sheets in one plane, edges shifted");
    add_sheet(plane, 70, 70, flat);
    add_sheet(plane, 70, 70, [](double u, double v) { return Vec3{1000 * u + 3.1, 1000 * v + 5.7, 0}; });
    TriangleSoup& nearly = add("two sheets that dip 1e-6 against each other");
    add_sheet(nearly, 70, 70, flat);
    add_sheet(nearly, 70, 70, [](double u, double v) { return Vec3{1000 * u, 1000 * v, 1e-3 * (u - 0.5)}; });
    TriangleSoup& star = add("50 sheets through one line");
    for (int k = 0; k < 50; ++k) {
        const double angle = 3.14159265358979 * k / 50;
        add_sheet(star, 14, 14, [&](double u, double v) {
            return Vec3{1000 * (u - 0.5) * std::cos(angle), 1000 * (u - 0.5) * std::sin(angle), 1000 * v};
        });
    }
    TriangleSoup& needles = add("needles 1 : 10,000 across each other");
    add_sheet(needles, 70, 70, [](double u, double v) { return Vec3{1000 * u, 0.1 * v, 0.05 + 0.01 * std::sin(50 * u)}; });
    add_sheet(needles, 70, 70, [](double u, double v) { return Vec3{1000 * u, 0.05 + 0.01 * std::sin(40 * u), 0.1 * v}; });
    TriangleSoup& flakes = add("triangles without area on a sheet");
    add_sheet(flakes, 70, 70, flat);
    add_sheet(flakes, 70, 70, [](double u, double) { return Vec3{1000 * u, 500 + 100 * u, 0}; });
    return soups;
}

void print_rough_faults() {
    const TriangleSoup soup = geomend::test::rough_faults_through_topography(707, 158);
    geomend::bench::Least least;
    std::size_t result = 0, turned = 0;
    for (int round = 0; round < 2; ++round) {
        std::optional<geomend::arrangement::Arrangement> cut;
        least.take([&] { cut = std::move(*geomend::arrangement::arrange(soup, {.tolerance = 0.003})); });
        result = cut->soup.triangles.size();
        turned = 0;
        for (std::size_t t = 0; t < result; ++t) {
            const Vec3 a = geomend::test::area_vector_of(cut->soup, t);
            const Vec3 b = geomend::test::area_vector_of(soup, cut->origin.triangles[t]);
            if (!(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] > 0)) ++turned;
        }
    }
    std::printf(
        "rough faults through a topography             asked  5.00  measured %5.2f s (%.2f on the wall): %zu -> %zu triangles, %zu "
        "turned\n",
        least.cpu, least.wall, soup.triangles.size(), result, turned);
}

void print_asked() {
    const geomend::ThreadBudget one_thread(1);
    print_rough_faults();
    for (auto& [name, soup] : degenerate_soups()) {
        geomend::bench::Least least;
        std::optional<geomend::arrangement::Arrangement> result;
        least.take([&] {
            if (auto cut = geomend::arrangement::arrange(soup, {.tolerance = 1.5e-4})) result = std::move(*cut);
        });
        if (!result) return static_cast<void>(std::printf("%s: cannot be cut\n", name));
        std::printf("%-44s %6zu -> %7zu triangles, %2u rounds, %s, %6.2f s, %5.2f us a triangle of the result\n", name,
                    soup.triangles.size(), result->soup.triangles.size(), result->rounds, result->clean ? "clean" : "NOT clean", least.cpu,
                    1e6 * least.cpu / static_cast<double>(result->soup.triangles.size()));
    }
    const double before = geomend::bench::status_bytes("VmHWM:");
    const TriangleSoup& soup = soup_of(158);
    geomend::bench::Least least;
    double result = 0;
    least.take([&] { result = megabytes(geomend::arrangement::arrange(soup, {.tolerance = 1.5e-4})->soup); });
    const double peak = geomend::bench::status_bytes("VmHWM:") / 1e6;
    std::printf("%zu triangles: %.2f s; input %.0f MB, result %.0f MB, peak of the process %.0f MB (%.0f MB before)\n",
                soup.triangles.size(), least.cpu, megabytes(soup), result, peak, before / 1e6);
#ifdef GEOMEND_WITH_CGAL
    geomend::bench::Least theirs;
    geomend::bench::CgalSoup mesh(soup.vertices, soup.triangles);
    theirs.take([&] { benchmark::DoNotOptimize(mesh.autorefine()); });
    geomend::bench::print_ratio("1 M triangles are cut", 1.0, least, "CGAL's autorefine", theirs);
#endif
}

}  // namespace

int main(int argc, char** argv) { geomend::bench::run(argc, argv, print_asked); }
