// SPDX-License-Identifier: MIT
// Certificates of rays at needles of 1 : 1e10 to 1 : 1e12, thinner than a plane of three rounded
// points can resolve: the number that hold is recorded here, as in docs/verification.md.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "core/proof/check_certificate.h"
#include "core/query/tolerances.h"
#include "tests/support/random.h"

namespace minkray {
namespace {

using V = Vec3<double>;
using testing::Random;

/// A needle about the origin along `axis`, of the k-th kind.
Shape needle(int k, const V& axis, double thin, Random& random) {
  const auto near = [&](double along) -> V { return along * axis + thin * random.in_cube(); };
  Affine<double> turned;
  turned.linear = random.rotation();
  const auto placed = [&](const Shape& shape) -> Shape {
    return Transform{Nested(shape), AffineMap(turned)};
  };
  switch (k) {
    case 0:
      return Triangle{near(1), near(-1), near(random.uniform(-1, 1))};
    case 1: {
      std::vector<V> points;
      for (int i = 0; i < 7; ++i) points.push_back(near(random.uniform(-1, 1)));
      return Hull{PointCloud(points)};
    }
    case 2:
      return Rounded{thin, Nested(Triangle{axis, -axis, near(random.uniform(-1, 1))})};
    case 3:
      return placed(Box{{thin, thin * random.uniform(0.5, 2), 1}});
    case 4:
      return placed(Capsule{thin, 1});
    case 5:
      return placed(Ellipsoid{{thin, 2 * thin, 1}});
    case 6:
      return placed(Cylinder{thin, 1});
    default:
      return placed(Cone{thin, 1});
  }
}
constexpr int kinds = 8, kinds_of_points = 3;

/// Towards a point of the needle, from anywhere, from nearby, or nearly along it.
Ray<double> ray_at(const Shape& shape, const V& axis, double thin, int i, Random& random) {
  const double share = random.uniform();
  const V target =
      share * shape.support(random.direction()) + (1 - share) * shape.support(random.direction());
  V origin = 3 * random.direction();
  if (i % 3 == 0) origin = target + 0.5 * random.direction();
  if (i % 5 == 0) origin = target - 2 * axis + thin * random.in_cube();
  V direction = target - origin;
  if (i % 2 == 1) direction += thin * random.in_cube();
  return {origin, direction};
}

struct Counts {
  int hits = 0, exhausted = 0;
  int beyond_rounding = 0;  ///< certificates of hits that hold only with the allowance for slivers
  int without_certificate = 0;  ///< that do not hold even so
  int misses_without_plane = 0;
};

Counts ask_needles(bool of_points, int rays) {
  Random random(1);
  Counts counts;
  for (int i = 0; i < rays; ++i) {
    const double thin = std::pow(10, -random.uniform(10, 12));
    const V axis = random.direction();
    const int k = of_points ? random.below(kinds_of_points)
                            : kinds_of_points + random.below(kinds - kinds_of_points);
    const Shape shape = needle(k, axis, thin, random);
    const Ray<double> ray = ray_at(shape, axis, thin, i, random);
    const CastResult<double> result = cast_ray(PreparedShape(shape), ray);
    counts.hits += result.found();
    counts.exhausted += result.status == Status::exhausted;
    if (result.status == Status::exhausted) continue;
    const SupportFunction support = supports_of(shape);
    Claim claim = claim_of(result);
    const auto holds = [&] {
      return check_certificate(support, ray, claim, certify(support, ray, claim)).holds;
    };
    if (holds()) continue;
    if (result.status == Status::miss) ++counts.misses_without_plane;
    claim.epsilon *= tolerance::proof_roundings;
    ++(holds() ? counts.beyond_rounding : counts.without_certificate);
  }
  return counts;
}

void print(const char* of, const Counts& counts) {
  std::printf(
      "%s: %d hits, of which %d hold with the allowance for slivers and %d not; %d exhausted\n", of,
      counts.hits, counts.beyond_rounding, counts.without_certificate, counts.exhausted);
}

TEST(Needles, of_curved_kinds_are_answered_and_proven) {
  const Counts counts = ask_needles(false, 20000);
  print("boxes, capsules, ellipsoids, cylinders, cones", counts);
  EXPECT_EQ(counts.exhausted, 0);
  EXPECT_EQ(counts.without_certificate, 0);
  EXPECT_LE(counts.beyond_rounding, 5);
  EXPECT_EQ(counts.misses_without_plane, 0);
  EXPECT_GT(counts.hits, 10000);
}

TEST(Needles, of_points_are_proven_but_for_one_hit_in_a_hundred) {
  const Counts counts = ask_needles(true, 20000);
  print("triangles, hulls, rounded triangles", counts);
  EXPECT_LE(counts.without_certificate * 100, counts.hits);
  EXPECT_LE(counts.beyond_rounding * 10, counts.hits);
  EXPECT_LE(counts.exhausted * 4, 20000);
  EXPECT_EQ(counts.misses_without_plane, 0);
  EXPECT_GT(counts.hits, 5000);
}

}  // namespace
}  // namespace minkray
