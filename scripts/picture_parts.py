# SPDX-License-Identifier: AGPL-3.0-or-later
"""What the pictures of the README have in common: reading the blocks of a .vtm, the side from which a model is seen, writing a PNG."""

import vtk


def blocks_of(model):
    """(group, name, leaf) of each block of a .vtm."""
    reader = vtk.vtkXMLMultiBlockDataReader()
    reader.SetFileName(model)
    reader.Update()
    return list(blocks(reader.GetOutput()))


def blocks(data, group=""):
    for i in range(data.GetNumberOfBlocks()):
        info = data.GetMetaData(i) if data.HasMetaData(i) else None
        name = info.Get(vtk.vtkCompositeDataSet.NAME()) if info else ""
        block = data.GetBlock(i)
        if isinstance(block, vtk.vtkMultiBlockDataSet):
            yield from blocks(block, name or group)
        elif block is not None:
            yield group, name or "", block


def look_at(renderer, middle, zoom):
    """All pictures show a model from the same side."""
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(*middle)
    camera.SetPosition(middle[0] + 1300, middle[1] - 2400, middle[2] + 1000)
    camera.SetViewUp(0, 0, 1)
    renderer.ResetCamera()
    camera.Zoom(zoom)
    renderer.ResetCameraClippingRange()


def window_of(width, height):
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(width, height)
    return window


def write(window, picture):
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(picture)
    writer.SetInputConnection(grab.GetOutputPort())
    writer.Write()
