# SPDX-License-Identifier: MIT
"""Calls of the Python module, right and wrong ones: python_calls_test.py SOURCES (PYTHONPATH: the module's folder)."""
import decimal
import io
import os
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import minkray as mk
from errors_support import ErrorCase

SOURCES = sys.argv.pop(1)


def at(x, y=0.0, z=0.0):
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def ball_scene():
    scene = mk.Scene()
    scene.add(mk.sphere(1), name="ball")
    return scene


class Mistakes(ErrorCase):
    """All are `minkray.Error`s that begin with the Python function's name and say which argument."""

    def test_of_shapes(self):
        ball = mk.sphere(1)
        for text, work in {
                "sphere: radius: must be > 0 (got -1": lambda: mk.sphere(-1),
                "sphere: radius: must be a number (got values of <U1)": lambda: mk.sphere("1"),
                "sphere: must be called as sphere(radius)": lambda: mk.sphere(),
                "box: must be called as box(half_extents)": lambda: mk.box(1, 2, 3),
                "box: half_extents": lambda: mk.box([1, 2]),
                "box: half_extents/1: must be a finite number (got nan)": lambda: mk.box([1, np.nan, 1]),
                "box: must be called as box(half_extents) (missing": lambda: mk.box(size=[1, 2, 3]),
                "sum: shapes[1]: must be a Shape (got int)": lambda: mk.sum(ball, 5),
                "sum: shapes[0]: must be a Shape (got str)": lambda: mk.sum(["a", ball]),
                "sum: shapes: must be at least one Shape": lambda: mk.sum(),
                "hull_of: shapes[2]": lambda: mk.hull_of([ball, ball, None]),
                "hull_of: shapes: must be at least one": lambda: mk.hull_of([]),
                "difference: b: must be a Shape (got float)": lambda: mk.difference(ball, 1.0),
                "rounded: shape: must be a Shape (got int)": lambda: mk.rounded(1, 2),
                "rounded: radius: must be": lambda: mk.rounded(ball, -1),
                "hull: points: must have the shape (N, 3) (got (2,))": lambda: mk.hull([1, 2]),
                "hull: points[1][2]: must be a finite number (got inf)": lambda: mk.hull([[0, 0, 0], [1, 1, np.inf]]),
                "segment: b: must have the shape (3,)": lambda: mk.segment([0, 0, 0], [1, 2]),
                "triangle: c[0]: must be a finite": lambda: mk.triangle([0] * 3, [1] * 3, [np.nan, 1, 2]),
                "transformed: matrix: must be a (4, 4) matrix": lambda: mk.transformed(ball, [1, 2, 3]),
                "transformed: matrix: must be invertible": lambda: mk.transformed(ball, np.diag([1, 0, 1, 1])),
                "scaled: by: must be invertible": lambda: mk.scaled(ball, 0),
                "translated: by: must have the shape (3,)": lambda: mk.translated(ball, 1),
                "swept: shape: must be a Shape": lambda: mk.swept(None, [1, 0, 0]),
                "custom: support: must be callable (got int)": lambda: mk.custom(5),
                "custom: bounds: must have the shape (2, 3)": lambda: mk.custom(lambda n: n, [[1, 2, 3]]),
                "make: kind: must be a str (got int)": lambda: mk.make(5),
                "make: kind: must be the name of a shape (got \"spere\"": lambda: mk.make("spere"),
                "make: radus: is not known": lambda: mk.make("sphere", radius=1, radus=2),
                "make: shapes: must be a dict": lambda: mk.make("sum", [ball]),
                "read_shape: json: must be a str": lambda: mk.read_shape(None),
                "read_shape: json: must be text that UTF-8": lambda: mk.read_shape("\ud800"),
                "read_shape: shape: ": lambda: mk.read_shape("{"),
                "Shape: must be made by functions such as minkray.box": lambda: mk.Shape(),
                "Shape.support: directions: must have the shape (N, 3)": lambda: ball.support([1, 0, 0]),
                "Shape.support: must be called as support(directions)": lambda: ball.support(),
                "Shape.json: shape: custom support functions cannot be written": lambda: mk.custom(lambda n: n).json()}.items():
            with self.subTest(text):
                self.expect(text, work)

    def test_of_scenes(self):
        scene = ball_scene()
        ball = mk.sphere(1)
        ray = [[-3, 0, 0, 1, 0, 0]]
        arm = mk.Scene()
        robot = arm.add_urdf(os.path.join(SOURCES, "examples/arm.urdf"))
        for text, work in {
                "Scene.add: shape: must be a Shape (got str)": lambda: scene.add("ball"),
                "Scene.add: pose: must be a (4, 4) matrix, or": lambda: scene.add(ball, [1, 2, 3]),
                "Scene.add: pose: must be invertible": lambda: scene.add(ball, np.diag([1, 1, 0, 1])),
                "Scene.add: pose: the last row": lambda: scene.add(ball, np.ones((4, 4))),
                "Scene.add: pose.rows[0][3]: must be a finite number (got nan)": lambda: scene.add(ball, at(np.nan)),
                "Scene.add: name: must be a str (got int)": lambda: scene.add(ball, name=5),
                "Scene.add: name: must be text that UTF-8 can hold": lambda: scene.add(ball, name="\ud800"),
                "Scene.add: name: must have no zero": lambda: scene.add(ball, name="a\0b"),
                "Scene.add_half_space: normal: must not be zero": lambda: scene.add_half_space([0, 0, 0]),
                "Scene.add_half_space: normal: must have": lambda: scene.add_half_space(5),
                "Scene.add_half_space: offset: must be a number": lambda: scene.add_half_space([0, 0, 1], [1, 2]),
                "Scene.add_json: file: must be the name of a file (got 5)": lambda: scene.add_json(5),
                "Scene.add_file: geometry: must be": lambda: scene.add_file("x.urdf", geometry="visble"),
                "Scene.add_urdf: package_dirs[0]: must be the name": lambda: scene.add_urdf("x", package_dirs=[5]),
                "Scene.set_pose: object: must be less than 1 (got 7)": lambda: scene.set_pose(7, np.eye(4)),
                "Scene.set_pose: object: must be from 0 to": lambda: scene.set_pose(-1, np.eye(4)),
                "Scene.pose: object: must be a whole number (got 'a')": lambda: scene.pose("a"),
                "Scene.remove: object: must be less than 1 (got 3)": lambda: scene.remove(3),
                "Scene.cast_rays: rays: must have the shape (..., 6) (got (1, 3))": lambda: scene.cast_rays([[1, 2, 3]]),
                "Scene.cast_rays: rays[0].direction: must not be zero": lambda: scene.cast_rays([[0] * 6]),
                "Scene.cast_rays: rays[1].origin[0]: must be": lambda: scene.cast_rays(ray + [[np.inf] + [1] * 5]),
                "Scene.cast_rays: rays: must be an array of numbers (got values of datetime64":
                    lambda: scene.cast_rays(np.zeros((1, 6), "datetime64[s]")),
                "Scene.cast_rays: rays: must be an array of numbers (got values of complex":
                    lambda: scene.cast_rays(np.ones((1, 6)) * 1j),
                "Scene.cast_rays: rays: must not be a masked array":
                    lambda: scene.cast_rays(np.ma.masked_equal([[0.0, 0, 0, 1, 0, 0]], 0)),
                "Scene.cast_rays: rays: must be an array of numbers (got list)": lambda: scene.cast_rays([[1], [2, 3]]),
                "Scene.cast_rays: rays: must be an array of numbers (got NoneType)": lambda: scene.cast_rays(None),
                "Scene.cast_rays: t_max: must be a number, or one per ray":
                    lambda: scene.cast_rays(ray, t_max=[1, 2]),
                "Scene.cast_rays: rays[0].t_max: must be >= 0": lambda: scene.cast_rays(ray, t_max=-1),
                "Scene.cast_rays: threads: must be from 0": lambda: scene.cast_rays(ray, threads=-1),
                "Scene.occluded: rays[0].direction: must not be zero": lambda: scene.occluded([[1] * 3 + [0] * 3]),
                "Scene.certify: hits: must be the Hits of these rays": lambda: scene.certify(ray, hits=5),
                "Scene.depth: K: must have the shape": lambda: scene.depth([1], None, 4, 4),
                "Scene.render: spp: must be a whole number": lambda: scene.render(spp="many"),
                "Scene.render: aovs: must be a list": lambda: scene.render(aovs="Z"),
                "Scene.render: integrator: must be one of": lambda: scene.render(integrator="paths"),
                "Scene.render: camera, lights, background: cannot hold": lambda: scene.render({"a": object()}),
                "Scene.clearance: robot: must be a Robot of this scene": lambda: scene.clearance(robot, [[0, 0]]),
                "Scene.clearance: numbers: must be 2": lambda: arm.clearance(robot, [[0, 0, 0]]),
                "Robot.set_pose: pose: must be a (4, 4) matrix": lambda: robot.set_pose(None),
                "Robot.joints: must be 2 values": lambda: setattr(robot, "joints", [1, 2, 3])}.items():
            with self.subTest(text):
                self.expect(text, work)
        with self.assertRaisesRegex(mk.Error, "shoulder, elbow.*'elbo'"):
            robot.joints = {"shoulder": 1, "elbo": 2}
        self.assertEqual(robot.joints["shoulder"], 0)  # nothing was set
        with self.assertRaisesRegex(mk.Error, "shoulder, elbow.*'wrist'"):
            robot.joints["wrist"]
        self.assertEqual(len(scene), 1)  # nothing was added

    def test_of_pairs_sensors_and_files(self):
        ball = mk.sphere(1)
        folder = tempfile.mkdtemp()
        png = os.path.join(folder, "a.png")
        picture = np.zeros((2, 2, 3))
        picture[1, 0, 2] = np.nan
        for text, work in {
                "signed_distance: a: must be a Shape (got int)": lambda: mk.signed_distance(5, None, ball, None),
                "signed_distance: b[1]: must be a Shape": lambda: mk.signed_distance(ball, None, [ball, 5], None),
                "signed_distance: pose_b: must be a (4, 4)": lambda: mk.signed_distance(ball, None, ball, [1, 2]),
                "signed_distance: a, pose_a, b, pose_b: must have shapes that broadcast together (got (2,), (3,), (), ())":
                    lambda: mk.signed_distance([ball] * 2, [np.eye(4)] * 3, ball, None),
                "signed_distance: tolerance: must be": lambda: mk.signed_distance(ball, None, ball, None, -1),
                "time_of_impact: t_max: must be finite":
                    lambda: mk.time_of_impact(ball, None, None, ball, None, None, np.inf),
                "time_of_impact: twist_b: must have the shape (..., 6)":
                    lambda: mk.time_of_impact(ball, None, None, ball, None, [1, 2, 3]),
                "time_of_impact: twist_a[4]: must be a finite":
                    lambda: mk.time_of_impact(ball, None, [0, 0, 0, 0, np.nan, 0], ball, None, None),
                "lidar: pattern: must be the name": lambda: mk.lidar(5),
                "lidar: pattern: must be (channels, steps)": lambda: mk.lidar((1, 2, 3)),
                "pinhole: K: ": lambda: mk.pinhole(np.zeros((3, 3)), None, 4, 4),
                "pinhole: width: must be a whole number": lambda: mk.pinhole(np.eye(3), None, 4.5, 4),
                "write: points: a picture must have at least one pixel": lambda: mk.write(png, np.zeros((0, 0, 3))),
                "write: points[1][0]: a picture must not hold NaN": lambda: mk.write(png, picture),
                "write: points: must not be a masked": lambda: mk.write(png, np.ma.masked_equal(picture, 0)),
                "write: points: must be an array of numbers (got values of datetime64":
                    lambda: mk.write(png, np.zeros((2, 2, 3), "datetime64[s]")),
                "write: file: must be the name of a file": lambda: mk.write(5, picture)}.items():
            with self.subTest(text):
                self.expect(text, work)
        self.assertEqual(os.listdir(folder), [])

    def test_of_support_functions_say_what_was_raised(self):
        def fails(n):
            raise KeyError("no such direction")

        self.expect("custom: the support function failed: KeyError: 'no such direction'", lambda: mk.custom(fails))


