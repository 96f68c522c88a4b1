# SPDX-License-Identifier: MIT
"""Rays cast at a scene, and pictures of it."""
import json

import numpy as np

from . import _minkray
from .answers import EXHAUSTED, HIT, AllHits, Hits, Proofs
from .calls import Error, array_of, list_of, public, text_of, whole_number_of
from .many_pairs import threads_of
from .rays import pinhole


def _public(function):
    return public(function, f"Scene.{function.__name__}")


_KEPT = (np.float64, np.float32)  # types of rays that need no copy


class RaysOfScene:
    """Casts at a `Scene`, and pictures."""

    @staticmethod
    def _rows(rays, t_max):
        rays = array_of(rays, "rays", keeps=_KEPT)
        if rays.ndim == 0 or rays.shape[-1] != 6:
            raise Error(f"rays: must have the shape (..., 6) (got {rays.shape})")
        if t_max is not None:
            t_max = array_of(t_max, "t_max", "a number, or one per ray", _KEPT)
            try:
                t_max = np.broadcast_to(t_max, rays.shape[:-1]).ravel() if t_max.ndim > 0 else t_max
            except ValueError:
                raise Error(f"t_max: must be a number, or one per ray (got the shape {t_max.shape} "
                            f"for rays of {rays.shape[:-1]})") from None
        rows = rays if rays.ndim == 2 else rays.reshape(-1, 6)
        return rows, t_max, rays.shape[:-1]

    @staticmethod
    def _shaped(fields, shape):
        return {name: values.reshape(shape + values.shape[1:]) if isinstance(values, np.ndarray)
                else values for name, values in fields.items()}

    @_public
    def cast_rays(self, rays, t_max=None, threads=0, *, jac=False, jac_error=False):
        """First hits of rays.

        Parameters
        ----------
        rays : (N, 6) or (..., 6) array
            Origin and direction (of any length except zero). Arrays of float64 and float32 are not copied.
        t_max : float or (...) array, optional
            Largest `t` of the ray. None: unlimited; 0: only the origin.
        threads : int
            0: one per core. Results are bit-identical for any number.
        jac : bool
            Add derivatives of `t`.
        jac_error : bool
            Add bounds of the derivatives' errors.

        Returns
        -------
        Hits
            Its arrays have the shape of the rays, without the last axis.

        Raises
        ------
        Error
            If the rays have another shape, a zero direction, or a number that is not finite; names
            the ray.

        Examples
        --------
        >>> import minkray as mk
        >>> scene = mk.Scene()
        >>> ball = scene.add(mk.sphere(1))
        >>> scene.cast_rays([[-4, 0, 0, 2, 0, 0], [-4, 3, 0, 2, 0, 0]]).t
        array([1.5, inf])
        """
        rows, ends, shape = self._rows(rays, t_max)
        found = self._ready().cast(rows, ends, threads_of(threads), bool(jac), bool(jac_error))
        fields = {name: found.pop(name) for name in ("t", "t_lo", "t_hi")}  # t is the first of all
        return Hits(self._shaped({**fields, **found}, shape))

    @_public
    def occluded(self, rays, t_max=None, threads=0):
        """True for rays that hit anything.

        Parameters
        ----------
        rays, t_max, threads
            As for `cast_rays`.

        Returns
        -------
        (...) array of bool

        Raises
        ------
        RuntimeError
            If the solver did not converge for a ray.
        """
        rows, t_max, shape = self._rows(rays, t_max)
        blocked = self._ready().occluded(rows, t_max, threads_of(threads))
        if (blocked == EXHAUSTED).any():
            raise RuntimeError(f"the solver did not converge at ray {int(np.argmax(blocked == EXHAUSTED))}")
        return (blocked == HIT).reshape(shape)

    @_public
    def exit(self, object, rays, t_max=None, threads=0):
        """Finds where rays last leave one object.

        Parameters
        ----------
        object : int
            Number of the object; not a half-space, which is unbounded.
        rays, t_max, threads
            As for `cast_rays`.

        Returns
        -------
        Hits
            HIT at the greatest t at which the ray is in the object, INSIDE if the ray ends in the object
            (at t_max), or MISS. Earlier exits from a mesh are not reported. An open mesh has no inside:
            the result is the last triangle that is hit. Normals point out of the object; normals of a
            mesh point along the ray.

        Examples
        --------
        >>> import minkray as mk
        >>> scene = mk.Scene()
        >>> ball = scene.add(mk.sphere(1))
        >>> scene.exit(ball, [[-4, 0, 0, 2, 0, 0], [0, 0, 0, 2, 0, 0]]).t
        array([2.5, 0.5])
        """
        rows, ends, shape = self._rows(rays, t_max)
        found = _minkray.scene_exit(self._ready(), whole_number_of(object, "object"), rows, ends,
                                    threads_of(threads))
        return Hits(self._shaped(found, shape))

    @_public
    def all_hits(self, rays, t_max=None, threads=0):
        """Finds all entries and exits of rays.

        Parameters
        ----------
        rays, t_max, threads
            As for `cast_rays`.

        Returns
        -------
        AllHits
            A ray that begins in an object has no entry into it; a ray that ends in an object has no exit.
            Entries and exits of a closed mesh without self-intersections alternate, even if the ray passes
            exactly through edges and vertices. A ray that only touches an edge or vertex either enters and
            leaves the mesh at the same t, or does not hit the mesh.

        Examples
        --------
        >>> import minkray as mk
        >>> scene = mk.Scene()
        >>> ball = scene.add(mk.sphere(1))
        >>> found = scene.all_hits([[-4, 0, 0, 2, 0, 0], [0, 0, 0, 2, 0, 0]])
        >>> found.t, found.leaves, found.offsets
        (array([1.5, 2.5, 0.5]), array([False,  True,  True]), array([0, 2, 3]))
        """
        rows, ends, shape = self._rows(rays, t_max)
        found = _minkray.scene_all_hits(self._ready(), rows, ends, threads_of(threads))
        found["ray"] = np.repeat(np.arange(len(rows)), np.diff(found["offsets"]))
        found["status"] = found["status"].reshape(shape)
        return AllHits(found)

    @_public
    def certify(self, rays, hits=None, t_max=None, threads=0):
        """Casts rays and proves the results for all objects, using only planes and support points.

        Parameters
        ----------
        rays : (N, 6) or (..., 6) array
            As for `cast_rays`.
        hits : Hits, optional
            Results of `cast_rays` for the same rays and t_max. The proof of a result that differs
            from a new cast fails.
        t_max : float or (...) array, optional
            As for `cast_rays`.
        threads : int

        Returns
        -------
        Proofs
        """
        rows, ends, shape = self._rows(rays, t_max)
        proofs = Proofs(self._shaped(self._ready().certify(rows, ends, threads_of(threads)), shape))
        if hits is not None:
            if not isinstance(hits, Hits) or np.shape(hits.t) != shape:
                raise Error(f"hits: must be the Hits of these rays, of the shape {shape}")
            met = self.cast_rays(rays, t_max, threads)
            differs = (met.t != hits.t) | (met.object != hits.object) | (met.status != hits.status)
            proofs.holds[...] &= ~differs
            for i in np.flatnonzero(differs):
                proofs.complaint[i] = "the result differs from a new cast"
        return proofs

    @_public
    def depth(self, K, pose, width, height, threads=0):
        """A depth image of a pinhole camera.

        Parameters
        ----------
        K, pose, width, height
            As for `minkray.pinhole`.
        threads : int

        Returns
        -------
        depth : (height, width) array of float64
            Along the camera's z axis; inf for a miss, NaN if the solver did not converge.
        object : (height, width) array of uint32
            NO_OBJECT for a miss.
        """
        hits = self.cast_rays(pinhole(K, pose, width, height), threads=threads)
        return np.where(hits.status == EXHAUSTED, np.nan, hits.t), hits.object

    @_public
    def render(self, camera=None, spp=16, bounces=None, aovs=(), *, lights=None, background=None,
               width=0, height=0, integrator="auto", max_depth=None, denoise=False, seed=0, threads=0):
        """Renders a picture.

        Parameters
        ----------
        camera : dict, optional
            As in scene files: ``{"position": [0, -5, 2], "look_at": [0, 0, 0]}``. None: the camera of
            the first scene file that has one, or else a camera that shows all objects.
        spp : int
            Samples per pixel.
        bounces : int, optional
            Diffuse bounces of the integrator 'ambient' (default 1).
        aovs : list of str
            More channels: 'Z', 'N', 'P', 'dist', 'id.object', 'albedo' and all others of ``minkray
            render --help``, except 'cryptomatte'.
        lights : list of dict, optional
            As in scene files; None: the lights of the scene files, or a sun and a sky.
        background : list or dict, optional
            As in scene files; None: the background of the scene files.
        width, height : int
            In pixels; 0 for the camera's.
        integrator : {'auto', 'path', 'direct', 'ambient', 'normals'}
        max_depth : int, optional
            Largest number of bounces of the integrator 'path' (default 16).
        denoise : bool
        seed : int
        threads : int
            0: one per core. The picture is bit-identical for any number.

        Returns
        -------
        dict of str to array
            'rgb' (linear, float32, (height, width, 3)) and each of the aovs (float32 or uint32,
            (height, width) or (height, width, 2 or 3)). Rows from the top.

        Examples
        --------
        >>> import minkray as mk
        >>> scene = mk.Scene()
        >>> ball = scene.add(mk.sphere(1))
        >>> view = {"position": [0, -5, 2], "look_at": [0, 0, 0]}
        >>> picture = scene.render(view, spp=1, aovs=["N"], width=32, height=24)
        >>> picture["rgb"].shape, picture["N"].dtype
        ((24, 32, 3), dtype('float32'))
        """
        view = {name: value for name, value in
                (("camera", camera), ("lights", lights), ("background", background))
                if value is not None}

        def plain(value):
            if hasattr(value, "tolist"):
                return value.tolist()
            raise Error(f"camera, lights, background: cannot hold a {type(value).__name__}")

        def often(number, name):
            return 0 if number is None else whole_number_of(number, name, 1000) or -1

        names = ["rgb", *(text_of(name, f"aovs[{i}]") for i, name in enumerate(list_of(aovs, "aovs", "names")))]
        return _minkray.render(self._ready(), json.dumps(view, default=plain) if view else "",
                               whole_number_of(width, "width"), whole_number_of(height, "height"),
                               whole_number_of(spp, "spp"), whole_number_of(seed, "seed", 2**64 - 1),
                               text_of(integrator, "integrator"), often(bounces, "bounces"),
                               often(max_depth, "max_depth"), bool(denoise), names, threads_of(threads))
