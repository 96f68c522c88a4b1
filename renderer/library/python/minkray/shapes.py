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
    """
    return _minkray.make(kind, {name: np.asarray(value, float) for name, value in numbers.items()},
                         shapes or {})


def point(position):
    """A point, of shape (3,)."""
    return make("point", position=position)


def segment(a, b):
    """The points between two."""
    return make("segment", points=[a, b])


def triangle(a, b, c):
    """A flat triangle."""
    return make("triangle", points=[a, b, c])


def sphere(radius):
    """A ball around the origin."""
    return make("sphere", radius=radius)


def ellipsoid(radii):
    """An ellipsoid around the origin, its three radii along x, y and z."""
    return make("ellipsoid", radii=radii)


def box(half_extents):
    """A box around the origin, half its size along x, y and z."""
    return make("box", half_extents=half_extents)


def disk(radius):
    """A flat disk around the z axis, at z = 0."""
    return make("disk", radius=radius)


def cylinder(radius, half_height):
    """A cylinder around the z axis, from -half_height to half_height."""
    return make("cylinder", radius=radius, half_height=half_height)


def cut_cylinder(radius, heights, lower_slope=(0, 0), upper_slope=(0, 0)):
    """A cylinder around the z axis between two planes ``z = height + slope . (x, y)``."""
    return make("cut_cylinder", radius=radius, heights=heights, lower_slope=lower_slope,
                upper_slope=upper_slope)


def cone(radius, half_height):
    """A cone around the z axis, its base at -half_height, its tip at half_height."""
    return make("cone", radius=radius, half_height=half_height)


def capsule(radius, half_height):
    """All points not further than `radius` from a segment of the z axis."""
    return make("capsule", radius=radius, half_height=half_height)


def tapered_capsule(radii, half_height):
    """The hull of two balls on the z axis, at -half_height and half_height."""
    return make("tapered_capsule", radii=radii, half_height=half_height)


def frustum(radii, half_height):
    """A cone cut off by two disks of the given radii, at -half_height and half_height."""
    return make("frustum", radii=radii, half_height=half_height)


def superellipsoid(radii, exponent):
    """All points with ``sum(abs(x / radii) ** exponent) <= 1``; exponent >= 1."""
    return make("superellipsoid", radii=radii, exponent=exponent)


def hull(points):
    """The convex hull of points, of shape (N, 3)."""
    return make("hull", points=points)


def rounded(shape, radius):
    """The shape, grown by a radius: its sum with a ball."""
    return make("rounded", {"shape": [shape]}, radius=radius)


def sum(*shapes):
    """The Minkowski sum: all sums of a point of each of the shapes."""
    return make("minkowski_sum", {"shapes": list(shapes)})


def difference(a, b):
    """All differences of a point of a and a point of b: the configuration space obstacle."""
    return make("minkowski_difference", {"a": [a], "b": [b]})


def hull_of(*shapes):
    """The convex hull of shapes."""
    return make("hull_of", {"shapes": list(shapes)})


def transformed(shape, matrix):
    """The shape under an invertible map: a (3, 4) or (4, 4) matrix."""
    return make("transform", {"shape": [shape]}, map=np.asarray(matrix, float)[:3])


def translated(shape, by):
    """The shape, moved."""
    return transformed(shape, np.column_stack([np.eye(3), by]))


def scaled(shape, by):
    """The shape, scaled by a number, or by one along each axis."""
    return transformed(shape, np.column_stack([np.diag(np.ones(3) * by), np.zeros(3)]))


def swept(shape, way):
    """All that the shape comes through that goes along `way` without turning."""
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

    Raises
    ------
    Error
        If no convex shape can have the points it answers. What it answers later on is checked as well:
        a query that is lied to raises too.
    """
    return _minkray.custom(support, bounds)


def read_shape(json, folder=""):
    """The shape that a text in the scene files' format describes; mesh files are in `folder`."""
    return _minkray.read_shape(json, folder)
