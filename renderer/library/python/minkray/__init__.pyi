# SPDX-License-Identifier: MIT
# What is public, with types; docs are in the modules themselves.
import enum
import os
from math import inf
from typing import Any, Callable, Iterable, Iterator, Literal, Mapping, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from ._minkray import Error as Error, Shape as Shape
from .shapes import *

_Floats = npt.NDArray[np.float64]
_Numbers = npt.NDArray[np.uint32]
_Bools = npt.NDArray[np.bool_]
_Codes = Any  # an array of uint8, or a member of the enum for one result
_Path = Union[str, "os.PathLike[str]"]
_Geometry = Literal["visual", "collision", "all"]

__version__: str

class Status(enum.IntEnum):
    HIT = 0
    MISS = 1
    INSIDE = 2
    EXHAUSTED = 3

class DistanceStatus(enum.IntEnum):
    SEPARATED = 0
    TOUCHING = 1
    OVERLAPPING = 2
    UNDECIDED = 3

class ImpactStatus(enum.IntEnum):
    IMPACT = 0
    NO_IMPACT = 1
    BEGINS_INSIDE = 2
    UNDECIDED = 3

HIT: Status
MISS: Status
INSIDE: Status
EXHAUSTED: Status
NO_OBJECT: int
SEPARATED: DistanceStatus
TOUCHING: DistanceStatus
OVERLAPPING: DistanceStatus
UNDECIDED: DistanceStatus
IMPACT: ImpactStatus
NO_IMPACT: ImpactStatus
BEGINS_INSIDE: ImpactStatus
IMPACT_UNDECIDED: ImpactStatus

_Shapes = Union[Shape, Sequence[Any], npt.NDArray[Any]]
_Poses = Union[npt.ArrayLike, Sequence[Any], None]

def rounded(shape: Shape, radius: float) -> Shape: ...
def sum(*shapes: Union[Shape, Sequence[Shape]]) -> Shape: ...
def difference(a: Shape, b: Shape) -> Shape: ...
def hull_of(*shapes: Union[Shape, Sequence[Shape]]) -> Shape: ...
def transformed(shape: Shape, matrix: npt.ArrayLike) -> Shape: ...
def translated(shape: Shape, by: npt.ArrayLike) -> Shape: ...
def scaled(shape: Shape, by: npt.ArrayLike) -> Shape: ...
def swept(shape: Shape, way: npt.ArrayLike) -> Shape: ...
def mesh(vertices: npt.ArrayLike, triangles: npt.ArrayLike) -> Shape: ...
def height_field(heights: npt.ArrayLike, size: npt.ArrayLike, bottom: Optional[float] = None) -> Shape: ...
def mesh_info(mesh: Shape) -> dict[str, int]: ...
def compound(shapes: Sequence[Shape], poses: _Poses = None) -> Shape: ...
def compound_parts(compound: Shape) -> tuple[list[Shape], _Floats]: ...

class Hits:
    t: _Floats
    distance: _Floats
    t_lo: _Floats
    t_hi: _Floats
    point: _Floats
    normal: _Floats
    object: _Numbers
    status: _Codes
    supports: npt.NDArray[np.int32]
    part: npt.NDArray[np.int32]
    jac_ray: _Floats
    jac_body: _Floats
    is_ridge: _Bools
    jac_error_ray: _Floats
    jac_error_body: _Floats
    def __getitem__(self, key: Any) -> Hits: ...
    def __iter__(self) -> Iterator[Hits]: ...
    def __len__(self) -> int: ...

class AllHits:
    t: _Floats
    t_lo: _Floats
    t_hi: _Floats
    point: _Floats
    normal: _Floats
    object: _Numbers
    part: npt.NDArray[np.int32]
    leaves: _Bools
    ray: npt.NDArray[np.int64]
    offsets: npt.NDArray[np.int64]
    status: _Codes

class Proofs:
    holds: npt.NDArray[np.bool_]
    t_lo: _Floats
    t_hi: _Floats
    allowed: _Floats
    plane: _Floats
    checked: _Numbers
    complaint: list[str]
    def __getitem__(self, key: Any) -> Proofs: ...
    def __iter__(self) -> Iterator[Proofs]: ...
    def __len__(self) -> int: ...

