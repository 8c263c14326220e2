# SPDX-License-Identifier: AGPL-3.0-or-later
"""VTK's own library as a client of legacy files.

make FOLDER     writes files of every kind with VTK into a folder
dump FOLDER     reads each FILE.vtk of a folder with VTK and writes what it found to FILE.txt beside it
"""
import os
import sys

try:  # the modules by name: all of VTK takes seconds to load
    from vtkmodules import vtkCommonCore, vtkCommonDataModel, vtkIOLegacy
except ImportError:
    print("no VTK for Python")
    sys.exit(77)


class vtk:
    """Classes of the three modules by their names."""


for module in (vtkCommonCore, vtkCommonDataModel, vtkIOLegacy):
    for word in dir(module):
        if word.startswith("vtk"):
            setattr(vtk, word, getattr(module, word))

READ_ALL = ("Scalars", "Vectors", "Normals", "Tensors", "TCoords", "Fields", "ColorScalars")


def load(path):
    reader = vtk.vtkGenericDataObjectReader()
    reader.SetFileName(path)
    for kind in READ_ALL:
        getattr(reader, "ReadAll" + kind + "On")()
    reader.Update()
    return reader.GetOutput()


def text(array, i):
    value = array.GetVariantValue(i)
    return value.ToString() if array.GetClassName() == "vtkStringArray" else value.ToDouble().hex()


def lines(data):
    yield data.GetClassName()
    for i in range(data.GetNumberOfPoints()):
        yield "p " + " ".join((x + 0.0).hex() for x in data.GetPoint(i))
    for i in range(data.GetNumberOfCells()):
        cell = data.GetCell(i)
        yield "c %d %s" % (data.GetCellType(i), [cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())])
        if data.GetCellType(i) == 42:
            for f in range(cell.GetNumberOfFaces()):
                face = cell.GetFace(f)
                yield "f %s" % [face.GetPointId(k) for k in range(face.GetNumberOfPoints())]
    for where, fields in (("point", data.GetPointData()), ("cell", data.GetCellData()), ("field", data.GetFieldData())):
        found = []
        for i in range(fields.GetNumberOfArrays()):
            a = fields.GetAbstractArray(i)
            if a.GetName().startswith("geomend"):
                continue
            names = [a.GetComponentName(k) for k in range(a.GetNumberOfComponents())] if a.HasAComponentName() else []
            found.append("%s %r %s %d %s %s" % (where, a.GetName(), a.GetClassName(), a.GetNumberOfComponents(), names,
                                              [text(a, k) for k in range(a.GetNumberOfValues())]))
        yield from sorted(found)
    for where, d in (("point", data.GetPointData()), ("cell", data.GetCellData())):
        for role in ("Scalars", "Vectors", "Normals", "Tensors", "TCoords", "GlobalIds", "PedigreeIds"):
            a = getattr(d, "Get" + role)()
            yield "active %s %s %r" % (where, role, a.GetName() if a else None)


def array(kind, name, components, count, value):
    a = kind()
    a.SetName(name)
    a.SetNumberOfComponents(components)
    a.SetNumberOfTuples(count)
    for i in range(components * count):
        a.SetValue(i, value(i))
    return a


def decorate(data, n):
    for kind in (vtk.vtkSignedCharArray, vtk.vtkUnsignedCharArray, vtk.vtkShortArray, vtk.vtkUnsignedShortArray, vtk.vtkIntArray,
                 vtk.vtkUnsignedIntArray, vtk.vtkLongArray, vtk.vtkUnsignedLongArray, vtk.vtkLongLongArray,
                 vtk.vtkUnsignedLongLongArray, vtk.vtkIdTypeArray):
        data.AddArray(array(kind, kind.__name__, 1, n, lambda i: i + 1))
    data.AddArray(array(vtk.vtkCharArray, "char", 1, n, lambda i: chr(65 + i)))
    data.AddArray(array(vtk.vtkDoubleArray, "100% of two", 2, n, lambda i: i / 4))
    data.GetArray("100% of two").SetComponentName(0, "first one")
    data.GetArray("100% of two").SetComponentName(1, "b%c")
    words = vtk.vtkStringArray()
    words.SetName("words")
    for i in range(n):
        words.InsertNextValue(("a b", "", "x%y\nz", "\u00e9")[i % 4])
    data.AddArray(words)
    data.SetScalars(array(vtk.vtkFloatArray, "s", 1, n, lambda i: i / 8))
    data.SetVectors(array(vtk.vtkFloatArray, "v", 3, n, lambda i: i / 8))
    data.SetNormals(array(vtk.vtkFloatArray, "n", 3, n, lambda i: i / 8))
    data.SetTensors(array(vtk.vtkDoubleArray, "t", 9, n, lambda i: i / 8))
    data.SetTCoords(array(vtk.vtkDoubleArray, "tc", 2, n, lambda i: i / 8))
    data.SetGlobalIds(array(vtk.vtkIdTypeArray, "g", 1, n, lambda i: i))


