// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/result.h"
#include "formats/vtk/vtk_cells.h"
#include "model/objects.h"

// The one place where VTK's own library is called. It writes all XML files and undoes compression. It does not
// parse: VTK 9.1's XML readers die by SIGSEGV on face streams, and by huge allocations on offsets and block sizes,
// that no check short of decoding all arrays would find; so xml_arrays.h decodes them with every count checked.

namespace geomend::vtk {

enum class Compressor : std::uint8_t { none, zlib, lz4, lzma };

/// Undoes the compression of one block. \return false unless it fills `out` exactly. May be called from several threads.
bool uncompress(Compressor compressor, std::string_view packed, std::span<char> out);

struct XmlWriteSettings {
    bool ascii = false;     ///< else raw appended with 64-bit headers
    bool compress = false;  ///< zlib; not for ASCII
};

/// Field data of a file in the making.
struct XmlFieldText {
    std::string name;
    std::string value;
};

/// The text of a .vtu, .vtp, .vts, .vti or .vtr file. Attributes of the objects at location point, cell and object
/// go in as arrays of their own types; the texts as string arrays in the field data. Doubles stay exact.
/// Failures: internal where VTK reports an error, with VTK's words; unwritable (F020) where memory runs out.
/// The objects are taken by value because VTK uses their arrays in place.
Result<std::string> write_unstructured(CellMesh mesh, std::span<const XmlFieldText> texts, const XmlWriteSettings& settings);
Result<std::string> write_polydata(PolyData data, std::span<const XmlFieldText> texts, const XmlWriteSettings& settings);
Result<std::string> write_structured(StructuredGrid grid, std::span<const XmlFieldText> texts, const XmlWriteSettings& settings);
/// An image, or a rectilinear grid where the raster has coordinates.
Result<std::string> write_raster(Raster raster, std::span<const XmlFieldText> texts, const XmlWriteSettings& settings);

}  // namespace geomend::vtk
