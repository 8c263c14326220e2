# SPDX-License-Identifier: AGPL-3.0-or-later
"""The programs of CGNS and VTK read the files that geomend writes, with the cells, volumes, sets and values of the model.

usage: cgns_test.py PROGRAM

Skipped where the program was built without the library of CGNS. What of cgnscheck and VTK is not installed is left out.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(os.environ.get("GEOMEND_SOURCE_DIR", pathlib.Path(__file__).parents[2])).resolve()

try:
    from vtkmodules.vtkFiltersVerdict import vtkMeshQuality
    from vtkmodules.vtkIOCGNSReader import vtkCGNSReader
except ImportError:
    vtkCGNSReader = None

wrong = []


def expect(holds, what):
    if not holds:
        wrong.append(what)


def run(*command):
    return subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)


def leaves(output):
    walk = output.NewIterator()
    walk.InitTraversal()
    while not walk.IsDoneWithTraversal():
        yield walk.GetCurrentDataObject()
        walk.GoToNextItem()


def volume_of(grid):
    measure = vtkMeshQuality()
    measure.SetInputData(grid)
    for kind in ("Tet", "Hex"):
        getattr(measure, f"Set{kind}QualityMeasureToVolume")()
    measure.SaveCellQualityOn()
    measure.Update()
    values = measure.GetOutput().GetCellData().GetArray("Quality")
    return sum(values.GetTuple1(i) for i in range(values.GetNumberOfTuples()) if grid.GetCell(i).GetCellDimension() == 3)


def check_by_vtk(file, cells, volume, fields):
    if vtkCGNSReader is None:
        return
    reader = vtkCGNSReader()
    reader.SetFileName(str(file))
    reader.UpdateInformation()
    reader.EnableAllBases()
    reader.EnableAllPointArrays()
    reader.EnableAllCellArrays()
    reader.Update()
    grids = [g for g in leaves(reader.GetOutput()) if g is not None]
    expect(len(grids) == 1, f"{file.name}: {len(grids)} zones")
    solid = sum(1 for g in grids for i in range(g.GetNumberOfCells()) if g.GetCell(i).GetCellDimension() == 3)
    expect(solid == cells, f"{file.name}: VTK reads {solid} cells of {cells}")
    read = sum(volume_of(g) for g in grids)
    expect(volume is None or abs(read - volume) <= 1e-9 * volume, f"{file.name}: the volume is {read}, not {volume}")
    for name in fields:
        expect(any(g.GetPointData().HasArray(name) or g.GetCellData().HasArray(name) for g in grids), f"{file.name}: no field {name}")


def check_by_cgnscheck(file):
    """Neither errors nor warnings, but those about what geological models do not have."""
    if not shutil.which("cgnscheck"):
        return
    text = run("cgnscheck", "-w3", file).stdout
    found = [line for line in text.splitlines() if re.search("ERROR|WARNING", line)]
    harmless = ("reference", "Reference", "time", "simulation type", "mass", "temperature", "angle", "not boundary elements", "not a CGNS data-name", "exponents")
    for line in found:
        expect(any(word in line for word in harmless), f"{file.name}: cgnscheck: {line}")
    expect("checking complete" in text or "leaving" in text, f"{file.name}: cgnscheck: {text[-300:]}")


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "cells.cgns")
        box = ROOT / "samples" / "layered_box.ml"
        done = subprocess.run([program, "mesh", box, "-o", file, "--lossy", "--json"],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
        if "without the library of CGNS" in done.stderr:
            print("built without CGNS: skipped")
            return 77
        expect(done.returncode == 0, f"mesh: {done.stderr}")
        report = json.loads(done.stdout)
        cells = sum(r["cells"]["tetrahedron"] for r in report["regions"])
        check_by_cgnscheck(file)
        check_by_vtk(file, cells, sum(r["volume"] for r in report["regions"]), [])
        if shutil.which("cgnslist"):
            listed = run("cgnslist", file).stdout
            for region in report["regions"]:
                expect(region["name"] in listed, f"no family of {region['name']}")
        again = pathlib.Path(folder, "again.cgns")
        time.sleep(1.1)
        run(program, "mesh", box, "-o", again, "--lossy")
        expect(file.read_bytes() == again.read_bytes(), "the same mesh is not the same file a second later")
        solid = pathlib.Path(folder, "solid.cgns")
        done = run(program, "convert", ROOT / "samples" / "layered_box.so", "-o", solid, "--lossy")
        expect(done.returncode == 0, f"convert: {done.stdout}")
        check_by_cgnscheck(solid)
        check_by_vtk(solid, 240, None, ["porosity", "permeability"])
        hexes = pathlib.Path(folder, "hexes.cgns")
        done = run(program, "mesh", box, "-o", hexes, "--cells", "hex-dominant", "--size", "120", "--lossy")
        expect(done.returncode == 0, f"hexahedra: {done.stdout}")
        check_by_cgnscheck(hexes)
    for what in wrong[:20]:
        print(what)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
