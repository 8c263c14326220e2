// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/near_weld.h"

#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "base/disjoint_sets.h"
#include "geometry/cell_volume.h"
#include "model/objects.h"

namespace geomend::topology {

namespace {

/// Positions in cubes much larger than the tolerance, so that most of them need to look into one cube only.
class Cubes {
public:
    Cubes(std::span<const Vec3> positions, double size) : positions_(positions), size_(size) {
        slots_.assign(std::bit_ceil(positions.size() + positions.size() / 2 + 16), no_index);
        next_.assign(positions.size(), no_index);
    }
    using Cube = std::array<std::int64_t, 3>;
    Cube cube(const Vec3& p) const {
        Cube c;
        for (std::size_t k = 0; k < 3; ++k) c[k] = std::llround(std::floor((p[k] - positions_[0][k]) / size_));
        return c;
    }
    std::uint32_t first(const Cube& c) const { return slots_[slot_of(c)]; }
    std::uint32_t next(std::uint32_t i) const { return next_[i]; }
    void add(std::uint32_t i) {
        std::uint32_t& head = slots_[slot_of(cube(positions_[i]))];
        next_[i] = head;
        head = i;
    }

private:
    std::size_t slot_of(const Cube& c) const {
        std::uint64_t h = 0x9e3779b97f4a7c15u;
        for (const std::int64_t x : c) {
            h ^= static_cast<std::uint64_t>(x);
            h *= 0xff51afd7ed558ccdu;
            h ^= h >> 32;
        }
        std::size_t slot = h & (slots_.size() - 1);
        while (slots_[slot] != no_index && cube(positions_[slots_[slot]]) != c) slot = (slot + 1) & (slots_.size() - 1);
        return slot;
    }

    std::span<const Vec3> positions_;
    double size_;
    std::vector<std::uint32_t> slots_, next_;
};

}  // namespace

std::vector<std::uint32_t> clusters_within(std::span<const Vec3> positions, double tolerance) {
    if (positions.empty()) return {};
    DisjointSets clusters(positions.size());
    Cubes cubes(positions, 64 * tolerance);
    const double square = tolerance * tolerance;
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
        const Vec3& p = positions[i];
        Vec3 low = p, high = p;
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] -= tolerance;
            high[k] += tolerance;
        }
        const auto from = cubes.cube(low), to = cubes.cube(high);
        for (auto x = from[0]; x <= to[0]; ++x) {
            for (auto y = from[1]; y <= to[1]; ++y) {
                for (auto z = from[2]; z <= to[2]; ++z) {
                    for (std::uint32_t j = cubes.first({x, y, z}); j != no_index; j = cubes.next(j)) {
                        const Vec3 d = minus(p, positions[j]);
                        if (dot(d, d) <= square) clusters.join(i, j);
                    }
                }
            }
        }
        cubes.add(i);
    }
    return std::move(clusters).roots();
}

}  // namespace geomend::topology
