// SPDX-License-Identifier: AGPL-3.0-or-later
// Reading and writing EGRID against a plain copy of the file. The number of cells is 250 x 200 x 200 = 10 million, or
// what GEOMEND_BENCH_CELLS says in millions.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "asked.h"
#include "base/parallel.h"
#include "formats/eclipse/read_egrid.h"
#include "formats/eclipse/write_eclipse.h"

namespace {

using namespace geomend;

std::uint32_t layers() {
    const char* millions = std::getenv("GEOMEND_BENCH_CELLS");
    const double cells = (millions != nullptr ? std::atof(millions) : 10.0) * 1e6;
    return std::max(1u, static_cast<std::uint32_t>(cells / (250 * 200)));
}

// Layers with two faults and folds.
CornerPointGrid faulted() {
    CornerPointGrid grid;
    grid.dims = {250, 200, layers()};
    grid.info.precision = CoordinatePrecision::single_precision;
    grid.info.name = "bench";
    grid.info.crs.z_positive = ZPositive::depth;
    for (std::uint32_t j = 0; j <= grid.dims[1]; ++j) {
        for (std::uint32_t i = 0; i <= grid.dims[0]; ++i) {
            const double x = 50.0 * i, y = 50.0 * j;
            grid.pillars.insert(grid.pillars.end(), {x, y, 1000, x + 16, y - 8, 4072});
        }
    }
    grid.depths.resize(8 * grid.cell_count());
    parallel_blocks(grid.dims[2], 1, [&](std::size_t from, std::size_t to) {
        for (std::size_t k = from; k != to; ++k) {
            for (std::uint32_t j = 0; j < grid.dims[1]; ++j) {
                for (std::uint32_t i = 0; i < grid.dims[0]; ++i) {
                    const double throws = (i >= 90 ? 24.5 : 0) + (j >= 120 ? -12.25 : 0);
                    for (unsigned c = 0; c < 8; ++c) {
                        const double pi = i + (c & 1u), pj = j + (c >> 1 & 1u), pk = static_cast<double>(k + (c >> 2));
                        grid.depths[corner_index(grid.dims, i, j, k, c)] = 1500 + 2 * pk + 0.25 * pi + 0.125 * pj + throws;
                    }
                }
            }
        }
    });
    grid.activity.assign(grid.cell_count(), 1);
    for (std::size_t c = 0; c < grid.cell_count(); c += 17) grid.activity[c] = 0;
    return grid;
}

const std::filesystem::path& path() {
    static const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("bench_eclipse_" + std::to_string(::getpid()) + ".EGRID");
    return file;
}

std::int64_t file_size() { return static_cast<std::int64_t>(std::filesystem::file_size(path())); }

double status_bytes(const std::string& key) {
    std::ifstream status("/proc/self/status");
    std::string word;
    double value = 0;
    while (status >> word) {
        if (word == key) status >> value;
    }
    return 1024 * value;
}

// What a copying program does: read a block, write a block, to the end of the file. Through memory the block is the file.
bool copy_file(std::size_t block_size) {
    const std::filesystem::path to = path().string() + ".copy";
    const std::unique_ptr<char[]> block(new char[block_size]);  // not touched before it is read into
    const int in = ::open(path().c_str(), O_RDONLY), out = ::open(to.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ssize_t n = 0;
    bool good = in >= 0 && out >= 0;
    while (good && (n = ::read(in, block.get(), block_size)) > 0) good = ::write(out, block.get(), static_cast<std::size_t>(n)) == n;
    ::close(in);
    ::close(out);
    std::filesystem::remove(to);
    return good && n == 0;
}

// What `cp` does: the system copies, and the program sees nothing of it.
void copy_by_system() {
    const std::filesystem::path to = path().string() + ".copy";
    std::filesystem::copy_file(path(), to, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::remove(to);
}

constexpr std::size_t small_block = std::size_t{1} << 18;

void plain_copy(benchmark::State& state) {
    for (auto _ : state) {
        if (!copy_file(small_block)) state.SkipWithError("cannot copy");
    }
    state.SetBytesProcessed(state.iterations() * file_size());
}

void read_whole(benchmark::State& state) {
    double peak = 0, arrays = 0;
    for (auto _ : state) {
        std::ofstream("/proc/self/clear_refs") << 5;
        const double before = status_bytes("VmRSS:");
        const auto input = Input::open(path().string());
        const auto data = eclipse::read_egrid(*input, {});
        if (!data) {
            state.SkipWithError(data.why().error.message.c_str());
            return;
        }
        state.PauseTiming();
        const auto& grid = std::get<CornerPointGrid>(data->objects[0]);
        arrays = 8.0 * static_cast<double>(grid.pillars.size() + grid.depths.size()) + static_cast<double>(grid.activity.size());
        // Pages of the mapped file count as resident, but can be dropped at any time.
        peak = status_bytes("VmHWM:") - before - static_cast<double>(input->bytes().size());
        state.ResumeTiming();
    }
    state.counters["peak_per_arrays"] = peak / arrays;
    state.counters["array_MB"] = arrays / 1e6;
    state.SetBytesProcessed(state.iterations() * file_size());
}

void write_whole(benchmark::State& state) {
    const auto data = eclipse::read_egrid(*Input::open(path().string()), {});
    for (auto _ : state) {
        OutputSet out(path().string() + ".written");
        if (!eclipse::write_egrid(*data, out, {})) state.SkipWithError("cannot write");
    }
    state.SetBytesProcessed(state.iterations() * file_size());
}

BENCHMARK(plain_copy)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(read_whole)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(write_whole)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void print_asked() {
    const auto read = [] { benchmark::DoNotOptimize(eclipse::read_egrid(*Input::open(path().string()), {})); };
    bench::Least reading, writing, by_system, by_blocks, through_memory;
    const auto data = eclipse::read_egrid(*Input::open(path().string()), {});
    for (int round = 0; round < 7; ++round) {
        by_system.take(copy_by_system);
        by_blocks.take([] { copy_file(small_block); });
        reading.take(read);
        through_memory.take([] { copy_file(static_cast<std::size_t>(file_size())); });
        writing.take([&] {
            OutputSet out(path().string() + ".written");
            benchmark::DoNotOptimize(eclipse::write_egrid(*data, out, {}));
        });
    }
    bench::print_ratio("a whole EGRID is read", 2.0, reading, "copy by the system", by_system);
    bench::print_ratio("a whole EGRID is read", 2.0, reading, "copy through memory", through_memory);
    bench::print_ratio("a whole EGRID is read", 2.0, reading, "copy by blocks of 256 KiB", by_blocks);
    bench::print_ratio("a whole EGRID is written", 2.0, writing, "copy by the system", by_system);
    bench::print_ratio("a whole EGRID is written", 2.0, writing, "copy through memory", through_memory);
    bench::print_ratio("a whole EGRID is written", 2.0, writing, "copy by blocks of 256 KiB", by_blocks);
}

}  // namespace

int main(int argc, char** argv) {
    {
        Dataset data;
        data.objects.emplace_back(faulted());
        OutputSet out(path());
        if (!eclipse::write_egrid(data, out, {}) || !out.commit()) return 1;
    }
    bench::run(argc, argv, print_asked);
    std::filesystem::remove(path());
}
