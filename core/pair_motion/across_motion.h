// SPDX-License-Identifier: MIT
// Curvature across a motion: a symmetric 2 x 2 matrix over two unit vectors e0 and e1. A third as
// many numbers as in space, and the search needs no others.
#pragma once

#include "core/math/vec.h"

namespace minkray {

struct AcrossMotion {
  double xx = 0, xy = 0, yy = 0;

  /// Adds k t t^T for a vector t with the components x and y.
  void add(double k, double x, double y) {
    xx += k * x * x;
    xy += k * x * y;
    yy += k * y * y;
  }
};

/// Adds to a matrix across the motion what is given in the frame of e0 and e1, as Symmetric does
/// (core/pair/core_support.h).
struct AcrossSum {
  AcrossMotion& sum;
  const Vec3<double>&e0, &e1;

  void add(double k, const Vec3<double>& t) { sum.add(k, e0.dot(t), e1.dot(t)); }
  void add_squares(double k, const Vec3<double>& r) {
    const Vec3<double> x = r.cwiseProduct(e0), y = r.cwiseProduct(e1);
    sum.xx += k * x.squaredNorm();
    sum.xy += k * x.dot(y);
    sum.yy += k * y.squaredNorm();
  }
};

}  // namespace minkray
