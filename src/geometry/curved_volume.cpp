// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/curved_volume.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "geometry/measures.h"
#include "geometry/vectors.h"

namespace geomend {

namespace {

/// Nodes of a face in the numbering of VTK: its corners in cyclic order, the middles of its edges from the first corner on, and its
/// middle, where the type has one.
struct CurvedFace {
    std::uint8_t count;
    std::array<std::uint8_t, 9> nodes;
};

constexpr std::array tetrahedron{CurvedFace{6, {0, 1, 3, 4, 8, 7}}, CurvedFace{6, {1, 2, 3, 5, 9, 8}}, CurvedFace{6, {2, 0, 3, 6, 7, 9}},
                                 CurvedFace{6, {0, 2, 1, 6, 5, 4}}};
constexpr std::array hexahedron{CurvedFace{8, {0, 4, 7, 3, 16, 15, 19, 11, 20}}, CurvedFace{8, {1, 2, 6, 5, 9, 18, 13, 17, 21}},
                                CurvedFace{8, {0, 1, 5, 4, 8, 17, 12, 16, 22}},  CurvedFace{8, {3, 7, 6, 2, 19, 14, 18, 10, 23}},
                                CurvedFace{8, {0, 3, 2, 1, 11, 10, 9, 8, 24}},   CurvedFace{8, {4, 5, 6, 7, 12, 13, 14, 15, 25}}};
constexpr std::array wedge{CurvedFace{6, {0, 1, 2, 6, 7, 8}}, CurvedFace{6, {3, 5, 4, 11, 10, 9}},
                           CurvedFace{8, {0, 3, 4, 1, 12, 9, 13, 6, 15}}, CurvedFace{8, {1, 4, 5, 2, 13, 10, 14, 7, 16}},
                           CurvedFace{8, {2, 5, 3, 0, 14, 11, 12, 8, 17}}};
constexpr std::array pyramid{CurvedFace{8, {0, 3, 2, 1, 8, 7, 6, 5}}, CurvedFace{6, {0, 1, 4, 5, 10, 9}},
                             CurvedFace{6, {1, 2, 4, 6, 11, 10}}, CurvedFace{6, {2, 3, 4, 7, 12, 11}}, CurvedFace{6, {3, 0, 4, 8, 9, 12}}};

/// Weights of the nodes of a face at a point of it, and their derivatives.
struct Weights {
    std::array<double, 9> at{}, by_u{}, by_v{};
};

Weights triangle_weights(double u, double v) {
    const double w = 1 - u - v;
    return {{w * (2 * w - 1), u * (2 * u - 1), v * (2 * v - 1), 4 * u * w, 4 * u * v, 4 * v * w},
            {1 - 4 * w, 4 * u - 1, 0, 4 * (w - u), 4 * v, -4 * v},
            {1 - 4 * w, 0, 4 * v - 1, -4 * u, 4 * u, 4 * (w - v)}};
}

constexpr std::array<double, 8> corner_u{-1, 1, 1, -1, 0, 1, 0, -1}, corner_v{-1, -1, 1, 1, -1, 0, 1, 0};

/// Corners and middles of edges, both from -1 to 1.
Weights eight_weights(double u, double v) {
    Weights w;
    for (std::size_t k = 0; k < 4; ++k) {
        const double a = corner_u[k], b = corner_v[k], p = 1 + a * u, q = 1 + b * v;
        w.at[k] = 0.25 * p * q * (a * u + b * v - 1);
        w.by_u[k] = 0.25 * a * q * (2 * a * u + b * v);
        w.by_v[k] = 0.25 * b * p * (a * u + 2 * b * v);
    }
    for (std::size_t k = 4; k < 8; ++k) {
        const double a = corner_u[k], b = corner_v[k];
        if (a == 0) {
            w.at[k] = 0.5 * (1 - u * u) * (1 + b * v);
            w.by_u[k] = -u * (1 + b * v);
            w.by_v[k] = 0.5 * b * (1 - u * u);
        } else {
            w.at[k] = 0.5 * (1 - v * v) * (1 + a * u);
            w.by_u[k] = 0.5 * a * (1 - v * v);
            w.by_v[k] = -v * (1 + a * u);
        }
    }
    return w;
}

/// With the middle of the face: what it adds is taken from the others in the shares that they have there.
Weights nine_weights(double u, double v) {
    Weights w = eight_weights(u, v);
    const double bubble = (1 - u * u) * (1 - v * v), by_u = -2 * u * (1 - v * v), by_v = -2 * v * (1 - u * u);
    for (std::size_t k = 0; k < 8; ++k) {
        const double share = k < 4 ? -0.25 : 0.5;
        w.at[k] -= share * bubble;
        w.by_u[k] -= share * by_u;
        w.by_v[k] -= share * by_v;
    }
    w.at[8] = bubble;
    w.by_u[8] = by_u;
    w.by_v[8] = by_v;
    return w;
}

double flux_at(std::span<const Vec3> nodes, const Weights& w) {
    Vec3 place{}, along_u{}, along_v{};
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        place = plus(place, times(w.at[k], nodes[k]));
        along_u = plus(along_u, times(w.by_u[k], nodes[k]));
        along_v = plus(along_v, times(w.by_v[k], nodes[k]));
    }
    return dot(place, cross(along_u, along_v));
}

/// Three times the volume between a face and the origin. The integrand is of the fourth degree in a triangle, and of the fifth in each
/// direction of a quadrangle.
double flux(std::span<const Vec3> nodes) {
    double sum = 0;
    if (nodes.size() == 6) {
        constexpr std::array<std::array<double, 2>, 2> rule{
            {{0.44594849091596489, 0.22338158967801147}, {0.091576213509770743, 0.10995174365532187}}};  // Dunavant 1985
        for (const auto& [a, weight] : rule) {
            for (const auto& [u, v] : {std::array{a, a}, std::array{1 - 2 * a, a}, std::array{a, 1 - 2 * a}})
                sum += 0.5 * weight * flux_at(nodes, triangle_weights(u, v));
        }
        return sum;
    }
    const double far = std::sqrt(0.6);
    constexpr std::array<double, 3> weights{5.0 / 9, 8.0 / 9, 5.0 / 9};
    const std::array<double, 3> places{-far, 0, far};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const Weights w = nodes.size() == 9 ? nine_weights(places[i], places[j]) : eight_weights(places[i], places[j]);
            sum += weights[i] * weights[j] * flux_at(nodes, w);
        }
    }
    return sum;
}

