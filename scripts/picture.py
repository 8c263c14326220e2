# SPDX-License-Identifier: AGPL-3.0-or-later
"""Draws the regions of a .vtm that geomend wrote, a little apart, and its fault: picture.py MODEL.vtm PICTURE.png"""

import sys

import vtk

LAYERS = {"1": (0.91, 0.78, 0.47), "2": (0.42, 0.62, 0.55), "3": (0.55, 0.46, 0.62)}
FAULT = (0.80, 0.22, 0.16)
APART = 0.16


def blocks(data, group=""):
    """(group, name, leaf) of each block."""
    for i in range(data.GetNumberOfBlocks()):
        info = data.GetMetaData(i) if data.HasMetaData(i) else None
        name = info.Get(vtk.vtkCompositeDataSet.NAME()) if info else ""
        block = data.GetBlock(i)
        if isinstance(block, vtk.vtkMultiBlockDataSet):
            yield from blocks(block, name or group)
        elif block is not None:
            yield group, name or "", block


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
    reader = vtk.vtkXMLMultiBlockDataReader()
    reader.SetFileName(model)
    reader.Update()
    all_blocks = list(blocks(reader.GetOutput()))
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

    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(1200, 800)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(*middle)
    camera.SetPosition(middle[0] + 1300, middle[1] - 2400, middle[2] + 1000)
    camera.SetViewUp(0, 0, 1)
    renderer.ResetCamera()
    camera.Zoom(1.03)
    renderer.ResetCameraClippingRange()
    window.Render()

    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(picture)
    writer.SetInputConnection(grab.GetOutputPort())
    writer.Write()


main(*sys.argv[1:])
