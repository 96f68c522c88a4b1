# SPDX-License-Identifier: MIT
"""Scenes and their queries."""
import threading

import numpy as np

from . import _minkray
from .answers import NO_OBJECT, Clearance, Verdict
from .calls import (Error, array_of, given_pose_of, list_of, name_of, number_of, pose_of, public, shape_of,
                    text_of, vectors_of, whole_number_of)
from .many_pairs import threads_of
from .robots import Robot, robot_of
from .scene_pairs import PairsOfScene
from .scene_rays import RaysOfScene


class _Names(list):
    """Names by number: None for a miss and for removed objects; a list for an array of numbers."""

    def __getitem__(self, number):
        if isinstance(number, np.ndarray) and number.ndim > 0:
            return [self[one] for one in number]
        if not isinstance(number, slice) and number == NO_OBJECT:
            return None
        return super().__getitem__(number)


class Scene(RaysOfScene, PairsOfScene):
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
        pose : (4, 4) or (7,) array, optional
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
        """Adds a half-space: all points x with ``normal . x <= offset * |normal|``.

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
        """Adds a file: a Minkray scene (.json), or a robot (URDF, MJCF, SDF, glTF).

        Parameters
        ----------
        file : str or path
        pose : (4, 4) or (7,) array, optional
            Of the file's contents.
        geometry : {'visual', 'collision', 'all'}
            Shapes of robots to use.
        keyframe : str
            Keyframe of an MJCF file.
        package_dirs : list of str
            Folders to search for ``package://`` and ``model://``.
        skip_missing_meshes : bool
        meshes : {'', 'exact', 'hull'}
            Use the triangles of robots' mesh files, or their convex hulls. The default is 'exact',
            but contacts of MJCF robots use the hull, as in MuJoCo.

        Returns
        -------
        Robot
        """
        folders = [name_of(folder, f"package_dirs[{i}]")
                   for i, folder in enumerate(list_of(package_dirs, "package_dirs", "folders"))]
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
        pose : (4, 4) or (7,) array, optional
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
        pose : (4, 4) or (7,) array, optional
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
        pose : (4, 4) or (7,) array, optional
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
        pose : (4, 4) or (7,) array, optional
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
        pose : (4, 4) or (7,) array, optional
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
        pose : (4, 4) or (7,) array
            From the shape's frame to the world: any invertible map, or x, y, z, qw, qx, qy, qz.
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
        """Applies changes. Queries call it automatically if necessary."""
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
            Measure only to bodies of the other files, not between bodies of the first file.
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
                                            bool(jac), bool(jac_error), threads_of(threads)))

    @public
    def verify(self, robot, path, rates=None, margin=0.0, tolerance=0.01, only_obstacles=False, threads=0,
               *, budget=4000, accelerations=None, proof=None, times=None):
        """Proves that a robot's motion is free of collisions at all times, or finds a collision.

        Parameters
        ----------
        robot : Robot
            Of this scene. Its current pose does not matter.
        path : (K, J) array
            Rows of joint values in the order of `Robot.joint_names`.
        rates : (K, J) array
            Derivatives of the joint values with respect to time. With rates, joints move as cubics
            between rows; without, linearly.
        margin : float
            Distance that the robot must keep from obstacles.
        tolerance : float
            Largest gap between the bounds of the clearance, relative to the clearance.
        only_obstacles : bool
            Measure only to bodies of the other files, not between bodies of the first file.
        threads : int
            0: one per core.
        budget : int
            Distance queries per pair and step before a motion is undecided.
        accelerations : (K, J) array
            Second derivatives of the joint values (need `rates`): joints then move as quintics.
        proof : str or path
            File for a proof, which ``minkray-check`` confirms. None is written for an undecided motion.
        times : (K,) array
            Increasing times of the rows. Default 0, 1, 2, ...

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

        def moments():
            if times is None:
                return np.zeros(0)
            given = array_of(times, "times")
            if given.shape != path.shape[:1]:
                raise Error(f"times: must have the shape {path.shape[:1]}, one per row (got {given.shape})")
            return given

        return Verdict(_minkray.verify(self._ready(), robot._group, path, table(rates, "rates"),
                                       table(accelerations, "accelerations"), moments(),
                                       number_of(margin, "margin"), number_of(tolerance, "tolerance"),
                                       whole_number_of(int(budget), "budget"), bool(only_obstacles),
                                       name_of(proof, "proof") if proof is not None else b"",
                                       threads_of(threads)))
