# SPDX-License-Identifier: MIT
"""Meshes, height fields and compounds."""
import numpy as np

from . import _minkray
from .calls import Error, array_of, number_of, poses_of, public, shape_of, shapes_array, vectors_of


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


@public
def compound(shapes, poses=None):
    """A solid of convex parts.

    Parameters
    ----------
    shapes : list of Shape
        Convex: not meshes or compounds.
    poses : (N, 4, 4) or (N, 7) array, optional
        One for each part.

    Returns
    -------
    Shape
        Usable like a mesh. The `part` of a hit is the index of the shape.

    Examples
    --------
    >>> import minkray as mk
    >>> hammer = mk.compound([mk.cylinder(0.1, 1), mk.box([0.5, 0.2, 0.2])], [[0, 0, 0, 1, 0, 0, 0], [0, 0, 1, 1, 0, 0, 0]])
    >>> scene = mk.Scene()
    >>> _ = scene.add(hammer)
    >>> scene.commit()
    >>> hit = scene.cast_rays([0.4, 0, 9, 0, 0, -1])
    >>> round(float(hit.t), 12), int(hit.part)
    (7.8, 1)
    """
    parts = shapes_array(shapes, "shapes")
    if parts.ndim != 1 or not parts.size:
        raise Error(f"shapes: must be a list of shapes (got shape {parts.shape})")
    maps = np.ascontiguousarray(np.broadcast_to(np.eye(4)[:3], (len(parts), 3, 4)) if poses is None
                                else poses_of(poses, "poses"), dtype=float)
    if maps.shape != (len(parts), 3, 4):
        raise Error(f"poses: must be one for each of {len(parts)} shapes (got {np.shape(poses)})")
    return _minkray.compound(list(parts), maps)


@public
def compound_parts(compound):
    """Shapes and poses of a compound: a list, and an array of shape (N, 3, 4)."""
    return _minkray.compound_parts(shape_of(compound, "compound"))
