/* SPDX-License-Identifier: MIT
 * A shape of your own in C: the hull of two circles across each other. */
#include <math.h>
#include <minkray/minkray_c.h>
#include <stdio.h>

static int support(void* user, size_t count, const double (*n)[3], double (*p)[3]) {
  const double radius = *(const double*)user;
  for (size_t i = 0; i < count; ++i) {
    const double flat = hypot(n[i][0], n[i][1]), upright = hypot(n[i][0], n[i][2]);
    const int lies = flat > upright; /* which circle reaches further */
    const double length = lies ? flat : upright;
    p[i][0] = radius * n[i][0] / length;
    p[i][1] = lies ? radius * n[i][1] / length : 0;
    p[i][2] = lies ? 0 : radius * n[i][2] / length;
  }
  return 0;
}

int main(void) {
  double radius = 1;
  const minkray_support mine = {.function = support, .user = &radius};
  const minkray_ray ray = {{0.2, 0.3, 5}, {0, 0, -1}, INFINITY};
  minkray_shape shape;
  minkray_hit hit;
  if (minkray_shape_custom(&mine, &shape) || minkray_shape_cast(shape, NULL, &ray, 1, &hit, NULL)) {
    fprintf(stderr, "%s\n", minkray_last_error());
    return 1;
  }
  printf("status %d, t = %.12f, between %.15f and %.15f, %d supports\n", hit.status, hit.t,
         hit.t_lo, hit.t_hi, hit.supports);
  minkray_shape_release(shape);
  return hit.status == MINKRAY_HIT ? 0 : 1;
}
