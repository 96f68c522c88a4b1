# SPDX-License-Identifier: MIT
"""Many pairs of shapes at once, and what is wrong with a question: python_pairs_test.py (PYTHONPATH: the module's folder)."""
import unittest

import numpy as np

import minkray as mk
from pairs_support import RNG, matrices, moved, random_poses, some_shapes, unit


class Batches(unittest.TestCase):
    def test_are_the_bits_of_each_pair_by_itself(self):
        a, b = mk.box([1, 0.5, 0.3]), mk.cone(0.6, 0.7)
        A, B = matrices(random_poses(200)), matrices(random_poses(200))
        many = mk.signed_distances(a, A, b, B)
        self.assertTrue((many.status == mk.OVERLAPPING).any() and (many.status == mk.SEPARATED).any())
        for i in range(200):
            one = mk.signed_distance(a, A[i], b, B[i])
            for name in "value", "lower", "upper", "point_a", "point_b", "normal", "status":
                np.testing.assert_array_equal(getattr(many, name)[i], getattr(one, name))
        self.assertEqual(many, mk.signed_distances(a, A, b, B, threads=1))
        self.assertEqual(many, mk.signed_distances(a, A, b, B, threads=3))

    def test_of_balls_are_what_anybody_can_work_out(self):
        p, q = RNG.uniform(-5, 5, (2, 1000, 3))
        r = RNG.uniform(0.1, 3, (2, 1000))
        pose = lambda at: np.concatenate([at, np.tile([1.0, 0, 0, 0], (1000, 1))], axis=1)
        d = mk.signed_distances([mk.sphere(x) for x in r[0]], pose(p), [mk.sphere(x) for x in r[1]], pose(q), jac=True)
        expected = np.linalg.norm(q - p, axis=1) - r.sum(0)
        np.testing.assert_allclose(d.value, expected, atol=1e-13)
        self.assertTrue((d.lower <= expected + 1e-14).all() and (expected - 1e-14 <= d.upper).all())
        np.testing.assert_allclose(d.jac_b[:, :3], unit(q - p), atol=1e-12)
        np.testing.assert_allclose(d.jac_a, -d.jac_b, atol=1e-12)
        np.testing.assert_allclose(d.jac_b[:, 3:], 0, atol=1e-12)

    def test_go_together_as_arrays_of_numpy_do(self):
        poses = random_poses(12)
        ball, box = mk.sphere(1), mk.box([1, 2, 3])
        grid = mk.signed_distances(ball, poses[:3, None], box, poses[None, 3:])
        self.assertEqual((grid.value.shape, grid.normal.shape), ((3, 9), (3, 9, 3)))
        for i in range(3):
            np.testing.assert_array_equal(grid.value[i], mk.signed_distances(ball, poses[i], box, poses[3:]).value)
        rows = matrices(poses)
        for same in (rows, rows[:, :3], np.asfortranarray(rows), list(rows), rows[::-1][::-1]):
            np.testing.assert_allclose(mk.signed_distances(ball, same, box, None).value,
                                       mk.signed_distances(ball, poses, box, None).value, atol=1e-14)
        both = mk.signed_distances([ball, box], None, box, poses[0])
        self.assertEqual(both.value[0], mk.signed_distances(ball, None, box, poses[0]).value[0])
        self.assertEqual(mk.signed_distances(ball, np.zeros((0, 7)), box, None).value.shape, (0,))
        twice = poses.copy()
        twice[:, 3:] *= 2
        np.testing.assert_allclose(mk.signed_distances(ball, twice, box, None).value,
                                   mk.signed_distances(ball, poses, box, None).value, atol=1e-14)

    def test_fill_arrays_that_are_given(self):
        poses = random_poses(50)
        ball, box = mk.sphere(1), mk.box([1, 2, 3])
        expected = mk.signed_distances(ball, None, box, poses, jac=True)
        again = mk.signed_distances(ball, None, box, poses[::-1], jac=True)
        values = again.value
        self.assertIs(mk.signed_distances(ball, None, box, poses, jac=True, out=again), again)
        self.assertEqual(again, expected)
        self.assertIs(again.value, values)
        mine = np.empty(50)
        part = mk.signed_distances(ball, None, box, poses, out={"value": mine})
        self.assertIs(part.value, mine)
        self.assertEqual(list(vars(part)), ["value"])
        lower = mk.signed_distances(ball, None, box, poses, out={"lower": mine})
        self.assertEqual(repr(lower), "<minkray.Distances with lower>")
        self.assertEqual(repr(mk.manifolds(ball, None, box, poses, out={"lower": mine})), "<minkray.Manifolds with lower>")
        for out, names in ((mk.signed_distances(ball, None, box, poses), "jac_a, jac_b, is_ridge"), (again, "jac_error_a, jac_error_b")):
            with self.assertRaisesRegex(mk.Error, f"^signed_distances: out: must have {names}, "):
                mk.signed_distances(ball, None, box, poses, jac=True, jac_error=out is again, out=out)

    def test_are_told_of_and_stopped(self):
        poses = random_poses(200000)
        heard = []
        mk.signed_distances(mk.box([1, 2, 3]), None, mk.cone(1, 1), poses, threads=1, progress=heard.append)
        self.assertTrue(len(heard) >= 2 and heard == sorted(heard) and heard[-1] == 1, heard)
        with self.assertRaisesRegex(mk.Error, "stopped"):
            mk.signed_distances(mk.box([1, 2, 3]), None, mk.cone(1, 1), poses, threads=1, progress=lambda done: True)
        with self.assertRaises(ZeroDivisionError):
            mk.signed_distances(mk.box([1, 2, 3]), None, mk.cone(1, 1), poses, threads=1, progress=lambda done: 1 / 0)

    def test_begin_with_what_the_last_one_left(self):
        hull = some_shapes()["hull"]
        memory = mk.pair_memory(100)
        poses = random_poses(100)
        for frame in range(5):
            poses = moved(poses, frame, 1e-3)
            warm = mk.signed_distances(hull, None, hull, poses, memory=memory)
            cold = mk.signed_distances(hull, None, hull, poses)
            np.testing.assert_allclose(warm.value, cold.value, atol=1e-9)
        self.assertTrue((memory != 0).any())
        self.assertLess(warm.supports.sum(), cold.supports.sum())
        memory[:] = np.frombuffer(RNG.bytes(memory.nbytes)).reshape(memory.shape)
        garbage = mk.signed_distances(hull, None, hull, poses, memory=memory)
        np.testing.assert_allclose(garbage.value, cold.value, atol=1e-9)

    def test_of_impacts_are_those_of_each(self):
        A, B = random_poses(100), random_poses(100)
        twists = RNG.normal(size=(2, 100, 6))
        twists[0, :, :3] += B[:, :3] - A[:, :3]
        a, b = mk.box([0.4, 0.5, 0.3]), mk.cylinder(0.3, 0.4)
        ends = RNG.uniform(0, 4, 100)
        many = mk.times_of_impact(a, A, twists[0], b, B, twists[1], ends)
        self.assertGreater((many.status == mk.IMPACT).sum(), 5)
        for i in range(100):
            one = mk.time_of_impact(a, matrices(A)[i], twists[0, i], b, matrices(B)[i], twists[1, i], ends[i])
            self.assertEqual(many.status[i], one.status)
            np.testing.assert_allclose(many.t_lo[i], one.t_lo, atol=1e-9)
        self.assertEqual(many, mk.times_of_impact(a, A, twists[0], b, B, twists[1], ends, threads=1))

    def test_of_shapes_of_ones_own(self):
        mine = mk.custom(lambda n: np.copysign([0.5, 0.3, 0.2], n))
        poses = random_poses(40)
        d = mk.signed_distances(mine, None, mk.sphere(0.3), poses)
        np.testing.assert_allclose(d.value, mk.signed_distances(mk.box([0.5, 0.3, 0.2]), None, mk.sphere(0.3), poses).value,
                                   atol=1e-9)

    def test_of_manifolds_are_corners(self):
        table, box = mk.box([5, 5, 1]), mk.box([0.5, 0.4, 0.3])
        poses = np.array([[1, 2, 1.3, 1, 0, 0, 0], [0, 0, 1.25, 1, 0, 0, 0], [0, 0, 9, 1, 0, 0, 0]])
        m = mk.manifolds(table, None, box, poses)
        np.testing.assert_array_equal(m.count, 4)
        for i, gap in enumerate((0, -0.05, 7.7)):
            corners = [[x, y, -0.3] for x in (-0.5, 0.5) for y in (-0.4, 0.4)]
            found = m.points_b[i] - poses[i, :3]
            # One of them may be the nearest point, which is anywhere on the face.
            at_corner = np.abs(found[:, None] - corners).max(2).min(1) < 1e-12
            self.assertGreaterEqual(at_corner.sum(), 3)
            self.assertTrue((np.abs(found[:, :2]) <= [0.5 + 1e-12, 0.4 + 1e-12]).all())
            np.testing.assert_allclose(m.gaps[i], gap, atol=1e-12)
        np.testing.assert_allclose(m.normal, [[0, 0, 1]] * 3, atol=1e-12)
        np.testing.assert_allclose(m.points, (m.points_a + m.points_b) / 2)
        ball = mk.manifolds(table, None, mk.sphere(1), poses[:1])
        self.assertEqual(ball.count[0], 1)
        self.assertTrue(np.isnan(ball.points[0, 1:]).all())


