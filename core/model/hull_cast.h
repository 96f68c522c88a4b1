// SPDX-License-Identifier: MIT
// Casts the ray exactly at the hull of at most four translates of one ball or ellipsoid, in closed
// form (docs/forms.md). The ray runs down the z axis. In a direction m with m.z > 0 the hull's
// supporting plane cuts the axis at height support_function(m)/m.z, and the hit is the least of
// these heights. m.z = 0 with support_function(m) < 0 separates hull and ray.
#pragma once

#include <array>

#include "core/model/hull_bodies.h"
#include "core/query/ray_frame.h"
#include "core/query/tolerances.h"

namespace minkray {

/// The valid centres of the bodies other than the newest one, which was found last.
template <class W>
struct Translates {
  std::array<Vec3<W>, 3> c = {Vec3<W>::Zero(), Vec3<W>::Zero(), Vec3<W>::Zero()};
  std::array<Mask<W>, 3> valid = {Mask<W>(false), Mask<W>(false), Mask<W>(false)};
};

/// The hit on the hull.
template <class W>
struct HullCastHit {
  Vec3<W> m = Vec3<W>::Zero();     ///< of unit length
  Mask<W> found = Mask<W>(false);  ///< hit or separation is certain; otherwise m is the best known
  /// Weights of the other bodies. The newest body's weight is 1 minus their sum.
  std::array<W, 3> weights = {W(0), W(0), W(0)};
  W height = W(std::numeric_limits<Lane<W>>::infinity());  ///< height of the hull's plane
};

/// Solves the cast. Points within `rounding` of the ray count as on it. A candidate for the hit is
/// a plane that touches one, two or three bodies.
template <class W, class Body>
class HullCast {
 public:
  using T = Lane<W>;

  HullCast(const Body& body, const Vec3<W>& newest, const Translates<W>& others, const W& rounding)
      : body_(body),
        newest_(newest),
        others_(others),
        rounding_(rounding),
        beaten_by_(rounding * W(T(1) / T(4))) {}

  /// The newest body is likely to be among the bodies that carry the hit. If another body reaches
  /// beyond a candidate's plane, it is added to the candidate. If this does not lead to the hit,
  /// all candidates are tried, those with the newest body first.
  HullCastHit<W> solve() {
    const Furthest newest = {newest_, W(0), nowhere(), Mask<W>(true)};
    const Furthest second = alone(newest);
    if (all(hit_.found)) return hit_;
    const Furthest third = edge(newest, second);
    if (all(hit_.found)) return hit_;
    face(newest, second, third);
    if (all(hit_.found)) return hit_;
    try_all(newest);
    return hit_;
  }

  /// Same as solve(), if the hit is known in some lanes. In the other lanes, the hit is likely to
  /// be between the newest body and the first of the other bodies.
  HullCastHit<W> solve_from(const HullCastHit<W>& known) {
    hit_ = known;
    if (!all(hit_.found)) edge({newest_, W(0), nowhere(), Mask<W>(true)}, other(0));
    return all(hit_.found) ? hit_ : solve();
  }

 private:
  using Places = std::array<Mask<W>, 3>;

  /// The body that reaches furthest in some direction, if `some` is set.
  struct Furthest {
    Vec3<W> c = Vec3<W>::Zero();
    W h = W(-std::numeric_limits<T>::infinity());
    Places at = {Mask<W>(false), Mask<W>(false), Mask<W>(false)};
    Mask<W> some = Mask<W>(false);
  };

  static Places nowhere() { return {Mask<W>(false), Mask<W>(false), Mask<W>(false)}; }
  Furthest other(std::size_t k) const {
    Places at = nowhere();
    at[k] = Mask<W>(true);
    return {others_.c[k], W(0), at, others_.valid[k]};
  }

