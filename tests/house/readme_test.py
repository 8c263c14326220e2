# SPDX-License-Identifier: AGPL-3.0-or-later
"""The table of formats in docs/formats.md says what the program says; pictures and links of it and of the README are there.

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
    wrong = []
    for page in ("README.md", "docs/formats.md"):
        path = os.path.join(ROOT, page)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        if page != "README.md" and wanted not in text:
            wrong.append(f"the table of {page} should be:\n{wanted}")
        for target in re.findall(r"\]\(([^)#]+)\)", text):
            if "://" not in target and not os.path.exists(os.path.join(os.path.dirname(path), target)):
                wrong.append(f"{target} is linked in {page}, but not there")
    if wrong:
        sys.exit("\n".join(wrong))


main(*sys.argv[1:])
