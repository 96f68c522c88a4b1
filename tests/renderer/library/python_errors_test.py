# SPDX-License-Identifier: MIT
"""Texts of errors in Python, and exceptions of support functions: python_errors_test.py SOURCES."""
import copy
import os
import pickle
import sys
import tempfile
import unittest

import numpy as np

import minkray as mk
from errors_support import ErrorCase

SOURCES = sys.argv.pop(1)


class Texts(ErrorCase):
    def test_name_the_function_and_the_argument(self):
        scene, ball = mk.Scene(), mk.sphere(1)
        scene.add(ball)
        robot = scene.add_urdf(os.path.join(SOURCES, "examples/arm.urdf"))
        two = [[0, 0], [1, 1]]
        for text, work in {
                "Scene.verify: robot: must be a Robot": lambda: scene.verify(3, two),
                "Scene.verify: numbers: must be 2": lambda: scene.verify(robot, [[0]]),
                "Scene.verify: rates: must have the shape": lambda: scene.verify(robot, two, rates=[[0, 0]]),
                "Scene.verify: times": lambda: scene.verify(robot, two, times=[1, 0]),
                "Scene.verify: tolerance: must be between": lambda: scene.verify(robot, two, tolerance=-1),
                "Scene.verify: budget: must be": lambda: scene.verify(robot, two, budget=-1),
                "Scene.verify: must be called as verify(": lambda: scene.verify(),
                "Scene.clearance: tolerance: must be between": lambda: scene.clearance(robot, two, tolerance=-1),
                "Scene.add_file: package_dirs: must be a list of folders (got 3)":
                    lambda: scene.add_file("x.urdf", package_dirs=3),
                "Scene.add_file: package_dirs: must be a list of folders (got '/tmp')":
                    lambda: scene.add_file("x.urdf", package_dirs="/tmp"),
                "Scene.render: aovs: must be a list of names (got 3)": lambda: scene.render(aovs=3),
                "Scene.render: integrator: must be one of": lambda: scene.render(integrator="paths"),
                "Scene.render: background/zenith: missing: must be the radiance (linear RGB) straight up, >= 0 and <= "
                "1e15\nbackground/nadir: missing": lambda: scene.render(background={}),
                "Robot.joints: must be 2 values, of shoulder, elbow (got 3)": lambda: setattr(robot, "joints", 3),
                "Robot.joints: must be 2 values, of shoulder, elbow (got None)":
                    lambda: setattr(robot, "joints", None),
                "height_field: heights: must be an array of numbers": lambda: mk.height_field("x", 1),
                "height_field: size: must be two numbers": lambda: mk.height_field([[0, 0], [0, 0]], "x"),
                "height_field: bottom: must be a number": lambda: mk.height_field([[0, 0], [0, 0]], (1, 1), "x"),
                "lidar: pattern: must be a lidar's name": lambda: mk.lidar("foo"),
                "lidar: pattern: must be spinning:": lambda: mk.lidar("spinning:axb"),
                "sphere: radius: must be a number (got NoneType)": lambda: mk.sphere(None),
                "sphere: radius: must be a number (got the shape (2,))": lambda: mk.sphere([1, 2]),
                "box: half_extents: must be an array of numbers (got NoneType)": lambda: mk.box(None),
                "pinhole: K: must have the shape (3, 3) (got ())": lambda: mk.pinhole(3, None, 4, 4),
                "pinhole: K: must have the shape (3, 3) (got (2, 3))":
                    lambda: mk.pinhole(np.ones((2, 3)), None, 4, 4),
                "pinhole: K[0][1]: must be a finite": lambda: mk.pinhole([[1, np.nan, 0], [0, 1, 0], [0, 0, 1]], None, 4, 4),
                "make: shape: must be a shape (got numbers)": lambda: mk.make("rounded", shape=3, radius=1),
                "Shape.kind: self: must be a Shape (got int)": lambda: mk.Shape.kind.fget(3),
                "Shape.bounds: self: must be a Shape (got int)": lambda: mk.Shape.bounds(3),
                "Shape.support: self: must be a Shape": lambda: mk.Shape.support(3, [[0, 0, 1]])}.items():
            with self.subTest(text):
                self.expect(text, work)

    def test_have_the_names_of_files_as_they_are(self):
        scene = mk.Scene()
        robot = scene.add_urdf(os.path.join(SOURCES, "examples/arm.urdf"))
        for name in ("/nope/x.json", "/nope/my_options.json", "/nope/options.d/x.urdf", "options.json",
                     "options.srdf/x.json"):
            with self.subTest(name):
                self.expect(f"Scene.add_file: {name}: ", lambda: scene.add_file(name))
        self.expect("Scene.allow_from_srdf: options.srdf: ", lambda: scene.allow_from_srdf(robot, "options.srdf"))
        picture = np.zeros((2, 2, 3))
        for name, points in (("/nope/a.png", picture), ("/nope/a.pfm", picture), ("/nope/a.npy", picture),
                             ("/nope/a.ply", picture[0]), ("/nope/a.npy", picture[0])):
            self.expect(f"write: {name}: cannot be written: No such file", lambda: mk.write(name, points))
        self.expect("write: /nope/a.foo: must end in", lambda: mk.write("/nope/a.foo", picture[0]))
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "my_options.json")
            with open(file, "w") as out:
                out.write('{"version": 2, "objects": [{"shape": {"type": "bxo"}}]}')
            self.expect(f"Scene.add_file: {file}: /objects/0/shape/type: ", lambda: scene.add_file(file))


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


