// SPDX-License-Identifier: MIT
// Slow ray cast in long double for shapes without a closed form: portal refinement (after Snethen,
// "XenoCollide: Complex Collision Made Simple", 2008), projected along the ray. Shares no code with
// the solvers; the support mapping is evaluated in long double.
#pragma once

#include <array>
#include <limits>

#include "core/derived/shape_bounds.h"

namespace minkray::testing {

using Long = long double;

struct PortalHit {
  enum class Answer : unsigned char { hit, miss, undecided } answer = Answer::undecided;
  Long t_lo = 0, t_hi = 0;
  Vec3<Long> normal = Vec3<Long>::Zero();
  int supports = 0;
};

/// Finds where lines enter one shape.
///
/// A portal is a triangle of the shape's points that the ray passes through: the hit is no later.
/// The hit is no earlier than the supporting plane along the portal's normal. The support point
/// splits the portal in three triangles, and the ray passes through one of them.
class PortalCast {
 public:
  explicit PortalCast(const Shape& shape) : shape_(shape) {
    const Bounds<Long> bounds = bounds_of<Long>(shape_);
    radius_ = bounds.half_extents().norm();
    // Off the middle: viewed from a centre of symmetry, portals have the line in their sides.
    middle_.setZero();
    int weight = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (const Long sign : {Long(-1), Long(1)})
        middle_ += ++weight * shape_.support(Vec3<Long>(sign * Vec3<Long>::Unit(axis))) / 21;
  }

  Long radius() const { return radius_; }

  /// Casts the whole line, t of any sign, until the two bounds are closer than `gap` radii, as a
  /// distance between planes.
  PortalHit operator()(const Vec3<Long>& origin, const Vec3<Long>& direction, Long gap) const {
    Search search{shape_, direction.normalized(), origin, {}, {}, 0};
    search.origin += (middle_ - origin).dot(search.r) * search.r;
    search.a = search.r.unitOrthogonal();
    search.b = search.r.cross(search.a);
    PortalHit hit;
    std::array<Vec3<Long>, 3> portal;
    hit.answer = search.find_portal(middle_ - search.origin, gap * radius_, portal);
    if (hit.answer == PortalHit::Answer::hit) hit = search.refine(portal, gap * radius_);
    hit.supports = search.supports;
    const Long length = direction.norm();
    const Long base = (search.origin - origin).dot(search.r);
    hit.t_lo = (base + hit.t_lo) / length;
    hit.t_hi = (base + hit.t_hi) / length;
    return hit;
  }

 private:
  static constexpr int most_supports = 20000;

  /// Points are relative to `origin`, which lies on the line near the shape; (a, b) is the plane
  /// across.
  struct Search {
    const Shape& shape;
    Vec3<Long> r, origin, a, b;
    int supports;

    using Vec2 = Eigen::Matrix<Long, 2, 1>;

    Vec3<Long> support(const Vec3<Long>& n) {
      ++supports;
      return shape.support(n) - origin;
    }
    Vec2 across(const Vec3<Long>& p) const { return {a.dot(p), b.dot(p)}; }
    static Long cross(const Vec2& u, const Vec2& v) { return u.x() * v.y() - u.y() * v.x(); }

