// SPDX-License-Identifier: AGPL-3.0-or-later
// Reading and writing GRDECL against bare from_chars and to_chars over the same numbers. The grid is faulted, with
// leaning pillars: 1.2 million cells, 90 MB of text; GEOMEND_BENCH_CELLS asks for another size.
#include <benchmark/benchmark.h>
#include <sys/resource.h>
#include <unistd.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "asked.h"
#include "base/parallel.h"
#include "formats/grdecl/grdecl.h"

namespace {

using namespace geomend;

std::uint64_t wanted_cells() {
    const char* text = std::getenv("GEOMEND_BENCH_CELLS");
    const std::uint64_t cells = text == nullptr ? 0 : std::strtoull(text, nullptr, 10);
    return cells == 0 ? 1'200'000 : cells;
}

double rounded(double x) { return std::round(x * 1000) / 1000; }

/// Depth of a layer's surface: it rolls, and columns beyond each of three faults are thrown down.
double depth_of(std::uint32_t column, double x, double y, std::uint32_t layer, std::uint32_t nx) {
    const double thrown = 12.5 * (column * 4 / nx);
    return rounded(2000 + 40 * std::sin(x / 900) + 25 * std::cos(y / 700) + thrown + 3.2 * layer);
}

Dataset make_grid() {
    CornerPointGrid g;
    g.info.name = "bench";
    const auto side = static_cast<std::uint32_t>(std::max(2.0, std::sqrt(static_cast<double>(wanted_cells()) / 50)));
    g.dims = {side, side, 50};
    for (std::uint32_t j = 0; j <= side; ++j) {
        for (std::uint32_t i = 0; i <= side; ++i) {
            const double x = 458000 + 25.0 * i + std::sin(j), y = 5931000 + 25.0 * j + std::cos(i);
            for (const double v : {x, y, 1900.0, x + 12, y - 7, 2600.0}) g.pillars.push_back(rounded(v));
        }
    }
    g.depths.resize(8 * g.cell_count());
    for (std::uint32_t k = 0; k < g.dims[2]; ++k) {
        for (std::uint32_t j = 0; j < side; ++j) {
            for (std::uint32_t i = 0; i < side; ++i) {
                for (unsigned c = 0; c < 8; ++c)
                    g.depths[corner_index(g.dims, i, j, k, c)] =
                        depth_of(i, 25.0 * (i + (c & 1u)), 25.0 * (j + ((c >> 1) & 1u)), k + (c >> 2), side);
            }
        }
    }
    g.activity.assign(g.cell_count(), 1);
    for (std::size_t cell = 0; cell < g.activity.size(); cell += 17) g.activity[cell] = 0;
    Attribute porosity;
    porosity.name = "PORO";
    porosity.location = AttributeLocation::cell;
    std::vector<double> values(g.cell_count());
    for (std::size_t cell = 0; cell < values.size(); ++cell)
        values[cell] = std::round(1e6 * (0.2 + 0.1 * std::sin(static_cast<double>(cell)))) / 1e6;
    porosity.values = std::move(values);
    g.info.attributes.push_back(std::move(porosity));
    Dataset dataset;
    dataset.objects.emplace_back(std::move(g));
    return dataset;
}

const Format& row() { return grdecl::formats().front(); }

std::filesystem::path temporary(const char* name) {
    return std::filesystem::temp_directory_path() / ("geomend-bench-" + std::to_string(::getpid()) + name);
}

struct File {
    File() : path(temporary(".grdecl")) {
        OutputSet outputs(path);
        if (!row().write(make_grid(), outputs, {}) || !outputs.commit()) std::abort();
        input = *Input::open(path.string());
    }
    ~File() { std::filesystem::remove(path); }
    std::filesystem::path path;
    Input input;
};

const File& file() {
    static const File made;
    return made;
}

void report(benchmark::State& state) {
    const std::size_t bytes = file().input.bytes().size();
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(bytes));
    state.counters["MB"] = static_cast<double>(bytes) / 1e6;
    struct rusage usage {};
    ::getrusage(RUSAGE_SELF, &usage);
    state.counters["peak_MB"] = static_cast<double>(usage.ru_maxrss) / 1e3;
}

// What any reader must do at least: turn every number of the text into a double, on one thread.
void bare_from_chars(benchmark::State& state) {
    const std::string_view bytes = file().input.bytes();
    for (auto _ : state) bench::bare_from_chars(bytes);
    report(state);
}

void read(benchmark::State& state) {
    const ThreadBudget budget(static_cast<std::size_t>(state.range(0)));
    for (auto _ : state) {
        auto dataset = row().read(file().input, {});
        if (!dataset) state.SkipWithError("cannot be read");
        benchmark::DoNotOptimize(dataset);
    }
    report(state);
}

void write(benchmark::State& state) {
    const ThreadBudget budget(static_cast<std::size_t>(state.range(0)));
    const auto dataset = row().read(file().input, {});
    if (!dataset) return state.SkipWithError("cannot be read");
    for (auto _ : state) {
        OutputSet outputs(temporary(".out.grdecl"));  // not committed: the speed of the disk's sync is not ours
        auto losses = row().write(*dataset, outputs, {});
        benchmark::DoNotOptimize(losses);
    }
    report(state);
}

BENCHMARK(bare_from_chars)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(read)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(write)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void print_asked() {
    const ThreadBudget one_thread(1);
    bench::compare(
        "a GRDECL grid is read", 2.0, [] { benchmark::DoNotOptimize(row().read(file().input, {})); }, "bare from_chars",
        [] { bench::bare_from_chars(file().input.bytes()); });
}

}  // namespace

int main(int argc, char** argv) { bench::run(argc, argv, print_asked); }
