# SPDX-License-Identifier: MIT
"""A shape of your own in NumPy, cast at and proven."""
import numpy as np

import minkray as mk


def lens(n):
    """The sum of a disk of radius 1 and a ball of radius 0.2, along unit directions (M, 3)."""
    flat = n * [1, 1, 0]
    length = np.linalg.norm(flat, axis=1, keepdims=True)
    return np.divide(flat, length, out=np.zeros_like(n), where=length > 0) + 0.2 * n


scene = mk.Scene()
scene.add(mk.custom(lens, bounds=[[-1.2, -1.2, -0.2], [1.2, 1.2, 0.2]]), name="lens")
rng = np.random.default_rng(1)
rays = np.concatenate([np.tile([0, 0, 5.0], (500, 1)), rng.normal(0, [0.3, 0.3, 0.1], (500, 3)) - [0, 0, 1]], axis=1)
print(scene.cast_rays(rays))
proofs = scene.certify(rays)
print(proofs)
assert proofs.holds.all()
try:
    mk.custom(lambda n: -n)
except mk.Error as error:
    print("refused:", str(error)[:70])
