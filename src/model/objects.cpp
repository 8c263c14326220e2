// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/objects.h"

namespace geomend {

namespace {

struct CellTypeRow {
    CellType type;
    const char* name;
    int dimension;
    std::uint32_t nodes;
    CellType linear;
};

constexpr CellTypeRow cell_types[] = {
    {CellType::vertex, "vertex", 0, 1, CellType::vertex},
    {CellType::poly_vertex, "poly_vertex", 0, 0, CellType::poly_vertex},
    {CellType::line, "line", 1, 2, CellType::line},
    {CellType::poly_line, "poly_line", 1, 0, CellType::poly_line},
    {CellType::triangle, "triangle", 2, 3, CellType::triangle},
    {CellType::polygon, "polygon", 2, 0, CellType::polygon},
    {CellType::quad, "quad", 2, 4, CellType::quad},
    {CellType::tetrahedron, "tetrahedron", 3, 4, CellType::tetrahedron},
    {CellType::hexahedron, "hexahedron", 3, 8, CellType::hexahedron},
    {CellType::wedge, "wedge", 3, 6, CellType::wedge},
    {CellType::pyramid, "pyramid", 3, 5, CellType::pyramid},
    {CellType::pentagonal_prism, "pentagonal_prism", 3, 10, CellType::pentagonal_prism},
    {CellType::hexagonal_prism, "hexagonal_prism", 3, 12, CellType::hexagonal_prism},
    {CellType::quadratic_edge, "quadratic_edge", 1, 3, CellType::line},
    {CellType::quadratic_triangle, "quadratic_triangle", 2, 6, CellType::triangle},
    {CellType::quadratic_quad, "quadratic_quad", 2, 8, CellType::quad},
    {CellType::quadratic_tetrahedron, "quadratic_tetrahedron", 3, 10, CellType::tetrahedron},
    {CellType::quadratic_hexahedron, "quadratic_hexahedron", 3, 20, CellType::hexahedron},
    {CellType::quadratic_wedge, "quadratic_wedge", 3, 15, CellType::wedge},
    {CellType::quadratic_pyramid, "quadratic_pyramid", 3, 13, CellType::pyramid},
    {CellType::biquadratic_quad, "biquadratic_quad", 2, 9, CellType::quad},
    {CellType::triquadratic_hexahedron, "triquadratic_hexahedron", 3, 27, CellType::hexahedron},
    {CellType::biquadratic_wedge, "biquadratic_wedge", 3, 18, CellType::wedge},
    {CellType::polyhedron, "polyhedron", 3, 0, CellType::polyhedron},
};

constexpr CellTypeRow unknown_cell{CellType::vertex, "unknown", 0, 0, CellType::vertex};

const CellTypeRow& row(CellType type) {
    for (const CellTypeRow& r : cell_types) {
        if (r.type == type) return r;
    }
    return unknown_cell;
}

}  // namespace

const char* to_string(CellType type) { return row(type).name; }
int dimension(CellType type) { return row(type).dimension; }
std::uint32_t node_count(CellType type) { return row(type).nodes; }
bool is_second_order(CellType type) { return row(type).linear != type; }
CellType linear_type(CellType type) { return row(type).linear; }

const char* kind_name(const Object& object) {
    constexpr const char* names[] = {"point-set",       "polyline-set", "surface", "cell-mesh",
                                     "structured-grid", "raster",       "well",    "corner-point-grid"};
    return names[object.index()];
}

ObjectInfo& info_of(Object& object) {
    return std::visit([](auto& o) -> ObjectInfo& { return o.info; }, object);
}

const ObjectInfo& info_of(const Object& object) {
    return std::visit([](const auto& o) -> const ObjectInfo& { return o.info; }, object);
}

Vec3 sample_position(const Raster& raster, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    if (!raster.coordinates[0].empty()) return {raster.coordinates[0][i], raster.coordinates[1][j], raster.coordinates[2][k]};
    Vec3 p = raster.origin;
    const std::array<double, 3> n{double(i), double(j), double(k)};
    for (std::size_t direction = 0; direction < 3; ++direction) {
        for (std::size_t axis = 0; axis < 3; ++axis) p[axis] += n[direction] * raster.step[direction][axis];
    }
    return p;
}

std::uint64_t sample_count(const std::array<std::uint32_t, 3>& dims) { return std::uint64_t{dims[0]} * dims[1] * dims[2]; }

std::uint64_t lattice_cell_count(const std::array<std::uint32_t, 3>& dims) {
    std::uint64_t cells = 1;
    bool any = false;
    for (const std::uint32_t n : dims) {
        if (n > 1) {
            cells *= n - 1;
            any = true;
        }
    }
    return any ? cells : 0;
}

}  // namespace geomend
