#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes scenes/shape-zoo.json: every shape and every operator on a grid, each with its name."""
from scene_file import rounded, turn, write

X, Y, Z = [1, 0, 0], [0, 1, 0], [0, 0, 1]


def sphere(radius):
    return {"type": "sphere", "radius": radius}


def box(*half_extents):
    return {"type": "box", "half_extents": list(half_extents)}


def at(shape, *translate):
    return {"type": "transform", "shape": shape, "translate": list(translate)}


cone = {"type": "cone", "radius": 0.5, "half_height": 0.6}
disk = {"type": "disk", "radius": 0.6}
facing = turn(X, 70)  # flat shapes lean back to be seen

# Points and segments have no surface for a ray to hit: they are rounded a little.
rows = [
    ("basic", [
        ("point (rounded)", {"type": "rounded", "radius": 0.07, "shape": {
            "type": "point", "position": [0, 0, 0]}}, None),
        ("segment (rounded)", {"type": "rounded", "radius": 0.04, "shape": {
            "type": "segment", "points": [[-0.5, 0, -0.35], [0.5, 0, 0.35]]}}, None),
        ("triangle", {"type": "triangle",
                      "points": [[-0.6, -0.5, 0], [0.6, -0.5, 0], [0, 0.6, 0]]}, facing),
        ("disk", disk, facing),
        ("box", box(0.5, 0.4, 0.45), turn(Z, 30)),
    ]),
    ("round", [
        ("sphere", sphere(0.55), None),
        ("ellipsoid", {"type": "ellipsoid", "radii": [0.7, 0.45, 0.35]}, turn(Y, 25)),
        ("superellipsoid", {"type": "superellipsoid", "radii": [0.55, 0.55, 0.55],
                            "exponent": 4}, turn(Z, 30)),
        ("capsule", {"type": "capsule", "radius": 0.28, "half_height": 0.4}, turn(Y, 35)),
        ("tapered_capsule", {"type": "tapered_capsule", "radii": [0.36, 0.14],
                             "half_height": 0.4}, turn(Y, 35)),
    ]),
    ("turned", [
        ("cylinder", {"type": "cylinder", "radius": 0.45, "half_height": 0.5}, turn([1, 1, 0], 25)),
        ("cone", cone, turn([1, -1, 0], 15)),
        ("frustum", {"type": "frustum", "radii": [0.55, 0.25], "half_height": 0.45},
         turn([1, 1, 0], 20)),
        ("hull", {"type": "hull", "points": [
            [-0.6, -0.4, -0.4], [0.6, -0.5, -0.4], [0.5, 0.5, -0.4], [-0.4, 0.5, -0.3],
            [-0.3, -0.3, 0.5], [0.4, 0.1, 0.6], [0, -0.6, 0.1]]}, turn(Z, 15)),
        ("hull_of", {"type": "hull_of", "shapes": [
            at(sphere(0.35), -0.3, 0, -0.2), at(sphere(0.12), 0.6, 0, -0.35),
            at(disk, 0, 0, 0.45)]}, turn(Y, 15)),
    ]),
    ("operators", [
        ("rounded", {"type": "rounded", "radius": 0.15, "shape": box(0.38, 0.3, 0.3)}, turn(Z, 30)),
        ("minkowski_sum", {"type": "minkowski_sum", "shapes": [
            {"type": "triangle", "points": [[-0.3, -0.2, 0], [0.3, -0.2, 0], [0, 0.35, 0]]},
            {"type": "cylinder", "radius": 0.25, "half_height": 0.35}]}, turn([1, 1, 0], 20)),
        ("minkowski_difference", {"type": "minkowski_difference", "a": box(0.3, 0.3, 0.2),
                                  "b": {"type": "cone", "radius": 0.3, "half_height": 0.3}},
         turn(Z, 30)),
        ("transform", {"type": "transform", "shape": cone,
                       "matrix": [[1, 0, 0.6], [0, 0.7, 0], [0, 0, -0.9]]}, turn(Z, 20)),
        ("nested", {"type": "rounded", "radius": 0.06, "shape": {"type": "hull_of", "shapes": [
            {"type": "minkowski_difference", "a": at({"type": "transform", "shape": disk,
             "scale": 0.5}, 0, 0, 0.4), "b": box(0.15, 0.15, 0.02)},
            at(box(0.5, 0.1, 0.1), 0, 0, -0.4)]}}, turn(Z, 30)),
    ]),
]

step_x, step_y = 2.1, 2.0
objects = []
for r, (material, row) in enumerate(rows):
    for c, (name, shape, rotate) in enumerate(row):
        pose = {"translate": [(c - 2) * step_x, 0, (1.5 - r) * step_y]}
        if rotate:
            pose["rotate"] = rounded(rotate)
        objects.append({"name": name, "shape": shape, "material": material, "transform": pose})

write("shape-zoo.json", {
    "$schema": "scene.schema.json",
    "version": 1,
    "description": "Every shape and every operator of the algebra, with their names.",
    "labels": True,
    "camera": {"position": [0, -15.5, 1.6], "look_at": [0, 0, -0.15], "up": [0, 0, 1],
               "fov_y_degrees": 33, "resolution": [1280, 1000]},
    "lights": [
        {"type": "directional", "direction": [0.6, 1, -0.9], "color": [1, 0.96, 0.9],
         "intensity": 2.4},
        {"type": "environment", "zenith": [0.6, 0.65, 0.75], "nadir": [0.25, 0.24, 0.24]},
    ],
    "materials": [
        {"name": "basic", "type": "lambert", "color": [0.75, 0.6, 0.3]},
        {"name": "round", "type": "glossy", "color": [0.7, 0.2, 0.12], "roughness": 0.1},
        {"name": "turned", "type": "glossy", "color": [0.08, 0.4, 0.42], "roughness": 0.1},
        {"name": "operators", "type": "glossy", "color": [0.12, 0.2, 0.5], "roughness": 0.1},
    ],
    "objects": objects,
    "background": {"zenith": [0.75, 0.78, 0.82], "nadir": [0.55, 0.57, 0.6]},
})
