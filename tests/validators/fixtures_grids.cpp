// SPDX-License-Identifier: AGPL-3.0-or-later
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "pipeline/load.h"
#include "support/corner_point_grids.h"
#include "support/temporary_folder.h"
#include "validators/checks_testing.h"
#include "validators/fixtures.h"

namespace geomend::testing {

namespace {

Dataset of(Object object) {
    Dataset data;
    data.objects.push_back(std::move(object));
    return data;
}

template <class Change>
Dataset bricks(const Change& change) {
    CornerPointGrid grid = brick_grid(4, 3, 2);
    change(grid);
    return of(grid);
}
Dataset sound_bricks() {
    return bricks([](CornerPointGrid&) {});
}

void move_corners(CornerPointGrid& grid, std::uint32_t k, unsigned first, unsigned last, double by) {
    for (unsigned c = first; c < last; ++c) corner(grid, 0, 0, k, c) += by;
}
/// The bottom of the upper of two cells goes through the base of the lower one, or not.
Dataset inverted(double by) {
    return bricks([&](CornerPointGrid& g) {
        move_corners(g, 1, 0, 4, by);
        move_corners(g, 0, 4, 8, by);
    });
}
Dataset corner_pillar(double by) {
    return bricks([&](CornerPointGrid& g) { move_pillar(g, 0, 0, by, by); });
}
Dataset leaning(double degrees) {
    return bricks([&](CornerPointGrid& g) {
        for (std::uint32_t j = 0; j < 4; ++j) {
            for (std::uint32_t i = 0; i < 5; ++i) move_pillar(g, i, j, 100 * j / std::tan(degrees * std::acos(-1.0) / 180), 0);
        }
    });
}
Dataset flat_pillar(double shift) {
    return bricks([&](CornerPointGrid& g) {
        double* p = pillar(g, 1, 2);
        p[5] = p[2];
        p[3] += shift;
    });
}
/// Pillars of one row lean towards the next one by so much over the height of the grid.
Dataset leaning_row(double by) {
    return bricks([&](CornerPointGrid& g) {
        for (std::uint32_t j = 0; j < 4; ++j) pillar(g, 1, j)[3] += by;
    });
}
Dataset folded_column() {
    return bricks([](CornerPointGrid& g) {
        for (std::uint32_t j = 0; j < 4; ++j) pillar(g, 4, j)[0] = pillar(g, 4, j)[3] = 250;
    });
}
Dataset mapped(const char* unit) {
    return bricks([&](CornerPointGrid& g) {
        g.map_axes = {0, 10, 0, 0, 10, 0};
        g.map_unit = unit;
    });
}
Dataset with_activity(std::uint8_t second) {
    return bricks([&](CornerPointGrid& g) {
        g.activity.assign(g.cell_count(), 1);
        g.activity[1] = second;
    });
}
Dataset with_porosity(double least_pore_volume) {
    return bricks([&](CornerPointGrid& g) {
        add_constant(g, "PORO", 0.1);  // 10000 each
        g.least_pore_volume = least_pore_volume;
    });
}
/// A column of inactive cells parts the others; or one cell is left alone behind them.
Dataset parted(bool lonely) {
    return bricks([&](CornerPointGrid& g) {
        g.activity.assign(g.cell_count(), 1);
        for (std::uint32_t k = 0; k < 2; ++k) {
            for (std::uint32_t j = 0; j < 3; ++j) {
                g.activity[g.cell(2, j, k)] = 0;
                if (lonely) g.activity[g.cell(3, j, k)] = j + k == 0 ? 1 : 0;
            }
        }
    });
}
Dataset parted_in_two() { return parted(false); }
Dataset parted_and_lonely() { return parted(true); }
Dataset thrown(bool stated) {
    return bricks([&](CornerPointGrid& g) {
        add_throw(g, 2, 5);
        if (stated) g.faults = {{"A", {{{1, 0, 0}, {1, 2, 1}, CellFace::i_plus}}, {}}};
    });
}
Dataset far_north(double y) {
    return bricks([&](CornerPointGrid& g) {
        for (std::size_t k = 1; k < g.pillars.size(); k += 3) g.pillars[k] += y;
    });
}
Dataset fault_record(std::uint32_t column) {
    return bricks([&](CornerPointGrid& g) { g.faults = {{"A", {{{column, 0, 0}, {column, 2, 1}, CellFace::i_plus}}, {}}}; });
}

Dataset region_numbers(const char* name, std::vector<std::int32_t> of_columns) {
    return bricks([&](CornerPointGrid& g) {
        Attribute a;
        a.name = name;
        a.location = AttributeLocation::cell;
        std::vector<std::int32_t> numbers;
        for (std::size_t cell = 0; cell < g.cell_count(); ++cell) numbers.push_back(of_columns[g.ijk(cell)[0]]);
        a.values = numbers;
        g.info.attributes.push_back(std::move(a));
    });
}
/// Two faults in a grid with throw at one place; the second one begins at a column.
Dataset two_fault_records(std::uint32_t second, bool displaced) {
    return bricks([&](CornerPointGrid& g) {
        add_throw(g, 2, 5);
        if (displaced) add_throw(g, 1, 3);
        g.faults = {{"A", {{{1, 0, 0}, {1, 2, 1}, CellFace::i_plus}}, {}}, {"B", {{{second, 0, 0}, {second, 2, 1}, CellFace::i_plus}}, {}}};
    });
}
/// Columns along a line on the ground, 100 wide, that comes back over itself or stays beside.
Dataset ribbon(bool crossed) {
    std::vector<std::array<double, 2>> line{{0, 0}, {300, 0}, {600, 0}, {900, 100}, {1000, 400}, {800, 700}, {500, 700}, {400, 400}};
    if (crossed) line.push_back({420, -200});
    CornerPointGrid grid = brick_grid(static_cast<std::uint32_t>(line.size() - 1), 1, 2);
    for (std::uint32_t i = 0; i < line.size(); ++i) {
        const auto &a = line[i == 0 ? 0 : i - 1], &b = line[i + 1 < line.size() ? i + 1 : i];
        const double dx = b[0] - a[0], dy = b[1] - a[1], length = std::hypot(dx, dy);
        for (const std::uint32_t j : {0u, 1u}) {
            const double away = j == 0 ? -50 : 50;
            for (const std::size_t at : {0u, 3u}) {
                pillar(grid, i, j)[at] = line[i][0] - away * dy / length;
                pillar(grid, i, j)[at + 1] = line[i][1] + away * dx / length;
            }
        }
    }
    return of(grid);
}
/// A throw between pillars that lean apart, or stand upright: sides are bent, and tops that meet them are plane.
Dataset bent_faces(double lean) {
    CornerPointGrid grid = brick_grid(4, 4, 2);
    for (std::uint32_t j = 0; j <= 4; ++j) {
        for (std::uint32_t i = 0; i <= 4; ++i) pillar(grid, i, j)[3] += (j % 2 == 0 ? lean : -lean);
    }
    reshape(grid, [](std::uint32_t i, std::uint32_t j, auto, unsigned c, double depth) {
        const double y = j + ((c >> 1) & 1u);
        return i >= 2 ? depth + 9 - 5 * y : depth + 3 * y;
    });
    return of(grid);
}

/// A connection that the file states between two cells of which none or one is active, or of one cell with itself.
Dataset stated_connection(std::uint64_t first, std::uint64_t second) {
    return bricks([&](CornerPointGrid& g) { g.connections.push_back({first, second, 1.5}); });
}
/// Two local grids, the second one from this column of their host on.
Dataset local_grids(std::uint32_t from) {
    CornerPointGrid host = brick_grid(6, 3, 2);
    host.info.name = "main";
    Dataset data = of(host);
    for (const std::uint32_t first : {0u, from}) {
        CornerPointGrid local = brick_grid(4, 4, 2);
        local.info.name = "LGR" + std::to_string(first);
        for (std::size_t p = 0; p < local.pillars.size(); p += 3) {
            local.pillars[p] = 100.0 * first + local.pillars[p] / 2;
            local.pillars[p + 1] /= 2;
        }
        auto& box = local.host.emplace();
        box.first = {first, 0, 0};
        box.last = {first + 1, 1, 1};
        data.objects.emplace_back(std::move(local));
    }
    return data;
}
/// A cell halved along I, of which the halves are stated to be in these host cells.
Dataset halves_of(std::uint64_t first, std::uint64_t second) {
    CornerPointGrid host = brick_grid(3, 1, 1);
    host.info.name = "main";
    CornerPointGrid local = brick_grid(2, 1, 1);
    local.info.name = "halves";
    for (std::size_t p = 0; p < local.pillars.size(); p += 3) local.pillars[p] = 100 + local.pillars[p] / 2;
    local.host = {"", {1, 0, 0}, {1, 0, 0}, {first, second}};
    Dataset data = of(host);
    data.objects.emplace_back(std::move(local));
    return data;
}
/// Four cells around an axis, each over so many degrees, as the reader of decks gives them.
Dataset around_an_axis(const char* degrees) {
    const test::TemporaryFolder folder;
    test::write_file(folder / "a.data", "RUNSPEC\nDIMENS\n2 4 1 /\nRADIAL\nGRID\nINRAD\n1 /\nDRV\n1 2 /\nDTHETAV\n4*" +
                                            std::string(degrees) + " /\nDZ\n8*3 /\nTOPS\n8*10 /\n");
    auto read = load(folder / "a.data", {});
    return read ? std::move(*read) : Dataset{};
}

/// As the reader of decks gives it.
Dataset deck(const char* specgrid) {
    const test::TemporaryFolder folder;
    std::string text = "RUNSPEC\nDIMENS\n1 1 1 /\nGRID\nSPECGRID\n" + std::string(specgrid) + " 1 F /\nCOORD\n";
    for (const char* xy : {"0 0", "100 0", "0 100", "100 100"}) text += std::string(xy) + " 1000 " + xy + " 1100\n";
    text += "/\nZCORN\n4*1000 4*1010 /\n";
    test::write_file(folder / "a.data", text);
    auto read = load(folder / "a.data", {});
    return read ? std::move(*read) : Dataset{};
}

// ---- S codes

CornerPointGrid complete_grid() {
    CornerPointGrid grid = brick_grid(3, 2, 2);
    for (const char* name : {"PERMX", "PERMY", "PERMZ"}) add_constant(grid, name, 100);
    add_constant(grid, "PORO", 0.2);
    grid.unit_system = "METRIC";
    return grid;
}
template <class Change>
Dataset for_flow(const Change& change) {
    CornerPointGrid grid = complete_grid();
    change(grid);
    return of(grid);
}
Dataset ready_for_flow() { return of(complete_grid()); }

/// A cube, tagged and with a named skin.
template <class Change>
Dataset for_cells(const Change& change) {
    CellMesh mesh;
    mesh.info.name = "cube";
    for (const double x : {0.0, 1.0}) {
        for (int c = 0; c < 4; ++c) mesh.points.push_back({x, double(c == 1 || c == 2), double(c > 1)});
    }
    mesh.add_cell(CellType::hexahedron, std::array{0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u});
    for (std::uint32_t c = 0; c < 4; ++c) mesh.add_cell(CellType::quad, std::array{c, (c + 1) % 4, 4 + (c + 1) % 4, 4 + c});
    mesh.add_cell(CellType::quad, std::array{3u, 2u, 1u, 0u});
    mesh.add_cell(CellType::quad, std::array{4u, 5u, 6u, 7u});
    mesh.cell_entity = {0, 1, 1, 1, 1, 1, 1};
    mesh.entities.resize(2);
    mesh.entities[0].name = "rock";
    mesh.entities[1] = {2, 1, "skin", {}, {}, {}, {}, {}};
    change(mesh);
    return of(mesh);
}
Dataset ready_cells() {
    return for_cells([](CellMesh&) {});
}
void add_quadratic_cell(CellMesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    const double half[20][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2},
                                {0, 2, 2}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2},
                                {1, 2, 2}, {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}};
    std::vector<std::uint32_t> nodes;
    for (const auto& h : half) {
        mesh.points.push_back({5 + h[0] / 2, h[1] / 2, h[2] / 2});
        nodes.push_back(first + static_cast<std::uint32_t>(nodes.size()));
    }
    mesh.add_cell(CellType::quadratic_hexahedron, nodes);
    mesh.cell_entity.push_back(0);
}

