/* SPDX-License-Identifier: MIT
 * Minkray for C and for every language that can call C: convex shapes, scenes, ray casts with
 * proofs, distances and times of impact. docs/c.md has examples.
 */
#ifndef MINKRAY_MINKRAY_C_H
#define MINKRAY_MINKRAY_C_H

/* All functions that return an int return MINKRAY_OK or another minkray_code; minkray_last_error()
 * then names the error and its place. A failed call writes no results, unless its description
 * specifies partial results.
 *
 * Handles are numbers, never addresses: using a released or invalid handle is a reported error,
 * even if newer handles exist.
 *
 * Threads: any number of threads may call functions of shapes at once. The same holds for functions
 * of scenes that do not change the scene. A call that changes or releases a scene while another
 * call (from any thread or a callback) uses this scene returns MINKRAY_WRONG_USE and changes
 * nothing. A call that uses a scene during a change also returns MINKRAY_WRONG_USE.
 *
 * All points, directions and poses are in world coordinates. Lengths have the scene's unit.
 */

#include <stddef.h>
#include <stdint.h>

#define MINKRAY_VERSION_MAJOR 0
#define MINKRAY_VERSION_MINOR 1
#define MINKRAY_VERSION_PATCH 0

#if defined(__GNUC__)
#define MINKRAY_API __attribute__((visibility("default")))
#else
#define MINKRAY_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Return codes. */
typedef enum minkray_code {
  MINKRAY_OK = 0,
  MINKRAY_WRONG_USE = 1,   /* an invalid argument, or a call at the wrong time */
  MINKRAY_BAD_INPUT = 2,   /* an invalid file or text */
  MINKRAY_BAD_SUPPORT = 3, /* a custom support function returned inconsistent points; results may
                            * be incomplete */
  MINKRAY_NO_MEMORY = 4,
  MINKRAY_STOPPED = 5, /* stopped by a callback; results are incomplete */
  MINKRAY_DEFECT = 6   /* a bug in Minkray: please report it */
} minkray_code;

/* Version of the loaded library, such as "0.1.0". */
MINKRAY_API const char* minkray_version(void);

/* Message of this thread's last failed call, one mistake per line. Valid until the next call. */
MINKRAY_API const char* minkray_last_error(void);

/* ---- shapes ---------------------------------------------------------------------------------- */

/* An immutable convex shape, mesh or compound. {0} means no shape. */
typedef struct minkray_shape {
  uint64_t id;
} minkray_shape;

/* The affine map x -> linear x + translation. Each row has three numbers of the linear part, then
 * one of the translation. */
typedef struct minkray_pose {
  double rows[3][4];
} minkray_pose;

/* One parameter of a shape: numbers or shapes. A point has three numbers; a map has the 12 numbers
 * of a minkray_pose. */
typedef struct minkray_parameter {
  const char* name;
  const double* numbers;
  size_t number_count;
  const minkray_shape* shapes;
  size_t shape_count;
} minkray_parameter;

/* Makes a shape of any kind by its name in scene files: `minkray info --shapes` lists kinds and
 * parameters. The operands may be released afterwards. */
MINKRAY_API int minkray_shape_make(const char* kind, const minkray_parameter* parameters,
                                   size_t count, minkray_shape* shape);

/* Reads a shape from the JSON text of a scene file. Mesh files are searched in `folder`, which may
 * be NULL for the working folder. */
MINKRAY_API int minkray_shape_read(const char* json, const char* folder, minkray_shape* shape);

/* Support function of a custom shape. Sets points[i] to the shape's furthest point along
 * directions[i], which has length 1. Equal directions must get equal points. Several threads may
 * call the function at once. The function must not query the shape itself, or shapes made of it:
 * such queries return MINKRAY_WRONG_USE. Returns 0, or nonzero on failure; see
 * minkray_support_failed. */
typedef int (*minkray_support_function)(void* user, size_t count, const double (*directions)[3],
                                        double (*points)[3]);

typedef struct minkray_support {
  minkray_support_function function;
  void* user;
  void (*release)(void* user); /* called once no shape uses `user`; may be NULL */
  const double* lower;         /* corners of a box that contains the shape; or both NULL */
  const double* upper;
} minkray_support;

