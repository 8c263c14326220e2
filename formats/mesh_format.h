// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>

#include "formats/format.h"

namespace geomend {

class VolumeMesh;

/// Prints a mesh that was prepared for the needs of the format (src/exchange), which lists what was lost on the way there; a writer
/// lists only what printing itself loses. Fails only where nothing sensible can be written (companion files beside a stream).
using MeshWriter = Result<std::vector<Loss>> (*)(const VolumeMesh&, OutputSet&, const WriteOptions&);

/// A format that takes a prepared VolumeMesh in place of a Dataset. It has a row in the table of formats, too, whose `write` refuses
/// (cannot_hold) every Dataset: preparing is not a format's matter.
struct MeshFormat {
    std::string_view name;    ///< as in the table of formats
    std::string_view target;  ///< its row of mesh_needs()
    MeshWriter write;
};

}  // namespace geomend
