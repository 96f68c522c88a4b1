# SPDX-License-Identifier: MIT
"""What scenes answer: arrays by name."""
import enum

import numpy as np

NO_OBJECT = 0xFFFFFFFF


class Status(enum.IntEnum):
    """What became of a ray: HIT, MISS, INSIDE (it begins in the object), or EXHAUSTED: the solver gave
    up, which is neither a hit nor a miss."""

    HIT = 0
    MISS = 1
    INSIDE = 2
    EXHAUSTED = 3


HIT, MISS, INSIDE, EXHAUSTED = Status


class _Arrays:
    """Arrays by name."""

    def __init__(self, fields):
        self.__dict__.update(fields)

    def _first(self):
        return next(iter(vars(self).values()))

    def __len__(self):
        return len(self._first())

    def __getitem__(self, key):
        """The same of some rays: an index, a slice, a mask, or an array of indices."""
        shape = self._first().shape
        return type(self)({name: values[key] if isinstance(values, np.ndarray)
                           else _of_list(values, shape, key) for name, values in vars(self).items()})

    def __iter__(self):
        return (self[i] for i in range(len(self)))

    def __eq__(self, other):
        if type(other) is not type(self):
            return NotImplemented
        mine, theirs = vars(self), vars(other)
        return all(np.array_equal(mine[name], theirs[name], equal_nan=name == "point") for name in mine)

    __hash__ = None


def _of_list(values, shape, key):
    """Of a flat list which belongs to arrays of that shape."""
    array = np.empty(len(values), object)
    array[:] = values
    found = array.reshape(shape)[key]
    return found.ravel().tolist() if isinstance(found, np.ndarray) else found


class Hits(_Arrays):
    """What rays met, in arrays of the rays' own shape.

    ``hits[mask]``, ``hits[i]``, ``hits[2:5]`` and iteration give the same of some of them;
    ``np.savez(file, **vars(hits))`` keeps all arrays.

    Attributes
    ----------
    t : float64
        Where, in lengths of the direction; inf where nothing is met.
    distance : float64
        The same, in the world's unit; inf where nothing is met.
    t_lo, t_hi : float64
        The true t is between them.
    point, normal : float64, three numbers each
        In the world; the point is NaN where nothing is met.
    object : uint32
        Number of what is met; NO_OBJECT where nothing is. ``scene.names[hits.object]`` are names.
    status : uint8
        A `Status`: HIT, MISS, INSIDE (the ray begins in the object), or EXHAUSTED: the solver gave up, which is
        neither a hit nor a miss.
    supports : int32
        How often the object's support mapping was asked.
    part : int32
        Of a mesh the triangle that is met; -1 of all else.
    jac_ray : float64, six numbers each
        With ``jac=True``: the derivative of `t` by the ray's origin and by its direction; NaN where
        nothing is met, zero where the ray begins inside.
    jac_body : float64, six numbers each
        Likewise, by a twist (v, w) of the object: by the velocity of its frame's origin along the
        world's axes, and by its angular velocity about that point.
    is_ridge : bool
        True where there may be other derivatives, or none: of a ray through an edge, that grazes a
        shape, or that meets two objects at once.
    jac_error_ray, jac_error_body : float64, two numbers each
        With ``jac_error=True``: bounds of the length of the error of `jac_ray`, by origin and by direction, and of
        `jac_body`, by velocity and by angular velocity; NaN where nothing is met, inf on ridges and
        of shapes known by their support mapping only.
    """

    def __repr__(self):
        counts = np.bincount(np.ravel(self.status), minlength=4)
        return (f"<minkray.Hits of {np.shape(self.t)}: {counts[HIT]} hit, {counts[MISS]} missed, "
                f"{counts[INSIDE]} inside, {counts[EXHAUSTED]} exhausted>")


class Proofs(_Arrays):
    """Whether answers are proven, in arrays of the rays' own shape.

    Attributes
    ----------
    holds : bool
    t_lo, t_hi : float64
                Proven bounds of t, rounding allowed for; inf where nothing is met.
    allowed : float64
        How far across a plane what is proven may be rounded, as a length.
    plane : float64, three numbers each
        A normal: nothing of the object lies beyond the plane of this normal through t_lo.
    checked : uint32
        Objects for which something had to be proven.
    complaint : list of str
        What does not hold.
    """

    def __repr__(self):
        return f"<minkray.Proofs: {int(np.sum(self.holds))} of {np.size(self.holds)} hold>"


class Clearance(_Arrays):
    """How near a robot comes to anything, in each step of its path: arrays of (K,).

    Attributes
    ----------
    lower, upper : float64
        Proven: the least signed distance of the step is between them. Less than zero where things
        overlap; inf where there is nothing to meet.
    row : float64
        Where it is `upper`: 2.25 is a quarter of the way from row 2 to row 3.
    object_a, object_b : uint32
        Numbers of the nearest; NO_OBJECT where there are none.
    point_a, point_b, normal : float64, three numbers each
        The nearest points there, in the world, and the direction from a to b.
    jac, is_ridge : (K, J) float64, (K,) bool
        With ``jac=True``: the derivative of the distance by the joints' values at `row`, and whether
        there may be others, as where another pair is as near then. By the two rows of the path it is
        ``(1 - s) * jac`` and ``s * jac``, if `row` is ``s`` behind the first of them.
    """

    def __repr__(self):
        if np.size(self.lower) == 0:
            return "<minkray.Clearance of 0 steps>"
        least = int(np.argmin(self.lower))
        return (f"<minkray.Clearance of {np.size(self.lower)} steps: at least "
                f"{np.ravel(self.lower)[least]:.6g}, at row {np.ravel(self.row)[least]:.6g}>")


class MotionStatus(enum.IntEnum):
    """What a motion is: proven FREE of collisions at all times, a pair COLLIDES, or UNDECIDED."""

    FREE = 0
    COLLIDES = 1
    UNDECIDED = 2


class Verdict:
    """What is proven of a robot's motion, between its rows too.

    Attributes
    ----------
    status : MotionStatus
        FREE, COLLIDES or UNDECIDED.
    lower, upper : float
        Bounds of the least clearance, which is the distance less the margin. If it is not free,
        lower is -inf, and upper less than 0 where a pair collides.
    row : float
        Where it is upper: 2.25 is a quarter of the way from row 2 to row 3.
    begin, end : float
        The first stretch, in rows, that collides, or may; outside of it that pair is proven apart,
        but for its other stretches. Of a free motion both are row.
    object_a, object_b : int
        Numbers of the pair; NO_OBJECT where there is none.
    point : (3,) float64
        In the middle between the two, or within both.
    """

    def __init__(self, fields):
        self.__dict__.update(fields)
        self.status = MotionStatus(self.status)

    def __bool__(self):
        """True if the motion is free."""
        return self.status == MotionStatus.FREE

    def __repr__(self):
        return f"<minkray.Verdict: {self.status.name}, at least {self.lower:.6g}, at row {self.row:.6g}>"
