// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/vtk/cell_check.h"

#include <vtkCell.h>
#include <vtkCellValidator.h>
#include <vtkHexahedron.h>
#include <vtkIdList.h>
#include <vtkPoints.h>
#include <vtkPyramid.h>
#include <vtkSmartPointer.h>
#include <vtkTetra.h>
#include <vtkWedge.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstddef>

#include "base/vectors.h"

namespace geomend {

namespace {

vtkSmartPointer<vtkCell> cell_without_corners(CellType type) {
    switch (type) {
        case CellType::tetrahedron:
            return vtkSmartPointer<vtkTetra>::New();
        case CellType::pyramid:
            return vtkSmartPointer<vtkPyramid>::New();
        case CellType::wedge:
            return vtkSmartPointer<vtkWedge>::New();
        default:
            return vtkSmartPointer<vtkHexahedron>::New();
    }
}

/// What VTK finds wrong with a cell at places relative to an origin.
unsigned wrongs_of(vtkCell& cell, std::span<const Vec3> corners, const Vec3& origin) {
    cell.GetPoints()->SetDataTypeToDouble();
    cell.GetPoints()->SetNumberOfPoints(static_cast<vtkIdType>(corners.size()));
    cell.GetPointIds()->SetNumberOfIds(static_cast<vtkIdType>(corners.size()));
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec3 p = minus(corners[k], origin);
        const auto id = static_cast<vtkIdType>(k);
        cell.GetPoints()->SetPoint(id, p.data());
        cell.GetPointIds()->SetId(id, id);
    }
    return static_cast<unsigned>(vtkCellValidator::Check(&cell, FLT_EPSILON));
}

}  // namespace

bool vtk_finds_valid(CellType type, std::span<const Vec3> corners) {
    const auto cell = cell_without_corners(type);
    if (wrongs_of(*cell, corners, corners[0]) != 0) return false;
    constexpr double far = 1e4;  // in extents of the cell: farther away it calls all kinds of cells wrong
    double away = 0, extent = 0;
    for (const Vec3& p : corners) {
        for (std::size_t k = 0; k < 3; ++k) {
            away = std::max(away, std::abs(p[k]));
            extent = std::max(extent, std::abs(p[k] - corners[0][k]));
        }
    }
    return away > far * extent || wrongs_of(*cell, corners, {0, 0, 0}) == 0;
}

}  // namespace geomend
