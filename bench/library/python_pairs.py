# SPDX-License-Identifier: MIT
"""Asks for distances as a user of the Python module does: python_pairs.py FOLDER (see python_rows.cpp).

Reads FOLDER/a and FOLDER/b, poses of float64, asks at each line of standard input, answers with nanoseconds of
processor time, and writes FOLDER/value at the end.
"""
import sys
import time

import minkray as mk
import numpy as np


def main():
    folder = sys.argv[1]
    brick = mk.box([1, 0.5, 0.25])
    poses_a = np.fromfile(folder + "/a").reshape(-1, 3, 4)
    poses_b = np.fromfile(folder + "/b").reshape(-1, 3, 4)
    found = None
    print("ready", flush=True)
    for _ in sys.stdin:
        begin = time.process_time_ns()
        found = mk.signed_distances(brick, poses_a, brick, poses_b, threads=1, out=found)
        print(time.process_time_ns() - begin, flush=True)
    found.value.tofile(folder + "/value")


main()
