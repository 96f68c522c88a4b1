#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes scenes/robot-room.json: the arm of robot_arm.py at work in a room that lamps and a window light."""
import robot_arm
from scene_file import Pose, rounded, turn, write

Z = [0, 0, 1]
wall = 0.1  # half a wall's thickness
left, right, front, back, height = -1.5, 2.6, -3.2, 1.5, 2.5
middle_x, middle_y = (left + right) / 2, (front + back) / 2
half_x, half_y = (right - left) / 2, (back - front) / 2


def body(name, shape, material, translate, rotate=None):
    made = {"name": name, "shape": shape, "material": material, "transform": {"translate": rounded(translate)}}
    if rotate:
        made["transform"]["rotate"] = rounded(rotate)
    return made


def box(*half_extents):
    return {"type": "box", "half_extents": rounded(half_extents)}


def round_box(radius, *half_extents):
    return {"type": "rounded", "radius": radius, "shape": box(*(h - radius for h in half_extents))}


objects = [thing for thing in robot_arm.objects if thing["name"] != "floor"]
objects += [
    body("floor", box(half_x, half_y, wall), "planks", [middle_x, middle_y, -wall]),
    body("ceiling", box(half_x, half_y, wall), "plaster", [middle_x, middle_y, height + wall]),
    body("back wall", box(half_x + 2 * wall, wall, height / 2), "plaster", [middle_x, back + wall, height / 2]),
    body("front wall", box(half_x + 2 * wall, wall, height / 2), "plaster", [middle_x, front - wall, height / 2]),
    body("right wall", box(wall, half_y, height / 2), "plaster", [right + wall, middle_y, height / 2]),
    body("skirting", round_box(0.008, half_x, 0.015, 0.05), "plaster", [middle_x, back - 0.015, 0.05]),
]

# The left wall around a window, behind which the sky shines.
low, high, near, far = 0.75, 2.05, -1.5, 0.6
x = left - wall
objects += [
    body("under the window", box(wall, half_y, low / 2), "plaster", [x, middle_y, low / 2]),
    body("over the window", box(wall, half_y, (height - high) / 2), "plaster", [x, middle_y, (high + height) / 2]),
    body("before the window", box(wall, (near - front) / 2, (high - low) / 2), "plaster",
         [x, (near + front) / 2, (low + high) / 2]),
    body("behind the window", box(wall, (back - far) / 2, (high - low) / 2), "plaster",
         [x, (back + far) / 2, (low + high) / 2]),
    body("sill", round_box(0.015, 0.16, (far - near) / 2 + 0.06, 0.02), "white", [x + 0.05, (near + far) / 2, low]),
    body("mullion", round_box(0.01, 0.03, 0.03, (high - low) / 2), "white", [x, (near + far) / 2, (low + high) / 2]),
    body("sky", box(0.01, (far - near) / 2 + 0.1, (high - low) / 2 + 0.1), "daylight",
         [left - 2 * wall - 0.02, (near + far) / 2, (low + high) / 2]),
]

# A shelf on the back wall with parts' bins, and a lamp over the work.
board = 1.05
objects.append(body("board", round_box(0.008, 0.75, 0.15, 0.016), "oak", [1.0, back - 0.17, board]))
for i, (material, width, tall) in enumerate([("orange", 0.11, 0.1), ("blue", 0.11, 0.13), ("white", 0.11, 0.09),
                                             ("blue", 0.11, 0.1), ("orange", 0.11, 0.14)]):
    objects.append(body(f"bin {i + 1}", round_box(0.018, width, 0.11, tall), material,
                        [0.44 + 0.28 * i, back - 0.18, board + 0.0161 + tall], turn(Z, [4, -7, 2, -3, 9][i])))
