# SPDX-License-Identifier: MIT
"""Scenes and their queries."""
import json
import threading

import numpy as np

from . import _minkray
from .answers import EXHAUSTED, HIT, NO_OBJECT, Clearance, Hits, Proofs, Verdict
from .calls import (Error, array_of, given_pose_of, name_of, number_of, pose_of, public, shape_of,
                    text_of, vectors_of, whole_number_of)
from .rays import pinhole
from .robots import Robot, robot_of
from .scene_pairs import PairsOfScene


def _threads(number):
    return whole_number_of(number, "threads", 1024)


class _Names(list):
    """Names by number: None for a miss and for removed objects; a list for an array of numbers."""

    def __getitem__(self, number):
        if isinstance(number, np.ndarray) and number.ndim > 0:
            return [self[one] for one in number]
        if not isinstance(number, slice) and number == NO_OBJECT:
            return None
        return super().__getitem__(number)


class Scene(PairsOfScene):
    """Objects with poses, for ray casts, distances and pictures.

    Changes take effect at the next query. Any number of threads may query a scene. Changing it
    during a query (in another thread or in a callback) raises an Error and changes nothing.
    """

    def __init__(self):
        self._scene = _minkray.Scene()
        self._changes = 1  # a count detects a change while another thread commits
        self._committed = 0
        self._commits = threading.Lock()
        self._removed = set()

    def __reduce__(self):
        raise Error("Scene: cannot be pickled")

    def _changed(self):
        self._changes += 1

    @public
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
        name = name if name is None else text_of(name, "name")
        number = self._scene.add(shape_of(shape, "shape"), pose_of(pose), name)
        self._changed()
        return number

    @public
    def add_half_space(self, normal, offset=0.0, name=None):
        """Adds all points x with ``normal . x <= offset * |normal|``.

        Parameters
        ----------
        normal : (3,) array
            Of any length except zero.
        offset : float
            In the world's unit of length.
        name : str, optional

        Returns
        -------
        int
            Its number.
        """
        name = name if name is None else text_of(name, "name")
        number = self._scene.add_half_space(vectors_of(normal, "normal", 3, 1), number_of(offset, "offset"),
                                            name)
        self._changed()
        return number

    @public
    def add_file(self, file, pose=None, geometry="visual", keyframe="", package_dirs=(),
                 skip_missing_meshes=False, meshes=""):
        """Adds a file: a scene of Minkray (.json), or a robot (URDF, MJCF, SDF, glTF).

        Parameters
        ----------
        file : str or path
        pose : (4, 4) array, optional
            Of the file's contents.
        geometry : {'visual', 'collision', 'all'}
            Shapes of robots to use.
        keyframe : str
            Keyframe of an MJCF file.
        package_dirs : list of str
            Folders to search for ``package://`` and ``model://``.
        skip_missing_meshes : bool
        meshes : {'', 'exact', 'hull'}
            Robots' mesh files: their triangles, or their convex hulls. The default is exact, except
            for contact of MJCF, which uses the hull as MuJoCo does.

        Returns
        -------
        Robot
        """
        if isinstance(package_dirs, (str, bytes)):
            raise Error("package_dirs: must be a list of folders (got one)")
        folders = [name_of(folder, f"package_dirs[{i}]") for i, folder in enumerate(package_dirs)]
        group = self._scene.add_file(name_of(file), pose_of(pose), text_of(geometry, "geometry"),
                                     text_of(keyframe, "keyframe"), folders, bool(skip_missing_meshes),
                                     text_of(meshes, "meshes"))
        self._changed()
        return Robot(group, self._scene, self._changed)

    @public
    def add_json(self, file, pose=None):
        """Adds a scene file of Minkray; see `add_file`.

        Parameters
        ----------
        file : str or path
        pose : (4, 4) array, optional
            Of the file's contents.

        Returns
        -------
        Robot
            Without joints.
        """
        return self.add_file(file, pose)

    @public
    def add_urdf(self, file, pose=None, geometry="visual", package_dirs=(), skip_missing_meshes=False,
                 meshes=""):
        """Adds a robot from a URDF file; see `add_file`.

        Parameters
        ----------
        file : str or path
        pose : (4, 4) array, optional
            Of the file's contents.
        geometry : {'visual', 'collision', 'all'}
        package_dirs : list of str
            Folders to search for ``package://`` and ``model://``.
        skip_missing_meshes : bool
        meshes : {'', 'exact', 'hull'}

        Returns
        -------
        Robot
        """
        return self.add_file(file, pose, geometry, "", package_dirs, skip_missing_meshes, meshes)

    @public
    def add_mjcf(self, file, pose=None, geometry="visual", keyframe="", skip_missing_meshes=False,
                 meshes=""):
        """Adds an MJCF file, MuJoCo's format; see `add_file`.

        Parameters
        ----------
        file : str or path
        pose : (4, 4) array, optional
            Of the file's contents.
        geometry : {'visual', 'collision', 'all'}
        keyframe : str
            Keyframe with the initial pose.
        skip_missing_meshes : bool
        meshes : {'', 'exact', 'hull'}

        Returns
        -------
        Robot
        """
        return self.add_file(file, pose, geometry, keyframe, (), skip_missing_meshes, meshes)

    @public
    def add_sdf(self, file, pose=None, geometry="visual", package_dirs=(), skip_missing_meshes=False,
                 meshes=""):
        """Adds an SDF file, Gazebo's format; see `add_file`.

        Parameters
        ----------
        file : str or path
        pose : (4, 4) array, optional
            Of the file's contents.
        geometry : {'visual', 'collision', 'all'}
        package_dirs : list of str
            Folders to search for ``package://`` and ``model://``.
        skip_missing_meshes : bool
        meshes : {'', 'exact', 'hull'}

        Returns
        -------
        Robot
        """
        return self.add_file(file, pose, geometry, "", package_dirs, skip_missing_meshes, meshes)

    @public
    def add_gltf(self, file, pose=None):
        """Adds a glTF file; see `add_file`.

        Parameters
        ----------
        file : str or path
        pose : (4, 4) array, optional
            Of the file's contents.

        Returns
        -------
        Robot
        """
        return self.add_file(file, pose)

    @public
    def set_pose(self, object, pose):
        """Moves an object.

        Parameters
        ----------
        object : int
            Its number.
        pose : (4, 4) array
            From the shape's frame to the world; any invertible map.
        """
        self._scene.set_pose(whole_number_of(object, "object"), given_pose_of(pose))
        self._changed()

    @public
    def remove(self, object):
        """Removes an object.

        Parameters
        ----------
        object : int
            Its number, which is never reused. All other numbers stay the same.
        """
        number = whole_number_of(object, "object")
        self._scene.remove(number)
        self._removed.add(number)
        self._changed()

    @public
    def pose(self, object):
        """Pose of an object.

        Parameters
        ----------
        object : int
            Its number.

        Returns
        -------
        (4, 4) array of float64
            From the shape's frame to the world.
        """
        return self._scene.pose(whole_number_of(object, "object"))

    @property
    @public
    def names(self):
        """list of str : names of the objects by number.

        ``names[hits.object]`` is a list of names; None for a miss (NO_OBJECT) and for removed objects.
        """
        return _Names(None if i in self._removed else self._scene.name(i) for i in range(len(self)))

    def __len__(self):
        return len(self._scene)

    def __repr__(self):
        names = [name for name in self.names if name is not None]
        shown = ", ".join(names[:5]) + (", ..." if len(names) > 5 else "")
        return f"<minkray.Scene of {len(names)} objects{': ' if names else ''}{shown}>"

    @public
    def commit(self):
        """Applies changes. Queries do so themselves if necessary."""
        changes = self._changes
        self._scene.commit()
        self._committed = changes

    def _ready(self):
        if self._committed != self._changes:
            # A support function that the commit itself calls must not wait for it.
            if _minkray.is_in_support():
                self.commit()
            with self._commits:
                if self._committed != self._changes:
                    self.commit()
        return self._scene

    @staticmethod
    def _rows(rays, t_max):
        rays = array_of(rays, "rays")
        if rays.ndim == 0 or rays.shape[-1] != 6:
            raise Error(f"rays: must have the shape (..., 6) (got {rays.shape})")
        if t_max is not None:
            t_max = array_of(t_max, "t_max", "a number, or one per ray")
            try:
                t_max = np.broadcast_to(t_max, rays.shape[:-1]).ravel() if t_max.ndim > 0 else t_max
            except ValueError:
                raise Error(f"t_max: must be a number, or one per ray (got the shape {t_max.shape} "
                            f"for rays of {rays.shape[:-1]})") from None
        rows = rays if rays.ndim == 2 else rays.reshape(-1, 6)
        return rows, t_max, rays.shape[:-1]

    @staticmethod
    def _shaped(fields, shape):
        return {name: values.reshape(shape + values.shape[1:]) if isinstance(values, np.ndarray)
                else values for name, values in fields.items()}

    @public
    def cast_rays(self, rays, t_max=None, threads=0, *, jac=False, jac_error=False):
        """First hits of rays.

        Parameters
        ----------
        rays : (N, 6) or (..., 6) array
            Origin and direction (of any length except zero). Arrays of float64 are not copied.
        t_max : float or (...) array, optional
            End of the ray, in lengths of the direction; None: no end. 0: only the origin.
        threads : int
            0: one per core. Results are bit-identical for any number.
        jac : bool
            Add derivatives of `t`.
        jac_error : bool
            Add bounds of the derivatives' errors.

        Returns
        -------
        Hits
            Its arrays have the shape of the rays, without the last axis.

        Raises
        ------
        Error
            If the rays have another shape, a zero direction, or a number that is not finite; names
            the ray.

        Examples
        --------
        >>> import minkray as mk
        >>> scene = mk.Scene()
        >>> ball = scene.add(mk.sphere(1))
        >>> scene.cast_rays([[-4, 0, 0, 2, 0, 0], [-4, 3, 0, 2, 0, 0]]).t
        array([1.5, inf])
        """
        rows, ends, shape = self._rows(rays, t_max)
        found = self._ready().cast(rows, ends, _threads(threads), bool(jac), bool(jac_error))
        fields = {name: found.pop(name) for name in ("t", "t_lo", "t_hi")}  # t is the first of all
        return Hits(self._shaped({**fields, **found}, shape))

    @public
    def occluded(self, rays, t_max=None, threads=0):
        """True for rays that hit anything.

        Parameters
        ----------
        rays, t_max, threads
            As for `cast_rays`.

        Returns
        -------
        (...) array of bool

        Raises
        ------
        RuntimeError
            If the solver did not converge for a ray.
        """
        rows, t_max, shape = self._rows(rays, t_max)
        blocked = self._ready().occluded(rows, t_max, _threads(threads))
        if (blocked == EXHAUSTED).any():
            raise RuntimeError(f"the solver did not converge at ray {int(np.argmax(blocked == EXHAUSTED))}")
        return (blocked == HIT).reshape(shape)

    @public
    def certify(self, rays, hits=None, t_max=None, threads=0):
        """Casts rays and proves the results for all objects, by planes and support points alone.

        Parameters
        ----------
        rays : (N, 6) or (..., 6) array
            As for `cast_rays`.
        hits : Hits, optional
            Results of `cast_rays` for the same rays and t_max. A result that differs from a new cast
            does not hold.
        t_max : float or (...) array, optional
            As for `cast_rays`.
        threads : int

        Returns
        -------
        Proofs
        """
        rows, ends, shape = self._rows(rays, t_max)
        proofs = Proofs(self._shaped(self._ready().certify(rows, ends, _threads(threads)), shape))
        if hits is not None:
            if not isinstance(hits, Hits) or np.shape(hits.t) != shape:
                raise Error(f"hits: must be the Hits of these rays, of the shape {shape}")
            met = self.cast_rays(rays, t_max, threads)
            differs = (met.t != hits.t) | (met.object != hits.object) | (met.status != hits.status)
            proofs.holds[...] &= ~differs
            for i in np.flatnonzero(differs):
                proofs.complaint[i] = "the result differs from a new cast"
        return proofs

    @public
    def depth(self, K, pose, width, height, threads=0):
        """A depth image of a pinhole camera.

        Parameters
        ----------
        K, pose, width, height
            As for `minkray.pinhole`.
        threads : int

        Returns
        -------
        depth : (height, width) array of float64
            Along the camera's z axis; inf for a miss, NaN if the solver did not converge.
        object : (height, width) array of uint32
            NO_OBJECT for a miss.
        """
        hits = self.cast_rays(pinhole(K, pose, width, height), threads=threads)
        return np.where(hits.status == EXHAUSTED, np.nan, hits.t), hits.object

    @public
    def render(self, camera=None, spp=16, bounces=None, aovs=(), *, lights=None, background=None,
               width=0, height=0, integrator="auto", max_depth=None, denoise=False, seed=0, threads=0):
        """Renders a picture.

        Parameters
        ----------
        camera : dict, optional
            As in scene files: ``{"position": [0, -5, 2], "look_at": [0, 0, 0]}``. None: the camera of
            the first scene file that has one; if none has, everything is framed.
        spp : int
            Samples per pixel.
        bounces : int, optional
            Diffuse bounces of the integrator 'ambient' (default 1).
        aovs : list of str
            More channels: 'Z', 'N', 'P', 'dist', 'id.object', 'albedo' and all others of ``minkray
            render --help``, except 'cryptomatte'.
        lights : list of dict, optional
            As in scene files; None: the lights of the scene files, or a sun and a sky.
        background : list or dict, optional
            As in scene files; None: the background of the scene files.
        width, height : int
            In pixels; 0 for the camera's.
        integrator : {'auto', 'path', 'direct', 'ambient', 'normals'}
        max_depth : int, optional
            Largest number of bounces of the integrator 'path' (default 16).
        denoise : bool
        seed : int
        threads : int
            0: one per core. The picture is bit-identical for any number.

        Returns
        -------
        dict of str to array
            'rgb' (linear, float32, (height, width, 3)) and each of the aovs (float32 or uint32,
            (height, width) or (height, width, 2 or 3)). Rows from the top.

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
            raise Error(f"camera, lights, background: cannot hold a {type(value).__name__}")

        def often(number, name):
            return 0 if number is None else whole_number_of(number, name, 1000) or -1

        if isinstance(aovs, str):
            raise Error(f"aovs: must be a list of names, such as [{aovs!r}]")
        names = ["rgb", *(text_of(name, f"aovs[{i}]") for i, name in enumerate(aovs))]
        return _minkray.render(self._ready(), json.dumps(view, default=plain) if view else "",
                               whole_number_of(width, "width"), whole_number_of(height, "height"),
                               whole_number_of(spp, "spp"), whole_number_of(seed, "seed", 2**64 - 1),
                               text_of(integrator, "integrator"), often(bounces, "bounces"),
                               often(max_depth, "max_depth"), bool(denoise), names, _threads(threads))

    @public
    def clearance(self, robot, path, tolerance=0.01, only_obstacles=False, threads=0, *, jac=False,
                  jac_error=False):
        """Proven clearance of a robot along a path, to itself and to all other objects.

        Parameters
        ----------
        robot : Robot
            Of this scene. Its current pose does not matter.
        path : (K, J) array
            Rows of joint values in the order of `Robot.joint_names` (radians or lengths; four per
            ball joint), linear between rows.
        tolerance : float
            Largest gap between the bounds, relative to the clearance.
        only_obstacles : bool
            Check obstacles only, not self-collision.
        threads : int
            0: one per core.
        jac : bool
            Add derivatives with respect to the joint values.
        jac_error : bool
            Add bounds of the derivatives' errors.

        Returns
        -------
        Clearance
            For each of the K - 1 steps between rows; for the pose itself if K is 1. Pairs excluded
            by `allow` or `set_masks` are skipped.
        """
        robot = robot_of(robot, self._scene)
        path = np.atleast_2d(array_of(path, "path"))
        if path.ndim != 2:
            raise Error(f"path: must have shape (rows, joint values) (got {path.shape})")
        return Clearance(_minkray.clearance(self._ready(), robot._group, path,
                                            number_of(tolerance, "tolerance"), bool(only_obstacles),
                                            bool(jac), bool(jac_error), _threads(threads)))

    def verify(self, robot, path, rates=None, margin=0.0, tolerance=0.01, only_obstacles=False, threads=0,
               *, budget=4000, accelerations=None, proof=None):
        """Proves that a robot's motion is free of collisions at all times, or finds a collision.

        Parameters
        ----------
        robot : Robot
            Of this scene. Its current pose does not matter.
        path : (K, J) array
            Rows of joint values in the order of `Robot.joint_names`.
        rates : (K, J) array
            Derivatives of the joint values per row. With rates, joints move as cubics between rows;
            without, linearly.
        margin : float
            Distance that the robot must keep from obstacles.
        tolerance : float
            Largest gap between the bounds of the least clearance, relative to it.
        only_obstacles : bool
            Check obstacles only, not self-collision.
        threads : int
            0: one per core.
        budget : int
            Distance queries per pair and step before a motion is undecided.
        accelerations : (K, J) array
            Second derivatives of the joint values (need `rates`): joints then move as quintics.
        proof : str or path
            File for a proof, which ``minkray-check`` confirms. None is written for an undecided motion.

        Returns
        -------
        Verdict
            True if the motion is free. Pairs excluded by `allow` or `set_masks` are skipped.
        """
        robot = robot_of(robot, self._scene)
        path = np.atleast_2d(array_of(path, "path"))
        if path.ndim != 2:
            raise Error(f"path: must have shape (rows, joint values) (got {path.shape})")

        def table(rows, name):
            if rows is None:
                return np.zeros((0, 0))
            rows = np.atleast_2d(array_of(rows, name))
            if rows.shape != path.shape:
                raise Error(f"{name}: must have the shape of the path, {path.shape} (got {rows.shape})")
            return rows

        return Verdict(_minkray.verify(self._ready(), robot._group, path, table(rates, "rates"),
                                       table(accelerations, "accelerations"),
                                       number_of(margin, "margin"), number_of(tolerance, "tolerance"),
                                       whole_number_of(int(budget), "budget"), bool(only_obstacles),
                                       name_of(proof, "proof") if proof is not None else b"",
                                       _threads(threads)))
