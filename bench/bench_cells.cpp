// SPDX-License-Identifier: AGPL-3.0-or-later
// Checks of meshes of a million cells: cells in each other (M29, asked: at most 3 s of processor), faces that lie on each other
// (M24, M36) with regions in parts (M37), each as processor seconds of all threads and as a ratio to a bare pass, which sums the
// volumes of all cells. What every check needs (lengths, faces) is taken off: it is the run of a check that looks at nodes only (M22).
#include <benchmark/benchmark.h>

#include <array>
#include <cstdio>
#include <string>

#include "asked.h"
#include "geometry/cell_volume.h"
#include "validators/registry.h"

namespace {

using namespace geomend;

using Nodes = std::vector<std::uint32_t>;

/// n x n x n cubes, each one hexahedron or six tetrahedra. \param at where a node of the lattice is
template <class Place>
CellMesh lattice(std::uint32_t n, bool tetrahedra, const Place& at) {
    CellMesh mesh;
    const auto number = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) { return (k * (n + 1) + j) * (n + 1) + i; };
    for (std::uint32_t k = 0; k <= n; ++k)
        for (std::uint32_t j = 0; j <= n; ++j)
            for (std::uint32_t i = 0; i <= n; ++i) mesh.points.push_back(at(double(i) / n, double(j) / n, double(k) / n));
    for (std::uint32_t k = 0; k < n; ++k) {
        for (std::uint32_t j = 0; j < n; ++j) {
            for (std::uint32_t i = 0; i < n; ++i) {
                const Nodes c{number(i, j, k),     number(i + 1, j, k),     number(i + 1, j + 1, k),     number(i, j + 1, k),
                              number(i, j, k + 1), number(i + 1, j, k + 1), number(i + 1, j + 1, k + 1), number(i, j + 1, k + 1)};
                if (!tetrahedra) {
                    mesh.add_cell(CellType::hexahedron, c);
                    continue;
                }
                constexpr unsigned paths[6][2] = {{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}};
                for (const auto& [a, b] : paths) mesh.add_cell(CellType::tetrahedron, Nodes{c[0], c[a], c[b], c[6]});
            }
        }
    }
    return mesh;
}

Vec3 even(double x, double y, double z) { return {1000 * x, 1000 * y, 1000 * z}; }
/// A corner a thousand times finer than the opposite one.
Vec3 refined(double x, double y, double z) { return {1000 * x * x * x, 1000 * y * y * y, 1000 * z * z * z}; }

/// Each region with nodes of its own: all its borders are outer faces.
CellMesh in_regions(const CellMesh& whole, std::uint32_t regions) {
    CellMesh mesh;
    Attribute region;
    region.name = "region";
    region.location = AttributeLocation::cell;
    std::vector<std::int32_t> values;
    const std::size_t each = (whole.cell_count() + regions - 1) / regions;
    std::vector<std::uint32_t> place(whole.points.size(), no_index);
    for (std::size_t first = 0; first < whole.cell_count(); first += each) {
        std::ranges::fill(place, no_index);
        for (std::size_t c = first; c < std::min(first + each, whole.cell_count()); ++c) {
            Nodes nodes;
            for (const std::uint32_t node : whole.cell_nodes(c)) {
                if (place[node] == no_index) {
                    place[node] = static_cast<std::uint32_t>(mesh.points.size());
                    mesh.points.push_back(whole.points[node]);
                }
                nodes.push_back(place[node]);
            }
            mesh.add_cell(whole.types[c], nodes);
            values.push_back(static_cast<std::int32_t>(first / each));
        }
    }
    region.values = std::move(values);
    mesh.info.attributes.push_back(std::move(region));
    return mesh;
}

/// One flat huge cell just below all others.
CellMesh beside_a_huge_one(CellMesh mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const Vec3& p : {Vec3{-5e4, -5e4, -1}, Vec3{5e4, -5e4, -1}, Vec3{5e4, 5e4, -1}, Vec3{-5e4, 5e4, -1}, Vec3{-5e4, -5e4, -0.5},
                          Vec3{5e4, -5e4, -0.5}, Vec3{5e4, 5e4, -0.5}, Vec3{-5e4, 5e4, -0.5}})
        mesh.points.push_back(p);
    mesh.add_cell(CellType::hexahedron, Nodes{first, first + 1, first + 2, first + 3, first + 4, first + 5, first + 6, first + 7});
    return mesh;
}

