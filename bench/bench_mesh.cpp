// SPDX-License-Identifier: AGPL-3.0-or-later
// The way from a sealed model with triangles of one size to a file of cells, stage by stage, in processor seconds beside those that TetGen
// itself takes for the same triangles: region by region with a size, as the program asks it, and for all of them at once with pYAq1.4,
// without a size. Models may be given; else they are real ones, where they are at hand.
#include <sys/resource.h>
#include <sys/wait.h>
#include <tetgen.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "asked.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "exchange/model_from_brep.h"
#include "formats/registry.h"
#include "pipeline/load.h"
#include "pipeline/mesh.h"
#include "pipeline/remesh.h"
#include "pipeline/shape.h"
#include "pipeline/validate.h"
#include "support/real_data.h"
#include "topology/brep_from_dataset.h"
#include "topology/lengths.h"
#include "volume/fill.h"
#include "volume/improve.h"
#include "volume/narrow_cells.h"
#include "volume/tetrahedra_workers.h"

namespace {

using namespace geomend;
using namespace geomend::volumes;

/// Of this process and of its children that have ended.
double processor_seconds() {
    rusage children{};
    ::getrusage(RUSAGE_CHILDREN, &children);
    const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
    return bench::cpu_seconds() + seconds(children.ru_utime) + seconds(children.ru_stime);
}

/// Stages in the order in which they are first met.
class Stages {
public:
    template <class Body>
    auto take(const char* name, const Body& body) {
        const double start = processor_seconds();
        struct AtEnd {
            Stages& stages;
            const char* name;
            double start;
            ~AtEnd() { stages.add(name, processor_seconds() - start); }
        } end{*this, name, start};
        return body();
    }
    void add(const char* name, double seconds) {
        for (auto& [known, sum] : all_) {
            if (known == name) {
                sum += seconds;
                return;
            }
        }
        all_.emplace_back(name, seconds);
    }
    const std::vector<std::pair<std::string, double>>& all() const { return all_; }

private:
    std::vector<std::pair<std::string, double>> all_;
};

/// What TetGen alone takes for facets: its function in a process of its own, which may crash, without what goes in and out of it.
struct Alone {
    double seconds = 0;
    int cells = 0;
};
Alone tetgen_alone(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles, const std::string& switches) {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) return {};
    std::fflush(stdout);
    const pid_t child = ::fork();
    if (child == 0) {
        if (std::freopen("/dev/null", "w", stdout) == nullptr) ::_exit(1);
        tetgenio in, out;
        in.numberofpoints = static_cast<int>(positions.size());
        in.pointlist = new REAL[3 * positions.size()];
        std::copy_n(positions.front().data(), 3 * positions.size(), in.pointlist);
        in.numberoffacets = static_cast<int>(triangles.size());
        in.facetlist = new tetgenio::facet[triangles.size()];
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            tetgenio::init(&in.facetlist[t]);
            in.facetlist[t].numberofpolygons = 1;
            in.facetlist[t].polygonlist = new tetgenio::polygon[1];
            in.facetlist[t].polygonlist[0].numberofvertices = 3;
            in.facetlist[t].polygonlist[0].vertexlist = new int[3];
            for (std::size_t k = 0; k < 3; ++k) in.facetlist[t].polygonlist[0].vertexlist[k] = static_cast<int>(triangles[t][k]);
        }
        tetgenbehavior how;
        std::string text = switches;
        how.parse_commandline(text.data());
        const double start = bench::cpu_seconds();
        ::tetrahedralize(&how, &in, &out);
        const Alone done{bench::cpu_seconds() - start, out.numberoftetrahedra};
        ::_exit(::write(ends[1], &done, sizeof done) == sizeof done ? 0 : 1);
    }
    ::close(ends[1]);
    Alone done;
    if (child < 0 || ::read(ends[0], &done, sizeof done) != sizeof done) done = {};
    ::close(ends[0]);
    ::waitpid(child, nullptr, 0);
    return done;
}

