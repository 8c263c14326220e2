# SPDX-License-Identifier: AGPL-3.0-or-later
"""The files of the source tree, for the tests that keep the house in order."""

import os

FOLDERS = ("src", "formats", "validators", "tests", "bench", "man", "scripts", "samples", "cmake", ".ci", "docs")
SOURCE_ENDINGS = (".h", ".cpp")
DATA_FOLDERS = ("tests/fuzz/corpus/",)


def files(root):
    """Every file of the project as a path relative to root with forward slashes, sorted. No build folders."""
    # In a second working tree .git is a file that tells where the first one is.
    found = [name for name in os.listdir(root) if name != ".git" and os.path.isfile(os.path.join(root, name))]
    for folder in FOLDERS:
        for place, folders, names in os.walk(os.path.join(root, folder)):
            folders[:] = [name for name in folders if name not in ("__pycache__", "node_modules")]
            found += [os.path.relpath(os.path.join(place, name), root) for name in names]
    return sorted(path.replace(os.sep, "/") for path in found)


def sources(root):
    """The C++ files among them."""
    return [path for path in files(root) if path.endswith(SOURCE_ENDINGS)]


def text(root, path):
    """The text of one file, or None where it is no text."""
    with open(os.path.join(root, path), "rb") as file:
        data = file.read()
    try:
        return None if b"\0" in data else data.decode("utf-8")
    except UnicodeDecodeError:
        return None


def write(root, path, content):
    """Writes one file of a made-up tree, with its folders."""
    place = os.path.join(root, path)
    os.makedirs(os.path.dirname(place), exist_ok=True)
    with open(place, "w", encoding="utf-8") as file:
        file.write(content)