struct Case {
    const char* name;
    CellMesh (*make)();
};
constexpr std::uint32_t cubes = 100, cubes_of_six = 55;  // 1,000,000 hexahedra; 998,250 tetrahedra
constexpr std::array cases = {
    Case{"tetrahedra", [] { return lattice(cubes_of_six, true, even); }},
    Case{"hexahedra", [] { return lattice(cubes, false, even); }},
    Case{"tetrahedra in 40 regions apart", [] { return in_regions(lattice(cubes_of_six, true, even), 40); }},
    Case{"hexahedra in 50 regions apart", [] { return in_regions(lattice(cubes, false, even), 50); }},
    Case{"tetrahedra, a refined corner", [] { return lattice(cubes_of_six, true, refined); }},
    Case{"hexahedra, a refined corner", [] { return lattice(cubes, false, refined); }},
    Case{"tetrahedra beside a flat huge cell", [] { return beside_a_huge_one(lattice(cubes_of_six, true, even)); }},
    Case{"hexahedra beside a flat huge cell", [] { return beside_a_huge_one(lattice(cubes, false, even)); }},
};

const Dataset& dataset(std::size_t number) {
    static std::array<Dataset, cases.size()> made;
    if (made[number].objects.empty()) {
        made = {};  // one at a time
        made[number].objects.emplace_back(cases[number].make());
    }
    return made[number];
}

std::size_t run_checks(const Dataset& data, std::vector<std::string> codes) {
    validators::CheckOptions options;
    options.only = std::move(codes);
    const auto checked = validators::check_models(data, options);
    return checked ? checked->findings.size() : 0;
}

/// Sums the volumes of all cells.
void bare_pass(const Dataset& data) {
    const auto& mesh = std::get<CellMesh>(data.objects.front());
    double sum = 0;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        const auto nodes = mesh.cell_nodes(c);
        for (std::size_t i = 1; i + 2 < nodes.size(); ++i)
            sum += tetrahedron_volume(mesh.points[nodes[0]], mesh.points[nodes[i]], mesh.points[nodes[i + 1]], mesh.points[nodes[i + 2]]);
    }
    benchmark::DoNotOptimize(sum);
}

/// What checks take beyond what all of them need.
struct Measured {
    bench::Least checks, needed, bare;
    double cpu() const { return checks.cpu - needed.cpu; }
};

Measured measure(const Dataset& data, const std::vector<std::string>& codes, int rounds) {
    Measured m;
    for (int round = 0; round < rounds; ++round) {
        m.bare.take([&] { bare_pass(data); });
        m.needed.take([&] { benchmark::DoNotOptimize(run_checks(data, {"M22"})); });
        m.checks.take([&] { benchmark::DoNotOptimize(run_checks(data, codes)); });
    }
    return m;
}

void cell_checks(benchmark::State& state, const std::vector<std::string>& codes) {
    const auto number = static_cast<std::size_t>(state.range(0));
    state.SetLabel(cases[number].name);
    const Dataset& data = dataset(number);
    Measured m;
    for (auto _ : state) m = measure(data, codes, 1);
    state.counters["cpu_s"] = m.cpu();
    state.counters["per_bare"] = m.cpu() / m.bare.cpu;
    state.counters["findings"] = static_cast<double>(run_checks(data, codes));
}

void print_asked() {
    for (std::size_t number = 0; number < cases.size(); ++number) {
        const Measured m = measure(dataset(number), {"M29"}, 2);
        const std::string what = std::string("M29, a million ") + cases[number].name;
        bench::print_figure(what.c_str(), 3, m.cpu(), "s of processor");
    }
}

}  // namespace

BENCHMARK_CAPTURE(cell_checks, M29, std::vector<std::string>{"M29"})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1)
    ->DenseRange(0, cases.size() - 1);
BENCHMARK_CAPTURE(cell_checks, M24_M36_M37, std::vector<std::string>{"M24", "M36", "M37"})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1)
    ->DenseRange(0, cases.size() - 1);

int main(int argc, char** argv) {
    bench::run(argc, argv, print_asked);
    return 0;
}
