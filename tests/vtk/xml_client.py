#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""Reads a VTK XML file with VTK's own library and writes what it finds: xml_client.py FILE COUNTS.txt.

Fails (1) where VTK reports an error; --probe only tells whether VTK is there."""
import sys

import vtk

if sys.argv[1] == "--probe":
    sys.exit(0)

readers = {
    "vtu": vtk.vtkXMLUnstructuredGridReader,
    "vtp": vtk.vtkXMLPolyDataReader,
    "vts": vtk.vtkXMLStructuredGridReader,
    "vti": vtk.vtkXMLImageDataReader,
    "vtr": vtk.vtkXMLRectilinearGridReader,
    "vtm": vtk.vtkXMLMultiBlockDataReader,
}
errors = []
reader = readers[sys.argv[1].rsplit(".", 1)[1]]()
for source in (reader, reader.GetExecutive()):
    source.AddObserver("ErrorEvent", lambda *_: errors.append("error"))
reader.SetFileName(sys.argv[1])
reader.Update()
data = reader.GetOutput()
lines = [f"{data.GetNumberOfPoints()} points {data.GetNumberOfCells()} cells"]
if isinstance(data, vtk.vtkImageData):
    lines.append(f"origin {data.GetOrigin()[0]!r}")
if isinstance(data, vtk.vtkDataSet):
    types = {}
    for cell in range(data.GetNumberOfCells()):
        kind = data.GetCellType(cell)
        types[kind] = types.get(kind, 0) + 1
    lines += [f"type {kind}: {count}" for kind, count in sorted(types.items())]
    for place, arrays in (("point", data.GetPointData()), ("cell", data.GetCellData())):
        for i in range(arrays.GetNumberOfArrays()):
            array = arrays.GetAbstractArray(i)
            line = f"{place} {array.GetName()} {array.GetDataTypeAsString()} {array.GetNumberOfComponents()} {array.GetNumberOfTuples()}"
            if isinstance(array, vtk.vtkDataArray):
                line += f" {array.GetRange(-1)!r}"
            lines.append(line)
with open(sys.argv[2], "w", encoding="utf-8") as out:
    out.write("\n".join(lines) + "\n")
sys.exit(1 if errors else 0)
