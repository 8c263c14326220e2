// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>
#include <vector>

#include "validators/fixtures.h"

namespace geomend::testing {

namespace {

Dataset of(Object object) {
    Dataset data;
    data.objects.push_back(std::move(object));
    return data;
}

// ---- meshes of cells

/// Unit cubes in a row along x.
CellMesh cubes(std::uint32_t count) {
    CellMesh mesh;
    mesh.info.name = "cubes";
    for (std::uint32_t i = 0; i <= count; ++i) {
        for (const double y : {0.0, 1.0}) {
            for (const double z : {0.0, 1.0}) mesh.points.push_back({double(i), y, z});
        }
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t a = 4 * i, b = a + 4;
        mesh.add_cell(CellType::hexahedron, std::array{a, b, b + 2, a + 2, a + 1, b + 1, b + 3, a + 3});
    }
    return mesh;
}
Dataset sound_cubes() { return of(cubes(3)); }

template <class Change>
Dataset changed_cubes(const Change& change) {
    CellMesh mesh = cubes(3);
    change(mesh);
    return of(mesh);
}
/// Three cubes and a square with nodes of its own across the row: at 1 it is the face of two of them.
Dataset cubes_with_square(double x) {
    return changed_cubes([&](CellMesh& m) {
        const auto first = static_cast<std::uint32_t>(m.points.size());
        for (const Vec3& p : {Vec3{x, 0, 0}, Vec3{x, 1, 0}, Vec3{x, 1, 1}, Vec3{x, 0, 1}}) m.points.push_back(p);
        m.add_cell(CellType::quad, std::array{first, first + 1, first + 2, first + 3});
    });
}

/// A row of three cubes with an array of regions.
Dataset cubes_of_regions(std::vector<std::int32_t> regions) {
    return changed_cubes([&](CellMesh& m) {
        Attribute a;
        a.name = "Region_ID";
        a.location = AttributeLocation::cell;
        a.values = std::move(regions);
        m.info.attributes.push_back(std::move(a));
    });
}
void add_tetrahedron(CellMesh& mesh, std::array<std::uint32_t, 4> nodes) { mesh.add_cell(CellType::tetrahedron, nodes); }

/// Two tetrahedra on a triangle, and one more beside them or on it, too.
Dataset tetrahedra_on_a_face(bool three) {
    CellMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {1, 1, 1}};
    add_tetrahedron(mesh, {0, 1, 2, 3});
    add_tetrahedron(mesh, {0, 2, 1, 4});
    if (three) add_tetrahedron(mesh, {0, 1, 2, 5});
    else add_tetrahedron(mesh, {1, 2, 3, 5});
    return of(mesh);
}

/// A tetrahedron on a side of a cube, by nodes of its own or by three of a half cube's.
Dataset beside_a_cube(bool matching) {
    CellMesh mesh = cubes(1);
    mesh.points.push_back({1, 0.5, 0.5});
    mesh.points.push_back({2, 0.5, 0.5});
    if (matching) mesh.add_cell(CellType::pyramid, std::array{4u, 5u, 7u, 6u, 9u});
    else add_tetrahedron(mesh, {4, 6, 8, 9});
    if (matching) mesh.points.erase(mesh.points.begin() + 8);
    if (matching) mesh.nodes.back() = 8;
    return of(mesh);
}

/// Two rows of cubes; the second one by nodes of its own, moved along x and turned around z.
Dataset two_rows(double along, double angle) {
    CellMesh mesh = cubes(3), other = cubes(3);
    const auto shift = static_cast<std::uint32_t>(mesh.points.size());
    for (Vec3 p : other.points) mesh.points.push_back({p[0] + along, p[1], p[2]});
    for (std::size_t c = 0; c < other.cell_count(); ++c) {
        std::vector<std::uint32_t> nodes;
        for (const std::uint32_t node : other.cell_nodes(c)) nodes.push_back(node + shift);
        mesh.add_cell(CellType::hexahedron, nodes);
    }
    for (Vec3& p : mesh.points) {
        p = {std::cos(angle) * p[0] - std::sin(angle) * p[1], std::sin(angle) * p[0] + std::cos(angle) * p[1], p[2]};
    }
    return of(mesh);
}

/// Two tetrahedra with an edge in common, and where asked others that join them.
Dataset around_an_edge(bool joined) {
    CellMesh mesh;
    mesh.points = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0.5}, {0.5, 1, 0.5}, {-1, 0.5, 0.5}, {-0.5, -1, 0.5}};
    add_tetrahedron(mesh, {0, 2, 3, 1});
    add_tetrahedron(mesh, {0, 4, 5, 1});
    if (joined) add_tetrahedron(mesh, {0, 3, 4, 1});
    return of(mesh);
}

