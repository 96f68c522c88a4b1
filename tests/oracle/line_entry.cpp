// SPDX-License-Identifier: MIT
#include "tests/oracle/line_entry.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "tests/oracle/closed_form.h"

namespace minkray::testing {
namespace {

using V = Vec3<Long>;
using Answer = LineEntry::Answer;

constexpr Long infinity = std::numeric_limits<Long>::infinity();

LineEntry entry_at(Long t) {
  return t < infinity ? LineEntry{Answer::hit, t} : LineEntry{Answer::miss, 0};
}

/// The square root of the positive discriminant of |w + t d|^2 = r^2, w at right angles to d.
Long half_chord(const V& w, Long dd, Long radius) {
  const Long inside = radius * radius - w.squaredNorm();
  return inside >= 0 ? std::sqrt(inside / dd) : -1;
}

Long ball_entry(const V& o, const V& d, Long dd, const V& centre, Long radius) {
  const Long nearest = (centre - o).dot(d) / dd;
  const Long half = half_chord(o + nearest * d - centre, dd, radius);
  return half >= 0 ? nearest - half : infinity;
}

/// The points within r of the hull of some points.
class RoundedHull {
 public:
  RoundedHull(const std::vector<Vec3<double>>& points, std::vector<V> exact_points, Long radius)
      : points_(std::move(exact_points)), radius_(radius) {
    const HalfSpaces planes(points);
    if (planes.size() < 4)
      throw std::invalid_argument("LineEntries: the hull must be solid, its points span a plane");
    for (const HalfSpaces::Plane& plane : planes.planes()) {
      const auto [i, j, k] = plane.through;
      facets_.push_back(facet_of(plane.normal, {i, j, k}));
      for (const auto& [a, b] : {std::pair{i, j}, std::pair{j, k}, std::pair{i, k}}) {
        const V along = points_[b] - points_[a];
        edges_.push_back({points_[a], along, (points_[a] + points_[b]) / 2, along.squaredNorm(),
                          along.norm() / 2 + radius_, a, b});
      }
    }
    std::sort(edges_.begin(), edges_.end(), [](const Edge& p, const Edge& q) {
      return std::pair(p.from, p.to) < std::pair(q.from, q.to);
    });
    edges_.erase(
        std::unique(edges_.begin(), edges_.end(),
                    [](const Edge& p, const Edge& q) { return p.from == q.from && p.to == q.to; }),
        edges_.end());
  }

  LineEntry operator()(const V& o, const V& d) const {
    const Long dd = d.squaredNorm();
    Long first = infinity;
    for (const Facet& facet : facets_) first = std::min(first, entry(facet, o, d));
    for (const Edge& edge : edges_) first = std::min(first, entry(edge, o, d, dd));
    for (const V& point : points_) first = std::min(first, ball_entry(o, d, dd, point, radius_));
    return entry_at(first);
  }

 private:
  /// A triangle, moved out by the radius.
  struct Facet {
    V normal, corner;
    std::array<V, 3> inward;     ///< of its sides
    std::array<Long, 3> offset;  ///< inward.x >= offset
  };
  struct Edge {
    V point, along, middle;
    Long length_squared, reach;
    std::size_t from, to;
  };

  Facet facet_of(const V& plane_normal, const std::array<std::size_t, 3>& corners) const {
    const V &a = points_[corners[0]], &b = points_[corners[1]], &c = points_[corners[2]];
    // The points are as they are here, maybe scaled: only the plane's side is taken over.
    V normal = (b - a).cross(c - a).normalized();
    if (normal.dot(plane_normal) < 0) normal = -normal;
    Facet facet{normal, a + radius_ * normal, {}, {}};
    const std::array<V, 3> p = {a, b, c};
    for (std::size_t i = 0; i < 3; ++i) {
      V inward = normal.cross(p[(i + 1) % 3] - p[i]);
      if (inward.dot(p[(i + 2) % 3] - p[i]) < 0) inward = -inward;
      facet.inward[i] = inward;
      facet.offset[i] = inward.dot(p[i]);
    }
    return facet;
  }

  static Long entry(const Facet& facet, const V& o, const V& d) {
    const Long slope = facet.normal.dot(d);
    if (slope >= 0) return infinity;
    const Long t = facet.normal.dot(facet.corner - o) / slope;
    const V x = o + t * d;
    for (std::size_t i = 0; i < 3; ++i)
      if (facet.inward[i].dot(x) < facet.offset[i]) return infinity;
    return t;
  }

  /// The cylinder's mantle, between the edge's ends; beyond them the balls are first.
  Long entry(const Edge& edge, const V& o, const V& d, Long dd) const {
    const V to_middle = edge.middle - o;
    const V beside = to_middle - to_middle.dot(d) / dd * d;
    if (beside.squaredNorm() > edge.reach * edge.reach) return infinity;
    // Seen along the edge: a circle.
    const auto across = [&](const V& v) -> V {
      return v - v.dot(edge.along) / edge.length_squared * edge.along;
    };
    const V w = across(o - edge.point), flat = across(d);
    const Long ff = flat.squaredNorm();
    if (!(ff > 0)) return infinity;
    const Long nearest = -w.dot(flat) / ff;
    const Long half = half_chord(w + nearest * flat, ff, radius_);
    if (half < 0) return infinity;
    const Long t = nearest - half;
    const Long at = (o + t * d - edge.point).dot(edge.along);
    return at >= 0 && at <= edge.length_squared ? t : infinity;
  }

