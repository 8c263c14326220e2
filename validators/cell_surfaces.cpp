// SPDX-License-Identifier: AGPL-3.0-or-later
// Surfaces in a mesh of cells whose triangles and quadrangles are not faces of its cells: they run through cells, or lie on faces that
// are divided in another way, or use a node twice. What is set on them reaches no cell. Those that keep clear of all cells are something
// else, and fine.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/bounds.h"
#include "base/parallel.h"
#include "base/wording.h"
#include "geometry/box_tree.h"
#include "topology/faces_from_mesh.h"
#include "topology/near_weld.h"
#include "validators/cell_checks.h"
#include "validators/cell_hulls.h"
#include "validators/triangle_overlap.h"

namespace geomend::validators {

namespace {

enum class Fit : std::uint8_t { clear, without_area, on_faces, through };

/// Corners as sorted vertices.
void sorted_vertices(std::span<const std::uint32_t> vertex_of, std::span<const std::uint32_t> nodes, std::vector<std::uint32_t>& vertices) {
    vertices.clear();
    for (const std::uint32_t node : nodes) vertices.push_back(vertex_of[node]);
    std::ranges::sort(vertices);
}

/// Whether two quadrangles of the same vertices run around them in one order: a bow-tie does not.
bool run_alike(std::span<const std::uint32_t> vertex_of, std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
    const auto at = std::ranges::find_if(b, [&](std::uint32_t node) { return vertex_of[node] == vertex_of[a[0]]; });
    const auto i = static_cast<std::size_t>(at - b.begin());
    return i < 4 && vertex_of[b[(i + 2) % 4]] == vertex_of[a[2]];
}

/// The faces of cells at each vertex that an element has.
class FacesAtVertices {
public:
    FacesAtVertices(const CellScope& scope, std::span<const std::uint32_t> vertex_of, std::span<const std::uint32_t> elements)
        : scope_(scope), vertex_of_(vertex_of), first_(scope.mesh().points.size() + 1, 0) {
        std::vector<std::uint8_t> is_asked(scope.mesh().points.size(), 0);
        for (const std::uint32_t element : elements) {
            for (const std::uint32_t node : topology::corner_nodes(scope.mesh(), element)) is_asked[vertex_of[node]] = 1;
        }
        const auto each = [&](const auto& visit) {
            for (std::uint32_t f = 0; f < scope.faces().size(); ++f) {
                for (const std::uint32_t node : scope.nodes_of(scope.faces()[f])) {
                    const std::uint32_t v = vertex_of[node];
                    if (is_asked[v] != 0) visit(v, f);
                }
            }
        };
        each([&](std::uint32_t v, std::uint32_t) { ++first_[v + 1]; });
        for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
        faces_.resize(first_.back());
        auto next = first_;
        each([&](std::uint32_t v, std::uint32_t f) { faces_[next[v]++] = f; });
    }

    /// Whether an element is a face of a cell, half of one, or two together: whether one has all corners of the other.
    bool hold(std::uint32_t element) const {
        const auto nodes = topology::corner_nodes(scope_.mesh(), element);
        std::vector<std::uint32_t> own, theirs;
        sorted_vertices(vertex_of_, nodes, own);
        for (const std::uint32_t node : nodes.first(std::min<std::size_t>(nodes.size(), 2))) {
            const std::uint32_t v = vertex_of_[node];
            for (std::uint64_t k = first_[v]; k < first_[v + 1]; ++k) {
                const auto face = scope_.nodes_of(scope_.faces()[faces_[k]]);
                sorted_vertices(vertex_of_, face, theirs);
                if (nodes.size() == 4 && own == theirs && !run_alike(vertex_of_, nodes, face)) continue;
                if (own.size() < theirs.size() ? std::ranges::includes(theirs, own) : std::ranges::includes(own, theirs)) return true;
            }
        }
        return false;
    }

private:
    const CellScope& scope_;
    std::span<const std::uint32_t> vertex_of_;
    std::vector<std::uint64_t> first_;
    std::vector<std::uint32_t> faces_;
};

/// Takes off the elements that are faces of cells, where nodes with one vertex are one.
void take_off_faces(const CellScope& scope, std::span<const std::uint32_t> vertex_of, std::vector<std::uint32_t>& elements) {
    const FacesAtVertices faces(scope, vertex_of, elements);
    std::vector<std::uint8_t> is_face(elements.size());
    parallel_blocks(elements.size(), 1024, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) is_face[i] = faces.hold(elements[i]) ? 1 : 0;
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        if (is_face[i] == 0) elements[kept++] = elements[i];
    }
    elements.resize(kept);
}

/// Elements of two dimensions that are not faces of cells, ascending. Those that are within the tolerance match: that their nodes are not
/// one is M27.
std::vector<std::uint32_t> elements_without_face(const CellScope& scope) {
    const CellMesh& mesh = scope.mesh();
    std::vector<std::uint32_t> elements;
    for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
        if (dimension(mesh.types[c]) == 2 && topology::corner_nodes(mesh, c).size() >= 3) elements.push_back(c);
    }
    if (!elements.empty()) take_off_faces(scope, scope.vertex_of(), elements);
    if (elements.empty() || !(scope.lengths().tolerance > 0)) return elements;
    const auto near = topology::clusters_within(mesh.points, scope.lengths().tolerance);
    if (!near.empty()) take_off_faces(scope, near, elements);
    return elements;
}

