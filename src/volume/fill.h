// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/monitor.h"
#include "base/result.h"
#include "model/loss.h"
#include "topology/assemble.h"
#include "volume/cut_by_wells.h"
#include "volume/improve.h"
#include "volume/narrow_cells.h"
#include "volume/tetrahedra.h"
#include "volume/well_network.h"

namespace geomend::volumes {

struct FillOptions {
    double size = 0;  ///< edges of cells inside, as far as surfaces allow; 0: the median edge of the triangles around each region
    std::vector<std::pair<std::string, double>> size_of;  ///< the same of regions by name
    double ratio = 1.4;   ///< most radius of the sphere around a cell by its shortest edge, as far as surfaces allow; 0: any
    bool improve = true;  ///< whether bad cells are worked on when a region is filled
    /// Vertices that a region should have inside, on no facet of it, and no others but what is needed: shapes and sizes are theirs.
    /// Where cells are not improved, flat ones between points of a lattice stay.
    std::function<std::vector<Vec3>(const RegionFacets&)> points;
    /// Where cells of such points are made first: somewhere else for each place, nearby ones near each other and turned the same way, so
    /// that a lattice which dips or narrows is an even one there. Nothing for a region that has no such places; empty: none has.
    std::function<std::vector<Vec3>(const RegionFacets&, std::span<const Vec3>)> straightened;
    /// Sizes of cells at points in and around a region, between which they change, in place of one size for all of it.
    std::function<std::vector<SizedPoint>(const RegionFacets&)> sizes;
    std::vector<WellPath> wells;  ///< that are to be chains of edges of cells
    double well_tolerance = 0;    ///< with wells: points and surfaces nearer to them than that lie on them; above 0
    ChildLimits limits;           ///< for each try
    const Monitor* monitor = nullptr;
};

/// The most volume of cells of a size: that of 1.5 regular tetrahedra with such edges. So edges inside are in the middle 0.9 to 1.0 times
/// as long as the size; with the volume of one they would be 0.8 to 0.9 times as long, and cells half as many more.
double most_cell_volume(double size);

/// How a region was filled.
struct FilledRegion {
    std::string name;
    std::uint64_t cells = 0, new_vertices = 0;
    double volume = 0;          ///< of its cells
    double surface_volume = 0;  ///< enclosed by its surfaces
    double least_dihedral = 0;  ///< degrees
    ShapeCounts shapes;
    NarrowCells narrow;
    Improvement improvement;
    std::string rung;                  ///< the method that served; empty: none did
    bool as_asked = true;              ///< false: shapes and sizes that were asked for could not be had
    std::vector<std::string> why_not;  ///< why those before it did not
    bool hit_limit = false;            ///< of time: one of those did
    double seconds = 0;                ///< on the wall
    std::uint64_t well_edges = 0;      ///< that lie inside, on no surface
    bool filled() const { return !rung.empty(); }
};

struct Filled {
    BrepData brep;                       ///< the model with tetrahedra in its regions; those that were not filled are empty
    std::vector<FilledRegion> regions;   ///< as those of the boundary representation
    std::vector<Loss> losses;            ///< cells that regions had before, and their values
    std::vector<WellChain> wells;        ///< one for each that was asked for
    std::uint64_t surface_vertices = 0;  ///< that lines and surfaces got since cells could not be made without them
};

/// Fills all regions of a sealed model with tetrahedra. Surfaces stay as they are: each of their triangles is a face of one cell on
/// either side that is in a region; wells cut them first, where there are any. Cells that regions held before give way. Each region is
/// tried with good shapes first, then with any. Failure as of facets_of_regions() and cut_by_wells(), or (cancelled). Regions that nothing
/// fills are told in `regions`. Results do not depend on the number of threads. Cost: that of TetGen; regions side by side.
Result<Filled> fill_regions(const BrepData& brep, const topology::FoundRegions& found, const FillOptions& options);

/// The same of a model that wells have cut; those of the options are not cut again.
Result<Filled> fill_regions(CutByWells cut, const topology::FoundRegions& found, const FillOptions& options);

inline Result<Filled> fill_regions(const topology::JudgedModel& model, const FillOptions& options) {
    return fill_regions(*model.brep, model.found, options);
}

/// The same; where nothing fills a region as its surfaces are, they and their lines get vertices where the tetrahedra have them, on
/// both sides, and all is tried again. Shapes stay, values lie between those that were there. Cost: that of the first, up to four times.
Result<Filled> fill_dividing_surfaces(const BrepData& brep, const topology::FoundRegions& found, const FillOptions& options);

}  // namespace geomend::volumes
