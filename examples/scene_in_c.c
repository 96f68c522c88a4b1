/* SPDX-License-Identifier: MIT
 * A scene in C: two shapes, a ray, and the report of an error. */
#include <math.h>
#include <minkray/minkray_c.h>
#include <stdio.h>

static int failed(void) {
  fprintf(stderr, "%s\n", minkray_last_error());
  return 1;
}

int main(void) {
  const double radius = 0.5, half_extents[] = {1, 2, 0.25};
  const minkray_parameter of_sphere = {"radius", &radius, 1, NULL, 0};
  const minkray_parameter of_box = {"half_extents", half_extents, 3, NULL, 0};
  const minkray_pose above = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 2}}};
  const minkray_ray ray = {{0, 0, 9}, {0, 0, -1}, INFINITY};
  minkray_shape sphere, box;
  minkray_scene scene;
  minkray_hit hit;
  const char* name = "";
  if (minkray_shape_make("sphere", &of_sphere, 1, &sphere) ||
      minkray_shape_make("box", &of_box, 1, &box) || minkray_scene_make(&scene) ||
      minkray_scene_add(scene, sphere, &above, "ball", NULL) ||
      minkray_scene_add(scene, box, NULL, "table", NULL) || minkray_scene_commit(scene) ||
      minkray_scene_cast(scene, &ray, 1, &hit, NULL) ||
      minkray_scene_name(scene, hit.object, &name))
    return failed();
  printf("Minkray %s: %s at t = %.17g\n", minkray_version(), name, hit.t);
  minkray_shape_release(sphere);
  minkray_shape_release(box);
  minkray_scene_release(scene);
  return hit.t == 6.5 ? 0 : 1;
}