/* A mesh of triangles: three vertex indices each, counter-clockwise as seen from outside. Rays hit
 * the mesh itself, not its hull, from either side. A ray at an edge or vertex of a closed mesh hits
 * one of the triangles there. Scenes accept a mesh like a shape; functions
 * that need a convex shape, such as minkray_shape_make, reject a mesh. Both arrays are copied. */
MINKRAY_API int minkray_shape_mesh(const double (*vertices)[3], size_t vertex_count,
                                   const uint32_t (*triangles)[3], size_t triangle_count,
                                   minkray_shape* shape);

/* A terrain as a mesh: heights over a grid centred at the origin, `size_x` by `size_y` from border
 * to border. Each of the `rows` rows runs along x and has `columns` heights; the row with the least
 * y is first. Each cell is cut along the diagonal from its corner of least x and y. The cell in
 * row r and column c has two triangles: number 2 (r (columns - 1) + c) and the next one. A `bottom`
 * closes the mesh to a solid, by walls down to that z; NULL: open. The heights are copied. */
MINKRAY_API int minkray_shape_height_field(const double* heights, size_t rows, size_t columns,
                                           double size_x, double size_y, const double* bottom,
                                           minkray_shape* shape);

/* Properties of a mesh. Vertices at the same position count as one, except in `vertices`. */
typedef struct minkray_mesh_info {
  size_t vertices, triangles;
  size_t open_edges;   /* edges that triangles use more often in one direction; 0: closed */
  size_t without_area; /* triangles of zero area, which no ray hits */
  size_t repeated;     /* triangles with the same vertices as another */
} minkray_mesh_info;
/* Counts a mesh's vertices, triangles and defects. */
MINKRAY_API int minkray_shape_mesh_info(minkray_shape shape, minkray_mesh_info* info);
/* Copies a mesh's vertices and triangles: as many as minkray_mesh_info has. */
MINKRAY_API int minkray_shape_mesh_arrays(minkray_shape shape, double (*vertices)[3],
                                          uint32_t (*triangles)[3]);

/* A solid of convex parts: shapes at poses (NULL: the identity). Scenes, rays and pairs accept a
 * compound like a mesh, and hits name the part. */
MINKRAY_API int minkray_shape_compound(const minkray_shape* shapes, const minkray_pose* poses,
                                       size_t count, minkray_shape* shape);
/* Number of a compound's parts. */
MINKRAY_API int minkray_shape_compound_size(minkray_shape shape, size_t* count);
/* Shape and pose of a part. The shape must be released. Output pointers may be NULL. */
MINKRAY_API int minkray_shape_compound_part(minkray_shape shape, size_t part, minkray_shape* made,
                                            minkray_pose* pose);

/* Sets the error message of a failing support function, for the query that called it. Ignored
 * outside of support functions. */
MINKRAY_API void minkray_support_failed(const char* reason);

/* Makes a shape from a support function. Calls the function for a few hundred directions, and
 * returns MINKRAY_BAD_SUPPORT if no convex shape has the returned points. Later points are checked
 * as well: a query that gets inconsistent points returns MINKRAY_BAD_SUPPORT. If
 * minkray_shape_custom fails, it calls `release`. */
MINKRAY_API int minkray_shape_custom(const minkray_support* support, minkray_shape* shape);

/* Makes a shape from a function that is expensive per call and cheap per direction, such as a
 * function in an interpreter. Casts of many rays collect up to `gathered` directions per call;
 * other queries pass at most 16. `gathered` does not change results. */
MINKRAY_API int minkray_shape_custom_gathered(const minkray_support* support, size_t gathered,
                                              minkray_shape* shape);

/* Derivatives of support points with respect to directions of length 1. derivatives[i] is the
 * derivative of points[i]: a symmetric matrix, row by row. Its product with the direction is zero;
 * its other eigenvalues are the radii of curvature. At a vertex the matrix is zero. */
typedef int (*minkray_jet_function)(void* user, size_t count, const double (*directions)[3],
                                    double (*points)[3], double (*derivatives)[9]);

/* Makes a smooth shape with known curvature, which saves most of the support points of a cast.
 * `jets` gets the `user` of `support`, and must return the same points as its function. Wrong
 * derivatives only cost time: casts do not rely on them. */
