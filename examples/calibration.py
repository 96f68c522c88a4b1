# SPDX-License-Identifier: MIT
"""A lidar's pose found back from its scan of a known room, by Gauss-Newton with derivatives of rays."""
import numpy as np

import minkray as mk


def pose_of(position, turn):
    """A pose that turns about the rotation vector."""
    angle = float(np.linalg.norm(turn))
    x, y, z = np.asarray(turn) / max(angle, 1e-300)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    pose = np.eye(4)
    pose[:3, :3] += np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    pose[:3, 3] = position
    return pose


room = mk.Scene()
room.add_half_space([0, 0, 1], name="floor")
for normal in [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]:
    room.add_half_space(normal, -4, name="wall")
room.add(mk.cylinder(0.3, 1.2), pose_of([1, 2, 0.6], [0, 0, 0]), name="bin")
room.add(mk.rounded(mk.box([0.5, 0.4, 0.3]), 0.05), pose_of([-2, 1, 0.35], [0, 0, 0.5]), name="crate")
room.add(mk.ellipsoid([0.6, 0.5, 0.9]), pose_of([2, -1.5, 0.9], [0.2, 0, 0]), name="tank")

true_pose = pose_of([0.3, -0.2, 0.8], [0.02, -0.03, 0.7])
scan = room.cast_rays(mk.lidar((16, 360), true_pose))

pose = pose_of([0.4, -0.25, 0.85], [0.05, 0.01, 0.6])  # measured by hand
for step in range(20):
    rays = mk.lidar((16, 360), pose)
    hits = room.cast_rays(rays, jac=True)
    off = hits.t - scan.t
    # A ray through an edge has no derivative. A ray that now hits another object is useless.
    use = (hits.status == mk.HIT) & (scan.status == mk.HIT) & ~hits.is_ridge & (hits.object == scan.object)
    use[use] = np.abs(off[use]) <= 5 * np.median(np.abs(off[use])) + 1e-12
    # The sensor moves by v, and turns by w about its own origin: w x direction turns the ray.
    by_turn = np.cross(rays[:, 3:], hits.jac_ray[:, 3:])
    jac = np.concatenate([hits.jac_ray[:, :3], by_turn], axis=1)[use]
    twist = -np.linalg.lstsq(jac, off[use], rcond=None)[0]
    turned = pose_of([0, 0, 0], twist[3:]) @ pose
    turned[:3, 3] = pose[:3, 3] + twist[:3]
    pose = turned
    print(f"step {step}: {use.sum()} rays, off by {np.sqrt(np.mean(off[use] ** 2)):.1e} m")
    if np.linalg.norm(twist) < 1e-11:
        break

error = np.abs(pose - true_pose).max()
print(f"the pose is found to {error:.1e}")
assert error < 1e-9
