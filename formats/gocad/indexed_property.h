// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/result.h"
#include "base/text_cursor.h"
#include "formats/gocad/array_codec.h"
#include "model/attribute.h"

// The property block of array objects (Voxet, SGrid, GSurf, curves of a Well): records PROPERTY, PROPERTY_* and
// PROP_*, each with the property's number first (in a Well: without).

namespace geomend::gocad {

/// What the records say of one property; the values stand elsewhere.
struct IndexedProperty {
    Attribute attribute;  ///< name, unit, kind, class, no-data, legal range, rock codes, annotations; no values
    std::int64_t index = 0;
    std::string storage_type;  ///< Octet, Short, Integer, Float, RGBA; empty: not stated
    std::string etype;         ///< IEEE, IBM, BYTE; empty: not stated
    std::string format;        ///< RAW, SEGY; empty: not stated
    std::string alignment;     ///< CELLS, POINTS; empty: that of the object
    std::string file;
    std::optional<std::int64_t> esize;
    std::optional<bool> is_signed;
    std::uint64_t offset = 0;
    std::uint64_t line = 0;       ///< of its first record
    std::uint64_t file_line = 0;  ///< of PROP_FILE
};

/// Collects the records.
class IndexedPropertyList {
public:
    explicit IndexedPropertyList(bool numbered) : numbered_(numbered) {}

    /// Takes a record whose keyword has been read; class headers are read up to their closing brace.
    /// \return false when the record is not one of a property. Failure: F012 (no number), F005, F004 (open brace).
    Result<bool> take(std::string_view keyword, TextCursor& cursor, const std::string& file);

    /// Fails with F012 when a number was used without its PROPERTY record.
    Result<void> check_names(const std::string& file) const;

    std::vector<IndexedProperty> properties;  ///< in file order

private:
    Result<IndexedProperty*> property_of_line(TextCursor& cursor, const std::string& file);

    bool numbered_;
    std::unordered_map<std::int64_t, std::size_t> by_index_;
};

/// How the values of a property are stored. Failure F013 for SEGY, unknown types and sizes that do not go together.
/// Without a storage type 4 bytes are a float, 8 a double, 2 a short and 1 an octet.
Result<ArrayStorage> storage_of(const IndexedProperty& property, const std::string& file);

}  // namespace geomend::gocad
