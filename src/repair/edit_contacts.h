// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "repair/surface_model.h"

namespace geomend::repair {

/// An edge at which a patch ends on other surfaces, and has to end on them again after these or itself have moved.
struct EndingEdge {
    std::uint32_t a, b;  ///< vertices
    std::uint32_t patch;
    std::vector<std::uint32_t> controllers;  ///< what it ends on: numbers of interfaces, ascending
};

/// Per patch a number of its interface.
struct InterfaceNumbers {
    std::vector<std::uint32_t> of;
    std::uint32_t count = 0;
};
InterfaceNumbers interface_numbers(const SurfaceModel& model);

/// What became of surfaces that were taken out of their contacts.
struct Detached {
    std::vector<EndingEdge> endings;                  ///< of what was moved, and of what ended on it
    std::vector<std::array<std::uint32_t, 2>> lines;  ///< edges that had both, as vertices, the lower one first, ascending
    std::vector<std::uint32_t> trace;                 ///< vertices of lines, ascending
    std::uint64_t moved = 0;                          ///< vertices
    /// Per group of what is replaced the interfaces that it ended on, ascending.
    std::map<std::uint32_t, std::vector<std::uint32_t>> replaced_endings;
};

/// What is to be done with a patch.
struct PatchEdit {
    bool taken_out = false;   ///< else it stays as it is
    bool removed = false;     ///< it goes for good
    bool replaced = false;    ///< ... and another patch of its interface takes its place
    Vec3 by{};                ///< else it is moved
    std::uint32_t group = 0;  ///< patches of one group move as one and keep what they have in common
};

/// Takes patches out of the soup and puts those that stay back, moved, with vertices of their own. Notes what they had in common with
/// the others: simplified contacts, in N. Euler's words (thesis, 5.3.1). Vertices that were there keep their numbers; edges embedded in
/// lines with what is taken out are left out. Cost: n log n. \param edits per patch
Detached detach(SurfaceModel& model, std::span<const PatchEdit> edits);

/// How borders were brought onto what they should end on.
struct Extended {
    std::uint64_t edges = 0, triangles = 0;
    std::uint64_t left = 0;              ///< edges with nothing ahead or behind
    double farthest = 0;                 ///< along a surface
    std::vector<std::uint32_t> borders;  ///< vertices that were on a border, ascending
};

/// Lengthens surfaces along themselves where they stop short of what they should end on, a little beyond it; the cut ends them.
/// \param reach largest distance along a surface at which its controller is looked for, before it and behind it
/// Cost: n log n.
Extended extend_endings(SurfaceModel& model, std::span<const EndingEdge> endings, double reach);

/// What the patches that end on others had in common with nothing: parts that hang together over edges.
struct EndingParts {
    std::vector<std::uint32_t> of;                     ///< per triangle the part of its patch; no_index for patches without endings
    std::vector<std::vector<std::uint32_t>> barriers;  ///< per patch the interfaces that it ends on, ascending
    std::uint32_t count = 0;
};
EndingParts ending_parts(const SurfaceModel& model, std::span<const EndingEdge> endings);

/// Leaves out what lies beyond the surfaces that patches end on: of each part its largest piece between them stays.
/// \param origin of the soup in the one that `parts` are of \return how many triangles
std::uint64_t drop_beyond(SurfaceModel& model, const EndingParts& parts, const Origin& origin);

}  // namespace geomend::repair