MINKRAY_API int minkray_shape_custom_with_jets(const minkray_support* support,
                                               minkray_jet_function jets, minkray_shape* shape);

/* Reference count: retain adds an owner, release removes one. */
MINKRAY_API int minkray_shape_retain(minkray_shape shape);
MINKRAY_API int minkray_shape_release(minkray_shape shape);

/* Writes a shape as JSON, which minkray_shape_read reads back: at most `size` bytes, including the
 * final 0. `needed` (or NULL) receives the number of bytes required. Custom shapes cannot be
 * written. */
MINKRAY_API int minkray_shape_write(minkray_shape shape, char* text, size_t size, size_t* needed);

/* The kind's name, such as "rounded". */
MINKRAY_API int minkray_shape_kind(minkray_shape shape, const char** kind);

/* Support points along `count` directions of any length. */
MINKRAY_API int minkray_shape_support(minkray_shape shape, size_t count,
                                      const double (*directions)[3], double (*points)[3]);

/* Axis-aligned bounding box, tight up to rounding. */
MINKRAY_API int minkray_shape_bounds(minkray_shape shape, double lower[3], double upper[3]);

/* ---- scenes ---------------------------------------------------------------------------------- */

/* Objects with poses. {0} means no scene. */
typedef struct minkray_scene {
  uint64_t id;
} minkray_scene;

#define MINKRAY_NO_OBJECT UINT32_MAX

/* Makes an empty scene; release it when done. */
MINKRAY_API int minkray_scene_make(minkray_scene* scene);
MINKRAY_API int minkray_scene_release(minkray_scene scene);

/* Adds a shape. The functions from here to minkray_scene_commit change the scene. Objects are
 * numbered from 0 on. `pose` may be any invertible map, NULL for the identity; `name` and the
 * output pointers may be NULL. */
MINKRAY_API int minkray_scene_add(minkray_scene scene, minkray_shape shape,
                                  const minkray_pose* pose, const char* name, uint32_t* object);

/* Adds a half-space: all points x with normal . x <= offset |normal|. */
MINKRAY_API int minkray_scene_add_half_space(minkray_scene scene, const double normal[3],
                                             double offset, const char* name, uint32_t* object);

typedef struct minkray_file_options {
  size_t size;                     /* sizeof(minkray_file_options) */
  const minkray_pose* pose;        /* applied to all objects of the file, after their own poses; or
                                    * NULL. Must be NULL for files with particles */
  const char* geometry;            /* of robots: "visual" (or NULL), "collision" or "all" */
  const char* keyframe;            /* name or number of an MJCF keyframe; or NULL */
  const char* const* package_dirs; /* search path for package:// and model:// */
  size_t package_dir_count;
  int skip_missing_meshes; /* 1: missing mesh files are no error */
  const char* meshes; /* of robots: "exact" (triangles) or "hull" (convex hulls of their vertices);
                       * NULL: exact, but hull for contact in MJCF. Read only if `size` covers it */
} minkray_file_options;

/* Adds all objects of a scene file (.json) or of a robot's file (URDF, MJCF, SDF, glTF): a group of
 * objects with consecutive numbers. Options may be NULL. */
MINKRAY_API int minkray_scene_add_file(minkray_scene scene, const char* file,
                                       const minkray_file_options* options, uint32_t* group);

/* Moves an object. An object of a robot moves again when a joint is set. */
MINKRAY_API int minkray_scene_set_pose(minkray_scene scene, uint32_t object,
                                       const minkray_pose* pose);

/* Moves all objects of a file. A file with particles cannot be moved: MINKRAY_WRONG_USE. */
MINKRAY_API int minkray_scene_set_group_pose(minkray_scene scene, uint32_t group,
                                             const minkray_pose* pose);

/* Sets a joint: one number for a hinge (radians) or a slide, four for a ball joint (quaternion w,
 * x, y, z). */
MINKRAY_API int minkray_scene_set_joint(minkray_scene scene, uint32_t group, const char* joint,
                                        const double* values, size_t count);

/* Removes an object. Its number is never reused, and calls with it return MINKRAY_WRONG_USE; all
 * other numbers stay the same. */
MINKRAY_API int minkray_scene_remove(minkray_scene scene, uint32_t object);