class Lists(unittest.TestCase):
    def test_of_poses_answer_for_each(self):
        ball = mk.sphere(1)
        poses = [at(3), at(4), at(5)]
        for given in (poses, tuple(poses), np.array(poses), [p.tolist() for p in poses], [p[:3] for p in poses]):
            distance = mk.signed_distance(ball, None, ball, given)
            np.testing.assert_allclose(distance.value, [1, 2, 3], atol=1e-9)
            self.assertEqual(distance.point_a.shape, (3, 3))
            impact = mk.time_of_impact(ball, None, None, ball, given, [-1, 0, 0, 0, 0, 0], 2.5)
            np.testing.assert_allclose(impact.t_lo, [1, 2, 2.5], atol=1e-8)
            np.testing.assert_array_equal(np.isinf(impact.t_hi), [False, False, True])
            np.testing.assert_array_equal(impact.status, [mk.IMPACT, mk.IMPACT, mk.NO_IMPACT])

    def test_of_shapes_and_poses_broadcast(self):
        shapes = [mk.sphere(1), mk.box([0.5] * 3)]
        table = mk.signed_distance([[one] for one in shapes], None, mk.sphere(1), [at(3), at(4), at(6)])
        np.testing.assert_allclose(table.value, [[1, 2, 4], [1.5, 2.5, 4.5]], atol=1e-9)
        self.assertEqual(table.normal.shape, (2, 3, 3))
        pairs = mk.signed_distance(shapes, [at(0), at(1)], shapes, [at(5), None])
        self.assertAlmostEqual(pairs.value[0], 3)
        self.assertAlmostEqual(pairs.value[1], 0)
        ends = mk.time_of_impact(mk.sphere(1), None, None, mk.sphere(1), at(4),
                                 [[-1, 0, 0, 0, 0, 0], [-2, 0, 0, 0, 0, 0]], [[1], [10]])
        np.testing.assert_array_equal(ends.status == mk.IMPACT, [[False, True], [True, True]])
        for i, one in enumerate(shapes):
            alone = mk.signed_distance(one, None, mk.sphere(1), at(3))
            self.assertEqual(alone.value, table.value[i, 0])

    def test_one_pair_is_numbers_with_statuses(self):
        one = mk.signed_distance(mk.sphere(1), None, mk.sphere(1), at(3))
        self.assertIsInstance(one.value, float)
        self.assertIs(one.status, mk.DistanceStatus.SEPARATED)
        miss = mk.time_of_impact(mk.sphere(1), None, None, mk.sphere(1), at(4), [9, 0, 0, 0, 0, 0], 10)
        self.assertIs(miss.status, mk.ImpactStatus.NO_IMPACT)
        self.assertEqual((miss.t_lo, miss.t_hi), (10, np.inf))
        self.assertAlmostEqual(miss.distance, 92)

    def test_of_a_miss_have_an_infinite_distance_if_it_is_unknown(self):
        ball, mesh = mk.sphere(1), mk.mesh([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], [[0, 1, 2]])
        for a, speed, distance in ((ball, 1, 12), (ball, 1e160, np.inf), (mesh, 1, np.inf)):
            twist = [0, 0, speed, 0, 0, 0]
            with self.subTest(distance=distance, speed=speed):
                alone = mk.time_of_impact(a, None, None, ball, at(0, 0, 4), twist, 10)
                batch = mk.times_of_impact(a, None, None, ball, [at(0, 0, 4)] * 2, [twist] * 2, t_max=10)
                self.assertIs(alone.status, mk.ImpactStatus.NO_IMPACT)
                self.assertAlmostEqual(alone.distance, distance)
                np.testing.assert_allclose(batch.distance, [distance] * 2)

    def test_of_operands_are_operands(self):
        a, b = mk.sphere(1), mk.box([1, 2, 3])
        self.assertEqual(mk.sum([a, b]).json(), mk.sum(a, b).json())
        self.assertEqual(mk.hull_of((a, b)).json(), mk.hull_of(a, b).json())
        self.assertEqual(mk.make("hull_of", {"shapes": [a, b]}).json(), mk.hull_of(a, b).json())

    def test_of_numbers_may_be_of_any_kind_of_number(self):
        self.assertEqual(mk.box([decimal.Decimal(1), 2, np.float32(3)]).json(), mk.box([1, 2, 3]).json())
        hits = ball_scene().cast_rays(np.array([[-4, 0, 0, 1, 0, 0]], np.int16))
        self.assertEqual(hits.t[0], 3)


