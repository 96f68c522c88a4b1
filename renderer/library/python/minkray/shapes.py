# SPDX-License-Identifier: MIT
"""Shapes by their parameters, and custom ones."""
from __future__ import annotations

from typing import TYPE_CHECKING, Callable, Mapping, Optional, Sequence

from . import _minkray
from .calls import Error, Shape, array_of, name_of, number_of, public, shapes_of, text_of, vectors_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

__all__ = ["box", "capsule", "cone", "custom", "cut_cylinder", "cylinder", "disk", "ellipsoid", "frustum", "hull",
           "make", "point", "read_shape", "segment", "sphere", "superellipsoid", "tapered_capsule", "triangle"]


_SINGLE = ("radius", "half_height", "exponent")  # parameters that are one number


def _made(kind, shapes=None, **numbers):
    given = {name: number_of(value, name) if name in _SINGLE else array_of(value, name)
             for name, value in numbers.items()}
    return _minkray.make(kind, given, shapes or {})


@public
def make(kind: str, shapes: Optional[Mapping[str, Sequence[Shape]]] = None, **numbers: ArrayLike) -> Shape:
    """A shape of any kind, by its name in scene files.

    Parameters
    ----------
    kind : str
        Such as 'box'; ``minkray info --shapes`` lists kinds and parameters.
    shapes : dict of str to list of Shape, optional
        Operands.
    **numbers : array_like
        The other parameters: lengths, or points of three numbers each.

    Returns
    -------
    Shape

    Examples
    --------
    >>> import minkray as mk
    >>> mk.make("sphere", radius=2).bounds()
    array([[-2., -2., -2.],
           [ 2.,  2.,  2.]])
    """
    shapes = {} if shapes is None else shapes
    if not hasattr(shapes, "items"):
        raise Error(f"shapes: must be a dict of lists of shapes (got {type(shapes).__name__})")
    operands = {text_of(name, "shapes"): shapes_of((one,), f"shapes[{name!r}]")
                for name, one in shapes.items()}
    return _made(text_of(kind, "kind"), operands, **numbers)


@public
def point(position: ArrayLike) -> Shape:
    """A point.

    Parameters
    ----------
    position : (3,) array
        In the world's unit of length.

    Returns
    -------
    Shape
    """
    return _made("point", position=position)


@public
def segment(a: ArrayLike, b: ArrayLike) -> Shape:
    """A line segment between two points.

    Parameters
    ----------
    a, b : (3,) array
        Its end points.

    Returns
    -------
    Shape
    """
    return _made("segment", points=[vectors_of(a, "a", 3, 1), vectors_of(b, "b", 3, 1)])


@public
def triangle(a: ArrayLike, b: ArrayLike, c: ArrayLike) -> Shape:
    """A flat triangle.

    Parameters
    ----------
    a, b, c : (3,) array
        Its corners.

    Returns
    -------
    Shape
    """
    return _made("triangle", points=[vectors_of(point, name, 3, 1)
                                     for name, point in (("a", a), ("b", b), ("c", c))])


@public
def sphere(radius: float) -> Shape:
    """A ball around the origin.

    Parameters
    ----------
    radius : float
        In the world's unit of length.

    Returns
    -------
    Shape
    """
    return _made("sphere", radius=radius)


@public
def ellipsoid(radii: ArrayLike) -> Shape:
    """An ellipsoid around the origin.

    Parameters
    ----------
    radii : (3,) array
        Along x, y and z, in the world's unit of length.

    Returns
    -------
    Shape
    """
    return _made("ellipsoid", radii=radii)


@public
def box(half_extents: ArrayLike) -> Shape:
    """A box around the origin.

    Parameters
    ----------
    half_extents : (3,) array
        Half its size along x, y and z, in the world's unit of length.

    Returns
    -------
    Shape
    """
    return _made("box", half_extents=half_extents)


@public
def disk(radius: float) -> Shape:
    """A flat disk around the z axis, at z = 0.

    Parameters
    ----------
    radius : float
        In the world's unit of length.

    Returns
    -------
    Shape
    """
    return _made("disk", radius=radius)


@public
def cylinder(radius: float, half_height: float) -> Shape:
    """A cylinder around the z axis, from -half_height to half_height.

    Parameters
    ----------
    radius, half_height : float
        In the world's unit of length.

    Returns
    -------
    Shape
    """
    return _made("cylinder", radius=radius, half_height=half_height)


