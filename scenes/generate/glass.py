#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes scenes/glass.json: a glass with wine, a lens and a prism, by the light of four lamps."""
from scene_file import after, rounded, turn, write


def body(name, shape, material, translate, rotate=None):
    made = {"name": name, "shape": shape, "material": material,
            "transform": {"translate": rounded(translate)}}
    if rotate:
        made["transform"]["rotate"] = rounded(rotate)
    return made


tumbler = {"type": "rounded", "radius": 0.03,
           "shape": {"type": "frustum", "radii": [0.3, 0.37], "half_height": 0.47}}
hollow = {"type": "frustum", "radii": [0.27, 0.36], "half_height": 0.44}
wine = {"type": "frustum", "radii": [0.273, 0.3222], "half_height": 0.24}

scene = {
    "$schema": "scene.schema.json",
    "version": 1,
    "description": "Nested dielectrics: a tumbler of glass, hollow, with wine that reaches into its wall; a block of amber with an air bubble and a ball of gold in it; a prism; a frosted ball. Four shining bodies light them.",
    "camera": {"position": [0.1, -5.2, 2.0], "look_at": [0.02, 0, 0.42], "fov_y_degrees": 21.5,
               "resolution": [1280, 720]},
    "lights": [],
    "materials": [
        {"name": "table", "type": "glossy", "color": [0.5, 0.45, 0.4], "roughness": 0.35},
        {"name": "wall", "type": "lambert", "color": [0.6, 0.64, 0.68]},
        {"name": "soft", "type": "emissive", "radiance": [15, 14.2, 13]},
        {"name": "warm", "type": "emissive", "radiance": [26, 17, 8]},
        {"name": "cool", "type": "emissive", "radiance": [5, 8, 14]},
        {"name": "glass", "type": "dielectric", "index_of_refraction": 1.52,
         "absorption": [0.12, 0.04, 0.07]},
        {"name": "air", "type": "dielectric", "index_of_refraction": 1, "priority": 2},
        {"name": "wine", "type": "dielectric", "index_of_refraction": 1.34, "priority": 3,
         "absorption": [0.7, 6.5, 5.2]},
        {"name": "amber", "type": "dielectric", "index_of_refraction": 1.55,
         "absorption": [0.15, 0.9, 3.2]},
        {"name": "crystal", "type": "dielectric", "index_of_refraction": 1.7},
        {"name": "frosted", "type": "dielectric", "index_of_refraction": 1.5, "roughness": 0.35},
        {"name": "gold", "type": "conductor", "metal": "gold", "roughness": 0.1}],
    "objects": [
        body("table", {"type": "box", "half_extents": [6, 3, 0.5]}, "table", [0, 0, -0.5]),
        body("wall", {"type": "box", "half_extents": [6, 0.1, 3]}, "wall", [0, 2.6, 2]),
        body("window", {"type": "box", "half_extents": [0.05, 1.2, 1.0]}, "soft", [-3.2, -0.6, 2.0],
             turn([0, 1, 0], 25)),
        body("tube", {"type": "capsule", "radius": 0.05, "half_height": 0.9}, "cool", [2.5, 0.9, 1.7],
             turn([1, 0, 0], 90)),
        body("softbox", {"type": "rounded", "radius": 0.05, "shape": {"type": "box", "half_extents": [0.9, 0.6, 0]}},
             "soft", [1.2, -2.2, 4.2], turn([1, 0, 0], 25)),
        body("bulb", {"type": "sphere", "radius": 0.16}, "warm", [1.4, 1.6, 2.3]),
        body("tumbler", tumbler, "glass", [-0.75, 0.1, 0.5]),
        body("hollow", hollow, "air", [-0.75, 0.1, 0.591]),
        body("wine", wine, "wine", [-0.75, 0.1, 0.3909]),
        body("amber", {"type": "rounded", "radius": 0.06,
                       "shape": {"type": "box", "half_extents": [0.3, 0.22, 0.3]}}, "amber",
             [0.35, 0.35, 0.36], turn([0, 0, 1], 28)),
        body("bubble", {"type": "ellipsoid", "radii": [0.07, 0.07, 0.1]}, "air", [0.27, 0.2, 0.5]),
        body("bead", {"type": "sphere", "radius": 0.11}, "gold", [0.42, 0.3, 0.3]),
        body("prism", {"type": "hull", "points": [
            [-0.5, -0.17, 0], [-0.5, 0.17, 0], [-0.5, 0, 0.2944], [0.5, -0.17, 0], [0.5, 0.17, 0], [0.5, 0, 0.2944]]},
             "crystal", [0.2, -0.72, 0.0005], turn([0, 0, 1], 12)),
        body("frosted ball", {"type": "sphere", "radius": 0.3}, "frosted", [1.15, -0.1, 0.3]),
        body("lens", {"type": "ellipsoid", "radii": [0.3, 0.3, 0.1]}, "crystal",
             [-0.3, -0.55, 0.305], after(turn([0, 0, 1], -28), turn([1, 0, 0], 90)))],
    "background": [0, 0, 0],
}
write("glass.json", scene)