class Answers(unittest.TestCase):
    def setUp(self):
        self.scene = ball_scene()
        self.rays = np.array([[-4.0, y, 0, 1, 0, 0] for y in (0, 0.5, 3, 0.7)])
        self.hits = self.scene.cast_rays(self.rays)

    def test_are_indexed_as_their_arrays_are(self):
        hits = self.hits
        self.assertEqual(len(hits), 4)
        met = hits[hits.status == mk.HIT]
        self.assertIsInstance(met, mk.Hits)
        self.assertEqual(len(met), 3)
        np.testing.assert_array_equal(met.normal, hits.normal[[0, 1, 3]])
        self.assertEqual(hits[1].t, hits.t[1])
        self.assertEqual(hits[-2].status, mk.MISS)
        self.assertEqual([one.t for one in hits], hits.t.tolist())
        self.assertEqual(len(hits[1:3]), 2)
        with self.assertRaises(IndexError):
            hits[4]
        for answer in (hits[0], met, hits[:0]):
            repr(answer)
        proofs = self.scene.certify(self.rays.reshape(2, 2, 6))
        self.assertEqual(proofs[1].holds.tolist(), [True, True])
        self.assertEqual(proofs[:, 0].complaint, ["", ""])
        self.assertEqual([one.complaint for one in proofs[0]], ["", ""])

    def test_are_kept_in_files(self):
        file = io.BytesIO()
        np.savez(file, **vars(self.hits))
        file.seek(0)
        np.testing.assert_array_equal(np.load(file)["t"], self.hits.t)
        np.savez(io.BytesIO(), **vars(mk.signed_distance(mk.sphere(1), None, mk.sphere(1), at(3))))

    def test_statuses_are_enums_that_compare_with_arrays(self):
        self.assertEqual(repr(mk.HIT), "<Status.HIT: 0>")
        self.assertIs(mk.Status(self.hits.status[2]), mk.MISS)
        self.assertEqual((self.hits.status == mk.HIT).sum(), 3)
        self.assertEqual([int(one) for one in mk.Status], [0, 1, 2, 3])

    def test_names_of_misses_are_none(self):
        names = self.scene.names
        self.assertEqual(names[self.hits.object], ["ball", "ball", None, "ball"])
        self.assertIsNone(names[self.hits.object[2]])
        self.assertEqual(names[0], "ball")

    def test_joints_tell_their_values(self):
        scene = mk.Scene()
        robot = scene.add_urdf(os.path.join(SOURCES, "examples/arm.urdf"))
        self.assertEqual(dict(robot.joints), {"shoulder": 0, "elbow": 0})
        robot.joints["elbow"] = 0.25
        self.assertEqual(repr(robot.joints), "<joints shoulder: 0., elbow: 0.25>")
        self.assertEqual(list(robot.joints), ["shoulder", "elbow"])
        robot.joints = robot.joints

    def test_removed_objects_are_not_met(self):
        scene = self.scene
        other = scene.add(mk.sphere(0.5), at(3), "other")
        scene.remove(0)
        hits = scene.cast_rays(self.rays)
        self.assertEqual(hits.object[0], other)
        self.assertEqual(scene.names, [None, "other"])
        self.assertIn("1 objects: other", repr(scene))
        with self.assertRaisesRegex(mk.Error, r"Scene.remove: object: must not be removed \(got 0\)"):
            scene.remove(0)


