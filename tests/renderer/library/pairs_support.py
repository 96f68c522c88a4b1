# SPDX-License-Identifier: MIT
"""Shapes, poses and slopes for tests of pairs."""
import numpy as np

import minkray as mk

RNG = np.random.default_rng(63)


def unit(rows):
    return rows / np.linalg.norm(rows, axis=-1, keepdims=True)


def random_poses(count, reach=3.0, rng=RNG):
    """(x, y, z, qw, qx, qy, qz)."""
    return np.concatenate([rng.uniform(-reach, reach, (count, 3)), unit(rng.normal(size=(count, 4)))], axis=1)


def matrices(poses):
    w, x, y, z = poses[..., 3:].T
    turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    matrix = np.zeros((len(poses), 4, 4))
    matrix[:, :3, :3] = np.moveaxis(turn, 2, 0)
    matrix[:, :3, 3] = poses[:, :3]
    matrix[:, 3, 3] = 1
    return matrix


def product(p, q):
    (a, b, c, d), (e, f, g, h) = np.moveaxis(p, -1, 0), np.moveaxis(q, -1, 0)
    return np.stack([a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g,
                     a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e], axis=-1)


def moved(poses, axis, by):
    """By a twist along one of its six axes."""
    poses = np.array(poses)
    if axis < 3:
        poses[:, axis] += by
        return poses
    turn = np.zeros(4)
    turn[0], turn[axis - 2] = np.cos(by / 2), np.sin(by / 2)
    poses[:, 3:] = product(turn, poses[:, 3:])
    return poses


def slope(f, step):
    """Of fourth order."""
    return (8 * (f(step) - f(-step)) - (f(2 * step) - f(-2 * step))) / (12 * step)


def off_slope(f, jac):
    """The least difference over some steps: one is near a kink of the second derivative, by chance."""
    with np.errstate(invalid="ignore"):
        off = np.abs([slope(f, step) - jac for step in (1e-4, 1e-5, 1e-6)])
    return np.where(np.isnan(off), np.inf, off).min(0)  # beside the rays of a miss there is no slope


def some_shapes():
    return {"sphere": mk.sphere(0.6), "capsule": mk.capsule(0.3, 0.5), "box": mk.box([0.7, 0.5, 0.3]),
            "cylinder": mk.cylinder(0.5, 0.6), "cone": mk.cone(0.6, 0.6), "ellipsoid": mk.ellipsoid([0.8, 0.5, 0.3]),
            "hull": mk.hull(0.8 * unit(np.random.default_rng(5).normal(size=(24, 3)))),
            "rounded": mk.rounded(mk.box([0.5, 0.4, 0.2]), 0.2), "sum": mk.sum(mk.box([0.3, 0.2, 0.4]), mk.disk(0.3))}