/* Applies all changes since the last commit: builds the BVH, or refits it if objects only moved. */
MINKRAY_API int minkray_scene_commit(minkray_scene scene);

/* Number of added objects, including removed ones. Particles of scene files are numbered
 * after all objects, once the scene is committed. */
MINKRAY_API int minkray_scene_size(minkray_scene scene, uint32_t* objects, uint32_t* particles);

/* Name of an object, valid as long as the scene exists. */
MINKRAY_API int minkray_scene_name(minkray_scene scene, uint32_t object, const char** name);
/* Pose of an object. */
MINKRAY_API int minkray_scene_pose(minkray_scene scene, uint32_t object, minkray_pose* pose);

/* Objects of a group, and the number of its movable joints. */
MINKRAY_API int minkray_scene_group(minkray_scene scene, uint32_t group, uint32_t* first_object,
                                    uint32_t* objects, uint32_t* joints);
/* Name of a joint, and the count of its numbers. */
MINKRAY_API int minkray_scene_joint(minkray_scene scene, uint32_t group, uint32_t joint,
                                    const char** name, size_t* number_count);
/* Value of a joint: as many numbers as minkray_scene_joint reports, at most `size`. */
MINKRAY_API int minkray_scene_joint_value(minkray_scene scene, uint32_t group, uint32_t joint,
                                          double* values, size_t size);

/* ---- rays ------------------------------------------------------------------------------------ */

/* The points origin + t direction, 0 <= t <= t_max. The direction may have any length; zero is
 * MINKRAY_WRONG_USE. A t_max of 0 (a zeroed struct) or infinity means unlimited. */
typedef struct minkray_ray {
  double origin[3];
  double direction[3];
  double t_max;
} minkray_ray;

typedef enum minkray_status {
  MINKRAY_HIT = 0,
  MINKRAY_MISS = 1,
  MINKRAY_INSIDE = 2,   /* the ray begins in the object: t = 0 */
  MINKRAY_EXHAUSTED = 3 /* the solver did not converge: neither a hit nor a miss */
} minkray_status;

typedef struct minkray_hit {
  double t;    /* ray parameter: the point is origin + t direction; infinite for a miss */
  double t_lo; /* proven bounds of t */
  double t_hi;
  double t_base; /* t_base + t_offset is a more precise t */
  double t_offset;
  double point[3];  /* NaN for a miss */
  double normal[3]; /* outward unit vector; of a mesh: towards the ray. Zero without a hit */
  uint32_t object;  /* or MINKRAY_NO_OBJECT */
  int32_t status;   /* a minkray_status */
  int32_t supports; /* calls of the object's support mapping */
  int32_t part;     /* of a mesh or compound: the triangle or part; else -1 */
} minkray_hit;

typedef struct minkray_options {
  size_t size;     /* sizeof(minkray_options) */
  int32_t threads; /* 0: one per core. Results are bit-identical for any number */
  int32_t reserved;
  /* Called from time to time with the fraction done, by one thread at a time; return nonzero to
   * stop. May be NULL. */
  int (*progress)(void* user, double done);
  void* user;
} minkray_options;

/* First hits of rays; among hits at the same t, the object with the smallest number. Results are
 * bit-identical for any split of the rays into calls. A ray is MINKRAY_EXHAUSTED if the solver did
 * not converge for some object, even if the ray hits another one; the result then has that hit.
 * Options may be NULL. */
MINKRAY_API int minkray_scene_cast(minkray_scene scene, const minkray_ray* rays, size_t count,
                                   minkray_hit* hits, const minkray_options* options);

/* Rays as arrays: strides are in bytes from one ray to the next; 0: contiguous. */
typedef struct minkray_ray_arrays {
  size_t size; /* sizeof(minkray_ray_arrays) */
  const double* origins;
  ptrdiff_t origin_stride;
  const double* directions;
  ptrdiff_t direction_stride;
  const double* t_max; /* NULL: unlimited. 0 ends a ray at its origin */
  ptrdiff_t t_max_stride;
  /* Arrays of float, each instead of the one of double above. Read if `size` includes them. */
  const float* float_origins;
  const float* float_directions;
  const float* float_t_max;
} minkray_ray_arrays;

