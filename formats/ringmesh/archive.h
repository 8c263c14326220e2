// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/input.h"
#include "base/monitor.h"
#include "formats/ringmesh/geogram_mesh.h"
#include "formats/ringmesh/model_text.h"
#include "model/dataset.h"

namespace geomend::ringmesh {

/// All that stands in a .gm file.
struct GmArchive {
    std::string name;  ///< of the file, for messages
    EntityText text;
    std::vector<GeologicalText> geology;
    /// By kind and number; regions that are not filled with cells have none.
    std::array<std::vector<std::optional<GeogramMesh>>, 4> meshes;
};

/// Two positions in ascending order: an edge wherever it is stored.
using Segment = std::array<Vec3, 2>;
inline Segment segment(const Vec3& a, const Vec3& b) { return a < b ? Segment{a, b} : Segment{b, a}; }

/// Opens the archive and reads every file of it. Files that are no part of a model are dropped into `data`.
Result<GmArchive> read_archive(const Input& input, const Monitor* monitor, Dataset& data);

/// A geological surface: some of the model's surfaces. Those that belong to none are one of their own.
struct Interface {
    std::string name, feature;
    std::vector<std::uint32_t> surfaces;
};
std::vector<Interface> interfaces_of(const GmArchive& archive, Dataset& data);

/// Gives the two sides of a surface nodes of their own along each line that bounds it twice, as RINGMesh does when it opens a model: the
/// file states a cut there, but its meshes share the nodes. Linear in the surfaces that are cut.
void cut_surfaces(GmArchive& archive);

/// Reports where lines do not end at the corners, or surfaces are not bounded by the lines, that are stated to bound them: F113, once for
/// lines and once for surfaces.
void check_bound_lists(const GmArchive& archive, Dataset& data);

/// Makes a Surface of each interface, with a part for each of its surfaces, and a StatedModel over them. Lines and corners that lie on
/// no surface become polyline and point sets.
void build_from_surfaces(GmArchive archive, Dataset& data);

/// Makes one mesh of the cells of the regions and the triangles of the surfaces, with an entity for each, and a StatedModel over it.
void build_from_cells(GmArchive archive, Dataset& data);

/// The regions, layers and the universe of a model, whose faces are stated already in the order of the surfaces.
/// \param face_of_surface  index into model.faces
void state_regions(const GmArchive& archive, std::span<const std::uint32_t> face_of_surface, StatedModel& model, Dataset& data);

/// Puts the corners and lines that lie on no surface into the dataset, and lists what else they carry.
void keep_lines_and_corners(const GmArchive& archive, Dataset& data);

/// "Surface_3" where a record has no name.
std::string name_or_number(const EntityText::Entity& entity, EntityText::Kind kind, std::size_t number);

}  // namespace geomend::ringmesh
