// SPDX-License-Identifier: AGPL-3.0-or-later
// All checks of a Model3d of 782,000 triangles, 880 surfaces and 128 regions (sixteen copies of a real model, where the real
// data is at hand), reading included, against CGAL's sequential self_intersections on the same triangles in the same run.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "asked.h"
#include "base/parallel.h"
#include "formats/gocad/write_gocad.h"
#include "model_copies.h"
#include "peak_memory.h"
#include "pipeline/validate.h"
#include "support/real_data.h"
#include "topology/brep_from_dataset.h"
#ifdef GEOMEND_WITH_CGAL
#include "cgal_intersections.h"
#endif

namespace {

using namespace geomend;

/// The file that is checked, on disk; empty where there is no real data.
const std::string& model_file() {
    static const std::string path = [] {
        const auto real = test::real_data("gocad/modelA4.ml");
        if (!real) return std::string();
        const auto one = load(real->string(), {});
        if (!one) return std::string();
        const auto name = std::filesystem::temp_directory_path() / ("bench_checks_" + std::to_string(::getpid()) + ".ml");
        OutputSet files(name);
        if (!gocad::write_model3d(bench::copies_of(*one, 16, 20000), files, {}) || !files.commit()) return std::string();
        return name.string();
    }();
    return path;
}

void all_checks(benchmark::State& state) {
    const std::string& path = model_file();
    if (path.empty()) return state.SkipWithError("no real data");
    const ThreadBudget budget(static_cast<std::size_t>(state.range(0)));
    std::size_t findings = 0;
    for (auto _ : state) {
        const auto file = validate(path, LoadOptions{}, validators::CheckOptions{});
        findings = file ? file->findings.size() : 0;
    }
    state.counters["findings"] = static_cast<double>(findings);
    state.counters["peak_MB"] = bench::status_bytes("VmHWM:") / 1e6;
}

#ifdef GEOMEND_WITH_CGAL
/// The triangles of the file as CGAL has them.
bench::CgalMesh cgal_mesh() {
    const auto data = load(model_file(), {});
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

void cgal_self_intersections(benchmark::State& state) {
    if (model_file().empty()) return state.SkipWithError("no real data");
    const bench::CgalMesh mesh = cgal_mesh();
    std::size_t pairs = 0;
    for (auto _ : state) pairs = mesh.self_intersections().size();
    state.counters["pairs"] = static_cast<double>(pairs);
}
#endif

void print_asked() {
    if (model_file().empty()) return static_cast<void>(std::printf("all checks on 16 copies of a model: no real data\n"));
#ifdef GEOMEND_WITH_CGAL
    const ThreadBudget one_thread(1);
    const bench::CgalMesh mesh = cgal_mesh();
    bench::compare(
        "all checks on 16 copies, reading included", 0.5,
        [] { benchmark::DoNotOptimize(validate(model_file(), LoadOptions{}, validators::CheckOptions{})); },
        "CGAL's self_intersections, one thread", [&] { benchmark::DoNotOptimize(mesh.self_intersections()); }, 2);
#else
    std::printf("all checks on 16 copies of a model: CGAL is not installed\n");
#endif
}

}  // namespace

BENCHMARK(all_checks)->Unit(benchmark::kMillisecond)->UseRealTime()->Arg(1)->Arg(2);
#ifdef GEOMEND_WITH_CGAL
BENCHMARK(cgal_self_intersections)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);
#endif

int main(int argc, char** argv) {
    bench::run(argc, argv, print_asked);
    if (!model_file().empty()) std::filesystem::remove(model_file());
    return 0;
}
