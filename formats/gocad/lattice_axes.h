// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/output.h"
#include "base/text_cursor.h"
#include "formats/gocad/object_scanner.h"
#include "model/objects.h"

// The AXIS_ records of Voxet and 2D grid: sample (i,j,k) stands at O + sum of axis * (MIN + i (MAX - MIN) / (N - 1)).

namespace geomend::gocad {

/// The records as they stand, in the file's own vertical frame.
class LatticeAxes {
public:
    /// Takes a record O, U, V, W, MIN, MAX, N, D (with AXIS_ in front) or ORIGIN. Numbers that are missing, malformed or
    /// not finite go to the log as errors. \return false when the keyword is another one
    bool take(std::string_view keyword, TextCursor& line, ObjectLog& log);

    /// Whether all that is needed was there: AXIS_N, U, V (and W for three directions). What is not is told as F012.
    /// More samples than 32-bit ids can number are refused with F014.
    /// \param directions 3, or 2 for grids whose AXIS_W is a height, or 0 where only AXIS_N is needed
    bool complete(int directions, std::uint64_t object_line, ObjectLog& log) const;

    /// Fills dims, origin and step; z is turned to elevation where `depth`. Steps come out exactly where MAX - MIN is
    /// N - 1. A direction with one sample stands at its MIN, and its step is the axis vector.
    /// \pre complete()
    void place(Raster& raster, bool depth) const;

    std::array<std::int64_t, 3> count{1, 1, 1};
    Vec3 origin{}, low{0, 0, 0}, high{1, 1, 1};
    std::array<Vec3, 3> axis{};
    std::optional<Vec3> step;  ///< AXIS_D, in parameters

private:
    bool has_count_ = false, has_origin_ = false, has_low_ = false, has_high_ = false;
    std::array<bool, 3> has_axis_{};
};

/// Whether a keyword is one of those that LatticeAxes takes.
bool is_axis_record(std::string_view keyword);

/// Writes AXIS_O, U, V, W, MIN, MAX, N so that reading them gives the same dims, origin and step bit by bit. Lines that
/// were read ("gocad.axis" annotations) are written as they stood where they still say the same.
void write_axes(OutputFile& out, const Raster& raster);

}  // namespace geomend::gocad
