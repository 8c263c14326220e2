# SPDX-License-Identifier: AGPL-3.0-or-later
"""The samples are what their script makes, byte by byte, and every one has its line in the README."""

import filecmp
import os
import subprocess
import sys
import tempfile

ROOT = os.path.abspath(os.environ.get("GEOMEND_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", "..")))
SAMPLES = os.path.join(ROOT, "samples")
SCRIPT = "make_samples.py"

kept = sorted(name for name in os.listdir(SAMPLES) if name not in (SCRIPT, "README.md", "__pycache__"))
with tempfile.TemporaryDirectory() as made:
    subprocess.run([sys.executable, "-B", os.path.join(SAMPLES, SCRIPT), made], check=True)
    wrong = [f"{name} is not what the script makes" for name in sorted(set(kept) | set(os.listdir(made)))
             if not (os.path.isfile(os.path.join(made, name)) and os.path.isfile(os.path.join(SAMPLES, name))
                     and filecmp.cmp(os.path.join(made, name), os.path.join(SAMPLES, name), shallow=False))]
with open(os.path.join(SAMPLES, "README.md"), encoding="utf-8") as file:
    readme = file.read()
wrong += [f"{name} has no line in samples/README.md" for name in kept if f"`{name}`" not in readme]
if not kept or wrong:
    sys.exit("\n".join(wrong) or "no samples")
print(f"{len(kept)} samples")