    /// Two silhouette points which, with a point m of the shape, make a triangle around the line:
    /// portal refinement of the shape's shadow, a figure in two dimensions.
    PortalHit::Answer find_portal(const Vec3<Long>& m, Long tolerance,
                                  std::array<Vec3<Long>, 3>& portal) {
      const Vec2 inner = across(m);
      const auto silhouette = [&](const Vec2& u) { return support(u.x() * a + u.y() * b); };
      Vec2 u = -inner;
      if (!(u.norm() > 0)) u = Vec2::UnitX();
      // Two points with the line between them, as seen from m: each new one is sought on the line's
      // side of the last.
      Vec3<Long> p = silhouette(u), q = p;
      if (u.dot(across(p)) < 0) return PortalHit::Answer::miss;
      for (;;) {
        if (supports > most_supports) return PortalHit::Answer::undecided;
        const Vec2 to_p = across(p) - inner;
        u = Vec2(-to_p.y(), to_p.x());
        if (u.dot(-inner) < 0) u = -u;
        q = silhouette(u);
        if (u.dot(across(q)) < 0) return PortalHit::Answer::miss;
        if (cross(across(q) - inner, -inner) * cross(across(q) - inner, to_p) >= 0) break;
        p = q;
      }
      for (int i = 0; i < most_supports; ++i) {
        // The side pq, its normal away from m.
        const Vec2 pq = across(q) - across(p);
        u = Vec2(pq.y(), -pq.x());
        if (u.dot(across(p) - inner) < 0) u = -u;
        const Long length = u.norm();
        if (!(length > 0)) break;
        u /= length;
        if (u.dot(across(p)) >= 0) {
          portal = {m, p, q};
          return PortalHit::Answer::hit;
        }
        const Vec3<Long> further = silhouette(u);
        const Long reach = u.dot(across(further));
        if (reach < 0) return PortalHit::Answer::miss;
        if (reach - u.dot(across(p)) <= tolerance * Long(1e-3)) break;
        // Half that contains the line.
        const Vec2 split = across(further) - inner;
        const bool with_p = cross(split, -inner) * cross(split, across(p) - inner) >= 0;
        (with_p ? q : p) = further;
      }
      return PortalHit::Answer::undecided;
    }

    /// Takes the two shorter edges: slivers lose digits to the product of the long ones.
    static Vec3<Long> normal_of(const std::array<Vec3<Long>, 3>& v) {
      const Vec3<Long> ab = v[1] - v[0], bc = v[2] - v[1], ca = v[0] - v[2];
      const Long ab2 = ab.squaredNorm(), bc2 = bc.squaredNorm(), ca2 = ca.squaredNorm();
      if (ab2 >= bc2 && ab2 >= ca2) return bc.cross(ca);
      return bc2 >= ca2 ? ca.cross(ab) : ab.cross(bc);
    }

    /// Depth of the line within a triangle: the least of three areas, negative if it is outside.
    Long room(const Vec3<Long>& p, const Vec3<Long>& q, const Vec3<Long>& s) const {
      const Vec2 i = across(p), j = across(q), k = across(s);
      const Long turn = cross(j - i, k - i) < 0 ? Long(-1) : Long(1);
      return std::min({turn * cross(i, j), turn * cross(j, k), turn * cross(k, i)});
    }

    PortalHit refine(std::array<Vec3<Long>, 3> v, Long tolerance) {
      PortalHit hit;
      hit.t_lo = -std::numeric_limits<Long>::infinity();
      hit.t_hi = std::numeric_limits<Long>::infinity();
      for (int i = 0; i < most_supports; ++i) {
        Vec3<Long> n = normal_of(v);
        if (n.dot(r) > 0) n = -n;
        n.normalize();
        const Long slope = n.dot(r);
        if (!(slope < 0)) return hit;  // seen from the edge: undecided
        const Vec3<Long> p = support(n);
        const Long in_plane = n.dot(v[0]), touching = n.dot(p);
        // Not the best of all portals: those seen nearly from their edge round t most.
        hit.t_lo = touching / slope;
        hit.t_hi = in_plane / slope;
        if (touching - in_plane <= tolerance) {
          hit.normal = n;
          hit.answer = PortalHit::Answer::hit;
          return hit;
        }
        // The line is furthest inside the triangle of p and two of the corners.
        std::size_t replaced = 0;
        Long most_room = -std::numeric_limits<Long>::infinity();
        for (std::size_t k = 0; k < 3; ++k) {
          const Long inside = room(p, v[(k + 1) % 3], v[(k + 2) % 3]);
          if (!(inside > most_room)) continue;
          most_room = inside;
          replaced = k;
        }
        if (!(most_room >= 0)) return hit;  // along an edge, to the last digit: undecided
        v[replaced] = p;
      }
      return hit;
    }
  };

  Shape shape_;
  Vec3<Long> middle_;
  Long radius_ = 0;
};

}  // namespace minkray::testing
