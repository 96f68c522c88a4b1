# SPDX-License-Identifier: MIT
"""Meshes and height fields."""
import numpy as np

from . import _minkray
from .calls import Error, array_of, number_of, public, shape_of, vectors_of


@public
def mesh(vertices, triangles):
    """A triangle mesh with shared vertices (not its convex hull).

    Parameters
    ----------
    vertices : (N, 3) array
    triangles : (M, 3) array of int
        Indices of vertices, counter-clockwise as seen from outside.

    Returns
    -------
    Shape
        Usable in scenes and casts like any shape, but not as an operand, since it is not convex.

    Raises
    ------
    Error
        If an index is out of range, or a coordinate is not finite.

    Examples
    --------
    >>> import numpy as np, minkray as mk
    >>> valley = mk.mesh([[-1, -1, 1], [-1, 1, 1], [0, -1, 0], [0, 1, 0], [1, -1, 1], [1, 1, 1]],
    ...                  [[0, 2, 1], [1, 2, 3], [2, 4, 3], [3, 4, 5]])
    >>> scene = mk.Scene()
    >>> _ = scene.add(valley)
    >>> scene.commit()
    >>> float(scene.cast_rays([0.5, 0, 9, 0, 0, -1]).t)
    8.5
    """
    corners = np.asarray(triangles)
    if corners.ndim != 2 or corners.shape[1] != 3 or corners.dtype.kind not in "iu":
        raise Error("triangles: must be whole numbers of shape (M, 3) "
                    f"(got {corners.dtype} of shape {corners.shape})")
    points = vectors_of(vertices, "vertices", 3, 2)
    if corners.size and not (0 <= corners.min() and corners.max() < len(points)):
        raise Error(f"triangles: must be from 0 to {len(points) - 1} "
                    f"(got {corners.min()} to {corners.max()})")
    return _minkray.mesh(np.ascontiguousarray(points), np.ascontiguousarray(corners, dtype=np.uint32))


@public
def height_field(heights, size, bottom=None):
    """A terrain: a mesh with two triangles per cell of a grid.

    Parameters
    ----------
    heights : (R, C) array
        Rows along y, starting at the least y; columns along x.
    size : (2,) array
        Size along x (first to last column) and y (rows). The grid is centred above the origin.
    bottom : float, optional
        z of a bottom that closes the terrain to a solid, with walls. Default: open.

    Returns
    -------
    Shape
        As from `mesh`. The triangles of the cell in row r and column c are ``2 * (r * (C - 1) + c)``
        and the next one.

    Raises
    ------
    Error
        If there are fewer than two rows or columns, or the bottom is not below all heights.

    Examples
    --------
    >>> import minkray as mk
    >>> scene = mk.Scene()
    >>> _ = scene.add(mk.height_field([[0, 0, 0], [0, 1, 0], [0, 0, 0]], size=(2, 2)))
    >>> scene.commit()
    >>> float(scene.cast_rays([0.5, 0, 9, 0, 0, -1]).t)
    8.5
    """
    grid = np.ascontiguousarray(array_of(heights, "heights"))
    if grid.ndim != 2:
        raise Error(f"heights: must be of shape (R, C) (got {grid.shape})")
    sizes = array_of(size, "size", "two numbers")
    if sizes.shape != (2,):
        raise Error(f"size: must be two numbers (got shape {sizes.shape})")
    return _minkray.height_field(grid, float(sizes[0]), float(sizes[1]),
                                 None if bottom is None else number_of(bottom, "bottom"))


@public
def mesh_info(mesh):
    """Counts of a mesh. Vertices at the same position count as one, except in 'vertices'.

    Parameters
    ----------
    mesh : Shape

    Returns
    -------
    dict
        'vertices', 'triangles', 'open_edges' (0: the mesh is closed), triangles 'without_area', and
        'repeated' triangles.
    """
    return _minkray.mesh_info(shape_of(mesh, "mesh"))