class Mistakes(unittest.TestCase):
    def test_are_told_with_the_argument(self):
        ball, nine = mk.sphere(1), random_poses(9)
        bad = matrices(nine)
        bad[4, 1, 2] = np.nan
        long = nine.copy()
        long[2, 3:] = 0
        scene = mk.Scene()
        scene.add(ball)
        scene.add(ball)
        scene.add_half_space([0, 0, 1])
        scene.add_half_space([0, 0, 1])
        gone = scene.add(ball)
        scene.remove(gone)
        d = mk.signed_distances(ball, nine, ball, None)
        for text, work in (
                (r"^signed_distances: pose_a\[4\]\[1\]\[2\]: must be a finite", lambda: mk.signed_distances(ball, bad, ball, None)),
                (r"^signed_distances: pose_b\[0\]: must be rigid", lambda: mk.signed_distances(ball, None, ball, np.diag([2.0, 1, 1, 1]))),
                (r"^manifolds: pose_b\[2\]: .*quaternion", lambda: mk.manifolds(ball, None, ball, long)),
                (r"^signed_distances: pose_a: must be a .4, 4. matrix", lambda: mk.signed_distances(ball, np.eye(3), ball, None)),
                (r"^signed_distances: pose_a\[0\]: the last row", lambda: mk.signed_distances(ball, np.ones((4, 4)), ball, None)),
                (r"^signed_distances: .*same length", lambda: mk.signed_distances(ball, nine, ball, nine[:4])),
                (r"^signed_distances: .*same length", lambda: mk.signed_distances([ball] * 3, nine, ball, None)),
                (r"^signed_distances: a: must be a Shape", lambda: mk.signed_distances("ball", None, ball, None)),
                (r"^signed_distances: a\[1\]: must be a Shape", lambda: mk.signed_distances([ball, 3], None, ball, None)),
                (r"^signed_distances: tolerance", lambda: mk.signed_distances(ball, None, ball, None, tolerance=-1)),
                (r"^signed_distances: threads", lambda: mk.signed_distances(ball, None, ball, None, threads=-1)),
                (r"^signed_distances: out", lambda: mk.signed_distances(ball, None, ball, None, out=d)),
                (r"^signed_distances: out", lambda: mk.signed_distances(ball, None, ball, None, out={"value": [1.0]})),
                (r"^signed_distances: memory", lambda: mk.signed_distances(ball, None, ball, None, memory=np.zeros(8))),
                (r"^signed_distances: progress", lambda: mk.signed_distances(ball, None, ball, None, progress=1)),
                (r"^signed_distances: .*must be called as", lambda: mk.signed_distances(ball, None, ball)),
                (r"^times_of_impact: t_max", lambda: mk.times_of_impact(ball, None, None, ball, None, None, -1)),
                (r"^times_of_impact: twist_b", lambda: mk.times_of_impact(ball, None, None, ball, None, [1, 2, 3])),
                (r"^Scene.nearest: k: must be at least 1", lambda: scene.nearest([0, 0, 0], k=0)),
                (r"^Scene.nearest: points", lambda: scene.nearest([0, 0])),
                (r"^Scene.nearest: points\[2\]", lambda: scene.nearest([0, 0, np.nan])),
                (r"^Scene.distances: within", lambda: scene.distances(within=-1)),
                (r"^Scene.distances: within", lambda: scene.distances(within=np.nan)),
                (r"^Scene.distances: pairs", lambda: scene.distances([1, 2, 3])),
                (r"^Scene.distances: pairs\[0\]\[1\]: must be less than 5", lambda: scene.distances([[0, 9]])),
                (r"^Scene.distances: pairs\[1\]: must be two objects", lambda: scene.distances([[0, 1], [1, 1]])),
                (r"^Scene.distances: pairs\[0\]\[0\]: .*removed", lambda: scene.distances([[4, 1]])),
                (r"^Scene.distances: pairs\[0\]: .*half-spaces", lambda: scene.distances([[2, 3]])),
                (r"^Scene.manifold: j: .*half-space", lambda: scene.manifold(2, 3)),
                (r"^Scene.manifold: i: must be less than", lambda: scene.manifold(9, 1)),
                (r"^Scene.manifold: j: .*two objects", lambda: scene.manifold(1, 1)),
                (r"^Scene.allow: j: must be less than", lambda: scene.allow(0, 7)),
                (r"^Scene.set_masks: category", lambda: scene.set_masks(0, -1)),
                (r"^Scene.distance_to: poses\[4\]\[1\]\[2\]", lambda: scene.distance_to(ball, bad)),
                (r"^Scene.distance_to: shape: must be a Shape", lambda: scene.distance_to(1, nine)),
                (r"^Scene.time_of_impact: twists", lambda: scene.time_of_impact(ball, nine, [1, 2])),
                (r"^Scene.time_of_impact: t_max", lambda: scene.time_of_impact(ball, nine, [0] * 6, np.inf)),
        ):
            with self.assertRaisesRegex(mk.Error, text):
                work()


if __name__ == "__main__":
    unittest.main()
