# SPDX-License-Identifier: MIT
"""Checks of error messages, for tests."""
import re
import unittest

import minkray as mk


class ErrorCase(unittest.TestCase):
    def expect(self, text, work):
        """Expects an `Error` that begins with the text and has no names of C or pybind."""
        with self.assertRaises(mk.Error, msg=text) as raised:
            work()
        said = str(raised.exception)
        self.assertTrue(said.startswith(text), f"{said!r} does not begin with {text!r}")
        self.assertIsNone(re.search(r"minkray_\w+:|incompatible|Invoked with|arg0|pybind|At:", said), said)
