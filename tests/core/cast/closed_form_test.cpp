// SPDX-License-Identifier: MIT
// Casts against closed forms in long double: every shape that has one, every solver, at several
// scales and distances.
#include "tests/oracle/closed_form.h"

#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "tests/support/aimed_rays.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/solvers.h"

namespace minkray::testing {
namespace {

/// Allowed error of a cast in epsilons of the shape's radius, as a distance between planes (error
/// of t times cosine of incidence): where its search stalls, a solver takes a distance of
/// tolerance::gjk_stalled = 256 epsilon for zero, and the inner frame of a transform loses about
/// as much again.
constexpr double allowed = 512;

struct Outcome {
  int hits = 0, undecided = 0, wrong = 0;
  double worst = 0;  ///< error of t times cosine, in epsilons of the radius
  double worst_normal =
      0;  ///< distance of the hit point from the normal's supporting plane, likewise
  std::string first_wrong, worst_ray;
};

Vec3<Long> exact(const Vec3<double>& v) {
  return v.cast<Long>();
}

/// A ray and the truth about it.
struct Query {
  Ray<double> ray;
  bool must_hit, may_hit;  ///< different for rays that graze the shape
  Interval line;
  double towards;  ///< |direction . normal| at the entry; infinite next to the silhouette
};

/// Steepness of a line's entry, from two lines next to it.
double steepness(const Shape& shape, const Ray<double>& ray, Long entry, double radius) {
  const Vec3<Long> o = exact(ray.origin), d = exact(ray.direction);
  const Vec3<Long> u = d.unitOrthogonal() * (1e-7L * radius), v = d.cross(u) / d.norm();
  const auto beside = line_in_shape(shape, o + u, d), above = line_in_shape(shape, o + v, d);
  if (beside->empty() || above->empty()) return std::numeric_limits<double>::infinity();
  const Vec3<Long> a = u + (beside->lower - entry) * d, b = v + (above->lower - entry) * d;
  const Vec3<Long> normal = a.cross(b);
  return static_cast<double>(std::abs(normal.dot(d)) / normal.norm());
}

struct Queries {
  Shape shape;
  double radius, band;
  std::vector<Query> queries;
};

constexpr double epsilon_of_double = std::numeric_limits<double>::epsilon();

Queries queries_of(const Shape& plain, int count, double distance, double scale) {
  const Affine<double> map{Mat3<double>::Identity() * scale, Vec3<double>::Zero()};
  const Shape shape = scale == 1 ? plain : Shape(Transform{Nested(plain), AffineMap(map)});
  const Bounds<double> bounds = bounds_of(shape);
  const double radius = bounds.half_extents().norm();

  // Grown or shrunk by more than any error allowed: a line that meets the one and not the other
  // grazes the shape, and may do either. A far origin's own rounding does not count: it is exact.
  double thinnest = radius;
  for (const double extent : bounds.half_extents())
    if (extent > 1e-9 * radius) thinnest = std::min(thinnest, extent);
  const double band = allowed * epsilon_of_double * radius / thinnest;
  const auto meets = [&](const Ray<double>& ray, Long size) {
    const Vec3<Long> centre = exact(bounds.centre());
    const auto line = line_in_shape(shape, centre + (exact(ray.origin) - centre) / size,
                                    exact(ray.direction) / size);
    return !line->empty() && line->upper >= 0;
  };

  AimedRays rays(bounds, 11, distance);
  const double spread = rays.spread_for_half([&](const Ray<double>& ray) { return meets(ray, 1); });
  Queries all{shape, radius, band, {}};
  for (int i = 0; i < count; ++i) {
    const Ray<double> ray = rays.next(spread);
    const auto line = line_in_shape(shape, exact(ray.origin), exact(ray.direction));
    const double towards = line->empty() ? 0 : steepness(shape, ray, line->lower, radius);
    all.queries.push_back({ray, meets(ray, 1 - band), meets(ray, 1 + band), *line, towards});
  }
  return all;
}

Outcome ask(const Queries& all, const Solver* solver) {
  const double unit = all.radius * epsilon_of_double;
  const PreparedShape prepared(all.shape);
  Outcome outcome;
  for (const auto& [ray, must_hit, may_hit, line, towards_true] : all.queries) {
    const CastResult<double> result = cast_ray(prepared, ray, {solver});
    const bool hit = result.found();
    outcome.hits += hit;
    const auto describe = [&result, &from = ray] {
      std::ostringstream text;
      text.precision(17);
      text << name_of(result.status) << " at " << result.t() << " for origin "
           << from.origin.transpose() << ", direction " << from.direction.transpose();
      return text.str();
    };
    const auto wrong = [&](const char* why) {
      if (outcome.wrong++ == 0) outcome.first_wrong = why + (": " + describe());
    };
    outcome.undecided += must_hit != may_hit;
    if (result.status == Status::exhausted) {
      if (must_hit == may_hit) wrong("gave up");
      continue;
    }
    if (must_hit && !hit) wrong("false miss");
    if (hit && !may_hit) wrong("false hit");
    if (!(hit && must_hit && may_hit)) continue;

    const Long t = Long(result.t_base) + Long(result.t_offset);
    const Vec3<double>& n = result.normal;
    // Next to an edge either face may be answered: a spot as near to the one as to the other.
    const double towards = std::min(std::abs(n.dot(ray.direction)), towards_true);
    const double error = static_cast<double>(std::abs(t - line.lower)) * towards / unit;
    if (error > outcome.worst) {
      outcome.worst = error;
      outcome.worst_ray = describe();
    }
    const Vec3<double> x = (exact(ray.origin) + t * exact(ray.direction)).cast<double>();
    const double depth = n.dot(all.shape.support(n)) - n.dot(x);
    outcome.worst_normal = std::max(outcome.worst_normal, std::abs(depth) / unit);
    EXPECT_NEAR(n.norm(), 1, 8 * epsilon_of_double);
  }
  return outcome;
}

bool has_closed_form(const Shape& shape) {
  return line_in_shape(shape, {-3, 0.1L, 0.2L}, {1, 0.1L, 0.1L}).has_value();
}

void expect_agreement(int count, double distance, double scale) {
  for (const SampleShape& sample : sample_shapes()) {
    if (!has_closed_form(sample.shape)) continue;
    const Queries queries = queries_of(sample.shape, count, distance, scale);
    for (const auto& solver : accurate_solvers()) {
      const std::string what = sample.name + ", solver " + std::string(solver.name);
      const Outcome outcome = ask(queries, solver.kind);
      EXPECT_EQ(outcome.wrong, 0) << what << ": " << outcome.first_wrong;
      EXPECT_LE(outcome.worst, allowed) << what << ": " << outcome.worst_ray;
      EXPECT_LE(outcome.worst_normal, allowed) << what;
      // A share of the rays in proportion to the band grazes.
      EXPECT_LT(outcome.undecided, (0.05 + 2 * queries.band) * count) << what;
      EXPECT_GT(outcome.hits, 0.3 * count) << what;
      EXPECT_LT(outcome.hits, 0.7 * count) << what;
    }
  }
}

TEST(ClosedForms, agree_with_every_solver) {
  expect_agreement(500, 3, 1);
}

TEST(ClosedForms, agree_from_a_hundred_thousand_sizes_away) {
  expect_agreement(100, 1e5, 1);
}

TEST(ClosedForms, agree_at_a_centimetre_and_at_ten_kilometres) {
  for (const double scale : {0.01, 1e4}) expect_agreement(100, 3, scale);
}

}  // namespace
}  // namespace minkray::testing