/// A cube as a polyhedron; without its last face, or with a corner pulled out, where asked.
Dataset polyhedron(bool open, bool bent) {
    CellMesh mesh = cubes(1);
    mesh.types = {CellType::polyhedron};
    const std::vector<std::vector<std::uint32_t>> faces = {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1},
                                                           {4, 6, 7, 5}, {6, 2, 3, 7}, {2, 0, 1, 3}};
    mesh.face_offsets = {0};
    for (std::size_t f = 0; f < (open ? 5u : 6u); ++f) {
        mesh.face_nodes.insert(mesh.face_nodes.end(), faces[f].begin(), faces[f].end());
        mesh.face_offsets.push_back(mesh.face_nodes.size());
    }
    mesh.cell_faces = {0, open ? 5u : 6u};
    if (bent) mesh.points[7][0] += 0.1;
    return of(mesh);
}
Dataset sound_polyhedron() { return polyhedron(false, false); }

/// The second cube has nodes of its own; they are shifted.
Dataset cut_cubes(double shift) {
    CellMesh mesh = cubes(2);
    for (std::uint32_t n = 4; n < 8; ++n) mesh.points.push_back({1 + shift, mesh.points[n][1], mesh.points[n][2]});
    for (std::size_t k = 8; k < 16; ++k) mesh.nodes[k] += mesh.nodes[k] < 8 ? 8 : 0;
    return of(mesh);
}

// ---- points, lines, wells

Dataset points(const Vec3& last) {
    PointSet set;
    set.info.name = "picks";
    set.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, last};
    return of(set);
}

