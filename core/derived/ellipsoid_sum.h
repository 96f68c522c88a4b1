// SPDX-License-Identifier: MIT
// Jets (local models of a surface, core/support/jet.h) that are sums of ellipsoids, stored as a
// list. The Minkowski sum of two curved features is not an ellipsoid, so a single ellipsoid can
// only osculate it. The list represents the sum exactly, by its support function h(n) = c.n +
// sum |F_k^T n|. Nearly every shape is the hull of finitely many such sums.
#pragma once

#include <array>

#include "core/shape/shape.h"
#include "core/support/jet.h"
#include "core/support/surface.h"

namespace minkray {

/// The points { c + sum F_k b_k : |b_k| <= 1 }, for a direction n: the part of a shape that
/// contains the support point in that direction.
template <class W>
struct EllipsoidSum {
  /// Maximum number of ellipsoids. Further ones are joined with the last one, which then osculates.
  static constexpr std::size_t most = 4;

  Vec3<W> c = Vec3<W>::Zero();
  std::array<Mat3<W>, most> F = {Mat3<W>::Zero(), Mat3<W>::Zero(), Mat3<W>::Zero(),
                                 Mat3<W>::Zero()};  ///< columns may be zero
  std::size_t used = 0;                             ///< F is zero from this index on
  Mask<W> exact = Mask<W>(true);                    ///< true: the sum is part of the shape
  Vec3<W> s = Vec3<W>::Zero();                      ///< the shape's support point in direction n
  /// If `exact`, the same as c. Otherwise the centre of the jets, which is the same for all
  /// ellipsoids that osculate one patch.
  Vec3<W> patch = Vec3<W>::Zero();

  /// Support function h(n), for n of any length.
  W support_function(const Vec3<W>& n) const {
    W reach = c.dot(n);
    for (std::size_t k = 0; k < used; ++k) reach += (F[k].transpose() * n).norm();
    return reach;
  }

