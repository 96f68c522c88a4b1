#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""site_test.py SOURCES: the site without pages of the inspector is complete, and faults of pages are named."""
import importlib.util
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sources = pathlib.Path(sys.argv.pop(1)).resolve()
tool = sources / "tools/site/minkray-site"


def make(folder, root):
    return subprocess.run([sys.executable, str(tool), str(folder), "--root", str(root)], capture_output=True, text=True)


def small_sources(folder, page):
    """Two pages, one of which is given, and one picture."""
    (folder / "docs").mkdir()
    (folder / "images").mkdir()
    (folder / "images/dot.png").write_bytes(b"a picture")
    (folder / "README.md").write_text("# Front\n\n![a dot](images/dot.png)\n\n[one](docs/one.md#the-end)\n")
    (folder / "CHANGELOG.md").write_text("# Changelog\n")
    (folder / "docs/README.md").write_text("# Documents\n\n## Users\n\n- [one.md](one.md): a page\n")
    (folder / "docs/one.md").write_text(page)


class Site(unittest.TestCase):
    def setUp(self):
        self.work = pathlib.Path(tempfile.mkdtemp())
        self.root, self.site = self.work / "root", self.work / "site"
        self.root.mkdir()
        self.addCleanup(shutil.rmtree, self.work)

    def test_every_page_is_there_and_every_link_resolves(self):
        made = make(self.site, sources)
        self.assertEqual(made.returncode, 0, made.stderr)
        for page in (sources / "docs").rglob("*.md"):
            name = page.relative_to(sources).with_suffix(".html")
            if page.name == "README.md":
                name = name.with_name("index.html")
            self.assertTrue((self.site / name).is_file(), name)
        checked = subprocess.run([sys.executable, str(tool.with_name("links.py")), str(self.site)],
                                 capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stdout)
        self.assertGreater(int(checked.stdout.split()[0]), 1000)
        gallery = (self.site / "gallery.html").read_text(encoding="utf-8")
        for picture in (sources / "images").rglob("*.png"):
            self.assertIn(f'src="{picture.relative_to(sources).as_posix()}"', gallery)
        self.assertIn("<table>", (self.site / "docs/cast.html").read_text(encoding="utf-8"))

    def test_links_lead_to_html_and_pages_are_called_by_their_titles(self):
        small_sources(self.root, "# Page one\n\n## The end!\n\n[index](README.md), [front](../README.md), [up](#the-end)\n")
        made = make(self.site, self.root)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertIn('<a href="docs/one.html#the-end">one</a>', (self.site / "index.html").read_text())
        page = (self.site / "docs/one.html").read_text()
        self.assertIn('<a href="index.html">index</a>, <a href="../index.html">front</a>', page)
        self.assertIn('<a href="one.html">Page one</a>: a page', (self.site / "docs/index.html").read_text())
        self.assertEqual(sorted(entry.name for entry in self.work.iterdir()), ["root", "site"])

    def refused(self, page, message):
        small_sources(self.root, page)
        made = make(self.site, self.root)
        self.assertEqual(made.returncode, 1)
        self.assertIn(message, made.stderr)
        self.assertEqual([entry.name for entry in self.work.iterdir()], ["root"])

    def test_a_link_to_no_file_is_named(self):
        self.refused("# One\n\n## The end\n\n[x](two.md)\n", "docs/one.md: link to two.md: no such file")

    def test_a_link_to_no_anchor_is_named(self):
        self.refused("# One\n\n## The beginning\n", "index.html: docs/one.html#the-end: no such anchor")

    def test_a_picture_of_another_host_is_named(self):
        self.refused("# One\n\n## The end\n\n![x](https://example.org/x.png)\n",
                     "docs/one.html: https://example.org/x.png: is loaded from another host")

    def test_a_picture_that_no_page_shows_is_named(self):
        (self.root / "images").mkdir()
        (self.root / "images/lost.png").write_bytes(b"")
        (self.root / "README.md").write_text("# Front\n")
        (self.root / "CHANGELOG.md").write_text("# Changelog\n")
        (self.root / "docs").mkdir()
        (self.root / "docs/README.md").write_text("# Documents\n")
        made = make(self.site, self.root)
        self.assertEqual(made.returncode, 1)
        self.assertIn("images/lost.png: no page shows this picture", made.stderr)

    def test_a_folder_of_something_else_is_left_alone(self):
        small_sources(self.root, "# One\n\n## The end\n")
        self.site.mkdir()
        (self.site / "thesis.txt").write_text("mine")
        made = make(self.site, self.root)
        self.assertEqual(made.returncode, 1)
        self.assertIn("exists and is not a site made by this program", made.stderr)
        self.assertEqual((self.site / "thesis.txt").read_text(), "mine")
        (self.site / "thesis.txt").unlink()
        self.assertEqual(make(self.site, self.root).returncode, 0)
        self.assertEqual(make(self.site, self.root).returncode, 0)  # its own site is replaced


if importlib.util.find_spec("markdown_it") is None:
    print("python3-markdown-it is not installed")
    sys.exit(77)
unittest.main()
