// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/vtk/vtk_cells.h"

#include <algorithm>
#include <array>
#include <optional>

#include "base/wording.h"
#include "formats/drop.h"
#include "model/attribute_operations.h"

namespace geomend::vtk {

namespace {

constexpr int empty_cell = 0, triangle_strip = 6, pixel = 8, voxel = 11, polyhedron = 42;

/// Fewest corners that a cell of varying size needs.
std::size_t least_corners(CellType type) {
    switch (type) {
        case CellType::polygon:
            return 3;
        case CellType::poly_line:
            return 2;
        default:
            return 1;
    }
}

/// What cells of higher order are by their corners.
struct CornerCell {
    CellType type;
    std::size_t corners;
};

std::optional<CornerCell> corner_cell(std::int64_t vtk_type) {
    switch (vtk_type) {
        case 35:  // cubic line
        case 68:  // Lagrange
        case 75:  // Bezier
            return CornerCell{CellType::line, 2};
        case 34:
        case 69:
        case 76:
            return CornerCell{CellType::triangle, 3};
        case 30:
        case 70:
        case 77:
            return CornerCell{CellType::quad, 4};
        case 71:
        case 78:
            return CornerCell{CellType::tetrahedron, 4};
        case 33:
        case 72:
        case 79:
            return CornerCell{CellType::hexahedron, 8};
        case 31:
        case 73:
        case 80:
            return CornerCell{CellType::wedge, 6};
        case 37:
        case 74:
        case 81:
            return CornerCell{CellType::pyramid, 5};
        default:
            return std::nullopt;
    }
}

bool known_type(std::int64_t number) {
    if (number <= 0 || number > 255) return false;
    const auto type = static_cast<CellType>(number);
    return std::string_view(to_string(type)) != "unknown";
}

}  // namespace

void MeshBuilder::reserve(std::size_t cells, std::size_t corners) {
    mesh_.types.reserve(cells);
    mesh_.offsets.reserve(cells + 1);
    mesh_.nodes.reserve(corners);
}

void MeshBuilder::note_sources(std::size_t first_new) {
    const std::size_t now = mesh_.types.size();
    const bool one = now == first_new + 1;
    if (one && source_.empty() && first_new == added_) {
        ++added_;
        return;
    }
    if (source_.empty()) {
        for (std::size_t i = 0; i < first_new; ++i) source_.push_back(static_cast<std::uint32_t>(i));
    }
    source_.resize(now, static_cast<std::uint32_t>(added_));
    ++added_;
}

CellProblem MeshBuilder::add(std::int64_t vtk_type, std::span<const std::uint32_t> corners) {
    const std::size_t first_new = mesh_.types.size();
    if (vtk_type == empty_cell) {
        ++empty_;
    } else if (vtk_type == pixel || vtk_type == voxel) {
        const std::size_t expected = vtk_type == pixel ? 4 : 8;
        if (corners.size() != expected) return CellProblem::wrong_size;
        std::array<std::uint32_t, 8> turned{};
        std::ranges::copy(corners, turned.begin());
        std::swap(turned[2], turned[3]);
        if (vtk_type == voxel) std::swap(turned[6], turned[7]);
        mesh_.add_cell(vtk_type == pixel ? CellType::quad : CellType::hexahedron, {turned.data(), expected});
    } else if (vtk_type == triangle_strip) {
        if (corners.size() < 3) return CellProblem::wrong_size;
        for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
            const std::size_t odd = i % 2;  // every other triangle of a strip is wound the other way
            const std::array<std::uint32_t, 3> t{corners[i + odd], corners[i + 1 - odd], corners[i + 2]};
            mesh_.add_cell(CellType::triangle, t);
        }
    } else if (const auto cell = corner_cell(vtk_type)) {
        if (corners.size() < cell->corners) return CellProblem::wrong_size;
        if (corners.size() > cell->corners) ++corner_cells_[vtk_type];
        mesh_.add_cell(cell->type, corners.first(cell->corners));
    } else {
        if (!known_type(vtk_type)) return CellProblem::unknown_type;
        if (vtk_type == polyhedron) return CellProblem::bad_faces;
        const auto type = static_cast<CellType>(vtk_type);
        const std::size_t nodes = node_count(type);
        if (nodes != 0 ? corners.size() != nodes : corners.size() < least_corners(type)) return CellProblem::wrong_size;
        mesh_.add_cell(type, corners);
    }
    note_sources(first_new);
    return CellProblem::none;
}

