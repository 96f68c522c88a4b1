# SPDX-License-Identifier: MIT
"""A lidar next to a moving robot: arm.py [ARM.URDF]"""
import sys

import numpy as np

import minkray as mk

scene = mk.Scene()
arm = scene.add_file(sys.argv[1] if len(sys.argv) > 1 else "arm.urdf")
scene.add_half_space([0, 0, 1], -0.1, name="ground")
sensor = np.eye(4)
sensor[:3, 3] = [1.5, 0, 0.5]
rays = mk.lidar((16, 360), sensor)
for elbow in 0.0, 0.8:
    arm.joints = {"elbow": elbow}
    hits = scene.cast_rays(rays, t_max=10)
    seen = np.isin(hits.object, arm.objects)
    print(f"elbow {elbow}: {seen.sum()} echoes of the arm, the nearest at {hits.distance[seen].min():.3f} m")
