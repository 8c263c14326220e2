// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "base/output.h"
#include "formats/gocad/coordinate_block.h"
#include "formats/gocad/object_scanner.h"
#include "formats/gocad/property_lists.h"

namespace geomend::gocad {

/// A node or cell set that is declared by `REGION name bit` and filled by indicator lines.
struct RegionBit {
    std::string name;
    std::int64_t bit = 0;
    std::vector<std::uint32_t> members;
};

/// The records that all objects share: header, coordinate block, geological words, property lists, region names and
/// whatever is not known. Everything goes into `info`, either as a field or as an annotation:
///   gocad.header                   one key:value line of HEADER or HDR, verbatim
///   gocad.stratigraphic_position   its text
///   gocad.property_class_header    the whole block, "name {\n...\n}"
///   gocad.record                   an unknown record (whole block) before the first node
///   gocad.record_after             the same, after the first node
///   gocad.comment                  a comment line
/// Use: for each line, look at the keywords of your own first, then give the line to take().
class ObjectHead {
public:
    explicit ObjectHead(ObjectScanner& scanner) : scanner_(scanner) {}

    ObjectInfo info;
    PropertyLists properties;        ///< of nodes
    PropertyLists tetra_properties;  ///< TETRA_...
    PropertyLists trgl_properties;   ///< TRGL_...
    std::vector<RegionBit> regions;  ///< REGION name bit, by ascending bit; see region_indicators.h
    std::vector<RegionBit> tetra_regions;
    bool geometry_begun = false;  ///< set by the reader at the first node: unknown records come after it

    /// Takes the record that begins on the current line, and its further lines if it is a block. `line` stands behind
    /// `keyword`, the first token of the line. Anything not known is kept as an annotation and told once (F102).
    void take(std::string_view keyword, TextCursor& line);

    /// Takes only what is common to all objects. \return false, and nothing is taken, when the keyword is not
    bool take_known(std::string_view keyword, TextCursor& line);

    /// Keeps a record (a whole block) as an annotation without a finding.
    void keep(std::string_view keyword, TextCursor& line);

    /// After the last line: object name, inherited coordinate system.
    void finish();

    /// Whether z counts downwards in this object, by its own coordinate block or by that of its group.
    bool depth() const { return (info.crs.stated ? info.crs : scanner_.inherited_crs).z_positive == ZPositive::depth; }

private:
    void read_header(TextCursor& line);
    void header_entry(std::string_view entry, std::uint64_t line);
    void read_class_header(std::string_view keyword, TextCursor& line);
    bool region_line(std::string_view keyword, TextCursor& line);
    std::string whole_record(std::string_view keyword, TextCursor& line);
    void annotate(std::string key, std::string value);

    ObjectScanner& scanner_;
    bool name_found_ = false;
    std::size_t kept_records_ = 0;
    std::size_t headers_ = 0;
};

// --- writing ---

/// Writes `GOCAD <type> 1`, the header, the coordinate block, geological words, unknown records, and nothing else.
void write_object_head(OutputFile& out, std::string_view type, const ObjectInfo& info);
/// Lists what an object says that Gocad has no place for: attributes and sets at other locations than those `held`,
/// annotations of other formats.
void list_unheld(const ObjectInfo& info, std::initializer_list<AttributeLocation> held, std::vector<Loss>& losses);
/// A name as it may stand to the end of a line.
std::string line_name(std::string_view name);
/// Records that stood after the first node; to be written before END.
void write_records_after(OutputFile& out, const ObjectInfo& info);
/// `PROPERTY_CLASS_HEADER` blocks as read; a class header for Z is added where there is none.
void write_class_headers(OutputFile& out, const ObjectInfo& info);

}  // namespace geomend::gocad
