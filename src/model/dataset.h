// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/finding.h"
#include "model/brep.h"
#include "model/loss.h"
#include "model/objects.h"
#include "model/stated_model.h"

namespace geomend {

/// Everything that was read from a file, or is to be written to one.
struct Dataset {
    std::string format;   ///< family: "gocad", "vtk", "gmsh", ...
    std::string variant;  ///< e.g. "Model3d", "MSH 2.2 binary", "XML unstructured grid"
    std::vector<Object> objects;
    std::vector<StatedModel> models;  ///< what the file claims; readers fill it
    std::vector<Brep> breps;          ///< filled by src/topology, never by a reader; breps[i] belongs to a model or mesh
    std::vector<StatedGroup> groups;  ///< in file order, those that hold others before them
    std::vector<Annotation> annotations;
    std::vector<Finding> findings;  ///< read, but worth telling
    std::vector<Loss> losses;       ///< in the file, but not in this Dataset
};

/// How many records of its own format the dataset keeps beside its objects: a writer of another format loses them.
inline std::size_t kept_records(const Dataset& dataset) { return dataset.groups.size() + dataset.annotations.size(); }

}  // namespace geomend
