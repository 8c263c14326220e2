# SPDX-License-Identifier: AGPL-3.0-or-later
"""The README's table of formats says what the program says, its picture and its links are there.

usage: readme_test.py PROGRAM            compares
       readme_test.py PROGRAM --print    prints the table as it should be
"""

import json
import os
import re
import subprocess
import sys

ROOT = os.path.abspath(os.environ.get("GEOMEND_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", "..")))
HEAD = "| format | extensions | read | written | tried on |\n|---|---|---|---|---|\n"


def table(program):
    """The table of formats in Markdown, from `geomend formats --json`."""
    text = subprocess.run([program, "formats", "--json"], check=True, stdout=subprocess.PIPE, text=True).stdout
    rows = []
    for row in json.loads(text):
        extensions = " ".join(f"`{extension}`" for extension in row["extensions"])
        read, written = ("yes" if row[key] else "" for key in ("read", "write"))
        rows.append(f"| {row['title']} | {extensions} | {read} | {written} | {row['tried_on']} |\n")
    return HEAD + "".join(rows)


def main(program, mode=""):
    wanted = table(program)
    if mode == "--print":
        print(wanted, end="")
        return
    with open(os.path.join(ROOT, "README.md"), encoding="utf-8") as file:
        readme = file.read()
    wrong = [] if wanted in readme else [f"the table of formats should be:\n{wanted}"]
    for target in re.findall(r"\]\(([^)#]+)\)", readme):
        if "://" not in target and not os.path.exists(os.path.join(ROOT, target)):
            wrong.append(f"{target} is linked, but not there")
    if wrong:
        sys.exit("\n".join(wrong))


main(*sys.argv[1:])
