#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes scenes/bowl.json: a bowl, as a mesh of triangles, and dice that lie in it, as exact rounded boxes.

The dice are let down one after the other. Each is moved and turned a little, again and again, and stays
where that brings it lower without touching anything (Scene.distance_to).
Needs NumPy and the module minkray.
"""
import math

import minkray as mk
import numpy as np
from scene_file import rounded, write

random = np.random.default_rng(5)


def bowl(around=96):
    """A closed surface around z: the inside from the middle to the rim, and the outside back."""
    inside = [(0.9 * math.sin(a), 1 - 0.9 * math.cos(a)) for a in np.linspace(0, math.radians(78), 24)]
    rim = [(0.93, 0.83), (0.96, 0.81)]
    outside = [(math.sin(a), 1.02 - math.cos(a)) for a in np.linspace(math.radians(75), math.radians(24), 20)]
    profile = inside[1:] + rim + outside + [(0.36, 0.0)]
    vertices = [(0, 0, inside[0][1])]
    for radius, height in profile:
        for k in range(around):
            angle = 2 * math.pi * k / around
            vertices.append((radius * math.cos(angle), radius * math.sin(angle), height))
    vertices.append((0, 0, 0.0))
    at = lambda i, k: 1 + i * around + k % around
    triangles = [(0, at(0, k), at(0, k + 1)) for k in range(around)]
    for i in range(len(profile) - 1):
        for k in range(around):
            triangles += [(at(i, k), at(i + 1, k), at(i + 1, k + 1)), (at(i, k), at(i + 1, k + 1), at(i, k + 1))]
    last = len(profile) - 1
    triangles += [(len(vertices) - 1, at(last, k + 1), at(last, k)) for k in range(around)]
    return np.round(vertices, 5), np.array(triangles)


vertices, triangles = bowl()
assert mk.mesh_info(mk.mesh(vertices, triangles))["open_edges"] == 0

half, edge = 0.13, 0.03
die = mk.rounded(mk.box([half - edge] * 3), edge)
scene = mk.Scene()
scene.add(mk.mesh(vertices, triangles))
scene.add_half_space([0, 0, 1], 0)
scene.commit()


def matrix(q):
    x, y, z, w = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def pose_of(at, q):
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = matrix(q), at
    return pose


def times(p, q):
    (a, b, c, d), (x, y, z, w) = p, q
    return np.array([d * x + a * w + b * z - c * y, d * y - a * z + b * w + c * x,
                     d * z + a * y - b * x + c * w, d * w - a * x - b * y - c * z])


def gap(poses):
    """How far the die is from everything, at each pose."""
    return scene.distance_to(die, poses, within=1.0).lower


dice = []
while len(dice) < 16:
    q = random.normal(size=4)
    q /= np.linalg.norm(q)
    at = np.array([*(random.normal(size=2) * 0.25), 1.6])
    size = 0.2
    while size > 2e-4:
        steps = random.normal(size=(24, 3)) * size + [0, 0, -size]
        turns = random.normal(size=(24, 4)) * [size, size, size, 0] + [0, 0, 0, 1]
        ats = at + steps
        qs = np.array([times(t / np.linalg.norm(t), q) for t in turns])
        gaps = gap(np.array([pose_of(a, r) for a, r in zip(ats, qs)]))
        free = np.flatnonzero((gaps > 1e-4) & (ats[:, 2] < at[2] - 1e-6))
        if len(free) == 0:
            size *= 0.8
            continue
        best = free[np.argmin(ats[free, 2])]
        at, q = ats[best], qs[best]
    if np.hypot(at[0], at[1]) > 0.8:
        continue  # it fell beside the bowl
    q /= np.linalg.norm(q)
    dice.append((at, q))
    scene.add(die, pose_of(at, q))
    scene.commit()

colours = {"ivory": [0.8, 0.76, 0.65], "red": [0.6, 0.05, 0.04], "blue": [0.04, 0.12, 0.45]}
names = list(colours)
objects = [{"name": "bowl", "material": "glaze",
            "mesh": {"vertices": vertices.tolist(), "triangles": triangles.tolist()}}]
box = {"type": "rounded", "radius": edge, "shape": {"type": "box", "half_extents": [half - edge] * 3}}
for i, (at, q) in enumerate(dice):
    objects.append({"name": f"die {i + 1}", "shape": box, "material": names[i % len(names)],
                    "transform": {"translate": rounded(at), "rotate": rounded(q)}})
objects.append({"name": "table", "shape": {"type": "plane"}, "material": "wood"})

write("bowl.json", {
    "$schema": "scene.schema.json",
    "version": 1,
    "description": "Dice in a bowl: the bowl is a mesh, and the dice are exact rounded boxes.",
    "camera": {"position": [1.9, -2.2, 2.3], "look_at": [0, 0, 0.33], "up": [0, 0, 1], "fov_y_degrees": 30,
               "resolution": [640, 480]},
    "lights": [
        {"type": "directional", "direction": [0.5, 0.7, -1.2], "color": [1, 0.95, 0.88], "intensity": 2.2},
        {"type": "environment", "zenith": [0.55, 0.6, 0.7], "nadir": [0.3, 0.28, 0.26]},
    ],
    "materials": [
        {"name": "glaze", "type": "glossy", "color": [0.16, 0.3, 0.32], "roughness": 0.12},
        *({"name": name, "type": "glossy", "color": colour, "roughness": 0.15} for name, colour in colours.items()),
        {"name": "wood", "type": "lambert", "color": [0.32, 0.2, 0.11]},
    ],
    "objects": objects,
})
