# SPDX-License-Identifier: MIT
"""Distances, points of contact and times of impact of many pairs of shapes at once."""
import math
import re

import numpy as np

from . import _minkray
from .answers import _Arrays
from .calls import (Error, array_of, number_of, poses_array, public, shapes_array, vectors_of,
                    whole_number_of, without_options)
from .pairs import DistanceStatus, ImpactStatus


class Distances(_Arrays):
    """Signed distances of many pairs: arrays in the broadcast shape of the arguments, (N,).

    Attributes
    ----------
    value : (N,) float64
        The distance in the world's unit, or minus the penetration depth for an overlap.
    lower, upper : (N,) float64
        Proven bounds: ``lower <= value <= upper``.
    normal : (N, 3) float64
        Unit vector from a to b, in the world.
    point_a, point_b : (N, 3) float64
        Nearest points, in the world: ``point_b - point_a = value * normal``, up to a sideways error of
        ``sqrt(2 * value * (upper - lower))``; if they touch or overlap, of 3e-6 of the sizes.
    status : (N,) uint8
        A `DistanceStatus`.
    supports : (N,) int32
        Number of support points computed.
    jac_a, jac_b : (N, 6) float64
        With ``jac=True``: the derivative of `value` with respect to a twist (v, w) of each body: v is the
        velocity of its frame's origin along the world's axes, w the angular velocity about that point.
    is_ridge : (N,) bool
        With ``jac=True``: True where the derivative may not be unique, as for parallel faces; `jac_a`
        and `jac_b` are then one of several.
    jac_error_a, jac_error_b : (N, 2) float64
        With ``jac_error=True``: bounds of the length of the error of `jac_a` and `jac_b`, for v and
        for w; inf if unknown: on ridges, for meshes and some depths, and for w on surfaces of unknown
        curvature.
    """

    _statuses = DistanceStatus

    def __repr__(self):
        if not self._has("value"):
            return self._names()
        least = f", the least {np.min(self.value):.6g}" if np.size(self.value) else ""
        return f"<minkray.Distances of {np.shape(self.value)}{least}>"


class Impacts(_Arrays):
    """Times of impact of many moving pairs: arrays in the broadcast shape of the arguments.

    Attributes
    ----------
    t_lo, t_hi : (N,) float64
        The shapes are proven apart before t_lo and touch at t_hi. Without contact t_lo is t_max and
        t_hi is inf.
    normal, point_a, point_b : (N, 3) float64
        At t_lo, in the world.
    distance : (N,) float64
        At t_lo; inf if unknown.
    status : (N,) uint8
        An `ImpactStatus`.
    jac_a, jac_b : (N, 6) float64
        With ``jac=True``: the derivative of the time with respect to a twist (v, w) of each body's pose
        at time 0, as in `Distances`; NaN without contact, zero if they overlap at time 0.
    is_ridge : (N,) bool
        With ``jac=True``: True where the derivative may be ambiguous or undefined, as for a grazing
        contact.
    jac_error_a, jac_error_b : (N, 2) float64
        With ``jac_error=True``: bounds of the length of the error of `jac_a` and `jac_b`, as for `Distances`; inf
        also for two shapes without a radius: neither spheres, capsules nor rounded.
    """

    _statuses = ImpactStatus

    def __repr__(self):
        if not self._has("t_lo") or not self._has("t_hi"):
            return self._names()
        return f"<minkray.Impacts of {np.shape(self.t_lo)}: {int(np.isfinite(self.t_hi).sum())} touch>"


class Manifolds(_Arrays):
    """Contact points of many pairs: arrays in the broadcast shape of the arguments.

    Attributes
    ----------
    count : (N,) int32
        Number of points, up to four; 0 if the distance is unknown.
    normal : (N, 3) float64
        Unit vector from a to b, in the world.
    points : (N, 4, 3) float64
        Midpoints between points_a and points_b, in the world; NaN from index `count` on.
    points_a, points_b : (N, 4, 3) float64
        ``points_b - points_a = gaps * normal``. The first pair are the nearest points; the others are on
        the bodies if these are flat there. On curved bodies they are inside, by up to 0.02 times the
        extent of the points.
    gaps : (N, 4) float64
        Distance at each point; negative: penetration depth.
    value, lower, upper : (N,) float64
        The signed distance and its bounds.
    status : (N,) uint8
        A `DistanceStatus`.
    """

    _statuses = DistanceStatus

    def __repr__(self):
        if not self._has("count"):
            return self._names()
        return f"<minkray.Manifolds of {np.shape(self.count)}: {int(np.sum(self.count))} points>"


