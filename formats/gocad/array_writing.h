// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <deque>
#include <string>
#include <vector>

#include "formats/gocad/object_writers.h"
#include "model/objects.h"

namespace geomend::gocad {

/// The property records and data files of one array object.
class ArrayWriting {
public:
    /// \param locations which attributes have a place; the others, and text, are listed as lost
    ArrayWriting(const ObjectInfo& info, const std::array<std::uint32_t, 3>& dims, std::initializer_list<AttributeLocation> locations,
                 GocadOutput& to);

    /// Checks the option data=ascii|binary and that companion files have a place. Without the option values go to binary
    /// files where that keeps every digit, else to text.
    /// Failures: usage (unknown value), cannot_hold (standard output)
    Result<void> prepare(bool needs_files);

    bool ascii() const { return ascii_; }
    /// Name of a companion file: <file>__<what>@@, with the object between where the file holds several.
    std::string file_name(std::string_view what);
    void write_file(const std::string& name, std::string_view bytes);
    /// Writes the records, and the data files. \param positions of an SGrid, for text; else empty
    void write(const std::vector<Vec3>& positions);

    std::vector<const Attribute*> attributes;  ///< those that are written
    const Attribute* flags = nullptr;          ///< "gocad_flags"
    const Attribute* region_flags = nullptr;   ///< "gocad_region_flags"

private:
    const Attribute* with_name(const Attribute& a);
    void write_records(const Attribute& a, std::size_t number, const std::string& file);

    const ObjectInfo& info_;
    std::array<std::uint32_t, 3> dims_;
    GocadOutput& to_;
    bool ascii_ = false;
    std::vector<std::string> used_names_;
    std::deque<Attribute> named_;  // copies of those that have no name of their own
};

/// What goes into the object's head: `info` without attributes and sets, and with the header key `ascii` as it now is.
ObjectInfo array_head(const ObjectInfo& info, bool ascii);

/// Region bits of sets: those that were read where they still fit, else from `first_free` on.
std::vector<std::uint32_t> region_bits(const ObjectInfo& info, const std::vector<const NamedSet*>& sets, std::uint32_t first_free);

}  // namespace geomend::gocad
