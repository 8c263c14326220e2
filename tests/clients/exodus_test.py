# SPDX-License-Identifier: AGPL-3.0-or-later
"""VTK reads the Exodus II files that geomend writes, with the cells, volumes and sides of the model.

usage: exodus_test.py PROGRAM

Skipped where Python has no VTK with its reader of Exodus II.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(os.environ.get("GEOMEND_SOURCE_DIR", pathlib.Path(__file__).parents[2])).resolve()

try:
    from vtkmodules.vtkFiltersVerdict import vtkMeshQuality
    from vtkmodules.vtkIOExodus import vtkExodusIIReader
except ImportError:
    print("no VTK with Exodus II: skipped")
    sys.exit(77)

wrong = []


def expect(holds, what):
    if not holds:
        wrong.append(what)


def blocks_of(reader, kind):
    """Name and grid of each block or set of a kind, all of them read."""
    for i in range(reader.GetNumberOfObjects(kind)):
        reader.SetObjectStatus(kind, i, 1)
    names = [reader.GetObjectName(kind, i) for i in range(reader.GetNumberOfObjects(kind))]
    reader.Update()
    return names


def parts(output, names):
    """The leaves of a tree of blocks by the names that the reader gives them."""
    found = {}
    walk = output.NewIterator()
    walk.InitTraversal()
    while not walk.IsDoneWithTraversal():
        name = walk.GetCurrentMetaData().Get(output.NAME())
        if name in names:
            found[name] = walk.GetCurrentDataObject()
        walk.GoToNextItem()
    return found


def volume_of(grid):
    measure = vtkMeshQuality()
    measure.SetInputData(grid)
    measure.SetTetQualityMeasureToVolume()
    measure.SaveCellQualityOn()
    measure.Update()
    values = measure.GetOutput().GetCellData().GetArray("Quality")
    return sum(values.GetTuple1(i) for i in range(values.GetNumberOfTuples()))


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "cells.exo")
        done = subprocess.run([program, "mesh", ROOT / "samples" / "layered_box.ml", "-o", file, "--lossy", "--json"],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
        expect(done.returncode == 0, f"mesh: {done.stderr}")
        report = json.loads(done.stdout)
        reader = vtkExodusIIReader()
        reader.SetFileName(str(file))
        reader.UpdateInformation()
        expect(reader.GetNumberOfNodes() > 0, "no nodes")
        names = blocks_of(reader, vtkExodusIIReader.ELEM_BLOCK)
        sides = blocks_of(reader, vtkExodusIIReader.SIDE_SET)
        found = parts(reader.GetOutput(), set(names) | set(sides))
        regions = {r["name"]: r for r in report["regions"]}
        for name in names:
            region = next((r for n, r in regions.items() if name == n or name.startswith(n + " ")), None)
            expect(region is not None, f"block {name} is none of {list(regions)}")
            if region is None or name not in found:
                expect(name in found, f"block {name} is not read")
                continue
            expect(found[name].GetNumberOfCells() == region["cells"]["tetrahedron"], f"{name}: {found[name].GetNumberOfCells()} cells")
            expect(abs(volume_of(found[name]) - region["volume"]) <= 1e-9 * region["volume"], f"{name}: volume {volume_of(found[name])}")
        expect(len(names) == len(regions), f"{len(names)} blocks")
        read = sum(found[s].GetNumberOfCells() for s in sides if s in found)
        expect(sides and read == sum(s["count"] for s in report["face_sets"]), f"{read} sides in {len(sides)} sets")
    for what in wrong[:20]:
        print(what)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
