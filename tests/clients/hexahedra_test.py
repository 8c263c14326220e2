# SPDX-License-Identifier: AGPL-3.0-or-later
"""Meshes of hexahedra, pyramids and tetrahedra are taken by those who use them: Gmsh, VTK, OpenFOAM and CalculiX.

usage: hexahedra_test.py PROGRAM

The layered box with a fault is read by each and checked by its own check; the figures that OpenFOAM reports are those of the mesh.
CalculiX, which has no pyramids, solves the problems of elasticity_test.py on two layers of hexahedra alone. Whoever is not installed is
left out; without any of them the test is skipped.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import elasticity_test as elasticity
from elasticity_test import ROOT, expect

FOAM = pathlib.Path(os.environ.get("WM_PROJECT_DIR", "/usr/share/openfoam"))


def run(*words, cwd=None, env=None):
    done = subprocess.run(list(map(str, words)), cwd=cwd, env=env, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    return done.returncode, done.stdout


def mesh_of_the_sample(program, folder):
    for name in ("box.vtu", "box.msh", "box.foam"):
        status, said = run(program, "mesh", ROOT / "samples" / "layered_box.ml", "-o", folder / name, "--cells", "hex-dominant", "--size", "60",
                           "--lossy", "--quiet")
        expect(status == 0, f"mesh {name}: {said}")


def gmsh_checks(folder):
    if shutil.which("gmsh") is None:
        return False
    status, said = run("gmsh", "-check", folder / "box.msh")
    expect(status == 0 and "Done checking mesh coherence" in said, f"gmsh -check: {said[-600:]}")
    expect("Warning" not in said and "Error" not in said, f"gmsh -check: {said[-600:]}")
    return True


def vtk_counts(folder):
    """Cells by VTK's type, with their volumes by VTK's own measure, which is positive for cells in the right order."""
    code = """
import sys, vtk
from collections import Counter
reader = vtk.vtkXMLUnstructuredGridReader()
reader.SetFileName(sys.argv[1])
sizes = vtk.vtkCellSizeFilter()
sizes.SetInputConnection(reader.GetOutputPort())
sizes.Update()
grid = sizes.GetOutput()
volume = grid.GetCellData().GetArray('Volume')
solid = [c for c in range(grid.GetNumberOfCells()) if grid.GetCell(c).GetCellDimension() == 3]
print(sorted(Counter(grid.GetCellType(c) for c in solid).items()))
print(min(volume.GetTuple1(c) for c in solid) > 0)
"""
    for python in (sys.executable, "/usr/bin/python3"):
        status, said = run(python, "-c", code, folder / "box.vtu")
        if status == 0:
            counts, positive = said.splitlines()[-2:]
            expect(positive == "True", "VTK measures a cell without volume or inside out")
            return dict(eval(counts))  # pylint: disable=eval-used
    return None


def foam_checks(folder, counts):
    if shutil.which("checkMesh") is None or not FOAM.is_dir():
        return False
    system = folder / "system"
    system.mkdir()
    head = "FoamFile { version 2.0; format ascii; class dictionary; object %s; }\n"
    (system / "controlDict").write_text(head % "controlDict" + "startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 1;\n"
                                        "writeControl timeStep; writeInterval 1;\n", encoding="utf-8")
    for name in ("fvSchemes", "fvSolution"):
        (system / name).write_text(head % name + "ddtSchemes{} gradSchemes{} divSchemes{} laplacianSchemes{} interpolationSchemes{}\n"
                                   "snGradSchemes{} solvers{}\n", encoding="utf-8")
    status, said = run("checkMesh", "-allTopology", cwd=folder, env={**os.environ, "WM_PROJECT_DIR": str(FOAM)})
    topology = said[said.find("Checking topology"):said.find("Checking geometry")]
    expect(status == 0 and topology and "***" not in topology, f"checkMesh: {topology or said[-1500:]}")
    # The shape of cells that are as flat as surfaces have them beside each other is theirs; none is without volume or inside out.
    for fine in ("Cell volumes OK", "Face area magnitudes OK", "Face pyramids OK"):
        expect(fine in said, f"checkMesh: not {fine}: {said[-1500:]}")
    for word, kind in (("hexahedra", 12), ("pyramids", 14), ("tetrahedra", 10)):
        found = re.search(rf"^ *{word}: +(\d+)$", said, re.MULTILINE)
        if counts is not None:
            expect(found and int(found.group(1)) == counts.get(kind, 0), f"checkMesh: {word} {found and found.group(1)}, not {counts}")
    total = re.search(r"Total volume = (\S+?)\.? ", said)
    expect(total and abs(float(total.group(1)) - 8e8) <= 1e4, f"checkMesh: volume {total and total.group(1)}")
    return True


def two_layers():
    """A box of 1 x 1 x 1 with a border at 0.4, as Gocad surfaces."""
    faces = []
    for name, z in (("bottom", 0), ("middle", 0.4), ("top", 1)):
        faces.append((name, [(0, 0, z), (1, 0, z), (1, 1, z), (0, 1, z)]))
    for layer, (low, high) in enumerate(((0, 0.4), (0.4, 1))):
        corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
        for k, (a, b) in enumerate(zip(corners, corners[1:] + corners[:1])):
            faces.append((f"side_{layer}_{k}", [(*a, low), (*b, low), (*b, high), (*a, high)]))
    text = ""
    for name, points in faces:
        text += f"GOCAD TSurf 1\nHEADER {{\nname:{name}\n}}\nTFACE\n"
        text += "".join(f"VRTX {n + 1} {p[0]} {p[1]} {p[2]}\n" for n, p in enumerate(points))
        text += "TRGL 1 2 3\nTRGL 1 3 4\nEND\n"
    return text


def calculix_solves(program, folder):
    if shutil.which("ccx") is None:
        return False
    (folder / "layers.ts").write_text(two_layers(), encoding="utf-8")
    mesh = folder / "layers.inp"
    status, said = run(program, "mesh", folder / "layers.ts", "-o", mesh, "--cells", "hex-dominant", "--size", "0.2", "--lossy", "--quiet")
    expect(status == 0, f"mesh {mesh.name}: {said}")
    if status != 0:
        return True
    kinds = set(re.findall(r"TYPE=(C3D\w+)", mesh.read_text(encoding="utf-8").upper()))
    expect(kinds == {"C3D8"}, f"two level layers are hexahedra alone, not {kinds}")
    points, sets = elasticity.read_mesh(mesh)
    expect(len(sets) == 2, f"two regions, not {sets}")
    for problem in (elasticity.press_from_above, elasticity.displace_the_outside, elasticity.heat_the_outside):
        problem(str(folder), mesh, points, sets)
    return True


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        mesh_of_the_sample(program, folder)
        counts = vtk_counts(folder)
        there = [counts is not None, gmsh_checks(folder), foam_checks(folder, counts), calculix_solves(program, folder)]
    for what in elasticity.wrong[:20]:
        print(what)
    if elasticity.wrong:
        return 1
    return 0 if any(there) else 77


if __name__ == "__main__":
    sys.exit(main())
