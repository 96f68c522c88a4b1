# SPDX-License-Identifier: MIT
"""Results of scenes: arrays by name."""
import enum

import numpy as np

NO_OBJECT = 0xFFFFFFFF


class Status(enum.IntEnum):
    """Status of a ray: HIT, MISS, INSIDE (the ray begins in the object) or EXHAUSTED (the solver did not
    converge: neither a hit nor a miss)."""

    HIT = 0
    MISS = 1
    INSIDE = 2
    EXHAUSTED = 3


HIT, MISS, INSIDE, EXHAUSTED = Status


class _Arrays:
    """Arrays by name. The status of a single result is a member of `_statuses`."""

    _statuses = None

    def __init__(self, fields):
        self.__dict__.update(fields)
        status = fields.get("status")  # may be left out of arrays to be filled
        if self._statuses is not None and status is not None and np.ndim(status) == 0:
            self.status = self._statuses(int(status))

    def _first(self):
        return next(iter(vars(self).values()))

    def _has(self, name):
        """False if the arrays are only some, those of a given dict."""
        return name in vars(self)

    def _names(self):
        return f"<minkray.{type(self).__name__} with {', '.join(vars(self)) or 'no arrays'}>"

    def __len__(self):
        return len(self._first())

    def __getitem__(self, key):
        """Selects rays by an index, a slice, a mask, or an array of indices."""
        shape = self._first().shape
        return type(self)({name: _of_list(values, shape, key) if isinstance(values, list)
                           else np.asarray(values)[key] for name, values in vars(self).items()})

    def __iter__(self):
        return (self[i] for i in range(len(self)))

    def __eq__(self, other):
        if type(other) is not type(self):
            return NotImplemented
        mine, theirs = vars(self), vars(other)
        return all(np.array_equal(mine[name], theirs[name], equal_nan=name == "point") for name in mine)

    __hash__ = None


def _of_list(values, shape, key):
    """Selects from a flat list that belongs to arrays of that shape."""
    array = np.empty(len(values), object)
    array[:] = values
    found = array.reshape(shape)[key]
    return found.ravel().tolist() if isinstance(found, np.ndarray) else found


class Hits(_Arrays):
    """First hits of rays, in arrays of the rays' shape.

    ``hits[mask]``, ``hits[i]``, ``hits[2:5]`` and iteration select rays;
    ``np.savez(file, **vars(hits))`` saves all arrays.

    Attributes
    ----------
    t : float64
        Ray parameter: the hit point is ``origin + t * direction``. inf for a miss.
    distance : float64
        Distance from the origin, in the world's unit; inf for a miss.
    t_lo, t_hi : float64
        Proven bounds of t.
    point, normal : float64, three numbers each
        In the world. For a miss the point is NaN and the normal zero.
    object : uint32
        Number of the object; NO_OBJECT for a miss. ``scene.names[hits.object]`` are names.
    status : uint8
        A `Status`: HIT, MISS, INSIDE (the ray begins in the object) or EXHAUSTED (the solver did not
        converge: neither a hit nor a miss).
    supports : int32
        Number of calls of the object's support mapping.
    part : int32
        The triangle or part, if the object is a mesh or compound; else -1.
    jac_ray : float64, six numbers each
        With ``jac=True``: the derivative of `t` with respect to the ray's origin and its direction;
        NaN for a miss, zero if the ray begins inside.
    jac_body : float64, six numbers each
        The derivative of `t` with respect to a twist (v, w) of the object: v is the velocity of its
        frame's origin along the world's axes, w the angular velocity about that point.
    is_ridge : bool
        True where the derivative may be ambiguous or undefined: the ray passes through an edge,
        grazes a shape, or hits two objects at once.
    jac_error_ray, jac_error_body : float64, two numbers each
        With ``jac_error=True``: bounds of the length of the error of `jac_ray`, for origin and for direction,
        and of `jac_body`, for velocity and for angular velocity; NaN for a miss, inf on ridges and for shapes
        known by their support mapping only.
    """

    _statuses = Status

    def __repr__(self):
        counts = np.bincount(np.ravel(self.status), minlength=4)
        return (f"<minkray.Hits of {np.shape(self.t)}: {counts[HIT]} hit, {counts[MISS]} missed, "
                f"{counts[INSIDE]} inside, {counts[EXHAUSTED]} exhausted>")


