#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes scenes/terrain.json: a robot with four legs that stands on a height field."""
import math

from scene_file import rounded, write

rows, size = 81, 6.0


def height(x, y):
    hills = 0.28 * math.sin(1.1 * x + 0.4) * math.cos(0.9 * y - 0.3) + 0.12 * math.sin(2.7 * x - 1.9 * y)
    stones = 0.03 * math.sin(9 * x + 2 * math.sin(5 * y)) * math.sin(8 * y - x)
    return hills + stones


def at_column(i):
    return size * (i / (rows - 1) - 0.5)


heights = [rounded([height(at_column(c), at_column(r)) for c in range(rows)], 3) for r in range(rows)]


def along(a, b):
    """The turn of z to the way from a to b."""
    d = [q - p for p, q in zip(a, b)]
    length = math.sqrt(sum(x * x for x in d))
    x, y, z = (v / length for v in d)
    w = math.sqrt((1 + z) / 2) if z > -1 else 0
    return [-y / (2 * w), x / (2 * w), 0, w] if w > 1e-6 else [1, 0, 0, 0]


objects = [{"name": "ground", "material": "earth", "height_field": {"heights": heights, "size": [size, size], "bottom": -0.9}}]


def rod(name, a, b, radius, material):
    middle = [(p + q) / 2 for p, q in zip(a, b)]
    objects.append({"name": name, "material": material,
                    "shape": {"type": "capsule", "radius": radius, "half_height": round(math.dist(a, b) / 2, 6)},
                    "transform": {"translate": rounded(middle), "rotate": rounded(along(a, b))}})


def ball(name, at, radius, material):
    objects.append({"name": name, "material": material, "shape": {"type": "sphere", "radius": radius},
                    "transform": {"translate": rounded(at)}})


foot_radius, thigh, shank = 0.045, 0.42, 0.42
feet = {"front left": (0.62, 0.34), "front right": (0.42, -0.34), "hind left": (-0.52, 0.34), "hind right": (-0.72, -0.34)}
ground = {name: height(x, y) for name, (x, y) in feet.items()}
body = sum(ground.values()) / 4 + 0.66
front = (ground["front left"] + ground["front right"]) / 2
hind = (ground["hind left"] + ground["hind right"]) / 2
pitch = -math.atan2(front - hind, 1.15)


def on_body(x, y, z):
    return [x * math.cos(pitch) + z * math.sin(pitch), y, body - x * math.sin(pitch) + z * math.cos(pitch)]


turn = [0, math.sin(pitch / 2), 0, math.cos(pitch / 2)]
objects.append({"name": "body", "material": "shell",
                "shape": {"type": "rounded", "radius": 0.07,
                          "shape": {"type": "box", "half_extents": [0.5, 0.14, 0.06]}},
                "transform": {"translate": rounded(on_body(0, 0, 0)), "rotate": rounded(turn)}})
objects.append({"name": "head", "material": "dark",
                "shape": {"type": "rounded", "radius": 0.04,
                          "shape": {"type": "box", "half_extents": [0.08, 0.09, 0.05]}},
                "transform": {"translate": rounded(on_body(0.66, 0, 0.04)), "rotate": rounded(turn)}})
objects.append({"name": "lidar", "material": "dark", "shape": {"type": "cylinder", "radius": 0.07, "half_height": 0.05},
                "transform": {"translate": rounded(on_body(0.3, 0, 0.19)), "rotate": rounded(turn)}})
for name, (x, y) in feet.items():
    hip = on_body(0.45 if name.startswith("front") else -0.45, math.copysign(0.26, y), 0)
    # The lowest that the ball can be above the slope.
    slope = max(height(x + dx, y + dy) - ground[name] + foot_radius - math.hypot(dx, dy) * 0
                for dx in (-0.03, 0, 0.03) for dy in (-0.03, 0, 0.03))
    foot = [x, y, ground[name] + slope]
    rod(name + " axle", on_body(0.45 if name.startswith("front") else -0.45, math.copysign(0.16, y), 0), hip, 0.075, "dark")
    # The knee is behind the line from hip to foot.
    d = math.dist(hip, foot)
    forward = (d * d + thigh * thigh - shank * shank) / (2 * d)
    aside = math.sqrt(max(thigh * thigh - forward * forward, 0))
    way = [(q - p) / d for p, q in zip(hip, foot)]
    back = [way[2], 0, -way[0]]
    length = math.hypot(*back)
    knee = [p + forward * w + aside * b / length for p, w, b in zip(hip, way, back)]
    rod(name + " thigh", hip, knee, 0.055, "shell")
    ball(name + " knee", knee, 0.06, "dark")
    rod(name + " shank", knee, foot, 0.032, "dark")
    ball(name + " foot", foot, foot_radius, "rubber")

write("terrain.json", {
    "$schema": "scene.schema.json",
    "version": 1,
    "description": "A robot with four legs on a height field.",
    "camera": {"position": [2.9, -3.1, 1.9], "look_at": [0, 0, 0.3], "up": [0, 0, 1], "fov_y_degrees": 30,
               "resolution": [800, 500]},
    "lights": [
        {"type": "directional", "direction": [0.8, 0.5, -0.7], "color": [1, 0.93, 0.82], "intensity": 2.6},
        {"type": "environment", "zenith": [0.45, 0.58, 0.8], "nadir": [0.25, 0.22, 0.18]},
    ],
    "materials": [
        {"name": "earth", "type": "lambert", "color": [0.34, 0.29, 0.2]},
        {"name": "shell", "type": "glossy", "color": [0.75, 0.45, 0.05], "roughness": 0.25},
        {"name": "dark", "type": "glossy", "color": [0.06, 0.065, 0.075], "roughness": 0.25},
        {"name": "rubber", "type": "lambert", "color": [0.03, 0.03, 0.03]},
    ],
    "objects": objects,
})
