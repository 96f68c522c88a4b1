// SPDX-License-Identifier: MIT
// The distance of two cores: GJK, which goes over to second order where surfaces are curved.
//
// GJK keeps up to four points of C and asks for the support point in the direction d of their
// closest point to the origin; on curved surfaces it converges linearly. Each point lies on a
// piece of the surface that slides when d turns. With S the weighted sum of the pieces'
// derivatives, the closest point of the sliding pieces is, to second order, that of points in the
// metric H = I + S |d| / gap: with H = L L^T, the closest point of the points L^-1 y to the origin,
// by the same simplex code. With S = 0 this is GJK, with one piece it is Newton's method.
//
// Every turn has a lower bound, the plane through the support point, and an upper one, the length
// of the combination of points: what ends the loop is that they meet.
#pragma once

#include <algorithm>

#include "core/contact/core_pair.h"
#include "core/contact/simplex_point.h"

namespace minkray {

template <CoreKind A, CoreKind B>
class CurvedGjk {
 public:
  CurvedGjk(const CorePair& pair, const CoreSearch& search)
      : pair_(pair), search_(search), size_(pair.size()), gap_(search.gap * size_) {
    const bool is_known = pair.a.kind != CoreKind::other && pair.b.kind != CoreKind::other;
    may_slide_ = is_known && (slides(pair.a.kind) || slides(pair.b.kind));
  }

  CoreDistance run() {
    Vec3<double> d = pair_.x;
    if (!(d.squaredNorm() > 0)) d = Vec3<double>::UnitX();
    double squared = std::numeric_limits<double>::infinity();
    int stalls = 0;
    for (int turn = 1; turn <= search_.max_turns; ++turn) {
      const DifferencePoint w = nearest(d);
      const double length = d.norm();
      result_.raise_lower(d.dot(w.c) / length, d / length);
      if (result_.lower > search_.apart) return finish(CoreStatus::separated);
      if (count_ > 0 && length - result_.lower <= gap_) return finish(CoreStatus::separated);
      const int plain_turns = result_.lower > 0 ? turns_apart : turns_near;
      if constexpr (any_slides) {
        if (may_slide_ && count_ > 0 && turn > plain_turns) {
          may_slide_ = false;
          if (slide(d)) return result_;
        }
      }
      for (int i = 0; i < count_; ++i)
        if (y_[i] == w.c) return finish(settled(length));
      if (count_ == 4) return finish(settled(length));
      y_[count_] = w.c;
      a_[count_] = w.a;
      piece_a_[count_] = w.piece_a;
      piece_b_[count_] = w.piece_b;
      ++count_;
      const SimplexPoint closest = closest_of_simplex(y_, count_, true);
      if (closest.kept == 0) return finish(settled(length));
      // Rounding ends what should come nearer with every turn.
      if (!(closest.squared < squared) && (++stalls > 1 || result_.lower > 0)) {
        --count_;
        return finish(settled(length));
      }
      squared = closest.squared;
      keep(closest);
      if (closest.is_inside() || squared <= common_point * common_point * size_ * size_)
        return finish(CoreStatus::overlapping);
      d = closest.v;
    }
    return finish(CoreStatus::unsettled);
  }

 private:
  /// Turns of GJK before pieces slide: with a separating plane, and without one.
  static constexpr int turns_apart = 2, turns_near = 6;
  static constexpr int most_slides = 12;
  /// Points this near to each other, in sizes, are common.
  static constexpr double common_point = 1e-15;
  static constexpr bool any_slides =
      (A == CoreKind::other || slides(A) || slides(B)) || B == CoreKind::other;

  DifferencePoint nearest(const Vec3<double>& d) {
    ++result_.supports;
    return nearest_along<A, B>(pair_, d);
  }

  CoreStatus settled(double length) const {
    if (result_.lower > 0) return CoreStatus::separated;
    return length <= common_point * size_ ? CoreStatus::overlapping : CoreStatus::unsettled;
  }

  /// Keeps the vertices that carry the closest point.
  void keep(const SimplexPoint& closest) {
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      if ((closest.kept >> i & 1u) == 0) continue;
      y_[kept] = y_[i];
      a_[kept] = a_[i];
      piece_a_[kept] = piece_a_[i];
      piece_b_[kept] = piece_b_[i];
      weight_[kept] = closest.weight[i];
      ++kept;
    }
    count_ = kept;
  }