@public
def cut_cylinder(radius: float, heights: ArrayLike, lower_slope: ArrayLike = (0, 0),
                 upper_slope: ArrayLike = (0, 0)) -> Shape:
    """A cylinder around the z axis between two planes ``z = height + slope . (x, y)``.

    Parameters
    ----------
    radius : float
        In the world's unit of length.
    heights : (2,) array
        Heights of the lower and the upper plane at the axis.
    lower_slope, upper_slope : (2,) array
        Slope of each plane along x and along y.

    Returns
    -------
    Shape
    """
    return _made("cut_cylinder", radius=radius, heights=heights, lower_slope=lower_slope,
                upper_slope=upper_slope)


@public
def cone(radius: float, half_height: float) -> Shape:
    """A cone around the z axis, its base at -half_height, its tip at half_height.

    Parameters
    ----------
    radius, half_height : float
        In the world's unit of length.

    Returns
    -------
    Shape
    """
    return _made("cone", radius=radius, half_height=half_height)


@public
def capsule(radius: float, half_height: float) -> Shape:
    """A capsule: all points within `radius` of a segment of the z axis.

    Parameters
    ----------
    radius, half_height : float
        In the world's unit of length.

    Returns
    -------
    Shape
    """
    return _made("capsule", radius=radius, half_height=half_height)


@public
def tapered_capsule(radii: ArrayLike, half_height: float) -> Shape:
    """The convex hull of two balls on the z axis, at -half_height and half_height.

    Parameters
    ----------
    radii : (2,) array
        Radii of the lower and the upper ball.
    half_height : float
        In the world's unit of length.

    Returns
    -------
    Shape
    """
    return _made("tapered_capsule", radii=radii, half_height=half_height)


@public
def frustum(radii: ArrayLike, half_height: float) -> Shape:
    """A frustum of a cone between two disks, at -half_height and half_height.

    Parameters
    ----------
    radii : (2,) array
        Radii of the lower and the upper disk.
    half_height : float
        In the world's unit of length.

    Returns
    -------
    Shape
    """
    return _made("frustum", radii=radii, half_height=half_height)


@public
def superellipsoid(radii: ArrayLike, exponent: float) -> Shape:
    """All points with ``sum(abs(x / radii) ** exponent) <= 1``; exponent >= 1.

    Parameters
    ----------
    radii : (3,) array
        Along x, y and z, in the world's unit of length.
    exponent : float
        At least 1; 2 is an ellipsoid, larger values are boxier.

    Returns
    -------
    Shape
    """
    return _made("superellipsoid", radii=radii, exponent=exponent)


@public
def hull(points: ArrayLike) -> Shape:
    """The convex hull of points.

    Parameters
    ----------
    points : (N, 3) array

    Returns
    -------
    Shape
    """
    return _made("hull", points=vectors_of(points, "points", 3, 2))


@public
def custom(support: Callable[[NDArray[np.float64]], ArrayLike], bounds: Optional[ArrayLike] = None) -> Shape:
    """A custom shape, given by its support function.

    Parameters
    ----------
    support : callable
        Takes unit directions, an array of shape (M, 3), and returns the shape's furthest points along
        them, of shape (M, 3). Equal directions must get equal points.
    bounds : (2, 3) array, optional
        Corners of a box that contains the shape.

    Returns
    -------
    Shape
        Cannot be pickled.

    Raises
    ------
    Error
        If the returned points belong to no convex shape. Queries check later points, too, and raise.

    Notes
    -----
    Casts collect directions of many rays, so the function is called with hundreds of directions at
    once. Any thread may call it, with the interpreter's lock.

    Examples
    --------
    >>> import minkray as mk, numpy as np
    >>> mine = mk.custom(lambda n: np.copysign([0.5, 0.3, 0.2], n))
    >>> mine.support([[1, 1, 1]])
    array([[0.5, 0.3, 0.2]])
    """
    if not callable(support):
        raise Error(f"support: must be callable (got {type(support).__name__})")
    corners = None if bounds is None else vectors_of(bounds, "bounds", 3, 2)
    if corners is not None and len(corners) != 2:
        raise Error(f"bounds: must have the shape (2, 3) (got {corners.shape})")
    return _minkray.custom(support, corners)


@public
def read_shape(json: str, folder: str = "") -> Shape:
    """Reads a shape from JSON, as in scene files.

    Parameters
    ----------
    json : str
        Such as ``'{"type": "sphere", "radius": 1}'``.
    folder : str
        Folder of mesh files (default: the working folder).

    Returns
    -------
    Shape
    """
    return _minkray.read_shape(text_of(json, "json"), name_of(folder, "folder"))
