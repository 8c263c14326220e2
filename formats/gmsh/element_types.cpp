// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gmsh/element_types.h"

#include <array>

namespace geomend::gmsh {

namespace {

// Gmsh numbers the edges of a cell by their end nodes, VTK goes around the bottom, the top, then upwards.
constexpr std::uint8_t tetrahedron10[] = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
constexpr std::uint8_t hexahedron27[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26};
// The first triangle of a wedge looks out of the cell in VTK (9.1: vtkCellSizeFilter gives a positive volume) and into it in Gmsh.
constexpr std::uint8_t wedge18[] = {0, 2, 1, 3, 5, 4, 7, 9, 6, 13, 14, 12, 8, 11, 10, 16, 17, 15};
constexpr std::uint8_t pyramid13[] = {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12};

constexpr int last_number = 140;

constexpr std::array<ElementType, last_number + 1> make_rows() {
    std::array<ElementType, last_number + 1> rows{};
    const auto exact = [&](int number, CellType cell, std::uint32_t nodes, int dimension, const std::uint8_t* order = nullptr) {
        rows[static_cast<std::size_t>(number)] = {number, cell, nodes, nodes, order, dimension};
    };
    using enum CellType;
    exact(1, line, 2, 1);
    exact(2, triangle, 3, 2);
    exact(3, quad, 4, 2);
    exact(4, tetrahedron, 4, 3);
    exact(5, hexahedron, 8, 3);
    exact(6, wedge, 6, 3, wedge18);
    exact(7, pyramid, 5, 3);
    exact(8, quadratic_edge, 3, 1);
    exact(9, quadratic_triangle, 6, 2);
    exact(10, biquadratic_quad, 9, 2);
    exact(11, quadratic_tetrahedron, 10, 3, tetrahedron10);
    exact(12, triquadratic_hexahedron, 27, 3, hexahedron27);
    exact(13, biquadratic_wedge, 18, 3, wedge18);
    exact(15, vertex, 1, 0);
    exact(16, quadratic_quad, 8, 2);
    exact(17, quadratic_hexahedron, 20, 3, hexahedron27);
    exact(18, quadratic_wedge, 15, 3, wedge18);
    exact(19, quadratic_pyramid, 13, 3, pyramid13);
    rows[14] = {14, quadratic_pyramid, 14, 13, pyramid13, 3};  // without the node in the middle of its base

    // Higher orders are read by their corners; the reader lists the rest as lost.
    const auto corners_of = [&](CellType cell, std::uint32_t kept, int dimension, const std::uint8_t* order = nullptr) {
        return [&rows, cell, kept, dimension, order](int first, std::initializer_list<std::uint32_t> node_counts) {
            int number = first;
            for (const std::uint32_t nodes : node_counts) {
                rows[static_cast<std::size_t>(number)] = {number, cell, nodes, kept, order, dimension};
                ++number;
            }
        };
    };
    const auto lines = corners_of(line, 2, 1);
    lines(26, {4, 5, 6});
    lines(62, {7, 8, 9, 10, 11});
    const auto triangles = corners_of(triangle, 3, 2);
    triangles(20, {9, 10, 12, 15, 15, 21});
    triangles(42, {28, 36, 45, 55, 66});
    triangles(52, {18, 21, 24, 27, 30});
    const auto quads = corners_of(quad, 4, 2);
    quads(36, {16, 25, 36, 12, 16, 20});
    quads(47, {49, 64, 81, 100, 121});
    quads(57, {24, 28, 32, 36, 40});
    const auto tetrahedra = corners_of(tetrahedron, 4, 3);
    tetrahedra(29, {20, 35, 56, 22, 28});
    tetrahedra(71, {84, 120, 165, 220, 286});
    tetrahedra(79, {34, 40, 46, 52, 58});
    const auto hexahedra = corners_of(hexahedron, 8, 3);
    hexahedra(92, {64, 125, 216, 343, 512, 729, 1000, 32, 44, 56, 68, 80, 92, 104});
    const auto wedges = corners_of(wedge, 6, 3, wedge18);
    wedges(90, {40, 75});
    wedges(106, {126, 196, 288, 405, 550, 24, 33, 42, 51, 60, 69, 78});
    const auto pyramids = corners_of(pyramid, 5, 3);
    pyramids(118, {30, 55, 91, 140, 204, 285, 385, 21, 29, 37, 45, 53, 61, 69});
    return rows;
}

constexpr std::array<ElementType, last_number + 1> rows = make_rows();

}  // namespace

const ElementType* element_type(std::int64_t number) {
    if (number < 1 || number > last_number) return nullptr;
    const ElementType& row = rows[static_cast<std::size_t>(number)];
    return row.nodes == 0 ? nullptr : &row;
}

const ElementType* element_type_of(CellType cell) {
    for (const ElementType& row : rows) {
        if (row.nodes != 0 && row.kept == row.nodes && row.cell == cell) return &row;
    }
    return nullptr;
}

}  // namespace geomend::gmsh
