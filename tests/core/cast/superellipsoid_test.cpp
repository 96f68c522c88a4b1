// SPDX-License-Identifier: MIT
// Casts at superellipsoids of all exponents against bisection in long double: the hit, what is
// missed, and how many support calls it takes.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "tests/support/cast_truth.h"
#include "tests/support/ray_families.h"

namespace minkray::testing {
namespace {

using Long = long double;

/// The gauge |x/a|_p along a line, by the C library's powers.
struct Line {
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
};

CastTruth truth_of(const Line& line, Long R) {
  const Long middle = -line.origin.dot(line.direction) / line.direction.squaredNorm();
  const Long ball = 2 * R / line.direction.norm();
  const Long least = bisected(middle - ball, middle + ball,
                              [&](Long t) { return line.normal(t).dot(line.direction) < 0; });
  const Long gauge = line.gauge(least);
  const double beside = static_cast<double>((gauge - 1) / line.normal(least).norm());
  if (gauge > 1) return {false, beside, 0, Vec3<Long>::Zero()};
  const Long t = bisected(middle - ball, least, [&](Long at) { return line.gauge(at) > 1; });
  return {true, beside, t, line.normal(t).normalized()};
}

CastOutcome cast_at(const Superellipsoid& wanted, RayFamily family, int count) {
  const Shape shape = Shape(wanted);
  const auto& exact = std::get<Superellipsoid>(shape.kind);
  const PreparedShape prepared(shape);
  FamilyRays rays(shape, family, 83);
  const double R = rays.ball().radius;
  CastOutcome outcome;
  for (int i = 0; i < count; ++i) {
    const Ray<double> ray = rays.next();
    const Ray<double> known = ray;
    const Line line{exact.radii.cast<Long>(), known.origin.cast<Long>(),
                    known.direction.cast<Long>(), exact.exponent};
    outcome.add(cast_ray(prepared, ray), truth_of(line, R), known.direction, R);
  }
  return outcome;
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

void check_ordinary(RayFamily family) {
  int misses = 0;
  for (const Superellipsoid& shape : superellipsoids()) {
    SCOPED_TRACE(name_of(shape));
    const int count = 100;
    const CastOutcome outcome = cast_at(shape, family, count);
    EXPECT_EQ(outcome.wrong, 0);
    EXPECT_EQ(outcome.others, 0);
    EXPECT_LE(outcome.worst, exactness);
    EXPECT_LE(outcome.unproven, exactness);
    // One proves, but where a ray is tangent within rounding.
    EXPECT_LE(outcome.supports, 1.05 * count);
    EXPECT_LE(outcome.most_supports, 24);
    EXPECT_GT(outcome.hits, 0);
    misses += outcome.misses;
  }
  EXPECT_GT(misses, 300);
}

TEST(Superellipsoid, is_hit_to_rounding_by_one_support_call) {
  check_ordinary(RayFamily::random);
}

TEST(Superellipsoid, is_grazed_to_rounding_by_one_support_call) {
  check_ordinary(RayFamily::grazing);
}

/// Rays along axes and in coordinate planes, where curvature vanishes or is infinite, at the
/// middle of flat sides and tangential there.
void check_degenerate() {
  for (const Superellipsoid& shape : superellipsoids()) {
    SCOPED_TRACE(name_of(shape));
    const CastOutcome outcome = cast_at(shape, RayFamily::degenerate, 100);
    EXPECT_EQ(outcome.wrong, 0);
    EXPECT_LE(outcome.others, 1);  // that did not converge
    // Casts that the GJK ray cast has finished are right to its own rounding.
    EXPECT_LE(outcome.worst, static_cast<double>(tolerance::gjk_stalled<double>));
    EXPECT_GT(outcome.hits, 0);
  }
}

TEST(Superellipsoid, is_hit_by_rays_along_its_axes_and_in_its_planes) {
  check_degenerate();
}

/// Next to the octahedron and next to the box, which the bands above would be too narrow for: the
/// surface turns by a right angle within rounding.
TEST(Superellipsoid, of_extreme_exponents_is_hit_and_missed) {
  for (const double p : {1.0001, 1.01, 1e3, 1e6, 1e12}) {
    SCOPED_TRACE(p);
    const Superellipsoid shape{{1, 0.7, 0.5}, p};
    const CastOutcome outcome = cast_at(shape, RayFamily::random, 300);
    EXPECT_EQ(outcome.wrong, 0);
    EXPECT_EQ(outcome.others, 0);
    EXPECT_LE(outcome.worst, static_cast<double>(tolerance::gjk_stalled<double>));
    EXPECT_GT(outcome.hits, 150);
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
