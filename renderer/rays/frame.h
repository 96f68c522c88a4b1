// SPDX-License-Identifier: MIT
// Two directions across a unit normal (Duff et al., "Building an Orthonormal Basis, Revisited",
// 2017).
#pragma once

#include "core/math/vec.h"

namespace minkray {

struct Frame {
  Vec3<double> x, y, z;

  explicit Frame(const Vec3<double>& normal) : z(normal) {
    // Neighbouring samples see different patterns where the two halves meet: not at z = 0, where
    // the upright faces are.
    const double sign = z.z() < -0.6 ? -1.0 : 1.0;
    const double a = -1 / (sign + z.z()), b = z.x() * z.y() * a;
    x = {1 + sign * z.x() * z.x() * a, sign * b, -sign * z.x()};
    y = {b, sign + z.y() * z.y() * a, -z.y()};
  }
  /// With y along circles around an axis; where the normal is along the axis, any.
  Frame(const Vec3<double>& normal, const Vec3<double>& axis) : Frame(normal) {
    const Vec3<double> around = axis.cross(normal);
    if (!(around.norm() > 1e-9)) return;
    y = around.normalized();
    x = y.cross(z);
  }
  Vec3<double> to_local(const Vec3<double>& v) const { return {v.dot(x), v.dot(y), v.dot(z)}; }
  Vec3<double> to_world(const Vec3<double>& v) const { return v.x() * x + v.y() * y + v.z() * z; }
};

}  // namespace minkray
