// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "validators/cell_scope.h"
#include "validators/grid_scope.h"
#include "validators/model_scope.h"
#include "validators/object_scope.h"

// Where the findings about a model are: in space, in the file, and by the file's own names.

namespace geomend::validators {

/// A point on a surface near its middle: of the middles of its triangles the one nearest to their mean by area, so that it does not
/// depend on their order. Cost: linear. \pre the surface has polygons
Vec3 middle_of_surface(const ModelScope& scope, std::uint32_t surface);

/// The middles of the faces of a region's cells that are polygons of some of its sides. \param sides as 2 x surface, + 1 for the front
/// Cost: n log n in the polygons of these surfaces and the cells of the region.
std::vector<Vec3> cell_faces_on(const ModelScope& scope, std::uint32_t region, std::span<const std::uint32_t> sides);

/// What the file has of a surface or region that a finding names.
struct InFile {
    std::string name;    ///< what it is called there, where that is another name: "TFACE 4 of 'H2'"; else empty
    std::string object;  ///< name of the object that it comes from; empty: not known
};
/// The same by kind and name of what findings name.
using NamesInFile = std::map<std::pair<std::string, std::string>, InFile>;

/// Gives each finding what it lacks of:
/// - a place: the course of a line, the middles of the surfaces that it names, or of those that bound the regions that it names;
/// - the line of the file where the record of the first surface that it names stands.
/// Adds what the file calls the surfaces and regions that they name.
/// Findings about a whole model, or about names of layers, get no place. Cost: linear in what is named.
void give_places(const ModelScope& scope, std::span<Finding> findings, NamesInFile& names);

/// Gives findings about a mesh of cells, a grid or another object a place where they have none: the middles of cells, the upper ends
/// of pillars, else a point of the object near its middle. Heights are elevations. Cost: linear in what is listed.
void give_places(const CellScope& scope, std::span<Finding> findings);
void give_places(const GridScope& scope, std::span<Finding> findings);
void give_places(const ObjectScope& scope, std::span<Finding> findings);

}  // namespace geomend::validators
