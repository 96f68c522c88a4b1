# SPDX-License-Identifier: MIT
"""A picture of shapes made here, one of them by its support function, with depth and normals: picture.py [OUT.png]"""
import sys

import numpy as np

import minkray as mk


def double_cone(n):
    """A double cone: the hull of a circle and two tips."""
    rim = np.zeros_like(n)
    length = np.hypot(n[:, 0], n[:, 1])
    rim[:, :2] = n[:, :2] / np.where(length > 0, length, 1)[:, None]
    rim[length == 0] = [1, 0, 0]
    tips = np.column_stack([0 * n[:, :2], np.copysign(0.4, n[:, 2])])
    along = lambda p: np.einsum("ij,ij->i", p, n)
    return np.where((along(rim) > along(tips))[:, None], rim, tips)


scene = mk.Scene()
scene.add_half_space([0, 0, 1], -0.5, name="floor")
scene.add(mk.custom(double_cone), name="double cone")
scene.add(mk.rounded(mk.box([0.3, 0.3, 0.3]), 0.1), pose=[[1, 0, 0, 1.6], [0, 1, 0, 0.3], [0, 0, 1, -0.1]], name="box")
view = {"position": [-2, -4, 2], "look_at": [0.6, 0, 0], "fov_y_degrees": 35}
picture = scene.render(view, spp=4, aovs=["Z", "N", "id.object"], width=160, height=120)
if len(sys.argv) > 1:
    mk.write(sys.argv[1], picture["rgb"])
seen = {scene.names[i - 1]: int((picture["id.object"] == i).sum()) for i in np.unique(picture["id.object"]) if i > 0}
print("pixels of", seen, "nearest at", picture["Z"].min())