  CoreDistance finish(CoreStatus status) {
    result_.status = status;
    if (count_ > 0) {
      result_.a.setZero();
      result_.c.setZero();
      for (int i = 0; i < count_; ++i) {
        result_.a += weight_[i] * a_[i];
        result_.c += weight_[i] * y_[i];
      }
      result_.upper = result_.c.norm();
    }
    // A plane between the two is a better witness than a simplex as flat as rounding makes it.
    if (status == CoreStatus::overlapping && result_.lower > 0)
      result_.status = CoreStatus::unsettled;
    if (count_ == 3 && status != CoreStatus::overlapping) use_face();
    return result_;
  }

  /// Where the two nearly touch, the closest point is short of digits for a direction; the face
  /// that it lies on is not.
  void use_face() {
    Vec3<double> n = (y_[1] - y_[0]).cross(y_[2] - y_[0]);
    const double length = n.norm();
    if (!(length > 0)) return;
    n *= (n.dot(result_.axis) < 0 ? -1 : 1) / length;
    result_.raise_lower(n.dot(nearest(n).c), n);
    if (result_.status == CoreStatus::unsettled && result_.lower > 0)
      result_.status = CoreStatus::separated;
  }

  /// The answer is this point of A, and c from it. Always true.
  bool end_at(CoreStatus status, const Vec3<double>& a, const Vec3<double>& c) {
    result_.status = status;
    result_.a = a;
    result_.c = c;
    result_.upper = c.norm();
    if (status == CoreStatus::overlapping && result_.lower > 0) {
      result_.status = CoreStatus::unsettled;
      result_.upper = std::numeric_limits<double>::infinity();
    }
    return true;
  }

  bool slide(const Vec3<double>& d);
  bool flat_ends(const Vec3<double>& d);
  template <CoreKind Other>
  bool flat_end(const ShapeCore& disks, const ShapeCore& other, const Mat3<double>& to_other,
                const Vec3<double>& d, bool is_of_a);
  bool is_inside(const Vec3<double>& n, double depth, const int* piece_a, const int* piece_b,
                 const Vec3<double>* z, int count, Vec3<double>& common);

  const CorePair& pair_;
  const CoreSearch& search_;
  double size_, gap_;
  bool may_slide_;
  CoreDistance result_;
  int count_ = 0;
  Vec3<double> y_[4], a_[4];
  int piece_a_[4], piece_b_[4];
  double weight_[4];
};

/// A flat end's axis, where its support point jumps from one side of the rim to the other: it is
/// the answer where the other's nearest point stands over the disk.
template <CoreKind A, CoreKind B>
template <CoreKind Other>
bool CurvedGjk<A, B>::flat_end(const ShapeCore& disks, const ShapeCore& other,
                               const Mat3<double>& to_other, const Vec3<double>& d, bool is_of_a) {
  constexpr double flat = 0.3;  // squared slopes above this do not end on a flat end
  if (!(d.x() * d.x() + d.y() * d.y() < flat * d.z() * d.z())) return false;
  const double sign = d.z() < 0 ? -1 : 1;
  const double rim = sign > 0 ? disks.size.y() : disks.size.x(), half = disks.size.z();
  // The other's nearest point p, in the frame of the disks.
  const Vec3<double> towards(0, 0, -sign);
  ++result_.supports;
  const CoreSupport nearest = support_of_core<Other>(other, to_other * towards);
  const Vec3<double> p = is_of_a ? Vec3<double>(pair_.x + pair_.turn * nearest.point)
                                 : pair_.to_b(nearest.point - pair_.x);
  const double across = p.x() * p.x() + p.y() * p.y();
  if (!(across <= rim * rim)) return false;
  const double gap = sign * p.z() - half;
  const Vec3<double> on_end(p.x(), p.y(), sign * half);
  if (gap > 0) {
    const Vec3<double> n(0, 0, sign);
    result_.lower = gap;
    result_.axis = is_of_a ? n : Vec3<double>(pair_.turn * -n);
    if (is_of_a) return end_at(CoreStatus::separated, on_end, p - on_end);
    return end_at(CoreStatus::separated, nearest.point, pair_.turn * Vec3<double>(on_end - p));
  }
  const double here =
      half > 0 ? disks.size.x() + (disks.size.y() - disks.size.x()) * (p.z() + half) / (2 * half)
               : rim;
  if (!(std::abs(p.z()) <= half) || !(across <= here * here)) return false;
  return end_at(CoreStatus::overlapping, is_of_a ? p : nearest.point, Vec3<double>::Zero());
}

