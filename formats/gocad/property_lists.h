// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/output.h"
#include "formats/gocad/object_scanner.h"
#include "model/attribute.h"

namespace geomend::gocad {

/// The parallel lists that declare properties of nodes, tetrahedra or triangles: PROPERTIES, NO_DATA_VALUES, ESIZES
/// and the like, each with one entry per property. With a prefix (TETRA_, TRGL_) for cells.
class PropertyLists {
public:
    /// Takes the rest of a line if `keyword` (without prefix) names one of the lists.
    /// \return false when it does not
    bool take(std::string_view keyword, TextCursor& line, ObjectLog& log);

    bool declared() const { return !names_.empty() || !classes_.empty(); }
    /// Makes one attribute without values per property. Lists of unequal length are told (F008 as an error for
    /// ESIZES, which would shift values; F105/F107 else). `count` is the number of things that will carry values: more
    /// values than the file could state in `bytes` bytes (16 per byte and a few) are refused with F014.
    std::vector<Attribute> make_attributes(AttributeLocation location, std::uint64_t count, std::uint64_t bytes, ObjectLog& log) const;

private:
    std::vector<std::string> names_, classes_, kinds_, subclasses_, units_, ranges_, no_data_, sizes_;
    std::vector<std::pair<std::string, std::vector<std::string>>> others_;  // READ_ONLY, FIXED, INTERPOLATION_METHODS
    std::uint64_t line_ = 0;
};

/// Writes the lists for the attributes: complete ones, but none of classes, kinds, units or no-data values where no
/// attribute states any. Attributes without a no-data value get -99999 where they hold NaN.
/// \param prefix  "" or "TETRA_" or "TRGL_"
/// \param written which things have their values written; nullptr: all
void write_property_lists(OutputFile& out, const std::vector<const Attribute*>& attributes, std::string_view prefix,
                          const std::vector<bool>* written = nullptr);

/// The no-data value that is written for an attribute: its own, or -99999.
double written_no_data(const Attribute& attribute);

/// Numeric attributes of a location, in order: those that node and cell lines can carry. Text attributes are listed
/// in `losses`.
std::vector<const Attribute*> writable_attributes(const ObjectInfo& info, AttributeLocation location, std::vector<Loss>& losses);

/// Appends " v1 v2 ..." for one thing: all components of all attributes, NaN as no-data.
void append_values(std::string& line, const std::vector<const Attribute*>& attributes, std::size_t index);

/// A name as one token: quoted when it holds blanks or is empty; a double quote inside becomes a single one.
std::string name_token(std::string_view name);

}  // namespace geomend::gocad
