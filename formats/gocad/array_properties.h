// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "formats/gocad/companion_files.h"
#include "formats/gocad/indexed_property.h"
#include "formats/gocad/object_scanner.h"

// The values of the properties of array objects, from binary files (PROP_FILE) or from one text file
// (ASCII_DATA_FILE).

namespace geomend::gocad {

/// Where the values of an array object stand.
struct ArrayPlace {
    std::array<std::uint32_t, 3> dims{1, 1, 1};
    std::uint64_t cells = 0;        ///< values of a property that stands on cells
    bool cells_by_default = false;  ///< PROP_ALIGNMENT of the object
    std::string ascii_file;         ///< empty: none
    std::uint64_t ascii_line = 0;
    bool ascii_positions = false;  ///< the text file holds X Y Z as well
};

/// Reads the values of all properties into scanner-independent attributes, in order. Properties that name no file are told
/// (F119) and left out. Errors go to scanner.log; the result is then not to be used.
/// \param positions filled from the text file where place.ascii_positions
std::vector<Attribute> read_array_properties(std::vector<IndexedProperty> properties, const ArrayPlace& place, CompanionFiles& files,
                                             ObjectScanner& scanner, std::vector<Vec3>* positions);

}  // namespace geomend::gocad
