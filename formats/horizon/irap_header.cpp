// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/horizon/irap_header.h"

#include <cmath>

#include "base/number_text.h"

namespace geomend::horizon {

namespace {

enum Place : std::size_t { mark, ny, xinc, yinc, xmin, xmax, ymin, ymax, nx, rotation, x0, y0 };

bool is_count(double value) { return value >= 1 && value <= 2147483647.0 && value == std::floor(value); }

/// A file may print its limits with few digits: a tenth of a step is taken for a contradiction.
bool disagrees(double first, double last, double step, double count) {
    return count > 1 && std::abs(first + (count - 1) * std::abs(step) - last) > 0.1 * std::abs(step);
}

}  // namespace

Result<IrapFrame> irap_frame(const IrapHeader& header, std::uint64_t count_limit, const Location& where) {
    if (header[mark] != irap_mark)
        return unreadable("F012", where, "expected -996 at the start of an IRAP grid, found " + number_text(header[mark]));
    if (!is_count(header[nx]) || !is_count(header[ny])) {
        return unreadable(
            "F012", where,
            "expected numbers of columns and rows from 1, found " + number_text(header[nx]) + " and " + number_text(header[ny]));
    }
    if (header[xinc] == 0 || header[yinc] == 0) return unreadable("F012", where, "expected steps in x and y, found 0");
    if (header[nx] * header[ny] > static_cast<double>(count_limit)) {
        return unreadable(
            "F014", where,
            "the header asks for " + number_text(header[nx]) + " x " + number_text(header[ny]) + " heights, more than the file can hold");
    }
    IrapFrame result;
    GridFrame& frame = result.frame;
    frame.nx = static_cast<std::uint32_t>(header[nx]);
    frame.ny = static_cast<std::uint32_t>(header[ny]);
    frame.x0 = header[xmin];
    frame.y0 = header[ymin];
    frame.xinc = header[xinc];
    frame.yinc = header[yinc];
    frame.rotation = header[rotation];
    const bool turned = std::fmod(frame.rotation, 360.0) != 0;
    if (turned && (header[x0] != header[xmin] || header[y0] != header[ymin])) {
        result.warning = "the centre of rotation is not the first node; the grid is turned around the first node";
    } else if (disagrees(header[xmin], header[xmax], header[xinc], header[nx]) ||
               disagrees(header[ymin], header[ymax], header[yinc], header[ny])) {
        result.warning = "the limits of the grid disagree with its steps; the steps are taken";
    }
    return result;
}

IrapHeader irap_header(const FileGrid& grid) {
    const GridFrame& f = grid.frame;
    IrapHeader header{};
    header[mark] = irap_mark;
    header[ny] = f.ny;
    header[xinc] = f.xinc;
    header[yinc] = f.yinc;
    header[xmin] = header[x0] = f.x0;
    header[ymin] = header[y0] = f.y0;
    header[xmax] = f.x0 + (f.nx - 1.0) * f.xinc;
    header[ymax] = f.y0 + (f.ny - 1.0) * std::abs(f.yinc);
    header[nx] = f.nx;
    header[rotation] = f.rotation;
    return header;
}

Finding irap_warning(const std::string& warning, const Location& where) {
    Finding finding = make_finding("F113", warning, where, 0);
    return finding;
}

}  // namespace geomend::horizon