/// The least of some rounds.
Alone least_alone(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles, const std::string& switches) {
    Alone least = tetgen_alone(positions, triangles, switches);
    for (int round = 1; round < 3; ++round) {
        const Alone again = tetgen_alone(positions, triangles, switches);
        if (again.seconds < least.seconds) least = again;
    }
    return least;
}

/// All triangles of a model with all of its regions.
Alone least_alone(const BrepData& brep, const std::string& switches) {
    std::vector<Triangle> triangles;
    std::vector<Vec3> positions;
    std::map<std::uint32_t, std::uint32_t> number;
    for (const auto& surface : brep.surfaces) {
        for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
            Triangle t{};
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t v = surface.nodes[surface.polygons[p][k]].value;
                const auto [at, is_new] = number.try_emplace(v, static_cast<std::uint32_t>(positions.size()));
                if (is_new) positions.push_back(brep.vertices[v]);
                t[k] = at->second;
            }
            triangles.push_back(t);
        }
    }
    return least_alone(positions, triangles, switches);
}

/// A fortieth of the diagonal of the box around a dataset's surfaces.
double size_of(const Dataset& dataset) {
    Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (const Object& object : dataset.objects) {
        const auto* surface = std::get_if<Surface>(&object);
        if (surface == nullptr) continue;
        for (const Vec3& p : surface->points) {
            for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
        }
    }
    return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) / 40;
}

constexpr const char* tetgen_stage = "TetGen, with its process and messages";

/// The cells of a region as fill_regions() makes and proves them; 0: it takes another method. Stages get their times.
std::size_t fill_by_stages(const RegionFacets& facets, double size, TetrahedraWorkers& workers, Stages& stages) {
    const std::string switches = "QpYMT1e-14q1.4a" + number_text(most_cell_volume(size));
    ChildLimits limits;
    limits.workers = &workers;
    auto all = stages.take(tetgen_stage, [&] { return tetrahedra_of(facets, {}, switches, {}, limits, nullptr); });
    if (!all) return 0;
    auto cells = stages.take("cells checked", [&] { return cells_of_region(facets, std::move(*all)); });
    if (!cells) return 0;
    stages.take("cells improved", [&] { return improve(facets, *cells, nullptr, {}, true, size).flips; });
    stages.take("cells checked", [&] {
        measure(facets, *cells);
        return lie_apart(cells->cells);
    });
    stages.take("cells checked", [&] { return narrow_cells(facets, *cells, size).all; });
    return cells->cells.size();
}

struct Figures {
    double own = 0, tetgen = 0, filling = 0, alone = 0, command = 0;
    std::size_t cells = 0;
};

double sum_of(const Stages& stages, std::initializer_list<std::string_view> names) {
    double sum = 0;
    for (const auto& [name, seconds] : stages.all()) {
        for (const std::string_view wanted : names) sum += name == wanted ? seconds : 0;
    }
    return sum;
}

