#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes scenes/studio.json: a sample of each material and texture on one kind of body, in a studio's light."""
from scene_file import after, rounded, turn, write


def body(name, shape, material, translate, rotate=None):
    made = {"name": name, "shape": shape, "material": material,
            "transform": {"translate": rounded(translate)}}
    if rotate:
        made["transform"]["rotate"] = rounded(rotate)
    return made


# The hull of a ball and a rounded square: flat below, round above.
sample = {"type": "hull_of", "shapes": [
    {"type": "sphere", "radius": 0.36},
    {"type": "transform", "translate": [0, 0, -0.38],
     "shape": {"type": "rounded", "radius": 0.04, "shape": {"type": "box", "half_extents": [0.3, 0.3, 0]}}}]}

materials = [
    {"name": "floor", "type": "glossy", "color": [0.3, 0.3, 0.31], "roughness": 0.45},
    {"name": "softbox", "type": "emissive", "radiance": [15, 14.4, 13.6]},
    {"name": "strip", "type": "emissive", "radiance": [9, 12, 17]},
    {"name": "matt", "type": "lambert", "color": [0.75, 0.3, 0.22]},
    {"name": "plastic", "type": "glossy", "color": [0.05, 0.22, 0.5], "roughness": 0.15},
    {"name": "gold", "type": "conductor", "metal": "gold", "roughness": 0.2},
    {"name": "brushed", "type": "conductor", "metal": "aluminium", "roughness": 0.4, "anisotropy": 0.8},
    {"name": "glass", "type": "dielectric", "absorption": [0.5, 0.1, 0.25]},
    {"name": "frosted", "type": "dielectric", "roughness": 0.3},
    {"name": "lacquer", "type": "principled", "base_color": [0.5, 0.02, 0.03], "metallic": 0.6,
     "roughness": 0.35, "coat": 1},
    {"name": "velvet", "type": "principled", "base_color": [0.16, 0.05, 0.22], "roughness": 0.9,
     "specular": 0.2, "sheen": 1},
    {"name": "checker", "type": "glossy", "roughness": 0.2, "color": {
        "type": "checker", "a": [0.8, 0.78, 0.72], "b": [0.06, 0.1, 0.12], "scale": 0.15, "mapping": "box"}},
    {"name": "marble", "type": "principled", "roughness": 0.25, "base_color": {
        "type": "marble", "a": [0.82, 0.8, 0.77], "b": [0.12, 0.16, 0.16], "scale": 0.45}},
    {"name": "wood", "type": "principled", "roughness": 0.45, "coat": 0.5, "coat_roughness": 0.1, "base_color": {
        "type": "wood", "a": [0.5, 0.27, 0.12], "b": [0.19, 0.075, 0.028], "scale": 0.09}},
    {"name": "rust", "type": "lambert", "color": {
        "type": "noise", "a": [0.36, 0.13, 0.05], "b": [0.1, 0.045, 0.03], "scale": 0.2}},
    {"name": "rusty", "type": "mix", "materials": ["brushed", "rust"], "amount": 0.6},
]
shown = ["matt", "plastic", "velvet", "lacquer", "rusty", "brushed",
         "glass", "frosted", "checker", "marble", "wood", "gold"]

objects = [
    body("floor", {"type": "plane"}, "floor", [0, 0, 0]),
    body("softbox", {"type": "rounded", "radius": 0.05, "shape": {"type": "box", "half_extents": [1.6, 1.0, 0]}},
         "softbox", [-2.6, -1.2, 4.4], turn([0, 1, 0], 32)),
    body("strip", {"type": "capsule", "radius": 0.09, "half_height": 1.8}, "strip", [3.4, 0.6, 2.3],
         after(turn([0, 0, 1], 25), turn([1, 0, 0], 90)))]
for i, name in enumerate(shown):
    row, column = divmod(i, 6)
    objects.append(body(name, sample, name, [-2.4 + 0.96 * column + 0.22 * row, 0.75 - 1.15 * row, 0.42],
                        turn([0, 0, 1], 24)))

scene = {
    "$schema": "scene.schema.json",
    "version": 1,
    "description": "Materials and textures, each on the hull of a ball and a rounded square: matt, plastic, velvet, lacquer, rusty and brushed aluminium, clear and frosted glass, a checkerboard, marble, wood, gold.",
    "camera": {"position": [0.3, -7.6, 3.6], "look_at": [0.14, 0.1, 0.3], "fov_y_degrees": 22.5,
               "resolution": [1280, 720], "aperture": 0.1, "focus_on": "checker"},
    "lights": [{"type": "environment", "zenith": [0.16, 0.18, 0.22], "nadir": [0.06, 0.06, 0.06]}],
    "materials": materials,
    "objects": objects,
    "background": {"zenith": [0.03, 0.035, 0.045], "nadir": [0.05, 0.05, 0.05]},
}
write("studio.json", scene)
