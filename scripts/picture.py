# SPDX-License-Identifier: AGPL-3.0-or-later
"""Draws the regions of a .vtm that geomend wrote, a little apart, and its fault: picture.py MODEL.vtm PICTURE.png"""

import sys

import vtk

import picture_parts

LAYERS = {"1": (0.91, 0.78, 0.47), "2": (0.42, 0.62, 0.55), "3": (0.55, 0.46, 0.62)}
FAULT = (0.80, 0.22, 0.16)
APART = 0.16


def centre(data):
    b = data.GetBounds()
    return [(b[0] + b[1]) / 2, (b[2] + b[3]) / 2, (b[4] + b[5]) / 2]


def actor(data, colour, shift, opacity=1.0, edges=True):
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputData(data)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(surface.GetOutputPort())
    mapper.ScalarVisibilityOff()
    drawn = vtk.vtkActor()
    drawn.SetMapper(mapper)
    drawn.SetPosition(*shift)
    look = drawn.GetProperty()
    look.SetColor(*colour)
    look.SetOpacity(opacity)
    look.SetEdgeVisibility(edges)
    look.SetEdgeColor(0.15, 0.15, 0.15)
    look.SetLineWidth(1.2)
    look.SetAmbient(0.4)
    look.SetDiffuse(0.65)
    return drawn


def main(model, picture):
    all_blocks = picture_parts.blocks_of(model)
    regions = [(name, data) for group, name, data in all_blocks if group == "Regions"]
    faults = [data for group, name, data in all_blocks if group == "Surfaces" and name.startswith("fault")]
    if len(regions) != 6 or not faults:
        sys.exit(f"{model}: {len(regions)} regions and {len(faults)} parts of the fault, not 6 and some: "
                 + ", ".join(f"{group}/{name}" for group, name, _ in all_blocks))
    centres = [centre(data) for _, data in regions]
    middle = [sum(c[axis] for c in centres) / len(centres) for axis in range(3)]

    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for (name, data), place in zip(regions, centres):
        shift = [APART * (p - m) for p, m in zip(place, middle)]
        renderer.AddActor(actor(data, LAYERS[name[-1]], shift))
    for data in faults:
        renderer.AddActor(actor(data, FAULT, [0, 0, APART * (centre(data)[2] - middle[2])], edges=False))

    window = picture_parts.window_of(1200, 800)
    window.AddRenderer(renderer)
    picture_parts.look_at(renderer, middle, 1.03)
    picture_parts.write(window, picture)


main(*sys.argv[1:])
