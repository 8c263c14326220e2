# SPDX-License-Identifier: AGPL-3.0-or-later
"""SARIF and JUnit reports, read by other readers than our own: what continuous integration servers take from them.

usage: report_readers_test.py PROGRAM

SARIF is held against the official schema, too, where GEOMEND_SARIF_SCHEMA names a file of it or npm can fetch a package that has it.
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tarfile
import tempfile
import urllib.parse
import xml.etree.ElementTree

ROOT = pathlib.Path(os.environ.get("GEOMEND_SOURCE_DIR", pathlib.Path(__file__).parents[2])).resolve()
SAMPLES = ROOT / "samples"
SCHEMA_PACKAGE, SCHEMA_IN_PACKAGE = "@microsoft/jest-sarif@1.0.0-beta.0", "package/lib/schemas/sarif-2.1.0-rtm.5.json"

wrong = []


def expect(holds, what):
    if not holds:
        wrong.append(what)


def run(program, folder, *arguments):
    """Exit status, SARIF and JUnit of a run of validate."""
    sarif, junit = pathlib.Path(folder, "r.sarif"), pathlib.Path(folder, "r.xml")
    done = subprocess.run([program, "validate", *arguments, "--report", sarif, "--report", junit, "--quiet"], cwd=folder,
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    return done.returncode, json.loads(sarif.read_text(encoding="utf-8")), xml.etree.ElementTree.parse(junit).getroot()


def check_sarif(name, status, log):
    expect(log["version"] == "2.1.0", f"{name}: version")
    (sarif_run,) = log["runs"]
    rules = sarif_run["tool"]["driver"]["rules"]
    expect(len({rule["id"] for rule in rules}) == len(rules), f"{name}: a rule is there twice")
    for rule in rules:
        expect(rule["shortDescription"]["text"] and rule["help"]["text"], f"{name}: {rule['id']} has no help")
    (invocation,) = sarif_run["invocations"]
    expect(invocation["exitCode"] == status, f"{name}: exit code {invocation['exitCode']}, not {status}")
    expect(invocation["executionSuccessful"] == (not invocation["toolExecutionNotifications"]), f"{name}: success and notifications")
    prints = []
    for result in sarif_run["results"]:
        what = f"{name}: {result['ruleId']} {result['message']['text']}"
        expect(rules[result["ruleIndex"]]["id"] == result["ruleId"], f"{what}: rule")
        expect(result["level"] in ("error", "warning", "note"), f"{what}: level")
        (location,) = result["locations"]
        uri = location["physicalLocation"]["artifactLocation"]["uri"]
        expect(uri.isascii() and not set(uri) & set(' #<>"{}|\\^`'), f"{what}: {uri} is no URI")
        region = location["physicalLocation"].get("region", {})
        expect(region.get("startLine", 1) >= 1 and region.get("byteOffset", 0) >= 0, f"{what}: {region}")
        expect(len(location.get("logicalLocations", [])) <= 1, f"{what}: where is it?")
        prints.append((result["ruleId"], result["partialFingerprints"]["codeEntitiesPlace/v1"]))
    return sarif_run["results"], prints


def check_junit(name, suites):
    for suite in suites:
        cases = suite.findall("testcase")
        names = [(case.get("classname"), case.get("name")) for case in cases]
        expect(len(set(names)) == len(names), f"{name}: names of cases are there twice")
        for attribute, tag in (("failures", "failure"), ("errors", "error"), ("skipped", "skipped")):
            number = len([case for case in cases if case.find(tag) is not None])
            expect(int(suite.get(attribute)) == number, f"{name}: {suite.get(attribute)} {attribute}, {number} cases")
        expect(int(suite.get("tests")) == len(cases), f"{name}: tests")
        for case in cases:
            for body in [case.find(tag) for tag in ("failure", "error")]:
                if body is None:
                    continue
                expect(body.get("message") and body.get("type"), f"{name}: {case.get('name')} has no message")
                text = body.text or ""
                expect(body.get("message").split(":")[0] in text, f"{name}: {case.get('name')}: the body does not say it")
                expect("{" not in text and '": ' not in text, f"{name}: {case.get('name')}: a body of JSON")


def official_schema(folder):
    """The schema, or None and why."""
    named = os.environ.get("GEOMEND_SARIF_SCHEMA")
    if named:
        return json.loads(pathlib.Path(named).read_text(encoding="utf-8")), ""
    try:
        packed = subprocess.run(["npm", "pack", SCHEMA_PACKAGE], cwd=folder, capture_output=True, text=True, timeout=60, check=True)
        with tarfile.open(pathlib.Path(folder, packed.stdout.split()[-1])) as package:
            return json.load(package.extractfile(SCHEMA_IN_PACKAGE)), ""
    except (OSError, subprocess.SubprocessError, KeyError, IndexError) as why:
        return None, f"npm has no {SCHEMA_PACKAGE}: {why}"


def check_schema(logs, folder):
    try:
        import jsonschema  # pylint: disable=import-outside-toplevel
    except ImportError:
        return "there is no jsonschema for Python"
    schema, why = official_schema(folder)
    if schema is None:
        return why
    schema.pop("$id", None)
    validator = jsonschema.validators.validator_for(schema)(schema)
    for name, log in logs.items():
        for error in validator.iter_errors(log):
            wrong.append(f"{name}: against the schema: {'/'.join(map(str, error.absolute_path))}: {error.message[:200]}")
    return ""


def main(program):
    with tempfile.TemporaryDirectory() as folder:
        logs = {}
        odd = pathlib.Path(folder, "a b#c%20d")
        odd.mkdir()
        shutil.copy(SAMPLES / "layered_box_gap.ml", odd / "mödel <1>.ml")
        shutil.copy(SAMPLES / "layered_box.ml", pathlib.Path(folder, "sound.ml"))
        text = (SAMPLES / "layered_box.ml").read_text(encoding="utf-8")
        pathlib.Path(folder, "cut.ml").write_text(text[:len(text) // 2], encoding="utf-8")
        binary = b"# vtk DataFile Version 3.0\ncut\nBINARY\nDATASET POLYDATA\nPOINTS 1000 double\n" + bytes(100)
        pathlib.Path(folder, "cut.vtk").write_bytes(binary)
        wanted = {"gap": ["a b#c%20d/mödel <1>.ml"], "sound": ["sound.ml"], "cut": ["cut.ml"], "binary": ["cut.vtk"],
                  "all": ["sound.ml", "cut.ml", "cut.vtk", "a b#c%20d/mödel <1>.ml"], "never": ["a b#c%20d/mödel <1>.ml", "--fail-on", "never"]}
        results = {}
        for name, arguments in wanted.items():
            status, logs[name], junit = run(program, folder, *arguments)
            results[name], prints = check_sarif(name, status, logs[name])
            check_junit(name, junit)
            expect(check_sarif(name, status, run(program, folder, *arguments)[1])[1] == prints, f"{name}: fingerprints change")
        uri = results["gap"][0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
        expect(urllib.parse.unquote(uri) == "a b#c%20d/mödel <1>.ml", f"{uri} is not the file")
        first = results["cut"][0]["locations"][0]["physicalLocation"]
        expect(first["region"]["startLine"] > 1, f"the end of the file has no line: {first}")
        # One at least for each file that cannot be read.
        for name, notes in {"gap": 0, "cut": 1, "binary": 1, "all": 2}.items():
            number = len(logs[name]["runs"][0]["invocations"][0]["toolExecutionNotifications"])
            expect(number >= notes and (number > 0) == (notes > 0), f"{name}: {number} notifications")
        skipped = check_schema(logs, folder)
    if wrong:
        sys.exit("\n".join(wrong))
    print(skipped or "the official schema of SARIF holds")


main(*sys.argv[1:])
