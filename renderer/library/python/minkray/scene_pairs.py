# SPDX-License-Identifier: MIT
"""Pairs of objects of a scene: distances, nearest objects, impacts, contact points."""
import re

import numpy as np

from . import _minkray
from .answers import _Arrays
from .calls import (Error, array_of, name_of, number_of, poses_array, public, shapes_array, vectors_of,
                    whole_number_of)
from .many_pairs import (Manifolds, Together, _rows_in_one_piece, progress_of, threads_of, call_c,
                         twists_array)
from .pairs import DistanceStatus, ImpactStatus
from .robots import robot_of

_DISTANCE = [("value", "f8"), ("lower", "f8"), ("upper", "f8"), ("point_a", "f8", 3), ("point_b", "f8", 3),
             ("normal", "f8", 3), ("status", "i4"), ("supports", "i4")]
_PAIR = np.dtype(_DISTANCE + [("jac_a", "f8", 6), ("jac_b", "f8", 6), ("object_a", "u4"), ("object_b", "u4"),
                              ("is_ridge", "i4"), ("_", "i4")])
_IMPACT = np.dtype([("t_lo", "f8"), ("t_hi", "f8"), ("distance", "f8"), ("point_a", "f8", 3),
                    ("point_b", "f8", 3), ("normal", "f8", 3), ("status", "i4"), ("steps", "i4"),
                    ("jac", "f8", 6), ("object", "u4"), ("is_ridge", "i4")])
_MANIFOLD = np.dtype([("normal", "f8", 3), ("points_a", "f8", (4, 3)), ("points_b", "f8", (4, 3)),
                      ("gaps", "f8", 4), ("value", "f8"), ("lower", "f8"), ("upper", "f8"), ("count", "i4"),
                      ("status", "i4")])
_ALL = 2**32 - 1


class ScenePairs(_Arrays):
    """Pairs of objects and their signed distances: arrays with one row per pair.

    Attributes
    ----------
    object_a, object_b : (M,) uint32
        Numbers of the objects, the smaller one first; given pairs keep their order.
    value, lower, upper : (M,) float64
        The signed distance and its proven bounds.
    normal, point_a, point_b : (M, 3) float64
        As in `Distances`.
    status : (M,) uint8
        A `DistanceStatus`.
    jac_a, jac_b, is_ridge
        With ``jac=True``, as in `Distances`: about the origins of the objects' frames.
    jac_error_a, jac_error_b : (M, 2) float64
        With ``jac_error=True``, as in `Distances`; inf for meshes, except above half-spaces.
    """

    _statuses = DistanceStatus

    def __repr__(self):
        return f"<minkray.ScenePairs: {np.size(self.value)}>"


class Nearest(_Arrays):
    """The objects nearest to points or shapes.

    Attributes
    ----------
    object : (N, k) or (N,) uint32
        Numbers of the objects, the nearest first; NO_OBJECT if there are fewer than k.
    value, lower, upper : float64
        The signed distance to that object and its proven bounds; inf without an object.
    normal, point_a, point_b : float64, three numbers each
        The direction from the point or shape to the object, and the nearest points on both.
    status : uint8
        A `DistanceStatus`.
    jac, is_ridge : six numbers, and bool
        With ``jac=True``: the derivative of `value` with respect to a twist of the shape (for a
        point, its velocity), and True where it may be ambiguous: also if another object may be as
        near. NaN without an object.
    jac_error : two numbers
        With ``jac_error=True``: bounds of the length of the error of `jac`, as in `Distances`; NaN
        without an object.
    """

    _statuses = DistanceStatus

    def __repr__(self):
        return f"<minkray.Nearest of {np.shape(self.object)}>"


class SceneImpacts(_Arrays):
    """First contacts of shapes that move through a scene: arrays of shape (N,).

    Attributes
    ----------
    object : (N,) uint32
        Number of the object; NO_OBJECT without contact.
    t_lo, t_hi : (N,) float64
        No contact before t_lo (proven); contact with the object at t_hi.
    normal, point_a, point_b, distance, status
        As in `Impacts`; a is the shape.
    jac, is_ridge : (N, 6) float64, (N,) bool
        With ``jac=True``: the derivative of the time with respect to a twist of the shape at time 0,
        and True where it may be ambiguous: also if another object may be touched at the same time.
    jac_error : (N, 2) float64
        With ``jac_error=True``: bounds of the length of the error of `jac`, as in `Impacts`.
    """

    _statuses = ImpactStatus

    def __repr__(self):
        return f"<minkray.SceneImpacts of {np.shape(self.t_lo)}: {int(np.isfinite(self.t_hi).sum())} touch>"