/* NULL arrays are not filled. */
typedef struct minkray_hit_arrays {
  size_t size; /* sizeof(minkray_hit_arrays) */
  double* t;
  double* t_lo;
  double* t_hi;
  double* distance; /* t times the direction's length */
  double* points;   /* three per ray */
  double* normals;  /* three per ray */
  uint32_t* objects;
  uint8_t* status;
  int32_t* supports;
  int32_t* parts; /* read only if `size` covers it */
} minkray_hit_arrays;

/* Casts rays given as arrays. */
MINKRAY_API int minkray_scene_cast_arrays(minkray_scene scene, const minkray_ray_arrays* rays,
                                          size_t count, const minkray_hit_arrays* hits,
                                          const minkray_options* options);

/* Occlusion of rays: blocked[i] is MINKRAY_HIT if the ray hits anything, MINKRAY_MISS, or
 * MINKRAY_EXHAUSTED. */
MINKRAY_API int minkray_scene_occluded(minkray_scene scene, const minkray_ray_arrays* rays,
                                       size_t count, uint8_t* blocked,
                                       const minkray_options* options);

/* Occlusion of rays given as structs. */
MINKRAY_API int minkray_scene_occluded_rays(minkray_scene scene, const minkray_ray* rays,
                                            size_t count, uint8_t* blocked,
                                            const minkray_options* options);

/* Finds where rays last leave one object. The status is MINKRAY_HIT at the greatest t at which the
 * ray is in the object, MINKRAY_INSIDE if the ray ends in the object (at t_max), or MINKRAY_MISS.
 * Earlier exits from a mesh are not reported. An open mesh has no inside: the result is the last
 * triangle that is hit. Normals point out of the object; normals of a mesh point along the ray. Not
 * for half-spaces, which are unbounded. */
MINKRAY_API int minkray_scene_exit(minkray_scene scene, uint32_t object, const minkray_ray* rays,
                                   size_t count, minkray_hit* hits, const minkray_options* options);

/* A point where a ray enters or leaves an object. */
typedef struct minkray_crossing {
  double t;    /* the ray's parameter */
  double t_lo; /* proven bounds of t */
  double t_hi;
  double point[3];
  double normal[3]; /* outward unit vector; of a mesh: the side on which the triangle's vertices are
                     * counter-clockwise */
  uint32_t object;
  int32_t part;   /* of a mesh or compound: the triangle or part; else -1 */
  int32_t leaves; /* 0: the ray enters the object; 1: it leaves */
  int32_t reserved;
} minkray_crossing;

/* All hits of rays: those of ray i are hits[offsets[i]] to hits[offsets[i + 1] - 1]. */
typedef struct minkray_all_hits {
  size_t size; /* sizeof(minkray_all_hits) */
  size_t rays;
  const size_t* offsets; /* rays + 1 numbers */
  const minkray_crossing* hits;
  const uint8_t*
      status; /* per ray: MINKRAY_HIT, MINKRAY_MISS (no hits), or MINKRAY_EXHAUSTED if the
               * solver did not converge for some object, whose hits may be missing */
} minkray_all_hits;

/* Receives all hits, on the calling thread. The hits are invalid after the function returns.
 * Returns 0, or nonzero to end the call with MINKRAY_STOPPED. */
typedef int (*minkray_take_all_hits)(void* user, const minkray_all_hits* found);

/* Finds all entries and exits of rays, with 0 <= t <= t_max. A ray's hits are sorted by t, then by
 * object. A ray that begins in an object has no entry into it; a ray that ends in an object has no
 * exit. Entries and exits of a closed mesh without self-intersections alternate, even if the ray
 * passes exactly through edges and vertices. A ray that only touches an edge or vertex either
 * enters and leaves the mesh at the same t, or does not hit the mesh. */
MINKRAY_API int minkray_scene_all_hits(minkray_scene scene, const minkray_ray_arrays* rays,
                                       size_t count, minkray_take_all_hits take, void* user,
                                       const minkray_options* options);

/* Casts rays at one shape alone. `pose` may be NULL. */
MINKRAY_API int minkray_shape_cast(minkray_shape shape, const minkray_pose* pose,
                                   const minkray_ray* rays, size_t count, minkray_hit* hits,
                                   const minkray_options* options);

/* ---- proofs ---------------------------------------------------------------------------------- */

