# SPDX-License-Identifier: MIT
"""Casts rays as a user of the Python module does: python_rays.py FOLDER (see python_rows.cpp).

Reads FOLDER/poses and FOLDER/rays, numbers of float64, casts at each line of standard input, answers with
nanoseconds of processor time, and writes FOLDER/t and FOLDER/object at the end.
"""
import sys
import time

import minkray as mk
import numpy as np


def main():
    folder = sys.argv[1]
    shape = mk.rounded(mk.box([0.5, 0.35, 0.2]), 0.1)
    scene = mk.Scene()
    for pose in np.fromfile(folder + "/poses").reshape(-1, 3, 4):
        scene.add(shape, pose)
    rays = np.fromfile(folder + "/rays").reshape(-1, 6)
    hits = None
    print("ready", flush=True)
    for _ in sys.stdin:
        hits = None
        begin = time.process_time_ns()
        hits = scene.cast_rays(rays, threads=1)
        print(time.process_time_ns() - begin, flush=True)
    hits.t.tofile(folder + "/t")
    hits.object.tofile(folder + "/object")


main()
