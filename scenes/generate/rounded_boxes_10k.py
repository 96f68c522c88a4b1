#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes scenes/rounded-boxes-10k.json: 10,000 rounded boxes, turned at random, along a spiral of
sunflower seeds (Vogel 1979) over a hill."""
import math
import random

from scene_file import rounded, write

count = 10000
golden_angle = math.pi * (3 - math.sqrt(5))
spacing = 0.62  # of neighbours along the spiral
random.seed(2)

palette = {
    "sand": [0.76, 0.6, 0.36], "rust": [0.6, 0.2, 0.07], "ink": [0.05, 0.1, 0.22],
    "sky": [0.2, 0.45, 0.7], "moss": [0.2, 0.34, 0.12], "bone": [0.8, 0.77, 0.7],
}
names = list(palette)


def random_turn():
    """Uniform over all rotations (Shoemake 1992)."""
    u, v, w = random.random(), 2 * math.pi * random.random(), 2 * math.pi * random.random()
    a, b = math.sqrt(1 - u), math.sqrt(u)
    return [a * math.sin(v), a * math.cos(v), b * math.sin(w), b * math.cos(w)]


objects = []
for i in range(count):
    r = spacing * math.sqrt(i + 0.5)
    x, y = r * math.cos(i * golden_angle), r * math.sin(i * golden_angle)
    z = 9 * math.exp(-(r / 22) ** 2) + 1.2 * math.cos(r / 3.2)
    half = [random.uniform(0.22, 0.5) for _ in range(3)]
    radius = random.uniform(0.02, 0.16)
    ring = int((r / 3.2) / math.pi + 0.5 + random.uniform(-0.35, 0.35))
    objects.append({
        "name": f"box {i}",
        "shape": {"type": "rounded", "radius": round(radius, 3),
                  "shape": {"type": "box", "half_extents": rounded(half, 3)}},
        "material": names[ring % len(names)],
        "transform": {"translate": rounded([x, y, z], 3), "rotate": rounded(random_turn(), 4)},
    })

write("rounded-boxes-10k.json", {
    "$schema": "scene.schema.json",
    "version": 1,
    "description": "10,000 rounded boxes, turned at random, on a spiral over a hill.",
    "camera": {"position": [0, -74, 40], "look_at": [0, -2, -2], "up": [0, 0, 1],
               "fov_y_degrees": 42, "resolution": [1280, 720]},
    "lights": [
        {"type": "directional", "direction": [1, 0.7, -0.9], "color": [1, 0.93, 0.82],
         "intensity": 2.6},
        {"type": "environment", "zenith": [0.5, 0.62, 0.85], "nadir": [0.2, 0.18, 0.15]},
    ],
    "materials": [{"name": name, "type": "lambert", "color": colour}
                  for name, colour in palette.items()],
    "objects": objects,
    "background": {"zenith": [0.35, 0.45, 0.6], "nadir": [0.02, 0.025, 0.035]},
})
