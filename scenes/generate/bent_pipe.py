#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes scenes/bent-pipe.json: a pipe of cylinders that are cut where they meet (mitre joints)."""
import math

from scene_file import rounded, turn, write

radius = 0.34
# Length of each piece along the pipe's axis, and the bend before the next one in degrees.
pieces = [(1.5, 22.5)] + 3 * [(0.55, 22.5)] + [(1.0, 45), (1.6, 45), (1.0, -30)] + \
    5 * [(0.5, -30)] + [(1.4, 0)]

objects = []
x, z, heading, bend_before = -2.6, -1.7, 0.0, 0.0
for i, (length, bend) in enumerate(pieces):
    along = [math.sin(math.radians(heading)), math.cos(math.radians(heading))]
    below, above = math.tan(math.radians(bend_before / 2)), math.tan(math.radians(bend / 2))
    objects.append({
        "name": f"cut_cylinder {i + 1}",
        "shape": {"type": "cut_cylinder", "radius": radius,
                  "heights": rounded([-length / 2, length / 2]),
                  "lower_slope": rounded([below, 0]), "upper_slope": rounded([-above, 0])},
        "material": "copper" if i % 2 == 0 else "brass",
        "transform": {"translate": rounded([x + along[0] * length / 2, 0, z + along[1] * length / 2]),
                      "rotate": rounded(turn([0, 1, 0], heading))}})
    x, z = x + along[0] * length, z + along[1] * length
    heading, bend_before = heading + bend, bend
objects.append({"name": "floor", "shape": {"type": "box", "half_extents": [6, 3, 0.1]},
                "material": "floor", "transform": {"translate": [0, 0, -1.9]}})

write("bent-pipe.json", {
    "$schema": "scene.schema.json",
    "version": 1,
    "description": "A pipe of cylinders that are cut obliquely where they meet.",
    "camera": {"position": [0.6, -9.5, 2.2], "look_at": [0.3, 0, -0.2], "up": [0, 0, 1],
               "fov_y_degrees": 34, "resolution": [960, 600]},
    "lights": [
        {"type": "directional", "direction": [0.5, 1, -0.9], "color": [1, 0.96, 0.9],
         "intensity": 2.2},
        {"type": "environment", "zenith": [0.6, 0.65, 0.75], "nadir": [0.25, 0.24, 0.24]},
    ],
    "materials": [
        {"name": "copper", "type": "glossy", "color": [0.6, 0.28, 0.16], "roughness": 0.15},
        {"name": "brass", "type": "glossy", "color": [0.6, 0.47, 0.2], "roughness": 0.15},
        {"name": "floor", "type": "lambert", "color": [0.5, 0.5, 0.52]},
    ],
    "objects": objects,
    "background": {"zenith": [0.75, 0.78, 0.82], "nadir": [0.55, 0.57, 0.6]},
})
