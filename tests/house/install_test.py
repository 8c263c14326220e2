# SPDX-License-Identifier: AGPL-3.0-or-later
"""Installs the library into an empty folder; a project outside, which knows only that folder, reads a sample with it.

usage: install_test.py BUILD_FOLDER CMAKE CXX_COMPILER
"""

import os
import re
import subprocess
import sys
import tempfile

ROOT = os.path.abspath(os.environ.get("GEOMEND_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", "..")))
SHOWN = re.compile(r'#\s*include\s*[<"](vtk|CGAL/|tetgen)')

def run(*command):
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if result.returncode:
        sys.exit(f"{' '.join(command)}\n{result.stdout}\nexit status {result.returncode}")
    return result.stdout


def main(build, cmake, compiler):
    with tempfile.TemporaryDirectory() as folder:
        prefix, outside = os.path.join(folder, "prefix"), os.path.join(folder, "outside")
        run(cmake, "--install", build, "--prefix", prefix)
        check_headers(os.path.join(prefix, "include", "geomend"))
        run(cmake, "-S", os.path.join(ROOT, "tests", "house", "outside"), "-B", outside, f"-DCMAKE_PREFIX_PATH={prefix}",
            f"-DCMAKE_CXX_COMPILER={compiler}", "-DCMAKE_BUILD_TYPE=Release")
        run(cmake, "--build", outside)
        seen = run(os.path.join(outside, "outside"), os.path.join(ROOT, "samples", "layered_box.ml"))
        if seen != "gocad: 9 objects, 31 surfaces, 6 regions\n":
            sys.exit(f"the outside project saw {seen!r} in layered_box.ml")
        version = run(os.path.join(prefix, "bin", "geomend"), "--version")
        if not version.startswith("geomend "):
            sys.exit(f"the installed program calls itself {version!r}")


def check_headers(folder):
    """Installed headers: there, complete, and free of the libraries behind them."""
    headers = [path for path in (os.path.join(place, name) for place, _, names in os.walk(folder) for name in names)]
    if not any(path.endswith(os.path.join("formats", "registry.h")) for path in headers):
        sys.exit(f"formats/registry.h was not installed into {folder}")
    for path in headers:
        with open(path, encoding="utf-8") as file:
            if SHOWN.search(file.read()):
                sys.exit(f"the installed header {os.path.relpath(path, folder)} shows a library that stays inside")


main(*sys.argv[1:])
