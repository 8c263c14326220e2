// SPDX-License-Identifier: AGPL-3.0-or-later
// Reading and writing MSH against bare from_chars and to_chars over the same numbers. The mesh is a box of cubes, six
// tetrahedra each, with its boundary triangles: 590,000 tetrahedra, 30 MB of text.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>

#include "base/parallel.h"
#include "formats/gmsh/read_msh.h"
#include "formats/gmsh/write_msh.h"
#include "peak_memory.h"

namespace {

using namespace geomend;

constexpr std::uint32_t cells_per_side = 46;  // 46^3 * 6 = 584016 tetrahedra

Dataset make_box() {
    CellMesh mesh;
    mesh.info.name = "box";
    const std::uint32_t n = cells_per_side + 1;
    for (std::uint32_t k = 0; k < n; ++k) {
        for (std::uint32_t j = 0; j < n; ++j) {
            for (std::uint32_t i = 0; i < n; ++i) {
                mesh.points.push_back(
                    {451234.5 + i * 17.3 + std::sin(j), 5901234.25 + j * 13.7 + std::cos(k), -1234.5 + k * 7.1 + std::sin(i)});
            }
        }
    }
    const auto at = [n](std::uint32_t i, std::uint32_t j, std::uint32_t k) { return (k * n + j) * n + i; };
    mesh.entities = {{.dimension = 3, .tag = 1, .name = "lower", .role = {}, .role_text = {}, .boundary = {}, .groups = {}, .bounds = {}},
                     {.dimension = 3, .tag = 2, .name = "upper", .role = {}, .role_text = {}, .boundary = {}, .groups = {}, .bounds = {}}};
    constexpr std::uint8_t six[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
    for (std::uint32_t k = 0; k < cells_per_side; ++k) {
        for (std::uint32_t j = 0; j < cells_per_side; ++j) {
            for (std::uint32_t i = 0; i < cells_per_side; ++i) {
                for (const auto& t : six) {
                    std::array<std::uint32_t, 4> nodes{};
                    for (std::size_t c = 0; c < 4; ++c) nodes[c] = at(i + (t[c] & 1u), j + ((t[c] >> 1) & 1u), k + (t[c] >> 2));
                    mesh.add_cell(CellType::tetrahedron, nodes);
                    mesh.cell_entity.push_back(k < cells_per_side / 2 ? 0 : 1);
                }
            }
        }
    }
    Dataset dataset;
    dataset.objects.emplace_back(std::move(mesh));
    return dataset;
}

const Dataset& box() {
    static const Dataset dataset = make_box();
    return dataset;
}

std::string write_to(const std::string& name, const FormatOptions& options) {
    const std::string path = (std::filesystem::temp_directory_path() / ("geomend-bench-" + std::to_string(::getpid()) + name)).string();
    OutputSet outputs(path);
    WriteOptions write_options;
    write_options.options = options;
    if (!gmsh::write_msh(box(), outputs, write_options) || !outputs.commit()) std::abort();
    return path;
}

struct File {
    explicit File(const FormatOptions& options, const std::string& name) : path(write_to(name, options)), input(*Input::open(path)) {}
    ~File() { std::filesystem::remove(path); }
    std::string path;
    Input input;
};

const File& file_of(const std::string& version, bool binary) {
    static const File files[4] = {File({{"version", "2.2"}}, "22.msh"), File({{"version", "4.1"}}, "41.msh"),
                                  File({{"version", "2.2"}, {"binary", "yes"}}, "22b.msh"),
                                  File({{"version", "4.1"}, {"binary", "yes"}}, "41b.msh")};
    return files[(binary ? 2 : 0) + (version == "4.1" ? 1 : 0)];
}

void report_bytes(benchmark::State& state, std::size_t bytes) {
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(bytes));
    state.counters["MB"] = static_cast<double>(bytes) / 1e6;
}

// What any reader must do at least: turn every number of the text into a double, on one thread.
void bare_from_chars(benchmark::State& state, const std::string& version) {
    const std::string_view bytes = file_of(version, false).input.bytes();
    for (auto _ : state) {
        double sum = 0;
        const char* p = bytes.data();
        const char* end = p + bytes.size();
        while (p != end) {
            double value = 0;
            const auto [stop, error] = std::from_chars(p, end, value);
            sum += value;
            p = error == std::errc{} ? stop : p + 1;
            while (p != end && (*p == ' ' || *p == '\n')) ++p;
        }
        benchmark::DoNotOptimize(sum);
    }
    report_bytes(state, bytes.size());
}

void memchr_pass(benchmark::State& state) {
    const std::string_view bytes = file_of("2.2", false).input.bytes();
    for (auto _ : state) {
        std::size_t lines = 0;
        for (const char* p = bytes.data();
             (p = static_cast<const char*>(std::memchr(p, '\n', static_cast<std::size_t>(bytes.data() + bytes.size() - p)))) != nullptr;
             ++p)
            ++lines;
        benchmark::DoNotOptimize(lines);
    }
    report_bytes(state, bytes.size());
}

void read(benchmark::State& state, const std::string& version, bool binary) {
    const File& file = file_of(version, binary);
    const ThreadBudget budget(static_cast<std::size_t>(state.range(0)));
    Dataset kept;
    for (auto _ : state) {
        auto dataset = gmsh::read_msh(file.input, {});
        if (!dataset) {
            state.SkipWithError("cannot be read");
            return;
        }
        kept = std::move(*dataset);
    }
    bench::report_memory(state, file.path, kept);
    report_bytes(state, file.input.bytes().size());
}

// What any writer must do at least: the digits of every number, on one thread.
void bare_to_chars(benchmark::State& state) {
    const auto& mesh = std::get<CellMesh>(box().objects.front());
    std::string text(std::size_t{1} << 26, '\0');
    for (auto _ : state) {
        char* p = text.data();
        char* end = p + text.size();
        for (std::size_t i = 0; i < mesh.points.size(); ++i) {
            p = std::to_chars(p, end, i + 1).ptr;
            for (const double x : mesh.points[i]) {
                *p++ = ' ';
                p = std::to_chars(p, end, x).ptr;
            }
            *p++ = '\n';
        }
        for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
            p = std::to_chars(p, end, i + 1).ptr;
            for (const std::uint32_t n : mesh.cell_nodes(i)) {
                *p++ = ' ';
                p = std::to_chars(p, end, n + 1).ptr;
            }
            *p++ = '\n';
        }
        benchmark::DoNotOptimize(p);
    }
    report_bytes(state, file_of("4.1", false).input.bytes().size());
}

void write(benchmark::State& state, const std::string& version) {
    const ThreadBudget budget(static_cast<std::size_t>(state.range(0)));
    const auto path = std::filesystem::temp_directory_path() / ("geomend-bench-" + std::to_string(::getpid()) + ".out.msh");
    WriteOptions options;
    options.options = {{"version", version}};
    for (auto _ : state) {
        OutputSet outputs(path);  // not committed: the speed of the disk's sync is not ours
        auto losses = gmsh::write_msh(box(), outputs, options);
        benchmark::DoNotOptimize(losses);
    }
    report_bytes(state, file_of(version, false).input.bytes().size());
}

BENCHMARK(memchr_pass)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(bare_from_chars, msh22, "2.2")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(bare_from_chars, msh41, "4.1")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(read, msh22, "2.2", false)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(read, msh41, "4.1", false)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(read, msh22_binary, "2.2", true)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(read, msh41_binary, "4.1", true)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(bare_to_chars)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(write, msh22, "2.2")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(write, msh41, "4.1")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

int main(int argc, char** argv) {
    if (argc == 3 && std::strcmp(argv[1], "--peak") == 0)
        return bench::print_peak(argv[2], [](const Input& input) { return gmsh::read_msh(input, {}); });
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
