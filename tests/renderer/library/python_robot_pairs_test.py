# SPDX-License-Identifier: MIT
"""Robots' pairs: derivatives of clearances, links that may touch: python_robot_pairs_test.py (PYTHONPATH: the
module's folder)."""
import os
import tempfile
import unittest

import numpy as np

import minkray as mk

# Joints of all kinds that MJCF has, with anchors and axes that no symmetry hides.
EVERY_KIND = """<mujoco><compiler angle="radian"/><worldbody>
  <geom name="wall" type="box" size="0.3 2 2" pos="-2 0 0"/>
  <body name="base" pos="0.2 0.1 -0.3">
    <joint name="rail" type="slide" axis="1 2 0.5"/>
    <joint name="hinge" type="hinge" axis="0.3 1 0.2" pos="0.1 0.2 0.3"/>
    <geom type="capsule" size="0.1" fromto="0 0 0 0 0.4 0.7"/>
    <body name="hand" pos="0 0.5 0.8" euler="0.3 0.2 0.1">
      <joint name="ball" type="ball" pos="0.1 0 -0.1"/>
      <geom type="ellipsoid" size="0.2 0.15 0.4" pos="0.3 0.1 0.2" euler="0.5 0.3 0.1"/>
      <body name="tip" pos="0.4 0.2 0.3"><joint name="bend" type="hinge" axis="1 0 1"/>
        <geom type="sphere" size="0.1" pos="0.4 0.3 0"/></body></body></body>
  <body name="drone" pos="0 0 3"><freejoint name="fly"/>
    <body name="arm" pos="0.3 0 0"><joint name="arm" type="hinge" axis="0 1 0.5"/>
      <geom type="ellipsoid" size="0.3 0.1 0.2" pos="0.5 0.1 0"/></body></body>
</worldbody></mujoco>"""

PLANAR_AND_MIMIC = """<robot name="r"><link name="base"/>
  <link name="cart"><collision><origin xyz="0.3 0.2 0" rpy="0.1 0.2 0.3"/><geometry><box size="0.5 0.4 0.3"/></geometry></collision></link>
  <link name="a"/><link name="b"><collision><origin xyz="0.6 0 0.1"/><geometry><sphere radius="0.2"/></geometry></collision></link>
  <joint name="drive" type="planar"><parent link="base"/><child link="cart"/><origin rpy="0.2 0.1 0"/><axis xyz="0.1 0.2 1"/></joint>
  <joint name="lead" type="continuous"><parent link="cart"/><child link="a"/><origin xyz="0.8 0 0"/><axis xyz="0 1 0"/></joint>
  <joint name="follow" type="continuous"><parent link="a"/><child link="b"/><origin xyz="0.5 0 0"/><axis xyz="0 0 1"/>
    <mimic joint="lead" multiplier="-1.5" offset="0.2"/></joint></robot>"""

ROW = """<robot name="row">%s</robot>""" % "".join(
    f'<link name="l{i}"><collision><geometry><sphere radius="0.6"/></geometry></collision></link>' for i in range(5))
ROW = ROW.replace("</robot>", "".join(
    f'<joint name="j{i}" type="prismatic"><parent link="l0"/><child link="l{i}"/><origin xyz="{i} 0 0"/>'
    f'<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>' for i in range(1, 5)) + "</robot>")


def loaded(text, name, place=None, obstacles=()):
    """A scene with a robot, and what is in its way."""
    scene = mk.Scene()
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, name)
        with open(file, "w") as to:
            to.write(text)
        robot = scene.add_file(file, geometry="collision", pose=place)
    for shape, pose in obstacles:
        scene.add(shape, pose)
    return scene, robot


def at(*position):
    pose = np.eye(4)
    pose[:3, 3] = position
    return pose


def place():
    """A pose that turns, too."""
    a, b = 0.7, -0.4
    turn = np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]]) @ [
        [1, 0, 0], [0, np.cos(b), -np.sin(b)], [0, np.sin(b), np.cos(b)]]
    pose = at(0.5, -0.2, 0.4)
    pose[:3, :3] = turn
    return pose


