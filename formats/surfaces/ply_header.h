// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/text_cursor.h"
#include "formats/format.h"

namespace geomend::surfaces {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
std::size_t size_of(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type{};
    std::optional<PlyType> count_type;  ///< of a list: the type of its length
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

enum class PlyEncoding : std::uint8_t { text, little_endian, big_endian };

struct PlyHeader {
    PlyEncoding encoding{};
    std::vector<PlyElement> elements;
    std::vector<std::string> comments;  ///< comment and obj_info lines, whole
};

/// Reads the header; the cursor stands in its last line then. Failures: F003 (no PLY), F012, F013 (encoding, type), F005, F004.
Result<PlyHeader> read_ply_header(const Input& input, TextCursor& cursor);

}  // namespace geomend::surfaces
