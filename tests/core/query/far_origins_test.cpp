// SPDX-License-Identifier: MIT
// Digits kept for rays from far away: all of a position's digits, and t's, up to where casts are
// promised to end (docs/cast.md).
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "core/query/near_segment.h"
#include "core/query/ray_near_ball.h"
#include "tests/oracle/quad.h"
#include "tests/support/random.h"

namespace minkray::testing {
namespace {

/// origin + t * direction, from `centre`.
QuadVec along(const Ray<double>& ray, Quad t, const Vec3<double>& centre) {
  return quad(ray.origin) + t * quad(ray.direction) - quad(centre);
}

double size_of(const QuadVec& p) {
  return std::sqrt(static_cast<double>(p.squaredNorm()));
}

/// The line's point closest to the centre, from there. `first_step` is so short a number that
/// its products with the direction are exact.
QuadVec closest_approach(const Ray<double>& ray, double first_step, const Vec3<double>& centre) {
  const QuadVec at = along(ray, first_step, centre), way = quad(ray.direction);
  return at - (at.dot(way) / way.squaredNorm()) * way;
}

double distance(const Vec3<double>& s, const QuadVec& p) {
  return size_of(QuadVec(quad(s) - p));
}

/// At a point of the unit ball around the origin, from so far away.
Ray<double> from(double distance, Random& random) {
  const Vec3<double> target = random.direction() * random.uniform(0, 0.8);
  const Vec3<double> way = random.direction() * distance;
  return {target - way, way};
}

/// Error of positions that casts compute for rays from 2^least to 2^most radii, in roundings of
/// the ball's radius.
double worst_position(double least, double most) {
  Random random(41);
  double worst = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3<double> centre = random.in_cube();
    const Ray<double> ray = from(std::exp2(random.uniform(least, most)), random);
    RayNearBall<double> near = ray_near(centre, ray);
    if (near.is_from_afar(1.0)) near = ray_near_from_afar(centre, ray);
    const QuadVec nearest = closest_approach(ray, near.t_base, centre);
    // The line may pass the ball by, rounded as its origin is.
    const double scale = std::max(1.0, size_of(nearest));
    worst = std::max(worst, distance(near.s, nearest) / scale);
  }
  return worst / std::numeric_limits<double>::epsilon();
}

TEST(FarOrigins, cost_no_digit_of_a_position) {
  EXPECT_LT(worst_position(0, 52), 4);
  EXPECT_LT(worst_position(52, 57), 4);  // the second way takes over here
  EXPECT_LT(worst_position(57, 61), 4);
}

/// Up to the limit where t's two numbers determine the place on the ball, all rays have results;
/// from further away, no hit has. Rays that lead away miss, wherever they begin.
void check_hits(double limit) {
  const PreparedShape ball{Shape(Sphere{1.0})};
  const CastOptions options{&solver::gjk_alone};  // closed forms end before
  Random random(43);
  int hits = 0;
  for (int i = 0; i < 4000; ++i) {
    const double power = random.uniform(limit - 3, limit + 4);
    const Ray<double> ray = from(std::exp2(power), random);
    if (size_of(closest_approach(ray, 1.0, {0, 0, 0})) > 0.9) continue;
    const CastResult<double> answer = cast_ray(ball, ray, options);
    ASSERT_NE(name_of(answer.status), name_of(Status::miss)) << power;
    if (power < limit - 0.1) {
      ASSERT_EQ(name_of(answer.status), name_of(Status::hit)) << power;
    } else if (power > limit + 1) {
      ASSERT_EQ(name_of(answer.status), name_of(Status::exhausted)) << power;
    }
    ASSERT_GT(answer.supports, 0) << "whatever it says, it was asked";
    const CastResult<double> away =
        cast_ray(ball, Ray<double>{ray.origin, -ray.direction}, options);
    ASSERT_EQ(name_of(away.status), name_of(Status::miss)) << power;
    ASSERT_LT(away.normal.dot(ray.direction), 0.0) << power;
    if (answer.status != Status::hit) continue;
    ++hits;
    const QuadVec spot = along(ray, Quad(answer.t_base) + Quad(answer.t_offset), {0, 0, 0});
    ASSERT_NEAR(size_of(spot), 1, 0.2) << power;
  }
  EXPECT_GT(hits, 500);
}

TEST(FarOrigins, are_answered_up_to_where_t_tells_the_spot) {
  check_hits(62);
}

/// From further away, up to the largest error of a position there: a ray that passes the ball by
/// more than that misses it, and closer ones may have any result.
void check_misses(double limit) {
  const PreparedShape ball{Shape(Sphere{1.0})};
  const CastOptions options{&solver::gjk_alone};
  Random random(53);
  int missed = 0, unknown = 0;
  for (int i = 0; i < 4000; ++i) {
    const double error = std::exp2(1 + i % 4), distance = std::exp2(limit) * error;
    // Along an axis, where all of the way aside is kept.
    const double beside = random.uniform(1, 8), turn = random.uniform(0, 6);
    const Ray<double> ray = {
        Vec3<double>(-distance, beside * error * std::cos(turn), beside * error * std::sin(turn))
            .cast<double>(),
        {double(distance), 0, 0}};
    const Status status = cast_ray(ball, ray, options).status;
    // Bounded by the bounding ball, of a radius from 1 to the diagonal of the shape's box.
    const double least = 1 / error + 4, most = std::sqrt(3) / error + 4;
    if (beside > most + 0.01) {
      ASSERT_EQ(name_of(status), name_of(Status::miss)) << beside;
      ++missed;
    } else if (beside < least - 0.01) {
      ASSERT_EQ(name_of(status), name_of(Status::exhausted)) << beside;
      ++unknown;
    }
  }
  EXPECT_GT(missed, 200);
  EXPECT_GT(unknown, 200);
}

TEST(FarOrigins, from_too_far_miss_by_more_than_positions_may_be_wrong_by) {
  check_misses(62);
}

/// Along an axis past the origin, from so far away: most t's on the way are no numbers of double.
Ray<double> along_axis(double distance, Random& random) {
  Vec3<double> origin = random.in_cube(), way = Vec3<double>::Zero();
  const int axis = random.below(3);
  origin[axis] = -distance;
  way[axis] = distance * random.uniform(0.1, 1);
  return {origin, way};
}

/// Rays in proofs are exact, or known not to be; and exact from where casts give results.
TEST(FarOrigins, are_proven_with_all_digits_or_refused) {
  Random random(47);
  const Vec3<double> middle(0.3, -0.2, 0.1);
  const auto support = [&](const Vec3<double>& n) -> Vec3<double> { return middle + unit(n); };
  int refused = 0;
  double worst = 0;
  for (int i = 0; i < 40000; ++i) {
    const double power = random.uniform(40, 72);
    const Ray<double> ray = along_axis(std::exp2(power), random);
    const NearSegment near = near_segment(support, ray);
    refused += near.is_too_far;
    if (power < 62) {
      ASSERT_FALSE(near.is_too_far) << power;
    }
    if (near.is_too_far) continue;
    // In two steps, whose products are exact.
    const QuadVec at =
        along(ray, near.t_base, near.centre) + Quad(near.t_shift) * quad(ray.direction);
    worst = std::max(worst, distance(near.s, at) / std::max(1.0, size_of(at)));
  }
  EXPECT_LT(worst, std::numeric_limits<double>::epsilon());
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace minkray::testing
