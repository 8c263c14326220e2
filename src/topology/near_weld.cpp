// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/near_weld.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "base/cell_number.h"
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
        tags_.assign(slots_.size(), 0);
        next_.assign(positions.size(), no_index);
    }
    using Cube = std::array<std::int64_t, 3>;
    Cube cube(const Vec3& p) const {
        Cube c;
        for (std::size_t k = 0; k < 3; ++k) c[k] = cell_number((p[k] - positions_[0][k]) / size_);
        return c;
    }
    std::uint32_t first(const Cube& c) const { return slots_[slot_of(c, hash_of(c))]; }
    std::uint32_t next(std::uint32_t i) const { return next_[i]; }
    void add(std::uint32_t i) {
        const Cube c = cube(positions_[i]);
        const std::uint64_t hash = hash_of(c);
        const std::size_t slot = slot_of(c, hash);
        next_[i] = slots_[slot];
        slots_[slot] = i;
        tags_[slot] = tag_of(hash);
    }

private:
    static std::uint64_t hash_of(const Cube& c) {
        std::uint64_t h = 0x9e3779b97f4a7c15u;
        for (const std::int64_t x : c) {
            h ^= static_cast<std::uint64_t>(x);
            h *= 0xff51afd7ed558ccdu;
            h ^= h >> 32;
        }
        return h;
    }
    static std::uint8_t tag_of(std::uint64_t hash) { return static_cast<std::uint8_t>(hash >> 56); }
    std::size_t slot_of(const Cube& c, std::uint64_t hash) const {
        std::size_t slot = hash & (slots_.size() - 1);
        const std::uint8_t tag = tag_of(hash);
        while (slots_[slot] != no_index && (tags_[slot] != tag || cube(positions_[slots_[slot]]) != c))
            slot = (slot + 1) & (slots_.size() - 1);
        return slot;
    }

    std::span<const Vec3> positions_;
    double size_;
    std::vector<std::uint32_t> slots_, next_;
    std::vector<std::uint8_t> tags_;  // a part of the hash, so that other cubes are seldom looked at
};

/// A size of cubes for which the number of a cube fits in 64 bits, whatever the tolerance.
double cube_size(std::span<const Vec3> positions, double wanted) {
    double farthest = 0;
    for (const Vec3& p : positions) {
        for (std::size_t k = 0; k < 3; ++k) farthest = std::max(farthest, std::abs(p[k] - positions[0][k]));
    }
    return std::max(wanted, 1e-15 * farthest);
}

/// Joins each position with the earlier ones near it. False where too many lie in one cube to compare them all.
bool join_by_pairs(std::span<const Vec3> positions, double tolerance, DisjointSets& clusters) {
    Cubes cubes(positions, cube_size(positions, 64 * tolerance));
    const double square = tolerance * tolerance;
    std::uint64_t left = 1000000 + 32 * std::uint64_t{positions.size()};
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
                        if (left-- == 0) return false;
                        const Vec3 d = minus(p, positions[j]);
                        if (dot(d, d) <= square) clusters.join(i, j);
                    }
                }
            }
        }
        cubes.add(i);
    }
    return true;
}

/// What lies in one small cube.
struct Crowd {
    Vec3 low, high;
    std::uint32_t first;  // position; the others follow it in the chain of its cube
};

bool may_be_near(const Crowd& a, const Crowd& b, double square) {
    double apart = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double gap = std::max({0.0, a.low[k] - b.high[k], b.low[k] - a.high[k]});
        apart += gap * gap;
    }
    return apart <= square;
}

/// The same where many positions lie near each other: cubes are so small that all positions in one are near each other, and
/// of two cubes one pair of near positions is enough.
void join_by_cubes(std::span<const Vec3> positions, double tolerance, DisjointSets& clusters) {
    const double size = cube_size(positions, 0.57 * tolerance), square = tolerance * tolerance;  // 0.57 < 1 / sqrt(3)
    const bool one_cluster_each = size < 0.58 * tolerance;
    Cubes cubes(positions, size);
    std::vector<std::uint32_t> crowd_of(positions.size(), no_index);  // per position that heads the chain of its cube
    std::vector<Crowd> crowds;
    for (std::uint32_t i = 0; i < positions.size(); ++i) cubes.add(i);
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
        const std::uint32_t head = cubes.first(cubes.cube(positions[i]));
        if (crowd_of[head] == no_index) {
            crowd_of[head] = static_cast<std::uint32_t>(crowds.size());
            crowds.push_back({positions[head], positions[head], head});
        }
        Crowd& crowd = crowds[crowd_of[head]];
        for (std::size_t k = 0; k < 3; ++k) {
            crowd.low[k] = std::min(crowd.low[k], positions[i][k]);
            crowd.high[k] = std::max(crowd.high[k], positions[i][k]);
        }
        if (one_cluster_each) clusters.join(head, i);
    }
    const auto join_two = [&](const Crowd& a, const Crowd& b) {
        if ((one_cluster_each && clusters.root(a.first) == clusters.root(b.first)) || !may_be_near(a, b, square)) return;
        for (std::uint32_t i = a.first; i != no_index; i = cubes.next(i)) {
            for (std::uint32_t j = b.first; j != no_index; j = cubes.next(j)) {
                const Vec3 d = minus(positions[i], positions[j]);
                if (dot(d, d) > square) continue;
                clusters.join(i, j);
                if (one_cluster_each) return;
            }
        }
    };
    const std::int64_t reach = one_cluster_each ? 2 : 1;
    for (const Crowd& crowd : crowds) {
        if (!one_cluster_each) join_two(crowd, crowd);
        const auto [x, y, z] = cubes.cube(positions[crowd.first]);
        for (std::int64_t i = -reach; i <= reach; ++i) {
            for (std::int64_t j = -reach; j <= reach; ++j) {
                for (std::int64_t k = -reach; k <= reach; ++k) {
                    if (std::array{i, j, k} <= std::array<std::int64_t, 3>{0, 0, 0}) continue;  // the other one looks here
                    const std::uint32_t other = cubes.first({x + i, y + j, z + k});
                    if (other != no_index) join_two(crowd, crowds[crowd_of[other]]);
                }
            }
        }
    }
}

}  // namespace

std::vector<std::uint32_t> clusters_within(std::span<const Vec3> positions, double tolerance) {
    if (positions.empty()) return {};
    DisjointSets clusters(positions.size());
    if (!join_by_pairs(positions, tolerance, clusters)) join_by_cubes(positions, tolerance, clusters);
    return std::move(clusters).roots();
}

}  // namespace geomend::topology
