# SPDX-License-Identifier: AGPL-3.0-or-later
"""Draws models that geomend wrote as .vtm with the places of their findings in red, side by side:
picture_findings.py PICTURE.png MODEL.vtm REPORT.json [MODEL.vtm REPORT.json]. The reports are those of `geomend validate --report`."""

import json
import sys

import vtk

import picture_parts

ROCK, RED = (0.55, 0.66, 0.70), (0.85, 0.10, 0.05)


def actor(data, colour, opacity, edges=True):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.ScalarVisibilityOff()
    drawn = vtk.vtkActor()
    drawn.SetMapper(mapper)
    look = drawn.GetProperty()
    look.SetColor(*colour)
    look.SetOpacity(opacity)
    look.SetEdgeVisibility(edges)
    look.SetEdgeColor(0.25, 0.3, 0.33)
    look.SetAmbient(0.4)
    look.SetDiffuse(0.65)
    return drawn


def tube(points, radius):
    line = vtk.vtkPolyData()
    places = vtk.vtkPoints()
    cells = vtk.vtkCellArray()
    cells.InsertNextCell(len(points))
    for p in points:
        cells.InsertCellPoint(places.InsertNextPoint(*p))
    line.SetPoints(places)
    line.SetLines(cells)
    around = vtk.vtkTubeFilter()
    around.SetInputData(line)
    around.SetRadius(radius)
    around.SetNumberOfSides(12)
    around.CappingOn()
    around.Update()
    return around.GetOutput()


def ball(point, radius):
    sphere = vtk.vtkSphereSource()
    sphere.SetCenter(*point)
    sphere.SetRadius(radius)
    sphere.SetThetaResolution(24)
    sphere.SetPhiResolution(16)
    sphere.Update()
    return sphere.GetOutput()


def view(model, report, left, right):
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.SetViewport(left, 0, right, 1)
    bounds = vtk.vtkBoundingBox()
    for block in [block for group, _, block in picture_parts.blocks_of(model) if group == "Surfaces"]:
        renderer.AddActor(actor(block, ROCK, 0.35))
        bounds.AddBounds(block.GetBounds())
    size = bounds.GetDiagonalLength()
    with open(report, encoding="utf-8") as file:
        findings = [f for one in json.load(file)["files"] for f in one["findings"] if f["severity"] != "info"]
    for finding in findings:
        for line in finding.get("polylines", []):
            if len(line) > 1:
                renderer.AddActor(actor(tube(line, 0.004 * size), RED, 1, False))
        for point in finding.get("points", [])[:8]:
            renderer.AddActor(actor(ball(point, 0.010 * size), RED, 1, False))
    middle = [0.0, 0.0, 0.0]
    bounds.GetCenter(middle)
    picture_parts.look_at(renderer, middle, 1.05)
    return renderer


def main(picture, *pairs):
    views = len(pairs) // 2
    window = picture_parts.window_of(1200, 800 if views == 1 else 480)
    for i in range(views):
        window.AddRenderer(view(pairs[2 * i], pairs[2 * i + 1], i / views, (i + 1) / views))
    picture_parts.write(window, picture)


main(*sys.argv[1:])
