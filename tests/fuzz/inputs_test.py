#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests that inputs.py keeps every byte of what is added, and refuses what is there already."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

import inputs

HARD = {"empty": b"", "text": b"a\r\n\tb", "lines": b"\n\n", "no-end": b"a\nb", "utf8": "\u00e9\u2028\x7f".encode() * 9,
        "latin-1": b"\xe9t\xe9", "zeros": bytes(9), "all": bytes(range(256)), "quotes": b'"\\" 1, [2]'}


class Inputs(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        inputs.PACKED = pathlib.Path(self.folder.name) / "packed"
        inputs.PACKED.mkdir()
        inputs.write("scene", {"corpus": {}, "findings": {}})

    def add(self, name, content, kind="findings"):
        file = pathlib.Path(self.folder.name) / "input"
        file.write_bytes(content)
        inputs.add("scene", file, name, kind)

    def test_bytes_stay_the_same(self):
        for name, content in HARD.items():
            self.add(name, content)
        inputs.unpack(pathlib.Path(self.folder.name), ["scene"])
        files = (pathlib.Path(self.folder.name) / "findings" / "scene").iterdir()
        self.assertEqual({file.name: file.read_bytes() for file in files}, HARD)

    def test_refusals(self):
        self.add("a", b"1", "corpus")
        for name, content, message in [("a", b"2", "has an input corpus/a"), ("b", b"1", "these bytes already: corpus/a"),
                                       ("../b", b"2", "name: must be of letters")]:
            with self.assertRaisesRegex(SystemExit, message):
                self.add(name, content)
        with self.assertRaisesRegex(SystemExit, "must be one of scene .got mash."):
            inputs.read("mash")

    def test_all_files_are_as_written(self):
        """Files edited by hand into another form would change with the next input added."""
        here = pathlib.Path(inputs.__file__).resolve().parent / "inputs"
        for file in here.glob("*.json"):
            text = file.read_text(encoding="utf-8")
            inputs.PACKED = here
            content = inputs.read(file.stem)
            inputs.PACKED = pathlib.Path(self.folder.name)
            inputs.write(file.stem, content)
            self.assertEqual(inputs.file_of(file.stem).read_text(encoding="utf-8"), text, file.name)

    def test_command_line(self):
        script = pathlib.Path(inputs.__file__).resolve()
        folder = pathlib.Path(self.folder.name) / "out"
        subprocess.run([sys.executable, "-B", script, "unpack", folder, "image"], check=True)
        self.assertTrue((folder / "corpus/image/base.jpg").read_bytes().startswith(b"\x03\xff\xd8\xff"))


if __name__ == "__main__":
    unittest.main()