  std::vector<V> points_;
  Long radius_;
  std::vector<Facet> facets_;
  std::vector<Edge> edges_;
};

/// Both with their radii along the axes, around the origin.
class TwoEllipsoids {
 public:
  TwoEllipsoids(const Vec3<double>& a, const Vec3<double>& b)
      : a_(a.cast<Long>()),
        b_(b.cast<Long>()),
        least_radius_(least_curvature_radius(a_) + least_curvature_radius(b_)),
        greatest_radius_(greatest_curvature_radius(a_) + greatest_curvature_radius(b_)),
        size_(a_.norm() + b_.norm()) {}

  LineEntry operator()(const V& o, const V& d, const Vec3<double>& begin) const {
    constexpr int most_turns = 2000;
    constexpr Long close = 1e-17L;
    const Long dd = d.squaredNorm();
    V n = begin.cast<Long>().normalized();
    for (int i = 0; i < most_turns; ++i) {
      // A plane along the line that has the shape on its other side?
      const V level = (n - n.dot(d) / dd * d).normalized();
      if (level.dot(o) > level.dot(support(level))) return {Answer::miss, 0};
      const V s = support(n);
      const Long slope = n.dot(d), not_before = n.dot(s - o) / slope;
      const V centre = s - least_radius_ * n;
      const Long not_after = ball_entry(o, d, dd, centre, least_radius_);
      if (slope < 0 && not_after < infinity && (not_after - not_before) * -slope <= close * size_)
        return {Answer::hit, not_after};
      // The ball that touches there and holds the sum is met where the normal is nearer to the
      // sought one: by a share of the least radius in the greatest at least.
      const V far_centre = s - greatest_radius_ * n;
      const Long met = ball_entry(o, d, dd, far_centre, greatest_radius_);
      if (!(met < infinity)) return {Answer::miss, 0};
      n = (o + met * d - far_centre).normalized();
    }
    return {};
  }

 private:
  static Long least_curvature_radius(const V& radii) {
    const Long least = radii.minCoeff();
    return least * least / radii.maxCoeff();
  }
  static Long greatest_curvature_radius(const V& radii) {
    const Long greatest = radii.maxCoeff();
    return greatest * greatest / radii.minCoeff();
  }
  V support(const V& n) const {
    const V in_a = a_.cwiseProduct(n), in_b = b_.cwiseProduct(n);
    return a_.cwiseProduct(in_a) / in_a.norm() + b_.cwiseProduct(in_b) / in_b.norm();
  }

  V a_, b_;
  Long least_radius_, greatest_radius_, size_;
};

std::vector<Vec3<double>> corners_of(const Shape& shape) {
  if (const auto* hull = std::get_if<Hull>(&shape.kind)) return hull->points.points();
  std::vector<Vec3<double>> corners;
  if (const auto* box = std::get_if<Box>(&shape.kind))
    for (int i = 0; i < 8; ++i)
      corners.push_back(Vec3<double>(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)
                            .cwiseProduct(box->half_extents));
  return corners;
}

std::vector<V> exact(const std::vector<Vec3<double>>& points, const V& units) {
  std::vector<V> all;
  for (const Vec3<double>& p : points) all.push_back(p.cast<Long>().cwiseQuotient(units));
  return all;
}

}  // namespace

LineEntries::LineEntries(const Shape& shape) {
  if (const auto* hull = std::get_if<Hull>(&shape.kind)) {
    enter_ = [planes = HalfSpaces(hull->points.points())](const V& o, const V& d, const auto&) {
      const HalfSpaces::Part part = planes.clip(o, d);
      return part.empty() ? LineEntry{Answer::miss, 0} : LineEntry{Answer::hit, part.lower};
    };
    return;
  }
  if (const auto* rounded = std::get_if<Rounded>(&shape.kind)) {
    if (const auto points = corners_of(*rounded->shape); !points.empty()) {
      enter_ = [hull = RoundedHull(points, exact(points, V::Ones()), rounded->radius)](
                   const V& o, const V& d, const auto&) { return hull(o, d); };
      return;
    }
  }
  if (const auto* sum = std::get_if<MinkowskiSum>(&shape.kind); sum && sum->shapes.size() == 2) {
    const auto* first = std::get_if<Ellipsoid>(&sum->shapes[0]->kind);
    const auto* second = std::get_if<Ellipsoid>(&sum->shapes[1]->kind);
    if (first && second) {
      enter_ = TwoEllipsoids(first->radii, second->radii);
      return;
    }
    const Shape& other = *sum->shapes[first ? 1 : 0];
    if (const auto* ellipsoid = first ? first : second) {
      if (const auto points = corners_of(other); !points.empty()) {
        const V units = ellipsoid->radii.cast<Long>();
        enter_ = [units, hull = RoundedHull(points, exact(points, units), 1)](
                     const V& o, const V& d, const auto&) {
          return hull(o.cwiseQuotient(units), d.cwiseQuotient(units));
        };
        return;
      }
    }
  }
  if (!line_in_shape(shape, V(3, 0.1L, 0.2L), V(1, 0.1L, 0.1L)))
    throw std::invalid_argument("LineEntries: no oracle for such shapes");
  enter_ = [shape](const V& o, const V& d, const auto&) {
    const Interval inside = *line_in_shape(shape, o, d);
    return inside.empty() ? LineEntry{Answer::miss, 0} : LineEntry{Answer::hit, inside.lower};
  };
}

}  // namespace minkray::testing
