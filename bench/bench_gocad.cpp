// SPDX-License-Identifier: AGPL-3.0-or-later
// How fast Gocad files are read and written, against a bare pass of from_chars (to_chars) over the same numbers on one
// thread in the same run. Figures to look at: the ratio of read to bare_from_chars, and the peak memory of a reading
// against the arrays that come out.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "asked.h"
#include "base/parallel.h"
#include "formats/gocad/read_gocad.h"
#include "formats/gocad/write_gocad.h"
#include "gocad_texts.h"
#include "peak_memory.h"

namespace {

using namespace geomend;

// A file on disk, so that reading maps it as in real life.
struct File {
    File(const std::string& text, const char* extension)
        : path((std::filesystem::temp_directory_path() / ("bench_gocad_" + std::to_string(::getpid()) + extension)).string()) {
        std::ofstream(path, std::ios::binary) << text;
    }
    ~File() { std::filesystem::remove(path); }
    std::string path;
};

const File& model() {
    static const File file(bench::synthetic_model(), ".ml");
    return file;
}
const File& solid() {
    static const File file(bench::synthetic_solid(), ".so");
    return file;
}

void report_bytes(benchmark::State& state, std::size_t bytes) {
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(bytes));
    state.counters["MB"] = static_cast<double>(bytes) / 1e6;
}

void bare_from_chars(benchmark::State& state, const File& (*file)()) {
    const auto input = Input::open(file().path);
    const std::string_view text = input->bytes();
    for (auto _ : state) bench::bare_from_chars(text);
    report_bytes(state, text.size());
}

void read(benchmark::State& state, const File& (*file)()) {
    std::size_t bytes = 0;
    Dataset kept;
    for (auto _ : state) {
        const auto input = Input::open(file().path);
        bytes = input->bytes().size();
        auto dataset = gocad::read_gocad(*input, {});
        if (!dataset) {
            state.SkipWithError(dataset.why().error.message.c_str());
            return;
        }
        kept = std::move(*dataset);
    }
    double cells = 0;
    for (const Object& object : kept.objects) {
        if (const auto* s = std::get_if<Surface>(&object)) cells += static_cast<double>(s->polygons.size());
        else cells += static_cast<double>(std::get<CellMesh>(object).cell_count());
    }
    state.counters["cells"] = cells;
    bench::report_memory(state, file().path, kept);
    report_bytes(state, bytes);
}

// What any writer must do at least: the digits of every number.
void bare_to_chars(benchmark::State& state) {
    const auto dataset = gocad::read_gocad(*Input::open(model().path), {});
    std::array<char, 64> text{};
    std::size_t bytes = 0;
    for (auto _ : state) {
        bytes = 0;
        for (const Object& object : dataset->objects) {
            const auto& s = std::get<Surface>(object);
            for (const Vec3& at : s.points) {
                for (const double x : at)
                    bytes += static_cast<std::size_t>(std::to_chars(text.data(), text.data() + 64, x).ptr - text.data());
            }
            for (const std::uint32_t c : s.polygons.corners) {
                bytes += static_cast<std::size_t>(std::to_chars(text.data(), text.data() + 64, c).ptr - text.data());
            }
        }
        benchmark::DoNotOptimize(bytes);
    }
    state.counters["MB"] = static_cast<double>(bytes) / 1e6;
}

void write_model(benchmark::State& state) {
    const auto dataset = gocad::read_gocad(*Input::open(model().path), {});
    for (auto _ : state) {
        OutputSet files(model().path + ".out");  // not committed: the speed of the disk's sync is not ours
        const auto losses = gocad::write_model3d(*dataset, files, {});
        if (!losses) state.SkipWithError("cannot write");
    }
}

BENCHMARK_CAPTURE(bare_from_chars, model, model)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK_CAPTURE(read, model, model)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK_CAPTURE(bare_from_chars, solid, solid)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK_CAPTURE(read, solid, solid)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(bare_to_chars)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(write_model)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void print_reading(const char* what, double asked, const File& file) {
    const ThreadBudget one_thread(1);
    const auto input = Input::open(file.path);
    bench::compare(
        what, asked, [&] { benchmark::DoNotOptimize(gocad::read_gocad(*input, {})); }, "bare from_chars",
        [&] { bench::bare_from_chars(input->bytes()); });
}

void print_asked() {
    print_reading("a TSolid is read", 2.0, solid());
    print_reading("a Model3d is read", 2.0, model());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 3 && std::strcmp(argv[1], "--peak") == 0)
        return bench::print_peak(argv[2], [](const Input& input) { return gocad::read_gocad(input, {}); });
    bench::run(argc, argv, print_asked);
}
