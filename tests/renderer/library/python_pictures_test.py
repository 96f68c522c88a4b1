# SPDX-License-Identifier: MIT
"""Pictures, sensors and paths from Python are the command line's: python_pictures_test.py SOURCES PROGRAM"""
import json
import os
import pickle
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import zlib

import numpy as np

import minkray as mk

PROGRAM, SOURCES = sys.argv.pop(2), sys.argv.pop(1)
ZOO = os.path.join(SOURCES, "scenes/shape-zoo.json")
ARM = os.path.join(SOURCES, "examples/arm.urdf")


def read_pfm(file):
    with open(file, "rb") as data:
        assert data.readline() == b"PF\n"
        width, height = map(int, data.readline().split())
        assert float(data.readline()) < 0
        return np.frombuffer(data.read(), "<f4").reshape(height, width, 3)[::-1]


class Pictures(unittest.TestCase):
    def setUp(self):
        self.scene = mk.Scene()
        self.scene.add_json(ZOO)

    def test_have_the_bits_of_the_command_line(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "zoo.pfm")
            subprocess.run([PROGRAM, "render", ZOO, "-q", "-r", "80x45", "-s", "3", "--seed", "7", "-o", file],
                           check=True)
            expected = read_pfm(file)
            again = os.path.join(folder, "again.pfm")
            for threads in 1, 2:
                picture = self.scene.render(spp=3, width=80, height=45, seed=7, threads=threads)["rgb"]
                np.testing.assert_array_equal(picture, expected)
            mk.write(again, picture)
            np.testing.assert_array_equal(read_pfm(again), expected)
        self.assertFalse((self.scene.render(spp=3, width=80, height=45, seed=8)["rgb"] == expected).all())

    def test_tell_what_rays_through_pixels_meet(self):
        view = {"position": [0, -9, 4], "look_at": [0, 0, 0], "fov_y_degrees": 40}
        parts = self.scene.render(view, spp=1, width=64, height=48, aovs=["Z", "N", "id.object", "dist", "N"])
        self.assertEqual({name: (part.shape, part.dtype.name) for name, part in parts.items()},
                         {"rgb": ((48, 64, 3), "float32"), "Z": ((48, 64), "float32"),
                          "N": ((48, 64, 3), "float32"), "id.object": ((48, 64), "uint32"),
                          "dist": ((48, 64), "float32")})
        # The same camera as OpenCV has it.
        ahead = -np.array([0, -9, 4.0])
        ahead /= np.linalg.norm(ahead)
        right = np.cross(ahead, [0, 0, 1])
        right /= np.linalg.norm(right)
        pose = np.eye(4)
        pose[:3, :3] = np.stack([right, np.cross(ahead, right), ahead], axis=1)
        pose[:3, 3] = [0, -9, 4]
        f = 24 / np.tan(np.radians(20))
        depth, ids = self.scene.depth([[f, 0, 32], [0, f, 24], [0, 0, 1]], pose, 64, 48)
        met = parts["id.object"] > 0
        self.assertTrue(0.2 < met.mean() < 1)
        same = np.where(met, parts["id.object"] - 1, mk.NO_OBJECT) == ids
        self.assertGreater(same.mean(), 0.995)  # rays that just touch may differ by rounding
        np.testing.assert_allclose(parts["Z"][met & same], depth[met & same], rtol=1e-5)

    def test_of_what_was_added_are_framed_and_lit_or_as_they_are_told(self):
        scene = mk.Scene()
        scene.add(mk.translated(mk.sphere(1), [30, 20, 10]))
        framed = scene.render(spp=2, width=40, height=30, aovs=["id.object"])
        met = framed["id.object"] == 1
        self.assertTrue(0.3 < met.mean() < 0.8, met.mean())
        self.assertFalse(met[0].any() or met[-1].any() or met[:, 0].any() or met[:, -1].any())
        self.assertTrue((framed["rgb"][met] > 0.03).all())
        scene = mk.Scene()
        scene.add(mk.sphere(1))
        view = {"position": np.array([0, -5, 0]), "look_at": [0, 0, 0]}
        dark = scene.render(view, spp=1, width=16, height=16, lights=[], background=[0, 0, 0])["rgb"]
        self.assertEqual(dark.max(), 0)
        sun = [{"type": "directional", "direction": [0, 1, 0], "color": [1, 1, 1]}]
        lit = scene.render(view, spp=1, width=16, height=16, lights=sun, background=[0, 0, 0])["rgb"]
        self.assertGreater(lit[8, 8].min(), 0.05)
        self.assertEqual(lit[0, 0].max(), 0)
        for camera, text in ({"position": [0, 0, 0]}, "camera/look_at"), ({**view, "fov": 1}, "fov"):
            with self.assertRaisesRegex(mk.Error, text):
                scene.render(camera)
        with self.assertRaisesRegex(mk.Error, "must be one of rgb, Z"):
            scene.render(view, aovs=["depth"])
        with self.assertRaisesRegex(mk.Error, "width: must be at most"):
            scene.render(view, width=10 ** 6)

    def test_are_stopped_by_ctrl_c(self):
        for threads in 1, 0:
            timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
            timer.start()
            begin = time.monotonic()
            with self.assertRaises(KeyboardInterrupt):
                self.scene.render(spp=4096, threads=threads)
            self.assertLess(time.monotonic() - begin, 20)

    def test_are_written_as_png(self):
        picture = np.zeros((2, 3, 3))
        picture[0, 1] = [1, 0.5, 7]
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "small.png")
            mk.write(file, picture)
            with open(file, "rb") as data:
                bytes_ = data.read()
            with self.assertRaisesRegex(ValueError, "must end in"):
                mk.write(os.path.join(folder, "small.bmp"), picture)
        self.assertEqual(bytes_[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", bytes_[16:24]), (3, 2))
        at = bytes_.index(b"IDAT")
        (length,) = struct.unpack(">I", bytes_[at - 4:at])
        rows = np.frombuffer(zlib.decompress(bytes_[at + 4:at + 4 + length]), np.uint8).reshape(2, 10)
        self.assertEqual(rows[0, 4:7].tolist(), [255, 188, 255])
        self.assertEqual(int(rows.sum()), 255 + 188 + 255)


class Sensors(unittest.TestCase):
    def test_lidars_are_those_of_scans(self):
        scene = mk.Scene()
        scene.add_json(ZOO)
        pose = np.eye(4)
        pose[:3, 3] = [0, -6, 1]
        hits = scene.cast_rays(mk.lidar((8, 90, -20, 10), pose))
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "scan.npy")
            subprocess.run([PROGRAM, "scan", ZOO, "--pattern", "spinning:8x90:-20,10", "--pose", "0,-6,1",
                            "-o", file], check=True, capture_output=True)
            scanned = np.load(file)
        self.assertTrue(0.05 < np.isfinite(hits.t).mean() < 0.95)
        columns = scanned["t"] if scanned.dtype.names else scanned[..., 0]
        np.testing.assert_allclose(columns.ravel(), hits.t, rtol=1e-6)

    def test_lidars_have_names(self):
        rays = mk.lidar("VLP-16").reshape(16, 1800, 6)
        up = np.degrees(np.arcsin(rays[:, 0, 5]))
        np.testing.assert_allclose(up, np.arange(15, -16, -2), atol=1e-9)
        with self.assertRaisesRegex(mk.Error, "did you mean .VLP-16."):
            mk.lidar("VLP-17")

    def test_cameras_are_opencvs(self):
        lens = {"fx": 60, "fy": 58, "cx": 30.2, "cy": 25.1, "width": 64, "height": 48,
                "k1": -0.2, "k2": 0.05, "p1": 1e-3, "p2": -2e-3}
        x, y, z = np.moveaxis(mk.camera(lens)[..., 3:], -1, 0)
        self.assertTrue((z == 1).all())
        s = x * x + y * y
        radial = 1 + s * (lens["k1"] + s * lens["k2"])
        u = x * radial + 2 * lens["p1"] * x * y + lens["p2"] * (s + 2 * x * x)
        v = y * radial + lens["p1"] * (s + 2 * y * y) + 2 * lens["p2"] * x * y
        v_pixel, u_pixel = np.mgrid[:48, :64]
        np.testing.assert_allclose(60 * u + 30.2, u_pixel, atol=1e-9)
        np.testing.assert_allclose(58 * v + 25.1, v_pixel, atol=1e-9)
        with self.assertRaisesRegex(mk.Error, "k9: unknown key"):
            mk.camera({**lens, "k9": 1})
        with self.assertRaisesRegex(mk.Error, "calibration: must be a dict"):
            mk.camera(5)

    def test_lidars_of_livox_are_tables(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "pattern.csv")
            with open(file, "w") as table:
                table.write("Time/s,Azimuth/deg,Zenith/deg\n0,0,90\n0.1,90,90\n0.2,0,0\n")
            rays = mk.lidar(file)
        np.testing.assert_allclose(rays[:, 3:], [[1, 0, 0], [0, 1, 0], [0, 0, 1]], atol=1e-15)
        with self.assertRaisesRegex(mk.Error, "spinning:CHANNELSxSTEPS"):
            mk.lidar((0, 5))


class Paths(unittest.TestCase):
    PATH = np.array([[0, 0], [0.5, 1], [1, 0.2]])

    def test_clearance_is_the_command_lines(self):
        scene = mk.Scene()
        arm = scene.add_urdf(ARM)
        scene.add_json(ZOO)
        found = scene.clearance(arm, self.PATH)
        with tempfile.TemporaryDirectory() as folder:
            path, steps = os.path.join(folder, "path.csv"), os.path.join(folder, "steps.csv")
            with open(path, "w") as table:
                table.write(",".join(arm.joint_names) + "\n")
                for row in self.PATH:
                    table.write(",".join(map(repr, map(float, row))) + "\n")
            subprocess.run([PROGRAM, "clearance", ARM, "--path", path, "--obstacle", ZOO, "--geometry",
                            "visual", "--steps", steps],
                           check=True, capture_output=True)
            told = np.genfromtxt(steps, delimiter=",", names=True, dtype=None, encoding=None)
        np.testing.assert_array_equal(found.lower, told["lower"])
        np.testing.assert_array_equal(found.upper, told["upper"])
        self.assertEqual([scene.names[i] for i in found.object_b], list(told["b"]))
        self.assertEqual(len(found), 2)

    def test_clearance_follows_the_robots_place_and_is_true_of_what_is_met(self):
        far = np.eye(4)
        far[:3, 3] = [3, -2, 1]
        far[:3, :3] = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
        ball = np.eye(4)
        ball[:3, 3] = [1.2, 0, 0.4]
        found = []
        for place in np.eye(4), far:
            scene = mk.Scene()
            arm = scene.add_urdf(ARM, pose=place)
            scene.add(mk.sphere(0.1), pose=place @ ball, name="ball")
            found.append(scene.clearance(arm, self.PATH, only_obstacles=True))
            least = found[-1]
            # Nothing is nearer at any time than what is proven.
            for s in np.linspace(0, 1, 9):
                arm.joints = self.PATH[0] + s * (self.PATH[1] - self.PATH[0])
                scene.commit()
                toward = place[:3, :3] @ [1.0, 0, 0]
                gap = scene.cast_rays([[*(scene.pose(3)[:3, 3] - toward * 5), *toward]])
                self.assertEqual(gap.status[0] in (mk.HIT, mk.INSIDE), True)
            self.assertTrue((least.lower <= least.upper).all())
            np.testing.assert_allclose(np.linalg.norm(least.point_b - least.point_a, axis=1),
                                       np.abs(least.upper), atol=1e-9)
            self.assertEqual({scene.names[i] for i in least.object_b}, {"ball"})
        np.testing.assert_allclose(found[0].lower, found[1].lower, atol=1e-9)

    def test_verdicts_are_those_of_clearances(self):
        ball = np.eye(4)
        ball[:3, 3] = [1.2, 0, 0.4]
        scene = mk.Scene()
        arm = scene.add_urdf(ARM)
        number = scene.add(mk.sphere(0.1), pose=ball, name="ball")
        least = scene.clearance(arm, self.PATH).lower.min()
        verdict = scene.verify(arm, self.PATH)
        self.assertEqual(bool(verdict), least > 0)
        if verdict:
            self.assertEqual(verdict.status, mk.MotionStatus.FREE)
            self.assertAlmostEqual(verdict.lower, least, delta=0.02 * abs(least))
        # Nearer than a margin is a collision, which the ball's own place tells.
        near = scene.verify(arm, self.PATH, margin=verdict.upper + 0.05, only_obstacles=True)
        self.assertEqual(near.status, mk.MotionStatus.COLLIDES)
        self.assertFalse(near)
        self.assertEqual(near.object_b, number)
        self.assertTrue(near.begin <= near.row <= near.end)
        self.assertLess(near.upper, 0)
        # Rates that are those of the straight way change nothing.
        straight = scene.verify(arm, [[0, 0], [0.5, 1]])
        cubic = scene.verify(arm, [[0, 0], [0.5, 1]], rates=[[0.5, 1], [0.5, 1]])
        self.assertEqual(straight.status, cubic.status)
        self.assertAlmostEqual(straight.upper, cubic.upper, delta=0.03 * abs(straight.upper))
        quintic = scene.verify(arm, [[0, 0], [0.5, 1]], rates=[[0.5, 1], [0.5, 1]],
                               accelerations=np.zeros((2, 2)))
        self.assertAlmostEqual(straight.upper, quintic.upper, delta=0.03 * abs(straight.upper))
        with self.assertRaisesRegex(mk.Error, "accelerations: must have rates"):
            scene.verify(arm, [[0, 0], [0.5, 1]], accelerations=np.zeros((2, 2)))

    def test_proofs_are_written(self):
        scene = mk.Scene()
        arm = scene.add_urdf(ARM)
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "proof.json")
            verdict = scene.verify(arm, [[0, 0], [0.5, 1]], proof=file)
            with open(file, encoding="utf-8") as proof:
                self.assertEqual(json.load(proof)["status"], verdict.status.name.lower())
            with self.assertRaisesRegex(mk.Error, "none"):
                scene.verify(arm, [[0, 0], [0.5, 1]], proof=os.path.join(folder, "none", "p.json"))

    def test_mistakes_are_told(self):
        scene = mk.Scene()
        arm = scene.add_urdf(ARM)
        with self.assertRaisesRegex(mk.Error, "rates: must have the shape"):
            scene.verify(arm, self.PATH, rates=[[0, 0]])
        with self.assertRaisesRegex(mk.Error, "margin"):
            scene.verify(arm, self.PATH, margin=-1)
        for path, text in ([[0, 0, 0]], "numbers: must be 2"), (np.zeros((0, 2)), "rows"), ([[0, np.nan]], r"path\[0\]\[1\]"):
            with self.assertRaisesRegex(mk.Error, text):
                scene.clearance(arm, path)
        zoo = scene.add_json(ZOO)
        with self.assertRaisesRegex(mk.Error, "must be a robot's"):
            scene.clearance(zoo, [[]])