CellProblem MeshBuilder::add_polyhedron(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> faces) {
    std::size_t at = 0;
    while (at < faces.size()) {
        const std::size_t n = faces[at];
        if (n < 3 || n > faces.size() - at - 1) return CellProblem::bad_faces;
        at += n + 1;
    }
    if (faces.empty()) return CellProblem::bad_faces;
    const std::size_t first_new = mesh_.types.size();
    if (mesh_.cell_faces.empty()) {
        mesh_.cell_faces.assign(first_new + 1, 0);
        mesh_.face_offsets.assign(1, 0);
    }
    const std::size_t first_face_node = mesh_.face_nodes.size();
    for (at = 0; at < faces.size(); at += faces[at] + 1) {
        const auto face = faces.subspan(at + 1, faces[at]);
        mesh_.face_nodes.insert(mesh_.face_nodes.end(), face.begin(), face.end());
        mesh_.face_offsets.push_back(mesh_.face_nodes.size());
    }
    std::vector<std::uint32_t> own;
    if (corners.empty()) {
        std::vector<std::uint32_t> seen(mesh_.face_nodes.begin() + static_cast<std::ptrdiff_t>(first_face_node), mesh_.face_nodes.end());
        std::ranges::sort(seen);
        seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
        std::vector<bool> taken(seen.size(), false);
        for (std::size_t i = first_face_node; i < mesh_.face_nodes.size(); ++i) {
            const auto place = static_cast<std::size_t>(std::ranges::lower_bound(seen, mesh_.face_nodes[i]) - seen.begin());
            if (!taken[place]) own.push_back(mesh_.face_nodes[i]);
            taken[place] = true;
        }
        corners = own;
    }
    mesh_.types.push_back(CellType::polyhedron);
    mesh_.nodes.insert(mesh_.nodes.end(), corners.begin(), corners.end());
    mesh_.offsets.push_back(mesh_.nodes.size());
    mesh_.cell_faces.push_back(mesh_.face_offsets.size() - 1);
    note_sources(first_new);
    return CellProblem::none;
}

void MeshBuilder::fit(std::vector<Attribute>& attributes) const {
    if (source_.empty() && mesh_.types.size() == added_) return;
    for (Attribute& a : attributes) {
        if (a.location == AttributeLocation::cell) take_values(a, source_);
    }
}

void drop_further_points(const CornerCells& cells, const Location& where, std::vector<Finding>& findings, std::vector<Loss>& losses) {
    for (const auto& [type, count] : cells) {
        const std::string name = unknown_cell_name(type), held = to_string(corner_cell(type)->type);
        drop(findings, losses,
             {.what = "the further points of every " + name,
              .why = "it is held as a " + held + " of its corners",
              .count = count,
              .where = where,
              .message =
                  counted(count, name + " is", name + "s are") + " read by the corners, as " + held + ": curved edges become straight"});
    }
}

std::string unknown_cell_name(std::int64_t vtk_type) {
    switch (vtk_type) {
        case 30:
            return "quadratic linear quad";
        case 31:
            return "quadratic linear wedge";
        case 33:
            return "biquadratic quadratic hexahedron";
        case 34:
            return "biquadratic triangle";
        case 35:
            return "cubic line";
        case 36:
            return "quadratic polygon";
        case 37:
            return "triquadratic pyramid";
        case 41:
            return "convex point set";
        default:
            break;
    }
    if (vtk_type >= 51 && vtk_type <= 56) return "parametric cell (type " + std::to_string(vtk_type) + ")";
    if (vtk_type >= 60 && vtk_type <= 67) return "higher-order cell (type " + std::to_string(vtk_type) + ")";
    if (vtk_type >= 68 && vtk_type <= 74) return "Lagrange cell (type " + std::to_string(vtk_type) + ")";
    if (vtk_type >= 75 && vtk_type <= 81) return "Bezier cell (type " + std::to_string(vtk_type) + ")";
    return "cell type " + std::to_string(vtk_type);
}

void take_values(Attribute& attribute, std::span<const std::uint32_t> source) {
    attribute.values = taken(attribute.values, source, attribute.components);
}

}  // namespace geomend::vtk
