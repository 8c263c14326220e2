# SPDX-License-Identifier: AGPL-3.0-or-later
"""The HTML report opened and clicked through in a headless browser: html_page_test.py GEOMEND. Skipped (77) without one."""

import json
import os
import subprocess
import sys
import tempfile
import unittest

import browser

PROGRAM = None
# A name that would do harm if it ever became markup; it is that of the file, and so that of the grid.
NAME = "<img src=x onerror=window.harmed=1>\"'&amp;"


def grid_text():
    """Three layers of 4 x 3 bricks: a throw between columns 2 and 3, one cell upside down, one that reaches into the next."""
    nx, ny, nz = 4, 3, 3
    pillars = "".join(f"{100 * i} {100 * j} 1000 {100 * i} {100 * j} 1200\n" for j in range(ny + 1) for i in range(nx + 1))
    depths = []
    for level in range(2 * nz):
        k, bottom = divmod(level, 2)
        for j in range(ny):
            for _ in range(2):
                for i in range(nx):
                    z = 1000 + 20 * (k + bottom) + (7 if i >= 2 else 0)
                    if (i, j, k) == (0, 0, 0) and bottom:
                        z -= 30  # its bottom above its top
                    if (i, j, k) == (3, 2, 0) and bottom:
                        z += 9  # into the cell below
                    depths += [z, z]
    return (f"SPECGRID\n {nx} {ny} {nz} 1 F /\nCOORD\n{pillars}/\nZCORN\n" + "\n".join(map(str, depths)) + "\n/\n")