template <CoreKind A, CoreKind B>
bool CurvedGjk<A, B>::flat_ends(const Vec3<double>& d) {
  if constexpr (A == CoreKind::disks || A == CoreKind::other)
    if (pair_.a.kind == CoreKind::disks &&
        flat_end<B>(pair_.a, pair_.b, pair_.turn.transpose(), d, true))
      return true;
  if constexpr (B == CoreKind::disks || B == CoreKind::other)
    if (pair_.b.kind == CoreKind::disks &&
        flat_end<A>(pair_.b, pair_.a, pair_.turn, pair_.to_b(-d), false))
      return true;
  return false;
}

/// Whether the origin is within a tetrahedron of C's middle and three points around n, in whose
/// direction C ends at -depth; `common` is where its weights lead to.
template <CoreKind A, CoreKind B>
bool CurvedGjk<A, B>::is_inside(const Vec3<double>& n, double depth, const int* piece_a,
                                const int* piece_b, const Vec3<double>* z, int count,
                                Vec3<double>& common) {
  const Vec3<double> e0 = n.unitOrthogonal(), e1 = n.cross(e0);
  const auto holds = [&](const Vec3<double>& p, const Vec3<double>& q, const Vec3<double>& r) {
    const Vec3<double> corners[4] = {p, q, r, pair_.x};
    const SimplexPoint closest = closest_of_simplex(corners, 4, false);
    // Rounding may tell wrongly: what it is worth is how near to the origin the weights come.
    common = Vec3<double>::Zero();
    for (int i = 0; i < 4; ++i) common += closest.weight[i] * corners[i];
    return closest.is_inside();
  };
  const auto on_piece = [&](int i, const Vec3<double>& d) -> Vec3<double> {
    return pair_.x + pair_.turn * point_of_piece<B>(pair_.b, piece_b[i], pair_.to_b(-d)) -
           point_of_piece<A>(pair_.a, piece_a[i], d);
  };
  const double turned = std::sqrt(depth / size_) + 1e-9;
  for (const double angle : {0.5 * turned, 5 * turned}) {
    const double c = -0.5 * angle, s = 0.8660254037844386 * angle;
    const Vec3<double> p = nearest(n + angle * e0).c, q = nearest(n + c * e0 + s * e1).c,
                       r = nearest(n + c * e0 - s * e1).c;
    if (holds(p, q, r)) return true;
    if (count == 2) {
      const Vec3<double> across = n.cross(z[1] - z[0]);
      const double length = across.norm();
      if (!(length > 0)) continue;
      const Vec3<double> t = across * (angle / length);
      const Vec3<double> f[4] = {on_piece(0, n - t), on_piece(1, n - t), on_piece(0, n + t),
                                 on_piece(1, n + t)};
      if (holds(f[0], f[1], f[2]) || holds(f[0], f[1], f[3]) || holds(f[0], f[2], f[3]) ||
          holds(f[1], f[2], f[3]))
        return true;
    }
    if (count >= 3 && holds(z[0], z[1], z[2])) return true;
    if (count == 4 &&
        (holds(z[0], z[1], z[3]) || holds(z[0], z[2], z[3]) || holds(z[1], z[2], z[3])))
      return true;
  }
  return false;
}

