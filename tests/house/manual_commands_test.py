# SPDX-License-Identifier: AGPL-3.0-or-later
"""What --help says and what the manual says agree: commands, options of each command, and exit statuses.

usage: manual_commands_test.py PROGRAM
"""

import os
import re
import subprocess
import sys

ROOT = os.path.abspath(os.environ.get("GEOMEND_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", "..")))
# Commands without a page of their own: geomend(1) describes them whole.
WITHOUT_PAGE = {"completion"}

wrong = []


def page(name):
    with open(os.path.join(ROOT, "man", f"{name}.1.scd"), encoding="utf-8") as file:
        return file.read()


def section(text, title):
    match = re.search(rf"^# {title}\n(.*?)(?=^# |\Z)", text, re.M | re.S)
    return match.group(1) if match else ""


def heads(text):
    """Lines that open an entry of a list."""
    return [line for line in text.splitlines() if line.startswith("*")]


def options_in(lines):
    """Long and short options that begin entries: *-o*, *--output* _OUT_."""
    return {option for line in lines for option in re.findall(r"\*(-{1,2}[A-Za-z][a-z-]*)\*", line)}


def options_of_help(text):
    return {option for line in re.findall(r"^  (-\S+)", text, re.M) for option in line.split(",")}


def compare(what, in_program, in_manual):
    for missing in sorted(in_program - in_manual):
        wrong.append(f"{what}: the manual lacks {missing}")
    for extra in sorted(in_manual - in_program):
        wrong.append(f"{what}: the manual has {extra}, which is not there")


def main(program):
    def help_of(*command):
        return subprocess.run([program, *command, "--help"], check=True, stdout=subprocess.PIPE, text=True).stdout

    whole, manual = help_of(), page("geomend")
    commands = set(re.findall(r"^  ([a-z]+)  ", whole.split("Subcommands:")[1], re.M))
    compare("SYNOPSIS of geomend(1)", commands, set(re.findall(r"^\*geomend\* \*([a-z]+)\*", section(manual, "SYNOPSIS"), re.M)))
    compare("DESCRIPTION of geomend(1)", commands, set(re.findall(r"^\*([a-z]+)\*$", section(manual, "DESCRIPTION"), re.M)))
    seen = set(re.findall(r"\*geomend-([a-z]+)\*\(1\)", section(manual, "SEE ALSO")))
    compare("SEE ALSO of geomend(1)", commands - WITHOUT_PAGE, seen)
    pages = {name for name in re.findall(r"geomend-([a-z]+)\.5\.scd", " ".join(os.listdir(os.path.join(ROOT, "man"))))}
    compare("SEE ALSO of geomend(1)", pages, set(re.findall(r"\*geomend-([a-z]+)\*\(5\)", section(manual, "SEE ALSO"))))

    common = options_in(heads(section(manual, "COMMON OPTIONS")))
    for command in sorted(commands - WITHOUT_PAGE):
        text = page(f"geomend-{command}")
        own = options_in(heads(section(text, "OPTIONS")))
        takes_common = "those of *geomend*(1)" in section(text, "OPTIONS")
        offered = options_of_help(help_of(command))
        if takes_common:  # the page has those that are its own, geomend(1) the others
            compare(f"geomend-{command}(1)", offered - common, own - common)
        else:
            compare(f"geomend-{command}(1)", offered - {"-h", "--help"}, own)

    with open(os.path.join(ROOT, "src", "cli", "exit_status.h"), encoding="utf-8") as file:
        statuses = set(re.findall(r"^    [a-z_]+ = (\d+)", file.read(), re.M))
    compare("EXIT STATUS of geomend(1)", statuses, set(re.findall(r"^\*(\d+)\*$", section(manual, "EXIT STATUS"), re.M)))
    line = re.search(r"Exit status: (.*)\. See", whole.replace("\n", " ")).group(1)
    compare("the last lines of --help", statuses, set(re.findall(r"(?:^|, )(\d+) ", line)))
    if wrong:
        sys.exit("\n".join(wrong))
    print(f"{len(commands)} commands, {len(statuses)} exit statuses")


main(*sys.argv[1:])
