// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "model/coordinate_system.h"
#include "model/feature.h"

// What a report may draw of a file. All positions are elevation-up.

namespace geomend {

/// What a repair did to a part, as far as that makes it a part of its own.
enum class PartChange : std::uint8_t {
    none,
    added,    ///< triangles of the result that were not there
    cut,      ///< lines of the result at which something was cut
    joined,   ///< lines of the result where borders became one
    removed,  ///< triangles that were left out
    erased    ///< lines that nothing needed any more
};
/// "added", "cut", ...; "none".
const char* to_string(PartChange change);

/// One thing of a model as triangles, lines or points. A part without triangles and lines is drawn as points.
struct ScenePart {
    std::string kind;  ///< as in EntityRef: surface, line, corner, corner-point-grid, ...
    std::string name;
    std::int64_t id = -1;
    FeatureRole role = FeatureRole::unknown;
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::vector<std::uint32_t>> polylines;
    PartChange change = PartChange::none;
    std::vector<float> moved;  ///< per point how far a repair moved it; empty: nowhere
};

/// Where a finding is: its points and lines, and the elements that it lists.
struct SceneMark {
    std::vector<Vec3> points;
    std::vector<std::vector<Vec3>> polylines;
    std::vector<std::array<Vec3, 3>> triangles;
    std::vector<std::vector<Vec3>> outlines;  ///< edges of the elements whose triangles those are; closed ones repeat their first point
    bool empty() const { return points.empty() && polylines.empty() && triangles.empty() && outlines.empty(); }
};

struct Scene {
    std::vector<ScenePart> parts;
    std::vector<SceneMark> marks;  ///< of each finding, in their order
    CoordinateSystem crs;          ///< of the first object
    Vec3 origin{};                 ///< near the middle; pages store positions relative to it, in single precision
    std::size_t triangles = 0;     ///< before thin() took some away
    bool simplified = false;
};

/// Sets `origin` and `triangles` of a scene whose parts are complete.
void finish(Scene& scene);

/// Where a scene has more triangles, puts points that lie in one box of a lattice together, in all parts alike, so that
/// what fits stays fitting, and drops the triangles and lines that collapse. The lattice is as fine as the bound allows,
/// by about a quarter. Of points that come together the one that moved farthest tells how far. Marks stay as they are. Cost: linear, some
/// ten times.
void thin(Scene& scene, std::size_t most_triangles);

}  // namespace geomend
