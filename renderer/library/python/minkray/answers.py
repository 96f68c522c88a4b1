# SPDX-License-Identifier: MIT
"""What scenes answer: arrays by name."""
import numpy as np

HIT, MISS, INSIDE, EXHAUSTED = range(4)
NO_OBJECT = 0xFFFFFFFF


class _Arrays:
    """Arrays by name."""

    def __init__(self, fields):
        self.__dict__.update(fields)

    def __len__(self):
        return len(next(iter(vars(self).values())))

    def __eq__(self, other):
        if type(other) is not type(self):
            return NotImplemented
        mine, theirs = vars(self), vars(other)
        return all(np.array_equal(mine[name], theirs[name], equal_nan=name == "point") for name in mine)

    __hash__ = None


class Hits(_Arrays):
    """What rays met, in arrays of the rays' own shape.

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
        Number of what is met; NO_OBJECT where nothing is.
    status : uint8
        HIT, MISS, INSIDE (the ray begins in the object), or EXHAUSTED: the solver gave up, which is
        neither a hit nor a miss.
    supports : int32
        How often the object's support mapping was asked.
    """

    def __repr__(self):
        counts = np.bincount(self.status.ravel(), minlength=4)
        return (f"<minkray.Hits of {self.t.shape}: {counts[HIT]} hit, {counts[MISS]} missed, "
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
        return f"<minkray.Proofs: {int(self.holds.sum())} of {self.holds.size} hold>"


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
    """

    def __repr__(self):
        least = int(np.argmin(self.lower))
        return (f"<minkray.Clearance of {len(self)} steps: at least {self.lower[least]:.6g}, at row "
                f"{self.row[least]:.6g}>")
