// SPDX-License-Identifier: MIT
// Casting the ray exactly on the hull of at most four translates of one ball or ellipsoid: in
// closed form. docs/theory.md derives it.
//
// Frame: the ray runs down the z axis, from +z to -z. In a direction m with m.z > 0 the hull's
// supporting plane cuts the axis at height reach(m)/m.z, and the hit is the least of these heights.
// m.z = 0 with reach(m) < 0 separates hull and ray.
#pragma once

#include <array>

#include "core/query/ray_frame.h"
#include "core/query/tolerances.h"

namespace minkray {

/// What translates of one body look like: a ball.
template <class W>
struct RoundBody {
  W radius;

  /// How far it reaches along m, of unit length but for rounding.
  W bend(const Vec3<W>& m) const { return radius * (W(Lane<W>(0.5)) * (W(1) + m.squaredNorm())); }
  Vec3<W> spot(const Vec3<W>& m) const { return m * radius; }

  /// The normal, of unit length, where the ray meets the body around c, or across from it.
  Vec3<W> alone(const Vec3<W>& c) const {
    using std::max;
    using std::sqrt;
    const W den = radius * radius - (c.x() * c.x() + c.y() * c.y());
    return unit<W>({-c.x(), -c.y(), sqrt(max(den, W(0)))});
  }

  /// Answers for the cylinder that the body sweeps along e. `touch` is where, seen from the body's
  /// centre, the cylinder is met; if it is passed by, where one grown to be touched would be.
  Vec3<W> swept(const Vec3<W>& c, const Vec3<W>& e, const W& length, Vec3<W>& touch) const {
    using std::abs;
    using std::max;
    using std::sqrt;
    const Vec3<W> t(-e.y() / length, e.x() / length, W(0));
    const Vec3<W> w = unit<W>({-e.x() * e.z(), -e.y() * e.z(), length * length});
    const W L = t.x() * c.x() + t.y() * c.y();
    const W den = radius * radius - L * L;
    const Mask<W> crosses = den > W(0);
    const Vec3<W> onto = unit<W>(Vec3<W>(w * sqrt(max(den, W(0))) - t * L));
    const Vec3<W> m = select<W>(crosses, onto, select<W>(L > W(0), Vec3<W>(-t), t));
    touch = m * select(crosses, radius, W(abs(L)));
    return m;
  }

  /// Balls have no flat sides.
  void between_disks(const Vec3<W>&, const Vec3<W>&, const Vec3<W>&, W&, Mask<W>&) const {}
};

/// An ellipsoid { F b : |b| <= 1 }; columns of F may be zero.
template <class W>
struct EllipsoidBody {
  Mat3<W> F;

  W bend(const Vec3<W>& m) const { return (F.transpose() * m).norm(); }
  /// Goes by way of a unit vector, so that it is a point of the ellipsoid even where F^T m is
  /// nothing but rounding. A disk's along its axis: the centre.
  Vec3<W> spot(const Vec3<W>& m) const {
    const Vec3<W> u = F.transpose() * m;
    const Vec3<W> spot = F * unit<W>(u);
    const Mask<W> along = is_along_axis(u);
    return any(along) ? select<W>(along, Vec3<W>(Vec3<W>::Zero()), spot) : spot;
  }

  /// Whether F is a disk and u = F^T m zero but for rounding.
  Mask<W> is_along_axis(const Vec3<W>& u) const {
    const Mask<W> is_disk = F.col(2).cwiseAbs().sum() == W(0);
    if (!any(is_disk)) return is_disk;
    return is_disk & (u.cwiseAbs().sum() <= F.cwiseAbs().sum() * W(tolerance::flat_disk<Lane<W>>));
  }