_DISTANCES = {"value": ((), np.float64), "lower": ((), np.float64), "upper": ((), np.float64),
              "normal": ((3,), np.float64), "point_a": ((3,), np.float64), "point_b": ((3,), np.float64),
              "status": ((), np.uint8), "supports": ((), np.int32)}
_JAC = {"jac_a": ((6,), np.float64), "jac_b": ((6,), np.float64), "is_ridge": ((), np.bool_)}
_JAC_ERROR = {"jac_error_a": ((2,), np.float64), "jac_error_b": ((2,), np.float64)}
_IMPACTS = {"t_lo": ((), np.float64), "t_hi": ((), np.float64), "normal": ((3,), np.float64),
            "point_a": ((3,), np.float64), "point_b": ((3,), np.float64), "distance": ((), np.float64),
            "status": ((), np.uint8)}
_MANIFOLDS = {"count": ((), np.int32), "normal": ((3,), np.float64), "points": ((4, 3), np.float64),
              "points_a": ((4, 3), np.float64), "points_b": ((4, 3), np.float64), "gaps": ((4,), np.float64),
              "value": ((), np.float64), "lower": ((), np.float64), "upper": ((), np.float64),
              "status": ((), np.uint8)}

class Together:
    """Arguments broadcast together by NumPy's rules."""

    def __init__(self, **arguments):
        """Takes an array and its number of axes per pair, for each argument."""
        self._given = arguments
        leads = [array.shape[:array.ndim - own] for array, own in arguments.values()]
        try:
            shape = np.broadcast_shapes(*leads)
        except ValueError:
            found = ", ".join(f"{name} {lead}" for name, lead in zip(arguments, leads))
            raise Error(f"{', '.join(arguments)}: must have the same length, or one entry (got {found})") from None
        self.shape = shape or (1,)
        self.count = math.prod(self.shape)

    def __getitem__(self, name):
        """Rows: one for all pairs, or one per pair. Copied only if necessary."""
        array, own = self._given[name]
        lead, tail = array.shape[:array.ndim - own], array.shape[array.ndim - own:]
        if math.prod(lead) == 1 and self.count != 0:
            return array.reshape((1,) + tail)
        return np.broadcast_to(array, self.shape + tail).reshape((self.count,) + tail)


def _rows_in_one_piece(array):
    """The array with contiguous, aligned rows; a copy if necessary."""
    if array.shape[0] == 0 or (array[0].flags.c_contiguous and array.flags.aligned
                               and array.strides[0] % array.itemsize == 0):
        return array
    return np.ascontiguousarray(array)


class Sides:
    """Both bodies of many pairs, as the extension module takes them."""

    def __init__(self, a, pose_a, b, pose_b, **more):
        self._kinds, given = {}, {}
        for side, shapes, poses in ("a", a, pose_a), ("b", b, pose_b):
            array, own, self._kinds[side] = poses_array(poses, f"pose_{side}")
            given[side] = shapes_array(shapes, side), 0
            given[f"pose_{side}"] = array, own
        self.together = Together(**given, **more)
        self._twisted = {name for name in more if name.startswith("twist")}

    def side(self, side):
        twist = f"twist_{side}"
        return _minkray.Side(
            self.together[side].tolist(), _rows_in_one_piece(self.together[f"pose_{side}"]),
            self._kinds[side],
            np.ascontiguousarray(self.together[twist]) if twist in self._twisted else None)


