# SPDX-License-Identifier: MIT
"""The pairs of scenes are those of brute force: python_scene_pairs_test.py (PYTHONPATH: the module's folder)."""
import unittest

import numpy as np

import minkray as mk
from pairs_support import RNG, matrices, moved, off_slope, product, random_poses, some_shapes, unit


def random_scene(count, seed, ground=True):
    rng = np.random.default_rng(seed)
    shapes = list(some_shapes().values())
    scene, bodies = mk.Scene(), []
    poses = random_poses(count, 4, rng)
    for i in range(count):
        bodies.append(shapes[i % len(shapes)])
        scene.add(bodies[-1], matrices(poses[i:i + 1])[0])
    if ground:
        scene.add_half_space([0, 0, 2], -3.2, "ground")
    return scene, bodies, poses


def to_ground(shape, pose):
    """The height of the lowest point above the plane z = -3.2."""
    turn = matrices(pose[None])[0]
    down = shape.support((turn[:3, :3].T @ [0, 0, -1.0])[None])[0]
    return (turn[:3, :3] @ down + turn[:3, 3])[2] + 3.2


class Scenes(unittest.TestCase):
    def expected(self, bodies, poses, within):
        n = len(bodies)
        found = {}
        for i in range(n):
            if i + 1 < n:
                d = mk.signed_distances(bodies[i], poses[i], bodies[i + 1:], poses[i + 1:])
                found.update({(i, i + 1 + k): v for k, v in enumerate(d.value) if v <= within})
            height = to_ground(bodies[i], poses[i])
            if height <= within:
                found[i, n] = height
        return found

    def test_tell_all_near_pairs(self):
        scene, bodies, poses = random_scene(120, 1)
        for within in 0.0, 0.3, 1.0:
            r = scene.distances(within=within)
            found = {(int(a), int(b)): v for a, b, v in zip(r.object_a, r.object_b, r.value)}
            expected = self.expected(bodies, poses, within)
            self.assertEqual(list(found), sorted(expected))
            self.assertGreater(len(found), 10)
            for pair, value in expected.items():
                self.assertAlmostEqual(found[pair], value, places=8)
        self.assertEqual(r, scene.distances(within=1.0, threads=1))
        given = np.array(list(expected))[::-3]
        some = scene.distances(given)
        np.testing.assert_array_equal(np.stack([some.object_a, some.object_b], 1), given)
        np.testing.assert_allclose(some.value, [expected[tuple(pair)] for pair in given], atol=1e-8)

    def test_follow_changes(self):
        scene, bodies, poses = random_scene(40, 2)
        before = scene.distances(within=1)
        gone = int(before.object_a[0])
        scene.remove(gone)
        after = scene.distances(within=1)
        keep = (before.object_a != gone) & (before.object_b != gone)
        self.assertEqual(after, before[keep])
        self.assertFalse((scene.nearest(poses[gone, :3], k=50).object == gone).any())
        far = np.eye(4)
        far[:3, 3] = 100
        mover = int(after.object_a[0])
        scene.set_pose(mover, far)
        self.assertFalse((scene.distances(within=1).object_a == mover).any())
        up = np.eye(4)
        up[2, 3] = -50
        scene.set_pose(40, up)
        self.assertFalse((scene.distances(within=1).object_b == 40).any())

    def test_leave_out_what_masks_and_allowances_say(self):
        scene, bodies, poses = random_scene(40, 3)
        all_pairs = scene.distances(within=1)
        i, j = int(all_pairs.object_a[3]), int(all_pairs.object_b[3])
        scene.allow(j, i)
        left = scene.distances(within=1)
        np.testing.assert_array_equal(left.value, np.delete(all_pairs.value, 3))
        self.assertEqual(len(scene.distances([[i, j]])), 1)
        scene.allow(i, j, False)
        self.assertEqual(scene.distances(within=1), all_pairs)
        for number in range(40):
            scene.set_masks(number, category=2 if number % 2 else 4, mask=4 if number % 2 else 2)
        odd = scene.distances(within=1)
        kept = ((all_pairs.object_a + all_pairs.object_b) % 2 == 1) & (all_pairs.object_b != 40)
        self.assertEqual(odd, all_pairs[kept])
        self.assertTrue((scene.nearest(np.zeros(3), k=40, mask=2).object[0, :20] % 2 == 1).all())

    def test_tell_the_nearest(self):
        scene, bodies, poses = random_scene(60, 4)
        points = RNG.uniform(-6, 6, (50, 3))
        r = scene.nearest(points, k=5)
        self.assertEqual((r.object.shape, r.normal.shape), ((50, 5), (50, 5, 3)))
        at = np.concatenate([points, np.tile([1.0, 0, 0, 0], (50, 1))], 1)
        d = mk.signed_distances(mk.point([0, 0, 0]), at[:, None], bodies, poses[None]).value
        d = np.concatenate([d, points[:, 2:] + 3.2], axis=1)
        order = np.argsort(d, axis=1)[:, :5]
        np.testing.assert_array_equal(r.object, order)
        np.testing.assert_allclose(r.value, np.take_along_axis(d, order, 1), atol=1e-8)
        folded = scene.nearest(points.reshape(5, 2, 5, 3), k=5, jac=True, jac_error=True)
        np.testing.assert_array_equal(folded.object, order.reshape(5, 2, 5, 5))
        self.assertEqual((folded.jac.shape, folded.jac_error.shape), ((5, 2, 5, 5, 6), (5, 2, 5, 5, 2)))
        few = scene.nearest(points[0], k=100)
        self.assertEqual((few.object[0] != mk.NO_OBJECT).sum(), 61)
        self.assertTrue(np.isinf(few.value[0, 61:]).all())

    def test_tell_how_far_a_shape_is(self):
        scene, bodies, poses = random_scene(60, 5)
        probe, at = mk.box([0.3, 0.2, 0.4]), random_poses(40, 5)
        r = scene.distance_to(probe, at, jac=True)
        d = mk.signed_distances(probe, at[:, None], bodies, poses[None]).value
        d = np.concatenate([d, np.array([[to_ground(probe, pose)] for pose in at])], axis=1)
        np.testing.assert_array_equal(r.object, d.argmin(1))
        np.testing.assert_allclose(r.value, d.min(1), atol=1e-8)
        near = scene.distance_to(probe, at, within=0.5)
        np.testing.assert_array_equal(near.object != mk.NO_OBJECT, d.min(1) <= 0.5)
        self.assertTrue((near.lower[near.object == mk.NO_OBJECT] == 0.5).all())
        for axis in range(6):
            off = off_slope(lambda s: scene.distance_to(probe, moved(at, axis, s)).value, r.jac[:, axis])
            self.assertLess(off[~r.is_ridge & (r.value > 0)].max(), 1e-5)

    def test_cast_shapes(self):
        scene, bodies, poses = random_scene(60, 6)
        probe = mk.capsule(0.1, 0.2)
        start = random_poses(60, 1)
        start[:, :3] = 9 * unit(RNG.normal(size=(60, 3)) + [0, 0, 1.5])
        twists = np.concatenate([RNG.uniform(-3, 3, (60, 3)) - start[:, :3], RNG.normal(size=(60, 3))], 1)
        twists[:20, 3:] = 0
        r = scene.time_of_impact(probe, start, twists, t_max=1.5)
        each = mk.times_of_impact(probe, start[:, None], twists[:, None], bodies, poses[None], None, 1.5)
        t = np.concatenate([each.t_hi, np.array([[self.ground_time(probe, s, w)] for s, w in zip(start, twists)])], axis=1)
        met = np.isfinite(t.min(1))
        self.assertTrue(20 < met.sum())
        np.testing.assert_array_equal(r.object[met], t.argmin(1)[met])
        np.testing.assert_allclose(r.t_hi[met], t.min(1)[met], atol=1e-6)
        self.assertTrue((r.object[~met] == mk.NO_OBJECT).all() and (r.status[~met] == mk.NO_IMPACT).all())
        self.assertTrue((r.t_lo <= r.t_hi).all() and (r.t_lo[~met] == 1.5).all())

    @staticmethod
    def ground_time(shape, pose, twist):
        """By many steps and bisection."""
        def height(t):
            angle = np.linalg.norm(twist[3:]) * t
            axis = twist[3:] / (np.linalg.norm(twist[3:]) or 1)
            turn = np.concatenate([[np.cos(angle / 2)], np.sin(angle / 2) * axis])
            return to_ground(shape, np.concatenate([pose[:3] + t * twist[:3], product(turn, pose[3:])]))
        times = np.linspace(0, 1.5, 151)
        below = [height(t) < 0 for t in times]
        if not any(below):
            return np.inf
        first = below.index(True)
        if first == 0:
            return 0.0
        low, high = times[first - 1], times[first]
        for _ in range(50):
            middle = (low + high) / 2
            low, high = (low, middle) if height(middle) < 0 else (middle, high)
        return high

    def test_tell_points_of_contact(self):
        scene = mk.Scene()
        box = scene.add(mk.box([0.5, 0.4, 0.3]), [[1, 0, 0, 2], [0, 1, 0, 1], [0, 0, 1, 0.29]])
        ground = scene.add_half_space([0, 0, 1], 0)
        top = scene.add(mk.box([0.2, 0.2, 0.2]), [[1, 0, 0, 2], [0, 1, 0, 1], [0, 0, 1, 0.79]])
        for m, sign in ((scene.manifold(box, ground), -1), (scene.manifold(ground, box), 1)):
            self.assertEqual(int(m.count), 4)
            np.testing.assert_allclose(m.normal, [0, 0, sign], atol=1e-12)
            np.testing.assert_allclose(m.gaps, -0.01, atol=1e-9)
            self.assertAlmostEqual(m.value, -0.01)
            self.assertEqual({tuple(p) for p in m.points[:, :2].round(6)}, {(2 + x, 1 + y) for x in (-0.5, 0.5) for y in (-0.4, 0.4)})
        m = scene.manifold(box, top)
        self.assertEqual((int(m.count), len(m), len(list(m))), (4, 4, 4))
        for k, one in enumerate(m):
            self.assertEqual((len(one), float(one.gaps), float(one.value)), (1, float(m.gaps[k]), float(m.value)))
            np.testing.assert_array_equal(one.points_a, m.points_a[k])
        np.testing.assert_array_equal(m[1:3].points, m.points[1:3])
        self.assertEqual(len(m[1:3]), 2)
        with self.assertRaises(IndexError):
            m[4]

    def test_without_an_object_have_no_derivative(self):
        scene = mk.Scene()
        scene.add(mk.sphere(1))
        far, ball = [9, 0, 0, 1, 0, 0, 0], mk.sphere(1)
        for r in (scene.distance_to(ball, far, within=1, jac=True, jac_error=True),
                  scene.nearest(far[:3], within=1, jac=True, jac_error=True),
                  scene.time_of_impact(ball, far, [1, 0, 0, 0, 0, 0], jac=True, jac_error=True)):
            self.assertTrue((r.object == mk.NO_OBJECT).all())
            self.assertTrue(np.isnan(r.jac).all() and np.isnan(r.jac_error).all() and not r.is_ridge.any())

    def test_are_told_of_and_stopped(self):
        rng = np.random.default_rng(3)
        cone, at = mk.cone(0.5, 1), np.concatenate([rng.uniform(-2, 2, (300, 3)), rng.normal(size=(300, 4))], 1)
        scene = mk.Scene()
        for pose in matrices(at[:60]):
            scene.add(mk.ellipsoid([1, 0.6, 0.4]), pose)
        for work in (lambda told: scene.distances(within=9, threads=1, progress=told),
                     lambda told: scene.distances([[0, 1]] * 3000, threads=1, jac=True, progress=told),
                     lambda told: scene.distance_to(cone, at, threads=1, progress=told),
                     lambda told: scene.nearest(np.tile(at[:, :3], (5, 1)), k=9, threads=1, progress=told),
                     lambda told: scene.time_of_impact(cone, at + [9, 0, 0, 0, 0, 0, 0], [-3, 0, 0, 0, 1, 0], 3, threads=1, progress=told)):
            heard = []
            work(heard.append)
            self.assertTrue(len(heard) >= 2 and heard == sorted(heard) and heard[-1] == 1, heard)
            with self.assertRaisesRegex(mk.Error, "stopped"):
                work(lambda done: True)

    def test_derivatives_are_told_about_the_objects_origins(self):
        scene, bodies, poses = random_scene(30, 7)
        r = scene.distances(within=0.8, jac=True)
        plain = scene.distances(within=0.8)
        np.testing.assert_array_equal(r.value, plain.value)
        grounded = np.flatnonzero((r.object_b == 30) & ~r.is_ridge)
        self.assertGreater(len(grounded), 0)
        for i in grounded:
            a = int(r.object_a[i])
            for axis in range(6):
                f = lambda s: to_ground(bodies[a], moved(poses[a:a + 1], axis, s)[0])
                self.assertLess(off_slope(f, r.jac_a[i, axis]), 1e-6)


if __name__ == "__main__":
    unittest.main()