  /// Tries all candidates again with a wider margin: a candidate that another body exceeds by
  /// little more than rounding may be the hit after all.
  void try_all(const Furthest& newest) {
    beaten_by_ = rounding_;
    for (std::size_t k = 0; k < 3; ++k) edge(newest, other(k));
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = j + 1; k < 3; ++k) face(newest, other(j), other(k));
    if (all(hit_.found)) return;
    alone(newest);
    for (std::size_t k = 0; k < 3; ++k) alone(other(k));
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = j + 1; k < 3; ++k) edge(other(j), other(k));
    face(other(0), other(1), other(2));
  }

  Furthest furthest_in(const Vec3<W>& m) const {
    Furthest best;
    for (std::size_t k = 0; k < 3; ++k) {
      const W h = others_.c[k].dot(m);
      const Mask<W> further = others_.valid[k] & (h > best.h);
      best.c = select<W>(further, others_.c[k], best.c);
      best.h = select(further, h, best.h);
      for (std::size_t j = 0; j < k; ++j) best.at[j] &= !further;
      best.at[k] = further;
      best.some |= further;
    }
    return best;
  }

  /// Takes the candidate with direction m in lanes where it is better than the hit so far. A
  /// candidate is the hit if its bodies meet the ray (`meets`) and no other body reaches further
  /// than its carrier. Returns the body that reaches furthest, except the newest.
  Furthest consider(const Vec3<W>& m, const Vec3<W>& carrier, const Mask<W>& meets,
                    const std::array<W, 3>& weights, const Mask<W>& candidate) {
    using std::max;
    const Furthest furthest = furthest_in(m);
    const W h = max(newest_.dot(m), furthest.h);
    const Mask<W> unbeaten = !(h - carrier.dot(m) > beaten_by_);
    const W value = h + body_.support_function(m);
    const Mask<W> ahead = m.z() > W(0);
    const W out_of_reach = W(std::numeric_limits<T>::max());
    const W height = select(ahead, W(value / select(ahead, m.z(), W(1))),
                            select(value < W(0), W(-out_of_reach), out_of_reach));
    // A separation by more than rounding is valid even if the bodies do not meet the ray.
    const Mask<W> separates = (!ahead) & ((value < -rounding_) | (meets & (value < W(0))));
    const Mask<W> useful = unbeaten & ((ahead & meets) | separates);
    const Mask<W> wins = candidate & (!hit_.found) & (useful | (height < hit_.height));
    hit_.m = select<W>(wins, m, hit_.m);
    hit_.height = select(wins, height, hit_.height);
    hit_.found |= wins & useful;
    for (std::size_t k = 0; k < 3; ++k) hit_.weights[k] = select(wins, weights[k], hit_.weights[k]);
    return furthest;
  }

  /// Candidate of one body.
  Furthest alone(const Furthest& a) {
    std::array<W, 3> weights;
    for (std::size_t k = 0; k < 3; ++k) weights[k] = select(a.at[k], W(1), W(0));
    return consider(body_.alone(a.c), a.c, Mask<W>(true), weights, a.some);
  }

  /// Candidate of two bodies: the cylinder between them.
  Furthest edge(const Furthest& a, const Furthest& b) {
    using std::sqrt;
    const Mask<W> candidate = a.some & b.some;
    if (!any(candidate & !hit_.found)) return {};
    const Vec3<W> e = a.c - b.c;
    const W E = e.x() * e.x() + e.y() * e.y();
    const W length = sqrt(E);
    Vec3<W> touch;
    const Vec3<W> m = body_.swept(a.c, e, length, touch);
    const W x = b.c.x() + touch.x(), y = b.c.y() + touch.y();
    W share = -(x * e.x() + y * e.y()) / E;
    const W slack = rounding_ / length;
    Mask<W> meets = (share >= -slack) & (share <= W(1) + slack);
    body_.between_disks(m, b.c, e, share, meets);
    std::array<W, 3> weights;
    for (std::size_t k = 0; k < 3; ++k)
      weights[k] = select(a.at[k], share, select(b.at[k], W(W(1) - share), W(0)));
    return consider(m, a.c, meets, weights, candidate & (E > W(0)));
  }

  /// Candidate of three bodies: the plane that touches them.
  void face(const Furthest& a, const Furthest& b, const Furthest& c) {
    Mask<W> candidate = a.some & b.some & c.some;
    for (std::size_t k = 0; k < 3; ++k) candidate &= !(b.at[k] & c.at[k]);
    if (!any(candidate & !hit_.found)) return;
    const Vec3<W> m = upper_normal(a.c, b.c, c.c);
    const Vec3<W> touch = body_.support_point(m);
    const Vec3<W> at_a = a.c + touch, at_b = b.c + touch, at_c = c.c + touch;
    const Mask<W> meets = passes_between(at_a, at_b, at_c) | passes_edge(at_a, at_b, rounding_) |
                          passes_edge(at_b, at_c, rounding_) | passes_edge(at_c, at_a, rounding_);
    const W of_a = cross_2d(at_b, at_c), of_b = cross_2d(at_c, at_a), of_c = cross_2d(at_a, at_b);
    const W sum = of_a + of_b + of_c;
    std::array<W, 3> weights;
    for (std::size_t k = 0; k < 3; ++k)
      weights[k] = select(a.at[k], W(of_a / sum),
                          select(b.at[k], W(of_b / sum), select(c.at[k], W(of_c / sum), W(0))));
    consider(m, a.c, meets, weights, candidate & (m.z() > W(0)) & (sum != W(0)));
  }

  Body body_;
  Vec3<W> newest_;
  const Translates<W>& others_;
  W rounding_;
  /// Margin by which another body may reach beyond a candidate's carrier. The candidate's plane is
  /// moved out to that body, so the hit is too early by this distance. Initially the rounding of
  /// two reaches, a quarter of rounding_.
  W beaten_by_;
  HullCastHit<W> hit_;
};

}  // namespace minkray
