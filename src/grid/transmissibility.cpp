// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/transmissibility.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>
#include <type_traits>

#include "base/big_array.h"
#include "base/parallel.h"
#include "grid/half_cells.h"
#include "grid/map_axes.h"
#include "grid/multipliers.h"

namespace geomend::grid {

namespace {

constexpr double millidarcy = 9.869232667160130e-16;  // m2

CellFace opposite(CellFace face) { return static_cast<CellFace>(static_cast<unsigned>(face) ^ 1u); }

Vec3 vector_area_of(std::span<const Vec3> polygon) {
    Vec3 sum{};
    for (std::size_t c = 1; c + 1 < polygon.size(); ++c) {
        const Vec3 n = cross(minus(polygon[c], polygon[0]), minus(polygon[c + 1], polygon[0]));
        for (std::size_t d = 0; d < 3; ++d) sum[d] += n[d] / 2;
    }
    return sum;
}

// One of the two cells of a connection.
struct Half {
    std::size_t cell;
    const HalfCells& shape;
};

/// Values of a cell attribute as doubles: those of the grid itself where it has them so and none is missing.
class CellValues {
public:
    CellValues(const CornerPointGrid& grid, std::string_view name, double fallback) {
        const Attribute* a = find_attribute(grid.info.attributes, std::string(name), AttributeLocation::cell);
        const auto* stored = a != nullptr ? std::get_if<std::vector<double>>(&a->values) : nullptr;
        if (stored != nullptr && stored->size() == grid.cell_count() && none_missing(*a, *stored)) {
            values_ = *stored;
            return;
        }
        own_ = cell_values(grid, name, fallback);
        values_ = own_;
    }
    CellValues(const CellValues&) = delete;
    CellValues& operator=(const CellValues&) = delete;
    bool empty() const { return values_.empty(); }
    double operator[](std::size_t cell) const { return values_[cell]; }

private:
    static bool none_missing(const Attribute& a, std::span<const double> values) {
        std::atomic<bool> any{false};
        parallel_blocks(values.size(), std::size_t{1} << 16, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                if (std::isnan(values[i]) || is_no_data(a, values[i])) return any.store(true, std::memory_order_relaxed);
            }
        });
        return !any.load();
    }

    std::vector<double> own_;
    std::span<const double> values_;
};

struct Worker {
    const CornerPointGrid& grid;
    CellValues permeability_x, permeability_y, permeability_z;  // y and z empty: as x
    CellValues net_to_gross;
    Multipliers multipliers;
    double factor;

    double permeability(std::size_t direction, std::size_t cell) const {
        const auto& own = direction == 0 ? permeability_x : direction == 1 ? permeability_y : permeability_z;
        return (own.empty() ? permeability_x : own)[cell];
    }

    double half(const Half& one, CellFace face, const Vec3& area) const {
        const auto f = static_cast<std::size_t>(face);
        const double squared = one.shape.arm_square[f];
        if (squared == 0) return 0;
        double value = permeability(f / 2, one.cell) * std::abs(dot(area, one.shape.arm[f])) / squared;
        if (face < CellFace::k_minus && !net_to_gross.empty()) value *= net_to_gross[one.cell];
        return value;
    }

