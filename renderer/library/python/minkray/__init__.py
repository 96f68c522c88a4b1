# SPDX-License-Identifier: MIT
"""Rays, proofs and distances of exact convex shapes.

>>> import minkray as mk
>>> scene = mk.Scene()
>>> scene.add(mk.rounded(mk.box([0.5, 0.2, 0.1]), 0.05), name="bumper")
0
>>> hit = scene.cast_rays([[-9, 0, 0, 1, 0, 0]])
>>> float(hit.t[0]), scene.names[hit.object[0]]
(8.45, 'bumper')

Points, directions and poses are in the world's frame and unit of length. Arrays are float64; others
are converted. Wrong arguments raise `minkray.Error`, a `ValueError`.
"""
from . import _minkray
from ._minkray import Error, Shape
from .answers import (EXHAUSTED, HIT, INSIDE, MISS, NO_OBJECT, AllHits, Clearance, Hits, MotionStatus, Proofs,
                      Status, Verdict)
from .robots import Robot
from .scene import Scene
from .rays import camera, lidar, pinhole
from .meshes import compound, compound_parts, height_field, mesh, mesh_info
from .shapes import *
from . import shape_methods as _shape_methods
from .shapes_of_shapes import difference, hull_of, rounded, scaled, sum, swept, transformed, translated
from .pairs import (BEGINS_INSIDE, IMPACT, IMPACT_UNDECIDED, NO_IMPACT, OVERLAPPING, SEPARATED, TOUCHING, UNDECIDED,
                    Distance, DistanceStatus, Impact, ImpactStatus, signed_distance, time_of_impact)
from .many_pairs import (Distances, Impacts, Manifolds, manifolds, pair_memory, signed_distances,
                         times_of_impact)
from .scene_pairs import Manifold, Nearest, SceneImpacts, ScenePairs
from .files import write

__version__ = _minkray.version
__all__ = [name for name in dir() if not name.startswith("_")]
