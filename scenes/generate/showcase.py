#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes scenes/showcase.json, and scenes/showcase-studio.json, the same bodies of other materials in a studio: the
picture on the front page."""
import math
import random

from scene_file import after, rounded, turn, write

X, Y, Z = [1, 0, 0], [0, 1, 0], [0, 0, 1]
random.seed(11)


def sphere(radius):
    return {"type": "sphere", "radius": radius}


def box(*half_extents):
    return {"type": "box", "half_extents": list(half_extents)}


def round_off(radius, shape):
    return {"type": "rounded", "radius": radius, "shape": shape}


def moved(shape, translate=None, rotate=None, scale=None):
    pose = {"translate": translate, "rotate": rotate and rounded(rotate), "scale": scale}
    return {"type": "transform", "shape": shape, **{k: v for k, v in pose.items() if v is not None}}


def hull(points):
    return {"type": "hull", "points": [rounded(p, 4) for p in points]}


def dodecahedron(size):
    g = (1 + math.sqrt(5)) / 2
    corners = [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    for a in (-1 / g, 1 / g):
        for b in (-g, g):
            corners += [[0, a, b], [a, b, 0], [b, 0, a]]
    return hull([[size * c for c in p] for p in corners])


def octahedron(size):
    return hull([[s * size if i == axis else 0 for i in range(3)]
                 for axis in range(3) for s in (-1, 1)])


def pebble(radius):
    """A rounded hull of ten random points, and how high its centre lies when it touches the floor."""
    points = []
    for _ in range(10):
        v = [random.gauss(0, 1) for _ in range(3)]
        n = math.sqrt(sum(c * c for c in v))
        points.append([0.75 * v[0] / n, 0.6 * v[1] / n, 0.38 * v[2] / n])
    return round_off(radius, hull(points)), radius - min(p[2] for p in points)


objects = []


def add(name, shape, material, at, rotate=None, scale=None):
    thing = {"name": name, "shape": shape, "material": material, "transform": {"translate": at}}
    if rotate:
        thing["transform"]["rotate"] = rounded(rotate)
    if scale:
        thing["transform"]["scale"] = scale
    objects.append(thing)


add("floor", box(40, 40, 0.5), "floor", [0, 0, -0.5])

# The middle: the configuration space obstacle of a rounded octahedron and a tilted cylinder.
add("configuration space obstacle",
    {"type": "minkowski_difference", "a": octahedron(0.78),
     "b": moved({"type": "cylinder", "radius": 0.36, "half_height": 0.26}, rotate=turn(X, 35))},
    "coral", [0.1, 0.5, 1.2], turn(Z, 24))

# Minkowski sums.
add("triangle + disk", {"type": "minkowski_sum", "shapes": [
    {"type": "triangle", "points": [[-0.75, -0.45, 0], [0.75, -0.45, 0], [0, 0.8, 0]]},
    moved({"type": "disk", "radius": 0.4}, rotate=turn(X, 90)), sphere(0.07)]},
    "mustard", [2.3, 0.2, 0.47], turn(Z, -20))
add("box + cone", {"type": "minkowski_sum", "shapes": [
    box(0.34, 0.34, 0.12), {"type": "cone", "radius": 0.42, "half_height": 0.55}, sphere(0.05)]},
    "teal", [-1.95, 0.95, 0.72], turn(Z, 32))
add("segment + disk", {"type": "minkowski_sum", "shapes": [
    {"type": "segment", "points": [[-0.55, 0, -0.25], [0.55, 0, 0.25]]},
    {"type": "disk", "radius": 0.34}, sphere(0.04)]},
    "cream", [-0.75, -1.0, 0.29], turn(Z, 30))

# Rounded boxes and hulls.
add("rounded box", round_off(0.14, box(0.42, 0.42, 0.42)), "navy", [-2.3, -0.95, 0.56],
    turn(Z, 22))
add("rounded box on edge", round_off(0.06, box(0.3, 0.3, 0.3)), "coral", [2.75, -1.5, 0.36],
    turn(Z, -31))
add("rounded dodecahedron", round_off(0.1, dodecahedron(0.33)), "cream", [1.1, -1.05, 0.555],
    after(turn(Z, 10), turn(X, 31.717)))
for i, (x, y, angle, size, material) in enumerate([
        (0.3, -2.15, 10, 0.6, "navy"), (-3.55, -0.35, 60, 0.84, "mustard"),
        (1.55, -2.25, 120, 0.52, "teal"), (3.75, -0.45, 75, 0.9, "cream")]):
    shape, height = pebble(0.1)
    add(f"pebble {i + 1}", shape, material, rounded([x, y, size * height]), turn(Z, angle), size)

# Curves of other kinds.
add("superellipsoid", {"type": "superellipsoid", "radii": [0.62, 0.62, 0.62], "exponent": 3.2},
    "teal", [1.65, 2.0, 0.62], turn(Z, 25))
add("ellipsoid", {"type": "ellipsoid", "radii": [0.6, 0.36, 0.27]}, "coral", [-1.25, -2.15, 0.27],
    turn(Z, -25))
add("hull of balls", {"type": "hull_of", "shapes": [
    sphere(0.42), moved(sphere(0.16), [0.95, 0.1, -0.24]),
    moved(sphere(0.1), [-0.35, 0.75, 0.75])]}, "mustard", [-0.6, 2.6, 0.42], turn(Z, 15))
add("tapered capsule", {"type": "tapered_capsule", "radii": [0.3, 0.12], "half_height": 0.7},
    "navy", [3.3, 1.9, 0.993], turn([0.3, 1, 0], 8))
add("frustum", round_off(0.05, {"type": "frustum", "radii": [0.42, 0.2], "half_height": 0.4}),
    "cream", [-3.1, 2.1, 0.45])

write("showcase.json", {
    "$schema": "scene.schema.json",
    "version": 1,
    "description": "Rounded boxes and hulls, Minkowski sums, a configuration space obstacle and "
                   "other curved shapes on a glossy floor; nothing is made of triangles.",
    "camera": {"position": [0.5, -9.6, 4.6], "look_at": [0.05, 0, 0.55], "up": [0, 0, 1],
               "fov_y_degrees": 29, "resolution": [1280, 720]},
    "lights": [
        {"type": "directional", "direction": [0.75, 0.65, -1.15], "color": [1, 0.94, 0.85],
         "intensity": 2.5},
        {"type": "environment", "zenith": [0.62, 0.7, 0.85], "nadir": [0.3, 0.27, 0.24]},
    ],
    "materials": [
        {"name": "floor", "type": "glossy", "color": [0.16, 0.165, 0.18], "roughness": 0.06,
         "index_of_refraction": 1.7},
        {"name": "coral", "type": "glossy", "color": [0.85, 0.2, 0.12], "roughness": 0.12},
        {"name": "mustard", "type": "glossy", "color": [0.85, 0.55, 0.08], "roughness": 0.2},
        {"name": "teal", "type": "glossy", "color": [0.03, 0.4, 0.4], "roughness": 0.1},
        {"name": "navy", "type": "glossy", "color": [0.05, 0.1, 0.28], "roughness": 0.08},
        {"name": "cream", "type": "lambert", "color": [0.82, 0.77, 0.66]},
    ],
    "objects": objects,
    "background": {"zenith": [0.5, 0.6, 0.75], "nadir": [0.8, 0.82, 0.85]},
})

# In a studio: boxes that shine, a dark room.
PRECIOUS = {"superellipsoid": "glass", "triangle + disk": "gold", "ellipsoid": "copper", "segment + disk": "frosted",
            "rounded dodecahedron": "marble", "hull of balls": "pearl", "frustum": "wood", "tapered capsule": "brushed"}


def lamp(name, half_extents, at, rotate, material):
    return {"name": name, "shape": round_off(0.02, box(*half_extents)), "material": material,
            "transform": {"translate": at, "rotate": rounded(rotate)}}


write("showcase-studio.json", {
    "$schema": "scene.schema.json",
    "version": 1,
    "description": "The bodies of showcase.json of glass, metal, marble and lacquer in a studio: three boxes that shine "
                   "light them, and a dim room.",
    "camera": {"position": [0.5, -9.6, 4.6], "look_at": [0.05, 0, 0.5], "up": [0, 0, 1],
               "fov_y_degrees": 27.5, "resolution": [1280, 720]},
    "lights": [{"type": "environment", "zenith": [0.3, 0.33, 0.4], "nadir": [0.2, 0.19, 0.18]}],
    "materials": [
        {"name": "floor", "type": "glossy", "color": [0.33, 0.32, 0.31], "roughness": 0.1},
        {"name": "coral", "type": "glossy", "color": [0.8, 0.13, 0.07], "roughness": 0.12},
        {"name": "mustard", "type": "glossy", "color": [0.85, 0.5, 0.06], "roughness": 0.2},
        {"name": "teal", "type": "principled", "base_color": [0.02, 0.3, 0.3], "metallic": 0.5, "roughness": 0.35,
         "coat": 1},
        {"name": "navy", "type": "glossy", "color": [0.04, 0.09, 0.3], "roughness": 0.08},
        {"name": "cream", "type": "lambert", "color": [0.8, 0.75, 0.64]},
        {"name": "glass", "type": "dielectric", "absorption": [0.35, 0.08, 0.12]},
        {"name": "frosted", "type": "dielectric", "roughness": 0.25, "absorption": [0.3, 0.1, 0.1]},
        {"name": "gold", "type": "conductor", "metal": "gold", "roughness": 0.22},
        {"name": "copper", "type": "conductor", "metal": "copper", "roughness": 0.12},
        {"name": "brushed", "type": "conductor", "metal": "aluminium", "roughness": 0.4, "anisotropy": 0.8},
        {"name": "pearl", "type": "principled", "base_color": [0.75, 0.72, 0.74], "roughness": 0.3, "coat": 1,
         "sheen": 0.3},
        {"name": "marble", "type": "glossy", "roughness": 0.1, "color": {
            "type": "marble", "a": [0.82, 0.8, 0.76], "b": [0.09, 0.1, 0.11], "scale": 0.55}},
        {"name": "wood", "type": "principled", "roughness": 0.35, "base_color": {
            "type": "wood", "a": [0.5, 0.28, 0.12], "b": [0.22, 0.09, 0.03], "scale": 0.09}},
        {"name": "warm", "type": "emissive", "radiance": [24, 21, 17]},
        {"name": "cool", "type": "emissive", "radiance": [12, 15, 20]},
        {"name": "above", "type": "emissive", "radiance": [4, 4, 4]},
    ],
    "objects": [{**thing, "material": PRECIOUS.get(thing["name"], thing["material"])} for thing in objects] + [
        lamp("key", (1.6, 1.1, 0.03), [-5.2, -3.6, 5.6],
             after(turn(Z, 35), turn(Y, 48)), "warm"),
        lamp("rim", (0.35, 2.6, 0.03), [6.6, 4.2, 3.4], after(turn(Z, 30), turn(Y, -62)), "cool"),
        lamp("sky", (3.2, 2.2, 0.03), [0, 2, 8], [0, 0, 0, 1], "above"),
    ],
    "background": {"zenith": [0.1, 0.11, 0.13], "nadir": [0.3, 0.3, 0.31]},
})