def room(kind, fields, shape, out):
    """Arrays for a result: new ones, or those of `out`."""
    if out is None:
        return {name: np.empty(shape + tail, dtype) for name, (tail, dtype) in fields.items()}
    if not isinstance(out, (kind, dict)):
        raise Error(f"out: must be a {kind.__name__} or a dict of arrays (got {type(out).__name__})")
    arrays = dict(out if isinstance(out, dict) else vars(out))
    missing = [name for name in fields if name not in arrays and name in (*_JAC, *_JAC_ERROR)]
    if missing and not isinstance(out, dict):
        raise Error(f"out: must have {', '.join(missing)}, as a result of the same call has (got {', '.join(arrays)})")
    for name, array in arrays.items():
        if name not in fields:
            raise Error(f"out[{name!r}]: must be one of {', '.join(fields)}")
        tail, dtype = fields[name]
        if not isinstance(array, np.ndarray) or array.dtype != dtype or array.shape != shape + tail:
            found = f"{array.dtype} {array.shape}" if isinstance(array, np.ndarray) else type(array).__name__
            raise Error(f"out[{name!r}]: must be an array of {np.dtype(dtype)} of the shape {shape + tail} "
                        f"(got {found})")
        if not (array.flags.c_contiguous and array.flags.writeable and array.flags.aligned):
            raise Error(f"out[{name!r}]: must be contiguous and writeable")
    return arrays


def _memory(memory, shape):
    if memory is None:
        return None
    if (not isinstance(memory, np.ndarray) or memory.dtype != np.float64 or memory.shape != shape + (8,)
            or not (memory.flags.c_contiguous and memory.flags.writeable and memory.flags.aligned)):
        raise Error(f"memory: must be made by pair_memory({shape[0] if len(shape) == 1 else shape}) (got "
                    f"{getattr(memory, 'shape', type(memory).__name__)})")
    return memory


def progress_of(progress):
    if progress is not None and not callable(progress):
        raise Error(f"progress: must be a function of one number (got {type(progress).__name__})")
    return progress


def threads_of(number):
    return whole_number_of(number, "threads", 1024)


def call_c(call, *arguments):
    """Calls a function of the C interface; errors name the arguments of Python."""
    try:
        call(*arguments)
    except Error as error:
        text = without_options(re.sub(r"^minkray_\w+: ", "", str(error)))
        text = re.sub(r"^([ab])\.(pose|twist)s", r"\2_\1", text)
        text = re.sub(r"^([ab])\.shapes", r"\1", text)
        text = re.sub(r"\.rows(?=\[)", "", text)
        text = re.sub(r"\.velocity\[(\d)\]", r"[\1]", text)
        text = re.sub(r"\.turn\[(\d)\]", lambda found: f"[{int(found[1]) + 3}]", text)
        raise Error(text) from None


@public
def pair_memory(shape):
    """Warm-start memory for ``memory=``, one row per pair, reused from call to call.

    A call starts from the result of the last call on the same pairs, which is faster if bodies move
    little. Bounds hold for any content; the last digits of results depend on it.

    Parameters
    ----------
    shape : int or tuple of int
        Number of pairs.

    Returns
    -------
    (N, 8) array of float64
        Empty memory; its numbers have no meaning.

    Examples
    --------
    >>> import minkray as mk
    >>> memory = mk.pair_memory(1)
    >>> for x in 3.0, 3.1, 3.2:
    ...     d = mk.signed_distances(mk.box([1, 1, 1]), None, mk.cone(1, 1), [[x, 0, 0, 1, 0, 0, 0]], memory=memory)
    """
    shape = tuple(shape) if isinstance(shape, (tuple, list)) else (shape,)
    return np.zeros(tuple(whole_number_of(one, "shape", 2**48) for one in shape) + (8,))