class Manifold(_Arrays):
    """Contact points of two objects: one entry of `Manifolds`."""

    __doc__ += (" ``manifold[k]`` is that of point k alone; ``len(manifold)`` is `count`."
                + Manifolds.__doc__[Manifolds.__doc__.index("\n\n"):].replace("(N,)", "").replace("(N, ", "("))

    _statuses = DistanceStatus

    def __len__(self):
        return int(self.count)

    def __getitem__(self, key):
        """Selects points by an index, a slice, a mask, or an array of indices."""
        fields = dict(vars(self))
        for name in "points", "points_a", "points_b", "gaps":
            fields[name] = fields[name][:len(self)][key]
        fields["count"] = np.int32(np.size(fields["gaps"]))
        return Manifold(fields)

    def __repr__(self):
        return f"<minkray.Manifold of {int(self.count)} points>"


def _columns(rows, names, jac):
    """Arrays by name; derivatives only if `jac`."""
    fields = {}
    for name, of in names.items():
        if name in ("jac", "jac_a", "jac_b", "is_ridge") and not jac:
            continue
        values = np.ascontiguousarray(rows[of])
        fields[name] = (values.astype(np.uint8) if name == "status" else
                        values != 0 if name == "is_ridge" else values)
    return fields


_OF_PAIR = {name: name for name in ("object_a", "object_b", "value", "lower", "upper", "normal", "point_a",
                                    "point_b", "status", "jac_a", "jac_b", "is_ridge")}
_OF_NEAREST = {"object": "object_b", "value": "value", "lower": "lower", "upper": "upper", "normal": "normal",
               "point_a": "point_a", "point_b": "point_b", "status": "status", "jac": "jac_a",
               "is_ridge": "is_ridge"}
_OF_IMPACT = {name: name for name in ("object", "t_lo", "t_hi", "normal", "point_a", "point_b", "distance",
                                      "status", "jac", "is_ridge")}


def _nearest_of(rows, jac, errors):
    """`errors`: None, or four bounds per row; those of the shape are kept."""
    fields = _columns(rows, _OF_NEAREST, jac)
    if errors is not None:
        fields["jac_error"] = errors[..., :2].copy()
    return Nearest(fields)


def _length(value, argument):
    number = number_of(value, argument)
    if not number >= 0:
        raise Error(f"{argument}: must be at least 0, or inf (got {number})")
    return number


def _mask(value):
    number = whole_number_of(value, "mask")
    if number == 0:
        raise Error("mask: must have a bit (got 0)")
    return number


def _numbers(value, argument):
    """Object numbers, two per row."""
    array = np.asarray(value)
    if array.size == 0:
        return np.zeros((0, 2), np.uint32)
    if array.ndim != 2 or array.shape[1] != 2 or array.dtype.kind not in "iu":
        raise Error(f"{argument}: must be whole numbers of the shape (M, 2) (got {array.dtype} {array.shape})")
    if array.min() < 0 or array.max() > _ALL:
        raise Error(f"{argument}: must be numbers of objects (got {array.min()} to {array.max()})")
    return np.ascontiguousarray(array, np.uint32)


class _Moved:
    """Shapes with poses outside of the scene."""

    def __init__(self, shape, poses, **more):
        array, own, self._kind = poses_array(poses, "poses")
        self.together = Together(shape=(shapes_array(shape, "shape"), 0), poses=(array, own), **more)
        self._is_twisted = "twists" in more

    def side(self):
        return _minkray.Side(self.together["shape"].tolist(), _rows_in_one_piece(self.together["poses"]),
                             self._kind,
                             np.ascontiguousarray(self.together["twists"]) if self._is_twisted else None)