class AllHits:
    """All hits of rays. The arrays are flat: the hits of ray i are ``offsets[i]`` to
    ``offsets[i + 1] - 1``, sorted by t.

    Attributes
    ----------
    t : float64
        Ray parameter, in units of the direction's length.
    t_lo, t_hi : float64
        Proven bounds of t.
    point, normal : float64, three numbers each
        In the world. Normals are outward; of a mesh, on the side on which the triangle's vertices are
        counter-clockwise.
    object : uint32
        Number of the object.
    part : int32
        The triangle or part, if the object is a mesh or compound; else -1.
    leaves : bool
        False where the ray enters the object, True where it leaves.
    ray : int64
        Number of the ray.
    offsets : int64, one more than rays
    status : uint8, in the shape of the rays
        A `Status`: HIT, MISS, or EXHAUSTED (the solver did not converge for some object, whose hits may
        be missing).
    """

    def __init__(self, fields):
        self.__dict__.update(fields)
        if np.ndim(self.status) == 0:
            self.status = Status(int(self.status))

    def __repr__(self):
        return f"<minkray.AllHits: {len(self.t)} hits of {len(self.offsets) - 1} rays>"


class Proofs(_Arrays):
    """Proofs of casts, in arrays of the rays' shape.

    Attributes
    ----------
    holds : bool
        True if the result is proven.
    t_lo, t_hi : float64
        Proven bounds of t, including rounding; inf for a miss.
    allowed : float64
        Allowed rounding, a distance perpendicular to a plane.
    plane : float64, three numbers each
        Normal of a plane through t_lo that the object does not cross.
    checked : uint32
        Number of objects with a proof.
    complaint : list of str
        The part of the proof that fails; empty if the proof holds.
    """

    def __repr__(self):
        return f"<minkray.Proofs: {int(np.sum(self.holds))} of {np.size(self.holds)} hold>"


class Clearance(_Arrays):
    """Least clearance of a robot in each step of its path: arrays of shape (K,).

    Attributes
    ----------
    lower, upper : float64
        Proven bounds of the step's least signed distance. Negative for an overlap; inf without any
        other object.
    row : float64
        Position of `upper` on the path: 2.25 is a quarter of the way from row 2 to row 3.
    object_a, object_b : uint32
        Numbers of the nearest pair; NO_OBJECT if there is none.
    point_a, point_b, normal : float64, three numbers each
        Nearest points at `row`, in the world, and the direction from a to b.
    jac, is_ridge : (K, J) float64, (K,) bool
        With ``jac=True``: the derivative of the distance with respect to the joint values at `row`, and
        True where it may be ambiguous, for example if two pairs are equally near. If ``s`` is the
        fractional part of `row`, the derivatives with respect to the rows before and after `row` are
        ``(1 - s) * jac`` and ``s * jac``.
    jac_error : (K, J) float64
        With ``jac_error=True``: bounds of the error of each number of `jac`, for the rounded joint
        values at `row`; inf on ridges and for meshes.
    """

    def __repr__(self):
        if np.size(self.lower) == 0:
            return "<minkray.Clearance of 0 steps>"
        least = int(np.argmin(self.lower))
        return (f"<minkray.Clearance of {np.size(self.lower)} steps: at least "
                f"{np.ravel(self.lower)[least]:.6g}, at row {np.ravel(self.row)[least]:.6g}>")


class MotionStatus(enum.IntEnum):
    """Status of a motion: FREE (proven at all times), COLLIDES, or UNDECIDED."""

    FREE = 0
    COLLIDES = 1
    UNDECIDED = 2


class Verdict:
    """Proven verdict on a robot's motion, including between its rows.

    Attributes
    ----------
    status : MotionStatus
        FREE, COLLIDES or UNDECIDED.
    lower, upper : float
        Bounds of the least clearance (distance minus margin). If the motion is not free, lower is
        -inf; upper is negative for a collision.
    row : float
        Position of upper on the path: 2.25 is a quarter of the way from row 2 to row 3.
    begin, end : float
        First interval of the path, in rows, in which the pair collides or may collide. For a free
        motion both equal `row`.
    object_a, object_b : int
        Numbers of the pair; NO_OBJECT if there is none.
    point : (3,) float64
        Midpoint between the two objects, or a point inside both.
    """

    def __init__(self, fields):
        self.__dict__.update(fields)
        self.status = MotionStatus(self.status)

    def __bool__(self):
        """True if the motion is free."""
        return self.status == MotionStatus.FREE

    def __repr__(self):
        return f"<minkray.Verdict: {self.status.name}, at least {self.lower:.6g}, at row {self.row:.6g}>"
