#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes scenes/figure-1.json: Figure 1 of van den Bergen, "Ray Casting against General Convex
Objects with Application to Continuous Collision Detection" (2004)."""
import math

from scene_file import rounded, turn, write

half = [0.75, 0.6, 0.5]  # of the box A
radius = 0.42  # of the sphere B
start = [-2.3, -0.3, 1.78]  # B's centre before it moves
direction = [1.0, 0.05, -0.62]
left, right = [-1.6, 0, 0], [2.2, 0, 0]  # where the two halves of the figure stand


def plus(a, b, factor=1.0):
    return [x + factor * y for x, y in zip(a, b)]


def norm(v):
    return math.sqrt(sum(x * x for x in v))


def out_of_box(p):
    """From the closest point of A to p."""
    return [x - max(-h, min(h, x)) for x, h in zip(p, half)]


# Walk along the ray by the distance that is free: the hit spot on A + ball, the obstacle A - B moved
# by B's start.
speed, t = norm(direction), 0.0
for _ in range(200):
    t += (norm(out_of_box(plus(start, direction, t))) - radius) / speed
hit = plus(start, direction, t)
normal = [x / radius for x in out_of_box(hit)]
contact = plus(hit, normal, -radius)


def along(v):
    """The quaternion that turns +z to v."""
    length = norm(v)
    axis = [-v[1], v[0], 0]
    angle = math.degrees(math.acos(v[2] / length))
    return turn(axis, angle) if norm(axis) > 0 else [0, 0, 0, 1]


objects = []


def add(name, shape, material, translate, rotate=None):
    pose = {"translate": rounded(translate)}
    if rotate:
        pose["rotate"] = rounded(rotate)
    objects.append({"name": name, "shape": shape, "material": material, "transform": pose})


def line(name, a, b, material, thickness=0.018):
    v = plus(b, a, -1)
    add(name, {"type": "capsule", "radius": thickness, "half_height": round(norm(v) / 2, 6)},
        material, plus(a, v, 0.5), along(v))


def arrow(name, a, v, material):
    tip = 0.2
    shaft = plus(a, v, 1 - tip / norm(v))
    line(name, a, shaft, material)
    add(name + "'s tip", {"type": "cone", "radius": 0.06, "half_height": tip / 2}, material,
        plus(a, v, 1 - tip / 2 / norm(v)), along(v))


box = {"type": "box", "half_extents": half}
ball = {"type": "sphere", "radius": radius}

# Left: the box, the sphere where it starts, its way, and where it touches.
add("box A", box, "a", left)
add("sphere B", ball, "b", plus(left, start))
on_the_way = plus(start, direction, radius / speed)
arrow("motion of B", plus(left, on_the_way), [(t - 2.3 * radius / speed) * x for x in direction], "ink")
add("B at contact", ball, "b pale", plus(left, hit))
add("contact point", {"type": "sphere", "radius": 0.05}, "dot", plus(left, contact))

# Right: the obstacle A - B, which the ray from the origin meets where B's centre touches.
add("A - B", {"type": "minkowski_difference", "a": box, "b": ball}, "cso", right)
add("origin", {"type": "sphere", "radius": 0.05}, "ink", plus(right, start))
line("ray", plus(right, start), plus(right, hit), "ink")
add("hit spot", {"type": "sphere", "radius": 0.05}, "dot", plus(right, hit))
arrow("normal", plus(right, hit), [0.9 * x for x in normal], "arrow")

write("figure-1.json", {
    "$schema": "scene.schema.json",
    "version": 1,
    "description": "Figure 1 of van den Bergen (2004): where a moving sphere B touches a box A is "
                   "where a ray enters the configuration space obstacle A - B.",
    "camera": {"position": [-0.6, -11.5, 3.4], "look_at": [-0.42, 0, 0.6], "up": [0, 0, 1],
               "fov_y_degrees": 22, "resolution": [1280, 640]},
    "lights": [
        {"type": "directional", "direction": [0.6, 1, -1.3], "color": [1, 1, 1], "intensity": 1.8},
        {"type": "environment", "zenith": [0.75, 0.75, 0.75], "nadir": [0.4, 0.4, 0.4]},
    ],
    "materials": [
        {"name": "a", "type": "lambert", "color": [0.2, 0.42, 0.65]},
        {"name": "b", "type": "lambert", "color": [0.75, 0.3, 0.12]},
        {"name": "b pale", "type": "lambert", "color": [0.85, 0.6, 0.45]},
        {"name": "cso", "type": "lambert", "color": [0.5, 0.55, 0.42]},
        {"name": "ink", "type": "lambert", "color": [0.02, 0.02, 0.02]},
        {"name": "dot", "type": "lambert", "color": [0.95, 0.95, 0.95]},
        {"name": "arrow", "type": "lambert", "color": [0.7, 0.05, 0.05]},
    ],
    "objects": objects,
    "background": [0.9, 0.9, 0.9],
})
