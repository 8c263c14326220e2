// SPDX-License-Identifier: AGPL-3.0-or-later
// Grids of horizons and faults: the whole way to a GRDECL file against a bare to_chars pass over its corner depths, from 10^5 to 10^7
// cells, with peak memory; and the volumes of zones of real sealed models at three resolutions beside those of their regions.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <set>

#include "asked.h"
#include "base/parallel.h"
#include "formats/registry.h"
#include "gridding/build_grid.h"
#include "gridding/structure_of.h"
#include "peak_memory.h"
#include "pipeline/load.h"
#include "support/real_data.h"
#include "topology/brep_from_dataset.h"

namespace {

using namespace geomend;
using gridding::Point;

/// Three rolling horizons on maps of 20 m, torn by five faults that die out.
gridding::Structure rolling(double width) {
    gridding::Structure structure;
    const auto n = static_cast<std::uint32_t>(width / 20) + 1;
    for (int h = 0; h < 3; ++h) {
        gridding::HorizonMap map{{n, n}, {0, 0}, {Point{20, 0}, Point{0, 20}}, {}};
        for (std::uint32_t j = 0; j < n; ++j) {
            for (std::uint32_t i = 0; i < n; ++i)
                map.depths.push_back(2000 + 60 * std::sin(i / 45.0) + 40 * std::cos(j / 35.0) + 50 * h + 5 * std::sin(i / 20.0 + h));
        }
        structure.horizons.push_back({"h" + std::to_string(h), std::move(map)});
    }
    for (int f = 0; f < 5; ++f) {
        gridding::Fault fault{
            "F" + std::to_string(f), {{width * (0.15 + 0.15 * f), 0.2 * width}, {width * (0.1 + 0.18 * f), 0.8 * width}}, {}, {}, {}};
        structure.faults.push_back(std::move(fault));
    }
    return structure;
}

CornerPointGrid made_grid(std::uint32_t columns, std::uint32_t layers) {
    const double width = 10000;
    gridding::GridOptions options;
    options.zones.resize(2);
    for (auto& zone : options.zones) zone.count = layers / 2;
    const gridding::Frame frame{{0, 0}, 0, {columns, columns}, {width / columns, width / columns}};
    static const gridding::Structure structure = rolling(width);
    auto made = gridding::build_grid(structure, gridding::net_of(frame, 0, 1), options);
    if (!made) std::abort();
    return std::move(made->grid);
}

void write_grid(std::uint32_t columns, std::uint32_t layers) {
    Dataset dataset;
    dataset.format = "grid";
    dataset.objects.emplace_back(made_grid(columns, layers));
    OutputSet outputs(std::filesystem::temp_directory_path() / ("geomend-bench-" + std::to_string(::getpid()) + ".grdecl"));
    if (!format_by_name("grdecl")->write(dataset, outputs, {})) std::abort();
}

void bare_to_chars(const std::vector<double>& values) {
    std::array<char, 64> text{};
    std::size_t bytes = 0;
    for (const double v : values)
        bytes += static_cast<std::size_t>(std::to_chars(text.data(), text.data() + text.size(), v).ptr - text.data());
    benchmark::DoNotOptimize(bytes);
}

void print_speed(std::uint32_t columns, std::uint32_t layers, int rounds) {
    const ThreadBudget one_thread(1);
    std::vector<double> depths = made_grid(columns, layers).depths;
    const double cells = static_cast<double>(columns) * columns * layers;
    bench::Least own, other;
    for (int round = 0; round < rounds; ++round) other.take([&] { bare_to_chars(depths); });
    depths = {};
    for (int round = 0; round < rounds; ++round) own.take([&] { write_grid(columns, layers); });
    const std::string what = std::to_string(static_cast<std::uint64_t>(cells)) + " cells as GRDECL";
    bench::print_ratio(what.c_str(), 2.5, own, "to_chars of ZCORN", other);
    std::printf("%44s %.3f microseconds a cell; at the peak %.0f MB\n", "", 1e6 * own.cpu / cells, bench::status_bytes("VmHWM:") / 1e6);
}

/// The volume of the regions between two horizons: of those with sides on both.
double volume_between(const BrepData& brep, const std::string& upper, const std::string& lower) {
    double sum = 0;
    for (const auto& region : brep.regions) {
        std::set<std::string> names;
        for (const auto& side : region.sides) {
            const auto& surface = brep.surfaces[side.surface.value];
            names.insert(surface.interface_id.valid() ? brep.interfaces[surface.interface_id.value].name : surface.name);
        }
        if (names.contains(upper) && names.contains(lower)) sum += std::abs(region.volume);
    }
    return sum;
}

void print_volumes(const std::string& file, const std::string& path) {
    auto dataset = load(path, {});
    if (!dataset) return;
    const auto found = gridding::structure_of(*dataset, {});
    topology::build_breps(*dataset);
    if (!found || dataset->breps.empty()) return;
    const auto& horizons = found->structure.horizons;
    const auto box = gridding::box_around(found->outline, 0);
    std::printf("%s: volumes of zones beside those of regions\n%-24s", file.c_str(), "columns");
    for (std::size_t z = 0; z + 1 < horizons.size(); ++z) std::printf(" %26s", ("below " + horizons[z].name).c_str());
    std::printf("\n");
    for (const std::uint32_t n : {30u, 60u, 120u}) {
        gridding::GridOptions options;
        options.zones.resize(horizons.size() - 1);
        options.follow_faults = true;
        const gridding::Frame frame{box.origin, 0, {n, 2 * n / 3}, {box.size[0] / n, box.size[1] / (2 * n / 3)}};
        const auto made = gridding::build_grid(found->structure, gridding::net_of(frame, 0, 1), options);
        if (!made) return;
        std::printf("%-24s", (std::to_string(n) + " x " + std::to_string(2 * n / 3)).c_str());
        for (std::size_t z = 0; z + 1 < horizons.size(); ++z) {
            const double exact = volume_between(*dataset->breps.front(), horizons[z].name, horizons[z + 1].name);
            std::printf(" %14.6g (%+8.4f %%)", made->report.zones[z].volume, 100 * (made->report.zones[z].volume / exact - 1));
        }
        std::printf("\n");
    }
}

void print_asked() {
    print_speed(71, 20, 5);
    print_speed(224, 20, 3);
    print_speed(708, 20, 1);
    for (const char* file : {"gocad/modelA1.ml", "gocad/modelA4.ml"}) {
        if (const auto path = test::real_data(file)) print_volumes(file, path->string());
    }
}

void build_a_grid(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(made_grid(static_cast<std::uint32_t>(state.range(0)), 20));
}
BENCHMARK(build_a_grid)->Arg(71)->Arg(224)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

}  // namespace

int main(int argc, char** argv) { bench::run(argc, argv, print_asked); }
