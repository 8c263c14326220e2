// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/input.h"
#include "model/dataset.h"

namespace geomend::ringmesh {

/// What an entity is bounded by.
struct EntityBound {
    std::uint32_t number = 0;  ///< of the entity one dimension lower
    bool positive = true;      ///< a region's side of a surface: the one that its normal points into
};

/// An entity of a model.
struct StatedEntity {
    bool stated = false;
    std::string name;     ///< empty: it has none
    std::string feature;  ///< the file's word for what it is; empty: not stated
    std::vector<EntityBound> bounds;
    std::uint64_t line = 0;  ///< of its record
};

/// What mesh_entities.txt says: corners, lines, surfaces and regions, each bounded by those before it.
struct EntityText {
    enum Kind : std::uint8_t { corner, line, surface, region };

    using Bound = EntityBound;
    using Entity = StatedEntity;

    std::string model;
    std::array<std::vector<Entity>, 4> entities;  ///< by Kind; all stated
    std::optional<Entity> universe;
};

/// Reads mesh_entities.txt of versions 0 to 2. What a bound names is there. Failures: F005, F007, F008, F009, F012, F013, F014.
Result<EntityText> read_entity_text(const Input& text);

/// "Corner", "Line", "Surface", "Region": as records and meshes are called.
const char* to_string(EntityText::Kind kind);

/// A geological thing of geological_entities.txt: an Interface is some surfaces, a Layer some regions, a Contact some lines.
struct GeologicalText {
    std::string type, name, feature;
    std::vector<std::uint32_t> members;
    std::uint64_t line = 0;
};

/// Reads geological_entities.txt. Members are numbers only: what they name is the caller's matter. Failures: F005, F012.
Result<std::vector<GeologicalText>> read_geological_text(const Input& text);

}  // namespace geomend::ringmesh
