# SPDX-License-Identifier: AGPL-3.0-or-later
"""Written meshes compute: CalculiX solves problems on them whose answers are known.

usage: elasticity_test.py PROGRAM

A block of several regions is pressed from above between smooth walls: it sinks evenly, with the same stress everywhere. And displacements
of all its outer points by one linear map, or temperatures (which obey the equation of pressures in a flow), give that map inside. Skipped
where ccx is not installed.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(os.environ.get("GEOMEND_SOURCE_DIR", pathlib.Path(__file__).parents[2])).resolve()
YOUNG, POISSON, PRESSURE = 1e4, 0.25, 5.0

wrong = []


def expect(holds, what):
    if not holds:
        wrong.append(what)


def read_mesh(path):
    """Points by number, and the names of the element sets."""
    points, sets, in_nodes = {}, [], False
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith("*"):
            in_nodes = line.upper().startswith("*NODE")
            found = re.search(r"ELSET=([^,\s]+)", line)
            if line.upper().startswith("*ELEMENT") and found:
                sets.append(found.group(1))
        elif in_nodes:
            number, *at = line.split(",")
            points[int(number)] = tuple(float(x) for x in at)
    return points, sets


def solve(folder, name, mesh, sets, material, step):
    """Runs ccx on a deck. \\return the values that it prints at nodes."""
    deck = pathlib.Path(folder, name + ".inp")
    text = mesh.read_text(encoding="utf-8")
    sections = "".join(f"*SOLID SECTION, ELSET={s}, MATERIAL=ROCK\n" for s in sets)
    deck.write_text(text + "*MATERIAL, NAME=ROCK\n" + material + sections + step, encoding="utf-8")
    done = subprocess.run(["ccx", name], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    expect("*ERROR" not in done.stdout, f"{name}: ccx reports an error: {done.stdout[-600:]}")
    values = {}
    printed = pathlib.Path(folder, name + ".dat")
    for line in printed.read_text(encoding="utf-8").splitlines() if printed.exists() else []:
        words = line.split()
        if words and words[0].isdigit():
            values.setdefault(int(words[0]), []).append([float(x) for x in words[1:]])
    return values


def box_of(points):
    return [min(p[k] for p in points.values()) for k in range(3)], [max(p[k] for p in points.values()) for k in range(3)]


def outer(points):
    low, high = box_of(points)
    return {n for n, p in points.items() if any(p[k] in (low[k], high[k]) for k in range(3))}


def press_from_above(folder, mesh, points, sets):
    low, high = box_of(points)
    boundary = "*BOUNDARY\n"
    for n, p in points.items():
        for k in range(3):
            if p[k] == low[k] or (k < 2 and p[k] == high[k]):
                boundary += f"{n}, {k + 1}, {k + 1}, 0.\n"
    step = ("*NSET, NSET=ALLPOINTS\n" + "".join(f"{n},\n" for n in points) + boundary +
            f"*STEP\n*STATIC\n*DSLOAD\ntop, P, {PRESSURE}\n*NODE PRINT, NSET=ALLPOINTS\nU\n*END STEP\n")
    values = solve(folder, "press", mesh, sets, f"*ELASTIC\n{YOUNG}, {POISSON}\n", step)
    strain = PRESSURE * (1 + POISSON) * (1 - 2 * POISSON) / (YOUNG * (1 - POISSON))
    largest = strain * (high[2] - low[2])
    expect(set(values) == set(points), f"press: values at {len(values)} of {len(points)} points")
    for n, p in points.items():
        found, known = values.get(n, [[9, 9, 9]])[0], (0, 0, -strain * (p[2] - low[2]))
        expect(all(abs(a - b) <= 1e-5 * largest for a, b in zip(found, known)), f"press: point {n} moves by {found}, not by {known}")


def displace_the_outside(folder, mesh, points, sets, outside=None):
    """\\param outside: the points on the border of all; None: those on the planes of the box around."""
    low, high = box_of(points)
    size = max(b - a for a, b in zip(low, high))
    outside = outer(points) if outside is None else outside
    shift = {}
    for n, p in points.items():
        x, y, z = (a - b for a, b in zip(p, low))
        shift[n] = [1e-3 * x + 2e-4 * y - 3e-4 * z, -5e-4 * x + 1e-3 * z, 4e-4 * y - 7e-4 * z]
    boundary = "*BOUNDARY\n" + "".join(f"{n}, {k + 1}, {k + 1}, {shift[n][k]:.12g}\n" for n in sorted(outside) for k in range(3))
    step = ("*NSET, NSET=ALLPOINTS\n" + "".join(f"{n},\n" for n in points) +
            f"*STEP\n*STATIC\n{boundary}*NODE PRINT, NSET=ALLPOINTS\nU\n*END STEP\n")
    values = solve(folder, "patch", mesh, sets, f"*ELASTIC\n{YOUNG}, {POISSON}\n", step)
    inside = set(points) - outside
    expect(len(inside) > 5, f"patch: only {len(inside)} points lie inside")
    for n in inside:
        found = values.get(n, [[9e9] * 3])[0]
        expect(all(abs(a - b) <= 1e-8 * size for a, b in zip(found, shift[n])), f"patch: point {n} moves by {found}, not by {shift[n]}")


def heat_the_outside(folder, mesh, points, sets, outside=None):
    low, high = box_of(points)
    size = max(b - a for a, b in zip(low, high))
    outside = outer(points) if outside is None else outside
    value = {n: (2 * (p[0] - low[0]) - (p[1] - low[1]) + 0.5 * (p[2] - low[2])) / size for n, p in points.items()}
    boundary = "*BOUNDARY\n" + "".join(f"{n}, 11, 11, {value[n]:.12g}\n" for n in sorted(outside))
    step = ("*NSET, NSET=ALLPOINTS\n" + "".join(f"{n},\n" for n in points) + "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALLPOINTS, 0.\n" +
            f"*STEP\n*HEAT TRANSFER, STEADY STATE\n{boundary}*NODE PRINT, NSET=ALLPOINTS\nNT\n*END STEP\n")
    values = solve(folder, "flow", mesh, sets, "*CONDUCTIVITY\n3.\n", step)
    for n in set(points) - outside:
        found = values.get(n, [[9e9]])[0][0]
        expect(abs(found - value[n]) <= 1e-5, f"flow: {found} at point {n}, not {value[n]}")


def main():
    program = sys.argv[1]
    if shutil.which("ccx") is None:
        print("ccx is not installed: skipped")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        mesh = pathlib.Path(folder, "mesh.inp")
        done = subprocess.run([program, "mesh", ROOT / "samples" / "layered_box.ml", "-o", mesh, "--method", "isotropic", "--size", "120",
                               "--lossy", "--quiet"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        expect(done.returncode == 0, f"mesh: {done.stdout}")
        points, sets = read_mesh(mesh)
        expect(len(sets) == 6, f"six regions, not {sets}")
        for problem in (press_from_above, displace_the_outside, heat_the_outside):
            problem(folder, mesh, points, sets)
    for what in wrong[:20]:
        print(what)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