Dataset a_point() {
    PointSet set;
    set.points = {{0, 0, 0}};
    return of(set);
}

constexpr Fixture fixtures[] = {
    {"C01", [] { return bricks([](CornerPointGrid& g) { g.depths.pop_back(); }); }, sound_bricks},
    {"C02", [] { return bricks([](CornerPointGrid& g) { corner(g, 3, 2, 1, 7) = 1e20; }); }, sound_bricks},
    {"C03", [] { return inverted(-15); }, [] { return inverted(-5); }},
    {"C04", [] { return bricks([](CornerPointGrid& g) { move_corners(g, 0, 4, 8, 4); }); }, sound_bricks},
    {"C05", [] { return inverted(-10); }, [] { return inverted(-9); }},
    {"C06", [] { return bricks([](CornerPointGrid& g) { move_corners(g, 0, 0, 2, 10); }); },
     [] { return bricks([](CornerPointGrid& g) { move_corners(g, 0, 0, 2, 9); }); }},
    {"C07", [] { return corner_pillar(60); }, [] { return corner_pillar(40); }},
    {"C08", [] { return corner_pillar(60); }, [] { return corner_pillar(40); }},
    {"C09", [] { return leaning(9); }, [] { return leaning(11); }},
    {"C10", [] { return flat_pillar(5); }, [] { return flat_pillar(0); }},
    {"C11", [] { return leaning_row(150); }, [] { return leaning_row(50); }},
    {"C12", folded_column, sound_bricks},
    {"C13", [] { return mapped(""); }, [] { return mapped("METRES"); }},
    {"C14", [] { return deck("1 1 2"); }, [] { return deck("1 1 1"); }},
    {"C15", [] { return with_activity(2); }, [] { return with_activity(1); }},
    {"C16", [] { return with_porosity(10001); }, [] { return with_porosity(9999); }},
    {"C17", parted_in_two, sound_bricks},
    {"C18", [] { return thrown(false); }, [] { return thrown(true); }},
    {"C19", [] { return far_north(6000000.2); }, [] { return far_north(6000000); }},
    {"C20", [] { return fault_record(7); }, [] { return fault_record(1); }},
    {"C21", parted_and_lonely, parted_in_two},
    {"C22", [] { return bricks([](CornerPointGrid& g) { move_corners(g, 0, 0, 4, 9.95); }); },
     [] { return bricks([](CornerPointGrid& g) { move_corners(g, 0, 0, 4, 9.5); }); }},
    {"C23",
     [] {
         return region_numbers("FIPNUM", {1, 2, 1, 1});
     },
     [] {
         return region_numbers("FIPNUM", {1, 2, 2, 3});
     }},
    {"C24",
     [] {
         return region_numbers("SATNUM", {1, 0, 1, 1});
     },
     [] {
         return region_numbers("SATNUM", {1, 2, 1, 1});
     }},
    {"C25", [] { return fault_record(3); }, [] { return fault_record(1); }},
    {"C26", [] { return two_fault_records(1, false); }, [] { return two_fault_records(0, true); }},
    {"C27", [] { return ribbon(true); }, [] { return ribbon(false); }, "", true},
    {"C28", [] { return bent_faces(30); }, [] { return bent_faces(0); }, "", true},
    {"C29", [] { return stated_connection(5, 5); }, [] { return stated_connection(5, 16); }},
    {"C30", [] { return local_grids(1); }, [] { return local_grids(2); }},
    {"C31", [] { return around_an_axis("95"); }, [] { return around_an_axis("90"); }},
    {"C32", [] { return halves_of(1, 2); }, [] { return halves_of(1, 1); }},
    {"S01", a_point, ready_for_flow, "flow"},
    {"S02", [] { return for_flow([](CornerPointGrid& g) { move_corners(g, 0, 4, 8, 4); }); }, ready_for_flow, "flow"},
    {"S03", [] { return for_flow([](CornerPointGrid& g) { g.activity.assign(g.cell_count(), 0); }); }, ready_for_flow, "flow"},
    {"S04", [] { return for_flow([](CornerPointGrid& g) { g.info.attributes.pop_back(); }); }, ready_for_flow, "flow"},
    {"S05", [] { return for_flow([](CornerPointGrid& g) { std::get<std::vector<double>>(g.info.attributes.back().values)[3] = 1.5; }); },
     ready_for_flow, "flow"},
    {"S06", [] { return for_cells([](CellMesh& m) { m.entities[0].name = "1st rock"; }); }, ready_cells, "abaqus"},
    {"S07", [] { return for_cells(add_quadratic_cell); }, ready_cells, "geos"},
    {"S08",
     [] {
         return for_cells([](CellMesh& m) {
             m.cell_entity.clear();
             m.entities.clear();
         });
     },
     ready_cells, "geos"},
    {"S09", [] { return for_flow([](CornerPointGrid& g) { g.porosity = CornerPointGrid::Porosity::dual_porosity; }); }, ready_for_flow,
     "flow"},
    {"S10", [] { return for_cells([](CellMesh& m) { m.entities[1].name.clear(); }); }, ready_cells, "openfoam"},
    {"S12", [] { return for_flow([](CornerPointGrid& g) { g.unit_system.clear(); }); }, ready_for_flow, "flow"},
};

}  // namespace

std::span<const Fixture> grid_fixtures() { return fixtures; }

}  // namespace geomend::testing
