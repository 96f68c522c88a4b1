// SPDX-License-Identifier: MIT
#include "tests/oracle/closed_form.h"

#include "core/geometry/convex_hull.h"

namespace minkray::testing {
namespace {

using V = Vec3<Long>;

constexpr Long infinity = std::numeric_limits<Long>::infinity();

Interval everything() {
  return {-infinity, infinity};
}

Interval both(const Interval& a, const Interval& b) {
  return {std::max(a.lower, b.lower), std::min(a.upper, b.upper)};
}

/// The two are features of a convex shape.
Interval either(const Interval& a, const Interval& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.lower, b.lower), std::max(a.upper, b.upper)};
}

/// normal.x <= offset.
Interval half_space(const V& o, const V& d, const V& normal, Long offset) {
  const Long along = normal.dot(d), room = offset - normal.dot(o);
  if (along == 0) return room >= 0 ? everything() : Interval{};
  return along > 0 ? Interval{-infinity, room / along} : Interval{room / along, infinity};
}

Interval slab(Long o, Long d, Long lower, Long upper) {
  if (d == 0) return lower <= o && o <= upper ? everything() : Interval{};
  const Long a = (lower - o) / d, b = (upper - o) / d;
  return {std::min(a, b), std::max(a, b)};
}

/// The roots of a t^2 + 2 b t + c, lower first, without cancellation; nothing if there are none.
/// `discriminant` is b^2 - ac.
std::optional<Interval> roots(Long a, Long b, Long c, Long discriminant) {
  if (!(discriminant >= 0) || a == 0) return std::nullopt;
  const Long q = -(b + std::copysign(std::sqrt(discriminant), b));
  const Long first = q / a, second = q != 0 ? c / q : first;
  return Interval{std::min(first, second), std::max(first, second)};
}

/// Starts from the line's point nearest to the centre, where the quadratic's linear term is small.
Interval ball(const V& o, const V& d, const V& centre, Long radius) {
  const Long nearest = -(o - centre).dot(d) / d.squaredNorm();
  const V close = o + nearest * d - centre;
  const Long a = d.squaredNorm(), b = close.dot(d), c = close.squaredNorm() - radius * radius;
  const auto t = roots(a, b, c, b * b - a * c);
  return t ? Interval{nearest + t->lower, nearest + t->upper} : Interval{};
}

/// The round solid around the z axis whose radius goes from r0 at z0 to r1 at z1.
Interval frustum(const V& o, const V& d, Long z0, Long r0, Long z1, Long r1) {
  const Interval between = slab(o.z(), d.z(), z0, z1);
  if (z0 == z1) {  // a disk: the parameter is that of its plane
    if (between.empty()) return {};
    if (d.z() == 0) {
      const V flat_o(o.x(), o.y(), 0), flat_d(d.x(), d.y(), 0);
      return ball(flat_o, flat_d, V::Zero(), std::max(r0, r1));
    }
    const V at = o + between.lower * d;
    return std::hypot(at.x(), at.y()) <= std::max(r0, r1) ? between : Interval{};
  }
  // x^2 + y^2 <= (radius + slope t)^2 along the line, from the point nearest to the axis' middle.
  const Long middle = -o.dot(d) / d.squaredNorm();
  const V p = o + middle * d;
  const Long per_z = (r1 - r0) / (z1 - z0);
  const Long radius = r0 + (p.z() - z0) * per_z, slope = d.z() * per_z;
  const Long a = d.x() * d.x() + d.y() * d.y() - slope * slope;
  const Long b = p.x() * d.x() + p.y() * d.y() - radius * slope;
  const Long c = p.x() * p.x() + p.y() * p.y() - radius * radius;
  const Interval here{between.lower - middle, between.upper - middle};
  // From the line's moment about the apex, as b^2 - ac cancels for lines near the apex.
  Long discriminant = b * b - a * c;
  if (per_z != 0) {
    const V moment = V(p.x(), p.y(), radius / per_z).cross(d);
    discriminant = per_z * per_z * (moment.x() * moment.x() + moment.y() * moment.y()) -
                   moment.z() * moment.z();
  }
  Interval inside;
  if (const auto t = roots(a, b, c, discriminant)) {
    if (a > 0) {
      inside = both(here, *t);
    } else {  // outside of the roots: one branch per nappe; the slab holds one of them
      const Interval low = both(here, {-infinity, t->lower});
      const Interval high = both(here, {t->upper, infinity});
      inside = either(low, high);
    }
  } else if (a < 0) {
    inside = here;
  } else if (a == 0) {  // parallel to the mantle: linear
    if (b == 0)
      inside = c <= 0 ? here : Interval{};
    else
      inside =
          both(here, b > 0 ? Interval{-infinity, -c / (2 * b)} : Interval{-c / (2 * b), infinity});
  }
  return inside.empty() ? Interval{} : Interval{middle + inside.lower, middle + inside.upper};
}

