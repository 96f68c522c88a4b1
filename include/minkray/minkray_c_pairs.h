/* SPDX-License-Identifier: MIT Many pairs of shapes at once, and the pairs of a scene: distances
 * with their derivatives, contact points, times of impact. docs/c.md has examples. The rules of
 * minkray_c.h for errors, threads and units hold here, too. */
#ifndef MINKRAY_MINKRAY_C_PAIRS_H
#define MINKRAY_MINKRAY_C_PAIRS_H

/* All poses are rigid: a rotation or a reflection, and a translation. The linear part may deviate
 * from this by 1e-6 (results are those of the given numbers); a larger deviation is
 * MINKRAY_WRONG_USE.
 */

#include "minkray/minkray_c.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- many pairs at once ---------------------------------------------------------------------- */

typedef enum minkray_pose_kind {
  MINKRAY_POSE_MATRIX = 0,     /* the 12 numbers of a minkray_pose */
  MINKRAY_POSE_QUATERNION = 1, /* x, y, z, qw, qx, qy, qz; quaternion of any length except 0 */
  MINKRAY_POSE_MATRIX_4X4 = 2  /* 16 numbers, row by row; the last row is 0, 0, 0, 1 */
} minkray_pose_kind;

/* One side of many pairs. Each of the three arrays has one item per pair, or one for all pairs. */
typedef struct minkray_bodies {
  size_t size; /* sizeof(minkray_bodies) */
  const minkray_shape* shapes;
  size_t shape_count;
  const double* poses; /* NULL: the identity, for all */
  size_t pose_count;
  ptrdiff_t pose_stride;       /* bytes from one pose to the next; 0: contiguous */
  const minkray_twist* twists; /* for times of impact only; NULL: at rest */
  size_t twist_count;
  int32_t pose_kind; /* a minkray_pose_kind */
  int32_t reserved;
} minkray_bodies;

/* Warm start: the final state of a query on a pair, kept by the caller for the next query on the
 * same pair. That query is faster if the two shapes have moved little. All zeros: empty. Bounds
 * hold for any contents; the last digits of a result depend on the contents. */
typedef struct minkray_pair_memory {
  uint64_t words[8];
} minkray_pair_memory;

/* NULL arrays are not filled. Derivatives are with respect to a twist of a body at the time of the
 * query: the velocity of its frame's origin (the pose's translation) along the world's axes, then
 * the angular velocity about that point. `is_ridge` is 1 if the derivative may not be unique: for
 * parallel faces, an edge on a face, a depth in two directions. The reported derivative is then one
 * of several. Derivatives are NaN if the distance is unknown. If any derivative is requested,
 * distances are computed to a tolerance of 1e-15, and the direction of a depth up to rounding.
 * `jac_error_a` and `jac_error_b` bound the length of a derivative's error, for velocity and for
 * angular velocity. Both are infinite on ridges, for meshes, and for depths in more than one
 * direction. The bound for angular velocity is also infinite if the nearest point may slide on a
 * surface of unknown curvature. */
typedef struct minkray_distance_arrays {
  size_t size;                 /* sizeof(minkray_distance_arrays) */
  minkray_distance* distances; /* all results of a pair in one struct */
  double* value;
  double* lower;
  double* upper;
  double* points_a; /* three per pair */
  double* points_b;
  double* normals;
  double* jac_a; /* six per pair */
  double* jac_b;
  uint8_t* is_ridge;
  uint8_t* status; /* a minkray_distance_status */
  int32_t* supports;
  double* jac_error_a; /* two per pair; read if `size` includes it */
  double* jac_error_b;
} minkray_distance_arrays;

/* Signed distances of `count` pairs. Bit-identical to minkray_signed_distance for any number of
 * threads. `memories` has one per pair, or is NULL. Both options may be NULL. */
MINKRAY_API int minkray_signed_distances(const minkray_bodies* a, const minkray_bodies* b,
                                         size_t count, const minkray_distance_options* options,
                                         minkray_pair_memory* memories,
                                         const minkray_distance_arrays* distances,
                                         const minkray_options* how);

/* NULL arrays are not filled. Derivatives of the first contact's time with respect to a twist of
 * each body's pose at time 0: NaN without contact, zero if the two overlap at time 0. `is_ridge` is
 * 1 where the derivative may be ambiguous or undefined, as for a grazing contact. `jac_error_a` and
 * `jac_error_b` bound the length of the error; infinite on ridges, for meshes, for two shapes
 * without a radius (neither sphere, capsule nor rounded), and if no overlap was proven. */
typedef struct minkray_impact_arrays {
  size_t size; /* sizeof(minkray_impact_arrays) */
  minkray_impact* impacts;
  double* t_lo;
  double* t_hi;
  double* distance;
  double* points_a;
  double* points_b;
  double* normals;
  double* jac_a;
  double* jac_b;
  uint8_t* is_ridge;
  uint8_t* status;     /* a minkray_impact_status */
  double* jac_error_a; /* two per pair; read if `size` includes it */
  double* jac_error_b;
} minkray_impact_arrays;

