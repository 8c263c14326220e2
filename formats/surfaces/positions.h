// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/vec3.h"

namespace geomend::surfaces {

/// Numbers positions from 0, the very same position once; 0.0 and -0.0 are the same. Cost: a look into a table each.
class PositionNumbers {
public:
    std::uint32_t number(const Vec3& p);
    const std::vector<Vec3>& positions() const { return positions_; }

private:
    struct Hash {
        std::size_t operator()(const std::array<std::uint64_t, 3>& bits) const;
    };
    std::unordered_map<std::array<std::uint64_t, 3>, std::uint32_t, Hash> number_;
    std::vector<Vec3> positions_;
};

}  // namespace geomend::surfaces
