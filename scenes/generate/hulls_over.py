#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""hulls_over.py VISUAL.json COLLISION.json OUT.json: joins two imports of one robot: its visual shapes as solid
bodies, its collision shapes as tinted glass around them."""
import json
import sys


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        seen = json.load(file)
    with open(sys.argv[2], encoding="utf-8") as file:
        collision = json.load(file)
    seen["materials"].append({"name": "hull", "type": "dielectric", "index_of_refraction": 1,
                              "absorption": [3, 22, 70], "priority": 1})
    for item in collision["objects"]:
        item["name"] = "hull of " + item["name"]
        item["material"] = "hull"
        seen["objects"].append(item)
    seen["description"] = "What a robot looks like, and what of it collides."
    with open(sys.argv[3], "w", encoding="utf-8") as file:
        json.dump(seen, file)


main()
