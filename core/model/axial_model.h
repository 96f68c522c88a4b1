// SPDX-License-Identifier: MIT
// Models for shapes with an axis of revolution, in whose frame the axis is z: one ellipsoid; or two
// balls or two disks on the axis, any of which may be points (capsules, cylinders, cones). All in
// closed form. docs/theory.md derives them.
#pragma once

#include "core/model/line_cast.h"
#include "core/shape/jet.h"

namespace minkray {

/// The model of an ellipsoid around the origin: itself.
template <class W, class S>
class EllipsoidModel {
 public:
  struct Piece {
    Vec3<W> c, radii;
    W reach(const Vec3<W>& n) const { return c.dot(n) + n.cwiseProduct(radii).norm(); }
    Vec3<W> spot(const Vec3<W>& n) const {
      return c + unit<W>(n.cwiseProduct(radii)).cwiseProduct(radii);
    }
  };

  EllipsoidModel(const S& shape, const Vec3<Lane<W>>&, const Vec3<W>& s, const Vec3<W>& r, Lane<W>)
      : shape_(shape), s_(s), r_(r) {}

  const Vec3<W>& to_frame(const Vec3<W>& n) const { return n; }
  const Vec3<W>& to_shape(const Vec3<W>& n) const { return n; }
  W against_ray(const Vec3<W>& n) const { return -n.dot(r_); }

  Piece support(const Vec3<W>& n, const Mask<W>&) const {
    return {Vec3<W>(-s_), shape_.jet(n).radii};
  }

  ModelHit<W> begin(const Vec3<Lane<W>>&) const {
    return step({Vec3<W>(-s_), widen<W>(shape_.radii)}, s_, 0);
  }

  ModelHit<W> step(const Piece& piece, const Vec3<W>&, int) const {
    ModelHit<W> hit;
    hit.m = normal_on_ellipsoid<W>(shape_.radii, s_, r_, hit.certain);
    const W z = -hit.m.dot(r_);
    const Mask<W> ahead = z > W(0);
    hit.height = piece.reach(hit.m) / select(ahead, z, W(1));
    hit.certain &= ahead;
    hit.repeated = Mask<W>(true);
    return hit;
  }

 private:
  const S& shape_;
  Vec3<W> s_, r_;
};

/// The hull of at most two balls or two disks on the z axis.
template <class W, class S>
class AxialModel {
 public:
  using T = Lane<W>;
  using JetHere = decltype(std::declval<const S&>().jet(std::declval<const Vec3<W>&>()));
  static constexpr bool disks = std::is_same_v<JetHere, AxialDiskJet<W>>;
  static_assert(disks || std::is_same_v<JetHere, AxialBallJet<W>>);

  struct Piece {
    Vec3<W> c;  ///< relative to s
    W radius;

    /// How far the unit ball or disk reaches. The length of a direction that is 1 but for rounding.
    static W bend(const Vec3<W>& n) {
      using std::sqrt;
      if constexpr (disks) return sqrt(n.x() * n.x() + n.y() * n.y());
      return W(T(0.5)) * (W(1) + n.squaredNorm());
    }
    W reach(const Vec3<W>& n) const { return c.dot(n) + radius * bend(n); }
    Vec3<W> spot(const Vec3<W>& n) const {
      if constexpr (disks) return c + unit<W>({n.x(), n.y(), W(0)}) * radius;
      return c + n * radius;
    }
    Mask<W> same(const Piece& other) const {
      return (c.z() == other.c.z()) & (radius == other.radius);
    }
  };

  /// The shape with its bounding ball's centre, seen from s; R is the ball's radius.
  AxialModel(const S& shape, const Vec3<T>& centre, const Vec3<W>& s, const Vec3<W>& r, T R)
      : shape_(shape),
        centre_z_(centre.z()),
        s_(s),
        r_(r),
        rounding_(tolerance::model_rounding<T> * R) {}

  const Vec3<W>& to_frame(const Vec3<W>& n) const { return n; }
  const Vec3<W>& to_shape(const Vec3<W>& n) const { return n; }
  W against_ray(const Vec3<W>& n) const { return -n.dot(r_); }

  Piece support(const Vec3<W>& n, const Mask<W>&) const {
    const JetHere jet = shape_.jet(n);
    return {{-s_.x(), -s_.y(), jet.z - centre_z_ - s_.z()}, jet.radius};
  }

  /// The piece that faces the ray is tried first.
  ModelHit<W> begin(const Vec3<T>&) {
    const Mask<W> all_lanes(true);
    const Piece upper = support({W(0), W(0), W(1)}, all_lanes);
    const Piece lower = support({W(0), W(0), W(-1)}, all_lanes);
    const Mask<W> from_above = r_.z() < W(0);
    first_ = pick(from_above, upper, lower);
    second_ = pick(from_above, lower, upper);
    return on_both(first_, second_);
  }

  ModelHit<W> step(const Piece& piece, const Vec3<W>&, int) {
    const Mask<W> is_first = piece.same(first_);
    ModelHit<W> hit = on_both(piece, pick(is_first, second_, first_));
    hit.repeated = Mask<W>(true);
    return hit;
  }

 private:
  static Piece pick(const Mask<W>& condition, const Piece& a, const Piece& b) {
    return {select<W>(condition, a.c, b.c), select(condition, a.radius, b.radius)};
  }

