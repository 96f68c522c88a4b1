# SPDX-License-Identifier: MIT
"""Meshes in Python: python_mesh_test.py (PYTHONPATH: the module's folder)."""
import pickle
import unittest

import numpy as np

import minkray as mk


def torus(around=60, across=40):
    u, v = np.meshgrid(np.arange(around) * 2 * np.pi / around, np.arange(across) * 2 * np.pi / across,
                       indexing="ij")
    r = 1 + 0.4 * np.cos(v)
    vertices = np.stack([r * np.cos(u), r * np.sin(u), 0.4 * np.sin(v)], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    a, b = i * across + j, (i + 1) % around * across + j
    d, c = i * across + (j + 1) % across, (i + 1) % around * across + (j + 1) % across
    return vertices, np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])


class Meshes(unittest.TestCase):
    def test_rays_meet_the_triangle_that_they_are_said_to_meet(self):
        vertices, triangles = torus()
        scene = mk.Scene()
        scene.add(mk.mesh(vertices, triangles), name="ring")
        scene.commit()
        rng = np.random.default_rng(1)
        origins = rng.normal(size=(2000, 3))
        origins *= 4 / np.linalg.norm(origins, axis=1)[:, None]
        rays = np.concatenate([origins, rng.normal(size=(2000, 3)) * 0.7 - origins], axis=1)
        hits = scene.cast_rays(rays)
        met = hits.status == mk.HIT
        self.assertGreater(met.sum(), 500)
        self.assertTrue((hits.part[~met] == -1).all())
        a, b, c = (vertices[triangles[hits.part[met], k]] for k in range(3))
        n = np.cross(b - a, c - a)
        o, d = rays[met, :3], rays[met, 3:]
        t = np.sum(n * (a - o), axis=1) / np.sum(n * d, axis=1)
        np.testing.assert_allclose(hits.t[met], t, rtol=1e-12)
        self.assertTrue(((hits.t_lo[met] <= t + 1e-14) & (t <= hits.t_hi[met] + 1e-14)).all())
        self.assertTrue(scene.certify(rays, hits).holds.all())

    def test_no_ray_from_within_gets_out_at_a_vertex(self):
        vertices, triangles = torus()
        scene = mk.Scene()
        scene.add(mk.mesh(vertices, triangles))
        scene.commit()
        angle = np.arctan2(vertices[:, 1], vertices[:, 0])
        origins = np.stack([np.cos(angle), np.sin(angle), 0 * angle], -1)
        hits = scene.cast_rays(np.concatenate([origins, vertices - origins], axis=1))
        self.assertTrue((hits.status == mk.HIT).all())

    def test_a_terrain_is_as_high_as_its_heights(self):
        rng = np.random.default_rng(7)
        heights = rng.uniform(-1, 1, size=(6, 9))
        scene = mk.Scene()
        scene.add(mk.height_field(heights, size=(4, 3)))
        scene.commit()
        x, y = np.meshgrid(np.linspace(-2, 2, 9), np.linspace(-1.5, 1.5, 6))
        down = np.stack([x, y, 5 + 0 * x, 0 * x, 0 * x, -1 + 0 * x], axis=-1).reshape(-1, 6)
        hits = scene.cast_rays(down)
        np.testing.assert_allclose(5 - hits.t, heights.reshape(-1), atol=1e-14)
        self.assertGreater(mk.mesh_info(mk.height_field(heights, (4, 3)))["open_edges"], 0)
        self.assertEqual(mk.mesh_info(mk.height_field(heights, (4, 3), bottom=-2))["open_edges"], 0)
        for wrong in ((heights[0], (4, 3)), (heights, 4), (heights, (4, 0)), (heights[:1], (4, 3))):
            with self.assertRaises(mk.Error):
                mk.height_field(*wrong)
        with self.assertRaises(mk.Error):
            mk.height_field(heights, (4, 3), bottom=0)

    def test_a_ball_goes_through_the_hole_of_a_ring_but_not_of_its_hull(self):
        vertices, triangles = torus()
        ring, ball = mk.mesh(vertices, triangles), mk.sphere(0.2)
        found = mk.signed_distance(ring, None, ball, None)
        self.assertEqual(found.status, mk.SEPARATED)
        self.assertAlmostEqual(float(found.value), 0.4, places=2)
        self.assertEqual(mk.signed_distance(mk.hull(vertices), None, ball, None).status, mk.OVERLAPPING)
        shifted = np.tile(np.eye(4), (5, 1, 1))
        shifted[:, 0, 3] = [0, 0.1, 0.2, 0.5, 1]
        many = mk.signed_distances(ring, np.eye(4), ball, shifted)
        self.assertEqual(list(many.status == mk.OVERLAPPING), [False, False, False, True, True])
        self.assertTrue((np.diff(many.value) <= 0).all())

    def test_says_what_is_wrong(self):
        vertices, triangles = torus(6, 4)
        for wrong, of in (((vertices, triangles + 24), "from 0 to 23"), ((vertices, triangles[:, :2]), r"shape \(M, 3\)"),
                          ((vertices, triangles * 1.0), "whole numbers"), ((vertices[:, :2], triangles), r"\(N, 3\)")):
            with self.assertRaisesRegex(mk.Error, of):
                mk.mesh(*wrong)
        self.assertEqual(mk.mesh_info(mk.mesh(vertices, triangles))["open_edges"], 0)
        self.assertEqual(repr(mk.mesh(vertices, triangles)), "<minkray.Shape mesh>")

    def test_a_pair_has_its_own_bodies_whatever_the_pair_before_has(self):
        ball, ring = mk.sphere(0.5), mk.mesh(*torus())
        table = mk.compound([mk.box([1, 1, 0.1]), mk.sphere(0.2)], [[0, 0, 1, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0, 0]])
        bodies, pose = [ring, ball, table, ball, ring, table], [5, 0, 0, 1, 0, 0, 0]
        many = mk.signed_distances(bodies, np.tile([0, 0, 0, 1, 0, 0, 0], (6, 1)), ball, pose)
        one = [float(mk.signed_distance(body, None, ball, pose).value) for body in bodies]
        self.assertEqual(many.value.tolist(), one)
        self.assertAlmostEqual(one[1], 4)


