# SPDX-License-Identifier: AGPL-3.0-or-later
"""Findings about Gocad files name the record that is wrong: its line, and what to write in it.

usage: record_places_test.py PROGRAM
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(os.environ.get("GEOMEND_SOURCE_DIR", pathlib.Path(__file__).parents[2])).resolve()
BOX = (ROOT / "samples" / "layered_box.ml").read_text(encoding="utf-8")

wrong = []


def findings(program, text):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "m.ml")
        path.write_text(text, encoding="utf-8")
        done = subprocess.run([program, "validate", path.name, "--json"], cwd=folder, capture_output=True, text=True, check=False, timeout=120)
        return json.loads(done.stdout)["files"][0]["findings"]


def expect(found, code, line, words, what):
    of_code = [f for f in found if f["code"] == code]
    if not any(words in f["message"] and f.get("location", {}).get("line") == line for f in of_code):
        wrong.append(f"{what}: expected {code} at line {line} with '{words}', found "
                     f"{[(f['code'], f.get('location', {}).get('line'), f['message']) for f in found if f['severity'] != 'info']}")


def region_lists():
    """Line of the record (from 1), name, and the tokens of its list with their places in the text."""
    for match in re.finditer(r"^REGION\s+\d+\s+(.*)\n((?:[ \t]*[-+0-9 \t]+\n)+)", BOX, re.M):
        if match.group(1).strip().lower() == "universe":
            continue
        tokens = [(m.start() + match.start(2), m.group(0)) for m in re.finditer(r"[-+]?\d+", match.group(2)) if m.group(0) != "0"]
        yield BOX.count("\n", 0, match.start()) + 1, match.group(1).strip(), tokens


def main(program):
    faces = dict(re.findall(r"^TFACE (\d+)\s+\S+ (\S+)$", BOX, re.M))
    lists = 0
    for line, name, tokens in region_lists():
        lists += 1
        for start, token in tokens:
            number = token.lstrip("+-")
            sign = "-" if token.startswith("-") else "+"
            shown = f"{sign}{number} (TFACE {number} of '{faces[number]}')"
            left_out = BOX[:start] + " " * len(token) + BOX[start + len(token):]
            expect(findings(program, left_out), "B05", line, f"lacks {shown}", f"{name} without {token}")
            other = ("+" if sign == "-" else "-") + number
            turned = BOX[:start] + other + BOX[start + len(token):]
            expect(findings(program, turned), "B30", line, f"its list has {other} (TFACE", f"{name} with {other}")
    if lists < 2:
        wrong.append("there are no lists in the sample")

    lines = BOX.splitlines()
    triangle = next(i for i, text in enumerate(lines) if text.startswith("TRGL") and i > len(lines) // 2)
    first, second, _ = re.findall(r"\d+", lines[triangle])
    twice = "\n".join([*lines[:triangle], f"TRGL {first} {second} {second}", *lines[triangle + 1:], ""])
    expect(findings(program, twice), "B01", triangle + 1, "uses a vertex twice", "a triangle")

    start = next(i for i, text in enumerate(lines) if text.startswith("TRGL"))
    end = next(i for i in range(start, len(lines)) if not lines[i].startswith("TRGL"))
    border = f"BORDER 990 {lines[start].split()[1]} {lines[end - 1].split()[3]}"
    expect(findings(program, "\n".join([*lines[:end], border, *lines[end:], ""])), "B19", end + 1, "stated border", "a border")

    whole = [f for f in findings(program, BOX) if f["severity"] != "info"]
    if whole:
        wrong.append(f"the sample is not sound: {whole}")
    if wrong:
        sys.exit("\n".join(wrong))
    print(f"{lists} lists")


main(*sys.argv[1:])
