# SPDX-License-Identifier: MIT
"""Derivatives are slopes, and ridges are told: python_derivatives_test.py (PYTHONPATH: the module's folder)."""
import unittest

import numpy as np

import minkray as mk
from pairs_support import RNG, matrices, moved, off_slope, random_poses, slope, some_shapes, unit


class Derivatives(unittest.TestCase):
    def check_distances(self, low, high, allowed):
        shapes = some_shapes()
        for name_a, a in shapes.items():
            for name_b, b in shapes.items():
                A = random_poses(20)
                B = random_poses(20)
                B[:, :3] = A[:, :3] + unit(RNG.normal(size=(20, 3))) * RNG.uniform(low, high, (20, 1))
                d = mk.signed_distances(a, A, b, B, jac=True)
                self.assertLess(d.is_ridge.sum(), 4)
                known = ~d.is_ridge
                for axis in range(6):
                    of_a = off_slope(lambda s: mk.signed_distances(a, moved(A, axis, s), b, B, tolerance=1e-14).value,
                                     d.jac_a[:, axis])
                    of_b = off_slope(lambda s: mk.signed_distances(a, A, b, moved(B, axis, s), tolerance=1e-14).value,
                                     d.jac_b[:, axis])
                    self.assertLess(max(of_a[known].max(), of_b[known].max()), allowed, (name_a, name_b, axis))

    def test_of_distances_are_slopes(self):
        self.check_distances(1.8, 4, 4e-6)

    def test_of_depths_are_slopes(self):
        self.check_distances(0.2, 0.5, 1e-5)

    def test_errors_of_distances_have_bounds(self):
        for name, shape in some_shapes().items():
            A, B = random_poses(20), random_poses(20)
            B[:, :3] = A[:, :3] + 4 * unit(RNG.normal(size=(20, 3)))
            ball = mk.sphere(0.3)
            d = mk.signed_distances(shape, A, ball, B, jac=True, jac_error=True)
            # A ball is turned about its middle in vain.
            self.assertTrue((np.linalg.norm(d.jac_b[:, 3:], axis=1) <= d.jac_error_b[:, 1]).all(), name)
            self.assertLess(d.jac_error_b.max(), 1e-5, name)
            self.assertFalse(hasattr(mk.signed_distances(shape, A, ball, B, jac=True), "jac_error_a"))

    def test_of_times_of_impact_are_slopes(self):
        shapes = some_shapes()
        for a in ("box", "capsule", "ellipsoid"):
            for b in ("box", "cylinder", "sphere"):
                A, B = random_poses(60), random_poses(60)
                B[:, :3] = A[:, :3] + 4 * unit(RNG.normal(size=(60, 3)))
                twists = RNG.normal(size=(2, 60, 6)) * [1, 1, 1, 0.4, 0.4, 0.4]
                twists[0, :, :3] += B[:, :3] - A[:, :3]
                twists[:, :20, 3:] = 0
                def time(A, B):
                    return mk.times_of_impact(shapes[a], A, twists[0], shapes[b], B, twists[1], 3)
                hit = time(A, B)
                d = mk.times_of_impact(shapes[a], A, twists[0], shapes[b], B, twists[1], 3, jac=True)
                known = (hit.status == mk.IMPACT) & ~d.is_ridge
                self.assertGreater(known.sum(), 10)
                for axis in range(6):
                    for side, jac in enumerate((d.jac_a, d.jac_b)):
                        f = lambda s: time(moved(A, axis, s) if side == 0 else A, moved(B, axis, s) if side == 1 else B).t_lo
                        off = np.abs(slope(f, 1e-3) - jac[:, axis]) / (1 + np.abs(jac[:, axis]))
                        # Times are known to 1e-10 of the sizes, and contacts pass from feature to feature.
                        self.assertLess(np.quantile(off[known], 0.7), 2e-6, (a, b, axis, side))
                self.assertTrue(np.isnan(d.jac_a[d.status == mk.NO_IMPACT]).all())

    def test_of_rays_are_slopes(self):
        for name, shape in some_shapes().items():
            pose = random_poses(1, 0.5)
            origins = 4 * unit(RNG.normal(size=(300, 3)))
            rays = np.concatenate([origins, pose[0, :3] + RNG.uniform(-0.3, 0.3, (300, 3)) - origins], axis=1)

            def cast(rays, pose, **how):
                scene = mk.Scene()
                scene.add(shape, matrices(pose)[0])
                return scene.cast_rays(rays, **how)
            hits = cast(rays, pose, jac=True)
            known = (hits.status == mk.HIT) & ~hits.is_ridge
            self.assertGreater(known.sum(), 150, name)
            self.assertLess((hits.is_ridge & (hits.status == mk.HIT)).sum(), 3, name)
            self.assertTrue(np.isnan(hits.jac_ray[hits.status == mk.MISS]).all())
            for axis in range(6):
                def of_ray(s):
                    beside = rays.copy()
                    beside[:, axis] += s
                    return cast(beside, pose).t
                for f, jac in ((of_ray, hits.jac_ray), (lambda s: cast(rays, moved(pose, axis, s)).t, hits.jac_body)):
                    off = off_slope(f, jac[:, axis]) / (1 + np.abs(jac[:, axis]))
                    self.assertLess(off[known].max(), 2e-6, (name, axis))

    def test_errors_of_rays_have_bounds(self):
        scene = mk.Scene()
        scene.add(mk.sphere(1))
        scene.add(mk.box([1, 1, 1]), [[1, 0, 0, 0], [0, 1, 0, 10], [0, 0, 1, 0]])
        rays = [[-4, 0.6, 0, 1, 0, 0], [-4, 10, 0, 2, 0, 0], [-4, 5, 0, 1, 0, 0], [0, 0, 0, 1, 0, 0],
                [-4, 10, 4, 3, 0, -3]]
        hits = scene.cast_rays(rays, jac=True, jac_error=True)
        error = hits.jac_ray[0] - [-1, 0.75, 0, -3.2, 2.4, 0]
        self.assertLessEqual(np.linalg.norm(error[:3]), hits.jac_error_ray[0, 0])
        self.assertLessEqual(np.linalg.norm(error[3:]), hits.jac_error_ray[0, 1])
        # A ball is turned about its middle in vain.
        self.assertLessEqual(np.linalg.norm(hits.jac_body[0, 3:]), hits.jac_error_body[0, 1])
        self.assertLess(hits.jac_error_ray[:2].max(), 1e-11)
        self.assertLess(hits.jac_error_body[:2].max(), 1e-11)
        self.assertTrue(np.isnan(hits.jac_error_ray[2]).all())
        self.assertTrue((hits.jac_error_body[3] == 0).all())
        self.assertTrue(hits.is_ridge[4] and np.isinf(hits.jac_error_ray[4]).all())
        self.assertFalse(hasattr(scene.cast_rays(rays, jac=True), "jac_error_ray"))
        alone = scene.cast_rays(rays, jac_error=True)
        self.assertFalse(hasattr(alone, "jac_ray"))
        np.testing.assert_array_equal(alone.jac_error_body, hits.jac_error_body)

    def test_errors_of_times_of_impact_have_bounds(self):
        ball, poses, twist = mk.sphere(1), [[4, 1.2, 0, 1, 0, 0, 0], [4, 9, 0, 1, 0, 0, 0]], [-1, 0, 0, 0, 0, 0.5]
        d = mk.times_of_impact(ball, None, None, ball, poses, twist, 5, jac=True, jac_error=True)
        error = d.jac_b[0] - [1, 0.75, 0, 0, 0, 0]
        self.assertLessEqual(np.linalg.norm(error[:3]), d.jac_error_b[0, 0])
        self.assertLessEqual(np.linalg.norm(error[3:]), d.jac_error_b[0, 1])
        self.assertLess(d.jac_error_b[0].max(), 1e-7)
        self.assertTrue(np.isnan(d.jac_error_a[1]).all())
        self.assertFalse(hasattr(mk.times_of_impact(ball, None, None, ball, poses, twist, 5), "jac_error_a"))
        scene = mk.Scene()
        scene.add(ball)
        found = scene.time_of_impact(ball, poses, twist, 5, jac=True, jac_error=True)
        self.assertLessEqual(np.linalg.norm((found.jac[0] - [1, 0.75, 0, 0, 0, 0])[:3]), found.jac_error[0, 0])
        self.assertEqual(found.jac_error.shape, (2, 2))
        self.assertTrue(np.isnan(found.jac_error[1]).all())

    def test_say_where_they_are_not_unique(self):
        box, flat = mk.box([1, 1, 1]), [[0.3, 0.2, 3, 1, 0, 0, 0]]
        turned = [[0.3, 0.2, 3, np.cos(0.2), 0, 0, np.sin(0.2)]]  # about z: faces still parallel
        tilted = [[0, 0, 4, np.cos(0.2), np.sin(0.2), 0, 0]]  # about x: an edge over a face
        askew = [[0, 0, 4, *unit(np.array([1, 0.3, 0.2, 0.1]))]]
        ridge = lambda *pair: bool(mk.signed_distances(*pair, jac=True).is_ridge[0])
        for pose, expected in ((flat, True), (turned, True), (tilted, True), (askew, False)):
            self.assertEqual(ridge(box, None, box, pose), expected, pose)
        self.assertTrue(ridge(mk.capsule(1, 1), None, mk.capsule(1, 1), [[3, 0, 0, 1, 0, 0, 0]]))  # parallel
        self.assertFalse(ridge(mk.capsule(1, 1), None, mk.capsule(1, 1), [[3, 0, 0, *unit(np.array([1, 1, 0, 0]))]]))
        self.assertTrue(ridge(mk.cylinder(1, 1), None, mk.box([5, 5, 1]), [[0, 0, 4, 1, 0, 0, 0]]))  # stands
        self.assertTrue(ridge(mk.cylinder(1, 1), None, mk.box([1, 5, 5]), [[4, 0, 0, 1, 0, 0, 0]]))  # lies
        self.assertFalse(ridge(mk.ellipsoid([1, 2, 3]), None, mk.box([1, 5, 5]), [[9, 0, 0, 1, 0, 0, 0]]))
        self.assertTrue(ridge(mk.sphere(1), None, mk.sphere(2), None))  # around a common middle
        self.assertTrue(ridge(mk.sphere(0.1), [[0.2, 0, 0, 1, 0, 0, 0]], mk.box([1, 0.8, 3]), None))  # two faces as near
        self.assertFalse(ridge(mk.sphere(0.1), [[0.3, 0, 0, 1, 0, 0, 0]], mk.box([1, 0.8, 3]), None))
        hull = mk.hull([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
        self.assertTrue(ridge(hull, None, hull, flat))
        self.assertFalse(ridge(hull, None, hull, askew))
        summed = mk.sum(mk.box([0.5, 0.5, 0.5]), mk.superellipsoid([0.5, 0.5, 0.5], 4))
        self.assertTrue(ridge(summed, None, summed, [[0.1, 0.1, 5, 1, 0, 0, 0]]))

    def test_of_meshes_say_where_parts_are_equally_near(self):
        def bent(height):  # a valley (1), a flat (0) or a roof (-1) of four triangles along y
            return mk.mesh([[0, -1, 0], [0, 1, 0], [-2, -1, height], [-2, 1, height], [2, -1, height], [2, 1, height]],
                           [[0, 1, 3], [0, 3, 2], [0, 5, 1], [0, 4, 5]])
        scene_pose = np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 1.0]])
        small_box = mk.mesh([[x, y, z] for x in (-.1, .1) for y in (-.1, .1) for z in (-.1, .1)],
                            [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6],
                             [0, 6, 4], [1, 5, 7], [1, 7, 3]])
        for body in mk.sphere(0.1), mk.ellipsoid([0.1, 0.2, 0.1]), mk.superellipsoid([0.1, 0.1, 0.1], 2.5):
            for height, expected in ((1.0, True), (0, False), (-1.0, False)):
                for x in (0, 1e-6) if height > 0 else (0,):
                    at, down = [x, 0.3, 1, 1, 0, 0, 0], [0, 0, -1, 0, 0, 0]
                    mesh, ridge = bent(2 * height), expected and x == 0
                    scene = mk.Scene()
                    scene.add(mesh)
                    found = [mk.signed_distances(mesh, None, body, at, jac=True).is_ridge[0],
                             mk.times_of_impact(mesh, None, None, body, at, down, jac=True).is_ridge[0],
                             scene.distance_to(body, at, jac=True).is_ridge[0],
                             scene.time_of_impact(body, at, down, jac=True).is_ridge[0]]
                    scene.add(body, scene_pose + [[0, 0, 0, x], [0, 0, 0, 0.3], [0, 0, 0, 0]])
                    found.append(scene.distances(within=2, jac=True).is_ridge[0])
                    self.assertEqual([bool(one) for one in found], [ridge] * 5, (body, height, x))
        turned = [0, 0.3, 1, *unit(np.array([1, 0.3, 0.2, 0.1]))]
        self.assertFalse(mk.signed_distances(bent(0), None, small_box, turned, jac=True).is_ridge[0])
        self.assertTrue(mk.signed_distances(bent(0), None, small_box, [0, 0.3, 1, 1, 0, 0, 0], jac=True).is_ridge[0])

    def test_of_impacts_are_as_accurate_as_those_of_distances(self):
        # A point moves into a superellipsoid: the gauge's gradient is the normal.
        rng, errors = np.random.default_rng(0), []
        for _ in range(100):
            p, r = rng.choice([2.5, 3, 4, 6]), rng.uniform(0.4, 1.2, 3)
            origin = 4 * unit(rng.normal(size=3))
            v = -origin / 4 + rng.normal(size=3) * 0.03
            d = mk.times_of_impact(mk.superellipsoid(r, p), None, None, mk.point([0, 0, 0]), [*origin, 1, 0, 0, 0],
                                   [*v, 0, 0, 0], 9, jac=True, threads=1)
            if d.status[0] != mk.IMPACT:
                continue
            t = d.t_hi[0]
            for _ in range(5):
                x = origin + t * v
                n = p / r * np.abs(x / r) ** (p - 1) * np.sign(x)
                t -= ((np.abs(x / r) ** p).sum() - 1) / (n @ v)
            errors.append(np.abs(-n / (n @ v) - d.jac_b[0, :3]).max() / max(1, np.linalg.norm(n / (n @ v))))
        self.assertGreater(len(errors), 60)
        self.assertLess(max(errors), 1e-6)

    def test_of_rays_at_the_border_of_a_mesh_are_not_unique(self):
        def flags(mesh, points):
            scene = mk.Scene()
            scene.add(mesh)
            hits = scene.cast_rays([[x, y, 5, 0, 0, -1.0] for x, y in points], jac=True, jac_error=True)
            self.assertTrue((hits.status == mk.HIT).all())
            self.assertTrue((np.isinf(hits.jac_error_ray).all(1) == hits.is_ridge).all())
            return hits.is_ridge.tolist()
        square = mk.mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], [[0, 1, 2], [1, 3, 2]])
        self.assertEqual(flags(square, [(0, 0.5), (0, 0), (1, 1), (0.5, 0.5), (0.2, 0.2), (1e-6, 0.5)]),
                         [True, True, True, False, False, False])
        # The same vertices twice: the triangles still meet.
        parted = mk.mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [3, 4, 5]])
        self.assertEqual(flags(parted, [(0.5, 0.5), (1, 0.5)]), [False, True])
        fan = mk.mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]], [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]])
        self.assertEqual(flags(fan, [(0, 0), (0.25, 0), (1, 0)]), [False, False, True])

    def test_of_rays_say_where_they_are_not_unique(self):
        scene = mk.Scene()
        scene.add(mk.box([1, 1, 1]))
        scene.add(mk.cylinder(1, 1), [[1, 0, 0, 10], [0, 1, 0, 0], [0, 0, 1, 0]])
        scene.add(mk.hull([[x, y, z + 20] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]))
        scene.add(mk.box([1, 1, 1]), [[1, 0, 0, 0], [0, 1, 0, -20], [0, 0, 1, 0]])
        scene.add(mk.box([1, 1, 1]), [[1, 0, 0, 2], [0, 1, 0, -20], [0, 0, 1, 0]])
        for ray, expected in (([5, 0, 0, -1, 0, 0], False), ([5, 0, 5, -4, 0, -4], True), ([5, 5, 5, -4, -4, -4], True),
                              ([10, -3, 3, 0, 2, -2], True), ([10, -3, 0.3, 0, 2, 0], False), ([5, 0.1, 20.1, -1, 0, 0], False),
                              ([5, 0, 25, -4, 0, -4], True), ([1, -10, 0, 0, -1, 0], True), ([0.5, -10, 0, 0, -1, 0], False)):
            hits = scene.cast_rays([ray], jac=True)
            self.assertEqual(hits.status[0], mk.HIT, ray)
            self.assertEqual(bool(hits.is_ridge[0]), expected, ray)


if __name__ == "__main__":
    unittest.main()