class Threads(unittest.TestCase):
    def test_that_ask_after_a_change_wait_for_one_commit(self):
        rays = np.tile([[-4.0, 0, 0, 1, 0, 0]], (1000, 1))
        for _ in range(20):
            scene = ball_scene()
            found, threads = [], []
            for _ in range(4):
                threads.append(threading.Thread(target=lambda: found.append(scene.cast_rays(rays).t[0])))
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            self.assertEqual(found, [3.0] * 4)

    def test_that_change_what_is_asked_get_errors(self):
        scene = ball_scene()
        rays = np.tile([[-4.0, 0, 0, 1, 0, 0]], (20000, 1))
        stop, wrong = threading.Event(), []

        def ask():
            while not stop.is_set():
                try:
                    t = scene.cast_rays(rays).t
                    if not (t == 3).all():
                        wrong.append(t)
                except mk.Error as error:
                    if "another call" not in str(error) and "committed" not in str(error):
                        wrong.append(error)

        askers = [threading.Thread(target=ask) for _ in range(2)]
        for asker in askers:
            asker.start()
        added, refused = 0, 0
        # On a busy machine the askers may begin late.
        deadline = time.monotonic() + 30
        while added + refused < 300 or (refused == 0 and time.monotonic() < deadline):
            if added + refused >= 300:
                time.sleep(0.001)
            try:
                scene.add(mk.sphere(0.5), at(50), name="x" * 50)
                added += 1
            except mk.Error as error:
                self.assertIn("Scene.add: scene: must not be", str(error))
                refused += 1
        stop.set()
        for asker in askers:
            asker.join()
        self.assertEqual(wrong, [])
        self.assertEqual(len(scene), 1 + added)
        self.assertGreater(refused, 0)

    def test_a_support_function_cannot_ask_its_own_scene(self):
        said = []

        def support(n):
            if asking and not said:
                for work in (lambda: scene.cast_rays([[-4, 0, 0, 1, 0, 0]]), lambda: mine.bounds()):
                    try:
                        work()
                    except mk.Error as error:
                        said.append(str(error))
            return np.copysign([1.0, 1, 1], n)

        asking = False
        mine = mk.custom(support)
        scene = mk.Scene()
        scene.add(mine)
        asking = True
        self.assertEqual(scene.cast_rays([[-4, 0.1, 0, 1, 0, 0]]).t[0], 3)
        self.assertEqual(len(said), 2)
        said.clear()
        scene.cast_rays([[-4, 0.1, 0, 1, 0, 0]])
        self.assertIn("Scene.cast_rays: scene: must not be queried from within its own support function", said)

    def test_a_process_ends_while_a_daemon_is_at_work(self):  # it was aborted
        for work in ("s.cast_rays(R)", "s.cast_rays(R[:1])", "own.cast_rays(R)", "s.render(spp=4)",
                     "mk.signed_distance(a, None, a, [np.eye(4)] * 1000)", "a.support(R[:, 3:])"):
            for seconds in (0.05, 0.3):
                script = f"""
import numpy as np, minkray as mk, threading, time
a = mk.rounded(mk.box([1, 1, 1]), .2)
s, own = mk.Scene(), mk.Scene()
s.add(a); own.add(mk.custom(lambda n: np.copysign([1., 1, 1], n)))
R = np.tile([[-5, 0, 0, 1, 0.01, 0]], (300000, 1))
def ask():
    while True: {work}
for _ in range(2): threading.Thread(target=ask, daemon=True).start()
time.sleep({seconds})
"""
                done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
                self.assertEqual((done.returncode, done.stderr), (0, ""), work)


if __name__ == "__main__":
    unittest.main()
