# SPDX-License-Identifier: MIT
"""Point clouds and pictures as files."""
import os
import re
import struct
import zlib

import numpy as np

from .calls import Error, array_of, name_of, public


def _check_columns(columns, count):
    """Checks names, which become words of the header, and that integers fit in 32 bits."""
    for name, values in columns.items():
        array_of(values, name)
        if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_.]*", name) or name in ("x", "y", "z"):
            raise Error(f"{name!r}: a column's name must be letters, digits, dots and underscores,"
                             " and not x, y or z")
        if np.shape(values) != (count,):
            raise Error(f"{name}: must be one number per point (got the shape {np.shape(values)})")
        values = np.asarray(values)
        if values.dtype.kind in "iu" and count and not (values.min() >= -2**31 and values.max() < 2**32):
            raise Error(f"{name}: must be numbers of 32 bits (got {values.min()} to {values.max()})")


@public
def write(file, points, **columns):
    """Writes a point cloud, or a picture.

    Parameters
    ----------
    file : str or path
        Ends in .pcd, .ply or .npy; pictures in .png (sRGB, clipped at 1), .pfm (linear) or .npy.
    points : (N, 3) array
        Points, or a picture of shape (height, width, 3): linear light, rows from the top.
    **columns : (N,) array
        More columns, such as ``object=hit.object``; as 32-bit floats and integers.

    Raises
    ------
    Error
        If the array has another shape, the file another ending, or a picture is empty or contains NaN.

    Examples
    --------
    >>> import minkray as mk, numpy as np, os, tempfile
    >>> file = os.path.join(tempfile.mkdtemp(), "two.pcd")
    >>> mk.write(file, np.zeros((2, 3)), object=[0, 1])
    """
    file = os.fsdecode(name_of(file))
    try:
        _write(file, points, columns)
    except OSError as error:
        raise Error(f"{file}: cannot be written: {error.strerror}") from None


def _write(file, points, columns):
    points = array_of(points, "points")
    if points.ndim == 3 and not columns:
        return _write_picture(file, points)
    if points.ndim != 2 or points.shape[1] != 3:
        raise Error(f"points: must have the shape (N, 3) (got {points.shape})")
    _check_columns(columns, len(points))
    fields = {"x": points[:, 0], "y": points[:, 1], "z": points[:, 2],
              **{name: np.asarray(values) for name, values in columns.items()}}
    ending = os.path.splitext(file)[1].lower()
    if ending not in (".pcd", ".ply", ".npy"):
        raise Error(f"{file}: must end in .pcd, .ply or .npy")
    dtype = [(name, "<f4" if values.dtype.kind == "f" else "<i4") for name, values in fields.items()]
    rows = np.empty(len(points), dtype)
    for name, values in fields.items():
        rows[name] = values
    if ending == ".npy":
        np.save(file, rows)
        return
    with open(file, "wb") as out:
        if ending == ".pcd":
            kinds = " ".join("F" if kind == "<f4" else "I" for _, kind in dtype)
            ones = " ".join("1" for _ in dtype)
            out.write((f"# .PCD v0.7\nVERSION 0.7\nFIELDS {' '.join(fields)}\n"
                       f"SIZE {' '.join('4' for _ in dtype)}\nTYPE {kinds}\nCOUNT {ones}\n"
                       f"WIDTH {len(rows)}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
                       f"POINTS {len(rows)}\nDATA binary\n").encode())
        else:
            properties = "".join(f"property {'float' if kind == '<f4' else 'int'} {name}\n"
                                 for name, kind in dtype)
            out.write((f"ply\nformat binary_little_endian 1.0\nelement vertex {len(rows)}\n"
                       f"{properties}end_header\n").encode())
        out.write(rows.tobytes())


def _write_picture(file, picture):
    if picture.shape[2] != 3:
        raise Error(f"points: a picture must have the shape (height, width, 3) (got {picture.shape})")
    height, width, _ = picture.shape
    if height == 0 or width == 0:
        raise Error(f"points: a picture must have at least one pixel (got the shape {picture.shape})")
    if np.isnan(picture).any():
        y, x, _ = np.argwhere(np.isnan(picture))[0]
        raise Error(f"points[{y}][{x}]: a picture must not hold NaN")
    ending = os.path.splitext(file)[1].lower()
    if ending == ".npy":
        np.save(file, picture.astype("<f4"))
    elif ending == ".pfm":
        with open(file, "wb") as out:
            out.write(f"PF\n{width} {height}\n-1.0\n".encode())
            out.write(picture[::-1].astype("<f4").tobytes())
    elif ending == ".png":
        light = np.clip(picture, 0, 1)
        shown = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
        rows = np.zeros((height, 1 + 3 * width), np.uint8)  # each row begins with its filter: none
        rows[:, 1:] = np.round(255 * shown).astype(np.uint8).reshape(height, 3 * width)

        def chunk(name, data):
            return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

        with open(file, "wb") as out:
            out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
                      + chunk(b"IDAT", zlib.compress(rows.tobytes())) + chunk(b"IEND", b""))
    else:
        raise Error(f"{file}: a picture must end in .png, .pfm or .npy")
