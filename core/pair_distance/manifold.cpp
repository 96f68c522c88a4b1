// SPDX-License-Identifier: MIT
#include "core/pair_distance/manifold.h"

#include <algorithm>
#include <cmath>

namespace minkray {
namespace {

constexpr int directions = 8, most_corners = 3 * directions;

/// A point projected along the normal: its position in the plane, and its height.
struct Corner {
  double x, y, height;
};

double area(const Corner& a, const Corner& b, const Corner& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Corners in counter-clockwise order. A polygon with one or two corners is a point or an edge.
struct Polygon {
  std::array<Corner, most_corners> corners;
  int count = 0;

  void add(const Corner& corner) { corners[static_cast<std::size_t>(count++)] = corner; }
  const Corner& operator[](int i) const { return corners[static_cast<std::size_t>(i)]; }
};

/// Convex hull of corners projected along the normal (A. Andrew's monotone chain, 1979). Merges
/// corners closer to each other than `near`, and drops corners within `near` of an edge.
Polygon hull_of(std::array<Corner, directions> points, double near) {
  std::ranges::sort(points, [](const Corner& a, const Corner& b) {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
  });
  Polygon hull;
  const auto is_same = [near](const Corner& a, const Corner& b) {
    return std::hypot(a.x - b.x, a.y - b.y) <= near;
  };
  const auto chain = [&](auto first, auto last, int least) {
    for (auto it = first; it != last; ++it) {
      while (hull.count > least) {
        const Corner &a = hull[hull.count - 2], &b = hull[hull.count - 1];
        if (area(a, b, *it) > near * std::hypot(it->x - a.x, it->y - a.y)) break;
        --hull.count;
      }
      if (hull.count == 0 || !is_same(hull[hull.count - 1], *it)) hull.add(*it);
    }
  };
  chain(points.begin(), points.end(), 1);
  chain(points.rbegin() + 1, points.rend(), hull.count);
  while (hull.count > 1 && is_same(hull[0], hull[hull.count - 1])) --hull.count;
  return hull;
}

/// Clips one polygon by another, which may be a single edge.
Polygon clipped(Polygon polygon, const Polygon& by, double near) {
  for (int i = 0; i < by.count; ++i) {
    const Corner &from = by[i], &to = by[(i + 1) % by.count];
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    if (!(length > 0)) continue;
    Polygon kept;
    for (int k = 0; k < polygon.count; ++k) {
      const Corner &p = polygon[k], &q = polygon[(k + 1) % polygon.count];
      const double at_p = area(from, to, p) / length, at_q = area(from, to, q) / length;
      if (at_p >= -near && kept.count < most_corners) kept.add(p);
      const bool crosses = (at_p < -near && at_q > near) || (at_p > near && at_q < -near);
      if (!crosses || kept.count == most_corners || polygon.count == 1) continue;
      const double t = at_p / (at_p - at_q);
      kept.add(
          {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), p.height + t * (q.height - p.height)});
    }
    polygon = kept;
  }
  return polygon;
}

/// Height of the polygon over a point inside it. The height is that of the edges, or of a fan of
/// triangles from the first corner.
double height_over(const Polygon& polygon, double x, double y) {
  const Corner p{x, y, 0};
  for (int i = 1; i + 1 < polygon.count; ++i) {
    const Corner &a = polygon[0], &b = polygon[i], &c = polygon[i + 1];
    const double whole = area(a, b, c), at_a = area(b, c, p), at_b = area(c, a, p),
                 at_c = whole - at_a - at_b;
    constexpr double beside = -1e-6;
    if (!(whole > 0) || at_a < beside * whole || at_b < beside * whole || at_c < beside * whole)
      continue;
    return (at_a * a.height + at_b * b.height + at_c * c.height) / whole;
  }
  double best = polygon[0].height, nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < polygon.count; ++i) {
    const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.count];
    const double dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
    const double t =
        squared > 0 ? std::clamp(((x - a.x) * dx + (y - a.y) * dy) / squared, 0.0, 1.0) : 0;
    const double off = std::hypot(a.x + t * dx - x, a.y + t * dy - y);
    if (off >= nearest) continue;
    nearest = off;
    best = a.height + t * (b.height - a.height);
  }
  return best;
}

/// A shape whose core has its middle at `middle`, relative to A's.
struct Seen {
  const ContactShape& shape;
  Mat3<double> turn;
  Vec3<double> middle;

  /// The support point of the shape, including its radius.
  Vec3<double> support(const Vec3<double>& n) const {
    const Vec3<double> d = turn.transpose() * n;
    return middle + turn * support_of_core<CoreKind::other>(shape.core(), d).point +
           (shape.core().radius / n.norm()) * n;
  }
};

class Manifold {
 public:
  /// `point_a` is A's nearest point, relative to A's middle.
  Manifold(const SignedDistance& nearest, const Vec3<double>& point_a,
           const ManifoldOptions& options)
      : nearest_(nearest),
        point_a_(point_a),
        options_(options),
        e0_(nearest.normal.unitOrthogonal()),
        e1_(nearest.normal.cross(e0_)) {}

  /// Returns the face that points along `sign` times the normal, relative to point_a.
  Polygon face(const Seen& seen, double sign, double near) const {
    std::array<Corner, directions> corners;
    const Vec3<double>& n = nearest_.normal;
    for (int k = 0; k < directions; ++k) {
      constexpr double turn = 2 * 3.14159265358979323846 / directions;
      const double angle = turn * (k + 0.5);
      const Vec3<double> aside = std::cos(angle) * e0_ + std::sin(angle) * e1_;
      const Vec3<double> p = seen.support(sign * n + std::tan(options_.tilt) * aside) - point_a_;
      corners[static_cast<std::size_t>(k)] = {p.dot(e0_), p.dot(e1_), p.dot(n)};
    }
    return hull_of(corners, near);
  }

