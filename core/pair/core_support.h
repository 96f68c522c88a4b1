// SPDX-License-Identifier: MIT
// Support mapping of a core, for solvers of pairs. Each support point comes with its feature: the
// part of the surface (a vertex, a rim, an ellipsoid) that it lies on. Also gives the furthest
// point of a given feature, and that point's derivative with respect to the direction. The core's
// kind is a template parameter, so that solvers are compiled per kind; `CoreKind::other` looks up
// the kind per call.
#pragma once

#include "core/pair/hull_scan.h"

namespace minkray {

/// A support point, and the number of the feature that it lies on.
struct CoreSupport {
  Vec3<double> point;
  int feature;
};

/// Calls f.template operator()<K>() for the core's kind K.
template <class F>
auto with_core_kind(CoreKind kind, F&& f) {
  switch (kind) {
    case CoreKind::point:
      return f.template operator()<CoreKind::point>();
    case CoreKind::segment:
      return f.template operator()<CoreKind::segment>();
    case CoreKind::box:
      return f.template operator()<CoreKind::box>();
    case CoreKind::hull:
      return f.template operator()<CoreKind::hull>();
    case CoreKind::disks:
      return f.template operator()<CoreKind::disks>();
    case CoreKind::ellipsoid:
      return f.template operator()<CoreKind::ellipsoid>();
    case CoreKind::other:
      break;
  }
  return f.template operator()<CoreKind::other>();
}

/// True if cores of this kind have curved features. When the direction turns, support points slide
/// along such a feature (`add_curvature`).
constexpr bool slides(CoreKind kind) {
  return kind == CoreKind::disks || kind == CoreKind::ellipsoid;
}

/// Returns the feature's furthest point along d, which may have any length except zero.
template <CoreKind K>
inline Vec3<double> point_of_feature(const ShapeCore& core, int feature, const Vec3<double>& d) {
  const Vec3<double>& size = core.size;
  if constexpr (K == CoreKind::point) {
    return {0, 0, 0};
  } else if constexpr (K == CoreKind::segment) {
    return {0, 0, feature != 0 ? size.z() : -size.z()};
  } else if constexpr (K == CoreKind::box) {
    return {(feature & 1) != 0 ? -size.x() : size.x(), (feature & 2) != 0 ? -size.y() : size.y(),
            (feature & 4) != 0 ? -size.z() : size.z()};
  } else if constexpr (K == CoreKind::hull) {
    return {core.x[feature], core.y[feature], core.z[feature]};
  } else if constexpr (K == CoreKind::disks) {
    const double rim = feature != 0 ? size.y() : size.x(), z = feature != 0 ? size.z() : -size.z();
    const double across = d.x() * d.x() + d.y() * d.y();
    if (!(across > 0)) return {rim, 0, z};
    const double k = rim / std::sqrt(across);
    return {k * d.x(), k * d.y(), z};
  } else if constexpr (K == CoreKind::ellipsoid) {
    const Vec3<double> e = size.cwiseProduct(d);
    return size.cwiseProduct(e) / e.norm();
  } else if (core.kind == CoreKind::other) {
    return core.shape->support(d);
  } else {
    return with_core_kind(core.kind, [&]<CoreKind Known>() -> Vec3<double> {
      if constexpr (Known == CoreKind::other)
        return core.shape->support(d);
      else
        return point_of_feature<Known>(core, feature, d);
    });
  }
}

/// Returns the core's furthest point along d, which may have any length except zero.
template <CoreKind K>
inline CoreSupport support_of_core(const ShapeCore& core, const Vec3<double>& d) {
  if constexpr (K == CoreKind::point || K == CoreKind::ellipsoid) {
    return {point_of_feature<K>(core, 0, d), 0};
  } else if constexpr (K == CoreKind::segment) {
    const int feature = d.z() > 0 ? 1 : 0;
    return {point_of_feature<K>(core, feature, d), feature};
  } else if constexpr (K == CoreKind::box) {
    const Vec3<double>& h = core.size;
    const int feature = (std::signbit(d.x()) ? 1 : 0) | (std::signbit(d.y()) ? 2 : 0) |
                        (std::signbit(d.z()) ? 4 : 0);
    return {{std::copysign(h.x(), d.x()), std::copysign(h.y(), d.y()), std::copysign(h.z(), d.z())},
            feature};
  } else if constexpr (K == CoreKind::hull) {
    const int feature = furthest_of_hull(core, d.x(), d.y(), d.z());
    return {{core.x[feature], core.y[feature], core.z[feature]}, feature};
  } else if constexpr (K == CoreKind::disks) {
    const Vec3<double>& size = core.size;
    const double across = std::sqrt(d.x() * d.x() + d.y() * d.y());
    const bool above = 2 * size.z() * d.z() + (size.y() - size.x()) * across > 0;
    const double rim = above ? size.y() : size.x(), z = above ? size.z() : -size.z();
    if (!(across > 0)) return {{rim, 0, z}, above ? 1 : 0};
    const double k = rim / across;
    return {{k * d.x(), k * d.y(), z}, above ? 1 : 0};
  } else if (core.kind == CoreKind::other) {
    return {core.shape->support(d), 0};
  } else {
    return with_core_kind(core.kind, [&]<CoreKind Known>() -> CoreSupport {
      if constexpr (Known == CoreKind::other)
        return {core.shape->support(d), 0};
      else
        return support_of_core<Known>(core, d);
    });
  }
}

/// A symmetric 3 x 3 matrix, to which outer products k t t^T are added.
struct Symmetric {
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;

