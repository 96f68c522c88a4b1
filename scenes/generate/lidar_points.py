#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""lidar_points.py SCAN.csv OUT.json: the points of a scan (minkray scan -o SCAN.csv) as a scene of small
balls, coloured by height as lidars' pictures are."""
import csv
import json
import math
import sys

# Dark blue, blue, green, yellow, orange, from low to high (linear RGB).
ramp = [(0.015, 0.03, 0.16), (0.02, 0.16, 0.55), (0.03, 0.5, 0.42), (0.75, 0.62, 0.05), (0.9, 0.2, 0.03)]
steps = 48
lowest, highest = -0.02, 2.2


def colour(share):
    at = share * (len(ramp) - 1)
    i = min(int(at), len(ramp) - 2)
    return [round(a + (at - i) * (b - a), 4) for a, b in zip(ramp[i], ramp[i + 1])]


def main():
    rows = []
    with open(sys.argv[1], newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if int(row["object"]) < 0:
                continue
            x, y, z, distance = (float(row[key]) for key in ("x", "y", "z", "distance"))
            if math.hypot(x, y) > 7:
                continue
            share = min(max((z - lowest) / (highest - lowest), 0), 1)
            # Balls grow with the distance, as the gaps between them do.
            rows.append([x, y, z, round(0.0035 + 0.0016 * distance, 5), round(share * (steps - 1))])
    scene = {
        "version": 1,
        "description": "The points that a lidar's sweep met, coloured by height.",
        "camera": {"position": [7.4, -5.4, 4.6], "look_at": [0, 0, 0.35], "fov_y_degrees": 34,
                   "resolution": [960, 600]},
        "lights": [{"type": "environment", "zenith": [1, 1, 1], "nadir": [0.55, 0.55, 0.6]}],
        "materials": [{"name": f"height {i}", "type": "lambert", "color": colour(i / (steps - 1))}
                      for i in range(steps)],
        "objects": [],
        "particles": [{"name": "points", "shape": {"type": "sphere", "radius": 1},
                       "columns": ["position", "scale", "material"],
                       "materials": [f"height {i}" for i in range(steps)], "poses": rows}],
        "background": [0.012, 0.014, 0.02]}
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        json.dump(scene, file)


main()