/* Times of impact of `count` pairs. `t_max` has one number per pair, or one for all. */
MINKRAY_API int minkray_times_of_impact(const minkray_bodies* a, const minkray_bodies* b,
                                        size_t count, const double* t_max, size_t t_max_count,
                                        minkray_pair_memory* memories,
                                        const minkray_impact_arrays* impacts,
                                        const minkray_options* how);

/* Up to four pairs of contact points: corners of the region where the two shapes face each other.
 * In each pair, point_b - point_a = gap normal. The first pair is that of the signed distance. The
 * others are on the shapes if these are flat there; on curved shapes they are inside, by up to 0.02
 * times the extent of the points. */
typedef struct minkray_manifold {
  double normal[3]; /* unit vector from a to b */
  double points_a[4][3];
  double points_b[4][3];
  double gaps[4]; /* negative: the depth of the overlap there */
  double value;   /* the signed distance, as in a minkray_distance */
  double lower;
  double upper;
  int32_t count;  /* of points; 0 if the distance is unknown. Entries from `count` on are NaN */
  int32_t status; /* a minkray_distance_status */
} minkray_manifold;

/* NULL arrays are not filled. */
typedef struct minkray_manifold_arrays {
  size_t size; /* sizeof(minkray_manifold_arrays) */
  minkray_manifold* manifolds;
  double* normals;  /* three per pair */
  double* points;   /* midpoints of points_a and points_b: 12 numbers per pair */
  double* points_a; /* 12 numbers per pair */
  double* points_b;
  double* gaps; /* four per pair */
  double* value;
  double* lower;
  double* upper;
  int32_t* counts;
  uint8_t* status;
} minkray_manifold_arrays;

/* Contact points of `count` pairs. */
MINKRAY_API int minkray_manifolds(const minkray_bodies* a, const minkray_bodies* b, size_t count,
                                  const minkray_distance_options* options,
                                  minkray_pair_memory* memories,
                                  const minkray_manifold_arrays* manifolds,
                                  const minkray_options* how);

/* ---- the pairs of a scene -------------------------------------------------------------------- */

/* Scenes must be committed before queries. Results exclude removed objects and include particles,
 * whose numbers minkray_scene_size explains. */

/* Sets which pairs are tested: those where each object's mask shares a bit with the other object's
 * category. By default categories are 1 and masks have all bits. Changes the scene; needs no
 * commit. */
MINKRAY_API int minkray_scene_set_masks(minkray_scene scene, uint32_t object, uint32_t category,
                                        uint32_t mask);

/* Sets if two objects may touch: allowed pairs are not tested. Changes the scene. */
MINKRAY_API int minkray_scene_allow(minkray_scene scene, uint32_t object_a, uint32_t object_b,
                                    int is_allowed);

/* Allows the pairs of links that may touch according to an SRDF file, MoveIt's description of a
 * robot: its `disable_collisions`, `disable_default_collisions` and `enable_collisions`.
 * `group` is a robot's. An unknown link is MINKRAY_BAD_INPUT, and no pair is allowed then. */
MINKRAY_API int minkray_scene_allow_from_srdf(minkray_scene scene, uint32_t group,
                                              const char* file);

/* Two objects and their distance. `is_ridge` is also 1 if another object may be as near, but for
 * minkray_scene_distances, where it is that of this pair. `jac_a` and `jac_b` are the derivatives
 * with respect to a twist of each about the origin of its frame, zero unless requested, NaN if
 * there is no object; see minkray_distance_arrays. */
typedef struct minkray_scene_pair {
  minkray_distance distance;
  double jac_a[6];
  double jac_b[6];
  uint32_t object_a; /* the lesser number; MINKRAY_NO_OBJECT for a given shape */
  uint32_t object_b; /* MINKRAY_NO_OBJECT if there is none: distances are infinite */
  int32_t is_ridge;
  int32_t reserved;
} minkray_scene_pair;

typedef struct minkray_near_options {
  size_t size;         /* sizeof(minkray_near_options) */
  double within;       /* pairs proven to be further apart are skipped; 0: the default, which is 0
                        * for minkray_scene_distances without `pairs`, else infinite */
  double tolerance;    /* as in minkray_distance_options */
  int32_t derivatives; /* 1: add derivatives */
  uint32_t mask;       /* for given shapes and points: categories to test; 0: all */
  /* Receives bounds of the length of each derivative's error, for velocity and for angular
   * velocity: two numbers per shape for minkray_scene_time_of_impact; four numbers per pair (two
   * for a, two for b) for minkray_scene_nearest and minkray_scene_distance_to. Infinite as in
   * minkray_distance_arrays, but finite for a mesh above a half-space. Read if `size` includes it;
   * may be NULL. */
  double* jac_error;
  /* Set by minkray_scene_distances to an array of such bounds, four per pair, which is valid while
   * `take` runs. Read if `size` includes it; may be NULL. */
  const double** jac_errors;
} minkray_near_options;

/* Receives all pairs at once, sorted by object numbers, on the calling thread. The pairs are
 * invalid after the function returns. Returns 0, or nonzero to end the call with MINKRAY_STOPPED.
 */
