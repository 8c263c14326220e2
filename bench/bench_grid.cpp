// SPDX-License-Identifier: AGPL-3.0-or-later
// Volumes, connections and transmissibilities of a faulted corner-point grid: 200 x 200 x 250 cells, a fault every 20
// columns, leaning pillars. GEOMEND_BENCH_LAYERS sets another number of layers.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdlib>

#include "asked.h"
#include "grid/cell_geometry.h"
#include "grid/cell_mesh.h"
#include "grid/connections.h"
#include "grid/faces.h"
#include "grid/transmissibility.h"

namespace {

using namespace geomend;

// Layers of every other fault block dip the other way where edges are to cross off the pillars.
CornerPointGrid make_grid(bool crossing) {
    CornerPointGrid grid;
    const char* layers = std::getenv("GEOMEND_BENCH_LAYERS");
    grid.dims = {200, 200, static_cast<std::uint32_t>(layers != nullptr ? std::atoi(layers) : 250)};
    for (std::uint32_t j = 0; j <= grid.dims[1]; ++j) {
        for (std::uint32_t i = 0; i <= grid.dims[0]; ++i) {
            const double x = 50.0 * i, y = 50.0 * j;
            for (const double p : {x, y, 1500.0, x + 20 * std::sin(0.1 * j), y + 15, 2500.0}) grid.pillars.push_back(p);
        }
    }
    grid.depths.resize(8 * grid.cell_count());
    for (std::uint32_t k = 0; k < grid.dims[2]; ++k) {
        for (std::uint32_t j = 0; j < grid.dims[1]; ++j) {
            for (std::uint32_t i = 0; i < grid.dims[0]; ++i) {
                for (unsigned c = 0; c < 8; ++c) {
                    const double x = i + (c & 1u), y = j + ((c >> 1) & 1u);
                    grid.depths[corner_index(grid.dims, i, j, k, c)] =
                        1500 + 2.0 * (k + (c >> 2)) + 30 * std::sin(0.03 * x) + 0.2 * y + 7.3 * (i / 20) +
                        (crossing && (i / 20) % 2 == 1 ? 1.3 * (j % 5 + ((c >> 1) & 1u)) - 0.8 * y : 0.0);
                }
            }
        }
    }
    Attribute permeability;
    permeability.name = "PERMX";
    permeability.location = AttributeLocation::cell;
    permeability.values = std::vector<double>(grid.cell_count(), 100.0);
    grid.info.attributes.push_back(std::move(permeability));
    return grid;
}

const CornerPointGrid& faulted() {
    static const CornerPointGrid grid = make_grid(false);
    return grid;
}

void tell(benchmark::State& state) {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    state.counters["cells"] = double(faulted().cell_count());
    state.counters["peak_MB_so_far"] = double(usage.ru_maxrss) / 1024;
}

void volumes(benchmark::State& state) {
    const CornerPointGrid& grid = faulted();
    for (auto _ : state) benchmark::DoNotOptimize(grid::cell_volumes(grid));
    tell(state);
}
BENCHMARK(volumes)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void connections(benchmark::State& state) {
    const CornerPointGrid& grid = faulted();
    for (auto _ : state) {
        const grid::Connections found = grid::connections(grid);
        state.counters["nnc"] = double(found.others.size());
    }
    tell(state);
}
BENCHMARK(connections)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void transmissibilities(benchmark::State& state) {
    const CornerPointGrid& grid = faulted();
    const grid::Connections found = grid::connections(grid);
    for (auto _ : state) benchmark::DoNotOptimize(grid::transmissibilities(grid, found));
    tell(state);
}
BENCHMARK(transmissibilities)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void faces(benchmark::State& state) {
    const CornerPointGrid& grid = faulted();
    for (auto _ : state) benchmark::DoNotOptimize(grid::conforming_faces(grid));
    tell(state);
}
BENCHMARK(faces)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void faces_with_crossings(benchmark::State& state) {
    const CornerPointGrid grid = make_grid(true);
    for (auto _ : state) {
        const grid::GridFaces found = grid::conforming_faces(grid);
        state.counters["faces"] = double(found.faces.size());
        state.counters["points"] = double(found.points.size());
    }
    tell(state);
}
BENCHMARK(faces_with_crossings)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void polyhedra(benchmark::State& state) {
    for (auto _ : state) {
        state.PauseTiming();
        CornerPointGrid grid = make_grid(false);
        state.ResumeTiming();
        const grid::Cells cells = grid::take_conforming_cells(grid);
        state.counters["cells"] = double(cells.mesh.cell_count());
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    state.counters["peak_MB_so_far"] = double(usage.ru_maxrss) / 1024;
}
BENCHMARK(polyhedra)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

double peak_megabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) / 1024;
}

// First the polyhedra, so that the peak is theirs.
void print_asked() {
    bench::Least polyhedra, transmissibilities;
    for (int round = 0; round < 2; ++round) {
        CornerPointGrid grid = make_grid(false);
        polyhedra.take([&] { benchmark::DoNotOptimize(grid::take_conforming_cells(grid)); });
    }
    bench::print_figure("10 M cells: conforming polyhedra", 12, polyhedra.cpu, "s of processor");
    bench::print_figure("10 M cells: conforming polyhedra", 12, polyhedra.wall, "s on the wall");
    bench::print_figure("10 M cells: peak of conforming polyhedra", 3, peak_megabytes() / 1000, "GB, the grid included");
    const grid::Connections found = grid::connections(faulted());
    for (int round = 0; round < 5; ++round)
        transmissibilities.take([&] { benchmark::DoNotOptimize(grid::transmissibilities(faulted(), found)); });
    bench::print_figure("10 M cells: transmissibilities", 2, transmissibilities.cpu, "s of processor");
    bench::print_figure("10 M cells: transmissibilities", 2, transmissibilities.wall, "s on the wall");
}

}  // namespace

int main(int argc, char** argv) { bench::run(argc, argv, print_asked); }
