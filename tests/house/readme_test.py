# SPDX-License-Identifier: AGPL-3.0-or-later
"""The table of formats in docs/formats.md says what the program says; pictures and links of it and of the README are there, and the
commands of the README run as they stand in samples/.

usage: readme_test.py PROGRAM            compares
       readme_test.py PROGRAM --print    prints the table as it should be
"""

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

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


def untrue_commands(program, text):
    """Commands of the README that do not run as they stand in samples/, in their order, each with what came of it."""
    wrong = []
    with tempfile.TemporaryDirectory() as parent:
        folder = os.path.join(parent, "samples")
        shutil.copytree(os.path.join(ROOT, "samples"), folder)
        for line in re.findall(r"^    geomend (.*)$", text, re.MULTILINE):
            words = shlex.split(line, comments=True)
            done = subprocess.run([program, *words], cwd=folder, capture_output=True, text=True, check=False, timeout=300)
            wanted = (0, 1) if words[0] == "validate" else (4,) if f"geomend: {words[-1]}: STL cannot hold" in text else (0,)
            if done.returncode not in wanted:
                wrong.append(f"geomend {line}\n  ends with {done.returncode}: {done.stderr}")
    return wrong


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
        if page == "README.md":
            wrong += untrue_commands(program, text)
        elif wanted not in text:
            wrong.append(f"the table of {page} should be:\n{wanted}")
        for target in re.findall(r"\]\(([^)#]+)\)", text):
            if "://" not in target and not os.path.exists(os.path.join(os.path.dirname(path), target)):
                wrong.append(f"{target} is linked in {page}, but not there")
    if wrong:
        sys.exit("\n".join(wrong))


main(*sys.argv[1:])
