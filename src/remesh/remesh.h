// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/monitor.h"
#include "base/result.h"
#include "model/brep.h"
#include "model/loss.h"
#include "remesh/pattern.h"
#include "remesh/size_rules.h"
#include "remesh/surface_job.h"
#include "remesh/triangle_quality.h"

namespace geomend::remeshing {

/// How sizes grow with centroidal cells: gently, since as many triangles are then of a better shape in all.
inline constexpr double centroidal_growth = 0.1;

struct RemeshOptions {
    double size = 0;          ///< of edges, above 0
    std::uint64_t sites = 0;  ///< vertices inside of surfaces, for which remesh_models() finds a size; 0: by size
    Method method = Method::isotropic;
    std::vector<std::pair<std::string, double>> size_of;  ///< of interfaces or surfaces by name
    std::vector<SizeRule> size_by;                        ///< distances, curvature, properties
    double growth = 0.3;                                  ///< sizes grow by no more than this share of the way
    double max_distance = 0;           ///< between new and old surfaces; 0: a tenth of the size, 1/200 of the model at most
    const Pattern* pattern = nullptr;  ///< where new vertices lie, in place of even spacing by sizes
    std::uint64_t most_triangles = 20'000'000;
    const Monitor* monitor = nullptr;
};

/// What has become of a surface.
struct RemeshedSurface {
    std::string name, interface;
    bool kept = false;  ///< it is as it was
    std::string why;    ///< if so
    TriangleQuality before, after;
    double to_old = 0, from_old = 0;  ///< largest distances from new to old, and from old to new
};

struct Remeshed {
    BrepData brep;                          ///< lines, surfaces, regions and corners as they were, with new vertices and triangles
    std::vector<RemeshedSurface> surfaces;  ///< as those of the boundary representation
    std::uint64_t line_edges_before = 0, line_edges_after = 0;
    double max_distance = 0;  ///< that was allowed
    unsigned rounds = 0;
    std::vector<Loss> losses;  ///< cells that regions had, and their values
};

/// Gives a model new triangles. Lines are sampled once, corners stay, and each surface is remeshed against its lines, so that
/// contacts stay conformal. Where surfaces come out too far from what they were, or cross where they did not, sizes are lowered
/// there and they are done again; a surface that does not come right stays as it was, with its lines, and the reason is given.
/// Values of surfaces are interpolated. Results do not depend on the number of threads.
/// Failure (limit, F023) where the size makes more triangles than allowed, (cancelled) when stopped. Cost: near-linear in the old and
/// new triangles.
Result<Remeshed> remesh_model(const BrepData& brep, const RemeshOptions& options);

}  // namespace geomend::remeshing
