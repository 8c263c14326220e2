// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Where the records of a Gocad file stand that messages about its contents speak of. Readers do not keep the lines of all records:
// they are looked up where they are needed.

namespace geomend::gocad {

struct RecordQuery {
    enum Kind : std::uint8_t {
        triangle,    ///< the TRGL with this number in its object, counted from 1
        point,       ///< the VRTX, PVRTX, ATOM or PATOM with this id in its object
        border,      ///< the BORDER with this id in its object
        region,      ///< the REGION of this name in a model
        layer,       ///< the LAYER of this name
        fault_block  ///< the FAULT_BLOCK of this name
    } kind = triangle;
    std::string object;       ///< name of the object, of the first three
    std::int64_t number = 0;  ///< of the first three
    std::string name;         ///< of the others
};

/// The line of each record, from 1; 0 where there is none, or several objects or lists have the name. Cost: linear in the text.
std::vector<std::uint64_t> record_lines(std::string_view text, std::span<const RecordQuery> queries);

}  // namespace geomend::gocad