    double connection(const Half& first, const Half& second, CellFace face, const Vec3& area, bool neighbours) const {
        const double one = half(first, face, area), two = half(second, opposite(face), area);
        if (one <= 0 || two <= 0) return 0;
        const double own = face == CellFace::k_plus ? downwards(first.cell, second.cell) : multipliers.of_face(first.cell, face);
        return factor / (1 / one + 1 / two) * own * multipliers.of_face(second.cell, opposite(face)) *
               multipliers.between(first.cell, second.cell, face, neighbours);
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
    double vertical(const Half& upper, const Half& lower) const {
        const Corners& p = upper.shape.corners;
        const bool neighbours = lower.cell == upper.cell + std::size_t{grid.dims[0]} * grid.dims[1];
        return connection(upper, lower, CellFace::k_plus, vector_area(p[4], p[5], p[7], p[6]), neighbours);
    }
    double vertical(std::size_t upper, std::size_t lower) const {
        const HalfCells above = shape_of(upper), below = shape_of(lower);
        return vertical({upper, above}, {lower, below});
    }

    HalfCells shape_of(std::size_t cell) const {
        const auto [i, j, k] = grid.ijk(cell);
        HalfCells shape;
        take_half_cells(grid, i, j, k, shape);
        return shape;
    }

    // Where the sides of two cells agree, what they share is the side of the first.
    double lateral(const Half& first, const Half& second, CellFace face, bool neighbours) const {
        const std::array<unsigned, 4> f = face == CellFace::i_plus ? std::array{1u, 3u, 7u, 5u} : std::array{2u, 3u, 7u, 6u};
        const std::array<unsigned, 4> b = face == CellFace::i_plus ? std::array{0u, 2u, 6u, 4u} : std::array{0u, 1u, 5u, 4u};
        const Corners &p = first.shape.corners, &q = second.shape.corners;
        const Side one{p[f[0]][2], p[f[1]][2], p[f[3]][2], p[f[2]][2]}, two{q[b[0]][2], q[b[1]][2], q[b[3]][2], q[b[2]][2]};
        const bool whole = one == two && one.upright();
        const Vec3 area = whole ? vector_area(p[f[0]], p[f[1]], p[f[2]], p[f[3]]) : shared_area(first.cell, face, one, two);
        return connection(first, second, face, area, neighbours);
    }
    double lateral(const NonNeighbour& pair) const {
        const HalfCells first = shape_of(pair.first), second = shape_of(pair.second);
        return lateral({pair.first, first}, {pair.second, second}, pair.face, false);
    }

    // Of the part that two sides share; `first` is the cell of the first one, `face` its i_plus or j_plus.
    Vec3 shared_area(std::size_t first, CellFace face, const Side& one, const Side& two) const {
        const auto [i, j, k] = grid.ijk(first);
        const std::size_t lines = std::size_t{grid.dims[0]} + 1, far = i + 1 + lines * (std::size_t{j} + 1);
        const std::size_t near = face == CellFace::i_plus ? far - lines : far - 1;
        const double* set = grid.pillars.data() + 6 * pillar_count(grid.dims) * (grid.reservoirs.empty() ? 0 : pillar_set(grid, k));
        const auto at = [&](int pillar, double depth) {
            return pillar_point(set + 6 * (pillar == 0 ? near : far), depth, grid.cylindrical);
        };
        const Overlap shared = overlap(one, two);
        std::array<Vec3, 6> points;
        for (std::uint32_t c = 0; c < shared.count; ++c) points[c] = position(shared.corners[c], at);
        return vector_area_of({points.data(), shared.count});
    }
};

// The values of the connections of one layer of a tile with neighbours in +I, +J and the next layer.
void layer_values(const Worker& worker, const Connections& connections, const Tile& tile, std::uint32_t k, const TileLayer& own,
                  const TileLayer& next, Transmissibilities& to) {
    const CornerPointGrid& grid = worker.grid;
    const std::size_t row = grid.dims[0], layer = row * grid.dims[1];
    for (std::uint32_t j = tile.first_j; j < tile.end_j; ++j) {
        std::size_t cell = grid.cell(tile.first_i, j, k);
        for (std::uint32_t i = tile.first_i; i < tile.end_i; ++i, ++cell) {
            const std::uint8_t neighbours = connections.neighbours[cell];
            const Half here{cell, own.at(i, j)};
            if ((neighbours & Connections::east) != 0)
                to.x[cell] = worker.lateral(here, {cell + 1, own.at(i + 1, j)}, CellFace::i_plus, true);
            if ((neighbours & Connections::south) != 0)
                to.y[cell] = worker.lateral(here, {cell + row, own.at(i, j + 1)}, CellFace::j_plus, true);
            if ((neighbours & Connections::below) == 0) continue;
            if (connections.present[cell + layer] != 0) to.z[cell] = worker.vertical(here, {cell + layer, next.at(i, j)});
            // Layers between that are no cells block the flow, unless PINCH bridges them.
            else if (grid.pinch) to.z[cell] = worker.vertical(cell, next_below(grid, connections.present, cell));
        }
    }
}

void tile_values(const Worker& worker, const Connections& connections, const Tile& tile, std::array<TileLayer, 2>& layers,
                 Transmissibilities& to) {
    const std::uint32_t count = worker.grid.dims[2];
    layers[0].fill(worker.grid, connections.present, tile, 0);
    for (std::uint32_t k = 0; k < count; ++k) {
        TileLayer &own = layers[k % 2], &next = layers[(k + 1) % 2];
        if (k + 1 < count) next.fill(worker.grid, connections.present, tile, k + 1);
        layer_values(worker, connections, tile, k, own, next, to);
    }
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
    make_big(values, grid.cell_count());
    const auto take = [&](const auto& from) {
        if constexpr (std::is_arithmetic_v<typename std::decay_t<decltype(from)>::value_type>) {
            parallel_blocks(values.size(), std::size_t{1} << 16, [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i) {
                    const auto v = static_cast<double>(from[i]);
                    values[i] = std::isnan(v) || is_no_data(*a, v) ? fallback : v;
                }
            });
        } else {
            std::ranges::fill(values, fallback);
        }
    };
    std::visit(take, a->values);
    return values;
}

Result<Transmissibilities> transmissibilities(const CornerPointGrid& grid, const Connections& connections) {
    const Worker worker{
        grid, {grid, "PERMX", 0.0}, {grid, "PERMY", 0.0}, {grid, "PERMZ", 0.0}, {grid, "NTG", 1.0}, Multipliers(grid), factor_of(grid)};
    if (worker.permeability_x.empty())
        return unreadable("F007", {}, "grid '" + grid.info.name + "' has no attribute PERMX: transmissibilities need permeabilities");
    Transmissibilities result;
    for (auto* values : {&result.x, &result.y, &result.z}) make_big(*values, grid.cell_count());
    parallel_blocks(Tile::count(grid), 1, [&](std::size_t first, std::size_t last) {
        std::array<TileLayer, 2> layers;
        for (std::size_t tile = first; tile < last; ++tile) tile_values(worker, connections, Tile(grid, tile), layers, result);
    });
    for (const auto& [upper, lower] : connections.bridges) result.z[upper] = worker.vertical(upper, lower);
    result.others.resize(connections.others.size());
    parallel_blocks(result.others.size(), 1024, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) result.others[n] = worker.lateral(connections.others[n]);
    });
    return result;
}

}  // namespace geomend::grid
