// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "model/objects.h"

// The outermost layer of Gocad's text files: a file is a sequence of `GOCAD <Type> [version] ... END`, and groups
// hold further objects between BEGIN_MEMBERS and END_MEMBERS.

namespace geomend::gocad {

/// One object of a file, found but not yet read. The views point into the file's bytes.
struct ObjectFrame {
    std::string_view type;        ///< the word after GOCAD, as written; empty where it is missing
    std::string_view version;     ///< what follows the type on its line
    std::string_view body;        ///< from the line after `GOCAD ...` up to the END line; groups: up to BEGIN_MEMBERS
    std::string_view tail;        ///< groups: between END_MEMBERS and END
    std::uint64_t line = 0;       ///< of `GOCAD ...`
    std::uint64_t body_line = 0;  ///< of the first line of `body`
    std::uint64_t tail_line = 0;
    std::uint32_t parent = no_index;  ///< index of the group that holds it
    bool group = false;               ///< it has BEGIN_MEMBERS
    bool ended = false;               ///< it has its END (groups: and END_MEMBERS)
    /// Lines that look like nodes, like cells (SEG, TRGL, TETRA), counted to take memory once. Never more than
    /// the bytes of the body could hold.
    std::uint64_t node_lines = 0;
    std::uint64_t cell_lines = 0;
};

struct FrameList {
    std::vector<ObjectFrame> frames;    ///< in file order; a group stands before its members
    std::vector<std::string> comments;  ///< `#` lines outside of objects, at most 1000
    std::uint64_t stray_lines = 0;      ///< other lines outside of objects
    std::uint64_t first_stray_line = 0;
    std::uint64_t last_line = 0;
};

/// Finds the objects of a text. Keywords are compared without regard to case; END must be a word of its own.
/// Fails with F014 when groups nest more than 64 deep, F012 when there is no object at all.
/// Cost: one pass over the bytes.
Result<FrameList> find_frames(std::string_view text, const std::string& file);

/// True when the first line that is neither blank nor a comment begins with the word GOCAD.
bool begins_with_gocad(std::string_view head);

}  // namespace geomend::gocad
