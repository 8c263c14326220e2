// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>

#include "formats/format.h"
#include "formats/vtk/xml_library.h"

namespace geomend::vtk {

// Writers of the XML formats; see Writer in formats/format.h. Options: compress=yes|no (zlib; default no),
// encoding=appended|ascii.

/// One unstructured grid: points, lines, polygons and cells; several objects share it and come back apart.
Result<std::vector<Loss>> write_vtu(const Dataset& dataset, OutputSet& out, const WriteOptions& options);
/// Points, lines and polygons.
Result<std::vector<Loss>> write_vtp(const Dataset& dataset, OutputSet& out, const WriteOptions& options);
/// One structured grid.
Result<std::vector<Loss>> write_vts(const Dataset& dataset, OutputSet& out, const WriteOptions& options);
/// One raster with even spacing, or one with coordinates of its own.
Result<std::vector<Loss>> write_vti(const Dataset& dataset, OutputSet& out, const WriteOptions& options);
Result<std::vector<Loss>> write_vtr(const Dataset& dataset, OutputSet& out, const WriteOptions& options);
/// A block per object; a block per corner, line, surface and region of each B-Rep. Blocks are files in a folder
/// beside the .vtm that has its name.
Result<std::vector<Loss>> write_vtm(const Dataset& dataset, OutputSet& out, const WriteOptions& options);

/// A series in time: a file per report step and object, in a folder beside the .pvd. Attributes with a TimeStep
/// stand in the file of their moment under their keyword alone; the others stand in all files.
Result<std::vector<Loss>> write_pvd(const Dataset& dataset, OutputSet& out, const WriteOptions& options);

Result<XmlWriteSettings> write_settings(const WriteOptions& options);

/// A file's worth of an object: extension and text.
struct XmlFile {
    std::string extension;
    std::string text;
};
/// An object in the XML format that fits it best (for .vtm).
Result<XmlFile> xml_of_object(const Object& object, const XmlWriteSettings& settings, std::vector<Loss>& losses);

}  // namespace geomend::vtk
