// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/objects.h"
#include "validators/grid_scope.h"

namespace geomend::validators {

/// A face of a volume cell: its nodes in cyclic order, as the cell winds it.
struct VolumeFace {
    std::uint32_t cell;
    std::uint32_t first, size;  ///< into CellScope::face_nodes()
};

/// A mesh of cells with what its checks share.
class CellScope {
public:
    CellScope(const CellMesh& mesh, const Lengths& lengths, const CheckOptions& options);

    const CellMesh& mesh() const { return mesh_; }
    const Lengths& lengths() const { return lengths_; }
    const Monitor* monitor() const { return monitor_; }
    bool stopped() const { return monitor_ != nullptr && monitor_->stopped(); }

    /// Cells of three dimensions, ascending.
    std::span<const std::uint32_t> volume_cells() const { return volume_cells_; }
    /// Their signed volumes, see cell_volume(); made when first asked for. Not for several threads at once.
    const std::vector<double>& volumes() const;
    /// All their faces, cell by cell; and the nodes of all faces.
    std::span<const VolumeFace> faces() const { return faces_; }
    std::span<const std::uint32_t> nodes_of(const VolumeFace& face) const { return std::span(face_nodes_).subspan(face.first, face.size); }
    /// Faces in groups with the same set of nodes, as numbers of faces; groups are split by `group_first`.
    std::span<const std::uint32_t> grouped() const { return grouped_; }
    std::span<const std::uint32_t> group_first() const { return group_first_; }
    /// Per node the one that stands for all at its position: equal positions are one.
    std::span<const std::uint32_t> vertex_of() const { return vertex_of_; }

private:
    void collect_faces();
    void group_faces();

    const CellMesh& mesh_;
    Lengths lengths_;
    const Monitor* monitor_;
    mutable std::vector<double> volumes_;
    std::vector<std::uint32_t> volume_cells_;
    std::vector<VolumeFace> faces_;
    std::vector<std::uint32_t> face_nodes_, grouped_, group_first_, vertex_of_;
};

/// A finding about some cells of a mesh: they are listed by the file's own numbers, and counted.
Finding cells_of_mesh_finding(const CellScope& scope, std::string_view code, std::string message, std::span<const std::uint32_t> cells);

/// " of 'name'", or nothing where the mesh has no name.
std::string in_mesh(const CellScope& scope);

}  // namespace geomend::validators
