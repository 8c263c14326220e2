// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>

#include "formats/format.h"

namespace geomend::meshes {

/// Whether a name and a text are those of a file of TetGen: .node or .ele, and numbers.
int sniff_tetgen(std::string_view head, std::string_view base_name);

/// TetGen: .node with attributes, .ele with 4 or 10 nodes and regions, .face with markers; named by .node or .ele, the others stand
/// beside it with the same name. Without .ele the nodes are points. Indices begin at that of the first node.
Result<Dataset> read_tetgen(const Input& input, const ReadOptions& options);

}  // namespace geomend::meshes
