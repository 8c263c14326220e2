# SPDX-License-Identifier: AGPL-3.0-or-later
"""Sizes by the error of a calculation: CalculiX computes the stress of a block, and geomend makes cells smaller where it is not good enough.

usage: resize_test.py PROGRAM

A block of six regions lies between smooth walls under its own weight and a pressure, so that its stress grows with depth as is known. It
is meshed, computed and meshed anew by the stress of each cell, until no cell's error is above a twentieth. Skipped where ccx is not
installed.
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(os.environ.get("GEOMEND_SOURCE_DIR", pathlib.Path(__file__).parents[2])).resolve()
YOUNG, POISSON, PRESSURE, WEIGHT = 1e10, 0.25, 2e7, 2.4e4  # pascal, pascal for each metre
ROUNDS = 6

wrong = []


def expect(holds, what):
    if not holds:
        wrong.append(what)


def read_deck(path):
    """Points and tetrahedra by number, and the names of the element sets."""
    points, cells, sets, within = {}, {}, [], ""
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith("*"):
            words = [w.strip() for w in line.upper().split(",")]
            within = words[0] if words[0] == "*NODE" or "TYPE=C3D4" in words else ""
            name = [w.strip()[6:] for w in line.split(",") if w.strip().upper().startswith("ELSET=")]
            if within and within != "*NODE":
                sets += name
        elif within == "*NODE":
            number, *at = line.split(",")
            points[int(number)] = tuple(float(x) for x in at)
        elif within:
            number, *nodes = (int(w) for w in line.split(",") if w.strip())
            cells[number] = nodes
    return points, cells, list(dict.fromkeys(sets))


def stress_of(folder, name, points, cells, sets, mesh):
    """Runs ccx. \\return the stress of each cell"""
    low = [min(p[k] for p in points.values()) for k in range(3)]
    high = [max(p[k] for p in points.values()) for k in range(3)]
    boundary = "".join(f"{n}, {k + 1}, {k + 1}, 0.\n" for n, p in points.items() for k in range(3)
                       if p[k] == low[k] or (k < 2 and p[k] == high[k]))
    text = mesh.read_text(encoding="utf-8")
    text += f"*MATERIAL, NAME=ROCK\n*ELASTIC\n{YOUNG}, {POISSON}\n*DENSITY\n1.\n"
    text += "".join(f"*SOLID SECTION, ELSET={s}, MATERIAL=ROCK\n" for s in sets)
    text += f"*BOUNDARY\n{boundary}*STEP\n*STATIC\n*DSLOAD\ntop, P, {PRESSURE}\n*DLOAD\n"
    text += "".join(f"{s}, GRAV, {WEIGHT}, 0., 0., -1.\n" for s in sets)
    text += "".join(f"*EL PRINT, ELSET={s}\nS\n" for s in sets) + "*END STEP\n"
    pathlib.Path(folder, name + ".inp").write_text(text, encoding="utf-8")
    done = subprocess.run(["ccx", name], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    expect("*ERROR" not in done.stdout, f"{name}: ccx reports an error: {done.stdout[-600:]}")
    stress = {}
    for line in pathlib.Path(folder, name + ".dat").read_text(encoding="utf-8").splitlines():
        words = line.split()
        if len(words) == 8 and words[0].isdigit():
            stress[int(words[0])] = [float(x) for x in words[2:]]
    expect(set(stress) == set(cells), f"{name}: stress of {len(stress)} of {len(cells)} cells")
    return stress


def write_result(path, points, cells, stress):
    number = {n: i for i, n in enumerate(points)}

    def array(of, name, components, values):
        return (f'<DataArray type="{of}" Name="{name}" NumberOfComponents="{components}" format="ascii">' +
                " ".join(str(v) for v in values) + "</DataArray>")
    path.write_text(
        '<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid>'
        f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}"><Points>' +
        array("Float64", "Points", 3, (x for p in points.values() for x in p)) + "</Points><Cells>" +
        array("Int64", "connectivity", 1, (number[n] for c in cells.values() for n in c)) +
        array("Int64", "offsets", 1, range(4, 4 * len(cells) + 1, 4)) + array("UInt8", "types", 1, [10] * len(cells)) +
        "</Cells><CellData>" + array("Float64", "stress", 6, (s for c in cells for s in stress[c])) +
        "</CellData></Piece></UnstructuredGrid></VTKFile>\n", encoding="utf-8")


def check_stress(name, points, cells, stress):
    """The mean of the vertical stress at each depth is known."""
    top = max(p[2] for p in points.values())
    for number, nodes in cells.items():
        depth = top - sum(points[n][2] for n in nodes) / 4
        known = -(PRESSURE + WEIGHT * depth)
        expect(abs(stress[number][2] - known) <= 0.35 * abs(known), f"{name}: {stress[number][2]} in cell {number}, about {known} is right")


def mesh_and_solve(program, folder, number, arguments):
    deck = pathlib.Path(folder, f"mesh{number}.inp")
    done = subprocess.run([program, "mesh", ROOT / "samples" / "layered_box.ml", "-o", deck, "--lossy", "--json", *arguments],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    expect(done.returncode == 0, f"mesh, round {number}: {done.stderr}")
    if done.returncode != 0:
        return None, None
    points, cells, sets = read_deck(deck)
    stress = stress_of(folder, f"run{number}", points, cells, sets, deck)
    check_stress(f"round {number}", points, cells, stress)
    result = pathlib.Path(folder, f"result{number}.vtu")
    write_result(result, points, cells, stress)
    return json.loads(done.stdout), result


def main():
    program = sys.argv[1]
    if shutil.which("ccx") is None:
        print("ccx is not installed: skipped")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        _, result = mesh_and_solve(program, folder, 0, ["--method", "isotropic", "--size", "250"])
        steps = []
        for number in range(1, ROUNDS + 2):
            if result is None:
                break
            report, after = mesh_and_solve(program, folder, number, ["--resize-by", result, "--size", "250"])
            if report is None:
                break
            steps.append(report["resize"])
            print(f"round {number - 1}: {steps[-1]['cells']} cells, {steps[-1]['above']} above, largest {steps[-1]['largest']:.3f}, "
                  f"whole {steps[-1]['whole']:.4f}")
            if steps[-1]["above"] == 0:
                break
            result = after
        expect(steps and steps[0]["above"] > 100, "the first mesh is good enough: it shows nothing")
        expect(steps and steps[-1]["above"] == 0 and len(steps) <= ROUNDS + 1, f"above a twentieth after {ROUNDS} rounds: {steps[-1:]}")
        expect(all(b["cells"] > a["cells"] for a, b in zip(steps, steps[1:])), "a round did not make cells smaller")
    for what in wrong[:20]:
        print(what)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
