/* SPDX-License-Identifier: MIT
 * Many pairs of shapes at once, and the pairs of a scene: distances with their derivatives, points
 * of contact, times of impact. docs/pairs.md has examples. What minkray_c.h says of errors, threads
 * and units holds here, too.
 *
 * All poses are rigid: a rotation or a reflection, and a translation. Their linear parts may be off
 * that by 1e-6; the answers are those of the numbers that were given. What is further off is
 * MINKRAY_WRONG_USE.
 */
#ifndef MINKRAY_MINKRAY_C_PAIRS_H
#define MINKRAY_MINKRAY_C_PAIRS_H

#include "minkray/minkray_c.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- many pairs at once ---------------------------------------------------------------------- */

typedef enum minkray_pose_kind {
  MINKRAY_POSE_MATRIX = 0,     /* the 12 numbers of a minkray_pose */
  MINKRAY_POSE_QUATERNION = 1, /* x, y, z, qw, qx, qy, qz; the quaternion of any length but zero */
  MINKRAY_POSE_MATRIX_4X4 = 2  /* 16 numbers, row by row; the last row is 0, 0, 0, 1 */
} minkray_pose_kind;

/* One side of many pairs. Of each of the three there are as many as pairs, or one for all pairs. */
typedef struct minkray_bodies {
  size_t size; /* sizeof(minkray_bodies) */
  const minkray_shape* shapes;
  size_t shape_count;
  const double* poses; /* NULL: the identity, for all */
  size_t pose_count;
  ptrdiff_t pose_stride; /* bytes from one pose to the next; 0: they have no room in between */
  const minkray_twist* twists; /* for times of impact alone; NULL: at rest */
  size_t twist_count;
  int32_t pose_kind; /* a minkray_pose_kind */
  int32_t reserved;
} minkray_bodies;

/* What a query on a pair ended with, kept by its caller for the next one on the same pair, which is
 * then faster if the two have moved little. Zeros are an empty one. The bounds hold whatever is in
 * it; the answer's last digits depend on it. */
typedef struct minkray_pair_memory {
  uint64_t words[8];
} minkray_pair_memory;

/* Those that are NULL are not filled. A pair's derivative is by a twist of a body at the time of
 * the question: by the velocity of its frame's origin (the pose's translation) along the world's
 * axes, then by its angular velocity about that point. `is_ridge` is 1 where the bounds do not
 * exclude that there are several derivatives: of parallel faces, an edge on a face, a depth in two
 * directions; the one that is told is one of them. Where nothing is known of the distance
 * derivatives are NaN. */
typedef struct minkray_distance_arrays {
  size_t size;                 /* sizeof(minkray_distance_arrays) */
  minkray_distance* distances; /* all of a pair in one struct */
  double* value;
  double* lower;
  double* upper;
  double* points_a; /* three a pair */
  double* points_b;
  double* normals;
  double* jac_a; /* six a pair */
  double* jac_b;
  uint8_t* is_ridge;
  uint8_t* status; /* a minkray_distance_status */
  int32_t* supports;
} minkray_distance_arrays;

/* As many signed distances as `count`: each has the bits of minkray_signed_distance, whatever the
 * number of threads. `memories` are as many as pairs, or NULL. Either options may be NULL. */
MINKRAY_API int minkray_signed_distances(const minkray_bodies* a, const minkray_bodies* b,
                                         size_t count, const minkray_distance_options* options,
                                         minkray_pair_memory* memories,
                                         const minkray_distance_arrays* distances,
                                         const minkray_options* how);

/* Those that are NULL are not filled. Derivatives are those of the first contact's time by a twist
 * of each body's pose at time 0; NaN where there is no contact, zero where the two begin inside
 * each other. `is_ridge` is 1 where there may be several or none, as where they graze. */
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
  uint8_t* status; /* a minkray_impact_status */
} minkray_impact_arrays;

/* As many times of impact. `t_max` are as many as pairs, or one. */
MINKRAY_API int minkray_times_of_impact(const minkray_bodies* a, const minkray_bodies* b,
                                        size_t count, const double* t_max, size_t t_max_count,
                                        minkray_pair_memory* memories,
                                        const minkray_impact_arrays* impacts,
                                        const minkray_options* how);

/* Up to four points of contact: corners of what of the two faces each other, one over the other
 * along the normal: point_b - point_a = gap normal. The first is that of the signed distance. */
typedef struct minkray_manifold {
  double normal[3]; /* from a to b, of length 1 */
  double points_a[4][3];
  double points_b[4][3];
  double gaps[4]; /* less than zero: so deep are the two in each other there */
  double value;   /* the signed distance, as in a minkray_distance */
  double lower;
  double upper;
  int32_t count;  /* 0 if nothing is known of the distance; what is beyond it is NaN */
  int32_t status; /* a minkray_distance_status */
} minkray_manifold;

/* Those that are NULL are not filled. */
typedef struct minkray_manifold_arrays {
  size_t size; /* sizeof(minkray_manifold_arrays) */
  minkray_manifold* manifolds;
  double* normals;  /* three a pair */
  double* points;   /* in the middle between those of a and b: four times three a pair */
  double* points_a; /* likewise */
  double* points_b;
  double* gaps; /* four a pair */
  double* value;
  double* lower;
  double* upper;
  int32_t* counts;
  uint8_t* status;
} minkray_manifold_arrays;

/* As many manifolds. */
MINKRAY_API int minkray_manifolds(const minkray_bodies* a, const minkray_bodies* b, size_t count,
                                  const minkray_distance_options* options,
                                  minkray_pair_memory* memories,
                                  const minkray_manifold_arrays* manifolds,
                                  const minkray_options* how);

#ifdef __cplusplus
}
#endif

#endif