class Statuses(unittest.TestCase):
    def test_of_single_results_are_members_of_their_enum(self):
        scene, ball = mk.Scene(), mk.sphere(1)
        scene.add(ball)
        scene.add(ball, [3, 0, 0, 1, 0, 0, 0])
        ray, away = [-4, 0, 0, 1, 0, 0], [-4, 0, 0, -1, 0, 0]
        poses = np.array([[0, 4, 0, 1, 0, 0, 0], [0, 1, 0, 1, 0, 0, 0]], float)
        motion = ball, None, None, ball, poses, [0, -1, 0, 0, 0, 0]
        for found, expected in ((scene.cast_rays(ray), mk.Status.HIT), (scene.cast_rays(away), mk.Status.MISS),
                                (scene.cast_rays([ray, away])[1], mk.Status.MISS),
                                (scene.all_hits(ray), mk.Status.HIT), (scene.exit(0, ray), mk.Status.HIT),
                                (mk.signed_distance(ball, None, ball, poses)[1], mk.DistanceStatus.OVERLAPPING),
                                (mk.signed_distances(ball, None, ball, poses)[0], mk.DistanceStatus.SEPARATED),
                                (mk.manifolds(ball, None, ball, poses)[1], mk.DistanceStatus.OVERLAPPING),
                                (scene.manifold(0, 1), mk.DistanceStatus.SEPARATED),
                                (scene.nearest([[0, 9, 0]])[0][0], mk.DistanceStatus.SEPARATED),
                                (scene.distances(within=2)[0], mk.DistanceStatus.SEPARATED),
                                (mk.time_of_impact(*motion, 9)[1], mk.ImpactStatus.BEGINS_INSIDE),
                                (mk.times_of_impact(*motion, t_max=1)[0], mk.ImpactStatus.NO_IMPACT),
                                (scene.time_of_impact(ball, poses, [0, -1, 0, 0, 0, 0], 9)[0], mk.ImpactStatus.IMPACT)):
            self.assertIs(found.status, expected)
            repr(found)
        self.assertIs(mk.IMPACT_UNDECIDED, mk.ImpactStatus.UNDECIDED)
        table = mk.signed_distance(ball, None, ball, poses)
        self.assertEqual(len(table), 2)
        self.assertEqual(table[table.status == mk.SEPARATED].value.tolist(), [2])
        self.assertEqual(len(mk.time_of_impact(*motion, 9)), 2)
        self.assertEqual(scene.cast_rays(ray)[()].t, 3)


class Poses(unittest.TestCase):
    def test_are_of_the_same_kinds_everywhere(self):
        half = np.sqrt(0.5)
        given = [4, 1, 2, 3 * half, 0, 0, 3 * half]  # a quarter turn about z
        matrix = np.array([[0, -1, 0, 4], [1, 0, 0, 1], [0, 0, 1, 2], [0, 0, 0, 1.0]])
        box, ball = mk.box([1, 2, 3]), mk.sphere(0.5)
        many = mk.signed_distances(ball, None, box, [given])
        for pose in (given, np.array(given), matrix, matrix[:3]):
            alone = mk.signed_distance(ball, None, box, pose)
            self.assertAlmostEqual(alone.value, many.value[0], 12)
            np.testing.assert_allclose(mk.signed_distance(ball, None, box, [pose, pose]).value, [alone.value] * 2)
            impact = mk.time_of_impact(ball, None, [2, 0.5, 1, 0, 0, 0], box, pose, None, 9)
            self.assertIs(impact.status, mk.ImpactStatus.IMPACT)
            self.assertAlmostEqual(impact.t_hi, 0.75, 6)
            scene = mk.Scene()
            number = scene.add(box, pose)
            np.testing.assert_allclose(scene.pose(number), matrix, atol=1e-15)
            scene.set_pose(number, np.eye(4))
            scene.set_pose(number, pose)
            np.testing.assert_allclose(scene.pose(number), matrix, atol=1e-15)
            robot = scene.add_file(os.path.join(SOURCES, "examples/arm.urdf"), pose)
            before = scene.pose(robot.objects[0])
            robot.set_pose(None if pose is None else np.eye(4))
            robot.set_pose(pose)
            np.testing.assert_allclose(scene.pose(robot.objects[0]), before, atol=1e-15)
            np.testing.assert_allclose(mk.lidar((4, 8), pose), mk.lidar((4, 8), matrix), atol=1e-15)
        for wrong, text in (([1, 2, 3], r"pose: must be a \(4, 4\) matrix, or one of the shape \(3, 4\), or x, y, z"),
                            ([0] * 7, "pose: must have a quaternion that is not zero"),
                            ([np.nan] * 7, r"pose\[0\]: must be a finite number"),
                            ([given] * 2, "pose: must be one pose")):
            with self.assertRaisesRegex(mk.Error, "^Scene.add: " + text):
                scene.add(ball, wrong)


if __name__ == "__main__":
    unittest.main()
