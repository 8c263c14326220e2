# SPDX-License-Identifier: AGPL-3.0-or-later
"""A room may include only what the table of rooms lets it use; no header shows VTK, CGAL or TetGen."""

import os
import re
import sys
import tempfile
import unittest

import tree

ROOT = os.path.abspath(os.environ.get("GEOMEND_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", "..")))

# The rooms, ground floor first, and the rooms whose use is granted directly; what those may use comes with it.
USES = {
    "base": (),
    "model": ("base",),
    "geometry": ("model",),
    "formats": ("model",),
    "report": ("model",),
    "grid": ("geometry",),
    "arrangement": ("geometry",),
    "topology": ("grid",),
    "editing": ("geometry",),
    "exchange": ("topology",),
    "complexity": ("topology",),
    "validators": ("topology",),
    "repair": ("validators", "arrangement", "editing", "exchange"),
    "remesh": ("validators", "editing", "exchange"),
    "volume": ("repair", "remesh"),
    "gridding": ("repair",),
    "hexes": ("volume", "gridding"),
    "drawing": ("gridding", "report"),
    "pipeline": ("formats", "report", "hexes", "complexity"),
    "cli": ("pipeline", "drawing"),
}
FAMILIES = ("gocad", "vtk", "gmsh", "horizon", "grdecl", "eclipse", "roff", "surfaces", "resqml")
HIDDEN = re.compile(r"^(vtk\w*\.h|CGAL/.*|tetgen\.h|gmp\w*\.h|mpfr\.h)$")
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)


def allowed(room):
    """A room itself and every room below it that it may use."""
    rooms = {room}
    for used in USES[room]:
        rooms |= allowed(used)
    return rooms


def room_of(path):
    """The room of a source file, or None for what is in no room (tests, benchmarks)."""
    parts = path.split("/")
    if parts[0] == "src" and len(parts) > 2:
        return parts[1]
    return parts[0] if parts[0] in ("formats", "validators") else None


def family_of(path):
    """The family of formats that a file below formats/ belongs to, or None."""
    parts = path.split("/")
    return parts[1] if parts[0] == "formats" and len(parts) > 2 and parts[1] in FAMILIES else None


def offences(root):
    """One line for each include that breaks the order."""
    found = []
    for path in tree.sources(root):
        room = room_of(path)
        if room is None:
            continue
        if room not in USES:
            found.append(f"{path}: src/{room} is not in the table of rooms")
            continue
        text = tree.text(root, path)
        for match in INCLUDE.finditer(text):
            quote, name = match.groups()
            where = f"{path}:{text.count(chr(10), 0, match.start()) + 1}"
            target = name.split("/")[0]
            if path.endswith(".h") and HIDDEN.match(name):
                found.append(f"{where}: a header shows {name} to whoever includes it")
            if target in USES and target not in allowed(room):
                found.append(f"{where}: {room} may not use {target} ({name})")
            if target in USES and quote == "<":
                found.append(f"{where}: our own header {name} stands between angle brackets")
            if quote == '"' and target not in USES:
                found.append(f"{where}: {name} is not written from the root of its room")
            own, other = family_of(path), family_of(name)
            if own and (other not in (None, own) or name == "formats/registry.h"):
                found.append(f"{where}: the formats of {own} may not use {name}")
            if room != "cli" and target == "cli":
                found.append(f"{where}: nothing may use the command line")
    return found


class IncludeOrder(unittest.TestCase):
    def test_no_room_uses_a_room_above_it(self):
        found = offences(ROOT)
        if found:
            self.fail("\n" + "\n".join(found))

    def test_every_room_was_seen(self):
        rooms = {room_of(path) for path in tree.sources(ROOT)}
        self.assertLessEqual({"base", "model", "geometry", "formats", "topology", "pipeline", "cli"}, rooms)

    def test_an_include_upwards_is_told_with_its_line(self):
        with tempfile.TemporaryDirectory() as root:
            tree.write(root, "src/base/a.cpp", '#include <vector>\n#include "base/a.h"\n\n#  include "model/b.h"\n')
            tree.write(root, "src/model/b.h", '#include <vtkCell.h>\n#include "base/a.h"\n')
            tree.write(root, "formats/vtk/c.cpp", '#include <vtkCell.h>\n#include "formats/gocad/d.h"\n#include "c.h"\n')
            tree.write(root, "src/topology/e.cpp", '#include "formats/format.h"\n#include "grid/f.h"\n#include <base/a.h>\n')
            tree.write(root, "src/cellar/g.cpp", "")
            self.assertEqual([line.split(": ")[0] for line in offences(root)], [
                "formats/vtk/c.cpp:2", "formats/vtk/c.cpp:3", "src/base/a.cpp:4", "src/cellar/g.cpp", "src/model/b.h:1",
                "src/topology/e.cpp:1", "src/topology/e.cpp:3"])


if __name__ == "__main__":
    sys.exit(unittest.main())