V exact(const Vec3<double>& v) {
  return v.cast<Long>();
}

Interval box(const V& o, const V& d, const V& half) {
  Interval inside = everything();
  for (int axis = 0; axis < 3; ++axis)
    inside = both(inside, slab(o[axis], d[axis], -half[axis], half[axis]));
  return inside;
}

Interval in(const Sphere& s, const V& o, const V& d) {
  return ball(o, d, V::Zero(), s.radius);
}

Interval in(const Ellipsoid& s, const V& o, const V& d) {
  const V r = exact(s.radii);
  return ball(o.cwiseQuotient(r), d.cwiseQuotient(r), V::Zero(), 1);
}

Interval in(const Box& s, const V& o, const V& d) {
  return box(o, d, exact(s.half_extents));
}

Interval in(const Disk& s, const V& o, const V& d) {
  return frustum(o, d, 0, s.radius, 0, s.radius);
}

Interval in(const Cylinder& s, const V& o, const V& d) {
  return frustum(o, d, -Long(s.half_height), s.radius, s.half_height, s.radius);
}

Interval in(const CutCylinder& s, const V& o, const V& d) {
  const V below(s.lower_slope[0], s.lower_slope[1], -1),
      above(-Long(s.upper_slope[0]), -Long(s.upper_slope[1]), 1);
  const Long lowest = s.heights[0] - s.radius * std::hypot(below.x(), below.y());
  const Long highest = s.heights[1] + s.radius * std::hypot(above.x(), above.y());
  return both(
      frustum(o, d, lowest, s.radius, highest, s.radius),
      both(half_space(o, d, below, -Long(s.heights[0])), half_space(o, d, above, s.heights[1])));
}

Interval in(const Cone& s, const V& o, const V& d) {
  return frustum(o, d, -Long(s.half_height), s.radius, s.half_height, 0);
}

Interval in(const Frustum& s, const V& o, const V& d) {
  return frustum(o, d, -Long(s.half_height), s.radii[0], s.half_height, s.radii[1]);
}

Interval in(const Capsule& s, const V& o, const V& d) {
  const V top(0, 0, s.half_height);
  return either(frustum(o, d, -top.z(), s.radius, top.z(), s.radius),
                either(ball(o, d, top, s.radius), ball(o, d, -top, s.radius)));
}

/// Two balls and the cone that touches both along circles.
Interval in(const TaperedCapsule& s, const V& o, const V& d) {
  const Long r0 = s.radii[0], r1 = s.radii[1], h = s.half_height;
  const V top(0, 0, h);
  const Interval lower = ball(o, d, -top, r0), upper = ball(o, d, top, r1);
  if (std::abs(r0 - r1) >= 2 * h) return r0 > r1 ? lower : upper;
  const Long sine = (r0 - r1) / (2 * h), cosine = std::sqrt((1 - sine) * (1 + sine));
  return either(frustum(o, d, -h + r0 * sine, r0 * cosine, h + r1 * sine, r1 * cosine),
                either(lower, upper));
}