/// From a file with triangles of the size to one with cells.
Figures measure_stages(const std::string& file, double size, const std::filesystem::path& folder) {
    Stages stages;
    Figures figures;
    validators::CheckOptions checks;
    LoadOptions load_options;
    auto dataset = stages.take("read", [&] { return load(file, load_options); });
    stages.take("model checked", [&] { return validate(file, *dataset, checks).ok(); });
    auto model = stages.take("model built", [&] {
        auto models = topology::models_to_judge(*dataset, topology::model_sources(*dataset, validators::lengths_of(*dataset, checks)));
        std::erase_if(*models, [](const topology::JudgedModel& m) { return m.found.regions.empty(); });
        return std::move(models->front());
    });
    const auto facets = stages.take("facets of regions", [&] { return facets_of_regions(model); });
    double own_size = 0;
    std::optional<TetrahedraWorkers> workers(std::in_place);
    for (const RegionFacets& region : *facets) figures.cells += fill_by_stages(region, size, *workers, stages);
    stages.take(tetgen_stage, [&] { workers.reset(); });  // the times of children count when they have ended
    for (const RegionFacets& region : *facets) {
        const std::string switches = "QpYMT1e-14q1.4a" + number_text(most_cell_volume(size));
        own_size += least_alone(region.positions, region.triangles, switches).seconds;
    }
    const Alone alone = least_alone(*model.brep, "QpYAq1.4");
    figures.tetgen = own_size;
    figures.alone = alone.seconds;
    FillOptions how;
    how.size = size;
    auto filled = fill_dividing_surfaces(*model.brep, model.found, how);
    std::vector<Loss> losses;
    Dataset made = stages.take("cells ordered", [&] {
        auto brep = Brep::make(std::move(filled->brep));
        return exchange::tagged_model(*brep, losses);
    });
    const Format& format = *format_by_name("vtu");
    stages.take("shaped for its format", [&] { shape_for(made, format); });
    stages.take("written", [&] {
        OutputSet out(folder / "cells.vtu");
        return format.write(made, out, {}).ok() && out.commit().ok();
    });
    for (const auto& [name, seconds] : stages.all()) std::printf("  %-40s %7.3f s\n", name.c_str(), seconds);
    std::printf("  TetGen's function alone: %.3f s as the program asks it, by regions; %.3f s with pYAq1.4, all at once (%d cells)\n",
                figures.tetgen, figures.alone, alone.cells);
    MeshRequest request;
    request.files.inputs = {file};
    request.files.output = folder / "command.vtu";
    request.fill.size = size;
    const double start = processor_seconds();
    if (!mesh(request)) std::printf("  the command fails\n");
    figures.command = processor_seconds() - start;
    const double with_messages = sum_of(stages, {tetgen_stage});
    figures.filling = sum_of(stages, {tetgen_stage, "cells checked", "cells improved"});
    double all = 0;
    for (const auto& [name, seconds] : stages.all()) all += seconds;
    figures.own = all - with_messages + (with_messages - figures.tetgen) - sum_of(stages, {"cells improved"});
    std::printf("  all stages %.3f s; the command in one piece %.3f s\n", all, figures.command);
    return figures;
}

/// A fortieth of the diagonal, to a file with triangles of that size.
bool remesh_to(const std::string& file, const std::string& target, double& size) {
    RemeshRequest request;
    request.files.inputs = {file};
    request.files.output = target;
    request.files.lossy = true;
    auto dataset = load(file, request.files.load);
    if (!dataset) return false;
    size = size_of(*dataset);
    request.remesh.size = size;
    const auto done = remesh(request);
    return done && done->is_written;
}

void compare_with_tetgen(const std::string& file) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / ("bench_mesh_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    const std::string remeshed = folder / "remeshed.ml";
    double size = 0;
    std::printf("%s\n", file.c_str());
    if (remesh_to(file, remeshed, size)) {
        const ThreadBudget one(1);
        const Figures f = measure_stages(remeshed, size, folder);
        std::printf("  %zu cells, triangles and cells of %g\n", f.cells, size);
        std::printf("  own work without improvement / TetGen's own  asked  1.00  measured %5.2f\n", f.own / f.tetgen);
        std::printf("  filling, improvement, checks / pYAq1.4       asked  2.00  measured %5.2f\n", f.filling / f.alone);
        std::printf("  whole command / pYAq1.4                                   measured %5.2f\n", f.command / f.alone);
    } else {
        std::printf("  cannot be given new triangles\n");
    }
    std::filesystem::remove_all(folder);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1 && argv[1] == std::string_view(worker_word)) return tetrahedra_worker(std::vector<std::string>(argv + 2, argv + argc));
    std::vector<std::string> files;
    for (int i = 1; i < argc; ++i) {
        if (std::filesystem::exists(argv[i])) files.emplace_back(argv[i]);
    }
    if (files.empty()) {
        for (const char* name : {"gocad/modelA1.ml", "gocad/CloudSpin_fixed.ml", "ringmesh/corbieres.gm"}) {
            if (const auto found = test::real_data(name)) files.push_back(*found);
        }
    }
    for (const std::string& file : files) compare_with_tetgen(file);
    return 0;
}
