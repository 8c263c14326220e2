# SPDX-License-Identifier: AGPL-3.0-or-later
"""Each F code of the catalogue is reported of a small file, with the line or byte where it stands.

usage: file_codes_test.py PROGRAM
"""

import gzip
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(os.environ.get("GEOMEND_SOURCE_DIR", pathlib.Path(__file__).parents[2])).resolve()
BOX = (ROOT / "samples" / "layered_box.ml").read_text(encoding="utf-8")
GRID = (ROOT / "samples" / "faulted_grid.grdecl").read_text(encoding="utf-8")

# Codes that no small file can have, and the test that has them.
TESTED_ELSEWHERE = {
    "F164": "elements numbered twice are tested by tests/gmsh/hostile_test.cpp",
    "F022": "stopping is tested by tests/cli/misfortunes_test.cpp",
    "F025": "crashing is tested by tests/cli/validate_many_test.cpp",
    "F130": "ghost cells are tested by tests/vtk/xml_read_test.cpp",
    "F133": "grids that do not fit are tested by tests/eclipse/roundtrip_test.cpp",
    "F134": "files of old simulators are tested by tests/eclipse/reading_test.cpp",
}
# Codes that stand nowhere in a file, and why.
WITHOUT_LINE = {
    "F001": "about the file as a whole", "F002": "about the file as a whole", "F003": "about the file as a whole",
    "F016": "about two files", "F017": "about the file as a whole", "F018": "about the command line", "F020": "about an output",
    "F021": "about an output", "F023": "about the run", "F024": "what is missing stands nowhere",
    "F026": "about the model", "F027": "about the model",
    "F106": "the face is named", "F111": "about the whole model", "F113": "the surface or region is named",
    "F116": "the face is named", "F121": "the region is named", "F122": "the entities are named",
    "F123": "the entities are named", "F132": "about all depths of a grid", "F133": "about a file that is not used", "F141": "what is missing stands nowhere",
    "F143": "about a file that is missing", "F151": "made while converting", "F152": "made while converting",
    "F153": "made while converting", "F154": "made while converting", "F155": "made while converting",
    "F160": "about kinds of objects", "F161": "about the whole grid", "F162": "about what was not judged", "F167": "about the whole result",
}


def tsurf(*records, head="name:a"):
    return "\n".join(["GOCAD TSurf 1", "HEADER {", head, "}", "TFACE", "VRTX 1 0 0 0", "VRTX 2 1 0 0", "VRTX 3 0 1 0", *records, "END", ""])


TRIANGLE = "TRGL 1 2 3"
DECK = "SPECGRID\n 1 1 1 1 F /\nCOORD\n 0 0 0 0 0 9  1 0 0 1 0 9  0 1 0 0 1 9  1 1 0 1 1 9 /\nZCORN\n 4*1 4*2 /\n"
MSH = """$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
3
1 0 0 0
2 1 0 0
3 0 1 0
$EndNodes
$Elements
%s
$EndElements
"""
VTK = "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET %s\n"

