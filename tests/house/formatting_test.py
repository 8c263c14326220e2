# SPDX-License-Identifier: AGPL-3.0-or-later
"""Every C++ file is as clang-format leaves it. Skipped where the version that the settings were made for is missing."""

import os
import shutil
import subprocess
import sys

import tree

ROOT = os.path.abspath(os.environ.get("GEOMEND_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", "..")))
SKIPPED = 77

program = shutil.which("clang-format-14")
if program is None:
    print("skipped: clang-format-14 is not installed")
    sys.exit(SKIPPED)

result = subprocess.run([program, "--dry-run", "-Werror", "--ferror-limit=1", *tree.sources(ROOT)], cwd=ROOT,
                        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
print(result.stdout)
sys.exit(1 if result.returncode else 0)
