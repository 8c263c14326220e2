// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>

#include "formats/format.h"
#include "formats/gocad/object_writers.h"

namespace geomend::gocad {

/// Writes all objects, in their order and groups, into one Gocad file: any object may stand in any Gocad file, so that
/// .ts, .pl, .vs, .gp and the like share this. Regions, layers and faces of models over surfaces have no place here and are
/// listed as losses.
Result<std::vector<Loss>> write_objects(const Dataset& dataset, OutputSet& files, const WriteOptions& options);

/// The same, with LightTSolid instead of TSolid for cell meshes.
Result<std::vector<Loss>> write_light_objects(const Dataset& dataset, OutputSet& files, const WriteOptions& options);

/// Writes each model over surfaces as a Model3d with its TSurfs, then all other objects. A Dataset without a model is refused
/// (cannot_hold): without faces and regions it is no Model3d, and .ts holds surfaces as they are.
Result<std::vector<Loss>> write_model3d(const Dataset& dataset, OutputSet& files, const WriteOptions& options);

/// Writes the objects of the given indices with BEGIN_MEMBERS and END_MEMBERS around those in groups.
/// \param light cell meshes become LightTSolids
Result<void> write_grouped(std::span<const std::uint32_t> objects, bool light, GocadOutput& to);

/// Text annotations of the file itself: comments.
void write_file_comments(const Dataset& dataset, OutputFile& out);

}  // namespace geomend::gocad
