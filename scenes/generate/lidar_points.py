#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""lidar_points.py SCAN.csv OUT.json [SCENE.json]: the points of a scan (minkray scan -o SCAN.csv) as small
balls, coloured by height as lidars' pictures are: a scene of their own, or put into the scene that was scanned."""
import csv
import json
import math
import sys

# Dark blue, blue, green, yellow, orange, from low to high (linear RGB).
ramp = [(0.015, 0.03, 0.16), (0.02, 0.16, 0.55), (0.03, 0.5, 0.42), (0.75, 0.62, 0.05), (0.9, 0.2, 0.03)]
steps = 48



def colour(share):
    at = share * (len(ramp) - 1)
    i = min(int(at), len(ramp) - 2)
    return [round(a + (at - i) * (b - a), 4) for a, b in zip(ramp[i], ramp[i + 1])]


def points_of(file, farthest):
    """Position and distance of each point within this range of the origin's axis."""
    for row in csv.DictReader(file):
        x, y, z, distance = (float(row[key]) for key in ("x", "y", "z", "distance"))
        if int(row["object"]) >= 0 and math.hypot(x, y) <= farthest:
            yield x, y, z, distance


def balls(points, lowest, highest, radius, growth):
    """Particles, one per point; they grow with the distance, as the gaps between them do."""
    poses = []
    for x, y, z, distance in points:
        share = min(max((z - lowest) / (highest - lowest), 0), 1)
        poses.append([x, y, z, round(radius + growth * distance, 5), round(share * (steps - 1))])
    return {"name": "points", "shape": {"type": "sphere", "radius": 1},
            "columns": ["position", "scale", "material"],
            "materials": [f"height {i}" for i in range(steps)], "poses": poses}


def alone(points):
    """A scene of nothing but the points."""
    return {
        "version": 1,
        "description": "The points that a lidar's sweep met, coloured by height.",
        "camera": {"position": [7.4, -5.4, 4.6], "look_at": [0, 0, 0.35], "fov_y_degrees": 34,
                   "resolution": [960, 600]},
        "lights": [{"type": "environment", "zenith": [1, 1, 1], "nadir": [0.55, 0.55, 0.6]}],
        "materials": [{"name": f"height {i}", "type": "lambert", "color": colour(i / (steps - 1))}
                      for i in range(steps)],
        "objects": [],
        "particles": [balls(points, -0.02, 2.2, 0.0035, 0.0016)],
        "background": [0.012, 0.014, 0.02]}


def put_into(scene, points):
    """The scene at dusk, with points that shine."""
    heights = [z for _, _, z, _ in points]
    scene["materials"] += [{"name": f"height {i}", "type": "emissive",
                            "radiance": [round(1.6 * c, 4) for c in colour(0.2 + 0.8 * i / (steps - 1))]}
                           for i in range(steps)]
    scene["particles"] = [balls(points, min(heights), max(heights), 0.0025, 0.0022)]
    for light in scene["lights"]:
        for key in {"intensity"} & light.keys():
            light[key] *= 0.4
        for key in {"zenith", "nadir"} & light.keys():
            light[key] = [round(0.5 * c, 4) for c in light[key]]
    return scene | {"background": [0.02, 0.026, 0.04]}


def main():
    with open(sys.argv[1], newline="", encoding="utf-8") as file:
        points = list(points_of(file, 7))
    scene = alone(points)
    if len(sys.argv) > 3:
        with open(sys.argv[3], encoding="utf-8") as file:
            scene = put_into(json.load(file), points)
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        json.dump(scene, file)


main()
