// SPDX-License-Identifier: AGPL-3.0-or-later
// Remeshing of a wavy surface whose borders stay, against CGAL's isotropic_remeshing with protected constraints on the same triangles,
// both on one thread: to triangles as large as they are, and to coarser and finer ones.
#include <cmath>
#include <cstdio>
#include <random>

#include "asked.h"
#include "remesh/isotropic.h"
#include "remesh/triangle_quality.h"
#ifdef GEOMEND_WITH_CGAL
#include "cgal_remesh.h"
#endif

namespace {

using namespace geomend;
using namespace geomend::remeshing;

struct Sheet {
    std::vector<Vec3> places;
    std::vector<Triangle> triangles;
    EdgeMesh mesh;
};

/// A sheet of n by n squares of about 1 with waves; vertices inside of it lie up to a third from where they would lie evenly.
Sheet sheet(std::uint32_t n) {
    Sheet made;
    std::mt19937 engine(7);
    std::uniform_real_distribution<double> shift(-0.33, 0.33);
    for (std::uint32_t j = 0; j <= n; ++j) {
        for (std::uint32_t i = 0; i <= n; ++i) {
            const bool is_border = i == 0 || j == 0 || i == n || j == n;
            const double x = i + (is_border ? 0 : shift(engine)), y = j + (is_border ? 0 : shift(engine));
            made.places.push_back({x, y, 10 * std::sin(x / 40) * std::cos(y / 55)});
        }
    }
    const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * (n + 1) + i; };
    for (std::uint32_t j = 0; j < n; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
            made.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            made.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    std::vector<std::uint32_t> corners, neighbours;
    for (std::uint32_t t = 0; t < made.triangles.size(); ++t) {
        const std::uint32_t i = t / 2 % n, j = t / 2 / n;
        corners.insert(corners.end(), made.triangles[t].begin(), made.triangles[t].end());
        if (t % 2 == 0) {
            neighbours.push_back(j > 0 ? t - 2 * n + 1 : no_index);
            neighbours.push_back(i + 1 < n ? t + 3 : no_index);
            neighbours.push_back(t + 1);
        } else {
            neighbours.push_back(t - 1);
            neighbours.push_back(j + 1 < n ? t + 2 * n - 1 : no_index);
            neighbours.push_back(i > 0 ? t - 3 : no_index);
        }
    }
    made.mesh = std::move(fanned_mesh(made.places, corners, neighbours)->mesh);
    return made;
}

TriangleQuality remesh_own(const Sheet& from, double size) {
    const std::vector<double> sizes(from.mesh.places.size(), size);
    WorkSurface work = work_surface(from.mesh, {sizes, {}, 0, nullptr});
    for (VertexKind& kind : work.kinds) kind = kind == VertexKind::old ? VertexKind::fixed : kind;
    remesh_isotropic(work, {});
    TriangleQuality quality;
    for (std::uint32_t t = 0; t < work.mesh.triangle_count(); ++t) {
        if (work.mesh.has_triangle(t)) quality.add(work.mesh.triangle(t));
    }
    return quality;
}

void print_quality(const char* who, const TriangleQuality& q) {
    std::printf("  %-6s %llu triangles, %.2f %% above 30 degrees, least angle %.1f, mean quality %.3f\n", who,
                static_cast<unsigned long long>(q.triangles), 100 * q.share_above_30(), q.least_angle, q.mean_quality());
}

void own(benchmark::State& state) {
    const Sheet from = sheet(static_cast<std::uint32_t>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(remesh_own(from, 1.15));
}
BENCHMARK(own)->Unit(benchmark::kMillisecond)->Arg(70)->Arg(224)->Arg(707);

#ifdef GEOMEND_WITH_CGAL
void compare_with_cgal() {
    const Sheet from = sheet(707);
    std::printf("%zu triangles\n", from.triangles.size());
    for (const double size : {1.15, 2.3, 0.8}) {
        for (const unsigned iterations : {1u, 3u, 6u}) {
            TriangleQuality mine, theirs;
            bench::Least own_time, cgal_time;
            {
                bench::CgalSurface surface(from.places, from.triangles);
                cgal_time.take([&] { surface.remesh(size, iterations); });
                for (const auto& t : surface.triangles()) theirs.add(t);
            }
            own_time.take([&] { mine = remesh_own(from, size); });
            const std::string what = "remeshing to edges of " + std::to_string(size).substr(0, 4),
                              yardstick = "CGAL with " + std::to_string(iterations) + " iterations";
            bench::print_ratio(what.c_str(), 1, own_time, yardstick.c_str(), cgal_time);
            print_quality("own", mine);
            print_quality("CGAL", theirs);
        }
    }
}
#endif

}  // namespace

int main(int argc, char** argv) {
    geomend::bench::run(argc, argv, [] {
#ifdef GEOMEND_WITH_CGAL
        compare_with_cgal();
#endif
    });
}
