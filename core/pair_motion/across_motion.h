// SPDX-License-Identifier: MIT
// Derivatives of features' points with respect to the direction, across a motion: symmetric 2 x 2
// matrices over two unit vectors e0 and e1. Same as add_curvature (core_support.h), which has all
// three dimensions.
#pragma once

#include "core/pair/core_support.h"

namespace minkray {

struct AcrossMotion {
  double xx = 0, xy = 0, yy = 0;

  void add(double k, double x, double y) {
    xx += k * x * x;
    xy += k * x * y;
    yy += k * y * y;
  }

  /// Adds `weight` times the derivative of the feature's point at the direction d. All vectors are
  /// in the core's frame.
  template <CoreKind K>
  void add(double weight, const ShapeCore& core, const Vec3<double>& e0, const Vec3<double>& e1,
           int feature, const Vec3<double>& d, const Vec3<double>& point) {
    if constexpr (K == CoreKind::disks) {
      const double rim = feature != 0 ? core.size.y() : core.size.x();
      const double across = d.x() * d.x() + d.y() * d.y();
      if (!(across > 0) || !(rim > 0)) return;
      add(weight * rim / (across * std::sqrt(across)), d.x() * e0.y() - d.y() * e0.x(),
          d.x() * e1.y() - d.y() * e1.x());
    } else if constexpr (K == CoreKind::ellipsoid) {
      const Vec3<double>& r = core.size;
      const double k = weight / r.cwiseProduct(d).norm();
      const Vec3<double> x = r.cwiseProduct(e0), y = r.cwiseProduct(e1);
      xx += k * x.squaredNorm();
      xy += k * x.dot(y);
      yy += k * y.squaredNorm();
      add(-k, e0.dot(point), e1.dot(point));
    } else if constexpr (K == CoreKind::other) {
      if (core.kind == CoreKind::disks)
        add<CoreKind::disks>(weight, core, e0, e1, feature, d, point);
      if (core.kind == CoreKind::ellipsoid)
        add<CoreKind::ellipsoid>(weight, core, e0, e1, feature, d, point);
    }
  }

  /// Adds the derivative of a ball's point, for a unit direction with the components x and y. `k`
  /// is the radius over the direction's length.
  void add_ball(double k, double x, double y) {
    xx += k;
    yy += k;
    add(-k, x, y);
  }
};

}  // namespace minkray
