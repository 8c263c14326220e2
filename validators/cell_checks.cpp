// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/cell_checks.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/cell_volume.h"
#include "geometry/corner_frames.h"
#include "topology/near_nodes.h"
#include "validators/cell_findings.h"
#include "validators/model_scope.h"

namespace geomend::validators {

namespace {

bool polyhedron(const CellScope& scope, std::uint32_t cell) { return scope.mesh().types[cell] == CellType::polyhedron; }

/// Least part of the cube over its longest side that a cell must fill for its sign to say anything.
constexpr double least_share = 1e-9;

/// The largest distance of a node of a cell from its first one.
double extent(const CellMesh& mesh, std::uint32_t cell) {
    const auto nodes = mesh.cell_nodes(cell);
    double square = 0;
    for (const std::uint32_t node : nodes) {
        const Vec3 d = minus(mesh.points[node], mesh.points[nodes[0]]);
        square = std::max(square, dot(d, d));
    }
    return std::sqrt(square);
}

/// +1 or -1: the sign that most cells have whose corner order tells one; by type, since conventions differ by type. Cells next to
/// without volume have no say: their sign is chance. Where as many have either, the sign is +1.
std::map<CellType, double> majority_signs(const CellScope& scope, std::span<const double> volumes) {
    std::map<CellType, std::int64_t> votes;
    for (std::size_t i = 0; i < volumes.size(); ++i) {
        const std::uint32_t cell = scope.volume_cells()[i];
        const double size = extent(scope.mesh(), cell);
        const bool counts = std::abs(volumes[i]) > least_share * size * size * size;
        votes[scope.mesh().types[cell]] += !counts ? 0 : volumes[i] > 0 ? 1 : -1;
    }
    std::map<CellType, double> signs;
    for (const auto& [type, vote] : votes) signs[type] = vote < 0 ? -1 : 1;
    return signs;
}

/// Types whose cells are inside out as a whole: programs that go by the order of nodes take their volumes for negative.
void tell_turned_types(const CellScope& scope, const std::map<CellType, double>& signs, std::vector<Finding>& findings) {
    std::vector<std::uint32_t> cells;
    std::string types;
    for (const auto& [type, sign] : signs) {
        if (sign > 0 || type == CellType::polyhedron) continue;
        types += (types.empty() ? "" : ", ") + std::string(to_string(type));
    }
    if (types.empty()) return;
    for (const std::uint32_t cell : scope.volume_cells()) {
        const CellType type = scope.mesh().types[cell];
        if (type != CellType::polyhedron && signs.at(type) < 0) cells.push_back(cell);
    }
    findings.push_back(cells_of_mesh_finding(scope, "M35",
                                             "all or most cells" + in_mesh(scope) + " of this type are inside out: " + types +
                                                 "; their volumes are negative in VTK's order of nodes",
                                             cells));
}

/// Three times the edges from a corner, as rows; six volumes of their tetrahedron.
double corner_jacobian(const CellMesh& mesh, std::span<const std::uint32_t> nodes, std::array<unsigned, 4> corner) {
    const Vec3& o = mesh.points[nodes[corner[0]]];
    return dot(minus(mesh.points[nodes[corner[1]]], o),
               cross(minus(mesh.points[nodes[corner[2]]], o), minus(mesh.points[nodes[corner[3]]], o)));
}

}  // namespace

void check_cell_volumes(const CellScope& scope, std::vector<Finding>& findings) {
    const auto& volumes = scope.volumes();
    const auto signs = majority_signs(scope, volumes);
    std::vector<std::uint32_t> wrong;
    std::uint64_t empty = 0;
    const double least = std::pow(scope.lengths().tolerance, 3);
    for (std::size_t i = 0; i < volumes.size(); ++i) {
        const std::uint32_t cell = scope.volume_cells()[i];
        const double v = volumes[i] * (polyhedron(scope, cell) ? (volumes[i] < 0 ? -1 : 1) : signs.at(scope.mesh().types[cell]));
        if (v > least) continue;
        wrong.push_back(cell);
        empty += std::abs(v) <= least ? 1 : 0;
    }
    tell_turned_types(scope, signs, findings);
    if (wrong.empty()) return;
    const std::uint64_t turned = wrong.size() - empty;
    std::string message;
    if (turned > 0)
        message = counted(turned, "cell", "cells") + in_mesh(scope) + (turned == 1 ? " is" : " are") + " inside out, unlike the others";
    if (empty > 0)
        message += (turned > 0 ? ", and " + std::to_string(empty) : counted(empty, "cell", "cells") + in_mesh(scope)) +
                   (empty == 1 ? " has no volume" : " have no volume");
    findings.push_back(cells_of_mesh_finding(scope, "M20", std::move(message), wrong));
}

void check_cell_jacobians(const CellScope& scope, std::vector<Finding>& findings) {
    const auto& volumes = scope.volumes();
    const auto signs = majority_signs(scope, volumes);
    std::vector<std::uint32_t> folded;
    double worst = 0;
    for (std::size_t i = 0; i < volumes.size(); ++i) {
        const std::uint32_t cell = scope.volume_cells()[i];
        const CellType type = linear_type(scope.mesh().types[cell]);
        const double sign = signs.at(scope.mesh().types[cell]);
        if (volumes[i] * sign <= 0 || type == CellType::tetrahedron) continue;  // M20; a tetrahedron is as its volume
        double least = HUGE_VAL;
        for (const auto& corner : corner_frames(type)) {
            least = std::min(least, sign * corner_jacobian(scope.mesh(), scope.mesh().cell_nodes(cell), corner) / std::abs(volumes[i]));
        }
        if (least > -1e-12) continue;
        worst = std::min(worst, least);
        folded.push_back(cell);
    }
    if (folded.empty()) return;
    Finding finding =
        cells_of_mesh_finding(scope, "M21",
                              counted(folded.size(), "cell", "cells") + in_mesh(scope) + (folded.size() == 1 ? " is" : " are") +
                                  " folded at a corner (worst Jacobian " + rounded(worst) + " of the cell's volume)",
                              folded);
    finding.measures = {{"jacobian", worst}};
    findings.push_back(std::move(finding));
}

void check_cell_nodes(const CellScope& scope, std::vector<Finding>& findings) {
    std::vector<std::uint32_t> wrong;
    std::vector<std::uint32_t> sorted;
    for (const std::uint32_t c : scope.volume_cells()) {
        const auto nodes = scope.mesh().cell_nodes(c);
        sorted.clear();
        for (const std::uint32_t node : nodes) sorted.push_back(scope.vertex_of()[node]);
        std::ranges::sort(sorted);
        if (std::ranges::adjacent_find(sorted) != sorted.end()) wrong.push_back(c);
    }
    if (wrong.empty()) return;
    findings.push_back(cells_of_mesh_finding(
        scope, "M22", counted(wrong.size(), "cell", "cells") + in_mesh(scope) + (wrong.size() == 1 ? " uses" : " use") + " a node twice",
        wrong));
}

void check_cell_faces(const CellScope& scope, std::vector<Finding>& findings) {
    std::vector<std::uint32_t> cells;
    std::uint64_t faces = 0;
    for (std::size_t g = 0; g + 1 < scope.group_first().size(); ++g) {
        const auto group = scope.grouped().subspan(scope.group_first()[g], scope.group_first()[g + 1] - scope.group_first()[g]);
        if (group.size() <= 2) continue;
        ++faces;
        for (const std::uint32_t f : group) cells.push_back(scope.faces()[f].cell);
    }
    if (cells.empty()) return;
    std::ranges::sort(cells);
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    findings.push_back(cells_of_mesh_finding(
        scope, "M23", counted(faces, "face", "faces") + in_mesh(scope) + (faces == 1 ? " is" : " are") + " on more than two cells", cells));
}

void check_polyhedra(const CellScope& scope, std::vector<Finding>& findings) {
    std::vector<std::uint32_t> open;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    const auto faces = scope.faces();
    for (std::size_t f = 0; f < faces.size();) {
        const std::uint32_t cell = faces[f].cell;
        edges.clear();
        std::size_t end = f;
        for (; end < faces.size() && faces[end].cell == cell; ++end) {
            if (!polyhedron(scope, cell)) continue;
            const auto nodes = scope.nodes_of(faces[end]);
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                const std::uint32_t a = scope.vertex_of()[nodes[i]], b = scope.vertex_of()[nodes[(i + 1) % nodes.size()]];
                if (a != b) edges.emplace_back(std::min(a, b), std::max(a, b));
            }
        }
        std::ranges::sort(edges);
        bool closed = true;
        for (std::size_t i = 0; i < edges.size() && closed;) {
            std::size_t j = i + 1;
            while (j < edges.size() && edges[j] == edges[i]) ++j;
            closed = (j - i) % 2 == 0;
            i = j;
        }
        if (!closed) open.push_back(cell);
        f = end;
    }
    if (open.empty()) return;
    findings.push_back(cells_of_mesh_finding(
        scope, "M25", "the faces of " + counted(open.size(), "polyhedron", "polyhedra") + in_mesh(scope) + " do not close", open));
}

