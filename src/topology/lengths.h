// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "model/dataset.h"
#include "topology/brep_from_dataset.h"

namespace geomend::topology {

/// The lengths by which something is judged; they are named in every report.
struct Lengths {
    double diameter = 0;   ///< D, twice the largest distance of a point from the area-weighted centroid
    double tolerance = 0;  ///< up to which points count as one: max(1e-7 D, 4 steps of the stored coordinates), or as given
    Vec3 shares{1, 1, 1};  ///< along each axis the part of the tolerance that holds there: steps of small coordinates are small
    double near = 0;       ///< search length for near misses, or as given
    double flatness = 1;   ///< 1/100 to 1, as flatness() has it: how much the cluster is thinner than D/5

    /// A position in a space in which the tolerance is the same along all axes.
    Vec3 drawn_out(const Vec3& p) const { return {p[0] / shares[0], p[1] / shares[1], p[2] / shares[2]}; }
    /// The least of the tolerances along the axes.
    double finest() const { return tolerance * std::min({shares[0], shares[1], shares[2]}); }
};

/// What the user says of lengths; negative: by rule.
struct LengthRules {
    double tolerance = -1, near = -1;
};

/// A point so far from all others that it is no part of the shape.
struct OutlyingPoint {
    std::uint32_t object, point;  ///< of the Dataset, of the object
    double times;                 ///< its distance from the rest, in diameters of the rest
    bool usual;                   ///< its height is a number that programs write for "no value"
};

/// The lengths of a Dataset's surfaces and cell meshes, cluster by cluster. A cluster is a set of objects that lie near one
/// another compared with their sizes; what lies far off has lengths of its own, and changes none of these.
struct LocalLengths {
    std::vector<Lengths> clusters;
    std::vector<std::uint32_t> cluster_of;  ///< per object; no_index: it has no surface and no cell
    std::vector<OutlyingPoint> outlying;    ///< ascending by object, then by point
    Lengths largest;                        ///< over all clusters, each length by itself

    /// Of an object; those of the largest where it is in no cluster.
    const Lengths& of(std::uint32_t object) const {
        return object < cluster_of.size() && cluster_of[object] != no_index ? clusters[cluster_of[object]] : largest;
    }
};

/// Works the lengths out.
///
/// Parts of objects that hang together by their elements or by equal positions are one; so are parts that come closer to one
/// another than a hundredth of the larger one's D, and a part with what it surrounds. An object is in the cluster in which most of its
/// area is. Of each cluster, with all lengths from points that its elements use:
/// - D is twice the largest distance of a point from the area-weighted centroid, so that it does not depend on how finely
///   something is triangulated (of meshes that have cells of three dimensions only the volume takes the place of the area);
/// - tolerance = max(1e-7 D, 4 steps of the largest coordinate as it is stored), along each axis of the largest one there: heights
///   of a few thousand metres tell layers apart that northings of millions in single precision could not;
/// - near = max(10 tolerances, min(1e-3 D flatness, a quarter of the median edge)): so it is a two hundredth of the thickness of bodies
///   that are thinner than D/5, as basins are (see thickness.h). The median is weighted by area.
/// Outlying points take no part: see find_outlying_points().
/// \pre all coordinates that elements use are finite and below 1e20. Cost: near-linear, about 0.15 s per million triangles.
LocalLengths local_lengths(const Dataset& dataset, const LengthRules& rules);

/// The models of a Dataset as model_sources() has them, their objects in groups by clusters, each with the cluster's tolerance.
std::vector<ModelSource> model_sources(const Dataset& dataset, const LocalLengths& lengths);

}  // namespace geomend::topology
