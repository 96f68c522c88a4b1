# SPDX-License-Identifier: MIT
"""Promises of the Python module: python_test.py SOURCES (PYTHONPATH: the module's folder)."""
import os
import pickle
import signal
import sys
import tempfile
import threading
import time
import tracemalloc
import unittest

import numpy as np

import minkray as mk

SOURCES = sys.argv.pop(1)


def rays_around(count, radius=3.0, seed=1):
    rng = np.random.default_rng(seed)
    away = rng.normal(size=(count, 3))
    origins = 4 * radius * away / np.linalg.norm(away, axis=1, keepdims=True)
    return np.concatenate([origins, rng.uniform(-radius, radius, (count, 3)) / 2 - origins], axis=1)


def box(n):
    return np.copysign([0.5, 0.3, 0.2], n)


class Rays(unittest.TestCase):
    def setUp(self):
        self.scene = mk.Scene()
        self.scene.add_json(os.path.join(SOURCES, "scenes/shape-zoo.json"))
        self.rays = rays_around(5000, 6)

    def test_answers_are_the_same_bits_for_any_cut_threads_and_layout(self):
        whole = self.scene.cast_rays(self.rays)
        parts = [self.scene.cast_rays(self.rays[i:i + 77], threads=1) for i in range(0, 5000, 77)]
        for name in vars(whole):
            np.testing.assert_array_equal(getattr(whole, name),
                                          np.concatenate([getattr(part, name) for part in parts]))
        apart = np.empty((5000, 12))[:, ::2]  # no row lies in one piece
        apart[:] = self.rays
        np.testing.assert_array_equal(self.scene.cast_rays(apart).t, whole.t)
        image = self.scene.cast_rays(self.rays.reshape(50, 100, 6))
        self.assertEqual(image.normal.shape, (50, 100, 3))
        np.testing.assert_array_equal(image.t.ravel(), whole.t)

    def test_misses_are_inf_and_hits_are_proven(self):
        hits = self.scene.cast_rays(self.rays)
        met = hits.status == mk.HIT
        self.assertTrue(0.2 < met.mean() < 0.8, met.mean())
        self.assertTrue(np.isinf(hits.t[hits.status == mk.MISS]).all())
        self.assertTrue((hits.object[hits.status == mk.MISS] == mk.NO_OBJECT).all())
        self.assertTrue((hits.t_lo[met] <= hits.t[met]).all() and (hits.t[met] <= hits.t_hi[met]).all())
        np.testing.assert_allclose(hits.distance[met],
                                   hits.t[met] * np.linalg.norm(self.rays[met, 3:], axis=1))
        np.testing.assert_array_equal(self.scene.occluded(self.rays), hits.status != mk.MISS)
        proofs = self.scene.certify(self.rays[:500])
        self.assertGreater(proofs.holds.mean(), 0.99)

    def test_ends_are_numbers_or_arrays(self):
        hits = self.scene.cast_rays(self.rays)
        met = hits.status == mk.HIT
        short = self.scene.cast_rays(self.rays, t_max=np.where(met, hits.t * 0.999, 10.0))
        self.assertFalse((short.t[met] == hits.t[met]).any())
        self.assertTrue((self.scene.cast_rays(self.rays, t_max=0.0).status != mk.HIT).all())

    def test_of_floats_have_the_answers_of_the_same_numbers_in_double(self):
        floats = self.rays.astype(np.float32)
        doubles = floats.astype(np.float64)
        ends = np.linspace(10, 30, 5000, dtype=np.float32)
        padded = np.zeros((5000, 9), np.float32)
        padded[:, 2:8] = floats
        swapped = floats.astype(floats.dtype.newbyteorder())
        for t_max in (None, 20.25, ends):
            expected = self.scene.cast_rays(doubles, None if t_max is None else np.float64(t_max))
            self.assertGreater((expected.status == mk.HIT).sum(), 500)
            for rays in (floats, padded[:, 2:8], np.asfortranarray(floats), swapped):
                found = self.scene.cast_rays(rays, t_max)
                for name in vars(expected):
                    np.testing.assert_array_equal(getattr(found, name), getattr(expected, name), name)
        np.testing.assert_array_equal(self.scene.occluded(floats[::-1]), self.scene.occluded(doubles[::-1]))
        np.testing.assert_array_equal(self.scene.certify(floats[:99], t_max=ends[:99]).t_hi,
                                      self.scene.certify(doubles[:99], t_max=ends[:99]).t_hi)
        np.testing.assert_array_equal(self.scene.all_hits(floats, ends).t, self.scene.all_hits(doubles, ends).t)
        floats[7, 4] = np.nan
        with self.assertRaisesRegex(mk.Error, r"Scene.cast_rays: rays\[7\].direction\[1\]: must be a finite"):
            self.scene.cast_rays(floats)

    def test_of_either_type_are_not_copied(self):
        rays = np.tile(self.rays, (20, 1))
        wide = np.zeros((len(rays), 9), np.float32)
        wide[:, 2:8] = rays
        for given in (rays, rays[::2], rays.astype(np.float32), wide[:, 2:8], wide[::3, 2:8]):
            ends = np.full(len(given), 20, given.dtype)
            tracemalloc.start()
            self.scene.occluded(given, ends)
            _, peak = tracemalloc.get_traced_memory()
            tracemalloc.stop()
            self.assertLess(peak, 4 * len(given) + 100000)  # a byte or two per ray are the answers

    def test_threads_of_python_ask_at_once(self):
        expected = self.scene.cast_rays(self.rays, threads=1).t
        found = [None] * 4
        def ask(i):
            found[i] = self.scene.cast_rays(self.rays, threads=1).t
        threads = [threading.Thread(target=ask, args=(i,)) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for t in found:
            np.testing.assert_array_equal(t, expected)

    def test_ctrl_c_stops_a_long_cast(self):
        many = np.tile(self.rays, (2000, 1))
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            self.scene.cast_rays(many, threads=1)
        self.assertLess(time.monotonic() - begin, 5)


class Interrupts(unittest.TestCase):
    def test_stop_casts_at_shapes_of_ones_own_and_leave_these_as_they_are(self):
        def slow_box(n):
            begin = time.monotonic()
            while time.monotonic() < begin + 0.002:  # in the interpreter, where signals arrive
                pass
            return box(n)

        scene = mk.Scene()
        scene.add(mk.custom(slow_box))
        rays = rays_around(200000, 0.9)
        for threads in 1, 0:
            timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
            timer.start()
            begin = time.monotonic()
            with self.assertRaises(KeyboardInterrupt):
                scene.cast_rays(rays, threads=threads)
            self.assertLess(time.monotonic() - begin, 10)
            self.assertEqual(scene.cast_rays([[-4, 0, 0, 1, 0, 0]]).t[0], 3.5)


class Shapes(unittest.TestCase):
    def test_are_pickled_and_shown(self):
        shape = mk.hull_of(mk.rounded(mk.box([0.1, 0.2, 0.3]), 1 / 3), mk.translated(mk.cone(1, 2), [0, 0, 1]))
        again = pickle.loads(pickle.dumps(shape))
        n = np.random.default_rng(1).normal(size=(100, 3))
        np.testing.assert_array_equal(shape.support(n), again.support(n))
        self.assertIn("hull_of", repr(shape))

    def test_of_every_kind_are_made(self):
        for shape in (mk.point([1, 2, 3]), mk.segment([0, 0, 0], [1, 0, 0]),
                      mk.triangle([0, 0, 0], [1, 0, 0], [0, 1, 0]), mk.sphere(1), mk.ellipsoid([1, 2, 3]),
                      mk.box([1, 2, 3]), mk.disk(1), mk.cylinder(1, 2), mk.cut_cylinder(1, [-1, 1], [0.1, 0]),
                      mk.cone(1, 2), mk.capsule(1, 2), mk.tapered_capsule([1, 0.5], 2),
                      mk.frustum([1, 0.5], 2), mk.superellipsoid([1, 1, 2], 3),
                      mk.hull(np.eye(3)), mk.rounded(mk.sphere(1), 0.5), mk.sum(mk.sphere(1), mk.disk(1)),
                      mk.difference(mk.sphere(1), mk.disk(1)), mk.hull_of(mk.sphere(1), mk.disk(2)),
                      mk.scaled(mk.sphere(1), [1, 2, 3]), mk.swept(mk.sphere(1), [1, 0, 0])):
            lower, upper = shape.bounds()
            self.assertTrue((lower <= upper).all())

    def test_of_ones_own_answer_as_ours(self):
        ours, mine = mk.Scene(), mk.Scene()
        ours.add(mk.box([0.5, 0.3, 0.2]))
        mine.add(mk.custom(box, bounds=[[-0.5, -0.3, -0.2], [0.5, 0.3, 0.2]]))
        rays = rays_around(2000, 0.9)
        a, b = ours.cast_rays(rays), mine.cast_rays(rays)
        np.testing.assert_array_equal(a.status, b.status)
        met = a.status == mk.HIT
        self.assertTrue(0.2 < met.mean() < 0.9, met.mean())
        self.assertTrue((a.t_lo[met] <= b.t_hi[met] * (1 + 4e-16)).all())
        self.assertTrue((b.t_lo[met] <= a.t_hi[met] * (1 + 4e-16)).all())
        self.assertTrue(mine.certify(rays[:200]).holds.all())

    def test_of_ones_own_that_lie_or_raise_are_told(self):
        for support, text in ((lambda n: -n, "not maximal"), (lambda n: n * np.nan, "not finite"),
                              (lambda n: n[:, :2], "(16, 3)"), (lambda n: 1 / 0, "ZeroDivisionError"),
                              (lambda n: "no", "failed")):
            with self.assertRaises(mk.Error) as raised:
                mk.custom(support)
            self.assertIn(text, str(raised.exception))


class Pairs(unittest.TestCase):
    def test_distances_of_many_poses(self):
        poses = np.tile(np.eye(4), (5, 1, 1))
        poses[:, 0, 3] = [1.5, 2.0, 2.5, 3.0, 3.5]
        d = mk.signed_distance(mk.sphere(1), None, mk.box([1, 1, 1]), poses)
        np.testing.assert_allclose(d.value, poses[:, 0, 3] - 2, atol=1e-9)
        self.assertTrue((d.lower <= d.value).all() and (d.value <= d.upper).all())
        one = mk.signed_distance(mk.sphere(1), None, mk.box([1, 1, 1]), poses[3])
        self.assertEqual(one.status, mk.SEPARATED)

    def test_time_of_impact(self):
        pose = np.eye(4)
        pose[0, 3] = 4
        hit = mk.time_of_impact(mk.sphere(1), None, None, mk.sphere(1), pose, [-1, 0, 0, 0, 0, 1], t_max=5)
        self.assertEqual(hit.status, mk.IMPACT)
        self.assertAlmostEqual(hit.t_lo, 2, places=8)


class Files(unittest.TestCase):
    def test_robots_move_by_their_joints(self):
        scene = mk.Scene()
        arm = scene.add_urdf(os.path.join(SOURCES, "examples/arm.urdf"))
        self.assertEqual(arm.joint_names, ["shoulder", "elbow"])
        ray = [[5, 0, 1, -1, 0, 0]]
        straight = scene.cast_rays(ray).t[0]
        arm.joints = {"elbow": 1.5}
        self.assertNotEqual(scene.cast_rays(ray).t[0], straight)
        arm.joints = [0, 0]
        self.assertEqual(scene.cast_rays(ray).t[0], straight)

    def test_point_clouds_are_written(self):
        points = np.random.default_rng(1).normal(size=(10, 3))
        with tempfile.TemporaryDirectory() as folder:
            for ending in "pcd", "ply", "npy":
                name = os.path.join(folder, "cloud." + ending)
                mk.write(name, points, object=np.arange(10, dtype=np.uint32))
                self.assertGreater(os.path.getsize(name), 10 * 16)
            rows = np.load(name)
        np.testing.assert_array_equal(rows["object"], np.arange(10))
        np.testing.assert_allclose(rows["x"], points[:, 0], rtol=1e-6)


class Hostile(unittest.TestCase):
    """Values that did harm, or were taken for others without a word."""

    def test_no_poses_are_no_pairs(self):  # memory was read where no pose is
        ball = mk.sphere(1)
        none = np.zeros((0, 4, 4))
        for a, b in [(none, None), (None, none), (none, none), (np.eye(4)[None], none)]:
            self.assertEqual(np.shape(mk.signed_distance(ball, a, ball, b).value), (0,))

    def test_names_do_not_end_at_a_zero(self):  # the file before the zero was read
        scene = mk.Scene()
        arm = os.path.join(SOURCES, "examples/arm.urdf")
        for call in (lambda: scene.add_file(arm + "\0.json"), lambda: scene.add_file(arm, package_dirs=["a\0"]),
                     lambda: scene.add(mk.sphere(1), name="a\0b"), lambda: mk.lidar("a\0.csv"),
                     lambda: scene.add_half_space([0, 0, 1], name="\0")):
            with self.assertRaisesRegex(ValueError, "zero"):
                call()
        self.assertEqual(len(scene), 0)
        scene.add_file(os.fsencode(arm))  # "b'...'" was not there
        self.assertGreater(len(scene), 0)

    def test_columns_do_not_write_the_header(self):
        file = os.path.join(tempfile.mkdtemp(), "two.ply")
        for columns in ({"a b": [1, 2]}, {"a\nend_header": [1, 2]}, {"x": [1, 2]}, {"": [1, 2]},
                        {"a": [1, 2**40]}, {"a": [-2**31 - 1, 0]}):
            with self.assertRaises(ValueError, msg=columns):
                mk.write(file, np.zeros((2, 3)), **columns)
        self.assertFalse(os.path.exists(file))
        mk.write(file, np.zeros((2, 3)), object=np.array([0, mk.NO_OBJECT], np.uint32))

    def test_rays_may_lie_anywhere_in_memory(self):
        scene = mk.Scene()
        scene.add(mk.sphere(1))
        ray = np.array([[-5.0, 0, 0, 1, 0, 0]] * 3)
        askew = np.frombuffer(b"_" + ray.tobytes(), offset=1).reshape(3, 6)
        self.assertFalse(askew.flags.aligned)
        np.testing.assert_array_equal(scene.cast_rays(askew).t, 4)
        np.testing.assert_array_equal(mk.sphere(1).support(askew[:, 3:]), [[1, 0, 0]] * 3)

    def test_answers_that_are_no_numbers_are_told(self):
        for answer in ("x", None, object()):
            with self.assertRaisesRegex(mk.Error, "array of numbers of shape"):
                mk.custom(lambda n: answer)
        with self.assertRaisesRegex(mk.Error, r"half_extents/1: must be a finite number \(got nan\)"):
            mk.box([1, np.nan, 1])
        with self.assertRaisesRegex(ValueError, "lowest, highest"):
            mk.lidar((1, 2, 3))


class Mistakes(unittest.TestCase):
    def expect(self, text, work, kind=ValueError):
        with self.assertRaises(kind) as raised:
            work()
        self.assertIn(text, str(raised.exception))

    def test_say_what_and_where(self):
        scene = mk.Scene()
        scene.add(mk.sphere(1))
        self.expect("rays: must have the shape", lambda: scene.cast_rays([[1, 2, 3]]))
        self.expect("rays[1].direction[0]", lambda: scene.cast_rays([[1] * 6, [0, 0, 0, np.nan, 0, 0]]))
        self.expect("t_max", lambda: scene.cast_rays([[1.0] * 6], t_max=-1))
        self.expect("pose: must be a (4, 4) matrix", lambda: scene.add(mk.sphere(1), pose=np.eye(3)))
        self.expect("invertible", lambda: scene.add(mk.sphere(1), pose=np.diag([1, 1, 0, 1])))
        self.expect("radius: must be > 0", lambda: mk.sphere(-1))
        self.expect("half_extents", lambda: mk.box([1, 2]))
        self.expect("no-such.json", lambda: scene.add_json("no-such.json"))
        self.expect("shape: must be a Shape", lambda: scene.add("ball"))


if __name__ == "__main__":
    unittest.main()
