# SPDX-License-Identifier: MIT
"""Scenes, and what is asked of them."""
import json

import numpy as np

from . import _minkray
from .answers import EXHAUSTED, HIT, Clearance, Hits, Proofs
from .files import name_of
from .rays import pinhole


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
        """list of str : those of the joints that move, in the file's order."""
        return self._group.joints

    @property
    def joints(self):
        """mapping : values by name, in radians or lengths; assigning moves the robot."""
        return self._joints

    @joints.setter
    def joints(self, values):
        if not hasattr(values, "items"):
            values = dict(zip(self.joint_names, values, strict=True))
        for name, value in values.items():
            self._joints[name] = value

    def set_pose(self, pose):
        """Moves all of it.

        Parameters
        ----------
        pose : (4, 4) array
            From the file's frame to the world.
        """
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
        """Adds all points x with ``normal . x <= offset * |normal|``.

        Parameters
        ----------
        normal : (3,) array
            Of any length but zero.
        offset : float
            In the world's unit of length.
        name : str, optional

        Returns
        -------
        int
            Its number.
        """
        self._changed()
        return self._scene.add_half_space(normal, offset, name)

    def add_file(self, file, pose=None, geometry="visual", keyframe="", package_dirs=(),
                 skip_missing_meshes=False):
        """Adds what is in a file: a scene of Minkray's (.json), or a robot (URDF, MJCF, SDF, glTF).

        Parameters
        ----------
        file : str or path
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
        group = self._scene.add_file(name_of(file), pose, geometry, keyframe,
                                     [name_of(folder) for folder in package_dirs], skip_missing_meshes)
        return Robot(group, self._changed)

    def add_json(self, file, pose=None):
        """Adds a scene file of Minkray's; see `add_file`.

        Parameters
        ----------
        file : str or path
        pose : (4, 4) array, optional
            Of all that is in it.

        Returns
        -------
        Robot
            Of no joints.
        """
        return self.add_file(file, pose)

    def add_urdf(self, file, pose=None, geometry="visual", package_dirs=(), skip_missing_meshes=False):
        """Adds a robot from a URDF file; see `add_file`.

        Parameters
        ----------
        file : str or path
        pose : (4, 4) array, optional
            Of all that is in it.
        geometry : {'visual', 'collision', 'all'}
        package_dirs : list of str
            Where ``package://`` and ``model://`` are looked for.
        skip_missing_meshes : bool

        Returns
        -------
        Robot
        """
        return self.add_file(file, pose, geometry, "", package_dirs, skip_missing_meshes)

    def add_mjcf(self, file, pose=None, geometry="visual", keyframe="", skip_missing_meshes=False):
        """Adds what is in an MJCF file, MuJoCo's format; see `add_file`.

        Parameters
        ----------
        file : str or path
        pose : (4, 4) array, optional
            Of all that is in it.
        geometry : {'visual', 'collision', 'all'}
        keyframe : str
            In whose pose it stands.
        skip_missing_meshes : bool

        Returns
        -------
        Robot
        """
        return self.add_file(file, pose, geometry, keyframe, (), skip_missing_meshes)

    def add_sdf(self, file, pose=None, geometry="visual", package_dirs=(), skip_missing_meshes=False):
        """Adds what is in an SDF file, Gazebo's format; see `add_file`.

        Parameters
        ----------
        file : str or path
        pose : (4, 4) array, optional
            Of all that is in it.
        geometry : {'visual', 'collision', 'all'}
        package_dirs : list of str
            Where ``package://`` and ``model://`` are looked for.
        skip_missing_meshes : bool

        Returns
        -------
        Robot
        """
        return self.add_file(file, pose, geometry, "", package_dirs, skip_missing_meshes)

    def add_gltf(self, file, pose=None):
        """Adds what is in a glTF file; see `add_file`.

        Parameters
        ----------
        file : str or path
        pose : (4, 4) array, optional
            Of all that is in it.

        Returns
        -------
        Robot
        """
        return self.add_file(file, pose)

    def set_pose(self, object, pose):
        """Moves an object.

        Parameters
        ----------
        object : int
            Its number.
        pose : (4, 4) array
            From the shape's frame to the world; any invertible map.
        """
        self._changed()
        self._scene.set_pose(object, pose)

    def pose(self, object):
        """Where an object stands.

        Parameters
        ----------
        object : int
            Its number.

        Returns
        -------
        (4, 4) array of float64
            From the shape's frame to the world.
        """
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
            Its arrays have the shape of the rays, without the last axis.

        Raises
        ------
        ValueError
            If the rays have another shape, or numbers that are not finite: it says which.

        Examples
        --------
        >>> import minkray as mk
        >>> scene = mk.Scene()
        >>> ball = scene.add(mk.sphere(1))
        >>> scene.cast_rays([[-4, 0, 0, 2, 0, 0], [-4, 3, 0, 2, 0, 0]]).t
        array([1.5, inf])
        """
        rows, ends, shape = self._rows(rays, t_max)
        return Hits(self._shaped(self._ready().cast(rows, ends, threads), shape))

    def occluded(self, rays, t_max=None, threads=0):
        """Whether rays meet anything.

        Parameters
        ----------
        rays, t_max, threads
            As of `cast_rays`.

        Returns
        -------
        (...) array of bool

        Raises
        ------
        RuntimeError
            If a solver gave up, so that nobody knows.
        """
        rows, t_max, shape = self._rows(rays, t_max)
        blocked = self._ready().occluded(rows, t_max, threads)
        if (blocked == EXHAUSTED).any():
            raise RuntimeError(f"the solver gave up at ray {int(np.argmax(blocked == EXHAUSTED))}")
        return (blocked == HIT).reshape(shape)

    def certify(self, rays, hits=None, t_max=None, threads=0):
        """Casts rays, and proves what they meet by planes and support points alone, of all objects.

        Parameters
        ----------
        rays : (N, 6) or (..., 6) array
            As of `cast_rays`.
        hits : Hits, optional
            Answers of `cast_rays`, of the same rays and t_max. Those that are not what the rays
            meet by now do not hold.
        t_max : float or (...) array, optional
            As of `cast_rays`.
        threads : int

        Returns
        -------
        Proofs
        """
        rows, ends, shape = self._rows(rays, t_max)
        proofs = Proofs(self._shaped(self._ready().certify(rows, ends, threads), shape))
        if hits is not None:
            met = self.cast_rays(rays, t_max, threads)
            differs = (met.t != hits.t) | (met.object != hits.object) | (met.status != hits.status)
            proofs.holds &= ~differs
            for i in np.flatnonzero(differs):
                proofs.complaint[i] = "the answer is not what the ray meets"
        return proofs

    def depth(self, K, pose, width, height, threads=0):
        """A depth image of a pinhole camera.

        Parameters
        ----------
        K, pose, width, height
            As of `minkray.pinhole`.
        threads : int

        Returns
        -------
        depth : (height, width) array of float64
            Along the camera's z axis; inf where nothing is met, NaN where the solver gave up.
        object : (height, width) array of uint32
            NO_OBJECT where nothing is met.
        """
        hits = self.cast_rays(pinhole(K, pose, width, height), threads=threads)
        return np.where(hits.status == EXHAUSTED, np.nan, hits.t), hits.object

    def render(self, camera=None, spp=16, bounces=None, aovs=(), *, lights=None, background=None,
               width=0, height=0, integrator="auto", max_depth=None, denoise=False, seed=0, threads=0):
        """A picture.

        Parameters
        ----------
        camera : dict, optional
            As scene files have it: ``{"position": [0, -5, 2], "look_at": [0, 0, 0]}``. None for
            that of the scene's first file that has one; without any, everything is framed.
        spp : int
            Samples of a pixel.
        bounces : int, optional
            How often light is scattered, with the integrator 'ambient'; 1 for None.
        aovs : list of str
            More that is told of each pixel: 'Z', 'N', 'P', 'dist', 'id.object', 'albedo' and all
            others that ``minkray render --help`` names, but for 'cryptomatte'.
        lights : list of dict, optional
            As scene files have them; None for those of the scene's files, or a sun and a sky.
        background : list or dict, optional
            Likewise.
        width, height : int
            In pixels; 0 for the camera's.
        integrator : {'auto', 'path', 'direct', 'ambient', 'normals'}
        max_depth : int, optional
            How often light is scattered, with the integrator 'path'; 16 for None.
        denoise : bool
        seed : int
        threads : int
            0 for one a core. The picture is the same bits for any number.

        Returns
        -------
        dict of str to array
            'rgb', the linear light, (height, width, 3) of float32, and each of the aovs: (height,
            width) or (height, width, 2 or 3), of float32 or uint32. Rows from the top.

        Examples
        --------
        >>> import minkray as mk
        >>> scene = mk.Scene()
        >>> ball = scene.add(mk.sphere(1))
        >>> view = {"position": [0, -5, 2], "look_at": [0, 0, 0]}
        >>> picture = scene.render(view, spp=1, aovs=["N"], width=32, height=24)
        >>> picture["rgb"].shape, picture["N"].dtype
        ((24, 32, 3), dtype('float32'))
        """
        view = {name: value for name, value in
                (("camera", camera), ("lights", lights), ("background", background))
                if value is not None}

        def plain(value):
            if hasattr(value, "tolist"):
                return value.tolist()
            raise TypeError(f"camera, lights, background: cannot hold a {type(value).__name__}")

        def often(number):
            return 0 if number is None else number if number > 0 else -1

        scene = self._ready()
        return _minkray.render(scene, json.dumps(view, default=plain) if view else "", width, height,
                               spp, seed, integrator, often(bounces), often(max_depth), denoise,
                               ["rgb", *aovs], threads)

    def clearance(self, robot, path, tolerance=0.01, only_obstacles=False, threads=0):
        """How near a robot comes to itself and to all else on its way, proven.

        Parameters
        ----------
        robot : Robot
            Of this scene. It need not stand on the path.
        path : (K, J) array
            Rows of joints' values in the order of `Robot.joint_names`, in radians or lengths, four
            for a ball joint; from row to row each joint goes at a constant rate.
        tolerance : float
            How near the bounds shall be to each other, relative to the clearance.
        only_obstacles : bool
            Whether the robot's links are not looked at with each other.
        threads : int
            0 for one a core.

        Returns
        -------
        Clearance
            Of each of the K - 1 steps from row to row; of one step that stands still if K is 1.
        """
        return Clearance(_minkray.clearance(self._ready(), robot._group,
                                            np.atleast_2d(np.asarray(path, float)), tolerance,
                                            only_obstacles, threads))
