# SPDX-License-Identifier: MIT
"""Exits and all hits of rays: python_all_hits_test.py (PYTHONPATH: the module's folder)."""
import unittest

import numpy as np

import minkray as mk

CUBE = ([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)],
        [[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4],
         [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5]])


def at(x, y, z):
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


class AllHits(unittest.TestCase):
    def setUp(self):
        self.scene = mk.Scene()
        self.cube = self.scene.add(mk.mesh(*CUBE))
        self.ball = self.scene.add(mk.sphere(0.5), at(3, 0.5, 0.5))

    def test_lists_belong_to_rays(self):
        rays = np.array([[[-1, 0.5, 0.5, 1, 0, 0], [-1, 5, 0, 1, 0, 0]],
                         [[0.5, 0.5, 0.5, 2, 0, 0], [3, 0.5, 0.5, 0, 0, 1]]], float)
        found = self.scene.all_hits(rays)
        self.assertEqual(found.offsets.tolist(), [0, 4, 4, 7, 8])
        self.assertEqual(found.ray.tolist(), [0, 0, 0, 0, 2, 2, 2, 3])
        self.assertEqual(found.status.tolist(), [[mk.HIT, mk.MISS], [mk.HIT, mk.HIT]])
        np.testing.assert_allclose(found.t, [1, 2, 3.5, 4.5, 0.25, 1, 1.5, 0.5], atol=1e-14)
        self.assertEqual(found.leaves.tolist(), [False, True, False, True, True, False, True, True])
        self.assertEqual(found.object.tolist(), [0, 0, 1, 1, 0, 1, 1, 1])
        self.assertTrue(((found.part >= 0) == (found.object == self.cube)).all())
        self.assertTrue((found.t_lo <= found.t).all() and (found.t <= found.t_hi).all())
        flat = rays.reshape(-1, 6)[found.ray]
        np.testing.assert_allclose(found.point, flat[:, :3] + found.t[:, None] * flat[:, 3:], atol=1e-14)
        along = (found.normal * flat[:, 3:]).sum(1)
        self.assertTrue(((along > 0) == found.leaves).all())

    def test_ends_are_those_of_casts(self):
        ray = [[-1, 0.5, 0.5, 1, 0, 0]]
        self.assertEqual(self.scene.all_hits(ray, t_max=1.5).t.tolist(), [1])
        self.assertEqual(self.scene.all_hits(ray, t_max=0).offsets.tolist(), [0, 0])
        self.assertEqual(self.scene.all_hits(np.zeros((0, 6))).offsets.tolist(), [0])

    def test_random_rays_through_edges_pass_in_pairs(self):
        random = np.random.default_rng(1)
        corners = np.array(CUBE[0], float)
        to = 0.5 * (corners[random.integers(0, 8, 3000)] + corners[random.integers(0, 8, 3000)])
        origins = random.integers(-20, 21, (3000, 3)) + np.array([60, 0, 0])
        found = self.scene.all_hits(np.hstack([origins, to - origins]))
        of_cube = found.object == self.cube
        entries = np.bincount(found.ray[of_cube & ~found.leaves], minlength=3000)
        leavings = np.bincount(found.ray[of_cube & found.leaves], minlength=3000)
        self.assertTrue((entries == leavings).all())
        self.assertGreater((entries == 1).sum(), 2000)
        self.assertLessEqual(entries.max(), 1)

    def test_exits(self):
        rays = [[-1, 0.5, 0.5, 1, 0, 0], [-1, 5, 0, 1, 0, 0], [0.5, 0.5, 0.5, 2, 0, 0]]
        hits = self.scene.exit(self.cube, rays)
        self.assertEqual(hits.t.tolist(), [2, np.inf, 0.25])
        self.assertEqual(hits.status.tolist(), [mk.HIT, mk.MISS, mk.HIT])
        self.assertEqual(hits.distance.tolist(), [2, np.inf, 0.5])
        self.assertEqual(hits.normal[0].tolist(), [1, 0, 0])
        ended = self.scene.exit(self.cube, rays, t_max=1.5)
        self.assertEqual(ended.status.tolist(), [mk.INSIDE, mk.MISS, mk.HIT])
        self.assertEqual(self.scene.exit(self.ball, rays).t.tolist(), [4.5, np.inf, 1.5])
        with self.assertRaisesRegex(mk.Error, "Scene.exit: object: must be less than 2"):
            self.scene.exit(7, rays)

    def test_wrong_rays_are_named(self):
        with self.assertRaisesRegex(mk.Error, r"Scene.all_hits: rays\[0\].direction: must not be zero"):
            self.scene.all_hits([[0, 0, 0, 0, 0, 0]])


if __name__ == "__main__":
    unittest.main()