/* Proof of a result, by support points alone (docs/certificates.md). */
typedef struct minkray_proof {
  int32_t holds; /* 1 if proven */
  int32_t reserved;
  uint32_t against; /* the object for which the proof failed, or MINKRAY_NO_OBJECT */
  uint32_t checked; /* number of objects with a proof */
  double t_lo;      /* of hits: proven bounds of t, including rounding */
  double t_hi;
  double plane[3]; /* of hits: a plane through t_lo that the object does not cross */
  char complaint[56];
  double allowed; /* allowed rounding, a distance perpendicular to a plane */
} minkray_proof;

/* Proves results of minkray_scene_cast: the object is hit at the reported point, and no other
 * object before it. The proof holds up to the rounding that docs/certificates.md specifies. */
MINKRAY_API int minkray_scene_prove(minkray_scene scene, const minkray_ray* rays,
                                    const minkray_hit* hits, size_t count, minkray_proof* proofs,
                                    const minkray_options* options);

/* ---- sensors --------------------------------------------------------------------------------- */

/* A lidar's rays. `pattern` is one of
 * - "spinning:CHANNELSxSTEPS[:LOWEST,HIGHEST[:FROM,TO]]": elevations (default -15,15) and azimuths
 *   in degrees. Rays are ordered by row, the highest elevation first. By default a row runs
 * clockwise, from behind the sensor.
 * - a lidar's name: "VLP-16", "VLP-32C", "HDL-64E", "OS1-64" or "Mid-360".
 * - a file: .csv (Livox), .json of elevations (also Ouster's) or .mat3x4f.
 * In the sensor's frame x points ahead and z is the axis of rotation. `pose` is the sensor's pose
 * in the world, or NULL. Directions have length 1, so t is the distance. Writes at most `size`
 * rays. `needed` (or NULL) receives the number of all rays. */
MINKRAY_API int minkray_lidar_rays(const char* pattern, const minkray_pose* pose, minkray_ray* rays,
                                   size_t size, size_t* needed);

/* A calibrated camera's rays, row by row. `camera` is the text of a JSON object with fx, fy, cx,
 * cy, width and height in pixels. Optional are "model" ("pinhole" or "fisheye"), k1 to k6
 * (fisheyes: k1 to k4), p1 and p2. All are as in OpenCV: the centre of the first pixel is at (0,
 * 0). Directions have z = 1 in the camera's frame, so t is the depth; for fisheyes they have
 * length 1. Directions are NaN where the distortion has no inverse. Pose, size and `needed` are as
 * for lidars. */
MINKRAY_API int minkray_camera_rays(const char* camera, const minkray_pose* pose, minkray_ray* rays,
                                    size_t size, size_t* needed);

/* ---- pictures -------------------------------------------------------------------------------- */

typedef struct minkray_picture_options {
  size_t size; /* sizeof(minkray_picture_options) */
  /* Text of a JSON object with the keys "camera", "lights" and "background" of scene files, each
   * optional. Present keys replace those of the scene's files. May be NULL. Without a camera the
   * picture shows all objects; without lights there are a sun and a sky. */
  const char* view;
  uint32_t width; /* in pixels; 0: the camera's */
  uint32_t height;
  uint32_t samples;  /* per pixel; 0: default (16) */
  int32_t bounces;   /* with integrator "ambient"; 0: default (1), negative: none */
  int32_t max_depth; /* with integrator "path"; 0: default (16), negative: none */
  int32_t denoise;   /* 1: denoise; needs at least 2 samples */
  uint64_t seed;
  const char* integrator; /* as for `minkray render --integrator`; NULL: "auto" */
} minkray_picture_options;

/* One channel of a picture. */
typedef struct minkray_channel {
  const char* name; /* "rgb" (linear), or one of `minkray render --aov` except cryptomatte */
  double* values;   /* pixel by pixel, in rows from the top */
  size_t count;     /* number of values: width * height * numbers per pixel */
} minkray_channel;

/* Returns how many numbers per pixel a channel has, and if they are integers; both pointers may be
 * NULL. */
MINKRAY_API int minkray_picture_channel(const char* name, uint32_t* numbers, int32_t* is_integer);