class Compounds(unittest.TestCase):
    def setUp(self):
        rng = np.random.default_rng(3)
        self.shapes = [mk.sphere(0.3), mk.box([0.2, 0.4, 0.1]), mk.cylinder(0.2, 0.5), mk.rounded(mk.cone(0.3, 0.4), 0.05)]
        self.poses = np.concatenate([rng.uniform(-1, 1, (4, 3)), rng.normal(size=(4, 4))], axis=1)
        self.compound = mk.compound(self.shapes, self.poses)

    def test_rays_and_distances_are_those_of_the_parts(self):
        rng = np.random.default_rng(4)
        rays = np.concatenate([rng.normal(size=(1000, 3)) * 3, np.zeros((1000, 3))], axis=1)
        rays[:, 3:] = rng.uniform(-1, 1, (1000, 3)) - rays[:, :3]
        scene, parts = mk.Scene(), mk.Scene()
        scene.add(self.compound)
        for shape, pose in zip(self.shapes, self.poses):
            parts.add(shape, pose)
        scene.commit()
        parts.commit()
        hits, expected = scene.cast_rays(rays), parts.cast_rays(rays)
        np.testing.assert_array_equal(hits.status, expected.status)
        met = hits.status == mk.HIT
        self.assertGreater(met.sum(), 100)
        np.testing.assert_allclose(hits.t[met], expected.t[met], rtol=1e-12)
        np.testing.assert_array_equal(hits.part[met], expected.object[met])
        self.assertTrue(scene.certify(rays, hits).holds.all())
        points = rng.uniform(-3, 3, (200, 3))
        poses = np.concatenate([points, np.tile([1, 0, 0, 0], (200, 1))], axis=1)
        found = mk.signed_distances(self.compound, None, mk.point([0, 0, 0]), poses)
        each = [mk.signed_distances(shape, pose, mk.point([0, 0, 0]), poses).value
                for shape, pose in zip(self.shapes, self.poses)]
        np.testing.assert_allclose(found.value, np.maximum(np.min(each, axis=0), 0), atol=1e-11)

    def test_is_copied_pickled_and_taken_apart(self):
        shapes, poses = mk.compound_parts(self.compound)
        self.assertEqual([shape.kind for shape in shapes], ["sphere", "box", "cylinder", "rounded"])
        self.assertEqual(poses.shape, (4, 3, 4))
        again = pickle.loads(pickle.dumps(self.compound))
        self.assertEqual(again.kind, "compound")
        np.testing.assert_array_equal(again.bounds(), self.compound.bounds())
        self.assertEqual(repr(again), "<minkray.Shape compound>")
        for wrong in (lambda: mk.compound([]), lambda: mk.compound(self.shapes, self.poses[:2]),
                      lambda: mk.compound([self.compound]), lambda: mk.compound_parts(mk.sphere(1))):
            with self.assertRaises(mk.Error):
                wrong()


if __name__ == "__main__":
    unittest.main()
