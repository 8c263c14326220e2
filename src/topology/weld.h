// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec3.h"
#include "model/objects.h"

namespace geomend::topology {

/// Gives equal positions one number (zero distance; -0 equals 0), in the order in which they come.
/// Cost: a constant per point; 4 to 8 bytes per vertex besides the positions.
class Welder {
public:
    /// \param expected how many points will come at most; more are allowed
    explicit Welder(std::size_t expected);

    /// The number of the vertex at a position, new or known.
    std::uint32_t add(const Vec3& position);
    /// The number of the vertex at a position, or no_index.
    std::uint32_t find(const Vec3& position) const;

    const std::vector<Vec3>& positions() const { return positions_; }
    std::vector<Vec3> take_positions() { return std::move(positions_); }

private:
    std::size_t slot_of(const Vec3& position) const;
    void grow();

    std::vector<Vec3> positions_;
    std::vector<std::uint32_t> slots_;
};

}  // namespace geomend::topology
