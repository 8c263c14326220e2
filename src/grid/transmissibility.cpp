// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/transmissibility.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "geometry/cell_volume.h"
#include "grid/cell_geometry.h"
#include "grid/map_axes.h"
#include "grid/multipliers.h"

namespace geomend::grid {

namespace {

constexpr double millidarcy = 9.869232667160130e-16;  // m2

// Corners of each face of a cell, in CellFace order, round the face.
constexpr std::array<std::array<unsigned, 4>, 6> face_corners{
    {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}}};

CellFace opposite(CellFace face) { return static_cast<CellFace>(static_cast<unsigned>(face) ^ 1u); }

Vec3 vector_area(std::span<const Vec3> polygon) {
    Vec3 sum{};
    for (std::size_t c = 1; c + 1 < polygon.size(); ++c) {
        const Vec3 n = cross(minus(polygon[c], polygon[0]), minus(polygon[c + 1], polygon[0]));
        for (std::size_t d = 0; d < 3; ++d) sum[d] += n[d] / 2;
    }
    return sum;
}

struct Worker {
    const CornerPointGrid& grid;
    std::span<const std::uint8_t> present;
    std::array<std::vector<double>, 3> permeability;
    std::vector<double> net_to_gross;
    Multipliers multipliers;
    double factor;

    double half(const Corners& corners, CellFace face, const Vec3& area, std::size_t cell) const {
        Vec3 d{};
        for (const unsigned c : face_corners[static_cast<std::size_t>(face)]) {
            for (std::size_t a = 0; a < 3; ++a) d[a] += corners[c][a] / 4;
        }
        d = minus(d, centre(corners));
        const double squared = dot(d, d);
        if (squared == 0) return 0;
        double value = permeability[static_cast<std::size_t>(face) / 2][cell] * std::abs(dot(area, d)) / squared;
        if (face < CellFace::k_minus && !net_to_gross.empty()) value *= net_to_gross[cell];
        return value;
    }

    double connection(std::size_t first, std::size_t second, CellFace face, const Vec3& area, bool neighbours) const {
        const auto a = grid.ijk(first), b = grid.ijk(second);
        const double one = half(cell_corners(grid, a[0], a[1], a[2]), face, area, first);
        const double two = half(cell_corners(grid, b[0], b[1], b[2]), opposite(face), area, second);
        if (one <= 0 || two <= 0) return 0;
        const double own = face == CellFace::k_plus ? downwards(first, second) : multipliers.of_face(first, face);
        return factor / (1 / one + 1 / two) * own * multipliers.of_face(second, opposite(face)) *
               multipliers.between(first, second, face, neighbours);
    }

    // MULTZ of the upper cell, or with ALL the least down to the lower one.
    double downwards(std::size_t upper, std::size_t lower) const {
        double value = multipliers.of_face(upper, CellFace::k_plus);
        if (!grid.pinch || !grid.pinch->multiplier_of_all) return value;
        const std::size_t layer = std::size_t{grid.dims[0]} * grid.dims[1];
        for (std::size_t cell = upper + layer; cell < lower; cell += layer)
            value = std::min(value, multipliers.of_face(cell, CellFace::k_plus));
        return value;
    }

    // Down to the next cell that is there, with the area of the upper one.
    double vertical(std::size_t upper, std::size_t lower) const {
        return connection(upper, lower, CellFace::k_plus, bottom_area(upper), lower == upper + std::size_t{grid.dims[0]} * grid.dims[1]);
    }

    Vec3 side_area(const ColumnPair& pair, const Side& one, const Side& two, std::uint32_t k) const {
        const double* set = grid.pillars.data() + 6 * pillar_count(grid.dims) * (grid.reservoirs.empty() ? 0 : pillar_set(grid, k));
        const auto at = [&](int pillar, double depth) {
            return pillar_point(set + 6 * (pillar == 0 ? pair.pillar_a : pair.pillar_b), depth, grid.cylindrical);
        };
        const Overlap shared = overlap(one, two);
        std::array<Vec3, 6> points;
        for (std::uint32_t c = 0; c < shared.count; ++c) points[c] = position(shared.corners[c], at);
        return vector_area({points.data(), shared.count});
    }