class Clearance:
    lower: _Floats
    upper: _Floats
    row: _Floats
    object_a: _Numbers
    object_b: _Numbers
    point_a: _Floats
    point_b: _Floats
    normal: _Floats
    jac: _Floats
    jac_error: _Floats
    is_ridge: _Bools
    def __getitem__(self, key: Any) -> Clearance: ...
    def __iter__(self) -> Iterator[Clearance]: ...
    def __len__(self) -> int: ...

class MotionStatus(enum.IntEnum):
    FREE = 0
    COLLIDES = 1
    UNDECIDED = 2

class Verdict:
    status: MotionStatus
    lower: float
    upper: float
    row: float
    begin: float
    end: float
    object_a: int
    object_b: int
    point: _Floats
    def __bool__(self) -> bool: ...

class Robot:
    objects: range
    @property
    def joint_names(self) -> list[str]: ...
    @property
    def joints(self) -> Any: ...
    @joints.setter
    def joints(self, values: Union[Mapping[str, npt.ArrayLike], Iterable[npt.ArrayLike]]) -> None: ...
    def set_pose(self, pose: npt.ArrayLike) -> None: ...

class Scene:
    def __init__(self) -> None: ...
    def __len__(self) -> int: ...
    def add(self, shape: Shape, pose: Optional[npt.ArrayLike] = None, name: Optional[str] = None) -> int: ...
    def add_half_space(self, normal: npt.ArrayLike, offset: float = 0.0, name: Optional[str] = None) -> int: ...
    def add_file(self, file: _Path, pose: Optional[npt.ArrayLike] = None, geometry: _Geometry = "visual", keyframe: str = "", package_dirs: Sequence[_Path] = (), skip_missing_meshes: bool = False, meshes: Literal["", "exact", "hull"] = "") -> Robot: ...
    def add_json(self, file: _Path, pose: Optional[npt.ArrayLike] = None) -> Robot: ...
    def add_urdf(self, file: _Path, pose: Optional[npt.ArrayLike] = None, geometry: _Geometry = "visual", package_dirs: Sequence[_Path] = (), skip_missing_meshes: bool = False, meshes: Literal["", "exact", "hull"] = "") -> Robot: ...
    def add_mjcf(self, file: _Path, pose: Optional[npt.ArrayLike] = None, geometry: _Geometry = "visual", keyframe: str = "", skip_missing_meshes: bool = False, meshes: Literal["", "exact", "hull"] = "") -> Robot: ...
    def add_sdf(self, file: _Path, pose: Optional[npt.ArrayLike] = None, geometry: _Geometry = "visual", package_dirs: Sequence[_Path] = (), skip_missing_meshes: bool = False, meshes: Literal["", "exact", "hull"] = "") -> Robot: ...
    def add_gltf(self, file: _Path, pose: Optional[npt.ArrayLike] = None) -> Robot: ...
    def set_pose(self, object: int, pose: npt.ArrayLike) -> None: ...
    def pose(self, object: int) -> _Floats: ...
    def remove(self, object: int) -> None: ...
    @property
    def names(self) -> Any: ...
    def commit(self) -> None: ...
    def cast_rays(self, rays: npt.ArrayLike, t_max: Optional[npt.ArrayLike] = None, threads: int = 0, *, jac: bool = False, jac_error: bool = False) -> Hits: ...
    def occluded(self, rays: npt.ArrayLike, t_max: Optional[npt.ArrayLike] = None, threads: int = 0) -> npt.NDArray[np.bool_]: ...
    def exit(self, object: int, rays: npt.ArrayLike, t_max: Optional[npt.ArrayLike] = None, threads: int = 0) -> Hits: ...
    def all_hits(self, rays: npt.ArrayLike, t_max: Optional[npt.ArrayLike] = None, threads: int = 0) -> AllHits: ...
    def certify(self, rays: npt.ArrayLike, hits: Optional[Hits] = None, t_max: Optional[npt.ArrayLike] = None, threads: int = 0) -> Proofs: ...
    def depth(self, K: npt.ArrayLike, pose: Optional[npt.ArrayLike], width: int, height: int, threads: int = 0) -> tuple[_Floats, _Numbers]: ...
    def set_masks(self, object: int, category: int = 1, mask: int = 4294967295) -> None: ...
    def allow(self, i: int, j: int, allowed: bool = True) -> None: ...
    def allow_from_srdf(self, robot: Robot, file: _Path) -> None: ...
    def distances(self, pairs: Optional[npt.ArrayLike] = None, within: Optional[float] = None, *, tolerance: float = 1e-10, jac: bool = False, jac_error: bool = False, threads: int = 0, progress: Optional[Callable[[float], Any]] = None) -> ScenePairs: ...
    def nearest(self, points: npt.ArrayLike, k: int = 1, *, within: float = inf, mask: int = 4294967295, jac: bool = False, jac_error: bool = False, threads: int = 0, progress: Optional[Callable[[float], Any]] = None) -> Nearest: ...
    def distance_to(self, shape: _Shapes, poses: _Poses, within: float = inf, *, mask: int = 4294967295, jac: bool = False, jac_error: bool = False, threads: int = 0, progress: Optional[Callable[[float], Any]] = None) -> Nearest: ...
    def time_of_impact(self, shape: _Shapes, poses: _Poses, twists: Optional[npt.ArrayLike], t_max: npt.ArrayLike = 1.0, *, mask: int = 4294967295, jac: bool = False, jac_error: bool = False, threads: int = 0, progress: Optional[Callable[[float], Any]] = None) -> SceneImpacts: ...
    def manifold(self, i: int, j: int) -> Manifold: ...
    def render(self, camera: Optional[Mapping[str, Any]] = None, spp: int = 16, bounces: Optional[int] = None, aovs: Sequence[str] = (), *, lights: Optional[Sequence[Mapping[str, Any]]] = None, background: Any = None, width: int = 0, height: int = 0, integrator: Literal["auto", "path", "direct", "ambient", "normals"] = "auto", max_depth: Optional[int] = None, denoise: bool = False, seed: int = 0, threads: int = 0) -> dict[str, npt.NDArray[Any]]: ...
    def clearance(self, robot: Robot, path: npt.ArrayLike, tolerance: float = 0.01, only_obstacles: bool = False, threads: int = 0, *, jac: bool = False, jac_error: bool = False) -> Clearance: ...
    def verify(self, robot: Robot, path: npt.ArrayLike, rates: Optional[npt.ArrayLike] = None, margin: float = 0.0, tolerance: float = 0.01, only_obstacles: bool = False, threads: int = 0, *, budget: int = 4000, accelerations: Optional[npt.ArrayLike] = None, proof: Optional[_Path] = None, times: Optional[npt.ArrayLike] = None) -> Verdict: ...

