# SPDX-License-Identifier: MIT
"""Distances and times of impact of pairs of shapes."""
from . import _minkray

SEPARATED, TOUCHING, OVERLAPPING, UNDECIDED = range(4)
IMPACT, NO_IMPACT, BEGINS_INSIDE = range(3)


class _Answer:
    """Fields by name."""

    def __init__(self, fields):
        self.__dict__.update(fields)

    def __repr__(self):
        fields = ", ".join(f"{name}={value!r}" for name, value in vars(self).items())
        return f"{type(self).__name__}({fields})"


class Distance(_Answer):
    """How far apart two shapes are.

    Attributes
    ----------
    value : float or (N,) array
        Less than zero where they overlap: how deep.
    lower, upper : float or (N,) array
        Proven: ``lower <= value <= upper``.
    point_a, point_b : (3,) or (N, 3) array
        The nearest points: ``point_b - point_a = value * normal``.
    normal : (3,) or (N, 3) array
        From a to b, of length 1.
    status : int or (N,) array
        SEPARATED, TOUCHING, OVERLAPPING or UNDECIDED.
    """


class Impact(_Answer):
    """When two moving shapes first touch.

    Attributes
    ----------
    t_lo, t_hi : float
        They are apart before t_lo, which is proven, and touch at t_hi; inf if they do not.
    point_a, point_b, normal : (3,) array
        At t_lo.
    distance : float
        At t_lo.
    status : int
        IMPACT, NO_IMPACT (proven), BEGINS_INSIDE or UNDECIDED.
    """


def signed_distance(a, pose_a, b, pose_b, tolerance=1e-10):
    """How far apart two shapes are, or how deep in each other.

    Parameters
    ----------
    a, b : Shape
    pose_a, pose_b : (4, 4) or (N, 4, 4) array, or None
        Where they stand; None for the identity.
    tolerance : float
        How near the bounds shall be to each other, in sizes of the shapes.

    Returns
    -------
    Distance
        Of arrays, if any of the poses are.
    """
    fields = _minkray.signed_distance(a, pose_a, b, pose_b, tolerance)
    if all(getattr(pose, "ndim", 2) != 3 for pose in (pose_a, pose_b)):
        fields = {name: values[0] for name, values in fields.items()}
    return Distance(fields)


def time_of_impact(a, pose_a, twist_a, b, pose_b, twist_b, t_max=1.0):
    """The first contact of two shapes that move and turn, at times from 0 to `t_max`.

    Parameters
    ----------
    pose_a, pose_b : (4, 4) array or None
        At time 0.
    twist_a, twist_b : (6,) array or None
        A velocity, and a rotation vector a unit of time, about the origin of the shape's frame.

    Returns
    -------
    Impact
    """
    return Impact(_minkray.time_of_impact(a, pose_a, twist_a, b, pose_b, twist_b, t_max))
