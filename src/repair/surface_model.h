// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "model/dataset.h"
#include "model/origin.h"
#include "repair/removed.h"
#include "topology/lengths.h"
#include "topology/soup_front.h"

namespace geomend::repair {

/// The surfaces of a Dataset while they are mended: what they were, what they have become, and which came from which.
struct SurfaceModel {
    /// Triangles in patches over shared vertices. Its patches, one for each part of a surface that was read, keep their numbers
    /// whatever is done; attributes and regions are not in it, but below.
    topology::SoupModel model;

    /// As read: patch by patch, each with vertices of its own.
    TriangleSoup source;
    Origin origin;  ///< of model.soup in source

    /// What belongs to a patch as it was read.
    struct SourcePatch {
        std::uint32_t first_vertex = 0, first_triangle = 0;  ///< in source; they end where those of the next patch begin
        std::vector<Attribute> attributes;                   ///< over its vertices (point) or triangles (polygon), or for the whole
        std::uint32_t object = no_index;                     ///< of the Dataset
        std::int64_t number = 0;                             ///< of the face in its file; 0: none
        enum Cuts : std::uint8_t { unstated, if_most, stated } cuts = unstated;  ///< whether doubled nodes state where it is cut
        double diameter = 0;  ///< D of the cluster that it was read in; 0: it was not read
    };
    std::vector<SourcePatch> source_patches;
    /// Per vertex of the source the node of its patch that it counts as; empty: each counts as itself. See join_lone_twins().
    std::vector<std::uint32_t> counts_as;

    /// Regions as they were read, over patches as they are wound there.
    std::vector<topology::StatedRegion> regions;
    /// Layers and fault blocks over them.
    std::vector<topology::SurfaceComplex::RegionList> layers, fault_blocks;

    /// Where patches ended freely before they were cut: what lies between there and a line of the cut may be a tail.
    struct BorderSegment {
        Vec3 from, to;
        std::uint32_t patch;
    };
    std::vector<BorderSegment> uncut_borders;

    /// Per patch of which nothing is left, being in others, one of these; else no_index. Empty: there is none.
    std::vector<std::uint32_t> lies_in;
    /// Per patch the one that its triangles belong to now; no_index: it was removed, as it was asked for. May be shorter than the
    /// patches: the others are themselves.
    std::vector<std::uint32_t> became;

    /// Per triangle of the soup 1 where a step put it beside a border; empty: none is. See is_added().
    std::vector<std::uint8_t> added;
    std::vector<RemovedTriangle> removed;           ///< what steps left out, in their order
    std::vector<std::array<Vec3, 2>> erased_edges;  ///< of what was read: edges of traces of which a vertex was erased

    topology::LengthRules rules;         ///< what was given of lengths
    topology::Lengths lengths;           ///< by which it is mended, from the input or as given
    double diameter = 0;                 ///< the largest D of what was read: what is added around it later is not in it
    std::vector<std::uint32_t> objects;  ///< of the Dataset that are in it, ascending
    struct StrayPoint {
        std::string surface;
        Vec3 at;
    };
    std::vector<StrayPoint> stray;  ///< points that lie far off: no part of the shape
    std::vector<Loss> losses;       ///< what was read but cannot be mended here: cells of regions
};

/// All surfaces of a Dataset as one model: those of stated models, of tagged meshes, and loose ones. Equal positions become one
/// vertex; polygons become triangles. Loose surfaces of one name, or of none, get names of their own.
/// Failure (usage) where there is no surface. Cost: near-linear.
Result<SurfaceModel> surface_model_of(const Dataset& dataset, const topology::LengthRules& rules);

/// Puts what a step made in place of the soup: the origins of the two are joined, and corners go to where their vertices are.
/// \pre `origin` is of `soup` in model.model.soup
void take_soup(SurfaceModel& model, TriangleSoup soup, const Origin& origin);

/// After a step that added something around a model: the lengths by which what was there will be judged with that, so that it is
/// mended by them. \param patches so many were there before. Cost: near-linear.
void measure_lengths(SurfaceModel& model, std::uint32_t patches);

}  // namespace geomend::repair