class Distances:
    value: _Floats
    lower: _Floats
    upper: _Floats
    normal: _Floats
    point_a: _Floats
    point_b: _Floats
    status: _Codes
    supports: npt.NDArray[np.int32]
    jac_a: _Floats
    jac_b: _Floats
    is_ridge: _Bools
    jac_error_a: _Floats
    jac_error_b: _Floats
    def __getitem__(self, key: Any) -> Distances: ...
    def __iter__(self) -> Iterator[Distances]: ...
    def __len__(self) -> int: ...

class Impacts:
    t_lo: _Floats
    t_hi: _Floats
    normal: _Floats
    point_a: _Floats
    point_b: _Floats
    distance: _Floats
    status: _Codes
    jac_a: _Floats
    jac_b: _Floats
    is_ridge: _Bools
    jac_error_a: _Floats
    jac_error_b: _Floats
    def __getitem__(self, key: Any) -> Impacts: ...
    def __iter__(self) -> Iterator[Impacts]: ...
    def __len__(self) -> int: ...

class Manifolds:
    count: npt.NDArray[np.int32]
    normal: _Floats
    points: _Floats
    points_a: _Floats
    points_b: _Floats
    gaps: _Floats
    value: _Floats
    lower: _Floats
    upper: _Floats
    status: _Codes
    def __getitem__(self, key: Any) -> Manifolds: ...
    def __iter__(self) -> Iterator[Manifolds]: ...
    def __len__(self) -> int: ...

class Manifold:
    count: Any
    normal: _Floats
    points: _Floats
    points_a: _Floats
    points_b: _Floats
    gaps: _Floats
    value: Any
    lower: Any
    upper: Any
    status: Any
    def __getitem__(self, key: Any) -> Manifold: ...
    def __iter__(self) -> Iterator[Manifold]: ...
    def __len__(self) -> int: ...

