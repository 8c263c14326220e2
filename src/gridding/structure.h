// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "base/vec3.h"
#include "gridding/plan.h"
#include "model/triangle_soup.h"

// A structural model as the gridder sees it: horizons from top to base and faults. Positions are depth-down: x, y, depth.

namespace geomend::gridding {

/// Depths on a regular lattice in plan: sample (i,j) stands at origin + i step[0] + j step[1] and is number i + nx j.
struct HorizonMap {
    std::array<std::uint32_t, 2> dims{0, 0};
    Point origin{};
    std::array<Point, 2> step{};
    std::vector<double> depths;  ///< NaN where there is none
};

/// Triangles.
struct Sheet {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
};

struct Horizon {
    std::string name;
    std::variant<HorizonMap, Sheet> shape;
    bool erodes = false;     ///< cuts off what lies below it
    bool is_lapped = false;  ///< cuts off what lies above it
};

/// A fault: triangles, or lines in plan, or both.
struct Fault {
    std::string name;
    Path trace;   ///< at mid level; what the chain of the grid follows
    Sheet sheet;  ///< empty where only lines are known
    /// Per horizon the ring around where it is torn apart, and the line in its middle; empty: not known. Empty as a whole, too.
    std::vector<Path> polygons, traces;
};

struct Structure {
    std::vector<Horizon> horizons;  ///< from top to base
    std::vector<Fault> faults;
};

}  // namespace geomend::gridding
