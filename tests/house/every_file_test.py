# SPDX-License-Identifier: AGPL-3.0-or-later
"""What every file of the tree has and has not: a licence line, no place of one machine, no unbounded length."""

import os
import re
import sys
import tempfile
import unittest

import tree

ROOT = os.path.abspath(os.environ.get("GEOMEND_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", "..")))

SPDX = "SPDX-License-Identifier: " + "AGPL-3.0-or-later"
PROGRAM_TEXT = (".h", ".cpp", ".cmake", ".py", ".sh", ".scd", "CMakeLists.txt")
# Put together here, so that this file does not name them itself.
MACHINE_PLACES = re.compile(r"(?<![\w.)}/])/" + r"(work|home|root|tmp|mnt|Users)/")
LONGEST_SOURCE = 700
# The maker of findings, which looks into the catalogue, and the reader of reports, which takes what stands there.
SEVERITY_MAKERS = ("src/base/finding.h", "src/base/result.cpp", "src/report/report_reading.cpp")
SEVERITY_SET = re.compile(r"\bseverity\s*=(?!=)")


def is_program_text(path):
    if path.startswith(tree.DATA_FOLDERS) or path.endswith(".md"):
        return False
    return path.endswith(PROGRAM_TEXT) or path.startswith((".ci/", "scripts/"))


def without_licence(root):
    """Files of program text whose first three lines lack the licence line."""
    return [path for path in tree.files(root)
            if is_program_text(path) and SPDX not in "\n".join((tree.text(root, path) or "").split("\n")[:3])]


def machine_places(root):
    """file:line of each path that only exists on somebody's machine."""
    found = []
    for path in tree.files(root):
        if path == "LICENSE" or path.startswith(tree.DATA_FOLDERS):
            continue
        for number, line in enumerate((tree.text(root, path) or "").split("\n"), 1):
            if MACHINE_PLACES.search(line):
                found.append(f"{path}:{number}: {line.strip()}")
    return found


def too_long(root):
    """Source files beyond the length that one can keep in mind."""
    counted = [(path, (tree.text(root, path) or "").count("\n")) for path in tree.sources(root)]
    return [f"{path}: {count} lines" for path, count in counted if count > LONGEST_SOURCE]


def severities_set(root):
    """file:line of each place in the product that gives a finding a severity beside the catalogue."""
    found = []
    for path in tree.sources(root):
        if not path.startswith(("src/", "formats/", "validators/")) or path in SEVERITY_MAKERS:
            continue
        for number, line in enumerate((tree.text(root, path) or "").split("\n"), 1):
            if SEVERITY_SET.search(line) and not re.search(r"\bauto severity =", line):
                found.append(f"{path}:{number}: {line.strip()}")
    return found


class EveryFile(unittest.TestCase):
    def assertNone(self, found):
        if found:
            self.fail("\n" + "\n".join(found))

    def test_program_text_names_its_licence(self):
        self.assertNone(without_licence(ROOT))

    def test_no_file_names_a_place_on_one_machine(self):
        self.assertNone(machine_places(ROOT))

    def test_no_source_file_is_longer_than_700_lines(self):
        self.assertNone(too_long(ROOT))

    def test_severities_come_from_the_catalogue(self):
        self.assertNone(severities_set(ROOT))

    def test_every_room_says_what_it_is(self):
        rooms = {"/".join(path.split("/")[:-1]) for path in tree.sources(ROOT) if path.startswith(("src/", "formats/"))}
        rooms |= {"samples", "validators", "tests", "bench", "man", "scripts"}
        self.assertNone([room for room in sorted(rooms) if not os.path.isfile(os.path.join(ROOT, room, "README.md"))])

    def test_offences_are_found(self):
        with tempfile.TemporaryDirectory() as root:
            tree.write(root, "src/base/a.cpp", "// nothing\n" * 701)
            tree.write(root, "src/base/b.h", "// " + SPDX + "\n// see /" + "home/somebody/b.txt\n")
            tree.write(root, "scripts/c", "#!/bin/sh\n# " + SPDX + "\nls $folder/tmp/ ../work/ x/work/y\n")
            tree.write(root, "validators/d.cpp", "// " + SPDX + "\n    f.severity = Severity::info;\n    if (f.severity == x)\n")
            self.assertEqual(severities_set(root), ["validators/d.cpp:2: f.severity = Severity::info;"])
            self.assertEqual(without_licence(root), ["src/base/a.cpp"])
            self.assertEqual([line.split(": ")[0] for line in machine_places(root)], ["src/base/b.h:2"])
            self.assertEqual(too_long(root), ["src/base/a.cpp: 701 lines"])


if __name__ == "__main__":
    sys.exit(unittest.main())
