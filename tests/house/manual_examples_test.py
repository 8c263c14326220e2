# SPDX-License-Identifier: AGPL-3.0-or-later
"""Runs the examples of the manual pages in a copy of samples/, and holds each exit status against the stated one.

An example is a line that begins with a tab and `$ geomend`; `# exit N` at its end states a status other than 0.

usage: manual_examples_test.py PROGRAM
"""

import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.abspath(os.environ.get("GEOMEND_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", "..")))
EXAMPLE = re.compile(r"^\t\$ (geomend\b.*?)(?:\s+# exit (\d+))?$", re.MULTILINE)


def run_page(page, program):
    """Runs the examples of one page in their order; returns how many there are and what went wrong."""
    with open(page, encoding="utf-8") as file:
        examples = EXAMPLE.findall(file.read())
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        work, bin_folder = os.path.join(folder, "samples"), os.path.join(folder, "bin")
        shutil.copytree(os.path.join(ROOT, "samples"), work)
        os.mkdir(bin_folder)
        os.symlink(program, os.path.join(bin_folder, "geomend"))
        environment = {**os.environ, "PATH": bin_folder + os.pathsep + os.environ["PATH"]}
        for command, stated in examples:
            done = subprocess.run(["bash", "-c", command], cwd=work, env=environment, stdin=subprocess.DEVNULL,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, errors="replace")
            if done.returncode != int(stated or 0):
                wrong.append(f"{os.path.basename(page)}: {command}\n  exit status {done.returncode}, stated {stated or 0}\n"
                             f"  {done.stderr.strip()[:2000]}")
    return len(examples), wrong


def main(program):
    program = os.path.abspath(program)
    pages = sorted(glob.glob(os.path.join(ROOT, "man", "*.scd")))
    count, wrong = 0, []
    for page in pages:
        found, failures = run_page(page, program)
        if found == 0:
            wrong.append(f"{os.path.basename(page)}: no example")
        count += found
        wrong += failures
    print(f"{count} examples on {len(pages)} pages")
    if not pages or wrong:
        sys.exit("\n".join(wrong) or "no pages")


main(*sys.argv[1:])
