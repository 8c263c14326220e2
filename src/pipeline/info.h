// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "complexity/complexity.h"
#include "model/dataset.h"
#include "pipeline/load.h"

namespace geomend {

/// What `geomend info` tells of one object.
struct ObjectSummary {
    std::string name, kind;
    std::string role, feature;
    std::vector<std::string> groups;
    std::map<std::string, std::uint64_t> counts;       ///< "points", "edges", ...; only those that apply
    std::map<std::string, std::uint64_t> cell_types;   ///< of three-dimensional cells; only those that occur
    std::optional<std::array<std::uint32_t, 3>> dims;  ///< numbers of points; of cells for corner-point grids
    std::optional<std::array<Vec3, 2>> bounds;         ///< in the file's own frame
    ZPositive z_positive = ZPositive::elevation;
    std::array<std::string, 3> units;
    std::optional<double> area;
    std::optional<double> volume;            ///< of cell meshes: by tetrahedra, as VTK and ParaView measure
    std::optional<double> volume_trilinear;  ///< exact integral; only where warped faces make it differ
    struct AttributeRow {
        std::string name, location, type, unit;
        std::uint32_t components = 1;
    };
    std::vector<AttributeRow> attributes;
    struct SetRow {
        std::string name, location;
        std::uint64_t members = 0;
    };
    std::vector<SetRow> sets;
};

/// What it tells of one boundary representation.
struct BrepSummary {
    std::string name;
    std::uint64_t corners = 0, lines = 0, surfaces = 0, regions = 0, vertices = 0, triangles = 0, polygons = 0;
    std::map<std::string, std::uint64_t> features;  ///< interfaces by role
    std::uint64_t interfaces = 0, contacts = 0, layers = 0, fault_blocks = 0;
    std::uint64_t internal_lines_of_regions = 0, internal_lines_of_surfaces = 0;
    struct RegionRow {
        std::string name;
        std::optional<double> volume;  ///< none where the region does not close or the axis units differ
        std::uint64_t cells = 0;
    };
    std::vector<RegionRow> region_volumes;
    /// A layer or fault block.
    struct GroupRow {
        std::string name;
        std::vector<std::uint32_t> regions;  ///< rows of region_volumes
        std::optional<double> volume;        ///< none where that of a region is not known
    };
    std::vector<GroupRow> layer_rows, block_rows;
    std::string volume_unit;  ///< as m3; empty where axes state none, or several
    bool is_found = false;    ///< in loose surfaces or a grid, because --option as=brep asked for it; false: the file states it
    std::optional<double> universe_volume;
    std::optional<geomend::complexity::Complexity> complexity;  ///< where it was asked for
};

/// What it tells of one file; `error` where it cannot be read.
struct FileSummary {
    std::string file, format, variant;
    std::vector<ObjectSummary> objects;
    std::vector<BrepSummary> breps;
    /// Pairs of touching cells of all corner-point grids, and how many of them are no neighbours by (i,j,k).
    struct ConnectionCounts {
        std::uint64_t internal = 0, nnc = 0;
    };
    std::optional<ConnectionCounts> connections;
    CoordinateSystem crs;
    std::vector<Finding> findings;
    std::vector<Loss> losses;
    std::optional<Failure> error;
};

/// Reads a file, builds its boundary representations at zero distance and measures them. With option as=brep also those of its grids,
/// and those that checks find in its loose surfaces, welded at `tolerance` (negative: by rule).
/// \param complexity measures how complex they are, too; nullptr: does not
FileSummary summarise(const std::string& path, const LoadOptions& options, const complexity::ComplexityOptions* complexity = nullptr,
                      double tolerance = -1);

/// The same of a Dataset whose breps have been built.
FileSummary summarise(const std::string& path, const Dataset& dataset);

/// The array of INTERFACE's `info --json`, one object per file, with a line feed at the end.
std::string info_json(std::span<const FileSummary> files);
/// One file for people to read.
std::string info_text(const FileSummary& file, bool verbose);

}  // namespace geomend
