// SPDX-License-Identifier: MIT
// Jets: a shape's support mapping s(n) to second order (docs/forms.md). In direction n, an
// ellipsoid with the same support point and curvature approximates the shape. For a centre c inside
// the shape, g = s - c, h = n.g and H = ds/dn, the ellipsoid's shape matrix is A = h H + g g^T.
// Jets store a factor F with F F^T = A, since A would lose half of the digits of flat features.
#pragma once

#include <concepts>

#include "core/math/vec.h"

namespace minkray {

/// The ellipsoid { c + F b : |b| <= 1 }; columns of F may be zero. If `exact`, the entire ellipsoid
/// is part of the shape, and is the jet for all directions in which it touches the surface.
/// Otherwise the ellipsoid only osculates in the requested direction, and `s` is the shape's
/// support point. The ellipsoid's own support point may differ from `s` if a radius of curvature is
/// infinite.
template <class W>
struct Jet {
  Vec3<W> c = Vec3<W>::Zero();
  Mat3<W> F = Mat3<W>::Zero();
  Mask<W> exact = Mask<W>(true);
  Vec3<W> s = Vec3<W>::Zero();

  /// The shape's support point in the requested direction n.
  Vec3<W> support(const Vec3<W>& n) const {
    if (!any(exact)) return s;
    return select<W>(exact, Vec3<W>(c + F * unit<W>(F.transpose() * n)), s);
  }
  /// Support function h(n) of the shape: n . support(n), for n of any length.
  W support_function(const Vec3<W>& n) const {
    return select(exact, W(n.dot(c) + (F.transpose() * n).norm()), W(n.dot(s)));
  }
  Mask<W> is_point() const { return F.cwiseAbs().sum() == W(0); }
};

/// Selects a where the condition is true, else b, lane by lane.
template <class W>
Jet<W> select(const Mask<W>& condition, const Jet<W>& a, const Jet<W>& b) {
  Jet<W> chosen;
  chosen.c = select<W>(condition, a.c, b.c);
  for (int k = 0; k < 3; ++k)
    chosen.F.col(k) = select<W>(condition, Vec3<W>(a.F.col(k)), Vec3<W>(b.F.col(k)));
  chosen.exact = (condition & a.exact) | ((!condition) & b.exact);
  chosen.s = select<W>(condition, a.s, b.s);
  return chosen;
}

/// A shape with jets.
template <class S, class T>
concept JetMapped = requires(const S& shape, const Vec3<T>& n) {
  { shape.jet(n) } -> std::convertible_to<Jet<T>>;
};

// Solvers use the more specific jet types of common shapes.

/// A vertex.
template <class W>
struct PointJet {
  Vec3<W> c;
  operator Jet<W>() const { return {c}; }
};

/// A ball with its centre on the z axis.
template <class W>
struct AxialBallJet {
  W z;
  W radius;
  operator Jet<W>() const { return {{W(0), W(0), z}, Mat3<W>::Identity() * radius}; }
};

/// A disk around the z axis; for the radius zero, a point on the axis.
template <class W>
struct AxialDiskJet {
  W z;
  W radius;
  operator Jet<W>() const { return {{W(0), W(0), z}, Vec3<W>(radius, radius, W(0)).asDiagonal()}; }
};

/// An ellipsoid around the origin with its axes along the coordinate axes.
template <class W>
struct AxialEllipsoidJet {
  Vec3<W> radii;
  operator Jet<W>() const { return {Vec3<W>::Zero(), radii.asDiagonal()}; }
};

/// Returns a factor F with F F^T = A, for symmetric positive semidefinite A (Cholesky; values that
/// are negative due to rounding count as zero).
template <class W>
Mat3<W> factor(const Mat3<W>& A) {
  using std::sqrt;
  Mat3<W> F = Mat3<W>::Zero();
  for (int j = 0; j < 3; ++j) {
    W pivot = A(j, j);
    for (int k = 0; k < j; ++k) pivot -= F(j, k) * F(j, k);
    const Mask<W> positive = pivot > W(std::numeric_limits<Lane<W>>::epsilon()) * A(j, j);
    const W root = sqrt(select(positive, pivot, W(1)));
    F(j, j) = select(positive, root, W(0));
    for (int i = j + 1; i < 3; ++i) {
      W entry = A(i, j);
      for (int k = 0; k < j; ++k) entry -= F(i, k) * F(j, k);
      F(i, j) = select(positive, W(entry / root), W(0));
    }
  }
  return F;
}

/// Returns a factor of an ellipsoid that approximates the Minkowski sum of two ellipsoids with a
/// common centre. The returned ellipsoid and the sum have the same reach, support point and
/// curvature in direction n.
template <class W>
Mat3<W> osculating_sum(const Mat3<W>& F_a, const Mat3<W>& F_b, const Vec3<W>& n) {
  const Vec3<W> u_a = F_a.transpose() * n, u_b = F_b.transpose() * n;
  const W h_a = u_a.norm(), h_b = u_b.norm(), h = h_a + h_b;
  const Vec3<W> g_a = F_a * unit<W>(u_a), g_b = F_b * unit<W>(u_b), g = g_a + g_b;
  const W over_a = h / select(h_a > W(0), h_a, W(1)), over_b = h / select(h_b > W(0), h_b, W(1));
  const Mat3<W> A_a = F_a * F_a.transpose(), A_b = F_b * F_b.transpose();
  return factor<W>((A_a - g_a * g_a.transpose()) * over_a + (A_b - g_b * g_b.transpose()) * over_b +
                   g * g.transpose());
}

/// Jet of a Minkowski sum. The sum of an exact jet and a point is exact, and so is the sum of two
/// balls. For two other curved features, the matrices H are added, and the sum only osculates.
template <class W>
Jet<W> add(const Jet<W>& a, const Jet<W>& b, const Vec3<W>& n) {
  using T = Lane<W>;
  const Vec3<W> c = a.c + b.c, s = a.support(n) + b.support(n);
  const auto is_ball = [](const Mat3<W>& F) {
    return (F - Mat3<W>(Mat3<W>::Identity() * F(0, 0))).cwiseAbs().sum() == W(0);
  };
  const Mask<W> a_point = a.is_point(), b_point = b.is_point();
  const Mask<W> balls = is_ball(a.F) & is_ball(b.F);
  // The factor of the sum is a.F + b.F: F of a point is zero, and the radii of two balls add.
  const Mask<W> simple = a_point | b_point | balls;
  const Jet<W> joined{c, Mat3<W>(a.F + b.F), Mask<W>(a.exact & b.exact), s};
  if (all(simple)) return joined;

  Jet<W> sum{c, osculating_sum<W>(a.F, b.F, n), Mask<W>(false), s};
  // A flat feature has almost no extent along its normal. If moved to the other feature's support
  // point, it lies in the sum and touches the sum's supporting plane.
  const W h_a = (a.F.transpose() * n).norm(), h_b = (b.F.transpose() * n).norm();
  const W flat = (h_a + h_b) * W(T(1) / T(1024));
  const Mask<W> a_flat = !(h_a > flat), b_flat = !(h_b > flat);
  if (any(a_flat))
    sum = select<W>(a_flat, Jet<W>{Vec3<W>(a.c + b.support(n)), a.F, a.exact, s}, sum);
  if (any(b_flat))
    sum = select<W>(b_flat & !a_flat, Jet<W>{Vec3<W>(b.c + a.support(n)), b.F, b.exact, s}, sum);
  return any(simple) ? select<W>(simple, joined, sum) : sum;
}

}  // namespace minkray
