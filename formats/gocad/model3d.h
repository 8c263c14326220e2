// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "formats/gocad/object_scanner.h"
#include "model/stated_model.h"

namespace geomend::gocad {

/// The header object of a Model3d as it stands: its faces name TSurf objects that follow in the file.
struct Model3dClaims {
    StatedModel model;  ///< faces without objects
    struct TSurf {
        std::string name;
        std::uint64_t line = 0;
    };
    std::vector<TSurf> tsurfs;
};

/// Reads the body of a `GOCAD Model3d`: TSURF, TFACE with its key triangle, REGION, SURFACE, LAYER and FAULT_BLOCK,
/// in any order, with lists of any length over any number of lines. Numbers that name nothing: F007 in a REGION, F109
/// elsewhere.
Result<Model3dClaims> read_model3d(ObjectScanner& scanner);

/// Gives the faces their objects and parts. Unknown TSurfs are F007, another number of parts than of TFACE records F008.
/// \param objects     all objects
/// \param candidates  indices of the TSurfs that follow this Model3d, in file order
/// \pre every Surface among the candidates has valid indices
void attach_faces(Model3dClaims& claims, const std::vector<Object>& objects, std::span<const std::uint32_t> candidates, ObjectLog& log);

/// Whether a TSurf is the one that a TSURF record of this name means: by its name or its name_in_model_list.
bool goes_by(const ObjectInfo& info, const std::string& name);

}  // namespace geomend::gocad