@public
def signed_distances(a, pose_a, b, pose_b, *, jac=False, jac_error=False, tolerance=1e-10, memory=None,
                     threads=0, out=None, progress=None):
    """Signed distances of many pairs of shapes.

    Parameters
    ----------
    a, b : Shape, or list of N of them
    pose_a, pose_b : (N, 4, 4), (N, 3, 4) or (N, 7) array, or one of them, or None
        Rigid maps from the shape's frame to the world. Seven numbers are (x, y, z, qw, qx, qy, qz).
        All arguments follow NumPy's broadcasting, for example one shape with N poses.
    jac : bool
        Add derivatives.
    jac_error : bool
        Add bounds of the derivatives' errors.
    tolerance : float
        Largest gap between the bounds, relative to the shapes' sizes.
    memory : (N, 8) array, optional
        Made by `pair_memory`; read and written.
    threads : int
        0: one per core. Results are bit-identical for any number.
    out : Distances, or dict of arrays, optional
        Arrays to fill, such as an earlier result. A dict may contain only some of the arrays.
    progress : callable, optional
        Called from time to time with the fraction done; return True to stop.

    Returns
    -------
    Distances

    Raises
    ------
    Error
        If lengths do not match, or a pose is not finite or not rigid; names the pose.

    Examples
    --------
    >>> import minkray as mk
    >>> d = mk.signed_distances(mk.sphere(1), None, mk.sphere(1), [[3, 0, 0, 1, 0, 0, 0], [0, 5, 0, 1, 0, 0, 0]], jac=True)
    >>> d.value, d.jac_b[1, :3]
    (array([1., 3.]), array([0., 1., 0.]))
    """
    sides = Sides(a, pose_a, b, pose_b)
    shape = sides.together.shape
    arrays = room(Distances, {**_DISTANCES, **(_JAC if jac else {}), **(_JAC_ERROR if jac_error else {})}, shape, out)
    call_c(_minkray.signed_distances, sides.side("a"), sides.side("b"), sides.together.count,
         number_of(tolerance, "tolerance"), _memory(memory, shape), arrays, threads_of(threads),
         progress_of(progress))
    return out if isinstance(out, Distances) else Distances(arrays)


def twists_array(value, argument):
    return np.zeros(6) if value is None else vectors_of(value, argument, 6)


@public
def times_of_impact(a, pose_a, twist_a, b, pose_b, twist_b, t_max=1.0, *, jac=False, jac_error=False,
                    memory=None, threads=0, out=None, progress=None):
    """First contacts of many pairs of moving and turning shapes, at times from 0 to `t_max`.

    Parameters
    ----------
    a, b : Shape, or list of N of them
    pose_a, pose_b : (N, 4, 4), (N, 3, 4) or (N, 7) array, or one of them, or None
        At time 0; as for `signed_distances`.
    twist_a, twist_b : (N, 6) or (6,) array, or None
        Velocity, and rotation vector per unit of time, in the world, about the origin of the shape's
        frame (the last column of the pose). None: at rest.
    t_max : float or (N,) array
        Finite, at least 0.
    jac, jac_error, memory, threads, out, progress
        As for `signed_distances`; `out` is Impacts.

    Returns
    -------
    Impacts

    Raises
    ------
    Error
        As for `signed_distances`.
    """
    sides = Sides(a, pose_a, b, pose_b, twist_a=(twists_array(twist_a, "twist_a"), 1),
                  twist_b=(twists_array(twist_b, "twist_b"), 1),
                  t_max=(array_of(t_max, "t_max", "a number, or one for each pair"), 0))
    shape = sides.together.shape
    arrays = room(Impacts, {**_IMPACTS, **(_JAC if jac else {}), **(_JAC_ERROR if jac_error else {})}, shape, out)
    call_c(_minkray.times_of_impact, sides.side("a"), sides.side("b"), sides.together.count,
         sides.together["t_max"], _memory(memory, shape), arrays, threads_of(threads), progress_of(progress))
    return out if isinstance(out, Impacts) else Impacts(arrays)


@public
def manifolds(a, pose_a, b, pose_b, *, tolerance=1e-10, memory=None, threads=0, out=None, progress=None):
    """Up to four contact points per pair, such as the corners of a box on a plate.

    Parameters
    ----------
    a, b, pose_a, pose_b, tolerance, memory, threads, out, progress
        As for `signed_distances`; `out` is Manifolds.

    Returns
    -------
    Manifolds
        For separated pairs: the nearest points.

    Raises
    ------
    Error
        As for `signed_distances`.

    Examples
    --------
    >>> import minkray as mk
    >>> m = mk.manifolds(mk.box([5, 5, 1]), None, mk.box([1, 1, 1]), [[0, 0, 2, 1, 0, 0, 0]])
    >>> m.count, m.points[0, :, 2]
    (array([4], dtype=int32), array([1., 1., 1., 1.]))
    """
    sides = Sides(a, pose_a, b, pose_b)
    shape = sides.together.shape
    arrays = room(Manifolds, _MANIFOLDS, shape, out)
    call_c(_minkray.manifolds, sides.side("a"), sides.side("b"), sides.together.count,
         number_of(tolerance, "tolerance"), _memory(memory, shape), arrays, threads_of(threads),
         progress_of(progress))
    return out if isinstance(out, Manifolds) else Manifolds(arrays)
