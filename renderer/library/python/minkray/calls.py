# SPDX-License-Identifier: MIT
"""Arguments, checked before they are used, and errors that name the function that was called."""
import functools
import inspect
import operator
import os
import re
from typing import Any, Callable, Optional, TypeVar, cast

import numpy as np

from ._minkray import Error, Shape


Function = TypeVar("Function", bound=Callable[..., Any])


def _called(function, name, arguments, named):
    """The error of a call's arguments, or None."""
    try:
        signature = inspect.signature(function)
    except ValueError:  # of what is not written in Python
        return None
    try:
        signature.bind(*arguments, **named)
    except TypeError as error:
        plain = [one.replace(annotation=one.empty) for one in signature.parameters.values() if one.name != "self"]
        shown = inspect.Signature(plain)
        return f"must be called as {name.split('.')[-1]}{shown} ({error})"
    return None


# Members of options structs in C that are arguments in Python. All else after "options." may be part
# of a file's name.
_OPTIONS = ("accelerations|at_most|bounces|budget|geometry|height|integrator|keyframe|margin|max_depth|meshes|"
            "package_dirs|pose|samples|threads|times|tolerance|view|width|within")


def without_options(text):
    """A message of the C interface that names arguments instead of members of options."""
    return re.sub(rf"(^|(?<=, ))options\.(?=({_OPTIONS})\b)", "", text)


def _plain(text):
    """A message, without the names of the C function and of the kind of shape."""
    found = re.match(r"minkray(_\w+|::[\w:]+): ", text)
    if not found:
        return text
    text = text[found.end():]
    if found[1] in ("_shape_make", "_shape_read", "_camera_rays"):  # whose arguments are JSON
        text = re.sub(r"(?m)^\w+: /(?=\w)", "", text)
    return without_options(re.sub(r"(?m)^options\.view: /(?=\w)", "", text))


def public(function: Function, name: Optional[str] = None) -> Function:
    """Wraps a function: wrong calls raise an `Error` that begins with its name."""
    name = name or function.__qualname__

    def failed(detail):
        error = Error(f"{name}: {detail}")
        setattr(error, "detail", detail)
        return error

    @functools.wraps(function)
    def call(*arguments, **named):
        try:
            return function(*arguments, **named)
        except Error as error:
            raise failed(getattr(error, "detail", None) or _plain(str(error))) from None
        except (TypeError, ValueError, OverflowError, AttributeError) as error:
            detail = _called(function, name, arguments, named)
            if not detail and "incompatible function arguments" in str(error):
                kinds = ", ".join(type(one).__name__ for one in (*arguments, *named.values()))
                detail = f"an argument has a type that it cannot have (got {kinds})"
            raise failed(detail or str(error)) from (None if detail else error)

    return cast(Function, call)


def shape_of(value, argument):
    """The value, which must be a shape."""
    if not isinstance(value, Shape):
        raise Error(f"{argument}: must be a Shape (got {type(value).__name__})")
    return value


def shapes_of(values, argument="shapes"):
    """A list of shapes: of several arguments, or of one that is a list."""
    if len(values) == 1 and isinstance(values[0], (list, tuple, np.ndarray)):
        values = list(values[0])
    if not len(values):
        raise Error(f"{argument}: must be at least one Shape")
    return [shape_of(value, f"{argument}[{i}]") for i, value in enumerate(values)]


def list_of(value, argument, of):
    """A list of the values, which must not be a text."""
    if isinstance(value, (str, bytes)) or not hasattr(value, "__iter__"):
        raise Error(f"{argument}: must be a list of {of} (got {value!r})")
    return list(value)


def text_of(value, argument):
    """The value, which must be text without zero bytes."""
    if not isinstance(value, str):
        raise Error(f"{argument}: must be a str (got {type(value).__name__})")
    try:
        value.encode()
    except UnicodeEncodeError:
        raise Error(f"{argument}: must be text that UTF-8 can hold (got {value!r})") from None
    if "\0" in value:
        raise Error(f"{argument}: must have no zero character (got {value!r})")
    return value


def name_of(file, argument="file"):
    """The file's name in the system's encoding, without zero bytes."""
    try:
        name = os.fsencode(file)
    except (TypeError, UnicodeEncodeError):
        raise Error(f"{argument}: must be the name of a file (got {file!r})") from None
    if b"\0" in name:
        raise Error(f"{argument}: must have no zero byte (got {file!r})")
    return name


def whole_number_of(value, argument, most=2**32 - 1):
    """The value, which must be a whole number from 0 on."""
    try:
        number = operator.index(value)
    except TypeError:
        raise Error(f"{argument}: must be a whole number (got {value!r})") from None
    if not 0 <= number <= most:
        raise Error(f"{argument}: must be from 0 to {most} (got {number})")
    return number


