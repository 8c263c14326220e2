// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/wording.h"
#include "geometry/triangle_tree.h"
#include "topology/brep_from_dataset.h"
#include "validators/grid_scope.h"

namespace geomend::validators {

/// The lengths by which the surfaces and cells of a Dataset are judged, as local_lengths() has them.
topology::LocalLengths lengths_of(const Dataset& dataset, const CheckOptions& options);

/// M09 where points that elements use have coordinates of 1e20 or more: such models are judged no further, since distances
/// and boxes would overflow. Cost: linear.
std::vector<Finding> huge_coordinates(const Dataset& dataset);

/// M15 for each object with points that lie far off and take no part in its lengths. Cost: as the number of such points.
void report_outlying(const Dataset& dataset, const topology::LocalLengths& lengths, std::vector<Finding>& findings);

/// A boundary representation with what all its checks need.
class ModelScope {
public:
    ModelScope(const Dataset& dataset, const topology::JudgedModel& model, const topology::LocalLengths& lengths,
               const CheckOptions& options);

    const BrepData& brep() const { return *model_.brep; }
    const topology::JudgedModel& model() const { return model_; }
    const Dataset& dataset() const { return dataset_; }
    /// By which a surface is judged: those of the cluster of its object.
    const Lengths& lengths(std::uint32_t surface) const { return lengths_[surface]; }
    /// The larger tolerance of two surfaces.
    double tolerance(std::uint32_t a, std::uint32_t b) const { return std::max(lengths_[a].tolerance, lengths_[b].tolerance); }
    const Monitor* monitor() const { return monitor_; }
    bool stopped() const { return monitor_ != nullptr && monitor_->stopped(); }

    /// All polygons as triangles over model vertices, surface by surface; polygons are fans of their first corner.
    std::span<const std::array<std::uint32_t, 3>> triangles() const { return triangles_; }
    std::uint32_t first_triangle(std::uint32_t surface) const { return first_triangle_[surface]; }
    std::uint32_t surface_of(std::uint32_t triangle) const { return surface_of_[triangle]; }
    /// The same for all triangles().
    std::span<const std::uint32_t> surfaces_of_triangles() const { return surface_of_; }
    /// The polygon of its surface that a triangle is a part of.
    std::uint32_t polygon_of(std::uint32_t triangle) const;
    /// The file's own number of a polygon, from 1 in its object.
    std::int64_t file_number(std::uint32_t surface, std::uint32_t polygon) const;
    const Vec3& vertex_of_node(const BrepData::Surface& surface, std::uint32_t node) const {
        return brep().vertices[surface.nodes[node].value];
    }
    /// Whether two nodes of the surface that polygons use are one vertex.
    bool has_twin_nodes(std::uint32_t surface) const { return has_twin_nodes_[surface] != 0; }
    /// A search tree over triangles(), made when first asked for. Not for several threads at once.
    const TriangleTree& tree() const;
    /// Where the lines of one surface alone run: its free borders.
    const std::vector<std::uint8_t>& free_lines() const { return free_line_; }

private:
    const Dataset& dataset_;
    const topology::JudgedModel& model_;
    std::vector<Lengths> lengths_;  // per surface
    const Monitor* monitor_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
    std::vector<std::uint32_t> first_triangle_;  // per surface, and the end
    std::vector<std::uint32_t> surface_of_;      // per triangle
    std::vector<std::uint32_t> polygon_;         // per triangle; empty where all polygons are triangles
    std::vector<std::uint8_t> free_line_, has_twin_nodes_;

    void find_twin_nodes();
    mutable std::unique_ptr<TriangleTree> tree_;
};

/// True for roles whose surfaces may end anywhere.
inline bool may_end_freely(FeatureRole role) { return role == FeatureRole::fault || role == FeatureRole::fracture; }
/// True where no role says whether a surface may end anywhere, or lie within a region.
inline bool is_undecided(FeatureRole role) { return role == FeatureRole::unknown; }
/// Horizons and unconformities.
inline bool is_stratigraphic(FeatureRole role) { return role == FeatureRole::horizon || role == FeatureRole::unconformity; }

/// A finding of the catalogue's severity about no entity yet.
Finding finding_of(std::string_view code, std::string message);
/// About one surface and some of its polygons; they are listed, counted, and the middles of some are marked.
Finding polygons_finding(const ModelScope& scope, std::string_view code, std::uint32_t surface, std::string message,
                         std::span<const std::uint32_t> polygons);
EntityRef surface_ref(const ModelScope& scope, std::uint32_t surface);
/// Makes surfaces the elements of a finding, and names the first of them.
void name_surfaces(const ModelScope& scope, std::span<const std::uint32_t> surfaces, Finding& finding);
EntityRef line_ref(const ModelScope& scope, std::uint32_t line);
EntityRef region_ref(const ModelScope& scope, std::uint32_t region);
/// "region 'Lower'" for a region found by walking along surfaces; "the outside" for no_index.
std::string found_region_name(const ModelScope& scope, std::uint32_t found);
/// Adds the course of a line to a finding; at most 100 of them.
void mark_line(const ModelScope& scope, std::uint32_t line, Finding& finding);

}  // namespace geomend::validators
