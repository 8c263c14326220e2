// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "formats/vtk/xml_library.h"
#include "formats/vtk/xml_scan.h"
#include "model/attribute.h"

namespace geomend::vtk {

/// How the binary arrays of a file are packed (attributes of VTKFile and AppendedData).
struct XmlEncoding {
    bool big_endian = false;
    bool wide_header = false;  ///< UInt64 instead of UInt32
    bool appended_base64 = false;
    Compressor compressor = Compressor::none;
};

/// Failure F012 or F013 for words that are not known.
Result<XmlEncoding> encoding_of(const XmlDocument& document);

/// Reads one DataArray or Array element into values of the type that it states: ASCII, inline base64, appended raw
/// or base64, compressed or not. Bit arrays become uint8.
/// \param expected number of values (components counted one by one); without it, as many as there are
/// Failures: F005 malformed number, F008 a count that does not match, F012, F013 unknown type or format, F014 more
/// than the bytes can hold, F015 damaged compression, F004 data beyond the end of the file.
/// Memory is taken only after the file has shown that it has the bytes.
Result<AttributeValues> decode_array(const XmlDocument& document, const XmlEncoding& encoding, const XmlElement& array,
                                     std::optional<std::uint64_t> expected);

/// A whole attribute value as a number that is not negative, or nothing.
std::optional<std::uint64_t> count_attribute(const XmlDocument& document, const XmlElement& element, std::string_view name);

/// The same of one that may be left out: nothing where it is. Failure (F005) where it is no such number.
Result<std::optional<std::uint64_t>> stated_count(const XmlDocument& document, const XmlElement& element, std::string_view name);

/// The NumberOfComponents of an array, from 1; `usual` where it is not stated. Failure (F005) where it makes no sense.
Result<std::uint64_t> components_of(const XmlDocument& document, const XmlElement& array, std::uint64_t usual);

}  // namespace geomend::vtk