void check_cell_repeats(const CellScope& scope, std::vector<Finding>& findings) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
    const auto nodes_of = [&](std::uint32_t c) {
        std::vector<std::uint32_t> nodes;
        for (const std::uint32_t node : scope.mesh().cell_nodes(c)) nodes.push_back(scope.vertex_of()[node]);
        std::ranges::sort(nodes);
        return nodes;
    };
    for (const std::uint32_t c : scope.volume_cells()) {
        std::uint64_t hash = 0;
        for (const std::uint32_t node : scope.mesh().cell_nodes(c)) {
            std::uint64_t x = (scope.vertex_of()[node] + 1) * 0x9e3779b97f4a7c15u;
            x ^= x >> 29;
            hash += x * 0xff51afd7ed558ccdu;
        }
        keys.emplace_back(hash, c);
    }
    std::ranges::sort(keys);
    std::vector<std::uint32_t> repeats;
    for (std::size_t i = 1; i < keys.size(); ++i) {
        if (keys[i].first == keys[i - 1].first && nodes_of(keys[i].second) == nodes_of(keys[i - 1].second))
            repeats.push_back(keys[i].second);
    }
    if (repeats.empty()) return;
    std::ranges::sort(repeats);
    findings.push_back(cells_of_mesh_finding(scope, "M26",
                                             counted(repeats.size(), "cell", "cells") + in_mesh(scope) +
                                                 (repeats.size() == 1 ? " repeats" : " repeat") + " another one of the same nodes",
                                             repeats));
}

