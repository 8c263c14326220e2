// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "formats/format.h"
#include "formats/vtk/xml_pieces.h"

namespace geomend::vtk {

/// Reads any VTK XML file: .vtu .vtp .vts .vti .vtr, the parallel forms of these (.pvtu, ...) with their pieces, and
/// .vtm with its blocks and .pvd with its moments. Source of the rules: the VTK file formats page, and files that VTK 9.1 writes.
/// Failures: see decode_array; F010 where a piece or block is missing; F017 where there is nothing inside.
Result<Dataset> read_vtk_xml(const Input& input, const ReadOptions& options);

/// How sure a VTKFile element of the given type is in the head of a file; for the rows of the table of formats.
int sniff_xml(std::string_view head, std::string_view type);

/// Where reading stands among files that name files.
struct FileChain {
    std::size_t depth = 0;
    std::uint64_t* files_left = nullptr;
};

/// read_vtk_xml for a file that another one names.
Result<Dataset> read_chained(const Input& input, const ReadOptions& options, FileChain chain);
/// The blocks of a .vtm.
Result<Dataset> read_multiblock(const XmlDocument& document, const Input& input, const ReadOptions& options, FileChain chain);
/// The files of a .pvd, at all moments: parts whose geometry stays are one object, whose attributes are those of each moment
/// (Attribute::time; the time of ParaView as days) but for those that stay as they are.
Result<Dataset> read_collection(const XmlDocument& document, const Input& input, const ReadOptions& options, FileChain chain);
/// Opens a file that this one names; where only its folder is missing, the one beside, with a finding (F131). Else F010
/// at that place.
Result<Input> open_named(const XmlDocument& document, const XmlElement& element, const Input& input, const std::string& file,
                         ReadNotes& notes);

/// The texts of ours among the field data; they are taken out.
struct OwnTexts {
    std::string dataset, structure;
};
OwnTexts take_own_texts(std::vector<Attribute>& fields);
/// dataset_text() put back, with the reader's own "vtk." annotations kept as they are. False: it is no such text.
bool apply_own_text(std::string_view text, Dataset& dataset);

}  // namespace geomend::vtk