/// Tells how elements lie among the cells.
class CellsAround {
public:
    explicit CellsAround(const CellScope& scope) : scope_(scope), hulls_(scope), tree_(hulls_.boxes()) {}

    Fit fit(std::uint32_t element) const {
        const auto nodes = topology::corner_nodes(scope_.mesh(), element);
        std::vector<std::uint32_t> own;
        sorted_vertices(scope_.vertex_of(), nodes, own);
        if (std::ranges::adjacent_find(own) != own.end()) return Fit::without_area;
        Fit most = Fit::clear;
        for (std::size_t k = 1; k + 1 < nodes.size() && most != Fit::through; ++k) {
            most = std::max(most, fit(std::array{point(nodes[0]), point(nodes[k]), point(nodes[k + 1])}));
        }
        return most;
    }

private:
    using Corners3 = std::array<Vec3, 3>;
    const CellScope& scope_;
    CellHulls hulls_;
    BoxTree tree_;

    const Vec3& point(std::uint32_t node) const { return scope_.mesh().points[node]; }

    Fit fit(const Corners3& triangle) const {
        const double tolerance = scope_.lengths().tolerance;
        const Bounds around = bounds_around(triangle);
        Fit most = Fit::clear;
        tree_.visit({around.low, around.high}, -tolerance, [&](std::uint32_t i) {
            if (most == Fit::through) return;
            if (hulls_.holds_part_of(i, triangle, tolerance)) most = Fit::through;
            else if (most == Fit::clear && lies_on_faces(i, triangle, tolerance)) most = Fit::on_faces;
        });
        return most;
    }

    bool lies_on_faces(std::uint32_t i, const Corners3& triangle, double tolerance) const {
        for (const VolumeFace& face : hulls_.faces_of(i)) {
            const auto nodes = scope_.nodes_of(face);
            for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
                if (lie_on_each_other(triangle, {point(nodes[0]), point(nodes[k]), point(nodes[k + 1])}, tolerance)) return true;
            }
        }
        return false;
    }
};

void tell(const CellScope& scope, std::span<const std::uint32_t> elements, const char* what, std::vector<Finding>& findings) {
    if (elements.empty()) return;
    findings.push_back(
        cells_of_mesh_finding(scope, "M39", counted(elements.size(), "face", "faces") + " of surfaces" + in_mesh(scope) + what, elements));
}

}  // namespace

void check_cell_surfaces(const CellScope& scope, std::vector<Finding>& findings) {
    if (scope.volume_cells().empty()) return;
    const auto elements = elements_without_face(scope);
    if (elements.empty()) return;
    const CellsAround cells(scope);
    std::vector<Fit> fits(elements.size(), Fit::clear);
    parallel_blocks(elements.size(), 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last && !scope.stopped(); ++i) fits[i] = cells.fit(elements[i]);
    });
    const auto with = [&](Fit fit) {
        std::vector<std::uint32_t> some;
        for (std::size_t i = 0; i < elements.size(); ++i) {
            if (fits[i] == fit) some.push_back(elements[i]);
        }
        return some;
    };
    const auto through = with(Fit::through), on_faces = with(Fit::on_faces), without_area = with(Fit::without_area);
    tell(scope, through, through.size() == 1 ? " runs through cells" : " run through cells", findings);
    tell(scope, on_faces, on_faces.size() == 1 ? " lies on cells without being a face of one" : " lie on cells without being faces of them",
         findings);
    tell(scope, without_area,
         without_area.size() == 1 ? " uses a node twice, and is no face of a cell" : " use a node twice, and are no faces of cells",
         findings);
}

}  // namespace geomend::validators
