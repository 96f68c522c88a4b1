# SPDX-License-Identifier: MIT
"""Rays of cameras and lidars, as arrays whose last axis is origin and direction."""
import json

import numpy as np

from . import _minkray
from .calls import Error, array_of, name_of, pose_of, public, vectors_of, whole_number_of


@public
def pinhole(K, pose, width, height):
    """The rays of a pinhole camera through its pixel centres.

    Parameters
    ----------
    K : (3, 3) array
        Camera matrix, in pixels; the frame is OpenCV's: x right, y down, z ahead. The upper left
        corner of the picture is at (0, 0), the centre of the first pixel at (0.5, 0.5).
    pose : (4, 4) or (7,) array or None
        Of the camera, in the world.
    width, height : int
        In pixels.

    Returns
    -------
    (height, width, 6) array of float64
        Directions have z = 1 in the camera's frame, so `t` is the depth.

    Examples
    --------
    >>> import minkray as mk
    >>> rays = mk.pinhole([[500, 0, 320], [0, 500, 240], [0, 0, 1]], None, 640, 480)
    >>> rays.shape
    (480, 640, 6)
    """
    K = array_of(K, "K", "a (3, 3) matrix")
    if K.shape != (3, 3):
        raise Error(f"K: must have the shape (3, 3) (got {K.shape})")
    if vectors_of(K, "K", 3)[0, 0] == 0 or K[1, 1] == 0:
        raise Error(f"K: must be a (3, 3) matrix whose focal lengths are not zero (got {K.tolist()})")
    pose = np.eye(4) if pose is None else pose_of(pose)
    width, height = whole_number_of(width, "width"), whole_number_of(height, "height")
    x = (np.arange(width) + 0.5 - K[0, 2]) / K[0, 0]
    y = (np.arange(height) + 0.5 - K[1, 2]) / K[1, 1]
    directions = np.empty((height, width, 3))
    directions[..., 0] = x
    directions[..., 1] = y[:, None]
    directions[..., 2] = 1
    rays = np.empty((height, width, 6))
    rays[..., :3] = pose[:3, 3]
    rays[..., 3:] = directions @ pose[:3, :3].T
    return rays


@public
def camera(calibration, pose=None):
    """The rays of a calibrated camera through its pixel centres.

    Parameters
    ----------
    calibration : dict
        ``fx, fy, cx, cy, width, height`` in pixels, and optionally ``model`` ("pinhole" or "fisheye"),
        ``k1`` to ``k6`` (fisheyes ``k4``), ``p1`` and ``p2``, as in OpenCV: the centre of the first
        pixel is at (0, 0).
    pose : (4, 4) or (7,) array, optional
        Of the camera, in the world: x right, y down, z ahead.

    Returns
    -------
    (height, width, 6) array of float64
        Directions have z = 1 in the camera's frame, so `t` is the depth; for fisheyes they have
        length 1. NaN where the distortion has no inverse.

    Examples
    --------
    >>> import minkray as mk
    >>> lens = {"fx": 50, "fy": 50, "cx": 31.5, "cy": 23.5, "width": 64, "height": 48, "k1": -0.1}
    >>> mk.camera(lens).shape
    (48, 64, 6)
    """
    if not isinstance(calibration, dict):
        raise Error(f"calibration: must be a dict (got {type(calibration).__name__})")
    try:
        text = json.dumps(calibration)
    except TypeError as error:
        raise Error(f"calibration: {error}") from None
    rays = _minkray.camera(text, pose_of(pose))
    return rays.reshape(calibration["height"], calibration["width"], 6)


@public
def lidar(pattern, pose=None):
    """The rays of a lidar.

    Parameters
    ----------
    pattern : str or tuple
        Name of a lidar: "VLP-16", "VLP-32C", "HDL-64E", "OS1-64" or "Mid-360". Or a file: .csv of
        azimuths and zeniths (Livox), .json of elevations (also Ouster's), .mat3x4f (RobotecGPULidar).
        Or a spinning lidar: ``(channels, steps)`` or ``(channels, steps, lowest, highest)`` with
        elevations in degrees (default -15 and 15). Rays of a spinning lidar are ordered by channel,
        the highest first, then clockwise from behind: ``rays.reshape(channels, steps, 6)`` is an image.
    pose : (4, 4) or (7,) array, optional
        Of the sensor, in the world; x is ahead, z the axis.

    Returns
    -------
    (N, 6) array of float64
        Origins and unit directions, so `t` is the distance.

    Examples
    --------
    >>> import minkray as mk
    >>> mk.lidar((32, 1800)).shape
    (57600, 6)
    """
    if isinstance(pattern, (tuple, list)):
        channels, steps, *limits = pattern
        if len(limits) not in (0, 2):
            raise Error("pattern: must be (channels, steps) or (channels, steps, lowest, highest)"
                             f" (got {pattern})")
        pattern = f"spinning:{channels}x{steps}" + (":{},{}".format(*limits) if limits else "")
    return _minkray.lidar(name_of(pattern, "pattern"), pose_of(pose))
