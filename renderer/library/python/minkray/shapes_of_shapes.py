# SPDX-License-Identifier: MIT
"""Shapes made of shapes."""
import numpy as np

from .calls import Error, array_of, given_pose_of, public, shape_of, shapes_of, vectors_of
from .shapes import _made


@public
def rounded(shape, radius):
    """The shape grown by a radius: its Minkowski sum with a ball.

    Parameters
    ----------
    shape : Shape
    radius : float
        In the world's unit of length.

    Returns
    -------
    Shape
    """
    return _made("rounded", {"shape": [shape_of(shape, "shape")]}, radius=radius)


@public
def sum(*shapes):
    """The Minkowski sum: all sums of a point of each of the shapes.

    Parameters
    ----------
    *shapes : Shape
        Or one list of them.

    Returns
    -------
    Shape
    """
    return _made("minkowski_sum", {"shapes": shapes_of(shapes)})


@public
def difference(a, b):
    """The Minkowski difference of a and b, the configuration space obstacle.

    Parameters
    ----------
    a, b : Shape

    Returns
    -------
    Shape
    """
    return _made("minkowski_difference", {"a": [shape_of(a, "a")], "b": [shape_of(b, "b")]})


@public
def hull_of(*shapes):
    """The convex hull of shapes.

    Parameters
    ----------
    *shapes : Shape
        Or one list of them.

    Returns
    -------
    Shape
    """
    return _made("hull_of", {"shapes": shapes_of(shapes)})


def _transformed(shape, matrix, argument):
    try:
        return _made("transform", {"shape": [shape_of(shape, "shape")]}, map=matrix)
    except Error as error:
        raise Error(str(error).replace("map: must be invertible", f"{argument}: must be invertible")) from None


@public
def transformed(shape, matrix):
    """The shape under an invertible affine map.

    Parameters
    ----------
    shape : Shape
    matrix : (3, 4) or (4, 4) array
        Any invertible map; a fourth row must be (0, 0, 0, 1).

    Returns
    -------
    Shape
    """
    return _transformed(shape, given_pose_of(matrix, "matrix"), "matrix")


@public
def translated(shape, by):
    """The shape, translated.

    Parameters
    ----------
    shape : Shape
    by : (3,) array
        In the world's unit of length.

    Returns
    -------
    Shape
    """
    return _transformed(shape, np.column_stack([np.eye(3), vectors_of(by, "by", 3, 1)]), "by")


@public
def scaled(shape, by):
    """The shape, scaled by a number, or by a number per axis.

    Parameters
    ----------
    shape : Shape
    by : float or (3,) array
        One factor, or one per axis; not zero.

    Returns
    -------
    Shape
    """
    by = array_of(by, "by", "a number or three")
    if by.ndim > 0:
        by = vectors_of(by, "by", 3, 1)
    return _transformed(shape, np.column_stack([np.diag(np.ones(3) * by), np.zeros(3)]), "by")


@public
def swept(shape, way):
    """The volume swept by the shape along a straight line.

    Parameters
    ----------
    shape : Shape
    way : (3,) array
        Displacement, in the world's unit of length.

    Returns
    -------
    Shape
    """
    way = _made("segment", points=[np.zeros(3), vectors_of(way, "way", 3, 1)])
    return _made("minkowski_sum", {"shapes": [shape_of(shape, "shape"), way]})
