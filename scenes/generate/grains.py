#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes a scene of a heap of grains under the evening sky, and their poses beside it:

  python3 scenes/generate/grains.py grains.json [COUNT]

A million of them, if no count is given: ellipsoids, rounded boxes and rounded hulls, none like its
neighbour. They fill the heap in a lattice that is shaken; what lies below is as real as what is seen.
"""
import json
import math
import random
import struct
import sys
from pathlib import Path

HEIGHT, RADIUS = 0.56, 1.0  # of the heap
COLOURS = {"sand": [0.66, 0.49, 0.3], "ochre": [0.55, 0.32, 0.13], "chalk": [0.74, 0.7, 0.62],
           "slate": [0.2, 0.22, 0.25], "brick": [0.42, 0.15, 0.09]}
WEIGHTS = [10, 5, 5, 3, 2]


def surface(x, y):
    """The heap's height: a cone with a blunt top, slid here and there."""
    r = math.hypot(x, y) / RADIUS
    slides = 0.02 * math.sin(7 * x + 2 * y) * math.sin(5 * y - x) + 0.012 * math.sin(13 * x - 9 * y)
    return HEIGHT * (1 - (r * r + 0.008) ** 0.5 + 0.1 * r * (1 - r)) + slides * (1 - r)


def spots(spacing, random):
    """A body-centred lattice under the surface, shaken."""
    steps = int(1.3 * RADIUS / spacing)
    for k in range(2 * int(HEIGHT / spacing) + 4):
        offset = 0.5 * (k % 2)
        for i in range(-steps, steps + 1):
            for j in range(-steps, steps + 1):
                x, y, z = ((a + b + 0.42 * random.uniform(-1, 1)) * spacing
                           for a, b in ((i, offset), (j, offset), (0.5 * k, 0)))
                if z < surface(x, y):
                    yield x, y, z


def spacing_for(count):
    """The volume under the surface, by a coarse lattice; two grains are in each cube."""
    step = 0.02
    volume = sum(max(surface(i * step, j * step), 0) for i in range(-65, 66) for j in range(-65, 66))
    return (2 * volume * step * step / count) ** (1 / 3)


def rotation(random):
    while True:
        q = [random.uniform(-1, 1) for _ in range(4)]
        square = sum(c * c for c in q)
        if 0.01 < square <= 1:
            return [c / math.sqrt(square) for c in q]


def main():
    out = Path(sys.argv[1])
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 1000000
    generator = random.Random(5)
    spacing = spacing_for(count)
    while True:  # a few per cent are missing: the surface cuts the lattice
        found = list(spots(spacing, generator))
        if len(found) >= count:
            break
        spacing *= 0.99
    generator.shuffle(found)
    a = 0.5 * spacing
    shapes = {
        "pebbles": {"type": "ellipsoid", "radii": [1.15 * a, 0.95 * a, 0.75 * a]},
        "crumbs": {"type": "rounded", "radius": 0.25 * a,
                   "shape": {"type": "box", "half_extents": [0.62 * a, 0.5 * a, 0.42 * a]}},
        "chips": {"type": "rounded", "radius": 0.18 * a, "shape": {"type": "hull", "points": [
            [0.8 * a, 0, -0.3 * a], [-0.6 * a, 0.6 * a, -0.35 * a], [-0.5 * a, -0.7 * a, -0.2 * a],
            [0.3 * a, 0.3 * a, 0.5 * a], [-0.3 * a, -0.2 * a, 0.6 * a], [0.5 * a, -0.5 * a, 0.2 * a]]}}}
    particles = []
    for k, (name, shape) in enumerate(shapes.items()):
        mine = found[:count][k::len(shapes)]
        file = out.with_name(f"{out.stem}-{name}.f32")
        with file.open("wb") as rows:
            for place in mine:
                scale = generator.uniform(0.75, 1.3)
                material = generator.choices(range(len(COLOURS)), WEIGHTS)[0]
                rows.write(struct.pack("<9f", *place, *rotation(generator), scale, material))
        particles.append({"name": name, "shape": shape, "materials": list(COLOURS),
                          "columns": ["position", "rotation", "scale", "material"],
                          "count": len(mine), "file": file.name})
    scene = {
        "version": 1,
        "description": f"A heap of {count} grains under the evening sky, and three larger bodies in it.",
        "camera": {"position": [0.6, -1.9, 0.42], "look_at": [0.03, 0, 0.2], "fov_y_degrees": 26,
                   "aperture": 0.02, "focus_on": "ball", "resolution": [960, 540]},
        "lights": [{"type": "sun_sky", "sun": [-1, -0.75, 0.62], "turbidity": 3, "intensity": 0.3}],
        "materials": [{"name": "ground", "type": "lambert", "color": [0.4, 0.36, 0.31]},
                      {"name": "steel", "type": "conductor", "metal": "chromium", "roughness": 0.05},
                      {"name": "lacquer", "type": "glossy", "color": [0.55, 0.03, 0.02], "roughness": 0.08},
                      {"name": "enamel", "type": "glossy", "color": [0.03, 0.16, 0.3], "roughness": 0.1}]
                     + [{"name": name, "type": "glossy", "color": colour, "roughness": 0.45}
                        for name, colour in COLOURS.items()],
        "objects": [
            {"name": "ground", "shape": {"type": "plane"}, "material": "ground"},
            {"name": "ball", "shape": {"type": "sphere", "radius": 0.13}, "material": "steel",
             "transform": {"translate": [0.3, -0.72, 0.2]}},
            {"name": "box", "shape": {"type": "rounded", "radius": 0.02, "shape":
                {"type": "box", "half_extents": [0.075, 0.075, 0.075]}}, "material": "lacquer",
             "transform": {"translate": [-0.28, -0.52, 0.33], "rotate": [0.2, 0.25, 0.3, 0.9]}},
            {"name": "top", "shape": {"type": "cone", "radius": 0.1, "half_height": 0.12}, "material": "enamel",
             "transform": {"translate": [0.62, -0.2, 0.24], "rotate": [0.3, 0.35, 0, 0.89]}}],
        "particles": particles}
    out.write_text(json.dumps(scene, indent=1) + "\n")


if __name__ == "__main__":
    main()