  /// Adds contact points at the corners of `within`, the polygon that both faces share.
  void add(const Polygon& within, const Polygon& of_a, const Polygon& of_b, double most) {
    for (int i = 0; i < within.count; ++i) {
      const Corner& p = within[i];
      const double a = height_over(of_a, p.x, p.y), b = height_over(of_b, p.x, p.y);
      if (b - a > nearest_.value + most || count_ == most_corners) continue;
      ContactPoint point;
      const Vec3<double> foot = nearest_.point_a + p.x * e0_ + p.y * e1_;
      point.point_a = foot + a * nearest_.normal;
      point.point_b = foot + b * nearest_.normal;
      point.distance = b - a;
      all_[static_cast<std::size_t>(count_++)] = point;
    }
  }

  std::span<const ContactPoint> points() const {
    return {all_.data(), static_cast<std::size_t>(count_)};
  }
  ContactPoint nearest() const { return {nearest_.point_a, nearest_.point_b, nearest_.value}; }

 private:
  const SignedDistance& nearest_;
  Vec3<double> point_a_;
  const ManifoldOptions& options_;
  Vec3<double> e0_, e1_;
  std::array<ContactPoint, most_corners> all_;
  int count_ = 0;
};

/// Corners of the part that the faces of both shapes share.
Manifold all_points(const ContactShape& a, const Affine<double>& pose_a, const ContactShape& b,
                    const Affine<double>& pose_b, const SignedDistance& nearest,
                    const ManifoldOptions& options, double size) {
  constexpr double same = 1e-6;
  const double near = same * size;
  const Vec3<double> from_middle = nearest.point_a - middle_in_world(a, pose_a);
  Manifold manifold(nearest, from_middle, options);
  const Seen seen_a{a, turn_in_world(a, pose_a), Vec3<double>::Zero()},
      seen_b{b, turn_in_world(b, pose_b), between_middles(a, pose_a, b, pose_b).x};
  const Polygon of_a = manifold.face(seen_a, 1, near), of_b = manifold.face(seen_b, -1, near);
  // Keeps the part of a point or an edge inside the other shape's face.
  const Polygon common =
      of_a.count <= of_b.count ? clipped(of_a, of_b, near) : clipped(of_b, of_a, near);
  const bool has_face = std::max(of_a.count, of_b.count) > 2;
  if (has_face) manifold.add(common, of_a, of_b, options.within * size);
  return manifold;
}

double size_of(const ContactShape& a, const ContactShape& b) {
  return std::min(a.ball_radius(), b.ball_radius());
}

}  // namespace

ContactManifold contact_manifold(const ContactShape& a, const Affine<double>& pose_a,
                                 const ContactShape& b, const Affine<double>& pose_b,
                                 const SignedDistance& nearest, const ManifoldOptions& options) {
  if (nearest.normal.isZero(0) || nearest.is_unknown()) return {};
  const double size = size_of(a, b);
  const Manifold manifold = all_points(a, pose_a, b, pose_b, nearest, options, size);
  // The tilt moves support points of curved surfaces by this distance.
  return spread_points(nearest.normal, manifold.nearest(), manifold.points(),
                       3 * std::tan(options.tilt) * size);
}

void add_contact_points(const ContactShape& a, const Affine<double>& pose_a, const ContactShape& b,
                        const Affine<double>& pose_b, const SignedDistance& nearest,
                        std::vector<ContactPoint>& to, const ManifoldOptions& options) {
  if (nearest.normal.isZero(0) || nearest.is_unknown()) return;
  const Manifold manifold = all_points(a, pose_a, b, pose_b, nearest, options, size_of(a, b));
  to.push_back(manifold.nearest());
  to.insert(to.end(), manifold.points().begin(), manifold.points().end());
}

ContactManifold spread_points(const Vec3<double>& normal, const ContactPoint& first,
                              std::span<const ContactPoint> points, double near) {
  ContactManifold result;
  result.normal = normal;
  result.points[0] = first;
  result.count = 1;
  const auto at = [&](std::size_t k) -> const Vec3<double>& { return result.points[k].point_a; };
  const auto twice_area = [&](std::size_t i, std::size_t j, const Vec3<double>& p) {
    return (at(j) - at(i)).cross(p - at(i)).dot(normal);
  };
  const auto take = [&](auto&& worth, double least) {
    double most = least;
    const ContactPoint* found = nullptr;
    for (const ContactPoint& point : points) {
      const double w = worth(point.point_a);
      if (!(w > most)) continue;
      most = w;
      found = &point;
    }
    if (found) result.points[static_cast<std::size_t>(result.count++)] = *found;
    return found != nullptr;
  };
  if (!take([&](const Vec3<double>& p) { return (p - at(0)).norm(); }, near)) return result;
  const double edge = near * (at(1) - at(0)).norm();
  if (!take([&](const Vec3<double>& p) { return std::abs(twice_area(0, 1, p)); }, edge))
    return result;
  const double sign = twice_area(0, 1, at(2)) < 0 ? -1 : 1;
  take(
      [&](const Vec3<double>& p) {
        return std::max({-sign * twice_area(0, 1, p), -sign * twice_area(1, 2, p),
                         -sign * twice_area(2, 0, p)});
      },
      edge);
  return result;
}

}  // namespace minkray