  void add(double k, const Vec3<double>& t) {
    xx += k * t.x() * t.x();
    yy += k * t.y() * t.y();
    zz += k * t.z() * t.z();
    xy += k * t.x() * t.y();
    xz += k * t.x() * t.z();
    yz += k * t.y() * t.z();
  }
  /// Adds k times the diagonal matrix of the squares of r.
  void add_squares(double k, const Vec3<double>& r) {
    xx += k * r.x() * r.x();
    yy += k * r.y() * r.y();
    zz += k * r.z() * r.z();
  }
  void add_all(double k, const Symmetric& other) {
    xx += k * other.xx;
    yy += k * other.yy;
    zz += k * other.zz;
    xy += k * other.xy;
    xz += k * other.xz;
    yz += k * other.yz;
  }
  Vec3<double> operator*(const Vec3<double>& a) const {
    return {xx * a.x() + xy * a.y() + xz * a.z(), xy * a.x() + yy * a.y() + yz * a.z(),
            xz * a.x() + yz * a.y() + zz * a.z()};
  }
};

/// Adds to a matrix in A's frame what is given in B's frame; `turn` rotates B's frame to A's.
struct TurnedSum {
  Symmetric& sum;
  const Mat3<double>& turn;

  void add(double k, const Vec3<double>& t) { sum.add(k, turn * t); }
  void add_squares(double k, const Vec3<double>& r) {
    for (int i = 0; i < 3; ++i) sum.add(k * r[i] * r[i], turn.col(i));
  }
};

/// Adds `weight` times the derivative of the feature's point with respect to the direction d to
/// `sum`, in the core's frame. `point` is the feature's point.
template <CoreKind K, class Sum>
inline void add_curvature(Sum&& sum, double weight, const ShapeCore& core, int feature,
                          const Vec3<double>& d, const Vec3<double>& point) {
  if constexpr (K == CoreKind::disks) {
    const double rim = feature != 0 ? core.size.y() : core.size.x();
    const double across = d.x() * d.x() + d.y() * d.y();
    if (!(across > 0) || !(rim > 0)) return;
    sum.add(weight * rim / (across * std::sqrt(across)), {-d.y(), d.x(), 0});
  } else if constexpr (K == CoreKind::ellipsoid) {
    const Vec3<double>& r = core.size;
    const double k = weight / r.cwiseProduct(d).norm();
    sum.add_squares(k, r);
    sum.add(-k, point);
  } else if constexpr (K == CoreKind::other) {
    if (core.kind == CoreKind::disks)
      add_curvature<CoreKind::disks>(sum, weight, core, feature, d, point);
    if (core.kind == CoreKind::ellipsoid)
      add_curvature<CoreKind::ellipsoid>(sum, weight, core, feature, d, point);
  }
}

}  // namespace minkray