def array_of(value, argument, must_be="an array of numbers", keeps=(np.float64,)):
    """The value as an array of doubles, or of another kept type, if it is one of plain numbers."""
    parts = value if isinstance(value, (list, tuple)) else (value,)
    if any(isinstance(part, np.ma.MaskedArray) for part in parts):
        raise Error(f"{argument}: must not be a masked array: fill it first")
    try:
        array = np.asarray(value)
        if array.dtype.kind == "O":  # None would become NaN
            array = np.array([float(one) for one in array.ravel()]).reshape(array.shape)
    except (TypeError, ValueError, OverflowError):
        raise Error(f"{argument}: must be {must_be} (got {type(value).__name__})") from None
    if array.dtype.kind not in "fiub":
        raise Error(f"{argument}: must be {must_be} (got values of {array.dtype})")
    return array if array.dtype in keeps else array.astype(float)


def number_of(value, argument):
    """The value as a float."""
    array = array_of(value, argument, "a number")
    if array.ndim > 0:
        raise Error(f"{argument}: must be a number (got the shape {array.shape})")
    return float(array)


def vectors_of(value, argument, width, ndim=None):
    """Finite numbers in rows of `width`: of the shape (..., width), or with `ndim` axes."""
    array = array_of(value, argument)
    if array.ndim == 0 or array.shape[-1] != width or (ndim is not None and array.ndim != ndim):
        shape = {None: f"(..., {width})", 1: f"({width},)", 2: f"(N, {width})"}[ndim]
        raise Error(f"{argument}: must have the shape {shape} (got {array.shape})")
    if not np.isfinite(array).all():
        at = np.argwhere(~np.isfinite(array))[0]
        place = "".join(f"[{i}]" for i in at)
        raise Error(f"{argument}{place}: must be a finite number (got {array[tuple(at)]})")
    return array


_LAST_ROW = np.array([0.0, 0, 0, 1])
_MATRIX, _QUATERNION, _MATRIX_4X4 = range(3)


def poses_array(value, argument):
    """Returns the poses as given, the number of axes of one pose, and their kind."""
    if value is None:
        return np.eye(4)[:3], 2, _MATRIX
    if isinstance(value, (list, tuple)) and any(one is None for one in value):
        value = [np.eye(4) if one is None else one for one in value]
    array = array_of(value, argument, "a (4, 4) matrix, or x, y, z, qw, qx, qy, qz")
    if array.ndim >= 2 and array.shape[-2:] == (4, 4):
        return array, 2, _MATRIX_4X4
    if array.ndim >= 2 and array.shape[-2:] == (3, 4):
        return array, 2, _MATRIX
    if array.ndim >= 1 and array.shape[-1] == 7:
        return array, 1, _QUATERNION
    raise Error(f"{argument}: must be a (4, 4) matrix, or one of the shape (3, 4), or x, y, z, qw, qx, qy, qz "
                f"(got the shape {array.shape})")


def _of_quaternions(array, argument):
    """Matrices (..., 3, 4) of poses (..., 7)."""
    array = vectors_of(array, argument, 7)
    largest = np.abs(array[..., 3:]).max(-1, keepdims=True)
    if not (largest > 0).all():
        raise Error(f"{argument}: must have a quaternion that is not zero")
    q = array[..., 3:] / largest
    w, x, y, z = np.moveaxis(q / np.linalg.norm(q, axis=-1, keepdims=True), -1, 0)
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), array[..., 0]],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), array[..., 1]],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), array[..., 2]]]
    return np.stack([np.stack(row, -1) for row in rows], -2)


def poses_of(value, argument):
    """Matrices (..., 3, 4) of poses of any kind; the identity for None."""
    array, _, kind = poses_array(value, argument)
    if kind == _QUATERNION:
        return _of_quaternions(array, argument)
    if kind == _MATRIX_4X4 and not (array[..., 3, :] == _LAST_ROW).all():
        raise Error(f"{argument}: the last row must be (0, 0, 0, 1)")
    return array[..., :3, :]


def pose_of(value, argument="pose"):
    """One such matrix, or None."""
    poses = None if value is None else poses_of(value, argument)
    if poses is not None and poses.ndim != 2:
        raise Error(f"{argument}: must be one pose (got the shape {np.shape(value)})")
    return poses


def given_pose_of(value, argument="pose"):
    """One such matrix, which must be there."""
    if value is None:
        raise Error(f"{argument}: must be a (4, 4) matrix (got None)")
    return pose_of(value, argument)


def shapes_array(value, argument):
    """Shapes, as an array of them of any number of axes."""
    if isinstance(value, Shape):
        array = np.empty((), object)
        array[()] = value
        return array
    if not isinstance(value, (list, tuple, np.ndarray)):
        shape_of(value, argument)
    if all(isinstance(one, Shape) for one in value):
        array = np.empty(len(value), object)
        array[:] = value
        return array
    rows = [shapes_array(one, f"{argument}[{i}]") for i, one in enumerate(value)]
    if any(row.shape != rows[0].shape for row in rows):
        raise Error(f"{argument}: must be a Shape, or nested lists of equal lengths")
    return np.stack(rows)