class ScenePairs:
    object_a: _Numbers
    object_b: _Numbers
    value: _Floats
    lower: _Floats
    upper: _Floats
    normal: _Floats
    point_a: _Floats
    point_b: _Floats
    status: _Codes
    jac_a: _Floats
    jac_b: _Floats
    is_ridge: _Bools
    jac_error_a: _Floats
    jac_error_b: _Floats
    def __getitem__(self, key: Any) -> ScenePairs: ...
    def __iter__(self) -> Iterator[ScenePairs]: ...
    def __len__(self) -> int: ...

class Nearest:
    object: _Numbers
    value: _Floats
    lower: _Floats
    upper: _Floats
    normal: _Floats
    point_a: _Floats
    point_b: _Floats
    status: _Codes
    jac: _Floats
    is_ridge: _Bools
    jac_error: _Floats
    def __getitem__(self, key: Any) -> Nearest: ...
    def __iter__(self) -> Iterator[Nearest]: ...
    def __len__(self) -> int: ...

class SceneImpacts:
    object: _Numbers
    t_lo: _Floats
    t_hi: _Floats
    normal: _Floats
    point_a: _Floats
    point_b: _Floats
    distance: _Floats
    status: _Codes
    jac: _Floats
    is_ridge: _Bools
    jac_error: _Floats
    def __getitem__(self, key: Any) -> SceneImpacts: ...
    def __iter__(self) -> Iterator[SceneImpacts]: ...
    def __len__(self) -> int: ...

class Distance:
    value: Any
    lower: Any
    upper: Any
    point_a: _Floats
    point_b: _Floats
    normal: _Floats
    status: _Codes
    def __getitem__(self, key: Any) -> Distance: ...
    def __iter__(self) -> Iterator[Distance]: ...
    def __len__(self) -> int: ...

class Impact:
    t_lo: Any
    t_hi: Any
    distance: Any
    point_a: _Floats
    point_b: _Floats
    normal: _Floats
    status: _Codes
    def __getitem__(self, key: Any) -> Impact: ...
    def __iter__(self) -> Iterator[Impact]: ...
    def __len__(self) -> int: ...

def signed_distance(a: _Shapes, pose_a: _Poses, b: _Shapes, pose_b: _Poses, tolerance: float = 1e-10) -> Distance: ...
def time_of_impact(a: _Shapes, pose_a: _Poses, twist_a: Optional[npt.ArrayLike], b: _Shapes, pose_b: _Poses, twist_b: Optional[npt.ArrayLike], t_max: npt.ArrayLike = 1.0) -> Impact: ...
def pair_memory(shape: Union[int, tuple[int, ...]]) -> _Floats: ...
def signed_distances(a: _Shapes, pose_a: _Poses, b: _Shapes, pose_b: _Poses, *, jac: bool = False, jac_error: bool = False, tolerance: float = 1e-10, memory: Optional[_Floats] = None, threads: int = 0, out: Union[Distances, dict[str, npt.NDArray[Any]], None] = None, progress: Optional[Callable[[float], Any]] = None) -> Distances: ...
def times_of_impact(a: _Shapes, pose_a: _Poses, twist_a: Optional[npt.ArrayLike], b: _Shapes, pose_b: _Poses, twist_b: Optional[npt.ArrayLike], t_max: npt.ArrayLike = 1.0, *, jac: bool = False, jac_error: bool = False, memory: Optional[_Floats] = None, threads: int = 0, out: Union[Impacts, dict[str, npt.NDArray[Any]], None] = None, progress: Optional[Callable[[float], Any]] = None) -> Impacts: ...
def manifolds(a: _Shapes, pose_a: _Poses, b: _Shapes, pose_b: _Poses, *, tolerance: float = 1e-10, memory: Optional[_Floats] = None, threads: int = 0, out: Union[Manifolds, dict[str, npt.NDArray[Any]], None] = None, progress: Optional[Callable[[float], Any]] = None) -> Manifolds: ...
def camera(calibration: dict[str, Any], pose: Optional[npt.ArrayLike] = None) -> _Floats: ...
def lidar(pattern: Union[_Path, tuple[float, ...], list[float]], pose: Optional[npt.ArrayLike] = None) -> _Floats: ...
def pinhole(K: npt.ArrayLike, pose: Optional[npt.ArrayLike], width: int, height: int) -> _Floats: ...
def write(file: _Path, points: npt.ArrayLike, **columns: npt.ArrayLike) -> None: ...
