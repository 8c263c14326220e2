// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "pipeline/convert.h"
#include "remesh/remesh.h"
#include "remesh/sites.h"
#include "validators/registry.h"

namespace geomend {

/// What the user wants of new triangles.
struct RemeshRequest {
    ConvertRequest files;
    validators::CheckOptions checks;  ///< by which the model is judged before and after
    remeshing::RemeshOptions remesh;
    bool keep_invalid = false;  ///< write a result that has errors which the input had not
};

/// Numbers of corners, lines, surfaces and regions.
using EntityCounts = std::array<std::uint64_t, 4>;

/// A region by its surfaces as they were and as they are.
struct RegionVolume {
    std::string name;
    double before = 0, after = 0;
    Vec3 middle{};  ///< of its vertices, as they were

    /// By more than a hundredth, which is worth a word.
    bool differs() const { return !(std::abs(after - before) <= 0.01 * std::abs(before)); }
};

/// What came of it.
struct RemeshReport {
    ConvertReport written;
    struct Model {
        std::string name;
        EntityCounts counts{}, counts_after{};  ///< after: of the model that is built from what is written
        remeshing::VertexCounts vertices;       ///< of its new surfaces
        std::vector<RegionVolume> regions;      ///< that are closed, before and after
        remeshing::Remeshed made;               ///< its boundary representation is gone
    };
    std::vector<Model> models;
    double size = 0;          ///< of edges
    std::uint64_t sites = 0;  ///< how many vertices inside of surfaces were asked for; 0: a size was
    std::uint64_t sites_reached() const;
    std::uint64_t errors_before = 0;
    std::vector<Finding> errors;  ///< that are found after it
    std::string why_not;          ///< what speaks against the result; empty: nothing
    bool is_written = false;
};

/// Reads all inputs as one model, gives lines new vertices and surfaces new triangles, builds the model again from what came of it and
/// checks that it has the same numbers of corners, lines, surfaces and regions, and no errors that it had not. Else nothing is
/// written, unless that is asked for. Failure as of convert() and remesh_model(); (cannot_hold, F026) where there is no surface.
Result<RemeshReport> remesh(const RemeshRequest& request);

/// The same of a dataset in memory, which is changed. Failures as above. \param target that it is to be written in
Result<void> remesh(Dataset& dataset, const Format& target, const RemeshRequest& request, RemeshReport& report);

/// A line for each region whose volume differs, with the middle of it; empty: none does.
std::string changed_volumes(const RemeshReport& report);

/// The size that gives about as many vertices as were asked for, and how many; empty where a size was asked for.
std::string sites_found(const RemeshReport& report);

/// That the number of vertices asked for is missed by more than a tenth; empty where it is not.
std::string sites_missed(const RemeshReport& report);

/// What INTERFACE states of `remesh --json`.
std::string remesh_json(const RemeshReport& report);

}  // namespace geomend
