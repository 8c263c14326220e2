// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"

namespace geomend::surfaces {

// OFF: numbers of points, polygons and edges, then the points, then each polygon as its number of corners and these, from 0. Colours
// (COFF, or behind a polygon) and normals (NOFF) are style.

int sniff_off(std::string_view head, std::string_view base_name);
/// Cost: linear.
Result<Dataset> read_off(const Input& input, const ReadOptions& options);
/// All surfaces as one.
Result<std::vector<Loss>> write_off(const Dataset& dataset, OutputSet& out, const WriteOptions& options);

}  // namespace geomend::surfaces