lamp = [0.55, -0.15, 1.95]
objects += [
    body("shade", {"type": "hull_of", "shapes": [
        {"type": "disk", "radius": 0.22}, {"type": "transform", "shape": {"type": "disk", "radius": 0.07},
                                          "translate": [0, 0, 0.16]}]}, "dark", [lamp[0], lamp[1], lamp[2] + 0.012]),
    body("bulb", {"type": "disk", "radius": 0.19}, "lamp", lamp),
    body("cable", {"type": "capsule", "radius": 0.006, "half_height": 0.17}, "dark",
         [lamp[0], lamp[1], lamp[2] + 0.36]),
    body("tube", {"type": "capsule", "radius": 0.022, "half_height": 0.7}, "tube", [1.0, back - 0.06, 1.75],
         turn([0, 1, 0], 90)),
]

# On the floor.
objects += [
    body("crate", round_box(0.02, 0.24, 0.2, 0.2), "oak", [-0.75, 0.75, 0.2], turn(Z, 24)),
    body("vase", {"type": "hull_of", "shapes": [
        {"type": "transform", "shape": {"type": "disk", "radius": 0.06}, "translate": [0, 0, 0.3]},
        {"type": "sphere", "radius": 0.13}, {"type": "transform", "shape": {"type": "disk", "radius": 0.08},
                                             "translate": [0, 0, -0.12]}]}, "copper", [-0.7, 0.72, 0.521]),
    body("ball of glass", {"type": "sphere", "radius": 0.11}, "glass", [1.18, -0.75, 0.11]),
]

dark = [0.05, 0.05, 0.055]
write("robot-room.json", {
    "$schema": "scene.schema.json",
    "version": 1,
    "description": "A Universal Robots UR10 arm, each link the convex hull of its mesh, at work in a room that a "
                   "window, a lamp and a tube light; all of them are bodies that shine.",
    "camera": {"position": [2.15, -2.75, 1.35], "look_at": [0.42, 0.05, 0.78], "up": Z,
               "fov_y_degrees": 33, "resolution": [960, 720]},
    "lights": [],
    "materials": [
        {"name": "silver", "type": "principled", "base_color": [0.72, 0.73, 0.74], "metallic": 0.7, "roughness": 0.32},
        {"name": "blue", "type": "principled", "base_color": [0.06, 0.2, 0.42], "roughness": 0.3, "coat": 1},
        {"name": "dark", "type": "principled", "base_color": dark, "roughness": 0.4},
        {"name": "orange", "type": "principled", "base_color": [0.8, 0.2, 0.02], "roughness": 0.3, "coat": 1},
        {"name": "white", "type": "principled", "base_color": [0.8, 0.8, 0.78], "roughness": 0.3},
        {"name": "wood", "type": "principled", "base_color": {
            "type": "wood", "a": [0.46, 0.27, 0.13], "b": [0.25, 0.12, 0.05], "scale": 0.07}, "roughness": 0.4},
        {"name": "oak", "type": "principled", "base_color": {
            "type": "wood", "a": [0.62, 0.44, 0.26], "b": [0.4, 0.25, 0.12], "scale": 0.06}, "roughness": 0.5},
        {"name": "planks", "type": "principled", "base_color": {
            "type": "checker", "a": [0.36, 0.34, 0.31], "b": [0.24, 0.225, 0.2], "scale": 0.4, "mapping": "planar"},
         "roughness": 0.25},
        {"name": "plaster", "type": "lambert", "color": [0.76, 0.74, 0.7]},
        {"name": "copper", "type": "conductor", "metal": "copper", "roughness": 0.25},
        {"name": "glass", "type": "dielectric", "absorption": [0.6, 0.2, 0.3]},
        {"name": "daylight", "type": "emissive", "radiance": [3.4, 4.2, 5.4]},
        {"name": "lamp", "type": "emissive", "radiance": [22, 15, 8]},
        {"name": "tube", "type": "emissive", "radiance": [5, 4.3, 3.3]},
    ],
    "objects": objects,
    "background": [0, 0, 0],
})
