// SPDX-License-Identifier: MIT
// Finds the point of a simplex (up to four points) that is closest to the origin, and its weights.
// Tests only the faces whose outer side contains the origin (C. Ericson, "Real-Time Collision
// Detection", 2005, section 5.1). The determinants share their cross products.
#pragma once

#include <limits>

#include "core/math/vec.h"

namespace minkray {

/// The closest point found so far.
struct SimplexPoint {
  Vec3<double> v = Vec3<double>::Zero();                     ///< the point
  double squared = std::numeric_limits<double>::infinity();  ///< |v|^2
  double weight[4] = {0, 0, 0, 0};
  unsigned kept = 0;  ///< bit i is set if weight[i] is not 0

  void take(const Vec3<double>& point, unsigned vertices) {
    v = point;
    squared = point.squaredNorm();
    weight[0] = weight[1] = weight[2] = weight[3] = 0;
    kept = vertices;
  }
  bool is_inside() const { return kept == 15; }
};

inline void try_edge(const Vec3<double>* y, int a, int b, SimplexPoint& best) {
  const Vec3<double> e = y[b] - y[a];
  const double length = e.squaredNorm(), t = -y[a].dot(e);
  const double u = !(t > 0) ? 0 : (t >= length ? 1 : t / length);
  const Vec3<double> point = y[a] + u * e;
  if (!(point.squaredNorm() < best.squared)) return;
  best.take(point, u == 0 ? 1u << a : (u == 1 ? 1u << b : (1u << a) | (1u << b)));
  best.weight[b] = u;
  best.weight[a] = 1 - u;
}

/// Updates the closest point by the interior and the edges of the triangle with the vertices y[a],
/// y[b] and y[c]. If `newest_only`, skips edges without y[c], the newest vertex.
[[gnu::noinline]] inline void try_triangle(const Vec3<double>* y, int a, int b, int c,
                                           bool newest_only, SimplexPoint& best) {
  const Vec3<double> n = (y[b] - y[a]).cross(y[c] - y[a]);
  const double squared = n.squaredNorm();
  const double wa = n.dot(y[b].cross(y[c])), wb = n.dot(y[c].cross(y[a])),
               wc = n.dot(y[a].cross(y[b]));
  if (wa > 0 && wb > 0 && wc > 0 && squared > 0) {
    const Vec3<double> point = (n.dot(y[a]) / squared) * n;
    if (!(point.squaredNorm() < best.squared)) return;
    best.take(point, (1u << a) | (1u << b) | (1u << c));
    const double s = 1 / (wa + wb + wc);
    best.weight[a] = wa * s;
    best.weight[b] = wb * s;
    best.weight[c] = wc * s;
    return;
  }
  if (!(wa > 0)) try_edge(y, b, c, best);
  if (!(wb > 0)) try_edge(y, c, a, best);
  if (!newest_only && !(wc > 0)) try_edge(y, a, b, best);
}

/// Returns the closest point of the simplex y[0] to y[n - 1], with n from 1 to 4. If
/// `newest_only`, skips faces without y[n - 1]. If rounding rules out every face, `kept` is 0.
[[gnu::noinline]] inline SimplexPoint closest_of_simplex(const Vec3<double>* y, int n,
                                                         bool newest_only) {
  SimplexPoint best;
  if (n == 1) {
    best.take(y[0], 1);
    best.weight[0] = 1;
    return best;
  }
  if (n == 2) {
    try_edge(y, 0, 1, best);
    return best;
  }
  if (n == 3) {
    try_triangle(y, 0, 1, 2, newest_only, best);
    return best;
  }
  const Vec3<double> a = y[0] - y[3], b = y[1] - y[3], c = y[2] - y[3];
  const Vec3<double> bc = b.cross(c), ca = c.cross(a), ab = a.cross(b);
  const double determinant = a.dot(bc), sign = determinant < 0 ? -1 : 1,
               volume = std::abs(determinant);
  const double w0 = -sign * y[3].dot(bc), w1 = -sign * y[3].dot(ca), w2 = -sign * y[3].dot(ab),
               w3 = volume - w0 - w1 - w2;
  if (w0 >= 0 && w1 >= 0 && w2 >= 0 && w3 >= 0 && volume > 0) {
    best.take(Vec3<double>::Zero(), 15);
    best.weight[0] = w0 / volume;
    best.weight[1] = w1 / volume;
    best.weight[2] = w2 / volume;
    best.weight[3] = w3 / volume;
    return best;
  }
  if (!(w0 > 0)) try_triangle(y, 1, 2, 3, newest_only, best);
  if (!(w1 > 0)) try_triangle(y, 0, 2, 3, newest_only, best);
  if (!(w2 > 0)) try_triangle(y, 0, 1, 3, newest_only, best);
  if (!newest_only && !(w3 > 0)) try_triangle(y, 0, 1, 2, false, best);
  return best;
}

}  // namespace minkray
