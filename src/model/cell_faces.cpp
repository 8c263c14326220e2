// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/cell_faces.h"

namespace geomend {

namespace {

using LocalEdge = std::array<std::uint8_t, 2>;

constexpr std::array<LocalFace, 4> tetrahedron_faces{{{3, {0, 2, 1}}, {3, {0, 1, 3}}, {3, {1, 2, 3}}, {3, {0, 3, 2}}}};
constexpr std::array<LocalFace, 5> pyramid_faces{{{4, {0, 3, 2, 1}}, {3, {0, 1, 4}}, {3, {1, 2, 4}}, {3, {2, 3, 4}}, {3, {3, 0, 4}}}};
constexpr std::array<LocalFace, 5> wedge_faces{{{3, {0, 1, 2}}, {3, {3, 5, 4}}, {4, {0, 3, 4, 1}}, {4, {1, 4, 5, 2}}, {4, {2, 5, 3, 0}}}};
constexpr std::array<LocalFace, 6> hexahedron_faces{
    {{4, {0, 3, 2, 1}}, {4, {4, 5, 6, 7}}, {4, {0, 1, 5, 4}}, {4, {1, 2, 6, 5}}, {4, {2, 3, 7, 6}}, {4, {3, 0, 4, 7}}}};
constexpr std::array<LocalFace, 7> pentagonal_faces{{{5, {0, 4, 3, 2, 1}},
                                                     {5, {5, 6, 7, 8, 9}},
                                                     {4, {0, 1, 6, 5}},
                                                     {4, {1, 2, 7, 6}},
                                                     {4, {2, 3, 8, 7}},
                                                     {4, {3, 4, 9, 8}},
                                                     {4, {4, 0, 5, 9}}}};
constexpr std::array<LocalFace, 8> hexagonal_faces{{{6, {0, 5, 4, 3, 2, 1}},
                                                    {6, {6, 7, 8, 9, 10, 11}},
                                                    {4, {0, 1, 7, 6}},
                                                    {4, {1, 2, 8, 7}},
                                                    {4, {2, 3, 9, 8}},
                                                    {4, {3, 4, 10, 9}},
                                                    {4, {4, 5, 11, 10}},
                                                    {4, {5, 0, 6, 11}}}};

constexpr std::array<LocalEdge, 6> tetrahedron_edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
constexpr std::array<LocalEdge, 8> pyramid_edges{{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}}};
constexpr std::array<LocalEdge, 9> wedge_edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}}};
constexpr std::array<LocalEdge, 12> hexahedron_edges{
    {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}}};
constexpr std::array<LocalEdge, 15> pentagonal_edges{
    {{0, 1}, {0, 4}, {0, 5}, {1, 2}, {1, 6}, {2, 3}, {2, 7}, {3, 4}, {3, 8}, {4, 9}, {5, 6}, {5, 9}, {6, 7}, {7, 8}, {8, 9}}};
constexpr std::array<LocalEdge, 18> hexagonal_edges{{{0, 1},
                                                     {0, 5},
                                                     {0, 6},
                                                     {1, 2},
                                                     {1, 7},
                                                     {2, 3},
                                                     {2, 8},
                                                     {3, 4},
                                                     {3, 9},
                                                     {4, 5},
                                                     {4, 10},
                                                     {5, 11},
                                                     {6, 7},
                                                     {6, 11},
                                                     {7, 8},
                                                     {8, 9},
                                                     {9, 10},
                                                     {10, 11}}};

}  // namespace

std::span<const LocalFace> faces_of(CellType type) {
    switch (linear_type(type)) {
        case CellType::tetrahedron:
            return tetrahedron_faces;
        case CellType::pyramid:
            return pyramid_faces;
        case CellType::wedge:
            return wedge_faces;
        case CellType::hexahedron:
            return hexahedron_faces;
        case CellType::pentagonal_prism:
            return pentagonal_faces;
        case CellType::hexagonal_prism:
            return hexagonal_faces;
        default:
            return {};
    }
}

std::span<const LocalEdge> edges_of(CellType type) {
    switch (linear_type(type)) {
        case CellType::tetrahedron:
            return tetrahedron_edges;
        case CellType::pyramid:
            return pyramid_edges;
        case CellType::wedge:
            return wedge_edges;
        case CellType::hexahedron:
            return hexahedron_edges;
        case CellType::pentagonal_prism:
            return pentagonal_edges;
        case CellType::hexagonal_prism:
            return hexagonal_edges;
        default:
            return {};
    }
}

}  // namespace geomend