def in_each_view(test):
    """The test once with vtk.js, where that is in the page, and once with the plain view."""
    def run(self):
        for kind in ("vtk", "plain") if self.has_vtk else ("plain",):
            with self.subTest(view=kind):
                self.open_in(kind)
                test(self)
    run.__name__ = test.__name__
    return run


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.grid = os.path.join(cls.folder.name, NAME + ".grdecl")
        with open(cls.grid, "w", encoding="utf-8") as file:
            file.write(grid_text())
        cls.page = cls.report("page.html", cls.grid)
        with open(cls.report("report.json", cls.grid), encoding="utf-8") as file:
            cls.findings = json.load(file)["files"][0]["findings"]
        with open(cls.page, encoding="utf-8") as file:
            cls.has_vtk = "GeomendVtkView=" in file.read()
        cls.browser = browser.Browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.folder.cleanup()

    @classmethod
    def report(cls, name, *files):
        path = os.path.join(cls.folder.name, name)
        subprocess.run([PROGRAM, "validate", "--quiet", "--fail-on", "never", "--report", path, *files], check=True, timeout=60)
        return path

    def rows(self):
        """Codes of the rows shown."""
        return self.browser.ask("[...document.querySelectorAll('#rows tr')].map((row) => row.children[1].textContent)")

    def chosen(self):
        return self.browser.ask("geomendReport.state.chosen && geomendReport.state.chosen.finding.code")

    def view_box(self):
        return self.browser.ask("(() => { const b = document.getElementById('view').getBoundingClientRect(); return [b.x, b.y, b.width, b.height]; })()")

    def settle(self):
        self.browser.wait("geomendReport.settled()")
        self.browser.ask("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(() => done(1)))))")

    def assertQuiet(self):
        self.assertEqual(self.browser.complaints, [])
        self.assertEqual([url for url in self.browser.requests if not url.startswith(("file://", "data:", "blob:"))], [])

    def open_in(self, kind):
        """Opens the page with one of the views that it has."""
        self.browser.open(self.page, "#plain" if kind == "plain" else "")
        self.assertEqual(self.browser.ask("geomendReport.view()"), kind)
        self.settle()

    @in_each_view
    def test_shows_every_finding_the_worst_first_and_asks_nobody(self):
        self.assertEqual(self.rows(), [f["code"] for f in self.findings])
        self.assertGreaterEqual(len(self.findings), 3)
        self.assertEqual(self.browser.ask("document.querySelector('#verdict .badge').textContent"), "not valid")
        self.assertQuiet()

    def test_text_of_files_does_no_harm(self):
        self.browser.open(self.page)
        self.assertIsNone(self.browser.ask("window.harmed"))
        self.assertEqual(self.browser.ask("document.images.length"), 0)
        self.assertIn(NAME, self.browser.ask("document.querySelector('#rows td.entity').textContent"))
        self.browser.click_on("#rows tr")
        self.assertIn(NAME, self.browser.ask("document.getElementById('detail').textContent"))
        self.assertEqual(self.browser.ask("document.images.length"), 0)
        self.assertQuiet()

    def test_filters_leave_what_they_say(self):
        b = self.browser
        b.open(self.page)
        codes = [f["code"] for f in self.findings]
        errors = [f["code"] for f in self.findings if f["severity"] == "error"]
        self.assertTrue(errors and len(errors) < len(codes))
        b.click_on("[data-severity=info]")
        b.click_on("[data-severity=warning]")
        self.assertEqual(self.rows(), errors)
        b.click_on("[data-severity=info]")
        b.click_on("[data-severity=warning]")
        self.assertEqual(self.rows(), codes)
        b.click_on("#text")
        b.type("C18 THROW")
        self.assertEqual(self.rows(), ["C18"])
        self.assertEqual(b.ask("document.getElementById('shown').textContent"), f"1 of {len(codes)} findings")
        b.type(" nowhere")
        self.assertEqual(self.rows(), [])
        self.assertTrue(b.ask("!document.getElementById('none').hidden"))
        b.ask("(() => { const t = document.getElementById('text'); t.value = ''; t.dispatchEvent(new Event('input')); })()")
        b.ask("(() => { const c = document.getElementById('code'); c.value = 'C18'; c.dispatchEvent(new Event('change')); })()")
        self.assertEqual(self.rows(), ["C18"])

    def test_heads_of_columns_sort(self):
        self.browser.open(self.page)
        self.browser.click_on("#columns th:nth-child(2) button")
        self.assertEqual(self.rows(), sorted(f["code"] for f in self.findings))
        self.browser.click_on("#columns th:nth-child(2) button")
        self.assertEqual(self.rows(), sorted((f["code"] for f in self.findings), reverse=True))

    @in_each_view
    def test_a_click_on_a_row_flies_to_its_mark_and_shows_its_text(self):
        x, y, width, height = self.view_box()
        number = next(i for i, f in enumerate(self.findings) if f["code"] == "C03")
        self.browser.click_on(f"#rows tr:nth-child({number + 1})")
        self.settle()
        self.assertEqual(self.chosen(), "C03")
        self.assertIn(self.findings[number]["fix"], self.browser.ask("document.getElementById('detail').textContent"))
        self.assertEqual(self.browser.ask("document.querySelector('#rows tr[aria-selected=true] td.code').textContent"), "C03")
        at = self.browser.ask(f"geomendReport.at({number})")
        self.assertLess(abs(at[0] - x - width / 2), 0.35 * width)
        self.assertLess(abs(at[1] - y - height / 2), 0.35 * height)
        self.assertQuiet()

    @in_each_view
    def test_a_click_on_a_mark_chooses_its_row(self):
        # The cell upside down is also where the throw is not: its mark lies alone at that corner.
        number = next(i for i, f in enumerate(self.findings) if f["code"] == "C03")
        self.browser.click_on(f"#rows tr:nth-child({number + 1})")
        self.settle()
        for button in ("info", "warning"):
            self.browser.click_on(f"[data-severity={button}]")
        other = next(i for i, f in enumerate(self.findings) if f["severity"] == "error" and f["code"] != "C03")
        self.browser.ask(f"document.querySelectorAll('#rows tr')[{other}].dispatchEvent(new MouseEvent('click'))")
        self.settle()
        self.browser.click_on("#reset")
        self.settle()
        self.assertEqual(self.chosen(), self.findings[other]["code"])
        self.browser.click(*self.browser.ask(f"geomendReport.at({number})"))
        self.assertEqual(self.chosen(), "C03")

    @in_each_view
    def test_draws_the_model_and_turns_it(self):
        x, y, width, height = self.view_box()
        box = (x, y + 130, width, height - 220)  # without legend and sliders
        whole = self.browser.picture(box)
        self.browser.drag(x + width - 40, y + 200, -150, 40)
        self.settle()
        self.assertGreater(self.browser.changed(whole, self.browser.picture(box)), 0.05, "it turns")
        self.browser.click_on("#reset")
        self.settle()
        self.assertLess(self.browser.changed(whole, self.browser.picture(box)), 0.001, "the same view twice")
        for number in range(self.browser.ask("document.querySelectorAll('#legend input').length")):
            self.browser.click_on(f"#legend label:nth-child({number + 1}) input")
        self.settle()
        self.assertGreater(self.browser.changed(whole, self.browser.picture(box)), 0.05, "the roles are hidden")
        self.assertTrue(self.browser.ask(
            "(() => { const m = document.getElementById('marks'), d = m.getContext('2d').getImageData(0, 0, m.width, m.height).data;"
            " for (let i = 0; i < d.length; i += 4) if (d[i + 3] > 200 && d[i] > 180 && d[i + 1] < 60) return true; return false; })()"),
            "the errors are marked in red")
        self.assertQuiet()

    @in_each_view
    def test_heights_are_stretched_with_the_marks(self):
        before = self.browser.ask("geomendReport.at(0)")
        self.browser.ask("(() => { const s = document.getElementById('stretch'); s.value = 60; s.dispatchEvent(new Event('input')); })()")
        self.settle()
        self.assertNotEqual(self.browser.ask("geomendReport.at(0)"), before)
        self.assertNotEqual(self.browser.ask("document.getElementById('stretched').textContent"), "×1")

    def test_several_files_are_chosen_from(self):
        path = self.report("two.html", self.grid, os.path.join(os.environ["GEOMEND_SOURCE_DIR"], "samples", "layered_box.ml"))
        b = self.browser
        b.open(path)
        both = len(self.rows())
        self.assertEqual(b.ask("document.querySelectorAll('#columns th').length"), 6, "there is a column of files")
        b.ask("(() => { const f = document.getElementById('file'); f.value = '1'; f.dispatchEvent(new Event('change')); })()")
        self.settle()
        self.assertLess(len(self.rows()), both)
        self.assertEqual(b.ask("document.querySelectorAll('#columns th').length"), 5)
        self.assertIn("horizon", b.ask("document.getElementById('legend').textContent"))
        self.assertQuiet()