  /// Where two disks lie in one plane, across m: which point between their centres, b + share e, is
  /// such that the ray meets a disk around it, and whether it does.
  void between_disks(const Vec3<W>& m, const Vec3<W>& b, const Vec3<W>& e, W& share,
                     Mask<W>& meets) const {
    const Mask<W> along = is_along_axis(F.transpose() * m);
    if (!any(along)) return;
    // In units of the disk: x = F y.
    const Vec3<W> f = F.col(0), g = F.col(1);
    const W det = cross_2d(f, g);
    const auto unit_x = [&](const Vec3<W>& v) { return cross_2d(v, g) / det; };
    const auto unit_y = [&](const Vec3<W>& v) { return cross_2d(f, v) / det; };
    const W b_x = unit_x(b), b_y = unit_y(b), e_x = unit_x(e), e_y = unit_y(e);
    const W between = -(b_x * e_x + b_y * e_y) / (e_x * e_x + e_y * e_y);
    const W x = b_x + between * e_x, y = b_y + between * e_y;
    const Mask<W> inside = (between >= W(0)) & (between <= W(1)) & (x * x + y * y <= W(1));
    share = select(along, between, share);
    meets = (along & inside) | ((!along) & meets);
  }

  Vec3<W> alone(const Vec3<W>& c) const {
    using std::abs;
    using std::max;
    using std::sqrt;
    // With N_kl = f_k x f_l: det = sum N_kl.z^2, adj c and the rest of the minors of A = F F^T are
    // sums of products of these, which keep the digits that A itself loses for needles.
    W det(0), off(0);
    Vec3<W> across = Vec3<W>::Zero(), adj = Vec3<W>::Zero();
    for (int k = 0; k < 3; ++k) {
      for (int l = k + 1; l < 3; ++l) {
        const Vec3<W> N = F.col(k).cross(F.col(l));
        det += N.z() * N.z();
        across += N * N.z();
      }
      const W moment = F(0, k) * c.y() - F(1, k) * c.x();
      off += moment * moment;
      adj += Vec3<W>(-F(1, k), F(0, k), W(0)) * moment;
    }
    const W volume = abs(F.col(0).dot(F.col(1).cross(F.col(2))));
    const W den = det - off;
    const Vec3<W> onto = across * sqrt(max(den, W(0))) - adj * volume;
    return unit<W>(select<W>(den > W(0), onto, Vec3<W>(-adj)));
  }

  Vec3<W> swept(const Vec3<W>& c, const Vec3<W>& e, const W& length, Vec3<W>& touch) const {
    using std::abs;
    using std::max;
    using std::sqrt;
    const Vec3<W> t(-e.y() / length, e.x() / length, W(0));
    const Vec3<W> w = unit<W>({-e.x() * e.z(), -e.y() * e.z(), length * length});
    const Vec3<W> yw = F.transpose() * w, yt = F.transpose() * t;
    const W ga = yt.squaredNorm(), et = yw.dot(yt), D = yw.cross(yt).norm();
    const W L = -t.dot(c);
    const W den = ga - L * L, root = sqrt(max(den, W(0)));
    const Mask<W> crosses = den > W(0);
    const Vec3<W> onto = w * (ga * root) + t * (L * D - et * root);
    const Vec3<W> m = select<W>(crosses, unit<W>(onto), select<W>(L < W(0), Vec3<W>(-t), t));
    const Vec3<W> grown = F * (F.transpose() * m) * (abs(L) / select(ga > W(0), ga, W(1)));
    touch = select<W>(crosses, spot(m), grown);
    return m;
  }
};

/// The bodies' centres that are there beside the newest one.
template <class W>
struct Translates {
  std::array<Vec3<W>, 3> c = {Vec3<W>::Zero(), Vec3<W>::Zero(), Vec3<W>::Zero()};
  std::array<Mask<W>, 3> valid = {Mask<W>(false), Mask<W>(false), Mask<W>(false)};
};

/// The hit on the hull.
template <class W>
struct HullCastHit {
  Vec3<W> m = Vec3<W>::Zero();  ///< of unit length
  Mask<W> found =
      Mask<W>(false);  ///< it is the hit, or separates; otherwise the best that is known
  std::array<W, 3> weights = {W(0), W(0),
                              W(0)};  ///< of the others' spots; the newest's completes 1
  W rank = W(std::numeric_limits<Lane<W>>::infinity());  ///< height of the hull's plane
};

/// The cast; `rounding` is how far beside the ray counts as on it.
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

  /// The newest body is likely to be among the hit's carriers. A candidate that another body
  /// reaches beyond is joined by that body; should this not lead to the hit, all candidates are
  /// tried, those with the newest body first.
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

