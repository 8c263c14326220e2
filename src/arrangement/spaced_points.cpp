// SPDX-License-Identifier: AGPL-3.0-or-later
#include "arrangement/spaced_points.h"

#include <array>
#include <bit>
#include <cmath>

#include "base/cell_number.h"
#include "geometry/vectors.h"

namespace geomend::arrangement {

namespace {

constexpr std::uint32_t nobody = 0xffffffffu;
constexpr double cell_in_distances = 64;  // so that few points are near the side of their cell

std::uint64_t mixed(std::uint64_t h) {
    h ^= h >> 32;
    h *= 0x9e3779b97f4a7c15u;
    return h ^ h >> 29;
}

/// Different cells may have one key: their points are then looked at, too, which does no harm.
std::uint64_t cell_key(std::int64_t x, std::int64_t y, std::int64_t z) {
    const auto part = [](std::int64_t v) { return static_cast<std::uint64_t>(v); };
    return mixed(part(x) * 0x8da6b343u ^ mixed(part(y) * 0xd8163841u ^ mixed(part(z) + 0x7f4a7c15u))) | 1u;
}

}  // namespace

SpacedPoints::SpacedPoints(double distance, std::size_t expected) : distance_(distance), cell_(distance * cell_in_distances) {
    points_.reserve(expected);
    next_.reserve(expected);
    const std::size_t size = std::bit_ceil(2 * expected + 16);
    keys_.assign(size, 0);
    heads_.assign(size, nobody);
    mask_ = size - 1;
}

std::size_t SpacedPoints::slot_of(std::uint64_t key) const {
    std::size_t slot = static_cast<std::size_t>(key >> 1) & mask_;
    while (keys_[slot] != 0 && keys_[slot] != key) slot = (slot + 1) & mask_;
    return slot;
}

void SpacedPoints::grow() {
    const std::vector<std::uint64_t> keys = std::move(keys_);
    const std::vector<std::uint32_t> heads = std::move(heads_);
    const std::size_t size = 2 * (mask_ + 1);
    keys_.assign(size, 0);
    heads_.assign(size, nobody);
    mask_ = size - 1;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (keys[i] == 0) continue;
        const std::size_t slot = slot_of(keys[i]);
        keys_[slot] = keys[i];
        heads_[slot] = heads[i];
    }
}

std::uint32_t SpacedPoints::nearest(const Vec3& point, double distance) const {
    std::array<std::int64_t, 3> low{}, high{};
    for (std::size_t k = 0; k < 3; ++k) {
        low[k] = cell_number((point[k] - distance) / cell_);
        high[k] = cell_number((point[k] + distance) / cell_);
    }
    std::uint32_t nearest = nobody;
    double least = distance * distance;
    for (std::int64_t x = low[0]; x <= high[0]; ++x) {
        for (std::int64_t y = low[1]; y <= high[1]; ++y) {
            for (std::int64_t z = low[2]; z <= high[2]; ++z) {
                for (std::uint32_t p = heads_[slot_of(cell_key(x, y, z))]; p != nobody; p = next_[p]) {
                    const Vec3 d = minus(points_[p], point);
                    const double square = dot(d, d);
                    if (square < least || (square == least && square < distance * distance && p < nearest)) {
                        least = square;
                        nearest = p;
                    }
                }
            }
        }
    }
    return nearest;
}

/// Into the cell of its place, so that it is found there.
void SpacedPoints::enter(std::uint32_t number) {
    if (2 * ++cells_ > mask_) grow();
    std::array<std::int64_t, 3> own{};
    for (std::size_t k = 0; k < 3; ++k) own[k] = cell_number(points_[number][k] / cell_);
    const std::uint64_t key = cell_key(own[0], own[1], own[2]);
    const std::size_t slot = slot_of(key);
    keys_[slot] = key;
    next_[number] = heads_[slot];
    heads_[slot] = number;
}

std::uint32_t SpacedPoints::add(const Vec3& point, double distance) {
    const std::uint32_t near = nearest(point, distance);
    if (near != nobody) return near;
    const auto number = static_cast<std::uint32_t>(points_.size());
    points_.push_back(point);
    next_.push_back(nobody);
    enter(number);
    return number;
}

std::vector<std::uint32_t> SpacedPoints::move(const std::vector<Move>& moves, const std::vector<std::uint8_t>& is_used) {
    std::fill(keys_.begin(), keys_.end(), 0);
    std::fill(heads_.begin(), heads_.end(), nobody);
    cells_ = 0;
    std::vector<std::uint8_t> moved(points_.size(), 0);
    for (const Move& m : moves) {
        moved[m.point] = 1;
        points_[m.point] = m.to;
    }
    std::vector<std::uint32_t> becomes(points_.size());
    for (std::uint32_t p = 0; p < becomes.size(); ++p) {
        becomes[p] = p;
        if (is_used[p] != 0 && moved[p] == 0) enter(p);
    }
    for (std::uint32_t p = 0; p < becomes.size(); ++p) {
        if (is_used[p] == 0 || moved[p] == 0) continue;
        const std::uint32_t near = nearest(points_[p], distance_);
        if (near == nobody) enter(p);
        else becomes[p] = near;
    }
    return becomes;
}

}  // namespace geomend::arrangement