class RepairPage(unittest.TestCase):
    """A repair: the model before and after, side by side."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        recipe = os.path.join(cls.folder.name, "recipe.toml")
        with open(recipe, "w", encoding="utf-8") as file:
            file.write('[[edit]]\naction = "move"\nsurface = "H2"\nby = [0, 0, -20]\n')
        cls.page = os.path.join(cls.folder.name, "page.html")
        sample = os.path.join(os.environ["GEOMEND_SOURCE_DIR"], "samples", "layered_box.ml")
        subprocess.run([PROGRAM, "repair", "--quiet", "--recipe", recipe, sample, "-o", os.path.join(cls.folder.name, "out.ml"),
                        "--report", cls.page], check=True, timeout=60)
        with open(cls.page, encoding="utf-8") as file:
            cls.has_vtk = "GeomendVtkView=" in file.read()
        cls.browser = browser.Browser(1600, 900)

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.folder.cleanup()

    settle, open_in, assertQuiet = Page.settle, Page.open_in, Page.assertQuiet

    def box(self, name):
        return self.browser.ask(f"(() => {{ const b = document.getElementById('{name}').getBoundingClientRect();"
                                " return [b.x + 10, b.y + 260, b.width - 20, b.height - 400]; })()")

    def pictures(self):
        return [self.browser.picture(self.box(name)) for name in ("before-view", "view")]

    @in_each_view
    def test_stands_side_by_side_and_turns_as_one(self):
        before, after = self.box("before-view"), self.box("view")
        self.assertEqual((before[1], before[3]), (after[1], after[3]))
        self.assertLessEqual(abs(before[2] - after[2]), 1)  # an odd number of pixels has no half
        self.assertLess(before[0] + before[2], after[0])
        one, other = self.pictures()
        x, y, width, height = after
        self.browser.drag(x + width / 2, y + height / 2, -120, 30)
        self.settle()
        self.settle()
        turned_one, turned_other = self.pictures()
        self.assertGreater(self.browser.changed(other, turned_other), 0.05, "the result turns")
        self.assertGreater(self.browser.changed(one, turned_one), 0.05, "and what was read with it")
        self.assertEqual(self.browser.ask("JSON.stringify(geomendReport.poses()[0])"), self.browser.ask("JSON.stringify(geomendReport.poses()[1])"))
        x, y, width, height = before
        self.browser.drag(x + width / 2, y + height / 2, 120, -30)
        self.settle()
        self.settle()
        self.assertGreater(self.browser.changed(turned_other, self.pictures()[1]), 0.05, "also when the other one is turned")
        self.assertQuiet()

    @in_each_view
    def test_colours_what_moved_and_says_how_far(self):
        text = self.browser.ask("document.getElementById('scale').textContent")
        self.assertIn("Largest 20 m", text)
        self.assertIn("mean 20 m", text)
        coloured = self.pictures()
        self.browser.click_on("#by-move")
        self.settle()
        plain = self.pictures()
        self.assertGreater(self.browser.changed(coloured[1], plain[1]), 0.05, "roles instead of moves")
        self.assertLess(self.browser.changed(coloured[0], plain[0]), 0.001, "before nothing had moved")
        self.assertQuiet()

    def test_tells_the_steps_and_what_was_found_before_and_after(self):
        self.open_in("plain")
        steps = self.browser.ask("document.querySelector('#steps ol').textContent")
        self.assertIn("'H2' moved by 20", steps)
        self.assertIn("kept", steps)
        self.assertTrue(self.browser.ask("document.getElementById('steps').open"))
        self.assertIn("0 errors", self.browser.ask("document.getElementById('before-caption').textContent"))
        self.assertIn("0 errors", self.browser.ask("document.getElementById('after-caption').textContent"))
        self.assertIn("lines cut (after)", self.browser.ask("document.getElementById('legend').textContent"))


class PageWithoutWebGl(unittest.TestCase):
    def test_takes_the_plain_view(self):
        with tempfile.TemporaryDirectory() as folder, browser.Browser(webgl=False) as without:
            page = os.path.join(folder, "page.html")
            sample = os.path.join(os.environ["GEOMEND_SOURCE_DIR"], "samples", "layered_box.ml")
            subprocess.run([PROGRAM, "validate", "--quiet", "--fail-on", "never", "--report", page, sample], check=True, timeout=60)
            without.open(page)
            self.assertEqual(without.ask("geomendReport.view()"), "plain")
            self.assertEqual(without.complaints, [])


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    if browser.program() is None:
        print("skipped: there is no Chromium (scripts/test --clients installs it)")
        sys.exit(77)
    sys.exit(unittest.main())
