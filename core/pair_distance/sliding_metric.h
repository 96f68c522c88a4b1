// SPDX-License-Identifier: MIT
// The metric H = I + scale S of sliding features (sliding_features.h): its adjugate, and its
// factors L L^T.
#pragma once

#include <cmath>

#include "core/pair/core_support.h"

namespace minkray {

/// The adjugate of H = I + scale S: H^-1 times a positive number, without roots or divisions.
inline Symmetric adjugate(const Symmetric& S, double scale) {
  const double xx = 1 + scale * S.xx, yy = 1 + scale * S.yy, zz = 1 + scale * S.zz,
               xy = scale * S.xy, xz = scale * S.xz, yz = scale * S.yz;
  return {yy * zz - yz * yz, xx * zz - xz * xz, xx * yy - xy * xy,
          xz * yz - xy * zz, xy * yz - xz * yy, xy * xz - yz * xx};
}

/// H = I + scale S = L L^T.
struct SlidingMetric {
  double l10, l20, l21, i0, i1, i2;

  SlidingMetric(const Symmetric& S, double scale) {
    const double l00 = std::sqrt(1 + scale * S.xx);
    i0 = 1 / l00;
    l10 = scale * S.xy * i0;
    l20 = scale * S.xz * i0;
    i1 = 1 / std::sqrt(1 + scale * S.yy - l10 * l10);
    l21 = (scale * S.yz - l20 * l10) * i1;
    i2 = 1 / std::sqrt(1 + scale * S.zz - l20 * l20 - l21 * l21);
  }
  /// L^-1 p.
  Vec3<double> into(const Vec3<double>& p) const {
    const double x = p.x() * i0, y = (p.y() - l10 * x) * i1;
    return {x, y, (p.z() - l20 * x - l21 * y) * i2};
  }
  /// L^-T v: converts a closest point in the metric to a direction in space.
  Vec3<double> out_of(const Vec3<double>& v) const {
    const double z = v.z() * i2, y = (v.y() - l21 * z) * i1;
    return {(v.x() - l10 * y - l20 * z) * i0, y, z};
  }
};

}  // namespace minkray
