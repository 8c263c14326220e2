#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""Editors on Windows put a byte order mark before text, and old programs the end mark of DOS behind it: each file of text that is
read is read with them as well, and is told to be the same. Where a simulator stops at the mark, that is reported.
    byte_order_mark_test.py PROGRAM
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.abspath(sys.argv.pop(1))
SOURCE = os.environ["GEOMEND_SOURCE_DIR"]
MARK = b"\xef\xbb\xbf"
EXTENSIONS = {"zmap_lines": ".zmap", "ijxyz": ".ijxyz", "rms_well": ".w"}


def texts():
    """Path and bytes of the seeds of all readers that are text."""
    for folder, folders, files in os.walk(os.path.join(SOURCE, "tests/fuzz/corpus")):
        if os.path.basename(folder) == "whole_path":
            continue
        for name in sorted(files):
            with open(os.path.join(folder, name), "rb") as file:
                content = file.read()
            try:
                content.decode("utf-8")
            except UnicodeDecodeError:
                continue
            if b"\0" not in content and not content.startswith(MARK):
                yield os.path.join(os.path.basename(folder), name), content


def told(path):
    """What info says of a file, but for its name, its size and the remark that a simulator stops at the mark; None where it
    cannot be read."""
    run = subprocess.run([PROGRAM, "info", "--json", path], capture_output=True, text=True)
    if run.returncode != 0:
        return None
    whole = json.loads(run.stdout)
    return clean(whole, os.path.dirname(path))


def clean(value, folder):
    if isinstance(value, dict):
        return {key: clean(part, folder) for key, part in value.items() if key not in ("bytes", "size", "offset", "column")}
    if isinstance(value, list):
        return [clean(part, folder) for part in value if "byte-order mark" not in json.dumps(part)]
    return value.replace(folder, "") if isinstance(value, str) else value


class Marks(unittest.TestCase):
    def test_text_is_read_behind_a_mark(self):
        self.compare(MARK, b"")

    def test_what_stands_behind_the_end_mark_of_dos_is_no_part_of_a_text(self):
        for end in (b"\x1a", b"\x1a\r\n", b"\x1a\0\0"):
            self.compare(b"", end)

    def compare(self, start, end):
        compared = 0
        for number, (name, content) in enumerate(texts()):
            with self.subTest(name), tempfile.TemporaryDirectory() as plain, tempfile.TemporaryDirectory() as marked:
                base = os.path.basename(name)
                base += EXTENSIONS.get(base, "")
                for folder, whole in ((plain, content), (marked, start + content + end)):
                    with open(os.path.join(folder, base), "wb") as file:
                        file.write(whole)
                expected = told(os.path.join(plain, base))
                if expected is None:
                    continue
                compared += 1
                self.assertEqual(told(os.path.join(marked, base)), expected)
        self.assertGreater(compared, 25)


if __name__ == "__main__":
    unittest.main()