/* Size of a picture. Options may be NULL. */
MINKRAY_API int minkray_scene_picture_size(minkray_scene scene,
                                           const minkray_picture_options* options, uint32_t* width,
                                           uint32_t* height);

/* Renders the scene: bit-identical to `minkray render` of an equivalent file, for any number of
 * threads. Added shapes are grey. Both options may be NULL. */
MINKRAY_API int minkray_scene_render(minkray_scene scene, const minkray_picture_options* options,
                                     const minkray_channel* channels, size_t count,
                                     const minkray_options* how);

/* ---- pairs of shapes ------------------------------------------------------------------------- */

typedef enum minkray_distance_status {
  MINKRAY_SEPARATED = 0,
  MINKRAY_TOUCHING = 1, /* 0 is between the bounds */
  MINKRAY_OVERLAPPING = 2,
  MINKRAY_UNDECIDED = 3 /* the bounds hold, but are not within the tolerance */
} minkray_distance_status;

typedef struct minkray_distance {
  double value; /* between lower and upper; minus the depth for an overlap */
  double lower;
  double upper;
  double point_a[3]; /* point_b - point_a = value * normal, up to a sideways error of
                      * sqrt(2 value (upper - lower)); if the shapes touch or overlap, up to 3e-6 of
                      * their sizes */
  double point_b[3];
  double normal[3]; /* unit vector from a to b */
  int32_t status;   /* a minkray_distance_status */
  int32_t supports;
} minkray_distance;

typedef struct minkray_distance_options {
  size_t size;       /* sizeof(minkray_distance_options) */
  double tolerance;  /* largest gap of the bounds, relative to the shapes' sizes; 0: 1e-10 */
  double at_most;    /* beyond this distance a lower bound is enough; 0: unlimited */
  int32_t only_sign; /* 1: only decide if the shapes overlap */
  int32_t reserved;
} minkray_distance_options;

/* Signed distance of two shapes: their distance, or minus their penetration depth. Poses are any
 * invertible maps, NULL for the identity; options may be NULL, too. */
MINKRAY_API int minkray_signed_distance(minkray_shape a, const minkray_pose* pose_a,
                                        minkray_shape b, const minkray_pose* pose_b,
                                        const minkray_distance_options* options,
                                        minkray_distance* distance);

/* Motion of a shape: `velocity` moves its frame's origin, which is the pose's translation; `turn`
 * is a rotation vector about that point (world axes, radians per unit of time). `minkray cast`
 * turns shapes about the same point, unless a query has a `pivot`. */
typedef struct minkray_twist {
  double velocity[3];
  double turn[3];
} minkray_twist;

typedef enum minkray_impact_status {
  MINKRAY_IMPACT = 0,
  MINKRAY_NO_IMPACT = 1, /* proven */
  MINKRAY_BEGINS_INSIDE = 2,
  MINKRAY_IMPACT_UNDECIDED = 3 /* no impact before t_lo; unknown after t_lo */
} minkray_impact_status;

typedef struct minkray_impact {
  double t_lo;     /* no contact before this time (proven); t_max if MINKRAY_NO_IMPACT */
  double t_hi;     /* time of contact; infinite if MINKRAY_NO_IMPACT or MINKRAY_IMPACT_UNDECIDED */
  double distance; /* of the two shapes at t_lo; infinite if unknown, as for a miss of a mesh */
  double point_a[3];
  double point_b[3];
  double normal[3];
  int32_t status; /* a minkray_impact_status */
  int32_t steps;
} minkray_impact;

/* Finds the first contact at times from 0 to t_max, which must be finite. A NULL twist means at
 * rest. */
MINKRAY_API int minkray_time_of_impact(minkray_shape a, const minkray_pose* pose_a,
                                       const minkray_twist* twist_a, minkray_shape b,
                                       const minkray_pose* pose_b, const minkray_twist* twist_b,
                                       double t_max, minkray_impact* impact);

/* ---- robots' paths --------------------------------------------------------------------------- */

typedef struct minkray_clearance_options {
  size_t size;            /* sizeof(minkray_clearance_options) */
  double tolerance;       /* largest gap of the bounds, relative to the clearance; 0: 0.01 */
  int32_t only_obstacles; /* 1: obstacles only, no self-collision */
  int32_t threads;        /* 0: one per core */
  /* For minkray_scene_clearance_derivatives: receives bounds of the error of each number of `jac`.
   * Read if `size` includes it; may be NULL. */
  double* jac_error;
} minkray_clearance_options;

