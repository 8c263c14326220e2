// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/map_volumes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "gridding/horizon_reader.h"

namespace geomend::gridding {

namespace {

constexpr int places = 4;  // along each side of a column

bool has_active(const CornerPointGrid& grid, const ZoneReport& zone, std::uint32_t i, std::uint32_t j) {
    for (std::uint32_t k = zone.first_layer; k <= zone.last_layer; ++k) {
        if (grid.is_active(grid.cell(i, j, k))) return true;
    }
    return false;
}

/// How thick a zone of a grid is in a column, at shares of its sides: as corners of cells have it, straight between them.
double thickness_at(const CornerPointGrid& grid, const ZoneReport& zone, std::uint32_t i, std::uint32_t j, double u, double v) {
    double thickness = 0;
    for (unsigned c = 0; c < 4; ++c) {
        const double top = grid.depths[corner_index(grid.dims, i, j, zone.first_layer, c)];
        const double base = grid.depths[corner_index(grid.dims, i, j, zone.last_layer, c + 4)];
        thickness += ((c & 1) != 0 ? u : 1 - u) * ((c >> 1) != 0 ? v : 1 - v) * (base - top);
    }
    return thickness;
}

/// A place in a column, by shares of its sides, and the area that stands for it.
struct Place {
    Point at;
    double area;
};

Place place_in(const std::array<Point, 4>& p, double u, double v) {
    Place place{};
    std::array<Point, 2> d{};
    for (std::size_t a = 0; a < 2; ++a) {
        place.at[a] = (1 - v) * ((1 - u) * p[0][a] + u * p[1][a]) + v * ((1 - u) * p[2][a] + u * p[3][a]);
        d[0][a] = (1 - v) * (p[1][a] - p[0][a]) + v * (p[3][a] - p[2][a]);
        d[1][a] = (1 - u) * (p[2][a] - p[0][a]) + u * (p[3][a] - p[1][a]);
    }
    place.area = std::abs(d[0][0] * d[1][1] - d[0][1] * d[1][0]) / (places * places);
    return place;
}

}  // namespace

std::vector<MapVolume> map_volumes(const Structure& structure, const CornerPointGrid& grid, std::span<const ZoneReport> zones) {
    std::vector<MapReader> readers;
    for (const Horizon& horizon : structure.horizons) {
        const auto* map = std::get_if<HorizonMap>(&horizon.shape);
        if (map == nullptr) return {};
        readers.emplace_back(*map);
    }
    for (std::size_t p = 0; p < grid.pillars.size(); p += 6) {
        if (grid.pillars[p] != grid.pillars[p + 3] || grid.pillars[p + 1] != grid.pillars[p + 4]) return {};
    }
    std::vector<MapVolume> sums(grid.dims[1] * zones.size());
    parallel_for_each_index(grid.dims[1], [&](std::size_t j) {
        std::vector<Hit> top, base;
        for (std::uint32_t i = 0; i < grid.dims[0]; ++i) {
            std::array<Point, 4> corners{};
            for (std::size_t c = 0; c < 4; ++c) {
                const double* p = grid.pillars.data() + 6 * (i + (c & 1) + (std::size_t{grid.dims[0]} + 1) * (j + (c >> 1)));
                corners[c] = {p[0], p[1]};
            }
            for (std::size_t z = 0; z < zones.size(); ++z) {
                if (!has_active(grid, zones[z], i, static_cast<std::uint32_t>(j))) continue;
                for (int n = 0; n < places * places; ++n) {
                    const double u = (n % places + 0.5) / places, v = (n / places + 0.5) / places;
                    const Place place = place_in(corners, u, v);
                    top.clear();
                    base.clear();
                    readers[z].hits(place.at, top);
                    readers[z + 1].hits(place.at, base);
                    if (top.empty() || base.empty()) continue;
                    MapVolume& sum = sums[z + zones.size() * j];
                    sum.maps += place.area * std::max(0.0, base[0].depth - top[0].depth);
                    sum.grid += place.area * thickness_at(grid, zones[z], i, static_cast<std::uint32_t>(j), u, v);
                }
            }
        }
    });
    std::vector<MapVolume> volumes(zones.size());
    for (std::size_t n = 0; n < sums.size(); ++n) {
        volumes[n % zones.size()].maps += sums[n].maps;
        volumes[n % zones.size()].grid += sums[n].grid;
    }
    return volumes;
}

}  // namespace geomend::gridding
