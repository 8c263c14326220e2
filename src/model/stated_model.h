// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "model/coordinate_system.h"
#include "model/feature.h"
#include "model/objects.h"

namespace geomend {

/// What a file claims about a boundary representation made of the objects of the same Dataset: Model3d header,
/// MODEL section of a solid, entities of a tagged mesh, blocks of a .vtm. Nobody has checked it.
struct StatedModel {
    std::string name;
    CoordinateSystem crs;
    std::vector<Annotation> annotations;

    /// One face: a part of a Surface, or a two-dimensional entity of a CellMesh.
    struct Face {
        std::int64_t number = 0;          ///< TFACE number or tag
        std::uint32_t object = no_index;  ///< index into Dataset::objects
        std::uint32_t part = 0;           ///< index of the Surface::Part, or of the CellMesh::Entity
        std::string interface_name;       ///< the geological surface it is a part of (TSURF name, SURFACE name)
        std::string name;                 ///< its own name where it has one (.vtm blocks)
        FeatureRole role = FeatureRole::unknown;
        std::string role_text;                   ///< the file's word
        std::optional<std::array<Vec3, 3>> key;  ///< elevation-up; its normal names the front side
        std::uint64_t line = 0;                  ///< of its record in the file, from 1; 0: not known
    };
    std::vector<Face> faces;

    /// What is said of whole interfaces whose faces are entities of a mesh; a Surface says it in its own ObjectInfo.
    struct Interface {
        std::string name;     ///< Face::interface_name
        std::string feature;  ///< geological feature that it is a part of; empty: not stated
        std::vector<Annotation> annotations;
    };
    std::vector<Interface> interfaces;

    /// A face seen from one side: the region lies on the side the face's normal points into (front) or behind it.
    struct Side {
        std::uint32_t face = 0;  ///< index into faces
        bool front = true;
    };
    struct Region {
        std::int64_t number = 0;
        std::string name;
        bool universe = false;
        std::vector<Side> sides;  ///< both sides of a face where it is internal
    };
    std::vector<Region> regions;

    /// Gocad SURFACE lists: geological features over faces.
    struct Feature {
        std::string name;
        std::vector<std::uint32_t> faces;
    };
    std::vector<Feature> features;
    /// Layers and fault blocks: named lists of regions.
    struct RegionList {
        std::string name;
        std::vector<std::uint32_t> regions;
        std::vector<std::int64_t> unresolved;  ///< numbers without a region, kept for the way back
    };
    std::vector<RegionList> layers;
    std::vector<RegionList> fault_blocks;

    /// Names for lines and corners where a file has them, by position of their end points or of the corner.
    struct NamedCorner {
        std::string name;
        Vec3 position;
    };
    std::vector<NamedCorner> corners;
};

}  // namespace geomend
