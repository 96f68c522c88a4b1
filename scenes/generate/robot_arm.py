#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes scenes/robot-arm.json: a Universal Robots UR10 arm, each link the convex hull of its mesh.

The joints' places and axes are those of the UR10 example that Debian's libsimbody-dev ships
(TaskSpaceControl-UR10/UR10.cpp); the meshes come from there, too (scenes/fetch-meshes).
"""
from scene_file import Pose, rounded, turn, write

X, Y, Z = [1, 0, 0], [0, 1, 0], [0, 0, 1]
pedestal = 0.5

# Joint angles in degrees: the arm reaches forward, the tool looks down.
pan, lift, elbow, wrist_1, wrist_2, wrist_3 = -22, -68, 102, -124, -90, 30

base = Pose([0, 0, pedestal], turn(Z, 0))
shoulder = base * Pose([0, 0, 0.1273], turn(Z, pan))
upper_arm = shoulder * Pose([0, 0.220941, 0], turn(Y, 90 + lift))
forearm = upper_arm * Pose([0, -0.1719, 0.612], turn(Y, elbow))
wrist1 = forearm * Pose([0, 0, 0.5723], turn(Y, 90 + wrist_1))
wrist2 = wrist1 * Pose([0, 0.1149, 0], turn(Z, wrist_2))
wrist3 = wrist2 * Pose([0, 0, 0.1157], turn(Y, wrist_3))
tool = wrist3 * Pose([0, 0.0922, 0], turn(X, -90))  # its z axis points out of the flange


def link(name, pose, material):
    return {"name": name, "shape": {"type": "hull", "file": f"meshes/ur10/{name}.obj"},
            "material": material, "transform": pose.json()}


def rounded_box(half_extents, radius):
    return {"type": "rounded", "radius": radius,
            "shape": {"type": "box", "half_extents": half_extents}}


objects = [
    link("Base", base, "dark"), link("Shoulder", shoulder, "blue"),
    link("UpperArm", upper_arm, "silver"), link("Forearm", forearm, "silver"),
    link("Wrist1", wrist1, "blue"), link("Wrist2", wrist2, "silver"),
    link("Wrist3", wrist3, "dark"),
]

# A gripper with two fingers, holding a ball.
palm = tool * Pose([0, 0, 0.035])
objects.append({"name": "palm", "shape": rounded_box([0.055, 0.025, 0.02], 0.012),
                "material": "dark", "transform": palm.json()})
grip = 0.032
for name, side in (("left finger", -1), ("right finger", 1)):
    finger = tool * Pose([side * (grip + 0.012), 0, 0.105])
    objects.append({"name": name, "shape": rounded_box([0.006, 0.012, 0.045], 0.006),
                    "material": "silver", "transform": finger.json()})
ball = tool * Pose([0, 0, 0.125])
objects.append({"name": "ball", "shape": {"type": "sphere", "radius": grip}, "material": "orange",
                "transform": ball.json()})

# What the arm stands on, and the rest of its work.
objects.append({"name": "pedestal", "material": "dark", "shape": {
    "type": "rounded", "radius": 0.02, "shape": {
        "type": "frustum", "radii": [0.2, 0.12], "half_height": pedestal / 2 - 0.02}},
    "transform": {"translate": [0, 0, pedestal / 2]}})
under = ball.translate
table_top = 0.44
objects.append({"name": "table", "material": "wood",
                "shape": rounded_box([0.28, 0.28, table_top / 2 - 0.015], 0.015),
                "transform": {"translate": rounded([under[0], under[1], table_top / 2]),
                              "rotate": rounded(turn(Z, pan))}})
tray = Pose([under[0], under[1], table_top], turn(Z, pan))
for i, (x, y) in enumerate([(-0.2, -0.2), (0, -0.2), (0.2, -0.2), (-0.2, 0), (0.2, 0), (-0.2, 0.2),
                            (0.2, 0.2)]):
    objects.append({"name": f"ball {i + 2}", "shape": {"type": "sphere", "radius": grip},
                    "material": "orange" if i % 2 == 0 else "white",
                    "transform": {"translate": rounded((tray * Pose([x, y, grip])).translate)}})
objects.append({"name": "floor", "shape": {"type": "box", "half_extents": [12, 12, 0.1]},
                "material": "floor", "transform": {"translate": [0, 0, -0.1]}})

if __name__ == "__main__":
    write("robot-arm.json", {
        "$schema": "scene.schema.json",
        "version": 1,
        "description": "A Universal Robots UR10 arm, each link the convex hull of its mesh, at work.",
        "camera": {"position": [1.75, -2.15, 1.35], "look_at": [0.42, -0.1, 0.6], "up": [0, 0, 1],
                   "fov_y_degrees": 34, "resolution": [960, 720]},
        "lights": [
            {"type": "directional", "direction": [-0.5, 0.6, -1.1], "color": [1, 0.95, 0.88],
             "intensity": 2.4},
            {"type": "environment", "zenith": [0.55, 0.65, 0.8], "nadir": [0.25, 0.23, 0.2]},
        ],
        "materials": [
            {"name": "silver", "type": "glossy", "color": [0.62, 0.63, 0.65], "roughness": 0.25,
             "index_of_refraction": 1.8},
            {"name": "blue", "type": "glossy", "color": [0.12, 0.32, 0.52], "roughness": 0.2},
            {"name": "dark", "type": "glossy", "color": [0.06, 0.06, 0.07], "roughness": 0.3},
            {"name": "orange", "type": "glossy", "color": [0.85, 0.28, 0.04], "roughness": 0.08},
            {"name": "white", "type": "glossy", "color": [0.8, 0.8, 0.78], "roughness": 0.08},
            {"name": "wood", "type": "lambert", "color": [0.5, 0.36, 0.22]},
            {"name": "floor", "type": "glossy", "color": [0.3, 0.31, 0.33], "roughness": 0.15},
        ],
        "objects": objects,
        "background": {"zenith": [0.45, 0.55, 0.7], "nadir": [0.85, 0.87, 0.9]},
    })
