// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/monitor.h"
#include "model/brep.h"

// How complex a structural model is, before anything is meshed: J. Pellerin, PhD thesis, Universite de Lorraine 2014,
// chapter 3. Elements are regions, surfaces, lines and corners; those of the box around the model are left out.

namespace geomend::complexity {

struct ComplexityOptions {
    double size = 100;              ///< characteristic size h, in the model's unit of length
    double angle = 20;              ///< characteristic angle, degrees
    std::uint32_t sites = 1000;     ///< cells for the local counts; 0: none
    std::uint32_t iterations = 40;  ///< of Lloyd's, that even the cells out
    const Monitor* monitor = nullptr;
};

/// One number for each kind of element, where it is defined.
struct ByKind {
    std::optional<double> regions, surfaces, lines, corners;
    /// Of those that are defined.
    double total() const { return regions.value_or(0) + surfaces.value_or(0) + lines.value_or(0) + corners.value_or(0); }
};

/// Sums over the elements of one kind, each element between 0 and 1.
struct ComplexityTerms {
    double size = 0;       ///< elements smaller than h to the power of their dimension
    double shape = 0;      ///< how far from flat or straight: 1 - projection on the mean plane or line / size
    double thickness = 0;  ///< part of the boundary where it is thinner than h
    double angle = 0;      ///< part of the line length (of corners for surfaces) where the angle is below the given one
    double total() const { return size + shape + thickness + angle; }
};

/// Numbers of elements in the cells of a centroidal Voronoi diagram of the model's volume.
struct CellComplexity {
    struct Counts {
        std::uint32_t corners = 0, lines = 0, surfaces = 0, regions = 0;  ///< lines and surfaces: connected pieces
        std::uint32_t total() const { return corners + lines + surfaces + regions; }
    };
    std::vector<Vec3> sites;
    std::vector<Counts> counts;  ///< of each site's cell
    double resolution = 0;       ///< cube root of volume / sites

    std::uint32_t q10 = 0, q50 = 0, q90 = 0, most = 0;
    double mean = 0, variation = 0;
    std::uint32_t crowded = 0;  ///< cells with more than six elements: hard to mesh at this resolution
};

struct Complexity {
    double size = 0, angle = 0;                               ///< as given
    ByKind m1;                                                ///< numbers of elements
    std::optional<ComplexityTerms> regions, surfaces, lines;  ///< M2
    ByKind m3;  ///< variation of sizes: standard deviation of a sample over the mean; needs two elements
    std::optional<CellComplexity> cells;
    bool box_by_role = false;            ///< the box are surfaces with role boundary; else those with the outside on a side
    std::vector<std::string> undefined;  ///< what could not be measured, and why
    double m2() const { return (regions ? regions->total() : 0) + (surfaces ? surfaces->total() : 0) + (lines ? lines->total() : 0); }
};

/// Measures a boundary representation. What needs closed regions is left out where there are none, and told in
/// `undefined`. Deterministic, whatever the number of threads. Cost: n log n in triangles, and with sites linear in
/// 20 to 100 samples a site and iteration. Stopped by the monitor it returns what it has.
Complexity measure(const BrepData& brep, const ComplexityOptions& options);

}  // namespace geomend::complexity
