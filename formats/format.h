// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/input.h"
#include "base/monitor.h"
#include "base/output.h"
#include "base/result.h"
#include "formats/option_row.h"
#include "model/dataset.h"
#include "model/keeps.h"

namespace geomend {

struct ReadOptions {
    FormatOptions options;
    const Monitor* monitor = nullptr;
};

struct WriteOptions {
    FormatOptions options;
    const Monitor* monitor = nullptr;
};

/// Reads one input. Either everything that the file holds is in the Dataset, its findings or its losses, or
/// there is a Failure with file and line. Never prints, never throws but for exhausted memory.
using Reader = Result<Dataset> (*)(const Input&, const ReadOptions&);

/// Writes a Dataset into an uncommitted OutputSet and lists what does not fit; whether that is acceptable, and
/// so whether the set is committed, is the caller's decision. What cannot be held is left out, never bent.
/// Fails only where nothing sensible can be written (cannot_hold) or an option is wrong (usage).
using Writer = Result<std::vector<Loss>> (*)(const Dataset&, OutputSet&, const WriteOptions&);

/// How sure a format is that bytes are of its kind, from 0 (no) to 100 (a signature that nothing else has).
/// `head` is at most the first 64 KiB (inflated); `base_name` the file name without folder and ".gz".
using Sniffer = int (*)(std::string_view head, std::string_view base_name);

/// What a writer wants its Dataset to look like; the pipeline brings it about where that is exact.
enum class WriterWants : std::uint8_t {
    objects,      ///< takes the objects as they are
    brep,         ///< takes breps where there are any (built by src/topology), else objects
    faced_model,  ///< surfaces and a StatedModel over them (Gocad Model3d)
    tagged_mesh,  ///< one CellMesh with entities (MSH, Gocad solids) where there is a model, else objects
    corner_point  ///< corner-point grids; made from structured or (i,j,k)-tagged cells where columns allow it
};

/// One row of the table of formats.
struct Format {
    std::string_view name;                         ///< for --from and --to, e.g. "vtu"
    std::string_view family;                       ///< "gocad", "vtk", "gmsh", "horizon", "grdecl", "eclipse", "roff"
    std::string_view title;                        ///< one line for people
    std::span<const std::string_view> extensions;  ///< with the dot, lower case; the first is the usual one
    Sniffer sniff = nullptr;
    Reader read = nullptr;   ///< nullptr: cannot be read
    Writer write = nullptr;  ///< nullptr: cannot be written
    WriterWants wants = WriterWants::objects;
    Keeps keeps;
    std::string_view lossy_note;              ///< what does not go in, by class; one line
    std::string_view tried_on;                ///< "real files", "real files and clients", or "fixtures only: no real file was found"
    std::span<const OptionRow> options = {};  ///< all that its reader and its writer look at
    /// A deck of a simulator, which finds the connections of the geometry itself. It names further files with geometry or properties in
    /// keywords (GDFILE, IMPORT); records that are not understood are kept as text.
    bool deck = false;
    bool map_axes = false;         ///< can say where the origin of its coordinates lies on the map
    bool flat_meshes = false;      ///< holds cells of every dimension in one mesh; elsewhere a mesh of cells is a volume
    bool statements = false;       ///< carries beside a mesh all that a StatedModel says, and bounds surfaces by lines
    bool elevations = false;       ///< its files store elevations, whatever sign the model came with
    bool pore_volumes = false;     ///< states the pore volume of every cell
    bool bounded_regions = false;  ///< holds regions by the surfaces around them, not by cells alone
};

}  // namespace geomend
