// SPDX-License-Identifier: MIT
// Casts at superellipsoids of all exponents against bisection in long double: the hit, what is
// missed, and how many support calls it takes.
#include <gtest/gtest.h>

#include "tests/support/cast_truth.h"

namespace minkray::testing {
namespace {

using Long = long double;

/// The gauge |x/a|_p along a line, by the C library's powers.
struct GaugeAlong {
  Vec3<Long> radii, origin, direction;
  Long p;

  Vec3<Long> at(Long t) const { return (origin + t * direction).cwiseQuotient(radii); }
  Long gauge(Long t) const {
    const Vec3<Long> x = at(t).cwiseAbs();
    const Long largest = x.maxCoeff();
    if (!(largest > 0)) return 0;
    Long sum = 0;
    for (int i = 0; i < 3; ++i) sum += std::pow(x[i] / largest, p);
    return largest * std::pow(sum, 1 / p);
  }
  /// The gradient of the gauge, in the shape's frame.
  Vec3<Long> normal(Long t) const {
    const Vec3<Long> x = at(t);
    const Long largest = x.cwiseAbs().maxCoeff();
    Vec3<Long> n;
    Long sum = 0;
    for (int i = 0; i < 3; ++i) {
      n[i] = std::copysign(std::pow(std::abs(x[i]) / largest, p - 1), x[i]);
      sum += std::pow(std::abs(x[i]) / largest, p);
    }
    return n.cwiseQuotient(radii) * std::pow(sum, 1 / p - 1);
  }
  Long slope(Long t) const { return normal(t).dot(direction); }
  Long outside(Long t) const { return (gauge(t) - 1) / normal(t).norm(); }
};

CastOutcome cast_at(const Superellipsoid& shape, RayFamily family, int count) {
  const double R = ball_around(bounds_of(Shape(shape))).radius;
  return cast_family(shape, family, count, [&](const Ray<double>& ray) {
    return truth_by_bisection(GaugeAlong{shape.radii.cast<Long>(), ray.origin.cast<Long>(),
                                         ray.direction.cast<Long>(), shape.exponent},
                              ray, R);
  });
}

std::vector<Superellipsoid> superellipsoids() {
  std::vector<Superellipsoid> all;
  for (const double p : {1.2, 1.5, 1.9, 2.001, 2.5, 3.0, 4.0, 5.5, 8.0, 12.0, 60.0})
    for (const Vec3<double>& radii : {Vec3<double>(1, 1, 1), Vec3<double>(0.3, 2, 0.7)})
      all.push_back({radii, p});
  all.push_back({{1, 0.03, 0.001}, 4});
  return all;
}

std::string name_of(const Superellipsoid& shape) {
  std::ostringstream text;
  text << shape.radii.transpose() << ", p = " << shape.exponent;
  return text.str();
}

/// Rounding error of a support plane, and of the gauge: a few epsilon.
constexpr double exactness = 6 * std::numeric_limits<double>::epsilon();

/// Casts that the GJK ray cast has finished are right to its own rounding.
constexpr double stalled = tolerance::gjk_stalled<double>;

class Superellipsoids : public ::testing::TestWithParam<RayFamily> {};

TEST_P(Superellipsoids, are_hit_and_grazed_to_rounding_by_one_support_call) {
  int misses = 0;
  for (const Superellipsoid& shape : superellipsoids()) {
    SCOPED_TRACE(name_of(shape));
    const int count = 100;
    const CastOutcome outcome = cast_at(shape, GetParam(), count);
    expect_within(outcome, {exactness, exactness});
    // One proves, but where a ray is tangent within rounding.
    EXPECT_LE(outcome.supports, 1.05 * count);
    EXPECT_LE(outcome.most_supports, 24);
    misses += outcome.misses;
  }
  EXPECT_GT(misses, 300);
}

INSTANTIATE_TEST_SUITE_P(Families, Superellipsoids,
                         ::testing::Values(RayFamily::random, RayFamily::grazing),
                         [](const auto& tested) { return std::string(name_of(tested.param)); });

/// Rays along axes and in coordinate planes, where curvature vanishes or is infinite, at the
/// middle of flat sides and tangential there. One may not converge.
TEST(Superellipsoid, is_hit_by_rays_along_its_axes_and_in_its_planes) {
  for (const Superellipsoid& shape : superellipsoids()) {
    SCOPED_TRACE(name_of(shape));
    expect_within(cast_at(shape, RayFamily::degenerate, 100), {.worst = stalled, .others = 1});
  }
}

/// Next to the octahedron and next to the box, which the bands above would be too narrow for: the
/// surface turns by a right angle within rounding.
TEST(Superellipsoid, of_extreme_exponents_is_hit_and_missed) {
  for (const double p : {1.0001, 1.01, 1e3, 1e6, 1e12}) {
    SCOPED_TRACE(p);
    expect_within(cast_at({{1, 0.7, 0.5}, p}, RayFamily::random, 300),
                  {.worst = stalled, .hits = 151});
  }
}

/// Near the creases of exponents below 2 the radius of curvature falls to nothing. A jet of a
/// larger one agreed with planes that cut off the points on the crease. The jet must predict how
/// the support point moves with the direction, which the difference of two support points
/// measures.
TEST(Superellipsoid, has_the_curvature_of_its_jet_up_to_its_creases) {
  const Superellipsoid shape{{0.045, 0.09, 9.7}, 1.16};
  for (Long slope = 0.3L; slope > 1e-6L; slope /= 4) {
    SCOPED_TRACE(static_cast<double>(slope));
    const Vec3<Long> n(4, 7, slope * 0.06L), across(0, 0, n.z() * 0.0001L);
    const Jet<Long> jet = shape.jet<Long>(n);
    const Vec3<Long> moved =
        (shape.support<Long>(n + across) - shape.support<Long>(n - across)) / 2;
    const Vec3<Long> u = jet.F.transpose() * n, g = jet.F * u.normalized();
    const Vec3<Long> by_jet = (jet.F * (jet.F.transpose() * across) - g * g.dot(across)) / u.norm();
    EXPECT_NEAR(static_cast<double>(by_jet.z() / moved.z()), 1, 1e-6);
    EXPECT_LE((g - jet.s).norm(), 1e-15L * jet.s.norm());
  }
}

}  // namespace
}  // namespace minkray::testing
