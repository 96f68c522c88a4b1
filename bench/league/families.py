# SPDX-License-Identifier: MIT
"""Random rays of the families of tests/support/ray_families.h, with certified answers: the search of
tests/cases/derive_cases.py finds them, its checker proves them."""
import os
import random
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'tests', 'cases'))
import check_cases as checker  # noqa: E402
import derive_cases  # noqa: E402

SHAPES = {
    'sphere': {'type': 'sphere', 'radius': 1}, 'box': {'type': 'box', 'half_extents': [1, 0.5, 0.25]},
    'flat box': {'type': 'box', 'half_extents': [1, 1, 0.01]}, 'cylinder': {'type': 'cylinder', 'radius': 0.5, 'half_height': 0.75},
    'coin': {'type': 'cylinder', 'radius': 1, 'half_height': 0.02}, 'capsule': {'type': 'capsule', 'radius': 0.5, 'half_height': 0.75},
    'cone': {'type': 'cone', 'radius': 0.5, 'half_height': 0.75}, 'ellipsoid': {'type': 'ellipsoid', 'radii': [1, 0.5, 0.25]},
    'needle': {'type': 'ellipsoid', 'radii': [1, 0.02, 0.02]},
    'hull': {'type': 'hull', 'points': [[0.9, 0.1, 0], [-0.7, 0.5, 0.2], [-0.2, -0.9, 0.1], [0.1, 0.2, 0.95], [0.3, -0.3, -0.8],
                                        [-0.5, 0.4, -0.6], [0.5, 0.7, 0.3], [0.4, -0.6, 0.5]]},
}
FAMILIES = ('random', 'grazing', 'degenerate', 'far', 'camera')


def unit(v):
    length = sum(x * x for x in v) ** 0.5
    return [x / length for x in v]


def direction(rng):
    return unit([rng.gauss(0, 1) for _ in range(3)])


def cross(u, v):
    return [u[i - 2] * v[i - 1] - u[i - 1] * v[i - 2] for i in range(3)]


def mix(u, k, v):
    return [x + k * y for x, y in zip(u, v)]


def lattice(rng):
    while True:
        n = [float(rng.randrange(3) - 1) for _ in range(3)]
        if any(n):
            return n


class Shooter:
    """Rays at one shape. R is the radius of its bounding ball."""

    def __init__(self, shape, rng):
        self.body, self.rng = derive_cases.Body(shape), rng
        half = [max(abs(self.support([sign * float(i == k) for i in range(3)])[k]) for sign in (-1, 1)) for k in range(3)]
        self.half, self.r = half, sum(x * x for x in half) ** 0.5

    def support(self, n):
        return [float(x) for x in self.body.support([derive_cases.D(x) for x in n])[0]]

    def aimed(self, distance):
        rng = self.rng
        target = [0.6 * self.r * rng.random() ** (1 / 3) * x for x in direction(rng)]
        origin = [distance * self.r * x for x in direction(rng)]
        return origin, [(t - o) / distance for t, o in zip(target, origin)]

    def ray(self, family):
        rng, r = self.rng, self.r
        if family in ('random', 'far'):
            return self.aimed(5 if family == 'random' else 1e5)
        if family == 'camera':
            towards = unit([-2, 3, -1])
            right = unit(cross(towards, [0, 0, 1]))
            at = mix([rng.uniform(-1, 1) * x for x in right], rng.uniform(-1, 1), cross(towards, right))
            return [-4 * r * x for x in towards], unit(mix(at, 4, towards))
        if family == 'grazing':
            d = direction(rng)
            n = unit(cross(d, direction(rng)))
            past = mix(self.support(n), rng.choice((-1, 1)) * 10 ** rng.uniform(-6, -3) * r, n)
            return mix(past, -5 * r, d), [r * x for x in d]
        vertex, other = self.support(lattice(rng)), self.support(direction(rng))
        kind = rng.randrange(4)
        if kind < 2:  # at a vertex, or at the middle of an edge or a chord
            goal = vertex if kind == 0 else [(x + y) / 2 for x, y in zip(vertex, other)]
            origin = [5 * r * x for x in direction(rng)]
            return origin, [(g - o) / 5 for g, o in zip(goal, origin)]
        if kind == 2:  # tangential
            n = unit(lattice(rng))
            along = cross(n, lattice(rng))
            along = unit(along if any(along) else cross(n, direction(rng)))
            return mix(self.support(n), -5 * r, along), [r * x for x in along]
        d = [0.0, 0.0, 0.0]  # along an axis, at a corner, edge or face of the bounding box
        d[rng.randrange(3)] = float(rng.choice((-1, 1)))
        at = [x * h * rng.choice((1, 0.5)) for x, h in zip(lattice(rng), self.half)]
        return mix(at, -5 * r, d), [r * x for x in d]


def as_float(v):
    """Rounded as a float is, so that all precisions mean the same ray."""
    import struct
    return [struct.unpack('f', struct.pack('f', x))[0] for x in v]


def random_cases(count, seed):
    """Cases of all families; rays whose answer could not be proven are left out."""
    cases = []
    for name, shape in SHAPES.items():
        for family in FAMILIES:
            rng = random.Random(f'{seed} {name} {family}')
            shooter = Shooter(shape, rng)
            for i in range(count):
                origin, d = shooter.ray(family)
                case = {'name': f'{name}, {family} {i}', 'family': family, 'query': 'ray', 'shape': shape,
                        'ray': {'origin': as_float(origin), 'direction': as_float(d)}}
                try:
                    case = derive_cases.derive(case)
                except Exception:
                    continue
                if not checker.check(case):
                    cases.append(case)
    return cases