std::span<const CurvedFace> curved_faces(CellType type) {
    switch (type) {
        case CellType::quadratic_tetrahedron:
            return tetrahedron;
        case CellType::quadratic_hexahedron:
        case CellType::triquadratic_hexahedron:
            return hexahedron;
        case CellType::quadratic_wedge:
        case CellType::biquadratic_wedge:
            return wedge;
        case CellType::quadratic_pyramid:
            return pyramid;
        default:
            return {};
    }
}

}  // namespace

double unsigned_volume(const CellMesh& mesh, std::size_t cell) {
    const CellType type = mesh.types[cell];
    const auto faces = curved_faces(type);
    if (faces.empty()) return std::abs(cell_volume(mesh, cell));
    const bool has_middles = type == CellType::triquadratic_hexahedron || type == CellType::biquadratic_wedge;
    const auto nodes = mesh.cell_nodes(cell);
    const Vec3& origin = mesh.points[nodes[0]];
    double sum = 0;
    for (const CurvedFace& face : faces) {
        std::array<Vec3, 9> p{};
        const std::size_t count = face.count == 8 && has_middles ? 9 : face.count;
        for (std::size_t k = 0; k < count; ++k) p[k] = minus(mesh.points[nodes[face.nodes[k]]], origin);
        sum += flux(std::span(p).first(count));
    }
    return std::abs(sum) / 3;
}

}  // namespace geomend
