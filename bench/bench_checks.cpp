// SPDX-License-Identifier: AGPL-3.0-or-later
// All checks of a Model3d, reading and the boundary representation included (`per_cgal`) and without (`checks_per_cgal`), of copies
// of a real model (where the real data is at hand; sixteen have 782,000 triangles, 880 surfaces and 128 regions) in a row, in a
// square, and with one 10^5 diameters away; against CGAL's sequential self_intersections on the same triangles in the same run, on
// one thread: 0.5 at most is asked, and the time per triangle to be the same within 1.3 for all.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "asked.h"
#include "base/parallel.h"
#include "formats/gocad/write_gocad.h"
#include "model_copies.h"
#include "peak_memory.h"
#include "pipeline/validate.h"
#include "support/real_data.h"
#include "topology/brep_from_dataset.h"
#include "topology/lengths.h"
#ifdef GEOMEND_WITH_CGAL
#include "cgal_intersections.h"
#endif

namespace {

using namespace geomend;

struct Case {
    const char* name;
    std::uint32_t copies;
    bench::Layout layout;
};
constexpr std::array cases = {
    Case{"one", 1, bench::Layout::row},
    Case{"16 in a row", 16, bench::Layout::row},
    Case{"16 in a square", 16, bench::Layout::square},
    Case{"16, one far", 16, bench::Layout::one_far},
    Case{"64 in a row", 64, bench::Layout::row},
    Case{"64 in a square", 64, bench::Layout::square},
};

/// The file that is checked, on disk until the end; empty where there is no real data.
const std::string& model_file(std::size_t number) {
    static std::array<std::string, cases.size()> paths;
    std::string& path = paths[number];
    if (!path.empty()) return path;
    const auto real = test::real_data("gocad/modelA4.ml");
    if (!real) return path;
    const auto one = load(real->string(), {});
    if (!one) return path;
    const auto name =
        std::filesystem::temp_directory_path() / ("bench_checks_" + std::to_string(::getpid()) + "_" + std::to_string(number) + ".ml");
    OutputSet files(name);
    const Dataset copies = bench::copies_of(*one, cases[number].copies, 20000, cases[number].layout);
    if (gocad::write_model3d(copies, files, {}) && files.commit()) path = name.string();
    return path;
}

#ifdef GEOMEND_WITH_CGAL
/// The triangles of a case as CGAL has them.
bench::CgalMesh cgal_mesh(std::size_t number) {
    const auto data = load(model_file(number), {});
    const auto models = topology::models_to_judge(*data, 0);
    const BrepData& brep = *models->front().brep;
    std::vector<Triangle> triangles;
    for (const auto& surface : brep.surfaces) {
        for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
            const auto t = surface.polygons[p];
            triangles.push_back({surface.nodes[t[0]].value, surface.nodes[t[1]].value, surface.nodes[t[2]].value});
        }
    }
    return bench::CgalMesh(brep.vertices, triangles);
}

/// Processor seconds of CGAL for them, once.
double cgal_seconds(std::size_t number) {
    static std::array<double, cases.size()> known{};
    if (known[number] > 0) return known[number];
    const bench::CgalMesh mesh = cgal_mesh(number);
    const double before = bench::cpu_seconds();
    benchmark::DoNotOptimize(mesh.self_intersections().size());
    return known[number] = bench::cpu_seconds() - before;
}
#endif

/// What comes before the checks: reading, lengths, the boundary representation. CGAL's mesh is made before its search, too.
void prepare(const std::string& path) {
    const auto data = load(path, {});
    const auto lengths = topology::local_lengths(*data, {});
    benchmark::DoNotOptimize(topology::models_to_judge(*data, topology::model_sources(*data, lengths)));
}

void all_checks(benchmark::State& state) {
    const auto number = static_cast<std::size_t>(state.range(0));
    const std::string& path = model_file(number);
    if (path.empty()) return state.SkipWithError("no real data");
    state.SetLabel(cases[number].name);
    const ThreadBudget budget(static_cast<std::size_t>(state.range(1)));
    std::size_t findings = 0;
    double seconds = 0, before_checks = 0;
    {
        const double before = bench::cpu_seconds();
        prepare(path);
        before_checks = bench::cpu_seconds() - before;
    }
    for (auto _ : state) {
        const double before = bench::cpu_seconds();
        const auto file = validate(path, LoadOptions{}, validators::CheckOptions{});
        seconds += bench::cpu_seconds() - before;
        findings = file ? file->findings.size() : 0;
    }
    seconds /= static_cast<double>(state.iterations());
    state.counters["findings"] = static_cast<double>(findings);
    state.counters["ms_per_copy"] = 1e3 * seconds / cases[number].copies;
#ifdef GEOMEND_WITH_CGAL
    state.counters["per_cgal"] = seconds / cgal_seconds(number);
    state.counters["checks_per_cgal"] = (seconds - before_checks) / cgal_seconds(number);
#endif
    state.counters["peak_MB"] = bench::status_bytes("VmHWM:") / 1e6;
}

void print_asked() {
#ifdef GEOMEND_WITH_CGAL
    const ThreadBudget one_thread(1);
    for (std::size_t number = 0; number < cases.size(); ++number) {
        const std::string& path = model_file(number);
        if (path.empty()) return static_cast<void>(std::printf("all checks on copies of a model: no real data\n"));
        const bench::CgalMesh mesh = cgal_mesh(number);
        bench::Least cgal, before, whole;
        for (int round = 0; round < (cases[number].copies < 16 ? 8 : 2); ++round) {
            cgal.take([&] { benchmark::DoNotOptimize(mesh.self_intersections()); });
            before.take([&] { prepare(path); });
            whole.take([&] { benchmark::DoNotOptimize(validate(path, LoadOptions{}, validators::CheckOptions{})); });
        }
        const bench::Least checks{whole.cpu - before.cpu, whole.wall - before.wall};
        const std::string name = cases[number].name;
        constexpr auto yardstick = "CGAL's self_intersections, one thread";
        bench::print_ratio(("all checks: " + name).c_str(), 0.5, checks, yardstick, cgal);
        std::printf("%-44s %34.2f  x the same, reading and B-Rep included\n", "", whole.cpu / cgal.cpu);
    }
#else
    std::printf("all checks on copies of a model: CGAL is not installed\n");
#endif
}

}  // namespace

BENCHMARK(all_checks)->Unit(benchmark::kMillisecond)->UseRealTime()->ArgsProduct({{0, 1, 2, 3, 4, 5}, {1}})->Args({1, 2});

int main(int argc, char** argv) {
    bench::run(argc, argv, print_asked);
    for (std::size_t number = 0; number < cases.size(); ++number) {
        const auto name =
            std::filesystem::temp_directory_path() / ("bench_checks_" + std::to_string(::getpid()) + "_" + std::to_string(number) + ".ml");
        std::filesystem::remove(name);
    }
    return 0;
}
