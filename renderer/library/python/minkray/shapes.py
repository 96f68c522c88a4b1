# SPDX-License-Identifier: MIT
"""Shapes, and shapes made of shapes."""
import numpy as np

from . import _minkray


def make(kind, shapes=None, **numbers):
    """A shape of any kind that scene files know, by the names they have there.

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
    return _minkray.make(kind, {name: np.asarray(value, float) for name, value in numbers.items()},
                         shapes or {})


def point(position):
    """A point, of shape (3,).

    Parameters
    ----------
    position : (3,) array
        In the world's unit of length.

    Returns
    -------
    Shape
    """
    return make("point", position=position)


def segment(a, b):
    """The points between two.

    Parameters
    ----------
    a, b : (3,) array
        Its ends.

    Returns
    -------
    Shape
    """
    return make("segment", points=[a, b])


def triangle(a, b, c):
    """A flat triangle.

    Parameters
    ----------
    a, b, c : (3,) array
        Its corners.

    Returns
    -------
    Shape
    """
    return make("triangle", points=[a, b, c])


def sphere(radius):
    """A ball around the origin.

    Parameters
    ----------
    radius : float
        In the world's unit of length.

    Returns
    -------
    Shape
    """
    return make("sphere", radius=radius)


def ellipsoid(radii):
    """An ellipsoid around the origin, its three radii along x, y and z.

    Parameters
    ----------
    radii : (3,) array
        Along x, y and z, in the world's unit of length.

    Returns
    -------
    Shape
    """
    return make("ellipsoid", radii=radii)


def box(half_extents):
    """A box around the origin, half its size along x, y and z.

    Parameters
    ----------
    half_extents : (3,) array
        Half its size along x, y and z, in the world's unit of length.

    Returns
    -------
    Shape
    """
    return make("box", half_extents=half_extents)


def disk(radius):
    """A flat disk around the z axis, at z = 0.

    Parameters
    ----------
    radius : float
        In the world's unit of length.

    Returns
    -------
    Shape
    """
    return make("disk", radius=radius)


def cylinder(radius, half_height):
    """A cylinder around the z axis, from -half_height to half_height.

    Parameters
    ----------
    radius, half_height : float
        In the world's unit of length.

    Returns
    -------
    Shape
    """
    return make("cylinder", radius=radius, half_height=half_height)


def cut_cylinder(radius, heights, lower_slope=(0, 0), upper_slope=(0, 0)):
    """A cylinder around the z axis between two planes ``z = height + slope . (x, y)``.

    Parameters
    ----------
    radius : float
        In the world's unit of length.
    heights : (2,) array
        Of the lower and the upper plane at the axis.
    lower_slope, upper_slope : (2,) array
        How much a plane rises a unit of x and of y.

    Returns
    -------
    Shape
    """
    return make("cut_cylinder", radius=radius, heights=heights, lower_slope=lower_slope,
                upper_slope=upper_slope)


def cone(radius, half_height):
    """A cone around the z axis, its base at -half_height, its tip at half_height.

    Parameters
    ----------
    radius, half_height : float
        In the world's unit of length.

    Returns
    -------
    Shape
    """
    return make("cone", radius=radius, half_height=half_height)


def capsule(radius, half_height):
    """All points not further than `radius` from a segment of the z axis.

    Parameters
    ----------
    radius, half_height : float
        In the world's unit of length.

    Returns
    -------
    Shape
    """
    return make("capsule", radius=radius, half_height=half_height)


def tapered_capsule(radii, half_height):
    """The hull of two balls on the z axis, at -half_height and half_height.

    Parameters
    ----------
    radii : (2,) array
        Of the lower and the upper ball.
    half_height : float
        In the world's unit of length.

    Returns
    -------
    Shape
    """
    return make("tapered_capsule", radii=radii, half_height=half_height)


def frustum(radii, half_height):
    """A cone cut off by two disks of the given radii, at -half_height and half_height.

    Parameters
    ----------
    radii : (2,) array
        Of the lower and the upper disk.
    half_height : float
        In the world's unit of length.

    Returns
    -------
    Shape
    """
    return make("frustum", radii=radii, half_height=half_height)


def superellipsoid(radii, exponent):
    """All points with ``sum(abs(x / radii) ** exponent) <= 1``; exponent >= 1.

    Parameters
    ----------
    radii : (3,) array
        Along x, y and z, in the world's unit of length.
    exponent : float
        At least 1: 2 is an ellipsoid, more is boxier.

    Returns
    -------
    Shape
    """
    return make("superellipsoid", radii=radii, exponent=exponent)


def hull(points):
    """The convex hull of points, of shape (N, 3).

    Parameters
    ----------
    points : (N, 3) array

    Returns
    -------
    Shape
    """
    return make("hull", points=points)


def rounded(shape, radius):
    """The shape, grown by a radius: its sum with a ball.

    Parameters
    ----------
    shape : Shape
    radius : float
        In the world's unit of length.

    Returns
    -------
    Shape
    """
    return make("rounded", {"shape": [shape]}, radius=radius)


def sum(*shapes):
    """The Minkowski sum: all sums of a point of each of the shapes.

    Parameters
    ----------
    *shapes : Shape

    Returns
    -------
    Shape
    """
    return make("minkowski_sum", {"shapes": list(shapes)})


def difference(a, b):
    """All differences of a point of a and a point of b: the configuration space obstacle.

    Parameters
    ----------
    a, b : Shape

    Returns
    -------
    Shape
    """
    return make("minkowski_difference", {"a": [a], "b": [b]})


def hull_of(*shapes):
    """The convex hull of shapes.

    Parameters
    ----------
    *shapes : Shape

    Returns
    -------
    Shape
    """
    return make("hull_of", {"shapes": list(shapes)})


def transformed(shape, matrix):
    """The shape under an invertible map: a (3, 4) or (4, 4) matrix.

    Parameters
    ----------
    shape : Shape
    matrix : (3, 4) or (4, 4) array
        Any invertible map; a last row must be (0, 0, 0, 1).

    Returns
    -------
    Shape
    """
    return make("transform", {"shape": [shape]}, map=np.asarray(matrix, float)[:3])


def translated(shape, by):
    """The shape, moved.

    Parameters
    ----------
    shape : Shape
    by : (3,) array
        In the world's unit of length.

    Returns
    -------
    Shape
    """
    return transformed(shape, np.column_stack([np.eye(3), by]))


def scaled(shape, by):
    """The shape, scaled by a number, or by one along each axis.

    Parameters
    ----------
    shape : Shape
    by : float or (3,) array
        Along all axes, or along each; not zero.

    Returns
    -------
    Shape
    """
    return transformed(shape, np.column_stack([np.diag(np.ones(3) * by), np.zeros(3)]))


def swept(shape, way):
    """All that the shape comes through that goes along `way` without turning.

    Parameters
    ----------
    shape : Shape
    way : (3,) array
        In the world's unit of length.

    Returns
    -------
    Shape
    """
    return sum(shape, segment([0, 0, 0], way))


def custom(support, bounds=None):
    """A shape of your own, by its support function.

    Parameters
    ----------
    support : callable
        Takes directions of unit length, an array of shape (M, 3), and answers the points of the shape
        that lie furthest along them, of shape (M, 3). Equal directions must get equal points.
    bounds : (2, 3) array, optional
        Corners of a box that holds the shape.

    Returns
    -------
    Shape
        It cannot be pickled.

    Raises
    ------
    Error
        If no convex shape can have the points it answers. What it answers later on is checked as well:
        a query that is lied to raises too.

    Notes
    -----
    While rays are cast, many of them wait for each other, so that the function is called with
    hundreds of directions at once. It is called with the interpreter's lock, by any thread.

    Examples
    --------
    >>> import minkray as mk, numpy as np
    >>> mine = mk.custom(lambda n: np.copysign([0.5, 0.3, 0.2], n))
    >>> mine.support([[1, 1, 1]])
    array([[0.5, 0.3, 0.2]])
    """
    return _minkray.custom(support, bounds)


def read_shape(json, folder=""):
    """The shape that a text in the scene files' format describes.

    Parameters
    ----------
    json : str
        Such as ``'{"type": "sphere", "radius": 1}'``.
    folder : str
        Where mesh files are looked for; the working folder if left out.

    Returns
    -------
    Shape
    """
    return _minkray.read_shape(json, folder)
