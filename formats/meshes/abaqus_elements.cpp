// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/abaqus_elements.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <string>
#include <vector>

namespace geomend::meshes {

namespace {

constexpr std::uint8_t in_order[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19};
// The first triangle looks into the cell, that of VTK's wedge out of it.
constexpr std::uint8_t wedge_order[] = {0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13};
constexpr std::uint8_t middle_last[] = {0, 2, 1};  // a beam of three nodes has its middle between its ends
constexpr std::uint8_t tetrahedron_faces[] = {1, 2, 3, 4}, wedge_faces[] = {1, 2, 5, 4, 3}, hexahedron_faces[] = {1, 2, 3, 4, 5, 6},
                       pyramid_faces[] = {1, 2, 3, 4, 5};

constexpr std::array rows = {
    AbaqusElement{CellType::tetrahedron, "C3D4", {in_order, 4}, tetrahedron_faces},
    AbaqusElement{CellType::quadratic_tetrahedron, "C3D10", {in_order, 10}, tetrahedron_faces},
    AbaqusElement{CellType::pyramid, "C3D5", {in_order, 5}, pyramid_faces},
    AbaqusElement{CellType::wedge, "C3D6", {wedge_order, 6}, wedge_faces},
    AbaqusElement{CellType::quadratic_wedge, "C3D15", {wedge_order, 15}, wedge_faces},
    AbaqusElement{CellType::hexahedron, "C3D8", {in_order, 8}, hexahedron_faces},
    AbaqusElement{CellType::quadratic_hexahedron, "C3D20", {in_order, 20}, hexahedron_faces},
    AbaqusElement{CellType::triangle, "S3", {in_order, 3}, {}},
    AbaqusElement{CellType::quad, "S4", {in_order, 4}, {}},
    AbaqusElement{CellType::quadratic_triangle, "S6", {in_order, 6}, {}},
    AbaqusElement{CellType::quadratic_quad, "S8", {in_order, 8}, {}},
    AbaqusElement{CellType::line, "B31", {in_order, 2}, {}},
    AbaqusElement{CellType::quadratic_edge, "B32", {middle_last, 3}, {}},
};

// C3D8 with a side that is an edge, and with an upper face that is a point.
constexpr std::uint8_t collapsed_wedge[] = {0, 2, 1, 1, 3, 5, 4, 4}, collapsed_pyramid[] = {0, 1, 2, 3, 4, 4, 4, 4},
                       collapsed_tetrahedron[] = {0, 1, 2, 2, 3, 3, 3, 3};
constexpr std::uint8_t collapsed_wedge_faces[] = {1, 2, 6, 4, 3}, collapsed_pyramid_faces[] = {1, 3, 4, 5, 6},
                       collapsed_tetrahedron_faces[] = {1, 3, 4, 6};

constexpr std::array collapsed = {
    AbaqusElement{CellType::pyramid, "C3D8", collapsed_pyramid, collapsed_pyramid_faces},
    AbaqusElement{CellType::wedge, "C3D8", collapsed_wedge, collapsed_wedge_faces},
    AbaqusElement{CellType::tetrahedron, "C3D8", collapsed_tetrahedron, collapsed_tetrahedron_faces},
};

using Corners = std::array<std::uint8_t, 8>;

/// All ways to turn a hexahedron: at each corner the one that was there.
std::vector<Corners> ways_to_turn() {
    constexpr Corners as_it_is{0, 1, 2, 3, 4, 5, 6, 7}, about_z{1, 2, 3, 0, 5, 6, 7, 4}, about_edge{0, 4, 5, 1, 3, 7, 6, 2};
    std::vector<Corners> ways{as_it_is};
    for (std::size_t w = 0; w < ways.size(); ++w) {
        for (const Corners& turn : {about_z, about_edge}) {
            Corners next{};
            for (std::size_t k = 0; k < 8; ++k) next[k] = ways[w][turn[k]];
            if (std::ranges::find(ways, next) == ways.end()) ways.push_back(next);
        }
    }
    return ways;
}

/// The number of Abaqus' face that has, in a turned hexahedron, the corners that one has in it as it is.
std::uint8_t turned_face(std::uint8_t number, const Corners& way) {
    constexpr std::array<std::array<std::uint8_t, 4>, 6> faces{
        {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 4, 5}, {1, 2, 5, 6}, {2, 3, 6, 7}, {0, 3, 4, 7}}};
    std::array<std::uint8_t, 4> corners{};
    for (std::uint8_t k = 0, n = 0; k < 8; ++k) {
        const auto& own = faces[number - 1u];
        if (std::ranges::find(own, way[k]) != own.end()) corners[n++] = k;
    }
    return static_cast<std::uint8_t>(std::ranges::find(faces, corners) - faces.begin() + 1);
}

/// A C3D8 that is a cell of another type, in one of the ways in which it may be turned.
struct TurnedElement {
    Corners order{};
    std::array<std::uint8_t, 5> faces{};
    AbaqusElement row{};
};

std::vector<TurnedElement> all_collapsed() {
    std::vector<TurnedElement> all;
    const auto ways = ways_to_turn();
    all.reserve(ways.size() * collapsed.size());  // rows point into it
    for (const Corners& way : ways) {
        for (const AbaqusElement& base : collapsed) {
            TurnedElement& made = all.emplace_back();
            for (std::size_t k = 0; k < 8; ++k) made.order[k] = base.order[way[k]];
            for (std::size_t f = 0; f < base.faces.size(); ++f) made.faces[f] = turned_face(base.faces[f], way);
            made.row = {base.type, base.name, made.order, std::span(made.faces).first(base.faces.size())};
        }
    }
    return all;
}

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// The row of a name, where nothing but letters follow it: "C3D8" of "C3D8RH", not "C3D2" of "C3D20".
const AbaqusElement* row_called(std::string_view name) {
    for (const AbaqusElement& row : rows) {
        if (name.starts_with(row.name) && (name.size() == row.name.size() || !is_digit(name[row.name.size()]))) return &row;
    }
    return nullptr;
}

}  // namespace

std::span<const AbaqusElement> abaqus_elements() { return rows; }

const AbaqusElement* abaqus_element_of(CellType type) {
    const auto* found = std::ranges::find(rows, type, &AbaqusElement::type);
    return found == rows.end() ? nullptr : found;
}

const AbaqusElement* abaqus_element_written(CellType type) {
    return type == CellType::pyramid ? collapsed.data() : abaqus_element_of(type);
}

const AbaqusElement* abaqus_collapsed(std::span<const std::int64_t> nodes) {
    const auto is_so = [&](const AbaqusElement& row) {
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                if ((nodes[i] == nodes[j]) != (row.order[i] == row.order[j])) return false;
            }
        }
        return true;
    };
    static const std::vector<TurnedElement> all = all_collapsed();
    const auto found = std::ranges::find_if(all, is_so, &TurnedElement::row);
    return found == all.end() ? nullptr : &found->row;
}

const AbaqusElement* abaqus_element_called(std::string_view name) {
    if (const AbaqusElement* row = row_called(name)) return row;
    if (name.starts_with("STRI") && name.size() > 4) return row_called(name[4] == '6' ? "S6" : "S3");
    for (const std::string_view family : {"M3D", "CPS", "CPE", "CAX", "SFM3D", "R3D", "DS", "SC"}) {
        if (name.starts_with(family)) return row_called("S" + std::string(name.substr(family.size())));
    }
    if (name.starts_with("T3D2") || name.starts_with("B33") || name.starts_with("R3D2")) return row_called("B31");
    if (name.starts_with("T3D3")) return row_called("B32");
    return nullptr;
}

}  // namespace geomend::meshes
