# SPDX-License-Identifier: AGPL-3.0-or-later
"""Draws a mesh that geomend wrote as .vtu with its cells coloured by type, a corner cut away along whole cells so that the inside is seen:
picture_cells.py MESH.vtu PICTURE.png"""

import sys

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

import picture_parts

KINDS = ((vtk.VTK_HEXAHEDRON, "hexahedra", (0.91, 0.80, 0.52)), (vtk.VTK_WEDGE, "prisms", (0.45, 0.66, 0.45)),
         (vtk.VTK_PYRAMID, "pyramids", (0.80, 0.33, 0.24)), (vtk.VTK_TETRA, "tetrahedra", (0.33, 0.48, 0.68)))


def read(mesh):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(mesh)
    reader.Update()
    return reader.GetOutput()


def along_outline(places):
    """Places with x and y turned along the sides of the narrowest rectangle around them."""
    best = None
    for degrees in range(90):
        c, s = numpy.cos(numpy.radians(degrees)), numpy.sin(numpy.radians(degrees))
        turned = places @ numpy.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        size = numpy.ptp(turned[:, 0]) * numpy.ptp(turned[:, 1])
        if best is None or size < best[0] * (1 - 1e-6):
            best = size, turned
    return best[1]


def without_corner(grid):
    """The cells of the mesh whose middle does not lie in the corner towards the viewer, with the type as colour."""
    centres = vtk.vtkCellCenters()
    centres.SetInputData(grid)
    centres.Update()
    middle = along_outline(vtk_to_numpy(centres.GetOutput().GetPoints().GetData()))
    types = vtk_to_numpy(grid.GetCellTypesArray())
    solid = numpy.isin(types, [kind for kind, _, _ in KINDS])
    low, high = middle[solid].min(axis=0), middle[solid].max(axis=0)
    part = (middle - low) / (high - low)
    kept = solid & ~((part[:, 0] > 0.45) & (part[:, 1] < 0.5) & (part[:, 2] > 0.35))
    grid.GetPointData().Initialize()
    grid.GetCellData().Initialize()
    colour = numpy_to_vtk(numpy.array([[k for k, kind in enumerate(KINDS) if kind[0] == t] or [0] for t in types], dtype=float)[:, 0], deep=1)
    colour.SetName("kind")
    grid.GetCellData().SetScalars(colour)
    ids = vtk.vtkIdList()
    for cell in numpy.flatnonzero(kept):
        ids.InsertNextId(int(cell))
    cut = vtk.vtkExtractCells()
    cut.SetInputData(grid)
    cut.SetCellList(ids)
    skin = vtk.vtkDataSetSurfaceFilter()
    skin.SetInputConnection(cut.GetOutputPort())
    skin.Update()
    return skin.GetOutput(), [int((types == kind).sum()) for kind, _, _ in KINDS]


def legend(counts):
    box = vtk.vtkLegendBoxActor()
    shown = [(name, colour) for (_, name, colour), count in zip(KINDS, counts) if count > 0]
    box.SetNumberOfEntries(len(shown))
    square = vtk.vtkPlaneSource()
    square.Update()
    for k, (name, colour) in enumerate(shown):
        box.SetEntry(k, square.GetOutput(), name, colour)
    box.GetPositionCoordinate().SetValue(0.84, 0.03)
    box.GetPosition2Coordinate().SetValue(0.15, 0.04 * len(shown))
    box.GetEntryTextProperty().SetColor(0, 0, 0)
    box.BorderOff()
    return box


def main(mesh, picture):
    skin, counts = without_corner(read(mesh))
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(len(KINDS))
    for k, (_, _, colour) in enumerate(KINDS):
        table.SetTableValue(k, *colour, 1)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(skin)
    mapper.SetLookupTable(table)
    mapper.SetScalarRange(-0.5, len(KINDS) - 0.5)
    drawn = vtk.vtkActor()
    drawn.SetMapper(mapper)
    look = drawn.GetProperty()
    look.SetEdgeVisibility(True)
    look.SetEdgeColor(0.45, 0.42, 0.36)
    look.SetLineWidth(0.6)
    look.SetAmbient(0.55)
    look.SetDiffuse(0.5)
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(drawn)
    renderer.AddActor(legend(counts))
    low_x, high_x, low_y, high_y, low_z, high_z = skin.GetBounds()
    window = picture_parts.window_of(740, 480)
    window.AddRenderer(renderer)
    picture_parts.look_at(renderer, [(low_x + high_x) / 2, (low_y + high_y) / 2, (low_z + high_z) / 2], 1.5)
    picture_parts.write(window, picture)


main(*sys.argv[1:])