typedef int (*minkray_take_pairs)(void* user, const minkray_scene_pair* pairs, size_t count);

/* All pairs of objects not proven to be further apart than `within`. Skips pairs that masks exclude
 * or that are allowed, pairs of half-spaces, and links of a robot that do not move relative to each
 * other or that a joint connects. If `pairs` is not NULL, computes exactly these `count` pairs (two
 * numbers each), in their order, even if masks exclude them or they are allowed. Options may be
 * NULL. */
MINKRAY_API int minkray_scene_distances(minkray_scene scene, const uint32_t* pairs, size_t count,
                                        const minkray_near_options* options,
                                        minkray_take_pairs take, void* user,
                                        const minkray_options* how);

/* The k objects nearest to each of `count` points, the nearest first: k results per point, with
 * MINKRAY_NO_OBJECT if there are fewer objects. In each pair, a is the point. */
MINKRAY_API int minkray_scene_nearest(minkray_scene scene, const double (*points)[3], size_t count,
                                      size_t k, const minkray_near_options* options,
                                      minkray_scene_pair* nearest, const minkray_options* how);

/* The object nearest to each of many given shapes. The shapes are not part of the scene; in each
 * pair, a is the shape. There is always an object, unless the scene is empty or `within` excludes
 * all objects. Options may be NULL. */
MINKRAY_API int minkray_scene_distance_to(minkray_scene scene, const minkray_bodies* shapes,
                                          size_t count, const minkray_near_options* options,
                                          minkray_scene_pair* nearest, const minkray_options* how);

/* First contact of a shape that moves through the scene. */
typedef struct minkray_scene_impact {
  minkray_impact impact; /* no contact before t_lo; contact at t_hi */
  double jac[6];         /* derivative of the time with respect to a twist at time 0 */
  uint32_t object;       /* MINKRAY_NO_OBJECT without contact */
  int32_t is_ridge;      /* also 1 if another object may be touched at the same time */
} minkray_scene_impact;

/* Casts shapes through the scene, at times from 0 to t_max (one number, or one per shape). Options
 * may be NULL; only `derivatives`, `mask` and `jac_error` are used. */
MINKRAY_API int minkray_scene_time_of_impact(minkray_scene scene, const minkray_bodies* shapes,
                                             size_t count, const double* t_max, size_t t_max_count,
                                             const minkray_near_options* options,
                                             minkray_scene_impact* impacts,
                                             const minkray_options* how);

/* Contact points of two objects, regardless of masks. */
MINKRAY_API int minkray_scene_manifold(minkray_scene scene, uint32_t object_a, uint32_t object_b,
                                       minkray_manifold* manifold);

/* ---- derivatives of rays --------------------------------------------------------------------- */

/* Derivatives of a ray's t, six numbers each: with respect to its origin and its direction, and to
 * a twist of the hit object about the origin of its frame. NULL arrays are not filled. Zero if the
 * ray begins inside, NaN for a miss. `is_ridge` is 1 where the derivative may be ambiguous: the ray
 * passes through an edge, grazes a shape, or hits two objects at once. `jac_error_ray` and
 * `jac_error_body` bound the length of the error: for origin and for direction, for velocity and
 * for angular velocity. Infinite on ridges, and where the surface's curvature is unknown: for
 * shapes known by their support mapping only, and for meshes unless the hits have `parts`. */
typedef struct minkray_ray_derivatives {
  size_t size; /* sizeof(minkray_ray_derivatives) */
  double* jac_ray;
  double* jac_body;
  uint8_t* is_ridge;
  double* jac_error_ray; /* two per ray; read if `size` includes it */
  double* jac_error_body;
} minkray_ray_derivatives;

/* Derivatives of t. Needs the results of minkray_scene_cast_arrays for the same rays: t and its
 * bounds, points, normals, objects and status. */
MINKRAY_API int minkray_scene_ray_derivatives(minkray_scene scene, const minkray_ray_arrays* rays,
                                              size_t count, const minkray_hit_arrays* hits,
                                              const minkray_ray_derivatives* derivatives,
                                              const minkray_options* options);

/* ---- derivatives of clearances --------------------------------------------------------------- */

/* Clearances with their derivatives with respect to the joint values. Otherwise as
 * minkray_scene_clearance. `jac` gets `numbers` numbers per step: the derivative of the distance at
 * `row`, which `upper` bounds, with respect to the joint values at `row`. Between rows quaternions
 * are normalized; at a row they are as given. Joints that mimic others have zeros; without other
 * objects all numbers are zero. `is_ridge` is 1 if the derivative may be ambiguous, or another pair
 * is equally near at `row`. Each of `steps`, `jac` and `is_ridge` may be NULL. `jac_error` of the
 * options holds for the rounded joint values at `row`; infinite on ridges and for meshes. */
MINKRAY_API int minkray_scene_clearance_derivatives(minkray_scene scene, uint32_t group,
                                                    const double* path, size_t rows, size_t numbers,
                                                    const minkray_clearance_options* options,
                                                    minkray_clearance* steps, double* jac,
                                                    uint8_t* is_ridge);

#ifdef __cplusplus
}
#endif

#endif
