#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes scenes/hulls.json: Boston Dynamics' Atlas, each link the convex hull of its mesh; and
scenes/atlas.json: the meshes themselves, beside those hulls.

The joints are those of its description (URDF) in Debian's libsimbody-dev, where the meshes come
from, too: run scenes/fetch-meshes first.
"""
import math
import xml.etree.ElementTree as ElementTree

from scene_file import SCENES, Pose, after, turn, write

robot = ElementTree.parse(SCENES / "meshes/atlas/atlas_v4.urdf").getroot()

# Degrees: walking, one arm swings forward, the other back. The joints' signs are URDF's.
angles = {
    "back_bkz": -8, "back_bky": 6, "neck_ry": 8,
    "l_arm_shz": -10, "l_arm_shx": -68, "l_arm_ely": 75, "l_arm_elx": 62, "l_arm_wry": 60,
    "r_arm_shz": -28, "r_arm_shx": 66, "r_arm_ely": 110, "r_arm_elx": -40, "r_arm_wry": 60,
    "l_leg_hpy": 12, "l_leg_kny": 22, "l_leg_aky": -30, "l_leg_hpx": 2,
    "r_leg_hpy": -42, "r_leg_kny": 46, "r_leg_aky": -4, "r_leg_hpx": -2,
}
on_left_leg = {"l_uglut", "l_lglut", "l_uleg", "l_lleg", "l_talus", "l_foot"}
dark = {"pelvis", "mtorso", "ltorso", "l_uglut", "r_uglut", "l_lglut", "r_lglut", "l_talus",
        "r_talus", "l_scap", "r_scap", "l_larm", "r_larm", "l_foot", "r_foot"}
accent = {"head", "head_camera", "utorso_pack", "l_hand", "r_hand"}


def numbers(text):
    return [float(word) for word in text.split()]


def origin(element):
    """The pose that an <origin> says; its angles turn around fixed x, then y, then z."""
    found = element.find("origin")
    if found is None:
        return Pose()
    roll, pitch, yaw = (math.degrees(a) for a in numbers(found.get("rpy", "0 0 0")))
    turns = after(turn([0, 0, 1], yaw), after(turn([0, 1, 0], pitch), turn([1, 0, 0], roll)))
    return Pose(numbers(found.get("xyz", "0 0 0")), turns)


parents = {joint.find("child").get("link"): joint for joint in robot.findall("joint")}


def pose_of(link):
    joint = parents.get(link)
    if joint is None:
        return Pose([0, 0, 0.862])  # the pelvis, high enough for the feet to stand on the floor
    pose = pose_of(joint.find("parent").get("link")) * origin(joint)
    angle = angles.get(joint.get("name"), 0)
    return pose * Pose(rotate=turn(numbers(joint.find("axis").get("xyz")), angle)) if angle else pose


objects = []
for link in robot.findall("link"):
    for visual in link.findall("visual"):
        mesh = visual.find("geometry/mesh")
        if mesh is None:
            continue
        name = mesh.get("filename").split("/")[-1].removesuffix(".dae")
        pose = pose_of(link.get("name")) * origin(visual)
        objects.append({
            "name": name, "shape": {"type": "hull", "file": f"meshes/atlas/{name}.stl"},
            "material": "dark" if name in dark else "accent" if name in accent else "shell",
            "transform": pose.json()})
floor = {"name": "floor", "shape": {"type": "box", "half_extents": [14, 14, 0.1]},
         "material": "floor", "transform": {"translate": [0, 0, -0.1]}}


def scene(description, camera, objects):
    return {
        "$schema": "scene.schema.json",
        "version": 1,
        "description": description,
        "camera": camera,
        "lights": [
            {"type": "directional", "direction": [-0.9, 0.25, -1], "color": [1, 0.95, 0.88],
             "intensity": 2.4},
            {"type": "environment", "zenith": [0.5, 0.58, 0.7], "nadir": [0.25, 0.24, 0.22]},
        ],
        "materials": [
            {"name": "shell", "type": "glossy", "color": [0.7, 0.7, 0.68], "roughness": 0.25},
            {"name": "dark", "type": "glossy", "color": [0.07, 0.075, 0.085], "roughness": 0.2},
            {"name": "accent", "type": "glossy", "color": [0.75, 0.3, 0.05], "roughness": 0.2},
            {"name": "floor", "type": "glossy", "color": [0.35, 0.36, 0.38], "roughness": 0.2},
        ],
        "objects": [*objects, floor],
        "background": {"zenith": [0.5, 0.58, 0.7], "nadir": [0.8, 0.82, 0.85]},
    }


def camera(position, look_at, fov_y_degrees, resolution):
    return {"position": position, "look_at": look_at, "up": [0, 0, 1],
            "fov_y_degrees": fov_y_degrees, "resolution": resolution}


def beside(part, way, suffix):
    """The part moved to the side, and named so."""
    transform = dict(part["transform"])
    transform["translate"] = [round(a + b, 6) for a, b in zip(transform["translate"], way)]
    return {**part, "name": part["name"] + suffix, "transform": transform}


def as_mesh(part):
    kept = {key: value for key, value in part.items() if key != "shape"}
    return {"name": kept.pop("name"), "mesh": {"file": part["shape"]["file"]}, **kept}


write("hulls.json", scene(
    "Boston Dynamics' Atlas, each of its links the convex hull of its mesh.",
    camera([3.6, 2.3, 1.5], [0.02, 0, 0.93], 29, [800, 960]), objects))
write("atlas.json", scene(
    "Boston Dynamics' Atlas as its meshes are, and beside it their convex hulls.",
    camera([4.8, 1.3, 1.5], [0, 0, 0.9], 25, [800, 500]),
    [as_mesh(beside(part, [0.2, -0.72, 0], "")) for part in objects] +
    [beside(part, [-0.2, 0.72, 0], " hull") for part in objects]))
