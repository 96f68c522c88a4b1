# SPDX-License-Identifier: MIT
"""Rays of cameras and lidars, as arrays whose last axis is origin and direction."""
import numpy as np


def pinhole(K, pose, width, height):
    """The rays of a pinhole camera through the middles of its pixels.

    Parameters
    ----------
    K : (3, 3) array
        In pixels; the frame is OpenCV's: x right, y down, z ahead.
    pose : (4, 4) array or None
        Of the camera, in the world.
    width, height : int

    Returns
    -------
    (height, width, 6) array
        Directions have z = 1 in the camera's frame, so `t` is the depth.
    """
    K = np.asarray(K, float)
    pose = np.eye(4) if pose is None else np.asarray(pose, float)
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


def lidar(pattern, pose=None):
    """The rays of a lidar.

    Parameters
    ----------
    pattern : str or tuple
        A CSV file with columns for azimuth and zenith or elevation, in degrees, as Livox publishes
        its patterns; or ``(channels, steps)``, or ``(channels, steps, lowest, highest)`` with
        elevations in degrees: a sensor that spins.
    pose : (4, 4) array or None
        Of the sensor; x is ahead, z the axis.

    Returns
    -------
    (N, 6) array
        Directions of length 1, so `t` is the distance.
    """
    if isinstance(pattern, (tuple, list)):
        channels, steps, *limits = pattern
        lowest, highest = limits or (-15, 15)
        elevation = np.radians(np.linspace(lowest, highest, channels))
        azimuth = 2 * np.pi * np.arange(steps) / steps
        azimuth, elevation = (grid.ravel() for grid in np.meshgrid(azimuth, elevation, indexing="ij"))
    else:
        table = np.genfromtxt(pattern, delimiter=",", names=True)
        names = {name.lower(): name for name in table.dtype.names}

        def column(word):
            found = [name for lower, name in names.items() if lower.startswith(word)]
            return np.radians(table[found[0]]) if found else None

        azimuth, elevation, zenith = column("azimuth"), column("elevation"), column("zenith")
        if azimuth is None or (elevation is None and zenith is None):
            raise ValueError(f"{pattern}: must have columns for azimuth and zenith or elevation")
        if elevation is None:
            elevation = np.pi / 2 - zenith
    pose = np.eye(4) if pose is None else np.asarray(pose, float)
    directions = np.stack([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth),
                           np.sin(elevation)], axis=-1)
    rays = np.empty((len(azimuth), 6))
    rays[:, :3] = pose[:3, 3]
    rays[:, 3:] = directions @ pose[:3, :3].T
    return rays
