# SPDX-License-Identifier: MIT
"""Texts of errors in Python, and exceptions of support functions: python_errors_test.py SOURCES."""
import copy
import os
import pickle
import re
import sys
import tempfile
import unittest

import numpy as np

import minkray as mk

SOURCES = sys.argv.pop(1)


class Raised(unittest.TestCase):
    """By a support function."""

    def test_errors_are_told_without_a_trace(self):
        class Mine(Exception):
            pass

        for error, text in ((Mine("text 42"), "Mine: text 42"), (Mine(), "Mine"), (KeyError("x"), "KeyError: 'x'")):
            def fails(n):
                raise error

            with self.assertRaises(mk.Error) as raised:
                mk.custom(fails)
            self.assertEqual(str(raised.exception), f"custom: the support function failed: {text}")

    def test_ends_stay_what_they_are(self):
        for end in (KeyboardInterrupt, SystemExit(3), GeneratorExit):
            def ends(n):
                raise end

            kind = end if isinstance(end, type) else type(end)
            with self.assertRaises(kind):
                mk.custom(ends)
            ending = []

            def support(n):
                if ending:
                    raise end
                return n

            scene = mk.Scene()
            ball = mk.custom(support)
            scene.add(ball)
            scene.commit()
            ending.append(1)
            with self.assertRaises(kind):
                scene.cast_rays(np.tile([[-3, 0.1, 0.2, 1, 0, 0]], (1000, 1)))
            with self.assertRaisesRegex(mk.Error, "the support function failed: " + kind.__name__):
                ball.support([[0, 0, 1]])  # is not asked again
        self.assertEqual(mk.sphere(1).kind, "sphere")


class Copies(unittest.TestCase):
    def test_of_every_protocol(self):
        """Protocols 0 and 1 ended the process."""
        shape = mk.rounded(mk.box([1, 2, 3]), 0.5)
        for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
            self.assertEqual(pickle.loads(pickle.dumps(shape, protocol)).json(), shape.json())
        make, arguments = shape.__reduce__()
        self.assertEqual(make(*arguments).json(), shape.json())

    def test_of_meshes_have_their_vertices_and_triangles(self):
        mesh = mk.mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [7, 7, 7]], [[0, 2, 1], [0, 1, 3], [0, 3, 2]])
        for again in (pickle.loads(pickle.dumps(mesh)), pickle.loads(pickle.dumps(mesh, 0)), copy.deepcopy(mesh)):
            self.assertEqual(again.kind, "mesh")
            self.assertEqual(mk.mesh_info(again), mk.mesh_info(mesh))
            make, (vertices, triangles) = again.__reduce__()
            self.assertEqual(vertices.tolist()[3:], [[0, 0, 1], [7, 7, 7]])
            self.assertEqual(triangles.tolist(), [[0, 2, 1], [0, 1, 3], [0, 3, 2]])

    def test_of_what_is_immutable_are_itself(self):
        for shape in (mk.sphere(1), mk.custom(lambda n: n)):
            self.assertIs(copy.copy(shape), shape)
            self.assertIs(copy.deepcopy([shape])[0], shape)
        with self.assertRaisesRegex(mk.Error, "custom support functions cannot be written"):
            pickle.dumps(mk.custom(lambda n: n), 1)


if __name__ == "__main__":
    unittest.main()
