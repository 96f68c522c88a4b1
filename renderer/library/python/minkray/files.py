# SPDX-License-Identifier: MIT
"""Point clouds as files."""
import os

import numpy as np


def write(file, points, **columns):
    """Writes a point cloud.

    Parameters
    ----------
    file : str
        Ends in .pcd, .ply or .npy.
    points : (N, 3) array
    **columns : (N,) array
        More of each point, such as ``object=hit.object``.
    """
    points = np.asarray(points, float)
    if points.ndim != 2 or points.shape[1] != 3:
        raise ValueError(f"points: must have the shape (N, 3) (got {points.shape})")
    for name, values in columns.items():
        if len(values) != len(points):
            raise ValueError(f"{name}: must be one for each point (got {len(values)} of {len(points)})")
    fields = {"x": points[:, 0], "y": points[:, 1], "z": points[:, 2],
              **{name: np.asarray(values) for name, values in columns.items()}}
    ending = os.path.splitext(file)[1].lower()
    if ending not in (".pcd", ".ply", ".npy"):
        raise ValueError(f"{file}: must end in .pcd, .ply or .npy")
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