  /// Adds the ellipsoid with the factor `other`. Ellipsoids of the same proportions become one.
  /// Each lane decides separately, so that no lane depends on the others.
  void add(const Mat3<W>& other, const Vec3<W>& n) {
    Mask<W> left = other.cwiseAbs().sum() > W(0);
    for (std::size_t k = 0; k < most && any(left); ++k) {
      const W mine = F[k].trace(), its = other.trace();
      const Mask<W> fits =
          (F[k].cwiseAbs().sum() == W(0)) |
          ((mine * its > W(0)) & ((F[k] * its - other * mine).cwiseAbs().sum() == W(0)));
      const Mask<W> here = left & fits;
      if (!any(here)) continue;
      for (int j = 0; j < 3; ++j)
        F[k].col(j) = select<W>(here, Vec3<W>(F[k].col(j) + other.col(j)), Vec3<W>(F[k].col(j)));
      used = std::max(used, k + 1);
      left &= !here;
    }
    if (!any(left)) return;
    const Mat3<W> joined = osculating_sum<W>(F[most - 1], other, n);
    for (int j = 0; j < 3; ++j)
      F[most - 1].col(j) = select<W>(left, Vec3<W>(joined.col(j)), Vec3<W>(F[most - 1].col(j)));
    exact &= !left;
  }
};

/// Selects a where the condition is true, else b, lane by lane.
template <class W>
EllipsoidSum<W> select(const Mask<W>& condition, const EllipsoidSum<W>& a,
                       const EllipsoidSum<W>& b) {
  EllipsoidSum<W> chosen;
  chosen.c = select<W>(condition, a.c, b.c);
  chosen.used = std::max(a.used, b.used);
  for (std::size_t k = 0; k < chosen.used; ++k)
    for (int j = 0; j < 3; ++j)
      chosen.F[k].col(j) = select<W>(condition, Vec3<W>(a.F[k].col(j)), Vec3<W>(b.F[k].col(j)));
  chosen.exact = (condition & a.exact) | ((!condition) & b.exact);
  chosen.s = select<W>(condition, a.s, b.s);
  chosen.patch = select<W>(condition, a.patch, b.patch);
  return chosen;
}

/// The Minkowski sum, in direction n.
template <class W>
EllipsoidSum<W> sum_of(EllipsoidSum<W> a, const EllipsoidSum<W>& b, const Vec3<W>& n) {
  a.c += b.c;
  a.s += b.s;
  a.patch += b.patch;
  a.exact &= b.exact;
  for (std::size_t k = 0; k < b.used; ++k) a.add(b.F[k], n);
  return a;
}

template <class W>
EllipsoidSum<W> touching_sum(const Shape& shape, const Vec3<W>& n);

namespace detail {

/// For shapes whose jets are ellipsoids. An ellipsoid that only osculates is moved so that it
/// touches the shape at the support point.
template <class W, class S>
EllipsoidSum<W> sum_of_kind(const S& shape, const Vec3<W>& n) {
  const Jet<W> jet = shape.jet(n);
  EllipsoidSum<W> sum;
  sum.s = jet.support(n);
  sum.exact = jet.exact | jet.is_point();
  sum.c = select<W>(jet.exact, jet.c, Vec3<W>(jet.s - jet.F * unit<W>(jet.F.transpose() * n)));
  sum.patch = jet.c;
  sum.add(jet.F, n);
  return sum;
}

template <class W>
EllipsoidSum<W> sum_of_kind(const Rounded& shape, const Vec3<W>& n) {
  EllipsoidSum<W> sum = touching_sum<W>(*shape.shape, n);
  sum.s += unit<W>(n) * W(shape.radius);
  sum.add(Mat3<W>(Mat3<W>::Identity() * W(shape.radius)), n);
  return sum;
}

template <class W>
EllipsoidSum<W> sum_of_kind(const MinkowskiSum& sum, const Vec3<W>& n) {
  EllipsoidSum<W> total = touching_sum<W>(*sum.shapes.front(), n);
  for (std::size_t i = 1; i < sum.shapes.size(); ++i)
    total = sum_of<W>(total, touching_sum<W>(*sum.shapes[i], n), n);
  return total;
}

template <class W>
EllipsoidSum<W> sum_of_kind(const MinkowskiDifference& obstacle, const Vec3<W>& n) {
  EllipsoidSum<W> mirrored = touching_sum<W>(*obstacle.b, Vec3<W>(-n));
  mirrored.c = -mirrored.c;
  mirrored.s = -mirrored.s;
  mirrored.patch = -mirrored.patch;
  return sum_of<W>(touching_sum<W>(*obstacle.a, n), mirrored, n);
}

template <class W>
EllipsoidSum<W> sum_of_kind(const HullOf& hull, const Vec3<W>& n) {
  EllipsoidSum<W> best = touching_sum<W>(*hull.shapes.front(), n);
  W furthest = best.s.dot(n);
  for (std::size_t i = 1; i < hull.shapes.size(); ++i) {
    const EllipsoidSum<W> other = touching_sum<W>(*hull.shapes[i], n);
    const W along = other.s.dot(n);
    const Mask<W> further = along > furthest;
    best = select<W>(further, other, best);
    furthest = select(further, along, furthest);
  }
  return best;
}

template <class W>
EllipsoidSum<W> sum_of_kind(const Transform& moved, const Vec3<W>& n) {
  EllipsoidSum<W> sum = touching_sum<W>(*moved.shape, moved.map.inner_direction(n));
  sum.c = moved.map(sum.c);
  sum.s = moved.map(sum.s);
  sum.patch = moved.map(sum.patch);
  for (std::size_t k = 0; k < sum.used; ++k) sum.F[k] = moved.template mapped_factor<W>(sum.F[k]);
  return sum;
}

}  // namespace detail

/// Returns the part of the shape that touches the supporting plane with the normal n.
template <class W>
EllipsoidSum<W> touching_sum(const Shape& shape, const Vec3<W>& n) {
  return std::visit([&](const auto& kind) { return detail::sum_of_kind<W>(kind, n); }, shape.kind);
}

/// True if the shape seems to be the hull of exact sums. Tests only a few directions.
inline bool has_exact_sums(const Shape& shape) {
  for (int i = 0; i < tilted_directions; ++i)
    if (!touching_sum<double>(shape, tilted_direction<double>(i)).exact) return false;
  return true;
}

/// True if the shape seems to be a single exact sum without flat summands. Tests only a few
/// directions.
inline bool is_ellipsoid_sum(const Shape& shape) {
  const EllipsoidSum<double> first = touching_sum<double>(shape, tilted_direction<double>(0));
  if (first.used == 0) return false;
  for (std::size_t k = 0; k < first.used; ++k)
    if (first.F[k].col(2).isZero(0)) return false;
  for (int i = 0; i < tilted_directions; ++i) {
    const EllipsoidSum<double> sum = touching_sum<double>(shape, tilted_direction<double>(i));
    if (!sum.exact || sum.c != first.c || sum.F != first.F) return false;
  }
  return true;
}

}  // namespace minkray
