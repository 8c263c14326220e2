// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/length.h"
#include "complexity/complexity.h"
#include "geometry/principal_axes.h"
#include "geometry/vectors.h"

// What the files complexity_*.cpp share.

namespace geomend::complexity {

/// A surface as triangles over model vertices; larger polygons are fans.
struct SurfaceTriangles {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::array<std::uint32_t, 3>> across;  ///< triangle behind edge i -> i+1, or no_index at borders and lines
};
SurfaceTriangles triangulated(const BrepData::Surface& surface);

/// A B-Rep made ready to be measured: triangles, positions relative to the middle of the model, and what is of the box.
struct MeasuredModel {
    /// \pre the B-Rep outlives it
    explicit MeasuredModel(const BrepData& brep);
    explicit MeasuredModel(BrepData&&) = delete;

    const BrepData& brep;
    std::vector<Vec3> points;  ///< of model vertices, relative to `origin`
    Vec3 origin{};
    std::vector<SurfaceTriangles> surfaces;
    std::vector<std::uint8_t> surface_in_box, line_in_box;  ///< 1: left out of all counts
    /// 1: on the box, or there only because a closed line must begin somewhere.
    std::vector<std::uint8_t> corner_left_out;
    bool box_by_role = false;
    bool closed = false;  ///< every region closes, and there is one
    double volume = 0;    ///< of all regions, where closed

    double area(const std::array<std::uint32_t, 3>& triangle) const;
    Vec3 area_vector(const std::array<std::uint32_t, 3>& triangle) const;  ///< normal times area
};

/// a + t b
Vec3 moved(const Vec3& a, const Vec3& b, double t = 1);

/// Shape of a surface and of a line: 1 - projection on its mean plane or line / size.
double surface_shape(const MeasuredModel& model, std::size_t surface);
double line_shape(const MeasuredModel& model, std::size_t line);

/// For each region the part of its boundary's area from which, straight inwards, another point of the boundary is nearer
/// than h.
std::vector<double> thin_parts_of_regions(const MeasuredModel& model, double h);
/// For each surface the part of its border's length from which another point of the border is nearer than h, going
/// straight ahead on the surface.
std::vector<double> thin_parts_of_surfaces(const MeasuredModel& model, double h);

/// For each region the part of the length of its lines along which two of its surfaces meet at less than `degrees`.
std::vector<double> sharp_parts_of_regions(const MeasuredModel& model, double degrees);
/// For each surface the part of its corners where two of its lines meet at less than `degrees`.
std::vector<double> sharp_parts_of_surfaces(const MeasuredModel& model, double degrees);

/// Sites of a centroidal Voronoi diagram of the volume of all regions, relative to the model's origin.
/// \pre model.closed
std::vector<Vec3> volume_sites(const MeasuredModel& model, const ComplexityOptions& options);
/// What lies in the cell of each site.
std::vector<CellComplexity::Counts> counts_in_cells(const MeasuredModel& model, std::span<const Vec3> sites, const Monitor* monitor);

}  // namespace geomend::complexity
