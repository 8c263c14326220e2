// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/vec3.h"
#include "model/triangle_soup.h"

// What steps leave out of the surfaces that were read.

namespace geomend::repair {

struct SurfaceModel;

/// Why a triangle was left out.
enum class Removal : std::uint8_t { no_area, doubled, stray, overlap, tail, outside, edited, beyond, micro };
/// One word for names of files: "no-area", "double", "stray", "overlap", "tail", "outside", "edited", "beyond", "micro".
std::string_view word_of(Removal why);
/// A sentence without a full stop: "it sticks through another surface by less than the limit".
std::string_view reason_of(Removal why);

/// A triangle that was left out, as it was then.
struct RemovedTriangle {
    std::array<Vec3, 3> corners;
    std::uint32_t patch = 0;
    Removal why = Removal::no_area;
    std::string_view step;  ///< of surface_steps(), as the driver names it
};

/// Whether a step made a triangle of the soup, from nothing or beside a border: a side of a box, a strip, the filling of a hole.
bool is_added(const SurfaceModel& model, std::uint32_t triangle);
/// Says so of all triangles of the soup from a number on. Linear.
void mark_added(SurfaceModel& model, std::uint32_t first_triangle);

/// Notes triangles of the soup as left out, but for those that a step made: they were not in what was read.
void note_removed(SurfaceModel& model, std::span<const std::uint32_t> triangles, Removal why);
/// The same for all that are not kept and are not noted yet. \param keep per triangle  \param noted per triangle 0 where it is noted;
/// becomes `keep`
void note_removed(SurfaceModel& model, std::span<const std::uint8_t> keep, std::vector<std::uint8_t>& noted, Removal why);

/// Triangles that were left out for one reason and hang together.
struct RemovedPiece {
    std::string_view step;
    Removal why = Removal::no_area;
    std::uint32_t patch = 0;
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
};
/// In pieces over common edges, in the order in which their first triangles were left out. n log n.
std::vector<RemovedPiece> removed_pieces(std::span<const RemovedTriangle> removed);

}  // namespace geomend::repair