void check_cell_points(const CellScope& scope, std::vector<Finding>& findings) {
    const CellMesh& mesh = scope.mesh();
    std::vector<std::uint8_t> used(mesh.points.size(), 0);
    for (const std::uint32_t node : mesh.nodes) used[node] = 1;
    const auto unused = static_cast<std::uint64_t>(std::ranges::count(used, 0));
    if (unused > 0) {
        Finding finding =
            finding_of("M28", counted(unused, "node", "nodes") + in_mesh(scope) + (unused == 1 ? " belongs" : " belong") + " to no cell");
        finding.entities.push_back({"cell-mesh", mesh.info.name});
        finding.element_kind = "node";
        finding.count = unused;
        for (std::uint32_t n = 0; n < used.size() && finding.index.size() < listed_elements; ++n) {
            if (used[n] != 0) continue;
            finding.index.push_back(n);
            finding.elements.push_back(mesh.point_labels[n]);
            finding.points.push_back(mesh.points[n]);
        }
        findings.push_back(std::move(finding));
    }
    if (scope.lengths().tolerance <= 0) return;
    const auto first = topology::near_nodes(mesh, scope.lengths().tolerance);
    Finding finding = finding_of("M27", {});
    std::uint64_t equal = 0;
    for (std::uint32_t n = 0; n < first.size(); ++n) {
        if (first[n] == n || used[n] == 0) continue;
        ++finding.count;
        equal += mesh.points[n] == mesh.points[first[n]] ? 1 : 0;
        if (finding.index.size() >= listed_elements) continue;
        finding.index.push_back(n);
        finding.elements.push_back(mesh.point_labels[n]);
        finding.points.push_back(mesh.points[n]);
    }
    if (finding.count == 0) return;
    // Where all are equal, cells are disconnected on purpose, as along faults: that is worth knowing, but no defect.
    if (equal == finding.count) use_other_severity(finding);
    finding.entities.push_back({"cell-mesh", mesh.info.name});
    finding.element_kind = "node";
    finding.message = counted(finding.count, "node", "nodes") + in_mesh(scope) + (finding.count == 1 ? " lies" : " lie") + " within " +
                      rounded(scope.lengths().tolerance) + " of another one" +
                      (equal == 0              ? std::string()
                       : equal < finding.count ? ", " + std::to_string(equal) + " of them at the same position"
                                               : ", at the same position");
    findings.push_back(std::move(finding));
}

void check_face_planes(const CellScope& scope, std::vector<Finding>& findings) {
    std::vector<std::uint32_t> cells;
    double worst = 0;
    for (const VolumeFace& face : scope.faces()) {
        if (!polyhedron(scope, face.cell) || face.size < 4) continue;
        const auto nodes = scope.nodes_of(face);
        const auto& points = scope.mesh().points;
        Vec3 normal{}, middle{};
        const Vec3& o = points[nodes[0]];
        for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
            const Vec3 n = cross(minus(points[nodes[i]], o), minus(points[nodes[i + 1]], o));
            for (std::size_t k = 0; k < 3; ++k) normal[k] += n[k];
        }
        const double length = std::sqrt(dot(normal, normal));
        if (length == 0) continue;
        for (const std::uint32_t node : nodes) {
            for (std::size_t k = 0; k < 3; ++k) middle[k] += (points[node][k] - o[k]) / static_cast<double>(nodes.size());
        }
        double off = 0;
        for (const std::uint32_t node : nodes) off = std::max(off, std::abs(dot(minus(minus(points[node], o), middle), normal)) / length);
        if (off <= scope.lengths().tolerance) continue;
        worst = std::max(worst, off);
        if (cells.empty() || cells.back() != face.cell) cells.push_back(face.cell);
    }
    if (cells.empty()) return;
    Finding finding =
        cells_of_mesh_finding(scope, "Q10",
                              counted(cells.size(), "polyhedron", "polyhedra") + in_mesh(scope) + (cells.size() == 1 ? " has" : " have") +
                                  " faces that are not plane, by up to " + rounded(worst),
                              cells);
    finding.measures = {{"distance", worst}};
    findings.push_back(std::move(finding));
}

}  // namespace geomend::validators