/// The second order, from the points that GJK has. Returns whether it came to an answer.
template <CoreKind A, CoreKind B>
bool CurvedGjk<A, B>::slide(const Vec3<double>& d) {
  if (flat_ends(d)) return true;
  // Points of one piece are one.
  int count = 0, piece_a[4], piece_b[4];
  double weight[4];
  for (int i = 0; i < count_; ++i) {
    int j = 0;
    while (j < count && (piece_a[j] != piece_a_[i] || piece_b[j] != piece_b_[i])) ++j;
    if (j < count) {
      weight[j] += weight_[i];
    } else {
      piece_a[count] = piece_a_[i];
      piece_b[count] = piece_b_[i];
      weight[count++] = weight_[i];
    }
  }
  Vec3<double> nd = d;
  double damping = 0.1;  // of the first step, in sizes: mixed faces and rims need it
  for (int step = 0; step < most_slides; ++step, damping = step < 7 ? damping * 0.1 : 0) {
    const DifferencePoint w = nearest(nd);
    const double length = nd.norm(), gap = nd.dot(w.c) / length;
    const Vec3<double> n = nd / length;
    result_.raise_lower(gap, n);
    if (result_.lower > search_.apart) {
      result_.status = CoreStatus::separated;
      return true;
    }
    Vec3<double> z[5], v = Vec3<double>::Zero(), on_a = Vec3<double>::Zero();
    Symmetric S;
    bool is_known = false;
    const Vec3<double> of_b = pair_.to_b(-nd);
    for (int i = 0; i < count; ++i) {
      const Vec3<double> a = point_of_piece<A>(pair_.a, piece_a[i], nd),
                         b = point_of_piece<B>(pair_.b, piece_b[i], of_b);
      z[i] = pair_.x + pair_.turn * b - a;
      v += weight[i] * z[i];
      on_a += weight[i] * a;
      is_known |= piece_a[i] == w.piece_a && piece_b[i] == w.piece_b;
      add_curvature<A>(S, weight[i], pair_.a, Mat3<double>::Identity(), piece_a[i], nd, a);
      add_curvature<B>(S, weight[i], pair_.b, pair_.turn, piece_b[i], of_b, b);
    }
    if (v.norm() - result_.lower <= gap_) return end_at(CoreStatus::separated, on_a, v);
    // Where the gap is small or negative, C is moved on until there is one.
    const double least = size_ * std::max(1e-4, damping);
    const double shift = gap > least ? 0 : least - gap;
    if (shift > 0 && gap <= 0 && is_known) {
      constexpr double stationary = 1e-7;
      const Vec3<double> aside = v - v.dot(n) * n;
      if (aside.squaredNorm() < stationary * stationary * size_ * size_) {
        Vec3<double> common;
        if (!is_inside(n, -gap, piece_a, piece_b, z, count, common)) return false;
        return end_at(CoreStatus::overlapping, on_a, common);
      }
    }
    const double scale = length / (gap > least ? gap : least);
    if (!is_known) {
      if (count == 4) return false;
      piece_a[count] = w.piece_a;
      piece_b[count] = w.piece_b;
      z[count] = w.c;
      weight[count++] = 0;
    }
    // H = L L^T, and the points L^-1 z.
    const double l00 = std::sqrt(1 + scale * S.xx), i0 = 1 / l00, l10 = scale * S.xy * i0,
                 l20 = scale * S.xz * i0, l11 = std::sqrt(1 + scale * S.yy - l10 * l10),
                 i1 = 1 / l11, l21 = (scale * S.yz - l20 * l10) * i1,
                 i2 = 1 / std::sqrt(1 + scale * S.zz - l20 * l20 - l21 * l21);
    Vec3<double> mapped[4];
    for (int i = 0; i < count; ++i) {
      const Vec3<double> p = z[i] + shift * n;
      const double x = p.x() * i0, y = (p.y() - l10 * x) * i1;
      mapped[i] = {x, y, (p.z() - l20 * x - l21 * y) * i2};
    }
    const SimplexPoint closest = closest_of_simplex(mapped, count, false);
    if (closest.kept == 0 || closest.is_inside()) return false;
    const double z2 = closest.v.z() * i2, y2 = (closest.v.y() - l21 * z2) * i1;
    nd = {(closest.v.x() - l10 * y2 - l20 * z2) * i0, y2, z2};
    if (!(nd.squaredNorm() > 0)) return false;
    int kept = 0;
    for (int i = 0; i < count; ++i) {
      if ((closest.kept >> i & 1u) == 0) continue;
      piece_a[kept] = piece_a[i];
      piece_b[kept] = piece_b[i];
      weight[kept++] = closest.weight[i];
    }
    count = kept;
  }
  return false;
}

}  // namespace minkray
