# SPDX-License-Identifier: AGPL-3.0-or-later
"""The manual page of each family describes every option of its formats, with every word that it may have, and no other.

usage: manual_options_test.py PROGRAM
"""

import json
import os
import re
import subprocess
import sys

ROOT = os.path.abspath(os.environ.get("GEOMEND_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", "..")))
PAGE_OF_FAMILY = {"grdecl": "cornerpoint", "eclipse": "cornerpoint", "roff": "cornerpoint"}
# What the page describes of commands, which work on grids whatever their format.
OF_COMMANDS = {"cornerpoint": {"map", "origin", "connections", "faces", "regions", "as", "horizons", "quality"}}


def described(page):
    """Key to words (or how the value is written) of the section OPTIONS."""
    with open(os.path.join(ROOT, "man", f"geomend-{page}.5.scd"), encoding="utf-8") as file:
        section = re.search(r"^# OPTIONS\n(.*?)(?=^# |\Z)", file.read(), re.M | re.S)
    found = {}
    for line in (section.group(1) if section else "").splitlines():
        if not line.startswith("*"):
            continue
        for option in line.split(", "):
            match = re.match(r"([a-z-]+)=(.+)", option.replace("*", "").replace("_", ""))
            if match:
                found.setdefault(match.group(1), set()).update(match.group(2).split("|"))
    return found


def main(program):
    text = subprocess.run([program, "formats", "--json"], check=True, stdout=subprocess.PIPE, text=True).stdout
    tables = {}
    for row in json.loads(text):
        table = tables.setdefault(PAGE_OF_FAMILY.get(row["family"], row["family"]), {})
        for option in row["options"]:
            values = option["values"]
            table.setdefault(option["key"], set()).update(values if isinstance(values, list) else [values])
    wrong = []
    for page, table in tables.items():
        manual = described(page)
        for key in OF_COMMANDS.get(page, ()):
            manual.pop(key, None)
        for key in sorted(table.keys() | manual.keys()):
            if table.get(key) != manual.get(key):
                wrong.append(f"geomend-{page}(5): option {key}: the table has {table.get(key)}, the page {manual.get(key)}")
    if wrong:
        sys.exit("\n".join(wrong))


main(*sys.argv[1:])
