// SPDX-License-Identifier: MIT
// Jets: a shape's support mapping to second order. In direction n a shape looks like an ellipsoid
// that agrees with it in support point and curvature; shapes made of flat faces, straight edges and
// pieces of ellipsoids ARE the hull of finitely many such pieces.
//
// With h(n) = n.s(n), c an interior point and H = ds/dn, the ellipsoid of shape matrix
// A = h H + g g^T, g = s - c, around c has the same h, s and H at n. docs/theory.md derives how
// jets compose; a factor A = F F^T is kept, since A itself loses half of the digits of flat pieces.
#pragma once

#include <concepts>

#include "core/math/vec.h"

namespace minkray {

/// The ellipsoid { c + F b : |b| <= 1 }; columns of F may be zero. `exact` says that the ellipsoid
/// is part of the shape as a whole (the same one for all directions that it answers), not only
/// osculating in the direction asked for; then `s` is the shape's support point there, and the
/// ellipsoid may agree with it less well than the mathematics says (where a radius of curvature is
/// infinite).
template <class W>
struct Jet {
  Vec3<W> c = Vec3<W>::Zero();
  Mat3<W> F = Mat3<W>::Zero();
  bool exact = true;
  Vec3<W> s = Vec3<W>::Zero();

  /// The shape's support point in the direction n that was asked for.
  Vec3<W> support(const Vec3<W>& n) const {
    return exact ? Vec3<W>(c + F * unit<W>(F.transpose() * n)) : s;
  }
  /// How far the shape reaches along that n, in lengths of n.
  W reach(const Vec3<W>& n) const {
    return exact ? n.dot(c) + (F.transpose() * n).norm() : n.dot(s);
  }
  bool is_point() const { return (F.array() == W(0)).all(); }
};

/// A shape that knows its jets.
template <class S, class T>
concept JetMapped = requires(const S& shape, const Vec3<T>& n) {
  { shape.jet(n) } -> std::convertible_to<Jet<T>>;
};

// The jets of common shapes say more in their types: solvers make use of it.

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

/// A disk around the z axis; of radius zero, a point on it.
template <class W>
struct AxialDiskJet {
  W z;
  W radius;
  operator Jet<W>() const {
    return {{W(0), W(0), z}, Vec3<W>(radius, radius, W(0)).asDiagonal()};
  }
};

/// An ellipsoid around the origin with its axes along the coordinate axes.
template <class W>
struct AxialEllipsoidJet {
  Vec3<W> radii;
  operator Jet<W>() const { return {Vec3<W>::Zero(), radii.asDiagonal()}; }
};

/// A factor F with F F^T = A, for symmetric positive semidefinite A (Cholesky; what rounding makes
/// negative counts as zero).
template <class W>
Mat3<W> factor(const Mat3<W>& A) {
  using std::sqrt;
  Mat3<W> F = Mat3<W>::Zero();
  for (int j = 0; j < 3; ++j) {
    W pivot = A(j, j);
    for (int k = 0; k < j; ++k) pivot -= F(j, k) * F(j, k);
    if (!(pivot > std::numeric_limits<W>::epsilon() * A(j, j))) continue;
    F(j, j) = sqrt(pivot);
    for (int i = j + 1; i < 3; ++i) {
      W entry = A(i, j);
      for (int k = 0; k < j; ++k) entry -= F(i, k) * F(j, k);
      F(i, j) = entry / F(j, j);
    }
  }
  return F;
}

/// The jet of a Minkowski sum. A sum with a point stays exact, as does the sum of two balls; of two
/// curved pieces the curvatures H add, and the sum only osculates.
template <class W>
Jet<W> add(const Jet<W>& a, const Jet<W>& b, const Vec3<W>& n) {
  const Vec3<W> c = a.c + b.c, s = a.support(n) + b.support(n);
  if (b.is_point()) return {c, a.F, a.exact, s};
  if (a.is_point()) return {c, b.F, b.exact, s};
  const auto is_ball = [](const Mat3<W>& F) { return F == Mat3<W>::Identity() * F(0, 0); };
  if (is_ball(a.F) && is_ball(b.F)) return {c, a.F + b.F, a.exact && b.exact, s};

  const Vec3<W> u_a = a.F.transpose() * n, u_b = b.F.transpose() * n;
  const W h_a = u_a.norm(), h_b = u_b.norm();
  const Vec3<W> g_a = a.F * unit(u_a), g_b = b.F * unit(u_b);
  const W h = h_a + h_b;
  // A flat piece seen along its normal has no curvature to speak of: the piece as a whole, moved to
  // the other's support point, lies in the sum and touches its plane.
  constexpr W flat = W(1) / W(1024);
  if (!(h_a > flat * h)) return {a.c + b.support(n), a.F, a.exact, s};
  if (!(h_b > flat * h)) return {b.c + a.support(n), b.F, b.exact, s};
  const Mat3<W> A_a = a.F * a.F.transpose(), A_b = b.F * b.F.transpose();
  const Vec3<W> g = g_a + g_b;
  const Mat3<W> A = (h / h_a) * (A_a - g_a * g_a.transpose()) +
                    (h / h_b) * (A_b - g_b * g_b.transpose()) + g * g.transpose();
  return {c, factor(A), false, s};
}

}  // namespace minkray
