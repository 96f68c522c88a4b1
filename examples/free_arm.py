# SPDX-License-Identifier: MIT
"""An arm that is stuck in obstacles frees itself, by the derivatives of its distances: free_arm.py [ARM.URDF]"""
import sys

import numpy as np

import minkray as mk

MARGIN = 0.05  # least distance from all objects (m)

scene = mk.Scene()
arm = scene.add_file(sys.argv[1] if len(sys.argv) > 1 else "arm.urdf")
pose = np.eye(4)
for name, position, shape in [("ball", [0.45, 0, 0.75], mk.sphere(0.2)),
                              ("crate", [0.75, 0, 0.15], mk.box([0.2, 0.3, 0.15]))]:
    pose[:3, 3] = position
    scene.add(shape, pose, name)

assert scene.clearance(arm, [0.7, 1.5]).upper[0] < 0
joints, speed = np.array([0.7, 1.5]), np.zeros(2)
for step in range(200):
    near = scene.clearance(arm, joints, tolerance=1e-6, jac=True)
    distance, slope = near.lower[0], near.jac[0]
    names = scene.names[near.object_a[0]], scene.names[near.object_b[0]]
    print(f"step {step}: {names[0]} and {names[1]} are {distance:.4f} m apart at {joints.round(4)}")
    if distance >= MARGIN:
        break
    # Up the slope, with momentum: between two obstacles the slopes take turns.
    speed = 0.8 * speed + 0.02 * slope / np.linalg.norm(slope)
    joints = joints + speed

assert distance >= MARGIN, "it is still stuck"
print(f"the arm is free: nothing is nearer than {distance:.3f} m")
