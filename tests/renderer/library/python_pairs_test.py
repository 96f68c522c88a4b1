# SPDX-License-Identifier: MIT
"""Pairs of shapes, many at once and of scenes: python_pairs_test.py (PYTHONPATH: the module's folder)."""
import unittest

import numpy as np

import minkray as mk

RNG = np.random.default_rng(63)


def unit(rows):
    return rows / np.linalg.norm(rows, axis=-1, keepdims=True)


def random_poses(count, reach=3.0, rng=RNG):
    """(x, y, z, qw, qx, qy, qz)."""
    return np.concatenate([rng.uniform(-reach, reach, (count, 3)), unit(rng.normal(size=(count, 4)))], axis=1)


def matrices(poses):
    w, x, y, z = poses[..., 3:].T
    turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    matrix = np.zeros((len(poses), 4, 4))
    matrix[:, :3, :3] = np.moveaxis(turn, 2, 0)
    matrix[:, :3, 3] = poses[:, :3]
    matrix[:, 3, 3] = 1
    return matrix


def product(p, q):
    (a, b, c, d), (e, f, g, h) = np.moveaxis(p, -1, 0), np.moveaxis(q, -1, 0)
    return np.stack([a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g,
                     a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e], axis=-1)


def moved(poses, axis, by):
    """By a twist along one of its six axes."""
    poses = np.array(poses)
    if axis < 3:
        poses[:, axis] += by
        return poses
    turn = np.zeros(4)
    turn[0], turn[axis - 2] = np.cos(by / 2), np.sin(by / 2)
    poses[:, 3:] = product(turn, poses[:, 3:])
    return poses


def slope(f, step):
    """Of fourth order."""
    return (8 * (f(step) - f(-step)) - (f(2 * step) - f(-2 * step))) / (12 * step)


def off_slope(f, jac):
    """The least difference over some steps: one is near a kink of the second derivative, by chance."""
    with np.errstate(invalid="ignore"):
        off = np.abs([slope(f, step) - jac for step in (1e-4, 1e-5, 1e-6)])
    return np.where(np.isnan(off), np.inf, off).min(0)  # beside the rays of a miss there is no slope


def some_shapes():
    return {"sphere": mk.sphere(0.6), "capsule": mk.capsule(0.3, 0.5), "box": mk.box([0.7, 0.5, 0.3]),
            "cylinder": mk.cylinder(0.5, 0.6), "cone": mk.cone(0.6, 0.6), "ellipsoid": mk.ellipsoid([0.8, 0.5, 0.3]),
            "hull": mk.hull(0.8 * unit(np.random.default_rng(5).normal(size=(24, 3)))),
            "rounded": mk.rounded(mk.box([0.5, 0.4, 0.2]), 0.2), "sum": mk.sum(mk.box([0.3, 0.2, 0.4]), mk.disk(0.3))}


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
        self.assertEqual(int(scene.manifold(box, top).count), 4)

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
                (r"^signed_distances: pose_a: must be poses", lambda: mk.signed_distances(ball, np.eye(3), ball, None)),
                (r"^signed_distances: pose_a\[0\]: the last row", lambda: mk.signed_distances(ball, np.ones((4, 4)), ball, None)),
                (r"^signed_distances: .*as many", lambda: mk.signed_distances(ball, nine, ball, nine[:4])),
                (r"^signed_distances: .*as many", lambda: mk.signed_distances([ball] * 3, nine, ball, None)),
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