  /// The first piece alone, unless the second reaches further there; what joins the two; or the
  /// second alone.
  ModelHit<W> on_both(const Piece& first, const Piece& second) const {
    using std::max;
    using std::min;
    ModelHit<W> hit;
    Mask<W> meets;
    Vec3<W> n = alone(first, meets);
    W reach = first.reach(n);
    const Mask<W> settled = second.reach(n) - reach <= rounding_;
    hit.certain = settled & meets;
    // Of a plane as steep as the ray, the hit is known no better than from the points around it.
    W lowest = W(-std::numeric_limits<T>::infinity()), highest = -lowest;
    if (!all(settled)) {
      Vec3<W> m;
      W low, high;
      const Mask<W> between = joined(first, second, m, low, high);
      lowest = select((!settled) & between, low, lowest);
      highest = select((!settled) & between, high, highest);
      n = select<W>(settled, n, m);
      reach = select(settled, reach, first.reach(m));
      hit.certain |= (!settled) & between;
      const Mask<W> open = !(settled | between);
      if (any(open)) {
        m = alone(second, meets);
        const W second_reach = second.reach(m);
        const Mask<W> last = open & (first.reach(m) - second_reach <= rounding_);
        n = select<W>(last, m, n);
        reach = select(last, second_reach, reach);
        hit.certain |= last & meets;
      }
    }
    const W z = -n.dot(r_);
    const Mask<W> ahead = z > W(0);
    hit.certain &= ahead;
    hit.height = min(max(W(reach / select(ahead, z, W(1))), lowest), highest);
    const Mask<W> some = n.squaredNorm() > W(0);
    hit.m = all(some) ? n : select<W>(some, n, Vec3<W>(-r_));
    return hit;
  }

  /// At right angles to the ray.
  Vec3<W> beside(const Vec3<W>& x) const { return x - r_ * x.dot(r_); }

  /// The normal where the ray meets one piece, or across the ray from it; which of the two.
  Vec3<W> alone(const Piece& piece, Mask<W>& meets) const {
    using std::max;
    using std::sqrt;
    if constexpr (disks) {
      // Where the line crosses the disk's plane, times r.z.
      const W x = piece.c.z() * r_.x() - piece.c.x() * r_.z();
      const W y = piece.c.z() * r_.y() - piece.c.y() * r_.z();
      const W rim = piece.radius * r_.z();
      meets = (x * x + y * y <= rim * rim) & (r_.z() != W(0));
      const Vec3<W> face(W(0), W(0), select(r_.z() > W(0), W(-1), W(1)));
      const Vec3<W> past(x * r_.z(), y * r_.z(), -(x * r_.x() + y * r_.y()));
      return select<W>(meets, face, unit<W>(past));
    } else {
      // Twice, for what is short beside what it is the remainder of.
      const Vec3<W> q = beside(beside(piece.c));
      const W den = piece.radius * piece.radius - q.squaredNorm();
      meets = den > W(0);
      return unit<W>(-q - r_ * sqrt(max(den, W(0))));
    }
  }

  /// The normal m where the ray meets the cone that touches both pieces; whether it does so between
  /// them. All directions that reach equally far with both are m(phi) = (k cos phi, k sin phi,
  /// m_z). The plane of m(phi) is crossed at height (alpha + beta cos + gamma sin) / (p + q cos + w
  /// sin), which is least where A sin + B cos + C = 0. The hit's height is between `low` and
  /// `high`.
  Mask<W> joined(const Piece& piece, const Piece& other, Vec3<W>& m, W& low, W& high) const {
    using std::max;
    using std::min;
    using std::sqrt;
    const W m_z = (other.radius - piece.radius) / (piece.c.z() - other.c.z());
    W k = W(1);
    if constexpr (!disks) k = sqrt(max(W(W(1) - m_z * m_z), W(0)));
    const W alpha = piece.c.z() * m_z + piece.radius;
    const W beta = k * piece.c.x(), gamma = k * piece.c.y();
    const W p = -r_.z() * m_z, q = -k * r_.x(), w = -k * r_.y();
    const W A = alpha * q - beta * p, B = gamma * p - alpha * w, C = gamma * q - beta * w;
    const W AB = A * A + B * B, den = AB - C * C;
    const W root = sqrt(max(den, W(0)));
    W cosine = (A * root - C * B) / AB, sine = -(C * A + B * root) / AB;
    const Mask<W> crosses = (den > W(0)) & (p + q * cosine + w * sine > W(0));
    if (!all(crosses)) {
      // Past the cone: the direction at right angles to the ray that reaches least.
      const W across = sqrt(q * q + w * w);
      const W u = q / across, v = w / across, x = -p / across;
      const W y = sqrt(max(W(W(1) - x * x), W(0)));
      const W turn = select(gamma * u - beta * v > W(0), W(-y), y);
      cosine = select(crosses, cosine, W(x * u - turn * v));
      sine = select(crosses, sine, W(x * v + turn * u));
    }
    m = unit<W>({k * cosine, k * sine, m_z});

    // The support points of both, and the point between them that is nearest to the ray.
    const Vec3<W> g = disks ? Vec3<W>(cosine, sine, W(0)) : m;
    const Vec3<W> on_other = other.c + g * other.radius, on_piece = piece.c + g * piece.radius;
    low = min(W(-on_other.dot(r_)), W(-on_piece.dot(r_)));
    high = max(W(-on_other.dot(r_)), W(-on_piece.dot(r_)));
    const Vec3<W> from = beside(on_other);
    const Vec3<W> along = beside(on_piece) - from;
    const W share = min(max(W(-from.dot(along) / along.squaredNorm()), W(0)), W(1));
    return crosses & ((from + along * share).squaredNorm() <= rounding_ * rounding_);
  }

  const S& shape_;
  W centre_z_;
  Vec3<W> s_, r_;
  W rounding_;
  Piece first_{Vec3<W>::Zero(), W(0)}, second_{Vec3<W>::Zero(), W(0)};
};

}  // namespace minkray
