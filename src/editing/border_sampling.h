// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace geomend::editing {

/// How many edges the coarsest common discretisation of a border has, after N. Euler (thesis, 4.4): as many as the surface at it with the
/// fewest representative nodes (ends, and nodes of at least three triangles of the surface) has between these; at least two.
/// \param fewest_nodes of any surface at the border, ends counted
std::uint32_t common_edges(std::uint32_t fewest_nodes, bool closed);

/// The order in which most groups of radial edges have their faces, up to rotation; of equally frequent ones the first. Groups
/// whose order is not known are empty, and do not count. Empty where none is known.
std::vector<std::uint32_t> prevailing_order(std::span<const std::vector<std::uint32_t>> groups);
/// Whether two orders are the same up to rotation.
bool same_order(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b);

/// Where a vertex inside of a surface lies evenly between its neighbours: the middle of its triangles, by their areas (thesis,
/// 4.6). \param triangles around it \pre they have area
Vec3 relaxed_place(std::span<const std::array<Vec3, 3>> triangles);

}  // namespace geomend::editing
