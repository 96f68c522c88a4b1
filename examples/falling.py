# SPDX-License-Identifier: MIT
"""A thousand boxes and balls fall into a heap: near pairs, points of contact and warm starts in each step."""
import time

import numpy as np

import minkray as mk

STEP, GRAVITY, COUNT = 0.01, 9.81, 1000
MARGIN = 0.05  # what is nearer than this may touch in the next step

rng = np.random.default_rng(1)
shapes = [mk.box([0.4, 0.3, 0.2]), mk.sphere(0.3)]
kind = np.arange(COUNT) % 2
half = np.array([[0.4, 0.3, 0.2], [0.3 * np.sqrt(0.5)] * 3])[kind]  # a box of as much inertia
inverse_inertia = 3 / (np.sum(half**2, axis=1, keepdims=True) - half**2)  # of mass 1, along its own axes

scene = mk.Scene()
pose = np.tile(np.eye(4), (COUNT, 1, 1))
grid = np.stack(np.meshgrid(*[np.arange(10)] * 3), -1).reshape(-1, 3)
pose[:, :3, 3] = grid * [1.0, 1.0, 0.8] + [0, 0, 0.6] + rng.uniform(-0.05, 0.05, (COUNT, 3))
for body in range(COUNT):
    scene.add(shapes[kind[body]], pose[body])
ground = scene.add_half_space([0, 0, 1])
velocity, spin = np.zeros((2, COUNT, 3))
memory: dict[tuple[int, int], np.ndarray] = {}  # of each pair of bodies, from step to step


def turned(matrix, spin):
    """The rotations after a step."""
    angle = np.linalg.norm(spin, axis=1) * STEP
    x, y, z = (spin / np.maximum(np.linalg.norm(spin, axis=1, keepdims=True), 1e-12)).T
    zero = np.zeros_like(x)
    cross = np.moveaxis(np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]]), 2, 0)
    s, c = np.sin(angle)[:, None, None], np.cos(angle)[:, None, None]
    u, _, v = np.linalg.svd((np.eye(3) + s * cross + (1 - c) * cross @ cross) @ matrix)
    return u @ v


def contacts():
    """Bodies, points, normals and gaps of all points of contact; the ground is body -1."""
    near = scene.distances(within=MARGIN)
    at_ground = near.object_b == ground
    a, b = near.object_a[~at_ground], near.object_b[~at_ground]
    pairs = list(zip(a.tolist(), b.tolist()))
    kept = np.array([memory.get(pair, np.zeros(8)) for pair in pairs]).reshape(-1, 8)
    found = mk.manifolds([shapes[kind[i]] for i in a], pose[a], [shapes[kind[i]] for i in b], pose[b], memory=kept)
    memory.clear()
    memory.update(zip(pairs, kept))
    rows = [(i, j, found.points[k, p], found.normal[k], found.gaps[k, p])
            for k, (i, j) in enumerate(pairs) for p in range(found.count[k])]
    for i in near.object_a[at_ground]:
        m = scene.manifold(i, ground)
        rows += [(i, -1, m.points[p], m.normal, m.gaps[p]) for p in range(m.count)]
    if not rows:
        return (np.zeros(0, int), np.zeros(0, int), *np.zeros((2, 0, 3)), np.zeros(0))
    return tuple(np.array(column) for column in zip(*rows))


def resolve(a, b, point, normal, gap):
    """Impulses without friction, each point by itself and many times over; a is pushed back along the normal."""
    is_free = (b >= 0).astype(float)
    inverse = np.einsum("nij,nj,nkj->nik", pose[:, :3, :3], inverse_inertia, pose[:, :3, :3])
    arm_a, arm_b = point - pose[a, :3, 3], point - pose[b, :3, 3]
    turn_a, turn_b = (np.einsum("nij,nj->ni", inverse[body], np.cross(arm, normal))
                      for body, arm in ((a, arm_a), (b, arm_b)))
    mass = 1 + np.sum(np.cross(arm_a, normal) * turn_a, 1) + is_free * (
        1 + np.sum(np.cross(arm_b, normal) * turn_b, 1))
    touching = np.bincount(a, minlength=COUNT) + np.bincount(b[b >= 0], minlength=COUNT)
    share = 2 / np.maximum(touching[a], np.where(b >= 0, touching[b], 0))
    impulse = np.zeros(len(a))
    for _ in range(30):
        speed = np.sum(normal * (is_free[:, None] * (velocity[b] + np.cross(spin[b], arm_b))
                                 - velocity[a] - np.cross(spin[a], arm_a)), axis=1)
        wanted = np.where(gap > 0, -gap / STEP, np.minimum(-0.2 * gap / STEP, 1))
        more = np.maximum(impulse + np.minimum(share, 1) * (wanted - speed) / mass, 0) - impulse
        impulse += more
        np.add.at(velocity, a, -more[:, None] * normal)
        np.add.at(spin, a, -more[:, None] * turn_a)
        np.add.at(velocity, b, (is_free * more)[:, None] * normal)
        np.add.at(spin, b, (is_free * more)[:, None] * turn_b)


begin = time.perf_counter()
STEPS = 60
for step in range(STEPS):
    velocity[:, 2] -= GRAVITY * STEP
    touching = contacts()
    resolve(*touching)
    pose[:, :3, 3] += STEP * velocity
    pose[:, :3, :3] = turned(pose[:, :3, :3], spin)
    for body in range(COUNT):
        scene.set_pose(body, pose[body])
    scene.commit()
print(f"{(time.perf_counter() - begin) / STEPS * 1e3:.0f} ms a step, {len(touching[0])} points of contact")
end = scene.distances()
deepest = -min(end.value.min(initial=0), 0)
print(f"{len(end)} pairs touch, by {deepest:.3f} at most; the lowest body is at {pose[:, 2, 3].min():.2f}")
assert deepest < 0.1 and pose[:, 2, 3].min() > 0.1