/* The least signed distance along the entire path, not only at samples: between the robot and other
 * objects, and between links of the robot that no joint connects. */
typedef struct minkray_clearance {
  double lower; /* proven lower bound; infinite without other objects */
  double upper; /* reached at `row` */
  double row;   /* 2.25: a quarter of the way from path[2] to path[3] */
  double point_a[3];
  double point_b[3];
  double normal[3];  /* unit vector from a to b */
  uint32_t object_a; /* or a particle: see minkray_scene_size */
  uint32_t object_b;
  int32_t is_settled; /* 0 if the bounds are not within the tolerance */
  int32_t reserved;
} minkray_clearance;

/* Clearance of a robot along a path of `rows` rows of `numbers` joint values each, in the order of
 * minkray_scene_joint, linear between rows. `steps` (or NULL) receives one result per pair of
 * consecutive rows, or one for a single row; `least` (or NULL) receives the least of them. Pairs
 * excluded by minkray_scene_allow or masks are skipped. The option `geometry`, with which the file
 * was added, selects the robot's shapes. With more than 1,000,000 objects and particles, or
 * 10,000,000 pairs, returns MINKRAY_BAD_INPUT. The scene must be committed; the
 * current values of the robot's joints do not matter. */
MINKRAY_API int minkray_scene_clearance(minkray_scene scene, uint32_t group, const double* path,
                                        size_t rows, size_t numbers,
                                        const minkray_clearance_options* options,
                                        minkray_clearance* steps, minkray_clearance* least);

/* Verdict on a motion: proven free of collisions at all times, a collision of a pair, or undecided
 * within the budget. */
enum { MINKRAY_MOTION_FREE = 0, MINKRAY_MOTION_COLLIDES = 1, MINKRAY_MOTION_UNDECIDED = 2 };

typedef struct minkray_verdict_options {
  size_t size;            /* sizeof(minkray_verdict_options) */
  double tolerance;       /* largest gap of the bounds, relative to the clearance; 0: 0.01 */
  double margin;          /* least distance from obstacles; 0: the robot must not touch them */
  size_t budget;          /* distance queries per pair and step; 0: 4000 */
  int32_t only_obstacles; /* 1: obstacles only, no self-collision */
  int32_t threads;        /* 0: one per core */
  /* Read only if `size` covers them. */
  const double* accelerations; /* second derivatives, as many as `rates`; or NULL. Need `rates` */
  const char* proof;           /* file to write a proof to, for minkray-check; or NULL. The proof is
                                * in the frame of the robot's pose */
  const double* times;         /* one per row, increasing; NULL: 0, 1, 2, ... `rates` and
                                * `accelerations` are derivatives with respect to time */
} minkray_verdict_options;

typedef struct minkray_verdict {
  double lower; /* proven lower bound of distance minus margin; -infinity unless free */
  double upper; /* the least clearance found; negative for a collision */
  double row;   /* position of `upper`: 2.25 is a quarter of the way from path[2] to path[3] */
  double begin; /* first interval in which the pair collides, or may collide: like `row` */
  double end;
  double point[3];   /* midpoint between the two objects, or a point inside both */
  uint32_t object_a; /* the pair; MINKRAY_NO_OBJECT if there is none */
  uint32_t object_b;
  int32_t status; /* MINKRAY_MOTION_... */
  int32_t reserved;
} minkray_verdict;

/* Verifies a robot's motion along a path as in minkray_scene_clearance. `rates` (or NULL) has as
 * many numbers as `path`: derivatives of the joint values with respect to time. Joints other than
 * quaternions then move as cubics between rows, or as quintics if accelerations are given. Returns
 * MINKRAY_BAD_INPUT if `proof` is set but a proof is impossible; an undecided motion has no proof.
 */
MINKRAY_API int minkray_scene_verify(minkray_scene scene, uint32_t group, const double* path,
                                     const double* rates, size_t rows, size_t numbers,
                                     const minkray_verdict_options* options,
                                     minkray_verdict* verdict);

#ifdef __cplusplus
}
#endif

#include "minkray/minkray_c_pairs.h"

#endif
