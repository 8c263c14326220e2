// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/text_cursor.h"
#include "formats/horizon/lattice.h"

namespace geomend::horizon {

struct ZmapHeader {
    std::string title;  ///< without " HEADER"
    std::vector<std::string> comments;
    std::uint64_t nodes_per_line = 1;
    std::uint64_t width = 0;  ///< 0: fields are separated by blanks
    std::optional<double> null_number;
    std::string null_text;
    std::uint64_t decimals = 0;
    std::uint64_t start = 1;
    std::uint32_t rows = 1, columns = 1;
    double xmin = 0, xmax = 0, ymin = 0, ymax = 0;
};

/// Reads up to and with the second '@'; the cursor then stands there.
Result<ZmapHeader> read_zmap_header(const Input& input, TextCursor& cursor);

/// The lattice of a header; its first sample is the south-western one.
GridFrame frame_of(const ZmapHeader& header);

/// A number `last` so that (last - first) / intervals is exactly `step`, or else the nearest one.
double last_of(double first, double step, std::uint32_t intervals);

}  // namespace geomend::horizon