    Vec3 bottom_area(std::size_t cell) const {
        const auto [i, j, k] = grid.ijk(cell);
        const Corners p = cell_corners(grid, i, j, k);
        return vector_area(std::array{p[4], p[5], p[7], p[6]});
    }
};

void side_values(const Worker& worker, std::uint32_t j, PairSides& sides, Transmissibilities& to, std::vector<double>& along_i,
                 std::vector<double>& along_j) {
    const CornerPointGrid& grid = worker.grid;
    const std::size_t layer = std::size_t{grid.dims[0]} * grid.dims[1];
    each_pair_of_row(grid, j, [&](const ColumnPair& pair) {
        load(grid, worker.present, pair, sides);
        const std::size_t first = grid.cell(pair.i, pair.j, 0), second = first + (pair.along_i ? 1 : grid.dims[0]);
        const CellFace face = pair.along_i ? CellFace::i_plus : CellFace::j_plus;
        each_contact(sides, [&](std::uint32_t k, std::uint32_t m) {
            if (!grid.reservoirs.empty() && pillar_set(grid, k) != pillar_set(grid, m)) return;
            const Vec3 area = worker.side_area(pair, sides.first[k], sides.second[m], k);
            const double value = worker.connection(first + k * layer, second + m * layer, face, area, k == m);
            if (k == m) (pair.along_i ? to.x : to.y)[first + k * layer] = value;
            else (pair.along_i ? along_i : along_j).push_back(value);
        });
    });
}

// A deck may state its grid in another unit than its own; without a deck the unit of the grid tells the system.
double factor_of(const CornerPointGrid& grid) {
    const double own = metres(grid.info.crs.axis_units[0]);
    if (grid.unit_system.empty()) return transmissibility_factor(own == 0.3048 ? "FIELD" : own == 0.01 ? "LAB" : "METRIC");
    const double deck = grid.unit_system == "FIELD" ? 0.3048 : grid.unit_system == "LAB" ? 0.01 : 1.0;
    return transmissibility_factor(grid.unit_system) * (own == 0 ? 1.0 : own / deck);
}

}  // namespace

double transmissibility_factor(std::string_view unit_system) {
    constexpr double day = 86400, centipoise = 1e-3;
    if (unit_system == "FIELD") return millidarcy * 0.3048 / (centipoise * 0.158987294928 / (day * 6894.757293168361));
    if (unit_system == "LAB") return millidarcy * 0.01 / (centipoise * 1e-6 / (3600 * 101325.0));
    if (unit_system == "PVT-M") return millidarcy / (centipoise / (day * 101325.0));
    return millidarcy / (centipoise / (day * 1e5));
}

std::vector<double> cell_values(const CornerPointGrid& grid, std::string_view name, double fallback) {
    const Attribute* a = find_attribute(grid.info.attributes, std::string(name), AttributeLocation::cell);
    std::vector<double> values;
    if (a == nullptr || value_count(*a) != grid.cell_count()) return values;
    values.resize(grid.cell_count());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double v = value_as_double(*a, i);
        values[i] = std::isnan(v) || is_no_data(*a, v) ? fallback : v;
    }
    return values;
}

Result<Transmissibilities> transmissibilities(const CornerPointGrid& grid, const Connections& connections) {
    std::array permeability{cell_values(grid, "PERMX", 0.0), cell_values(grid, "PERMY", 0.0), cell_values(grid, "PERMZ", 0.0)};
    if (permeability[0].empty())
        return unreadable("F007", {}, "grid '" + grid.info.name + "' has no attribute PERMX: transmissibilities need permeabilities");
    for (std::size_t d = 1; d < 3; ++d) {
        if (permeability[d].empty()) permeability[d] = permeability[0];
    }
    const Worker worker{grid,           connections.present, std::move(permeability), cell_values(grid, "NTG", 1.0), Multipliers(grid),
                        factor_of(grid)};
    Transmissibilities result;
    for (auto* values : {&result.x, &result.y, &result.z}) values->assign(grid.cell_count(), 0.0);
    std::vector<std::vector<double>> along_i(grid.dims[1]), along_j(grid.dims[1]);
    parallel_blocks(grid.dims[1], 1, [&](std::size_t first, std::size_t last) {
        PairSides sides;
        for (std::size_t j = first; j < last; ++j)
            side_values(worker, static_cast<std::uint32_t>(j), sides, result, along_i[j], along_j[j]);
    });
    parallel_blocks(grid.cell_count(), 4096, [&](std::size_t first, std::size_t last) {
        for (std::size_t cell = first; cell < last; ++cell) {
            if ((connections.neighbours[cell] & Connections::below) == 0) continue;
            const std::size_t below = next_below(grid, connections.present, cell);
            // Layers between that are no cells block the flow, unless PINCH bridges them.
            if (below != cell + std::size_t{grid.dims[0]} * grid.dims[1] && !grid.pinch) continue;
            result.z[cell] = worker.vertical(cell, below);
        }
    });
    for (const auto& [upper, lower] : connections.bridges) result.z[upper] = worker.vertical(upper, lower);
    for (const auto* parts : {&along_i, &along_j}) {
        for (const auto& part : *parts) result.others.insert(result.others.end(), part.begin(), part.end());
    }
    return result;
}

}  // namespace geomend::grid