class Clearances(unittest.TestCase):
    def check(self, scene, robot, rows, least_known):
        known = 0
        for q in rows:
            c = scene.clearance(robot, q, jac=True, jac_error=True)
            self.assertEqual(c.jac.shape, (1, len(q)))
            self.assertEqual(c.jac_error.shape, (1, len(q)))
            if c.is_ridge[0]:
                self.assertTrue(np.isinf(c.jac_error).all())
                continue
            if c.lower[0] > 0:  # the direction of a depth is known to less
                self.assertLess(c.jac_error.max(), 1e-5)
            known += 1
            step = 1e-4
            slope = [(scene.clearance(robot, q + d).upper[0] - scene.clearance(robot, q - d).upper[0]) / (2 * step)
                     for d in step * np.eye(len(q))]
            np.testing.assert_allclose(c.jac[0], slope, atol=2e-5)
        self.assertGreaterEqual(known, least_known)

    def test_have_slopes_of_every_kind_of_joint(self):
        rng = np.random.default_rng(1)
        obstacles = [(mk.sphere(0.3), at(1.5, 1, 0)), (mk.rounded(mk.box([0.2, 0.3, 0.1]), 0.1), at(0.5, -1.5, 1))]
        scene, robot = loaded(EVERY_KIND, "every.xml", place(), obstacles)
        scene.add_half_space([0, 0, 1], -4)
        self.assertEqual(robot.joint_names, ["rail", "hinge", "ball", "bend", "fly", "arm"])
        rows = rng.uniform(-0.7, 0.7, (30, 15))
        rows[:, 7:10] += [0.5, 0, 0.5]  # what flies is near the others
        self.check(scene, robot, rows, 25)

    def test_have_slopes_of_planar_joints_and_of_those_that_others_follow(self):
        rng = np.random.default_rng(2)
        scene, robot = loaded(PLANAR_AND_MIMIC, "planar.urdf", place(), [(mk.sphere(0.3), at(2.5, 0.5, 0))])
        self.assertEqual(robot.joint_names, ["drive", "lead", "follow"])
        rows = rng.uniform(-0.7, 0.7, (30, 5))
        self.check(scene, robot, rows, 25)
        self.assertEqual(scene.clearance(robot, rows[0], jac=True).jac[0, 4], 0)

    def test_of_a_path_are_those_at_its_moment(self):
        scene, robot = loaded(PLANAR_AND_MIMIC, "planar.urdf", None, [(mk.sphere(0.3), at(1.5, 0.9, 0.3))])
        path = np.array([[0.0, -1, 0.1, 0.3, 0], [0.3, 1, 0.3, 0.5, 0], [0.2, 2, 0.3, 0.6, 0]])
        c = scene.clearance(robot, path, 1e-9, jac=True)
        self.assertEqual(c.jac.shape, (2, 5))
        self.assertFalse(c.is_ridge.any())
        row = c.row[0]
        self.assertTrue(0.1 < row < 0.9, row)
        single = scene.clearance(robot, (1 - row) * path[0] + row * path[1], jac=True)
        np.testing.assert_allclose(c.jac[0], single.jac[0], atol=1e-9)
        # The least itself, by both rows of the first step.
        for i, weight in enumerate((1 - row, row)):
            for k in range(5):
                step = np.zeros_like(path)
                step[i, k] = 1e-4
                slope = (scene.clearance(robot, path + step, 1e-9).upper[0]
                         - scene.clearance(robot, path - step, 1e-9).upper[0]) / 2e-4
                self.assertAlmostEqual(weight * c.jac[0, k], slope, delta=1e-4)
        same = scene.clearance(robot, path, 1e-9)
        np.testing.assert_array_equal(c.upper, same.upper)
        self.assertFalse(hasattr(same, "jac"))
        self.assertEqual(c[0].jac.shape, (5,))
        one = scene.clearance(robot, path, 1e-9, jac=True, threads=1)
        np.testing.assert_array_equal(c.jac, one.jac)

    def test_are_zero_where_there_is_nothing_and_ridges_where_two_are_as_near(self):
        scene, robot = loaded(PLANAR_AND_MIMIC, "planar.urdf")
        nothing = scene.clearance(robot, np.zeros(5), only_obstacles=True, jac=True)
        self.assertTrue(np.isinf(nothing.upper).all() and (nothing.jac == 0).all() and not nothing.is_ridge.any())
        scene, robot = loaded(ROW, "row.urdf")
        c = scene.clearance(robot, np.zeros(4), jac=True)
        self.assertTrue(c.is_ridge[0])
        self.assertFalse(scene.clearance(robot, [0, 0.2, 0, 0], jac=True).is_ridge[0])


    def test_by_joints_are_unique_if_all_nearest_points_agree(self):
        # Two plates on hinges about z: an edge over a face, along the hinges or across them.
        robot_text = """<robot name="r"><link name="base"/><link name="plate"><collision><origin xyz="1 0 0"/><geometry>
          <box size="1 0.2 0.6"/></geometry></collision></link><joint name="hinge" type="continuous"><parent link="base"/>
          <child link="plate"/><axis xyz="0 0 1"/></joint></robot>"""
        scene, robot = loaded(robot_text, "plate.urdf", None, [(mk.box([1, 0.5, 1]), at(1.5, 1.5, 0))])
        for q, expected in ((0.1, False), (0, True), (0.4, False)):
            c = scene.clearance(robot, [q], 1e-12, jac=True)
            self.assertEqual(bool(c.is_ridge[0]), expected, q)
            slope = [(scene.clearance(robot, [q + s], 1e-12).upper[0] - c.upper[0]) / s for s in (-1e-6, 1e-6)]
            if expected:
                self.assertGreater(abs(slope[0] - slope[1]), 0.1)
            else:
                np.testing.assert_allclose(slope, c.jac[0, 0], atol=1e-5)
        across = robot_text.replace('axis xyz="0 0 1"', 'axis xyz="1 0 0"')
        scene, robot = loaded(across, "plate.urdf", None, [(mk.box([1, 0.5, 1]), at(1.5, 1.5, 0))])
        self.assertTrue(scene.clearance(robot, [0], jac=True).is_ridge[0])  # faces, which the hinge tilts
        slide = robot_text.replace("continuous", "prismatic").replace(
            '<axis xyz="0 0 1"/>', '<axis xyz="0 1 0"/><limit lower="-9" upper="9" effort="1" velocity="1"/>')
        box, ball = (mk.box([1, 0.5, 1]), at(1.5, 1.5, 0)), (mk.sphere(0.1), at(1, 1.1, 0))
        for obstacles in [box], [box, ball]:  # a ball as near, with the same slope
            scene, robot = loaded(slide, "plate.urdf", None, obstacles)
            c = scene.clearance(robot, [0], jac=True, jac_error=True)
            self.assertEqual((bool(c.is_ridge[0]), c.jac[0, 0].round(9)), (False, -1))
        scene, robot = loaded(slide, "plate.urdf", None, [box])
        self.assertTrue(np.isinf(scene.clearance(robot, [0], jac=True, jac_error=True).jac_error[0, 0]))

    def test_need_shapes_of_the_robot(self):
        scene, robot = loaded('<robot name="bare"><link name="base"/></robot>', "bare.urdf", None, [(mk.sphere(0.3), at(1, 0, 0))])
        with self.assertRaisesRegex(mk.Error, "must have shapes"):
            scene.clearance(robot, np.zeros((1, 0)))


