# SPDX-License-Identifier: MIT
"""Scenes, and the answers of rays cast at them."""
import numpy as np

from . import _minkray
from .rays import pinhole

HIT, MISS, INSIDE, EXHAUSTED = range(4)
NO_OBJECT = 0xFFFFFFFF


class _Arrays:
    """Arrays by name."""

    def __init__(self, fields):
        self.__dict__.update(fields)

    def __len__(self):
        return len(next(iter(vars(self).values())))


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
        Proven bounds of t; inf where nothing is met.
    plane : float64, three numbers each
        A normal: nothing of the object lies beyond the plane of this normal through t_lo.
    checked : uint32
        Objects for which something had to be proven.
    complaint : list of str
        What does not hold.
    """

    def __repr__(self):
        return f"<minkray.Proofs: {int(self.holds.sum())} of {self.holds.size} hold>"


class _Joints:
    """Values of joints by name: assigning moves the robot at the next question."""

    def __init__(self, group, changed):
        self._group, self._changed, self._values = group, changed, {}

    def __setitem__(self, name, value):
        self._group.set(name, np.atleast_1d(np.asarray(value, float)))
        self._values[name] = value
        self._changed()

    def __getitem__(self, name):
        return self._values[name]

    def keys(self):
        return self._group.joints

    def __repr__(self):
        return f"<joints {', '.join(self._group.joints)}>"


class Robot:
    """What came from one file.

    Attributes
    ----------
    objects : range
        Their numbers.
    joint_names : list of str
    joints : mapping
        ``robot.joints["elbow"] = 0.4``, or ``robot.joints = {...}``, or an array in the order of
        `joint_names`: radians or lengths.
    """

    def __init__(self, group, changed):
        self._group, self._changed = group, changed
        self._joints = _Joints(group, changed)
        self.objects = range(group.first, group.first + group.size)

    @property
    def joint_names(self):
        return self._group.joints

    @property
    def joints(self):
        return self._joints

    @joints.setter
    def joints(self, values):
        if not hasattr(values, "items"):
            values = dict(zip(self.joint_names, values, strict=True))
        for name, value in values.items():
            self._joints[name] = value

    def set_pose(self, pose):
        """Moves all of it: a (4, 4) matrix."""
        self._group.set_pose(pose)
        self._changed()

    def __repr__(self):
        return f"<minkray.Robot of {len(self.objects)} objects, {len(self.joint_names)} joints>"


class Scene:
    """Shapes with poses, that rays are cast at.

    What is added or moved is met from the next question on. Any number of threads may ask a scene
    that nobody changes.
    """

    def __init__(self):
        self._scene = _minkray.Scene()
        self._is_committed = False

    def _changed(self):
        self._is_committed = False

    def add(self, shape, pose=None, name=None):
        """Adds a shape.

        Parameters
        ----------
        shape : Shape
        pose : (4, 4) array, optional
            Any invertible map.
        name : str, optional

        Returns
        -------
        int
            Its number.
        """
        self._changed()
        return self._scene.add(shape, pose, name)

    def add_half_space(self, normal, offset=0.0, name=None):
        """Adds all points x with ``normal . x <= offset * |normal|``; answers its number."""
        self._changed()
        return self._scene.add_half_space(normal, offset, name)

    def add_file(self, file, pose=None, geometry="visual", keyframe="", package_dirs=(),
                 skip_missing_meshes=False):
        """Adds what is in a file: a scene of Minkray's (.json), or a robot (URDF, MJCF, SDF).

        Parameters
        ----------
        file : str
        pose : (4, 4) array, optional
            Of all that is in it.
        geometry : {'visual', 'collision', 'all'}
            Of robots.
        keyframe : str
            Of MJCF.
        package_dirs : list of str
            Where ``package://`` and ``model://`` are looked for.
        skip_missing_meshes : bool

        Returns
        -------
        Robot
        """
        self._changed()
        group = self._scene.add_file(str(file), pose, geometry, keyframe,
                                     [str(folder) for folder in package_dirs], skip_missing_meshes)
        return Robot(group, self._changed)

    def add_json(self, file, pose=None):
        """Adds a scene file; see `add_file`."""
        return self.add_file(file, pose)

    add_urdf = add_mjcf = add_sdf = add_file

    def set_pose(self, object, pose):
        """Moves an object: a (4, 4) matrix."""
        self._changed()
        self._scene.set_pose(object, pose)

    def pose(self, object):
        """Where an object stands: a (4, 4) matrix."""
        return self._scene.pose(object)

    @property
    def names(self):
        """list of str : the objects' names, by their numbers."""
        return [self._scene.name(i) for i in range(len(self._scene))]

    def __len__(self):
        return len(self._scene)

    def __repr__(self):
        names = self.names
        shown = ", ".join(names[:5]) + (", ..." if len(names) > 5 else "")
        return f"<minkray.Scene of {len(names)} objects: {shown}>"

    def commit(self):
        """Makes ready what was added or moved. Questions do it themselves where it is due."""
        self._scene.commit()
        self._is_committed = True

    def _ready(self):
        if not self._is_committed:
            self.commit()
        return self._scene

    @staticmethod
    def _rows(rays, t_max):
        rays = np.asarray(rays, float)
        if rays.ndim == 0 or rays.shape[-1] != 6:
            raise ValueError(f"rays: must have the shape (..., 6) (got {rays.shape})")
        if t_max is not None and np.ndim(t_max) > 0:
            t_max = np.broadcast_to(t_max, rays.shape[:-1]).ravel()
        rows = rays if rays.ndim == 2 else rays.reshape(-1, 6)
        return rows, t_max, rays.shape[:-1]

    @staticmethod
    def _shaped(fields, shape):
        return {name: values.reshape(shape + values.shape[1:]) if isinstance(values, np.ndarray)
                else values for name, values in fields.items()}

    def cast_rays(self, rays, t_max=None, threads=0):
        """What rays meet first.

        Parameters
        ----------
        rays : (N, 6) or (..., 6) array
            Origin and direction, of any length. Not copied if of float64.
        t_max : float or (...) array, optional
            In lengths of the direction; None for no end.
        threads : int
            0 for one a core. The answers are the same bits for any number.

        Returns
        -------
        Hits
        """
        rows, t_max, shape = self._rows(rays, t_max)
        return Hits(self._shaped(self._ready().cast(rows, t_max, threads), shape))

    def occluded(self, rays, t_max=None, threads=0):
        """Whether rays meet anything: a bool array. Raises RuntimeError if a solver gave up."""
        rows, t_max, shape = self._rows(rays, t_max)
        blocked = self._ready().occluded(rows, t_max, threads)
        if (blocked == EXHAUSTED).any():
            raise RuntimeError(f"the solver gave up at ray {int(np.argmax(blocked == EXHAUSTED))}")
        return (blocked == HIT).reshape(shape)

    def certify(self, rays, t_max=None, threads=0):
        """Proves what rays meet: by planes and support points alone, of all objects.

        Returns
        -------
        Proofs
        """
        rows, t_max, shape = self._rows(rays, t_max)
        return Proofs(self._shaped(self._ready().certify(rows, t_max, threads), shape))

    def depth(self, K, pose, width, height, threads=0):
        """A depth image of a pinhole camera; see `minkray.pinhole`.

        Returns
        -------
        depth : (height, width) array
            Along the camera's z axis; inf where nothing is met.
        object : (height, width) array
        """
        hits = self.cast_rays(pinhole(K, pose, width, height), threads=threads)
        return hits.t, hits.object