class Proofs(unittest.TestCase):
    def test_of_answers_that_are_not_these_do_not_hold(self):
        scene = mk.Scene()
        ball = scene.add(mk.sphere(1))
        rays = [[-3, 0, 0, 1, 0, 0], [-3, 5, 0, 1, 0, 0]]
        hits = scene.cast_rays(rays)
        self.assertTrue(scene.certify(rays, hits).holds.all())
        moved = np.eye(4)
        moved[0, 3] = 0.5
        scene.set_pose(ball, moved)
        proofs = scene.certify(rays, hits)
        self.assertEqual(proofs.holds.tolist(), [False, True])
        self.assertIn("differs from a new cast", proofs.complaint[0])


class Pickles(unittest.TestCase):
    def test_of_custom_shapes_are_refused_with_a_reason(self):
        with self.assertRaisesRegex(mk.Error, "custom support functions cannot be written"):
            pickle.dumps(mk.custom(lambda n: n))

    def test_of_hulls_have_all_their_points(self):
        points = np.random.default_rng(3).normal(size=(200, 3))
        shape = pickle.loads(pickle.dumps(mk.hull(points)))
        n = np.random.default_rng(4).normal(size=(100, 3))
        np.testing.assert_array_equal(shape.support(n), mk.hull(points).support(n))
        self.assertLessEqual(len(json.loads(shape.json())["points"]), 200)


if __name__ == "__main__":
    unittest.main()