def cells(*lists):
    out = vtk.vtkCellArray()
    for one in lists:
        out.InsertNextCell(len(one))
        for p in one:
            out.InsertCellPoint(p)
    return out


def datasets():
    points = vtk.vtkPoints()
    points.SetDataTypeToDouble()
    for i in range(8):
        points.InsertNextPoint(i % 2 + 0.25, i // 2 % 2, i // 4)
    for name, fill, n in (("verts", lambda d: d.SetVerts(cells(*[[i] for i in range(8)])), 0),
                          ("lines", lambda d: d.SetLines(cells([0, 1, 2], [3, 4])), 0),
                          ("polys", lambda d: d.SetPolys(cells([0, 1, 3], [0, 1, 3, 2])), 2)):
        data = vtk.vtkPolyData()
        data.SetPoints(points)
        fill(data)
        decorate(data.GetPointData(), 8)
        if n:
            decorate(data.GetCellData(), n)
        yield name, vtk.vtkPolyDataWriter(), data
    grid = vtk.vtkUnstructuredGrid()
    grid.SetPoints(points)
    grid.InsertNextCell(12, 8, [0, 1, 3, 2, 4, 5, 7, 6])
    stream = vtk.vtkIdList()
    for x in (6, 4, 0, 2, 3, 1, 4, 4, 5, 7, 6, 4, 0, 1, 5, 4, 4, 1, 3, 7, 5, 4, 3, 2, 6, 7, 4, 2, 0, 4, 6):
        stream.InsertNextId(x)
    grid.InsertNextCell(42, stream)
    grid.InsertNextCell(5, 3, [0, 1, 2])
    decorate(grid.GetPointData(), 8)
    decorate(grid.GetCellData(), 3)
    yield "cells", vtk.vtkUnstructuredGridWriter(), grid
    curved = vtk.vtkStructuredGrid()
    curved.SetDimensions(4, 2, 1)
    curved.SetPoints(points)
    decorate(curved.GetPointData(), 8)
    curved.BlankCell(1)
    yield "structured", vtk.vtkStructuredGridWriter(), curved
    boxes = vtk.vtkRectilinearGrid()
    boxes.SetDimensions(2, 2, 2)
    boxes.SetXCoordinates(array(vtk.vtkDoubleArray, "x", 1, 2, lambda i: i / 4))
    boxes.SetYCoordinates(array(vtk.vtkFloatArray, "y", 1, 2, lambda i: i))
    boxes.SetZCoordinates(array(vtk.vtkIntArray, "z", 1, 2, lambda i: i))
    decorate(boxes.GetPointData(), 8)
    yield "rectilinear", vtk.vtkRectilinearGridWriter(), boxes
    image = vtk.vtkImageData()
    image.SetSpacing(0.25, 1, 2)
    image.SetExtent(3, 4, 0, 1, 0, 1)
    decorate(image.GetPointData(), 8)
    decorate(image.GetCellData(), 1)
    yield "image", vtk.vtkStructuredPointsWriter(), image


def make(folder):
    for name, writer, data in datasets():
        versions = (("42", writer.VTK_LEGACY_READER_VERSION_4_2), ("51", writer.VTK_LEGACY_READER_VERSION_5_1))
        for version, number in versions:
            for kind, file_type in (("text", 1), ("binary", 2)):
                path = os.path.join(folder, "%s_%s_%s.vtk" % (name, version, kind))
                writer.SetInputData(data)
                writer.SetFileVersion(number)
                writer.SetFileType(file_type)
                writer.SetFileName(path)
                writer.Write()


def dump(folder):
    for name in sorted(os.listdir(folder)):
        if name.endswith(".vtk"):
            path = os.path.join(folder, name)
            with open(path[:-4] + ".txt", "w", encoding="utf-8") as out:
                out.write("\n".join(lines(load(path))) + "\n")


{"make": make, "dump": dump}[sys.argv[1]](sys.argv[2])
