# SPDX-License-Identifier: MIT
"""A depth image of a few shapes, and the point cloud of it: depth_to_points.py OUT.pcd"""
import sys

import numpy as np

import minkray as mk

scene = mk.Scene()
scene.add(mk.superellipsoid([0.6, 0.4, 0.5], 4), name="soap")
scene.add(mk.translated(mk.cone(0.4, 0.5), [1.2, 0.3, 0.2]), name="cone")
scene.add_half_space([0, 0, 1], -0.5, name="table")
K = np.array([[300, 0, 160], [0, 300, 120], [0, 0, 1]])
camera = np.array([[1, 0, 0, 0.3], [0, 0, 1, -4], [0, -1, 0, 0.5], [0, 0, 0, 1]])  # looks along y
hits = scene.cast_rays(mk.pinhole(K, camera, 320, 240))
print(hits)
met = hits.status == mk.HIT
print("nearest", hits.t[met].min(), "of", {scene.names[i] for i in np.unique(hits.object[met])})
if len(sys.argv) > 1:
    mk.write(sys.argv[1], hits.point[met], object=hits.object[met])