# Code to files and the command, of which the first word that is a file is the one that is spoken of.
CASES = {
    "F001": ({}, "validate missing.ml"),
    "F002": ({"a.ts": ""}, "validate a.ts"),
    "F003": ({"a.xyzzy": "some words\n"}, "validate a.xyzzy"),
    "F004": ({"a.ml": BOX[:len(BOX) // 2]}, "validate a.ml"),
    "F005": ({"a.ts": tsurf(TRIANGLE, "VRTX 4 1 x 0")}, "validate a.ts"),
    "F006": ({"a.ts": tsurf(TRIANGLE, "VRTX 4 1 nan 0")}, "validate a.ts"),
    "F007": ({"a.ts": tsurf("TRGL 1 2 9")}, "validate a.ts"),
    "F008": ({"a.vtk": VTK % "POLYDATA" + "POINTS 3 double\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 5\n3 0 1 2 0\n"}, "validate a.vtk"),
    "F009": ({"a.ts": tsurf(TRIANGLE, "VRTX 3 1 1 0")}, "validate a.ts"),
    "F010": ({"a.grdecl": "INCLUDE\n 'missing.inc' /\n" + DECK}, "validate a.grdecl"),
    "F011": ({"a.vo": "GOCAD Voxet 1\nHEADER {\nname:v\n}\nAXIS_O 0 0 0\nAXIS_U 1 0 0\nAXIS_V 0 1 0\nAXIS_W 0 0 1\nAXIS_N 2 2 2\n"
                      "AXIS_MIN 0 0 0\nAXIS_MAX 1 1 1\nPROPERTY 1 p\nPROP_ESIZE 1 4\nPROP_ETYPE 1 IEEE\nPROP_FILE 1 p.bin\nEND\n",
              "p.bin": "1234"}, "validate a.vo"),
    "F012": ({"a.ts": tsurf("TRGL 1 2")}, "validate a.ts"),
    "F013": ({"a.vtk": VTK % "UNHEARD_OF" + "x\n"}, "validate a.vtk"),
    "F014": ({"a.vtk": VTK % "POLYDATA" + "POINTS 999999999 double\n0 0 0\n"}, "validate a.vtk"),
    "F015": ({"a.ts.gz": gzip.compress(tsurf(TRIANGLE).encode())[:-9] + b"........."}, "validate a.ts.gz"),
    "F016": ({"a.ts": tsurf(TRIANGLE),
              "b.ts": tsurf(TRIANGLE).replace("TFACE", "GOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME X Y Z\nAXIS_UNIT ft ft ft\n"
                                              "ZPOSITIVE Depth\nEND_ORIGINAL_COORDINATE_SYSTEM\nTFACE"),
              "c.ts": tsurf(TRIANGLE).replace("TFACE", "GOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME X Y Z\nAXIS_UNIT m m m\n"
                                              "ZPOSITIVE Elevation\nEND_ORIGINAL_COORDINATE_SYSTEM\nTFACE")}, "convert b.ts c.ts -o o.ts"),
    "F017": ({"a.ts": "GOCAD Unheard 1\nHEADER {\nname:a\n}\nEND\n"}, "validate a.ts"),
    "F018": ({"a.ts": tsurf(TRIANGLE)}, "validate a.ts --option no=thing"),
    "F020": ({"a.ts": tsurf(TRIANGLE)}, "convert a.ts -o missing/o.ts"),
    "F021": ({"a.ts": tsurf(TRIANGLE)}, "convert a.ts -o o.grdecl"),
    "F023": ({"a.ts": tsurf(*[f"TRGL {i % 3 + 1} {(i + 1) % 3 + 1} {(i + 2) % 3 + 1}" for i in range(300000)])}, "validate a.ts --time-limit 0.01"),
    "F024": ({"a.grdecl": "PORO\n 8*0.2 /\n"}, "validate a.grdecl"),
    "F026": ({"a.ts": tsurf(TRIANGLE)}, "mesh a.ts -o o.vtu"),
    "F027": ({"a.ts": tsurf(TRIANGLE)}, "grid a.ts -o o.grdecl --cells 2x2"),
    "F101": ({"a.ts": tsurf(TRIANGLE).replace("END\n", "")}, "validate a.ts"),
    "F102": ({"a.ts": tsurf(TRIANGLE).replace("TFACE", "UNHEARD_OF 1\nTFACE")}, "validate a.ts"),
    "F103": ({"a.ts": tsurf(TRIANGLE, "TRGL 1 1 2")}, "validate a.ts"),
    "F105": ({"a.ts": tsurf(TRIANGLE).replace("TFACE", "PROPERTIES p q\nTFACE").replace("VRTX 1 0 0 0", "PVRTX 1 0 0 0 5")}, "validate a.ts"),
    "F106": ({"a.ml": BOX.replace("TFACE 3  top H1\n  0 0 -300\n  159.423 0 -282.679\n", "TFACE 3  top H1\n  159.423 0 -282.679\n  0 0 -300\n")},
             "validate a.ml"),
    "F107": ({"a.ts": tsurf(TRIANGLE).replace("VRTX 1 0 0 0", "PVRTX 1 0 0 0 5")}, "validate a.ts"),
    "F108": ({"a.ml": BOX.replace("LAYER ", "LAYER nothing\n  1\nLAYER ", 1) if "LAYER " in BOX else BOX}, "validate a.ml"),
    "F109": ({"a.ml": BOX.replace("LAYER ", "LAYER nothing\n  977 0\nLAYER ", 1)}, "validate a.ml"),
    "F111": ({"a.ml": BOX}, "validate a.ml"),
    "F113": ({"a.stl": "solid a\nfacet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n"},
             "validate a.stl"),
    "F115": ({"a.gp": "GOCAD HomogeneousGroup 1\nHEADER {\nname:g\n}\nTYPE TSurf\nBEGIN_MEMBERS\n" + tsurf(TRIANGLE) + "END_MEMBERS\nEND\n"
                      "GOCAD HomogeneousGroup 1\nHEADER {\nname:g\n}\nTYPE TSurf\nBEGIN_MEMBERS\n" + tsurf(TRIANGLE, head="name:b") + "END_MEMBERS\nEND\n"},
             "validate a.gp"),
    "F116": ({"a.ml": BOX.replace("TFACE 3  top H1\n  0 0 -300\n", "TFACE 3  top H1\n  7 7 -300\n")}, "validate a.ml"),
    "F118": ({"a.ts": tsurf(TRIANGLE + " 7")}, "validate a.ts"),
    "F119": ({"a.ts": tsurf(TRIANGLE) + "GOCAD TSurf 1\nHEADER {\nname:empty\n}\nEND\n"}, "validate a.ts"),
    "F120": ({"a.ts": tsurf(TRIANGLE).replace("TFACE", "PROPERTIES p\nTFACE").replace("VRTX 1 0 0 0", "PVRTX 1 0 0 0 nan")}, "validate a.ts"),
    "F121": ({"a.ml": BOX.replace("LAYER ", "REGION 977 nowhere\n  0\nLAYER ", 1)}, "validate a.ml"),
    "F122": ({"a.msh": MSH.replace("3\n1 0 0 0", "4\n4 1 1 0\n1 0 0 0") % "2\n1 2 2 7 1 1 2 3\n2 2 2 8 1 2 4 3"}, "validate a.msh"),
    "F123": ({"a.msh": MSH % "2\n1 2 2 7 1 1 2 3\n2 2 2 8 1 1 2 3"}, "validate a.msh"),
    "F131": ({"d/a.grdecl": "INCLUDE\n 'else/where.inc' /\n", "d/where.inc": DECK}, "validate d/a.grdecl"),
    "F132": ({"a.grdecl": DECK.replace("4*1 4*2", "4*-1 4*-2").replace("0 9", "0 -9").replace("1 9", "1 -9")}, "validate a.grdecl"),
    "F141": ({"a.grdecl": "FAULTS\n 'f' 1 2 1 2 1 2 'I' /\n/\n"}, "validate a.grdecl"),
    "F142": ({"a.grdecl": DECK + "COPY\n PERMX PERMY /\n/\n"}, "validate a.grdecl"),
    "F143": ({"a.grdecl": DECK + "-- further properties: a.properties.grdecl\n"}, "validate a.grdecl"),
    "F144": ({"a.grdecl": DECK + "PORO 1 value\n 0.2 /\n"}, "validate a.grdecl"),
    "F145": ({"a.grdecl": "SPECGRID\n 1 1 2 1 F /\nDX\n 2*1 /\nDY\n 2*1 /\nDZ\n 1 /\nTOPS\n 1 /\n"}, "validate a.grdecl"),
    "F146": ({"a.grdecl": DECK + "FAULTS\n 'f' 1 1 1 1 1 1 'x' /\n/\n"}, "validate a.grdecl"),
    "F147": ({"a.grdecl": DECK + "FAULTS\n 'f' 1 1 1 1 1 1 'X' /\nPORO\n 0.2 /\n"}, "validate a.grdecl"),
    "F148": ({"a.grdecl": DECK + "ADDZCORN\n 1 1 1 1 1 1 1 /\n/\n"}, "validate a.grdecl"),
    "F149": ({"a.grdecl": "GRID\n" + DECK + "EQUALS\n DX 1 /\n/\n"}, "validate a.grdecl"),
    "F150": ({"a.grdecl": DECK + "NNC\n 1 1 1 1 1 1 0.5 1 1 1 1 1 1 1 1 /\n/\n"}, "validate a.grdecl"),
    "F151": ({"a.grdecl": GRID + "EQUALS\n PERMX 1e-12 /\n/\n"}, "convert a.grdecl -o o.EGRID --lossy --option connections=compute"),
    "F152": ({"a.grdecl": GRID}, "convert a.grdecl -o o.vtu --option faces=conformal --lossy"),
    "F153": ({"a.grdecl": GRID + "MINPV\n 1e9 /\n"}, "convert a.grdecl -o o.EGRID --lossy --option connections=compute"),
    "F154": ({"a.grdecl": GRID}, "convert a.grdecl -o o.grdecl --lossy --option origin=local"),
    "F155": ({"a.grdecl": GRID}, "convert a.grdecl -o o.grdecl --lossy --option connections=compute"),
    "F160": ({"a.wl": "GOCAD Well 1\nHEADER {\nname:w\n}\nWREF 0 0 0\nEND\n"}, "validate a.wl"),
    "F161": ({"a.grdecl": "SPECGRID\n 1 1 1 1 F /\nPORO\n 0.2 /\n"}, "validate a.grdecl"),
    "F162": ({"a.grdecl": DECK}, "validate a.grdecl --option as=brep --option regions=NONE"),
    "F163": ({"a.w": "1.0\nUndefined\nA 1 2\n1\nGR API lin\n1 2 3 75\n1 2 4 80\n"}, "validate a.w"),
    "F165": ({"a.vtk": VTK % "POLYDATA" + "POINTS 3 double\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2"}, "validate a.vtk"),
    "F166": ({"a.ts": tsurf(TRIANGLE, head="name:a\nno entry")}, "validate a.ts"),
    "F167": ({"a.ts": tsurf(TRIANGLE, TRIANGLE)}, "repair a.ts -o o.ts"),
}


def run(program, folder, files, command):
    """All findings that a command reports, whatever it does with them."""
    for name, content in files.items():
        path = pathlib.Path(folder, name)
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
    words = command.split()
    done = subprocess.run([program, *words, "--json", "--progress", "never"], cwd=folder, capture_output=True, text=True, check=False, timeout=120)
    found = []

    def collect(value):
        if isinstance(value, dict):
            if "code" in value and "message" in value:
                found.append(value)
            for inner in value.values():
                collect(inner)
        elif isinstance(value, list):
            for inner in value:
                collect(inner)

    try:
        collect(json.loads(done.stdout))
    except ValueError:
        pass
    if not found and "[" in done.stderr:
        found.append({"code": done.stderr.split("[")[-1].split("]")[0], "message": done.stderr.splitlines()[0]})
    return found, done


def main(program):
    wrong = []
    catalogue = json.loads(subprocess.run([program, "checks", "F", "--json"], check=True, capture_output=True, text=True).stdout)
    codes = [row["code"] for row in catalogue]
    for code in codes:
        if (code in CASES) == (code in TESTED_ELSEWHERE):
            wrong.append(f"{code}: expected a case, or a test elsewhere")
    wrong += [f"{code} is not in the catalogue" for code in {**CASES, **TESTED_ELSEWHERE, **WITHOUT_LINE} if code not in codes]
    for code, (files, command) in CASES.items():
        with tempfile.TemporaryDirectory() as folder:
            found, done = run(program, folder, files, command)
        of_code = [f for f in found if f["code"] == code]
        if not of_code:
            wrong.append(f"{code}: '{command}' reports {[f['code'] + ' ' + f['message'] for f in found]} ({done.returncode}) {done.stderr[:300]}")
        for finding in of_code:
            place = finding.get("location", {})
            if code not in WITHOUT_LINE and place.get("line", 0) == 0 and place.get("offset", -1) < 0:
                wrong.append(f"{code}: no line and no byte of the file: {finding['message']}")
    if wrong:
        sys.exit("\n".join(wrong))
    print(f"{len(CASES)} codes")


main(*sys.argv[1:])
