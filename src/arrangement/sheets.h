// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "arrangement/cut_round.h"

namespace geomend::arrangement {

/// Finds triangles that lie upon each other within a width of one plane, the one of the largest of them, puts them into that plane and
/// cuts them there at once: one triangulation takes their place, so that it cannot cross itself. Its triangles are pieces of all that
/// lie there, see CutState::stacks. What cannot be cut in its plane stays as it is, there. Points move by up to the width and come to
/// be one with others that are near then.
/// \param width in steps of the grid
/// \param may_lie per triangle of the soup: whether it may become a part of a sheet
/// \pre the state is not cut yet: its triangles are the soup's
void lay_sheets(CutState& state, double width, std::span<const std::uint8_t> may_lie, const Monitor* monitor);

/// Gives each triangle of a stack a piece of its own for each piece of the stack, ascending by sources; of several in one patch the first
/// stays.
void take_stacks_apart(CutState& state);

}  // namespace geomend::arrangement
