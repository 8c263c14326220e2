// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/vtk/legacy_scanner.h"
#include "formats/vtk/vtk_cells.h"
#include "model/loss.h"

// A legacy file as it stands: its records, before they become objects.

namespace geomend::vtk {

/// The role that a record gives to its array.
enum class LegacyRole : std::uint8_t {
    field,
    scalars,
    color_scalars,
    vectors,
    normals,
    tensors,
    tensors6,
    texture,
    global_ids,
    pedigree_ids,
    edge_flags
};

struct LegacyArray {
    std::string name;
    LegacyRole role = LegacyRole::field;
    LegacyType type = LegacyType::unknown;
    std::uint64_t offset = 0;  ///< where its record begins
    std::uint32_t components = 1;
    std::uint64_t tuples = 0;
    AttributeValues values;
    std::string lookup_table;                  ///< named by SCALARS; empty or "default": none
    std::vector<double> lookup_values;         ///< four per colour, 0..1
    std::vector<std::string> component_names;  ///< empty, or one per component
    std::string unit;                          ///< UNITS_LABEL of its information
    std::string information;                   ///< other lines of its information
};

/// One POINT_DATA or CELL_DATA with what follows it.
struct LegacySection {
    std::uint64_t offset = 0;
    std::uint64_t count = 0;
    bool of_cells = false;
    std::vector<LegacyArray> arrays;
};

/// CELLS, VERTICES, LINES, ...: lists of numbers (points; face streams for polyhedra).
struct LegacyCells {
    bool stated = false;
    std::uint64_t offset = 0;  ///< of the record
    CellList cells;
    std::uint64_t values_offset = 0;  ///< of the block that holds the numbers
    LegacyType values_type = LegacyType::int32;
    bool counted = false;  ///< old layout: each list has its size before it
};

enum class LegacyKind : std::uint8_t { none, structured_points, structured_grid, rectilinear_grid, unstructured_grid, polydata, field };

struct LegacyFile {
    int major_version = 1, minor_version = 0;
    std::string title;
    bool binary = false;
    LegacyKind kind = LegacyKind::none;

    std::optional<std::array<std::uint32_t, 3>> dims;
    std::optional<Vec3> origin, spacing;
    std::array<std::vector<double>, 3> coordinates;
    std::array<bool, 3> coordinates_stated{};
    std::array<LegacyType, 3> coordinates_type{};

    bool points_stated = false;
    LegacyType points_type = LegacyType::float32;
    std::uint64_t points_offset = 0;
    std::vector<Vec3> points;

    LegacyCells cells, verts, lines, polys, strips;
    bool types_stated = false;
    std::uint64_t types_offset = 0, types_values_offset = 0;
    std::vector<std::uint32_t> types;
    std::vector<std::uint8_t> blanking;  ///< per point, 0 where blanked
    std::uint64_t blanking_offset = 0;

    std::vector<LegacyArray> fields;
    std::vector<LegacySection> sections;
    std::vector<Finding> findings;
    std::vector<Loss> losses;
};

/// Parses a legacy file; `scanner` stands at its beginning and keeps the failure where there is one.
bool parse_legacy(LegacyScanner& scanner, LegacyFile& file);

}  // namespace geomend::vtk
