# SPDX-License-Identifier: AGPL-3.0-or-later
"""Meshes of hexahedra, prisms, pyramids and tetrahedra are taken by those who use them: Gmsh, VTK, OpenFOAM and CalculiX.

usage: hexahedra_test.py PROGRAM

A layered box with a fault as hexahedra, thin shells between spheres and a thin layer that pinches out as prisms, and real models where they
are at hand, are read by each and checked by its own check; the figures that OpenFOAM reports are those of the mesh. CalculiX, for which
pyramids are collapsed hexahedra, solves the problems of elasticity_test.py on them. Whoever is not installed is left out; without any of
them the test is skipped.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter

import elasticity_test as elasticity
from elasticity_test import ROOT, expect
from thin_models import nested_spheres, pinched_layer

FOAM = pathlib.Path(os.environ.get("WM_PROJECT_DIR", "/usr/share/openfoam"))
DATA = pathlib.Path(os.environ.get("GEOMEND_REAL_DATA") or ROOT.parent / "shared" / "data")
# Corners of the faces of elements that CalculiX has.
FACES = {"C3D4": ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)),
         "C3D6": ((0, 1, 2), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
         "C3D8": ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))}


def run(*words, cwd=None, env=None):
    done = subprocess.run(list(map(str, words)), cwd=cwd, env=env, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    return done.returncode, done.stdout


def make(program, folder, model, *options):
    """The mesh as a file for each of them. \\return its volume by the report, None where something could not be written"""
    folder.mkdir()
    status, said = run(program, "mesh", model, "-o", folder / "mesh.vtu", *options, "--lossy", "--quiet", "--json")
    expect(status == 0, f"mesh {model}: {said[-600:]}")
    if status != 0:
        return None
    volume = sum(region["volume"] for region in json.loads(said[said.index("{"):])["regions"])
    for name in ("mesh.msh", "mesh.foam", "mesh.inp"):
        status, said = run(program, "convert", folder / "mesh.vtu", "-o", folder / name, "--lossy", "--quiet")
        expect(status == 0, f"convert {model} to {name}: {said}")
    return volume


def gmsh_checks(folder):
    if shutil.which("gmsh") is None:
        return False
    status, said = run("gmsh", "-check", folder / "mesh.msh")
    expect(status == 0 and "Done checking mesh coherence" in said, f"{folder.name}: gmsh -check: {said[-600:]}")
    expect("Warning" not in said and "Error" not in said, f"{folder.name}: gmsh -check: {said[-600:]}")
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
        status, said = run(python, "-c", code, folder / "mesh.vtu")
        if status == 0:
            counts, positive = said.splitlines()[-2:]
            expect(positive == "True", f"{folder.name}: VTK measures a cell without volume or inside out")
            return dict(eval(counts))  # pylint: disable=eval-used
    return None


def foam_checks(folder, counts, volume):
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
    expect(status == 0 and topology and "***" not in topology, f"{folder.name}: checkMesh: {topology or said[-1500:]}")
    # Faces may be skew where surfaces are steep to each other; no cell is flat, without volume or inside out.
    geometry = said[said.find("Checking geometry"):]
    expect(all("skew" in line for line in geometry.splitlines() if "***" in line), f"{folder.name}: checkMesh: {geometry}")
    for fine in ("Cell volumes OK", "Face area magnitudes OK", "Face pyramids OK"):
        expect(fine in said, f"{folder.name}: checkMesh: not {fine}: {geometry}")
    for words, kind in (("hexahedra", 12), ("pyramids", 14), ("tetrahedra", 10), ("prisms", 13)) if counts is not None else ():
        found = re.search(rf"^ *{words}: +(\d+)$", said, re.MULTILINE)
        expect(found and int(found.group(1)) == counts.get(kind, 0), f"{folder.name}: checkMesh: {words} {found and found.group(1)}, not {counts}")
    # It measures faces that are not even from their middle, the report along diagonals.
    total = re.search(r"Total volume = (\S+?)\.? ", said)
    expect(total and abs(float(total.group(1)) - volume) <= 2e-3 * volume,
           f"{folder.name}: checkMesh: volume {total and total.group(1)}, not {volume}")
    return True


def elements_of(mesh):
    """Types and nodes of the elements of a deck."""
    kind = None
    for line in mesh.read_text(encoding="utf-8").splitlines():
        if line.startswith("*"):
            found = re.match(r"\*ELEMENT, TYPE=(\w+)", line)
            kind = found.group(1) if found else None
        elif kind:
            yield kind, [int(n) for n in line.split(",")][1:]


def outside_of(mesh):
    """Nodes of faces that one element alone has."""
    seen = Counter()
    for kind, nodes in elements_of(mesh):
        for face in FACES[kind]:
            corners = frozenset(nodes[k] for k in face)
            if len(corners) > 2:
                seen[corners] += 1
    expect(max(seen.values()) == 2, f"{mesh}: a face of {max(seen.values())} elements")
    return {n for face, count in seen.items() if count == 1 for n in face}


def calculix_solves(folder, counts):
    if shutil.which("ccx") is None:
        return False
    mesh = folder / "mesh.inp"
    if counts is not None:
        collapsed = sum(kind == "C3D8" and len(set(nodes)) == 5 for kind, nodes in elements_of(mesh))
        expect(collapsed == counts.get(14, 0), f"{folder.name}: {collapsed} collapsed hexahedra for {counts.get(14, 0)} pyramids")
    points, sets = elasticity.read_mesh(mesh)
    sets = list(dict.fromkeys(sets))
    outside = outside_of(mesh)
    elasticity.displace_the_outside(str(folder), mesh, points, sets, outside)
    elasticity.heat_the_outside(str(folder), mesh, points, sets, outside)
    return True


def calculix_presses_two_layers(program, folder):
    """Of level layers nothing but hexahedra is made, and all of the problems are solved."""
    if shutil.which("ccx") is None:
        return False
    (folder / "layers.ts").write_text(two_layers(), encoding="utf-8")
    mesh = folder / "layers.inp"
    status, said = run(program, "mesh", folder / "layers.ts", "-o", mesh, "--cells", "hex-dominant", "--size", "0.2", "--lossy", "--quiet")
    expect(status == 0, f"mesh {mesh.name}: {said}")
    if status != 0:
        return True
    kinds = {(kind, len(set(nodes))) for kind, nodes in elements_of(mesh)}
    expect(kinds == {("C3D8", 8)}, f"two level layers are hexahedra alone, not {kinds}")
    points, sets = elasticity.read_mesh(mesh)
    expect(len(sets) == 2, f"two regions, not {sets}")
    for problem in (elasticity.press_from_above, elasticity.displace_the_outside, elasticity.heat_the_outside):
        problem(str(folder), mesh, points, sets)
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


def models_in(folder):
    """Names, files and options."""
    (folder / "spheres.ts").write_text(nested_spheres(3, (100, 95, 90)), encoding="utf-8")
    (folder / "pinch.ts").write_text(pinched_layer(), encoding="utf-8")
    models = [("box", ROOT / "samples" / "layered_box.ml", ("--cells", "hex-dominant", "--size", "60")),
              ("shells", folder / "spheres.ts", ("--cells", "hybrid")),
              ("pinch", folder / "pinch.ts", ("--cells", "hybrid", "--size", "50")),
              ("modelA1", DATA / "gocad" / "modelA1.ml", ("--cells", "hybrid")),
              ("modelA4", DATA / "gocad" / "modelA4.so", ("--recombine",))]
    return [model for model in models if model[1].exists()]


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    there = []
    with tempfile.TemporaryDirectory() as name:
        for model, file, options in models_in(pathlib.Path(name)):
            folder = pathlib.Path(name, model)
            volume = make(program, folder, file, *options)
            if volume is not None:
                counts = vtk_counts(folder)
                there += [counts is not None, gmsh_checks(folder), foam_checks(folder, counts, volume), calculix_solves(folder, counts)]
        there.append(calculix_presses_two_layers(program, pathlib.Path(name)))
    for what in elasticity.wrong[:20]:
        print(what)
    if elasticity.wrong:
        return 1
    return 0 if any(there) else 77


if __name__ == "__main__":
    sys.exit(main())