PolylineSet line(const std::vector<Vec3>& way) {
    PolylineSet set;
    set.info.name = "line";
    set.points = way;
    for (std::uint32_t i = 0; i + 1 < way.size(); ++i) set.edges.push_back({i, i + 1});
    return set;
}
Dataset two_lines(double height) {
    PolylineSet set = line({{0, 0, 0}, {4, 0, 0}});
    set.parts = {{0, 0, {}}, {2, 1, {}}};
    set.points.push_back({2, -1, height});
    set.points.push_back({2, 1, height});
    set.edges.push_back({2, 3});
    return of(set);
}
Dataset three_edges(bool repeated) {
    PolylineSet set = line({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
    set.edges.push_back({2, repeated ? 1u : 0u});
    return of(set);
}

template <class Change>
Dataset well(const Change& change) {
    Well w;
    w.info.name = "W-1";
    for (int s = 0; s <= 5; ++s) {
        w.path.push_back({0, 0, -100.0 * s});
        w.measured_depth.push_back(100.0 * s);
    }
    w.markers = {{"top", 250, {}}};
    Well::Curve log;
    log.values.name = "GR";
    log.measured_depth = {100, 200, 300};
    log.values.values = std::vector<double>{1, 2, 3};
    w.curves.push_back(log);
    change(w);
    return of(w);
}
Dataset sound_well() {
    return well([](Well&) {});
}

// ---- rasters and structured grids

Dataset raster(const Vec3& second_step, const std::vector<double>& values) {
    Raster r;
    r.info.name = "map";
    r.dims = {2, 2, 1};
    r.step = {{{25, 0, 0}, second_step, {0, 0, 1}}};
    Attribute a;
    a.name = "depth";
    a.values = values;
    a.no_data = -1;
    r.info.attributes.push_back(a);
    return of(r);
}
Dataset sound_raster() { return raster({0, 25, 0}, {1, 2, 3, 4}); }

template <class Change>
Dataset lattice(const Change& change) {
    StructuredGrid grid;
    grid.info.name = "bricks";
    grid.dims = {4, 3, 4};
    for (int k = 0; k < 4; ++k) {
        for (int j = 0; j < 3; ++j) {
            for (int i = 0; i < 4; ++i) grid.points.push_back({100.0 * i, 50.0 * j, 10.0 * k});
        }
    }
    change(grid.points);
    return of(grid);
}

constexpr Fixture fixtures[] = {
    {"M10",
     [] {
         return points({1, 0, 0});
     },
     [] {
         return points({1, 1, 0});
     }},
    {"M11",
     [] {
         return of(line({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}));
     },
     [] {
         return of(line({{0, 0, 0}, {1, 0, 0}, {1, 0, 1}}));
     }},
    {"M12", [] { return three_edges(true); }, [] { return three_edges(false); }},
    {"M13",
     [] {
         return of(line({{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {2, 2, 0}, {2, -2, 0}}));
     },
     [] {
         return of(line({{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {2, 2, 1}, {2, -2, 1}}));
     }},
    {"M14", [] { return two_lines(0); }, [] { return two_lines(1); }},
    {"M20",
     [] {
         return changed_cubes([](CellMesh& m) {
             for (std::size_t k = 0; k < 4; ++k) std::swap(m.nodes[8 + k], m.nodes[12 + k]);
         });
     },
     sound_cubes},
    {"M21", [] { return changed_cubes([](CellMesh& m) {
                     m.points[11] = {1.4, 0.4, 0.4};
                 }); },
     [] { return changed_cubes([](CellMesh& m) {
              m.points[11] = {1.9, 0.9, 0.9};
          }); }},
    {"M22", [] { return changed_cubes([](CellMesh& m) {
                     add_tetrahedron(m, {12, 13, 14, 13});
                 }); }, sound_cubes},
    {"M23", [] { return tetrahedra_on_a_face(true); }, [] { return tetrahedra_on_a_face(false); }},
    {"M24", [] { return beside_a_cube(false); }, [] { return beside_a_cube(true); }},
    {"M25", [] { return polyhedron(true, false); }, sound_polyhedron},
    {"M26", [] { return changed_cubes([](CellMesh& m) {
                     m.add_cell(CellType::hexahedron, std::array{0u, 4u, 6u, 2u, 1u, 5u, 7u, 3u});
                 }); },
     sound_cubes},
    {"M27", [] { return cut_cubes(1e-8); }, [] { return cut_cubes(0.1); }},
    {"M28", [] { return changed_cubes([](CellMesh& m) {
                     m.points.push_back({1, 1, 3});
                 }); }, sound_cubes},
    {"M29", [] { return two_rows(2.7, 0.3); }, [] { return two_rows(3, 0.3); }},
    {"M30", [] { return well([](Well& w) { w.measured_depth[3] = 150; }); }, sound_well},
    {"M31", [] { return well([](Well& w) { w.path[3] = w.path[2]; }); }, sound_well},
    {"M32", [] { return well([](Well& w) { w.markers[0].measured_depth = 750; }); }, sound_well},
    {"M33", [] { return well([](Well& w) { w.path[5][0] = 50; }); },
     [] {
         return well([](Well& w) {
             w.path[5][0] = 50;
             w.measured_depth[5] = 512;
         });
     }},
    {"M34", [] { return well([](Well& w) { w.curves[0].measured_depth[2] = 150; }); }, sound_well},
    {"M35",
     [] {
         return changed_cubes([](CellMesh& m) {
             for (std::size_t c = 0; c < 3; ++c) {
                 for (std::size_t k = 0; k < 4; ++k) std::swap(m.nodes[8 * c + k], m.nodes[8 * c + 4 + k]);
             }
         });
     },
     sound_cubes},
    {"M36", [] { return around_an_edge(false); }, [] { return around_an_edge(true); }},
    {"M37",
     [] {
         return cubes_of_regions({1, 2, 1});
     },
     [] {
         return cubes_of_regions({1, 1, 2});
     }},
    {"M38", [] { return two_rows(3.02, 0.3); }, [] { return two_rows(3, 0.3); }},
    {"M39", [] { return cubes_with_square(0.5); }, [] { return cubes_with_square(1); }},
    {"M40",
     [] {
         return raster({50, 0, 0}, {1, 2, 3, 4});
     },
     sound_raster},
    {"M41",
     [] {
         return raster({0, -25, 0}, {1, 2, 3, 4});
     },
     sound_raster},
    {"M42",
     [] {
         return raster({0, 25, 0}, {-1, -1, -1, -1});
     },
     [] {
         return raster({0, 25, 0}, {-1, -1, -1, 4});
     }},
    {"M43",
     [] {
         return raster({0, 25, 0}, {1, 2, 3, -999.25});
     },
     sound_raster},
    {"M50",
     [] {
         return lattice([](std::vector<Vec3>& p) {
             for (std::size_t n = 0; n < 12; ++n) p[12 + n][2] = p[n][2];
         });
     },
     [] {
         return lattice([](std::vector<Vec3>& p) {
             for (std::size_t n = 0; n < 12; ++n) p[12 + n][2] = p[n][2] + 1;
         });
     }},
    {"Q10", [] { return polyhedron(false, true); }, sound_polyhedron},
};

}  // namespace

std::span<const Fixture> object_fixtures() { return fixtures; }

}  // namespace geomend::testing
