// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/output.h"
#include "base/vec3.h"
#include "formats/vtk/legacy_scanner.h"
#include "model/attribute.h"
#include "model/loss.h"

namespace geomend::vtk {

/// Blanks, control characters, '"', '%' and bytes above 126 as %XX, as VTK does.
std::string percent_encoded(std::string_view text);

/// A string array of the dataset.
struct LegacyText {
    std::string_view name;
    std::string text;
};

/// Writes blocks of values and arrays of attributes, as text with the shortest digits or as big-endian bytes.
class LegacyArraysOut {
public:
    LegacyArraysOut(OutputFile& out, bool binary, int major_version, std::vector<Loss>& losses)
        : out_(out), losses_(losses), binary_(binary), major_(major_version) {}

    /// Values, `per_line` on a line of text; ends with a line end.
    template <class T>
    void block(std::span<const T> values, std::size_t per_line);
    /// Coordinates in single precision. \pre they are exact in it
    void points_as_float(std::span<const Vec3> points);
    /// The old layout of cells: the size of each list before it, all as 32-bit numbers.
    void counted_cells(std::span<const std::uint64_t> offsets, std::span<const std::uint32_t> corners);
    /// Lists of points, one on a line of text, as 64-bit numbers.
    void connectivity(std::span<const std::uint64_t> offsets, std::span<const std::uint32_t> corners);

    /// POINT_DATA or CELL_DATA with all attributes of a location, and nothing where there is none. Attributes whose
    /// values do not match `count` are losses.
    void section(std::string_view keyword, std::span<const Attribute* const> attributes, AttributeLocation location, std::uint64_t count);
    /// FIELD with texts of ours and the attributes of the object.
    void object_field(std::span<const Attribute* const> attributes, std::span<const LegacyText> texts);

private:
    struct Shape {
        std::uint64_t components, tuples;
    };
    bool role_record(const Attribute& a, std::uint64_t count, std::vector<std::string>& used_roles);
    void array(const Attribute& a, Shape shape);
    void values(const Attribute& a, LegacyType type, std::size_t per_line);
    void bits(const std::vector<std::uint8_t>& values);
    void strings(const std::vector<std::string>& values);
    void metadata(const Attribute& a);
    void lookup_table(const Attribute& a, const std::string& name);
    LegacyType type_of(const Attribute& a);
    std::string name_of(const Attribute& a);

    OutputFile& out_;
    std::vector<Loss>& losses_;
    bool binary_;
    int major_;
};

}  // namespace geomend::vtk
