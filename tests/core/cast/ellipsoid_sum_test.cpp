// SPDX-License-Identifier: MIT
// Casts at sums of ellipsoids, turned and moved, against a portal search in long double.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "core/derived/ellipsoid_sum.h"
#include "tests/oracle/portal.h"
#include "tests/support/ray_families.h"

namespace minkray::testing {
namespace {

using S = Shape;

S turned(const S& shape, const Vec3<double>& axis, double angle) {
  const Mat3<double> turn = Eigen::AngleAxis<double>(angle, axis.normalized()).toRotationMatrix();
  return Transform{shape, AffineMap(Affine<double>{turn, {0.1, -0.2, 0.3}})};
}

S ellipsoid(double a, double b, double c) {
  return Ellipsoid{{a, b, c}};
}

struct NamedSum {
  std::string name;
  S shape;
};

std::vector<NamedSum> ordinary() {
  const S egg = ellipsoid(1, 0.5, 0.25), other = turned(ellipsoid(0.3, 0.5, 1), {1, 2, 3}, 1.1);
  return {{"two, aligned", MinkowskiSum{{egg, ellipsoid(0.3, 0.5, 1)}}},
          {"two, turned", MinkowskiSum{{egg, other}}},
          {"three", MinkowskiSum{{egg, other, turned(ellipsoid(1, 1, 0.2), {2, -1, 1}, 2)}}},
          {"grown", Rounded{0.1, egg}},
          {"difference", MinkowskiDifference{egg, other}}};
}

/// Radii where one is negligible next to the others.
std::vector<NamedSum> extreme() {
  const S needle = turned(ellipsoid(1, 0.01, 0.01), {1, 2, 3}, 1.1);
  return {{"needles", MinkowskiSum{{needle, ellipsoid(0.01, 1, 0.01)}}},
          {"plate and ball",
           MinkowskiSum{{turned(ellipsoid(1, 0.03, 0.001), {1, 2, 3}, 1), S(Sphere{0.2})}}}};
}

struct SumsOutcome {
  int hits = 0, misses = 0, undecided = 0, wrong = 0, exhausted = 0, supports = 0, most = 0;
  double worst = 0;  ///< error of t times cosine, in units of R
};

SumsOutcome cast_at(const S& wanted, RayFamily family, int count) {
  const Shape shape = wanted;
  const PreparedShape prepared(shape);
  const PortalCast portal(shape);
  FamilyRays rays(shape, family, 71);
  const double R = rays.ball().radius;
  // Distance from the silhouette within which either result is right, in units of R.
  const double band = 1e-14;
  SumsOutcome outcome;
  for (int i = 0; i < count; ++i) {
    const Ray<double> ray = rays.next();
    const Ray<double> known = ray;
    const CastResult<double> result = cast_ray(prepared, ray);
    outcome.supports += result.supports;
    outcome.most = std::max(outcome.most, result.supports);
    outcome.exhausted += result.status == Status::exhausted;
    const Vec3<Long> o = known.origin.cast<Long>(), d = known.direction.cast<Long>();
    const PortalHit truth = portal(o, d, 1e-16L);
    if (truth.answer == PortalHit::Answer::undecided) {
      ++outcome.undecided;
      continue;
    }
    const bool hits = truth.answer == PortalHit::Answer::hit, hit = result.status == Status::hit;
    outcome.hits += hit;
    outcome.misses += result.status == Status::miss;
    if (hit != hits) {
      // Moved by the band, does the ray do what the cast claims?
      const Vec3<Long> n = result.normal.cast<Long>();
      const Vec3<Long> beside =
          unit<double>((n - d * (n.dot(d) / d.squaredNorm())).cast<double>()).cast<Long>();
      const Vec3<Long> moved = o + beside * (band * R * (hit ? -1 : 1));
      if ((portal(moved, d, 1e-16L).answer == PortalHit::Answer::hit) != hit) ++outcome.wrong;
    } else if (hit) {
      const Long t = static_cast<Long>(result.t_base) + static_cast<Long>(result.t_offset);
      const Long error = (t - (truth.t_lo + truth.t_hi) / 2) * truth.normal.dot(d) / R;
      outcome.worst = std::max(outcome.worst, static_cast<double>(std::abs(error)));
    }
  }
  return outcome;
}

void check(const NamedSum& named, RayFamily family, double supports, int most) {
  SCOPED_TRACE(named.name);
  const int count = 300;
  const SumsOutcome outcome = cast_at(named.shape, family, count);
  EXPECT_EQ(outcome.wrong, 0);
  EXPECT_EQ(outcome.exhausted, 0);
  EXPECT_LT(outcome.undecided, count / 4);
  // A few roundings of a support plane.
  EXPECT_LE(outcome.worst, 4 * std::numeric_limits<double>::epsilon());
  EXPECT_LE(outcome.supports, supports * count);
  EXPECT_LE(outcome.most, most);
  EXPECT_GT(outcome.hits, 0);
}

TEST(SumOfEllipsoids, is_hit_to_rounding_by_one_support_call) {
  for (const NamedSum& named : ordinary()) {
    for (const RayFamily family : {RayFamily::random, RayFamily::grazing}) {
      check(named, family, 1, 1);
    }
  }
}

TEST(SumOfEllipsoids, is_hit_by_degenerate_rays) {
  for (const NamedSum& named : ordinary()) {
    check(named, RayFamily::degenerate, 2, 10);
  }
}

TEST(SumOfEllipsoids, of_needles_and_plates_is_hit_to_rounding) {
  for (const NamedSum& named : extreme()) {
    check(named, RayFamily::random, 4, 60);
  }
}

TEST(SumOfEllipsoids, is_told_from_other_shapes) {
  for (const NamedSum& named : ordinary()) EXPECT_TRUE(is_ellipsoid_sum(named.shape)) << named.name;
  const S egg = ellipsoid(1, 0.5, 0.25), box = Box{{1, 1, 1}}, disk = Disk{1};
  const std::vector<NamedSum> others = {
      {"with a box", MinkowskiSum{{egg, box}}},
      {"with a disk", MinkowskiSum{{egg, disk}}},
      {"beside another", HullOf{{egg, turned(egg, {1, 0, 0}, 1)}}}};
  for (const NamedSum& named : others) EXPECT_FALSE(is_ellipsoid_sum(named.shape)) << named.name;
}

}  // namespace
}  // namespace minkray::testing
