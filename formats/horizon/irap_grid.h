// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::horizon {

// IRAP classic grids (RMS, Petrel), ASCII and binary. The header is
//   -996 ny xinc yinc / xmin xmax ymin ymax / nx rotation x0 y0 / 0 0 0 0 0 0 0
// Heights follow with x running fastest, from (xmin, ymin). The rotation in degrees runs anticlockwise around (xmin,
// ymin); other places for the centre of rotation are told (F113). A negative yinc is a mirrored grid. 9999900.0 stands
// for missing in ASCII files, 1e30 in binary ones. The sign of z is not stated: --option z=depth|elevation.

int sniff_irap_grid(std::string_view head, std::string_view base_name);
int sniff_irap_grid_binary(std::string_view head, std::string_view base_name);

/// Cost: linear. Failures: F004 too few numbers, F005/F006 malformed or non-finite number, F008 too many, F012 header,
/// F014 a header that asks for more than the file can hold.
Result<Dataset> read_irap_grid(const Input& input, const ReadOptions& options);
/// Writes exact text. Left-over objects, attributes, units and names are losses.
Result<std::vector<Loss>> write_irap_grid(const Dataset& dataset, OutputSet& out, const WriteOptions& options);

/// Fortran records of big-endian float32; little-endian ones are read, too.
Result<Dataset> read_irap_grid_binary(const Input& input, const ReadOptions& options);
/// Writes big-endian. What float32 does not hold exactly is a loss of substance.
Result<std::vector<Loss>> write_irap_grid_binary(const Dataset& dataset, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::horizon