def _call_c(call, *arguments):
    """Calls a function of the C interface; errors name the arguments of Python."""
    answer = []
    try:
        call_c(lambda: answer.append(call(*arguments)))
    except Error as error:
        text = re.sub(r"^shapes\.(pose|twist)s", r"\1s", str(error))
        text = re.sub(r"^shapes\.shapes", "shape", text)
        text = re.sub(r"^object_a", "i", re.sub(r"^object_b", "j", text))
        raise Error(text) from None
    return answer[0]


def _public(function):
    return public(function, f"Scene.{function.__name__}")


class PairsOfScene:
    """Queries of a `Scene` on pairs of objects."""

    @_public
    def set_masks(self, object, category=1, mask=_ALL):
        """Sets the objects that an object forms pairs with.

        Parameters
        ----------
        object : int
            Its number.
        category, mask : int
            Bits: two objects are a pair if each one's mask has a bit of the other's category. By
            default the category is 1 and the mask has all 32 bits.
        """
        _call_c(_minkray.scene_set_masks, self._scene, whole_number_of(object, "object"),
              whole_number_of(category, "category"), whole_number_of(mask, "mask"))

    @_public
    def allow(self, i, j, allowed=True):
        """Allows two objects to touch: `distances` skips such pairs.

        Parameters
        ----------
        i, j : int
            Their numbers.
        allowed : bool
            False: query the pair again.
        """
        _call_c(_minkray.scene_allow, self._scene, whole_number_of(i, "i"), whole_number_of(j, "j"),
              bool(allowed))

    @_public
    def allow_from_srdf(self, robot, file):
        """Allows the pairs of a robot's links that an SRDF file (MoveIt) allows to touch.

        Parameters
        ----------
        robot : Robot
            Of this scene.
        file : str or path
            Uses ``disable_collisions``, ``disable_default_collisions`` and ``enable_collisions``.

        Raises
        ------
        Error
            If the file names an unknown link; then no pair is allowed.
        """
        _call_c(_minkray.scene_allow_from_srdf, self._scene, robot_of(robot, self._scene)._group, name_of(file))

    @_public
    def distances(self, pairs=None, within=None, *, tolerance=1e-10, jac=False, jac_error=False, threads=0,
                  progress=None):
        """All pairs of objects within a distance of each other.

        Skips pairs excluded by `allow` or `set_masks`, pairs of half-spaces, and links of a robot that
        do not move relative to each other or that a joint connects.

        Parameters
        ----------
        pairs : (M, 2) array of int, optional
            Numbers of objects. Only these pairs are queried, in this order, including excluded ones.
        within : float, optional
            In the world's unit: pairs that are proven to be further apart are skipped. Default 0 (pairs
            that touch or overlap); inf for given pairs.
        tolerance : float
            Largest gap between the bounds, relative to the objects' sizes.
        jac : bool
            Add derivatives.
        jac_error : bool
            Add bounds of the derivatives' errors.
        threads : int
            0: one per core. Results are bit-identical for any number.
        progress : callable, optional
            Called from time to time with the fraction done; return True to stop.

        Returns
        -------
        ScenePairs

        Examples
        --------
        >>> import minkray as mk
        >>> scene = mk.Scene()
        >>> for x in 0, 3, 9:
        ...     number = scene.add(mk.sphere(1), [[1, 0, 0, x], [0, 1, 0, 0], [0, 0, 1, 0]])
        >>> near = scene.distances(within=2)
        >>> near.object_a, near.object_b, near.value
        (array([0], dtype=uint32), array([1], dtype=uint32), array([1.]))
        """
        within = (0.0 if pairs is None else np.inf) if within is None else _length(within, "within")
        pairs = None if pairs is None else _numbers(pairs, "pairs")
        rows, errors = _call_c(_minkray.scene_distances, self._ready(), pairs, within,
                               number_of(tolerance, "tolerance"), bool(jac), bool(jac_error),
                               threads_of(threads), progress_of(progress))
        fields = _columns(rows.view(_PAIR), _OF_PAIR, jac)
        if jac_error:
            errors = errors.reshape(-1, 2, 2)
            fields["jac_error_a"], fields["jac_error_b"] = errors[:, 0].copy(), errors[:, 1].copy()
        return ScenePairs(fields)

    @_public
    def nearest(self, points, k=1, *, within=np.inf, mask=_ALL, jac=False, jac_error=False, threads=0,
                progress=None):
        """The k objects nearest to points.

        Parameters
        ----------
        points : (..., 3) array
            In the world.
        k : int
            At least 1.
        within : float
            Objects that are proven to be further away are skipped.
        mask : int
            Categories to query; see `set_masks`.
        jac, jac_error, threads, progress
            As for `distances`.

        Returns
        -------
        Nearest
            Of shape (N, k) for N points.
        """
        points = np.atleast_2d(vectors_of(points, "points", 3))
        shape, points = points.shape[:-1], np.ascontiguousarray(points.reshape(-1, 3))
        k = whole_number_of(k, "k")
        if k == 0:
            raise Error("k: must be at least 1 (got 0)")
        errors = np.empty(shape + (k, 4)) if jac_error else None
        rows = _call_c(_minkray.scene_nearest, self._ready(), points, k, _length(within, "within"), bool(jac),
                     errors, _mask(mask), threads_of(threads), progress_of(progress))
        return _nearest_of(rows.view(_PAIR).reshape(shape + (k,)), jac, errors)

    @_public
    def distance_to(self, shape, poses, within=np.inf, *, mask=_ALL, jac=False, jac_error=False, threads=0,
                    progress=None):
        """The object nearest to a shape outside of the scene, at many poses.

        Parameters
        ----------
        shape : Shape, or list of N of them
        poses : (N, 4, 4), (N, 3, 4) or (N, 7) array, or one of them
            Rigid; as for `minkray.signed_distances`.
        within, mask, jac, jac_error, threads, progress
            As for `nearest`.

        Returns
        -------
        Nearest
            Of shape (N,). Without an object within that distance, `object` is NO_OBJECT and `lower` is
            `within`.
        """
        moved = _Moved(shape, poses)
        errors = np.empty(moved.together.shape + (4,)) if jac_error else None
        rows = _call_c(_minkray.scene_distance_to, self._ready(), moved.side(), moved.together.count,
                     _length(within, "within"), bool(jac), errors, _mask(mask), threads_of(threads),
                     progress_of(progress))
        return _nearest_of(rows.view(_PAIR).reshape(moved.together.shape), jac, errors)

    @_public
    def time_of_impact(self, shape, poses, twists, t_max=1.0, *, mask=_ALL, jac=False, jac_error=False,
                       threads=0, progress=None):
        """First contact of a shape that moves and turns through the scene.

        Parameters
        ----------
        shape : Shape, or list of N of them
            Outside of the scene, whose objects are at rest.
        poses : (N, 4, 4), (N, 3, 4) or (N, 7) array, or one of them
            At time 0; rigid.
        twists : (N, 6) or (6,) array
            As for `minkray.times_of_impact`: about the origin of the shape's frame.
        t_max : float or (N,) array
            Finite, at least 0.
        mask, jac, threads, progress
            As for `nearest`.
        jac_error : bool
            Add bounds of the derivatives' errors.

        Returns
        -------
        SceneImpacts
        """
        moved = _Moved(shape, poses, twists=(twists_array(twists, "twists"), 1),
                       t_max=(array_of(t_max, "t_max", "a number, or one per pose"), 0))
        errors = np.empty((moved.together.count, 2)) if jac_error else None
        rows = _call_c(_minkray.scene_time_of_impact, self._ready(), moved.side(), moved.together.count,
                     moved.together["t_max"], bool(jac), errors, _mask(mask), threads_of(threads),
                     progress_of(progress))
        fields = _columns(rows.view(_IMPACT).reshape(moved.together.shape), _OF_IMPACT, jac)
        if jac_error:
            fields["jac_error"] = errors.reshape(moved.together.shape + (2,))
        return SceneImpacts(fields)

    @_public
    def manifold(self, i, j):
        """Up to four contact points of two objects, also of allowed pairs.

        Parameters
        ----------
        i, j : int
            Their numbers.

        Returns
        -------
        Manifold
        """
        row = _call_c(_minkray.scene_manifold, self._ready(), whole_number_of(i, "i"),
                    whole_number_of(j, "j")).view(_MANIFOLD)[0]
        fields = {name: row[name] for name in ("count", "normal", "points_a", "points_b", "gaps", "value",
                                               "lower", "upper", "status")}
        fields["points"] = row["points_a"] + (row["points_b"] - row["points_a"]) / 2
        return Manifold(fields)
