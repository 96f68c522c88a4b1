# SPDX-License-Identifier: MIT
"""Common code of the scripts in this folder: rotations, poses, and writing a scene file."""
import json
import math
import pathlib

SCENES = pathlib.Path(__file__).resolve().parent.parent


def turn(axis, degrees):
    """The unit quaternion [x, y, z, w] of a turn around an axis."""
    length = math.sqrt(sum(a * a for a in axis))
    half = math.radians(degrees) / 2
    return [a / length * math.sin(half) for a in axis] + [math.cos(half)]


def after(p, q):
    """The quaternion of q's turn first, then p's."""
    px, py, pz, pw = p
    qx, qy, qz, qw = q
    return [pw * qx + px * qw + py * qz - pz * qy,
            pw * qy - px * qz + py * qw + pz * qx,
            pw * qz + px * qy - py * qx + pz * qw,
            pw * qw - px * qx - py * qy - pz * qz]


def turned(q, v):
    """The vector v turned by the quaternion q."""
    x, y, z, _ = after(after(q, [*v, 0]), [-q[0], -q[1], -q[2], q[3]])
    return [x, y, z]


class Pose:
    """A turn, then a move."""

    def __init__(self, translate=(0, 0, 0), rotate=(0, 0, 0, 1)):
        self.translate, self.rotate = list(translate), list(rotate)

    def __mul__(self, inner):
        moved = turned(self.rotate, inner.translate)
        return Pose([a + b for a, b in zip(self.translate, moved)], after(self.rotate, inner.rotate))

    def json(self):
        return {"translate": rounded(self.translate), "rotate": rounded(self.rotate)}


def rounded(numbers, digits=6):
    return [round(n, digits) + 0 for n in numbers]


def write(name, scene):
    """One line for each object, light and material."""
    lines = []
    for key, value in scene.items():
        if isinstance(value, list) and value and isinstance(value[0], dict):
            items = ",\n    ".join(json.dumps(item) for item in value)
            lines.append(f'  "{key}": [\n    {items}\n  ]')
        else:
            lines.append(f'  "{key}": {json.dumps(value)}')
    (SCENES / name).write_text("{\n" + ",\n".join(lines) + "\n}\n")
