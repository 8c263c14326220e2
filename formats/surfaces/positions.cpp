// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/surfaces/positions.h"

#include <bit>

namespace geomend::surfaces {

std::size_t PositionNumbers::Hash::operator()(const std::array<std::uint64_t, 3>& bits) const {
    std::uint64_t h = 0;
    for (const std::uint64_t b : bits) {
        h = (h ^ b) * 0x9e3779b97f4a7c15u;
        h ^= h >> 29;
    }
    return static_cast<std::size_t>(h);
}

std::uint32_t PositionNumbers::number(const Vec3& p) {
    std::array<std::uint64_t, 3> bits{};
    for (std::size_t k = 0; k < 3; ++k) bits[k] = std::bit_cast<std::uint64_t>(p[k] + 0.0);
    const auto [at, is_new] = number_.try_emplace(bits, static_cast<std::uint32_t>(positions_.size()));
    if (is_new) positions_.push_back(p);
    return at->second;
}

}  // namespace geomend::surfaces
