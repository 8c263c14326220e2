// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/monitor.h"
#include "remesh/line_plan.h"
#include "remesh/reference_surface.h"

namespace geomend::remeshing {

/// What has become of a surface.
struct NewSurface {
    bool kept = false;  ///< as it was
    std::string why;    ///< it cannot be anything else, if so
    std::vector<Vec3> places;
    std::vector<std::uint32_t> names;                 ///< per vertex as of LinePlan; no_index: inside of the surface
    std::vector<std::uint32_t> corners;               ///< three per triangle
    std::vector<std::uint32_t> neighbours;            ///< per corner the triangle across the edge to the next one
    std::vector<std::array<std::uint32_t, 2>> nodes;  ///< of the model's surface between which a named vertex lies; else no_index
    struct Source {
        std::array<std::uint32_t, 3> rows;  ///< nodes of the surface as it was
        Weights weights;
    };
    std::vector<Source> sources;                  ///< per vertex
    std::vector<std::uint32_t> source_triangles;  ///< per triangle that of the surface as it was in which its middle lies
    std::vector<std::uint32_t> stuck;             ///< vertices of the model on lines that could not give way
    double to_old = 0;    ///< largest distance from the surface as it was: at vertices, middles, and where edges pass over its edges
    double from_old = 0;  ///< largest distance of the surface as it was from this one: at its vertices, and where edges pass over edges
    /// Where it is too far: vertices of the model, and by how many times the distance that is allowed.
    std::vector<std::pair<std::uint32_t, double>> too_far;
};

/// How surfaces get new triangles.
enum class Method : std::uint8_t {
    keep,        ///< they have none: all stays as it is
    isotropic,   ///< remesh_isotropic()
    centroidal,  ///< remesh_centroidal()
    frontal      ///< remesh_frontal()
};

struct SurfaceRules {
    double max_distance = 0;
    const Pattern* pattern = nullptr;                         ///< what takes the place of even triangles, where it is given
    double size = 0;                                          ///< below which vertices of a surface as it was stay with a pattern
    std::span<const std::array<std::uint32_t, 2>> bridges{};  ///< names of vertices between which no inner edge may run
    const Monitor* monitor = nullptr;
    Method method = Method::isotropic;  ///< without a pattern
};

/// A surface as it was, by the names of its vertices; all vertices of its lines must be kept then.
NewSurface surface_as_it_was(const BrepData& brep, std::uint32_t surface);

/// Remeshes a surface against its lines. Where that cannot be it is kept, with the reason. \param sizes at the vertices of the model
NewSurface remeshed_surface(const BrepData& brep, std::uint32_t surface, const LinePlan& lines, const VertexSizes& sizes,
                            const SurfaceRules& rules);

}  // namespace geomend::remeshing
