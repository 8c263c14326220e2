// SPDX-License-Identifier: AGPL-3.0-or-later
// `info` on copies of a real model in one Model3d (16: 62 MB, 782,000 triangles), boundary representation included, against a
// bare pass of from_chars over the same bytes in the same run, on one thread. Figures to look at: `ratio`, in CPU time, at most
// 4.5 for 16 copies; and `ns_per_triangle`, which does not depend on the number of copies.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <map>

#include "asked.h"
#include "base/parallel.h"
#include "formats/gocad/write_gocad.h"
#include "model_copies.h"
#include "pipeline/info.h"
#include "pipeline/load.h"
#include "support/real_data.h"

namespace {

using namespace geomend;

/// A file of some copies, on disk until the program ends; empty where there is no real data.
struct File {
    std::string path;
    std::size_t triangles = 0;
    ~File() {
        std::error_code ignored;
        if (!path.empty()) std::filesystem::remove(path, ignored);
    }
};

const File& file_of(std::uint32_t copies) {
    static std::map<std::uint32_t, File> files;
    const auto [at, is_new] = files.try_emplace(copies);
    File& file = at->second;
    if (!is_new) return file;
    const auto real = test::real_data("gocad/modelA4.ml");
    if (!real) return file;
    const auto one = load(real->string(), {});
    if (!one) return file;
    const Dataset all = bench::copies_of(*one, copies, 20000);
    for (const Object& object : all.objects) file.triangles += std::get<Surface>(object).polygons.size();
    const auto name =
        std::filesystem::temp_directory_path() / ("bench_brep_" + std::to_string(::getpid()) + "_" + std::to_string(copies) + ".ml");
    OutputSet out(name);
    if (gocad::write_model3d(all, out, {}) && out.commit()) file.path = name.string();
    return file;
}

/// Processor seconds of a bare pass.
double bare_pass(const std::string& path) {
    const auto input = Input::open(path);
    bench::Least least;
    for (int round = 0; round < 3; ++round) least.take([&] { bench::bare_from_chars(input->bytes()); });
    return least.cpu;
}

void info(benchmark::State& state) {
    const File& file = file_of(static_cast<std::uint32_t>(state.range(0)));
    if (file.path.empty()) return state.SkipWithError("no real data");
    const ThreadBudget budget(static_cast<std::size_t>(state.range(1)));
    const double bare = bare_pass(file.path);
    bench::Least least;
    for (auto _ : state) {
        least.take([&] {
            if (summarise(file.path, LoadOptions{}).breps.size() != 1) state.SkipWithError("no boundary representation");
        });
    }
    state.counters["ratio"] = least.cpu / bare;
    state.counters["ns_per_triangle"] = 1e9 * least.cpu / static_cast<double>(file.triangles);
}

void print_asked() {
    const File& file = file_of(16);
    if (file.path.empty()) return static_cast<void>(std::printf("info on 16 copies of a model: no real data\n"));
    const ThreadBudget one_thread(1);
    const auto input = Input::open(file.path);
    bench::compare(
        "info on 16 copies of a model, one thread", 4.5, [&] { benchmark::DoNotOptimize(summarise(file.path, LoadOptions{})); },
        "bare from_chars", [&] { bench::bare_from_chars(input->bytes()); });
}

}  // namespace

BENCHMARK(info)
    ->ArgNames({"copies", "threads"})
    ->Args({1, 1})
    ->Args({16, 1})
    ->Args({64, 1})
    ->Args({16, 2})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

int main(int argc, char** argv) { bench::run(argc, argv, print_asked); }
