# SPDX-License-Identifier: MIT
"""Distances and times of impact of pairs of shapes."""
import enum
import math

import numpy as np

from . import _minkray
from .answers import _Arrays
from .calls import Error, array_of, number_of, poses_of, public, shapes_array, vectors_of


class DistanceStatus(enum.IntEnum):
    """Status of a distance: SEPARATED, TOUCHING (0 is between the bounds), OVERLAPPING, or UNDECIDED
    (the bounds hold, but their gap is larger than requested)."""

    SEPARATED = 0
    TOUCHING = 1
    OVERLAPPING = 2
    UNDECIDED = 3


class ImpactStatus(enum.IntEnum):
    """Status of a motion of two shapes: IMPACT, NO_IMPACT (proven), BEGINS_INSIDE, or UNDECIDED (no
    contact before t_lo; later contact is unknown)."""

    IMPACT = 0
    NO_IMPACT = 1
    BEGINS_INSIDE = 2
    UNDECIDED = 3


SEPARATED, TOUCHING, OVERLAPPING, UNDECIDED = DistanceStatus
IMPACT, NO_IMPACT, BEGINS_INSIDE, IMPACT_UNDECIDED = ImpactStatus


class _Answer(_Arrays):
    """Fields by name."""

    def __repr__(self):
        fields = ", ".join(f"{name}={value!r}" for name, value in vars(self).items())
        return f"{type(self).__name__}({fields})"


class Distance(_Answer):
    """Signed distance of two shapes.

    Attributes
    ----------
    value : float or (...) array
        The distance, or minus the penetration depth for an overlap.
    lower, upper : float or (...) array
        Proven bounds: ``lower <= value <= upper``.
    point_a, point_b : (..., 3) array
        Nearest points: ``point_b - point_a = value * normal``, up to a sideways error of
        ``sqrt(2 * value * (upper - lower))``; if they touch or overlap, of 3e-6 of the sizes.
    normal : (..., 3) array
        Unit vector from a to b.
    status : DistanceStatus or (...) array
        SEPARATED, TOUCHING, OVERLAPPING or UNDECIDED.
    """

    _statuses = DistanceStatus


class Impact(_Answer):
    """Time of impact of two moving shapes.

    Attributes
    ----------
    t_lo, t_hi : float or (...) array
        The shapes are proven apart before t_lo and touch at t_hi. Without contact t_lo is t_max and
        t_hi is inf.
    point_a, point_b, normal : (..., 3) array
        Nearest points and direction at t_lo.
    distance : float or (...) array
        At t_lo; inf if unknown.
    status : ImpactStatus or (...) array
        IMPACT, NO_IMPACT (proven), BEGINS_INSIDE or UNDECIDED.
    """

    _statuses = ImpactStatus


class _Pairs:
    """Arguments broadcast together by NumPy's rules."""

    def __init__(self, **arguments):
        """Takes an array and its number of axes per pair, for each argument."""
        self._given = arguments
        shapes = [array.shape[:array.ndim - own] for array, own in arguments.values()]
        lists = {shape for shape in shapes if shape} or {()}
        try:
            self.shape = lists.pop() if len(lists) == 1 else np.broadcast_shapes(*lists)
        except ValueError:
            raise Error(f"{', '.join(arguments)}: must have shapes that broadcast together (got "
                        f"{', '.join(map(str, shapes))})") from None
        self.count = math.prod(self.shape)

    def __getitem__(self, name):
        """Numbers or a list of shapes: one for all pairs, or one per pair."""
        array, own = self._given[name]
        tail = array.shape[array.ndim - own:]
        if array.size != math.prod(tail):
            array = np.broadcast_to(array, self.shape + tail)
        return array.ravel().tolist() if array.dtype == object else np.ascontiguousarray(array)

    def answer(self, kind, fields):
        """The fields in the arguments' shape; numbers for one pair."""
        if self.shape == ():
            return kind({name: values[0] if values.ndim > 1 else float(values[0])
                         for name, values in fields.items()})
        return kind({name: values.reshape(self.shape + values.shape[1:]) for name, values in fields.items()})


@public
def signed_distance(a, pose_a, b, pose_b, tolerance=1e-10):
    """Signed distance of two shapes: the distance, or minus the penetration depth for an overlap.

    Parameters
    ----------
    a, b : Shape, or list of them
    pose_a, pose_b : (4, 4) or (..., 4, 4) array, or None
        From the shape's frame to the world; None for the identity. Lists of shapes and poses follow
        NumPy's broadcasting: one shape at N poses, N shapes at one pose, N at N.
    tolerance : float
        Largest gap between the bounds, relative to the shapes' sizes.

    Returns
    -------
    Distance
        With arrays, if shapes or poses are lists.

    Examples
    --------
    >>> import minkray as mk, numpy as np
    >>> poses = np.tile(np.eye(4), (3, 1, 1))
    >>> poses[:, 0, 3] = 3, 4, 5
    >>> mk.signed_distance(mk.sphere(1), None, mk.sphere(1), list(poses)).value
    array([1., 2., 3.])
    """
    pairs = _Pairs(a=(shapes_array(a, "a"), 0), pose_a=(poses_of(pose_a, "pose_a"), 2),
                   b=(shapes_array(b, "b"), 0), pose_b=(poses_of(pose_b, "pose_b"), 2))
    return pairs.answer(Distance, _minkray.signed_distance(
        pairs["a"], pairs["pose_a"], pairs["b"], pairs["pose_b"], number_of(tolerance, "tolerance"),
        pairs.count))


def _twists(value, argument):
    return np.zeros(6) if value is None else vectors_of(value, argument, 6)


@public
def time_of_impact(a, pose_a, twist_a, b, pose_b, twist_b, t_max=1.0):
    """First contact of two moving and turning shapes, at times from 0 to `t_max`.

    Parameters
    ----------
    a, b : Shape, or list of them
    pose_a, pose_b : (4, 4) or (..., 4, 4) array, or None
        At time 0. All arguments broadcast together, as for `signed_distance`.
    twist_a, twist_b : (6,) or (..., 6) array, or None
        Velocity, and rotation vector per unit of time, in the world, about the origin of the shape's
        frame (the last column of the pose). None: at rest.
    t_max : float or (...) array
        Finite, at least 0.

    Returns
    -------
    Impact
        With arrays, if any argument is a list.
    """
    pairs = _Pairs(a=(shapes_array(a, "a"), 0), pose_a=(poses_of(pose_a, "pose_a"), 2),
                   twist_a=(_twists(twist_a, "twist_a"), 1), b=(shapes_array(b, "b"), 0),
                   pose_b=(poses_of(pose_b, "pose_b"), 2), twist_b=(_twists(twist_b, "twist_b"), 1),
                   t_max=(array_of(t_max, "t_max", "a number"), 0))
    return pairs.answer(Impact, _minkray.time_of_impact(
        pairs["a"], pairs["pose_a"], pairs["twist_a"], pairs["b"], pairs["pose_b"], pairs["twist_b"],
        pairs["t_max"], pairs.count))
