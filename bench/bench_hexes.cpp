// SPDX-License-Identifier: AGPL-3.0-or-later
// Hexahedra of tetrahedra: the search for candidates by candidate; what the local search selects against the greedy choice by quality,
// by volume, in ten seconds of one thread. A mesh of tetrahedra may be given; else they are real ones, where they are at hand: one as it
// is, and a model with its surfaces as they are, filled with the points of a lattice.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "asked.h"
#include "base/parallel.h"
#include "geometry/cell_volume.h"
#include "hexes/local_search.h"
#include "hexes/recombine.h"
#include "pipeline/load.h"
#include "pipeline/mesh.h"
#include "pipeline/mesh_output.h"
#include "support/real_data.h"
#include "support/temporary_folder.h"

namespace {

using namespace geomend;
using hexes::Candidates;

Result<VolumeMesh> mesh_in(const std::string& file) {
    LoadOptions options;
    auto dataset = load(file, options);
    if (!dataset) return std::move(dataset).why();
    std::vector<Loss> losses;
    return volume_mesh_in(*dataset, losses);
}

double volume_of(const Candidates& all, const std::vector<std::uint32_t>& selected) {
    double sum = 0;
    for (const std::uint32_t i : selected) sum += all.volume[i];
    return sum;
}

/// Tetrahedra between the points of a lattice in a model, as a file.
bool write_lattice(const std::string& model, double size, const std::string& file) {
    MeshRequest request;
    request.files.inputs = {model};
    request.files.output = file;
    request.files.lossy = true;
    request.fill.size = size;
    request.on_lattice = true;
    request.fill.limits.program = {GEOMEND_PROGRAM};
    const auto made = mesh(request);
    return made && made->is_written;
}

void ask(const std::string& file, double quality, double asked_gain) {
    const auto mesh = mesh_in(file);
    if (!mesh) {
        std::printf("%s: cannot be read\n", file.c_str());
        return;
    }
    const ThreadBudget one(1);
    bench::Least setup, search, greedy_time, local_time;
    hexes::TetMesh tets;
    Candidates all;
    setup.take([&] { tets = hexes::tet_mesh_of(*mesh); });
    search.take([&] { all = hexes::find_hexahedra(tets, hexes::QuadTable(tets, quality), {quality, {}, nullptr}); });
    double whole = 0;
    for (const auto& t : tets.tets)
        whole += tetrahedron_volume(tets.positions[t[0]], tets.positions[t[1]], tets.positions[t[2]], tets.positions[t[3]]);
    std::printf("%s, q >= %.1f: %zu tetrahedra (%.2f s), %zu candidates\n", file.c_str(), quality, tets.tets.size(), setup.cpu, all.size());
    bench::print_figure("candidate search, microseconds each", 10, 1e6 * search.cpu / static_cast<double>(all.size()), "");
    const hexes::Conflicts conflicts(all, tets.tets.size());
    std::vector<std::uint32_t> greedy, local;
    greedy_time.take([&] { greedy = hexes::select_greedily(conflicts, all.quality, hexes::Greedy::weight); });
    std::vector<double> weights(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) weights[i] = all.volume[i] * (2 + all.quality[i]);
    hexes::LocalSearch how;
    how.steps = std::min<std::uint64_t>(2000 * all.size(), 120'000'000);
    local_time.take([&] { local = hexes::search_selection(conflicts, weights, greedy, how); });
    std::printf("  greedy by quality: %.2f %% of the volume (%.2f s); local search, %llu steps: %.2f %% (%.2f s)\n",
                100 * volume_of(all, greedy) / whole, greedy_time.cpu, static_cast<unsigned long long>(how.steps),
                100 * volume_of(all, local) / whole, local_time.cpu);
    bench::print_figure("local search by greedy, volume", asked_gain, volume_of(all, local) / volume_of(all, greedy), "x");
    bench::print_figure("seconds of the local search", 10, local_time.cpu, "");
}

}  // namespace

int main(int argc, char** argv) {
    const std::string given = argc > 2 ? argv[2] : "";
    if (argc > 2) argc = 2;
    bench::run(argc, argv, [&] {
        if (!given.empty()) return ask(given, 0.5, 1.07);
        if (const auto file = test::real_data("gocad/modelA4.so")) ask(file->string(), 0.3, 1.40);
        if (const auto model = test::real_data("ringmesh/corbieres.gm")) {
            const test::TemporaryFolder folder;
            const std::string lattice = folder / "corbieres_50m.vtu";
            if (write_lattice(model->string(), 50, lattice)) ask(lattice, 0.5, 1.07);
        }
    });
}