  /// Does what solve() does where the hit is known in some lanes, and likely to be between the
  /// newest body and the first of the others in the rest.
  HullCastHit<W> solve_from(const HullCastHit<W>& known) {
    hit_ = known;
    if (!all(hit_.found)) edge({newest_, W(0), nowhere(), Mask<W>(true)}, other(0));
    return all(hit_.found) ? hit_ : solve();
  }

 private:
  using Places = std::array<Mask<W>, 3>;

  /// The body that reaches furthest in some direction, if there is one.
  struct Furthest {
    Vec3<W> c = Vec3<W>::Zero();
    W reach = W(-std::numeric_limits<T>::infinity());
    Places at = {Mask<W>(false), Mask<W>(false), Mask<W>(false)};
    Mask<W> some = Mask<W>(false);
  };

  static Places nowhere() { return {Mask<W>(false), Mask<W>(false), Mask<W>(false)}; }
  Furthest other(std::size_t k) const {
    Places at = nowhere();
    at[k] = Mask<W>(true);
    return {others_.c[k], W(0), at, others_.valid[k]};
  }

  /// What another body reaches beyond by hardly more than rounding may be all there is, after all.
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
      const W reach = others_.c[k].dot(m);
      const Mask<W> further = others_.valid[k] & (reach > best.reach);
      best.c = select<W>(further, others_.c[k], best.c);
      best.reach = select(further, reach, best.reach);
      for (std::size_t j = 0; j < k; ++j) best.at[j] &= !further;
      best.at[k] = further;
      best.some |= further;
    }
    return best;
  }

  /// Takes the candidate of direction m where it is better than the hit so far: where `meets` (its
  /// bodies meet the ray) and no other body reaches further than its carrier, it is the hit.
  /// Answers the body that reaches furthest of all but the newest.
  Furthest consider(const Vec3<W>& m, const Vec3<W>& carrier, const Mask<W>& meets,
                    const std::array<W, 3>& weights, const Mask<W>& candidate) {
    using std::max;
    const Furthest furthest = furthest_in(m);
    const W reach = max(newest_.dot(m), furthest.reach);
    const Mask<W> unbeaten = !(reach - carrier.dot(m) > beaten_by_);
    const W value = reach + body_.bend(m);
    const Mask<W> ahead = m.z() > W(0);
    const W out_of_reach = W(std::numeric_limits<T>::max());
    const W rank = select(ahead, W(value / select(ahead, m.z(), W(1))),
                          select(value < W(0), W(-out_of_reach), out_of_reach));
    // What separates for sure does so wherever its bodies are met.
    const Mask<W> separates = (!ahead) & ((value < -rounding_) | (meets & (value < W(0))));
    const Mask<W> useful = unbeaten & ((ahead & meets) | separates);
    const Mask<W> wins = candidate & (!hit_.found) & (useful | (rank < hit_.rank));
    hit_.m = select<W>(wins, m, hit_.m);
    hit_.rank = select(wins, rank, hit_.rank);
    hit_.found |= wins & useful;
    for (std::size_t k = 0; k < 3; ++k) hit_.weights[k] = select(wins, weights[k], hit_.weights[k]);
    return furthest;
  }

  /// One.
  Furthest alone(const Furthest& a) {
    std::array<W, 3> weights;
    for (std::size_t k = 0; k < 3; ++k) weights[k] = select(a.at[k], W(1), W(0));
    return consider(body_.alone(a.c), a.c, Mask<W>(true), weights, a.some);
  }

  /// Two: the cylinder between them.
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

  /// Three: the plane that touches them.
  void face(const Furthest& a, const Furthest& b, const Furthest& c) {
    Mask<W> candidate = a.some & b.some & c.some;
    for (std::size_t k = 0; k < 3; ++k) candidate &= !(b.at[k] & c.at[k]);
    if (!any(candidate & !hit_.found)) return;
    const Vec3<W> m = upper_normal(a.c, b.c, c.c);
    const Vec3<W> touch = body_.spot(m);
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
  /// How much further another body may reach than a candidate's carrier, whose plane is moved out
  /// to it: as much too early. At first what two reaches are rounded by, a quarter of rounding_.
  W beaten_by_;
  HullCastHit<W> hit_;
};

}  // namespace minkray
