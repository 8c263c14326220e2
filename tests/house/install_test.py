# SPDX-License-Identifier: AGPL-3.0-or-later
"""Installs the library into an empty folder. A project outside, which knows only that folder, reads, validates and repairs samples
with it, and each installed header compiles alone.

usage: install_test.py BUILD_FOLDER CMAKE CXX_COMPILER
"""

import concurrent.futures
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
        program = os.path.join(outside, "outside")
        expect(run(program, "info", os.path.join(ROOT, "samples", "layered_box.ml")), "gocad: 9 objects, 31 surfaces, 6 regions\n")
        expect(run(program, "validate", os.path.join(ROOT, "samples", "layered_box.ml")), "valid\n")
        mended = os.path.join(folder, "mended.grdecl")
        expect(run(program, "repair", os.path.join(ROOT, "samples", "faulted_grid.grdecl"), mended), "3 steps, written\n")
        expect(run(program, "validate", mended), "valid\n")
        version = run(os.path.join(prefix, "bin", "geomend"), "--version")
        if not version.startswith("geomend "):
            sys.exit(f"the installed program calls itself {version!r}")
        compile_headers(compiler, prefix)


def expect(seen, wanted):
    if seen != wanted:
        sys.exit(f"the outside project printed {seen!r}, not {wanted!r}")


def compile_alone(compiler, prefix, header):
    """What the compiler has to say of a file that includes nothing but this header, as users name it."""
    include = os.path.join(prefix, "include")
    command = [compiler, "-std=c++20", "-fsyntax-only", "-x", "c++", "-I", include, "-I", os.path.join(include, "geomend"), "-"]
    source = f'#include "geomend/{header}"\n'
    result = subprocess.run(command, input=source, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return f"{header} does not compile alone:\n{result.stdout}" if result.returncode else ""


def compile_headers(compiler, prefix):
    top = os.path.join(prefix, "include", "geomend")
    headers = [os.path.relpath(os.path.join(place, name), top) for place, _, names in os.walk(top) for name in names]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        wrong = [text for text in pool.map(lambda header: compile_alone(compiler, prefix, header), sorted(headers)) if text]
    if wrong:
        sys.exit("\n".join(wrong))


def check_headers(folder):
    """Installed headers: there, complete, and free of the libraries behind them."""
    headers = [path for path in (os.path.join(place, name) for place, _, names in os.walk(folder) for name in names)]
    for wanted in ("formats/registry.h", "validators/registry.h", "pipeline/repair.h"):
        if os.path.join(folder, wanted) not in headers:
            sys.exit(f"{wanted} was not installed into {folder}")
    for path in headers:
        with open(path, encoding="utf-8") as file:
            if SHOWN.search(file.read()):
                sys.exit(f"the installed header {os.path.relpath(path, folder)} shows a library that stays inside")


main(*sys.argv[1:])
