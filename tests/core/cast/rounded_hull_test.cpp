// SPDX-License-Identifier: MIT
// Casts at rounded hulls, including ones with corners that rounding cannot distinguish, against
// bisection of the distance from the hull in long double.
#include <gtest/gtest.h>

#include "tests/support/cast_truth.h"

namespace minkray::testing {
namespace {

using Long = long double;
using LongPoint = Vec3<Long>;

LongPoint closest_on_segment(const LongPoint& x, const LongPoint& a, const LongPoint& b) {
  const LongPoint ab = b - a;
  const Long length = ab.squaredNorm();
  if (length == 0) return a;
  return a + ab * std::clamp((x - a).dot(ab) / length, Long(0), Long(1));
}

LongPoint closest_on_triangle(const LongPoint& x, const LongPoint& a, const LongPoint& b,
                              const LongPoint& c) {
  const LongPoint N = (b - a).cross(c - a);
  const auto within = [&](const LongPoint& p, const LongPoint& q) {
    return (q - p).cross(x - p).dot(N) >= 0;
  };
  if (N.squaredNorm() > 0 && within(a, b) && within(b, c) && within(c, a))
    return x - N * ((x - a).dot(N) / N.squaredNorm());
  LongPoint best = closest_on_segment(x, a, b);
  for (const LongPoint& other : {closest_on_segment(x, b, c), closest_on_segment(x, c, a)})
    if ((x - other).squaredNorm() < (x - best).squaredNorm()) best = other;
  return best;
}

/// All triangles of so few points: those of the hull's surface are among them, and the others lie
/// within. Wolfe's method (tests/oracle/wolfe.h) squares a tip of 1e-9 in its Gram matrix, and its
/// hit there is 5e-11 off.
class HullByTriples {
 public:
  explicit HullByTriples(const std::vector<Vec3<double>>& points) {
    for (const Vec3<double>& point : points) points_.push_back(point.cast<Long>());
  }

  /// x seen from the hull's closest point; zero within.
  LongPoint from(const LongPoint& x) const {
    LongPoint best = x - points_.front();
    for_triples([&](const LongPoint& a, const LongPoint& b, const LongPoint& c) {
      const LongPoint seen = x - closest_on_triangle(x, a, b, c);
      if (seen.squaredNorm() < best.squaredNorm()) best = seen;
    });
    for (const LongPoint& p : points_)
      if (best.dot(p - (x - best)) > 1e-16L * best.norm()) return LongPoint::Zero();
    return best;
  }

 private:
  void for_triples(const auto& use) const {
    for (std::size_t i = 0; i < points_.size(); ++i)
      for (std::size_t j = i + 1; j < points_.size(); ++j)
        for (std::size_t k = j + 1; k < points_.size(); ++k)
          use(points_[i], points_[j], points_[k]);
  }
  std::vector<LongPoint> points_;
};

/// Distance from the rounded hull along a line.
struct FromHull {
  const HullByTriples& hull;
  Long radius;
  LongPoint o, d;

  LongPoint normal(Long t) const { return hull.from(o + t * d); }
  Long slope(Long t) const { return normal(t).dot(d); }
  Long outside(Long t) const { return normal(t).norm() - radius; }
};

struct Form {
  const char* name;
  std::vector<Vec3<double>> points;
};

/// A tip so small that its corners are one place as a ray sees them.
Form tip(const char* name, double size) {
  Form form{name, {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, -1}}};
  for (const double angle : {0.0, 2.0943951023931953, 4.1887902047863905})
    form.points.push_back({size * std::cos(angle), size * std::sin(angle), 1});
  return form;
}

std::vector<Form> forms() {
  return {tip("a blunt tip", 0.1),
          tip("a tip of 1e-7", 1e-7),
          tip("a tip of 1e-9", 1e-9),
          tip("a tip of 1e-17", 1e-17),
          {"a tetrahedron", {{1, 0, 0}, {-0.4, 0.9, 0}, {-0.3, -0.7, 0.2}, {0.1, 0, 0.8}}},
          {"a wedge", {{1, 1, 0}, {1, -1, 0}, {-1, 1, 0}, {-1, -1, 0}, {0.5, 0, 1e-3}}}};
}

TEST(RoundedHull, is_where_the_distance_is_its_radius) {
  for (const auto& [name, points] : forms())
    for (const double radius : {0.125, 2.0}) {
      SCOPED_TRACE(name);
      const Shape shape = Rounded{radius, Shape(Hull{PointCloud(points)})};
      const PreparedShape prepared(shape);
      const HullByTriples hull(points);
      FamilyRays grazing(shape, RayFamily::grazing, 91);
      const double R = grazing.ball().radius;
      Random random(92);
      CastOutcome outcome;
      for (int i = 0; i < 40; ++i) {
        const double x = random.uniform(-0.8, 0.8), y = random.uniform(-0.8, 0.8);
        for (const Ray<double>& ray : {grazing.next(),
                                       Ray<double>{{x, y, 5}, {0, 0, -1}},
                                       {{x / 50, y / 50, 5}, {0, 0, -1}},
                                       {{5 * x, 5 * y, 3}, {-5 * x, -5 * y, -2}}}) {
          const FromHull from{hull, radius, ray.origin.cast<Long>(), ray.direction.cast<Long>()};
          outcome.add(cast_ray(prepared, ray), truth_by_bisection(from, ray, R), ray.direction, R);
        }
      }
      expect_within(outcome, {1e-14, 1e-14, 51});
    }
}

/// Rounded by much more than its size, a hull is a ball that has as many facets as it likes.
TEST(RoundedHull, by_much_more_than_its_size_is_a_ball) {
  for (const double radius : {1e3, 1e8, 1e17, 1e24}) {
    SCOPED_TRACE(radius);
    Random random(93);
    std::vector<Vec3<double>> points;
    for (int i = 0; i < 30; ++i) points.push_back(random.direction());
    const PreparedShape prepared(Shape(Rounded{radius, Shape(Hull{PointCloud(points)})}));
    const double allowed = 1 + 16 * radius * std::numeric_limits<double>::epsilon();
    int hits = 0;
    for (int i = 0; i < 500; ++i) {
      const Vec3<double> o = random.direction() * 3 * radius;
      const Ray<double> ray{o, random.direction() * radius * random.uniform(0, 1.5) - o};
      const Vec3<Long> from = ray.origin.cast<Long>(), along = ray.direction.cast<Long>();
      const Long a = along.squaredNorm(), b = from.dot(along);
      const Long beside = (from - along * (b / a)).norm();
      const CastResult<double> result = cast_ray(prepared, ray);
      if (beside > radius + 2 * allowed) {
        EXPECT_EQ(result.status, Status::miss);
      } else if (beside < radius - 2 * allowed) {
        ASSERT_EQ(result.status, Status::hit);
        const Long t = Long(result.t_base) + Long(result.t_offset);
        EXPECT_NEAR(static_cast<double>((from + along * t).norm()), radius, 2 * allowed);
        ++hits;
      }
    }
    EXPECT_GT(hits, 100);
  }
}

}  // namespace
}  // namespace minkray::testing
