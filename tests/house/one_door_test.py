# SPDX-License-Identifier: AGPL-3.0-or-later
"""What a reader leaves out of a file goes through formats/drop.h, which fills the list of losses: nowhere else may a reader do it."""

import os
import re
import tempfile
import unittest

import tree

ROOT = os.path.abspath(os.environ.get("GEOMEND_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", "..")))

DOOR = "formats/drop.h"
# Writers list what their format cannot hold; these files hold such lists of writers beside parts of readers, or only those.
WRITERS = re.compile(r"/(write_|legacy_write|xml_write|[a-z0-9_]*_writ|[a-z0-9_]*_out\.|losses\.|solid_plan|combine|point_table)")
BOTH = {
    "formats/eclipse/kept_arrays.cpp",
    "formats/gmsh/geomend_section.cpp",
    "formats/gocad/model3d_write.cpp",
    "formats/grdecl/kept_text.cpp",
    "formats/gocad/object_head.cpp",
    "formats/gocad/property_lists.cpp",
    "formats/horizon/irap_points.cpp",
    "formats/horizon/lines_formats.cpp",
    "formats/horizon/petrel_points.cpp",
    "formats/horizon/zmap.cpp",
    "formats/surfaces/off.cpp",
    "formats/surfaces/stl.cpp",
    "formats/vtk/vtk_merge.cpp",
}
LISTS = re.compile(r"\badd_loss\((?!\s*data\.losses, std::move\(loss\)\))|losses_?\.(?:push_back|emplace_back)\(")
SAYS_DROPPED = re.compile(r'"F107"|"F150"')
DOOR_CALL = re.compile(r'(\bdrop\(|\.code = )\s*"F1(07|50)"')


def wrong_places(root):
    """Every line of a reader that leaves something out beside the door."""
    found = []
    for path in tree.sources(root):
        if not path.startswith("formats/") or path == DOOR:
            continue
        for number, line in enumerate(tree.text(root, path).split("\n"), 1):
            if LISTS.search(line) and not WRITERS.search(path) and path not in BOTH:
                found.append(f"{path}:{number}: lists a loss beside {DOOR}")
            if SAYS_DROPPED.search(line) and not DOOR_CALL.search(line):
                found.append(f"{path}:{number}: reports what is not read beside {DOOR}")
    return found


class OneDoor(unittest.TestCase):
    def test_readers_leave_things_out_through_it_only(self):
        self.assertEqual(wrong_places(ROOT), [])

    def test_what_goes_around_it_is_found(self):
        with tempfile.TemporaryDirectory() as root:
            tree.write(root, "formats/x/read_x.cpp", 'add_loss(losses, {});\nr.losses.push_back({});\nlog.add("F107", 1);\n')
            tree.write(root, "formats/x/write_x.cpp", "add_loss(losses, {});\n")
            tree.write(root, "formats/x/good.cpp", 'log.drop("F107", c);\n{.code = "F107"}\n')
            self.assertEqual(len(wrong_places(root)), 3)


if __name__ == "__main__":
    unittest.main()
