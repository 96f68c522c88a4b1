#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes scenes/cornell.json: the box that renderers are shown with, around convex bodies."""
from scene_file import after, rounded, turn, write

wall, tall = 0.05, 1.0  # half a wall's thickness; half the room's size
white, red, green = [0.74, 0.74, 0.73], [0.62, 0.06, 0.05], [0.12, 0.46, 0.12]


def body(name, shape, material, translate, rotate=None):
    made = {"name": name, "shape": shape, "material": material,
            "transform": {"translate": rounded(translate)}}
    if rotate:
        made["transform"]["rotate"] = rounded(rotate)
    return made


def slab(name, half_extents, material, translate):
    return body(name, {"type": "box", "half_extents": half_extents}, material, translate)


golden = (1 + 5 ** 0.5) / 2
dodecahedron = ([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
                + [p for a in (-1 / golden, 1 / golden) for b in (-golden, golden)
                   for p in ([0, a, b], [a, b, 0], [b, 0, a])])
stone = {"type": "rounded", "radius": 0.045,
         "shape": {"type": "hull", "points": [rounded([0.19 * c for c in p], 4) for p in dodecahedron]}}
pillar = {"type": "minkowski_sum", "shapes": [
    {"type": "box", "half_extents": [0.14, 0.14, 0.42]},
    {"type": "disk", "radius": 0.09}, {"type": "sphere", "radius": 0.03}]}
lens = {"type": "superellipsoid", "radii": [0.26, 0.26, 0.26], "exponent": 3}
top = {"type": "hull_of", "shapes": [
    {"type": "sphere", "radius": 0.17},
    {"type": "transform", "shape": {"type": "sphere", "radius": 0.03}, "translate": [0, 0, 0.36]},
    {"type": "transform", "shape": {"type": "disk", "radius": 0.12}, "translate": [0, 0, -0.16]}]}

scene = {
    "$schema": "scene.schema.json",
    "version": 1,
    "description": "The Cornell box with convex bodies: a lamp that is a rounded box, a Minkowski sum of brushed copper, a rounded dodecahedron, a superellipsoid of glass and a hull of balls and a disk of gold.",
    "camera": {"position": [0, -3.9, 0.0], "look_at": [0, 0, 0.0], "fov_y_degrees": 39.5,
               "resolution": [800, 800]},
    "lights": [],
    "materials": [
        {"name": "white", "type": "lambert", "color": white},
        {"name": "red", "type": "lambert", "color": red},
        {"name": "green", "type": "lambert", "color": green},
        {"name": "lamp", "type": "emissive", "radiance": [17, 13.2, 8.6]},
        {"name": "glass", "type": "dielectric", "index_of_refraction": 1.5,
         "absorption": [0.9, 0.25, 0.15]},
        {"name": "copper", "type": "conductor", "metal": "copper", "roughness": 0.35,
         "anisotropy": 0.6},
        {"name": "gold", "type": "conductor", "metal": "gold", "roughness": 0.12},
        {"name": "stone", "type": "glossy", "color": [0.75, 0.72, 0.66], "roughness": 0.3}],
    "objects": [
        slab("floor", [tall + 2 * wall, tall, wall], "white", [0, 0, -tall - wall]),
        slab("ceiling", [tall + 2 * wall, tall, wall], "white", [0, 0, tall + wall]),
        slab("back", [tall, wall, tall], "white", [0, tall - wall, 0]),
        slab("left", [wall, tall, tall], "red", [-tall - wall, 0, 0]),
        slab("right", [wall, tall, tall], "green", [tall + wall, 0, 0]),
        body("lamp", {"type": "rounded", "radius": 0.02,
                      "shape": {"type": "box", "half_extents": [0.26, 0.2, 0]}},
             "lamp", [0, 0, 1]),
        body("pillar", pillar, "copper", [-0.5, 0.42, -tall + 0.45], turn([0, 0, 1], 22)),
        body("dodecahedron", stone, "stone", [0.46, 0.4, -tall + 0.308],
             after(turn([0, 0, 1], 15), turn([1, 0, 0], 31.7175))),
        body("superellipsoid", lens, "glass", [0.02, -0.36, -tall + 0.26], turn([0, 0, 1], 30)),
        body("top", top, "gold", [0.62, -0.34, -tall + 0.16])],
    "background": [0, 0, 0],
}
write("cornell.json", scene)