std::optional<Interval> in(const Triangle& s, const V& o, const V& d) {
  const V a = exact(s.points[0]) - o, b = exact(s.points[1]) - o, c = exact(s.points[2]) - o;
  const V normal = (b - a).cross(c - a);
  const Long ab = d.dot(a.cross(b)), bc = d.dot(b.cross(c)), ca = d.dot(c.cross(a));
  const bool through = (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
  if (normal.squaredNorm() == 0) return std::nullopt;  // a segment
  if (!through || normal.dot(d) == 0) return Interval{};
  const Long t = normal.dot(a) / normal.dot(d);
  return Interval{t, t};
}

/// The half-spaces of the facets that Qhull found, with offsets that let every vertex in.
std::optional<Interval> in(const Hull& s, const V& o, const V& d) {
  const auto& points = s.points.points();
  if (points.size() > 100) return std::nullopt;  // Qhull for every line would take too long
  const ConvexHull hull = convex_hull(points);
  if (hull.rank() < 3) return std::nullopt;
  Interval inside = everything();
  for (std::size_t f = 0; f < hull.facets.size(); ++f) {
    const auto corner = [&](std::size_t i) {
      return exact(points[hull.vertices[hull.facets[f][i]]]);
    };
    V normal = V::Zero();
    for (std::size_t i = 1; i + 1 < hull.facets[f].size(); ++i)
      normal += (corner(i) - corner(0)).cross(corner(i + 1) - corner(0));
    Long offset = -infinity;
    for (std::size_t i = 0; i < hull.facets[f].size(); ++i)
      offset = std::max(offset, normal.dot(corner(i)));
    inside = both(inside, half_space(o, d, normal, offset));
  }
  return inside;
}

/// The base must not be negative; a small whole p is answered by multiplications.
Long power(Long base, Long p) {
  if (p != std::floor(p) || p > 16) return std::pow(base, p);
  Long product = 1;
  for (int i = 0; i < static_cast<int>(p); ++i) product *= base;
  return product;
}

/// The sum of powers is convex along the line: its least by golden section, then bisection.
Interval in(const Superellipsoid& s, const V& o, const V& d) {
  const V radii = exact(s.radii), scaled_o = o.cwiseQuotient(radii),
          scaled_d = d.cwiseQuotient(radii);
  const Long p = s.exponent;
  const auto excess = [&](Long t) {
    Long sum = 0;
    for (int axis = 0; axis < 3; ++axis)
      sum += power(std::abs(scaled_o[axis] + t * scaled_d[axis]), p);
    return sum - 1;
  };
  // The ball around it, radius sqrt(3) at most, brackets.
  const Interval around = ball(scaled_o, scaled_d, V::Zero(), 1.8L);
  if (around.empty()) return {};
  Long low = around.lower, high = around.upper;
  constexpr Long golden = 0.6180339887498948482L;
  for (int i = 0; i < 50; ++i) {
    const Long a = high - golden * (high - low), b = low + golden * (high - low);
    (excess(a) < excess(b) ? high : low) = excess(a) < excess(b) ? b : a;
  }
  const Long least = (low + high) / 2;
  if (excess(least) > 0) return {};
  const auto root = [&](Long outside) {
    Long inside = least;
    for (int i = 0; i < 64; ++i) {
      const Long middle = (inside + outside) / 2;
      (excess(middle) > 0 ? outside : inside) = middle;
    }
    return inside;
  };
  return {root(around.lower), root(around.upper)};
}

/// The frustum's point in the plane of q, the distance from the axis, and z that is nearest to
/// (q, z).
std::array<Long, 2> nearest_of(const Frustum& s, Long q, Long z) {
  const Long h = s.half_height, r0 = s.radii[0], r1 = s.radii[1];
  const Long way_q = r1 - r0, way_z = 2 * h, length = std::hypot(way_q, way_z);
  // Positive beyond the side.
  const Long beyond =
      length > 0 ? ((q - r0) * way_z - (z + h) * way_q) / length : q - std::max(r0, r1);
  if (beyond <= 0 && std::abs(z) <= h) return {q, z};
  std::array<Long, 2> best = {};
  Long least = infinity;
  const auto offer = [&](Long at_q, Long at_z) {
    const Long away = std::hypot(q - at_q, z - at_z);
    if (away < least) {
      least = away;
      best = {at_q, at_z};
    }
  };
  offer(std::min(q, r0), -h);
  offer(std::min(q, r1), h);
  if (length > 0) {
    const Long along = ((q - r0) * way_q + (z + h) * way_z) / (length * length);
    const Long share = std::clamp<Long>(along, 0, 1);
    offer(r0 + share * way_q, share * way_z - h);
  }
  return best;
}

/// Bisection, since distances from the frustum are convex along the line.
Interval rounded(const Frustum& s, Long radius, const V& o, const V& d) {
  const auto off = [&](Long t) -> V {
    const V x = o + t * d;
    const Long q = std::hypot(x.x(), x.y());
    const auto [at_q, at_z] = nearest_of(s, q, x.z());
    const Long out = q > 0 ? (q - at_q) / q : 0;
    return {x.x() * out, x.y() * out, x.z() - at_z};
  };
  const Long reach =
      std::hypot(std::max(s.radii[0], s.radii[1]), s.half_height) + radius + o.norm();
  const Long middle = -o.dot(d) / d.squaredNorm(), around = 2 * reach / d.norm();
  const auto bisect = [](Long before, Long after, const auto& is_before) {
    for (int i = 0; i < 140; ++i) {
      const Long between = (before + after) / 2;
      (is_before(between) ? before : after) = between;
    }
    return after;
  };
  const auto is_outside = [&](Long t) { return off(t).norm() > radius; };
  const Long nearest = bisect(middle - around, middle + around, [&](Long t) {
    return off(t).dot(d) < 0 || (t < middle && off(t).norm() == 0);
  });
  if (is_outside(nearest)) return {};
  return {bisect(middle - around, nearest, is_outside),
          bisect(middle + around, nearest, is_outside)};
}

/// Cylinders, cones and frustums, by their distance; boxes, as the union of boxes grown along one
/// axis, cylinders around edges and balls at corners; balls and capsules, as themselves.
std::optional<Interval> in(const Rounded& s, const V& o, const V& d) {
  const Long r = s.radius;
  if (const auto* inner = std::get_if<Sphere>(&s.shape->kind))
    return ball(o, d, V::Zero(), inner->radius + r);
  if (const auto* point = std::get_if<Point>(&s.shape->kind))
    return ball(o, d, exact(point->position), r);
  if (const auto* inner = std::get_if<Disk>(&s.shape->kind))
    return rounded(Frustum{{inner->radius, inner->radius}, 0}, r, o, d);
  if (const auto* inner = std::get_if<Cylinder>(&s.shape->kind))
    return rounded(Frustum{{inner->radius, inner->radius}, inner->half_height}, r, o, d);
  if (const auto* inner = std::get_if<Cone>(&s.shape->kind))
    return rounded(Frustum{{inner->radius, 0}, inner->half_height}, r, o, d);
  if (const auto* inner = std::get_if<Frustum>(&s.shape->kind)) return rounded(*inner, r, o, d);
  const auto* inner = std::get_if<Box>(&s.shape->kind);
  if (!inner) return std::nullopt;
  const V half = exact(inner->half_extents);
  Interval inside;
  for (int axis = 0; axis < 3; ++axis) {
    inside = either(inside, box(o, d, half + r * V::Unit(axis)));
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const int su : {-1, 1})
      for (const int sv : {-1, 1}) {
        V edge_o(o[u] - su * half[u], o[v] - sv * half[v], o[axis]), edge_d(d[u], d[v], d[axis]);
        inside = either(inside, frustum(edge_o, edge_d, -half[axis], r, half[axis], r));
      }
  }
  for (int i = 0; i < 8; ++i) {
    const V corner(i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(),
                   i & 4 ? half.z() : -half.z());
    inside = either(inside, ball(o, d, corner, r));
  }
  return inside;
}

std::optional<Interval> in(const Transform& s, const V& o, const V& d) {
  const Affine<Long> inverse = s.map.affine().cast<Long>().inverse();
  return line_in_shape(*s.shape, inverse(o), inverse.linear * d);
}

template <class S>
std::optional<Interval> in(const S&, const V&, const V&) {
  return std::nullopt;
}

}  // namespace

std::optional<Interval> line_in_shape(const Shape& shape, const V& origin, const V& direction) {
  return std::visit(
      [&](const auto& kind) -> std::optional<Interval> { return in(kind, origin, direction); },
      shape.kind);
}

}  // namespace minkray::testing
