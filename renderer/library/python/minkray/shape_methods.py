# SPDX-License-Identifier: MIT
"""Methods of the class `Shape`, which the extension module has."""
from . import _minkray
from .calls import Error, Shape, public, shape_of, vectors_of
from .meshes import compound, mesh
from .shapes import read_shape


def _init(self, *arguments, **named):
    """Raises an Error: shapes are made by functions such as `minkray.box`."""
    raise Error("Shape: must be made by functions such as minkray.box")


def support(self, directions):
    """Points of the shape furthest along directions.

    Parameters
    ----------
    directions : (N, 3) array
        Of any length.

    Returns
    -------
    (N, 3) array
    """
    return shape_of(self, "self")._support(vectors_of(directions, "directions", 3, 2))


def bounds(self):
    """Lower and upper corner of the bounding box, of shape (2, 3)."""
    return shape_of(self, "self")._bounds()


def json(self):
    """The shape as JSON, as in scene files."""
    return shape_of(self, "self")._json()


def kind(self):
    """str : such as 'rounded'."""
    return shape_of(self, "self")._kind()


def reduce(self):
    """For pickle."""
    if self.kind == "mesh":
        return mesh, _minkray.mesh_arrays(self)
    if self.kind == "compound":
        return compound, _minkray.compound_parts(self)
    return read_shape, (self.json(),)


setattr(Shape, "__init__", _init)
setattr(Shape, "support", public(support, "Shape.support"))
setattr(Shape, "bounds", public(bounds, "Shape.bounds"))
setattr(Shape, "json", public(json, "Shape.json"))
setattr(Shape, "kind", property(public(kind, "Shape.kind")))
setattr(Shape, "__reduce__", public(reduce, "Shape.__reduce__"))
setattr(Shape, "__copy__", lambda self: self)
setattr(Shape, "__deepcopy__", lambda self, memo: self)
del support, bounds, json, kind, reduce