class AllowedPairs(unittest.TestCase):
    def setUp(self):
        self.scene, self.robot = loaded(ROW, "row.urdf")
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def allow(self, text):
        file = os.path.join(self.folder.name, "row.srdf")
        with open(file, "w") as to:
            to.write(f'<robot name="row">{text}</robot>')
        self.scene.allow_from_srdf(self.robot, file)

    def pairs(self):
        found = self.scene.distances(within=0)
        return list(zip(found.object_a.tolist(), found.object_b.tolist()))

    def test_are_left_out_of_distances_and_clearances(self):
        self.assertEqual(self.pairs(), [(1, 2), (2, 3), (3, 4)])
        self.assertAlmostEqual(self.scene.clearance(self.robot, [0, 0, 0, 0.1]).upper[0], -0.2)
        self.allow('<disable_collisions link1="l3" link2="l2" reason="Adjacent"/>')
        self.assertEqual(self.pairs(), [(1, 2), (3, 4)])
        self.scene.allow(1, 2)
        self.scene.allow(3, 4)
        self.assertEqual(self.pairs(), [])
        self.assertAlmostEqual(self.scene.clearance(self.robot, [0, 0, 0, 0]).upper[0], 0.8)
        self.scene.allow(2, 3, False)
        self.assertAlmostEqual(self.scene.clearance(self.robot, [0, 0, 0, 0]).upper[0], -0.2)
        self.scene.set_masks(2, mask=2)
        self.assertAlmostEqual(self.scene.clearance(self.robot, [0, 0, 0, 0]).upper[0], 0.8)

    def test_may_be_all_but_some(self):
        self.allow('<enable_collisions link1="l2" link2="l1"/><disable_default_collisions link="l2"/>')
        self.assertEqual(self.pairs(), [(1, 2), (3, 4)])

    def test_of_links_that_are_not_there_are_none(self):
        with self.assertRaisesRegex(mk.Error, r'link2: there is no link "l9"'):
            self.allow('<disable_collisions link1="l3" link2="l2"/><disable_collisions link1="l3" link2="l9"/>')
        self.assertEqual(len(self.pairs()), 3)
        with self.assertRaisesRegex(mk.Error, "must be a Robot of this scene"):
            self.scene.allow_from_srdf(loaded(ROW, "row.urdf")[1], "row.srdf")
        with self.assertRaisesRegex(mk.Error, "Scene.allow_from_srdf: .*nothing.srdf"):
            self.scene.allow_from_srdf(self.robot, "nothing.srdf")


if __name__ == "__main__":
    unittest.main()
