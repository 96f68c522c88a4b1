// SPDX-License-Identifier: MIT
// Certificates prove what is true, and the checker refuses what is not.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/cast/cast.h"
#include "core/proof/check_certificate.h"
#include "core/query/tolerances.h"
#include "tests/proof/certified_casts.h"
#include "tests/support/random.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/values_asked_for.h"

namespace minkray::testing {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Claim claim_for(const Shape& shape, const Ray<double>& ray) {
  return claim_of(cast_ray(PreparedShape(shape), ray));
}

CertificateVerdict verdict_on(const Shape& shape, const Ray<double>& ray, const Claim& claim) {
  const SupportFunction support = supports_of(shape);
  return check_certificate(support, ray, claim, certify(support, ray, claim));
}

const Shape ball = Sphere{2};
const Ray<double> at_ball{{-5, 1, 0}, {2, 0, 0}};  // enters at t = (5 - sqrt 3) / 2

TEST(Certificate, bounds_enclose_the_exact_hit) {
  const double exact = (5 - std::sqrt(3.0)) / 2;
  const CertificateVerdict verdict = verdict_on(ball, at_ball, claim_for(ball, at_ball));
  ASSERT_TRUE(verdict.holds) << verdict.complaint;
  EXPECT_LE(verdict.t_lo(), exact);
  EXPECT_GE(verdict.t_hi(), exact);
  // The allowance before the plane, and twice that behind it, by the cosine and the speed.
  EXPECT_LT(verdict.t_hi() - verdict.t_lo(), 4 * verdict.allowed / (std::sqrt(3.0) / 2) / 2);
}

/// Three of four intervals of ordinary hits left the truth out: what is rounded was no part of
/// them.
TEST(Certificate, bounds_of_random_and_grazing_hits_hold_the_truth) {
  Random random(8);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const double beside = i % 2 ? random.uniform(0, 1.9) : 2 - std::pow(10, random.uniform(-9, -1));
    const Vec3<double> r = random.direction(), n = unit<double>(r.cross(random.direction()));
    const Ray<double> ray{beside * n - random.uniform(3, 1e3) * r, r * random.uniform(0.1, 10)};
    const Claim claim = claim_for(ball, ray);
    const CertificateVerdict verdict = verdict_on(ball, ray, claim);
    if (claim.status != Status::hit || !verdict.holds) continue;
    ++hits;
    using Long = long double;
    const Vec3<Long> o = ray.origin.cast<Long>(), d = ray.direction.cast<Long>();
    const Long dd = d.squaredNorm(), base = -o.dot(d) / dd;
    const Long exact = base - std::sqrt((4 - (o + base * d).squaredNorm()) / dd);
    // Long double loses as much to far origins.
    const Long unsure = 0x1p-60L * base;
    EXPECT_LE(verdict.t_lo(), exact + unsure);
    EXPECT_GE(verdict.t_hi(), exact - unsure);
  }
  EXPECT_GT(hits, 1500);
}

/// A hit seen by a sloppy solver still gets tight bounds, but is not let through.
TEST(Certificate, a_hit_that_is_early_or_late_is_refused) {
  for (const double error : {-1e-3, -1e-9, -1e-12, 1e-12, 1e-9, 1e-3}) {
    Claim claim = claim_for(ball, at_ball);
    claim.t_offset += error;
    EXPECT_FALSE(verdict_on(ball, at_ball, claim).holds) << error;
    claim.epsilon = double(std::numeric_limits<float>::epsilon());
    EXPECT_EQ(verdict_on(ball, at_ball, claim).holds, std::abs(error) < 1e-6) << error;
  }
}

TEST(Certificate, a_normal_that_is_turned_or_backwards_or_missing_is_refused) {
  const Claim right = claim_for(ball, at_ball);
  for (const Vec3<double>& normal :
       {Vec3<double>(right.normal + Vec3<double>(0, 0, 1e-5)), Vec3<double>(-right.normal),
        Vec3<double>(0, 0, 0), Vec3<double>(NAN, 0, 0), Vec3<double>(0, 0, 1)}) {
    Claim claim = right;
    claim.normal = normal;
    EXPECT_FALSE(verdict_on(ball, at_ball, claim).holds) << normal.transpose();
  }
}

TEST(Certificate, the_wrong_status_is_refused) {
  const Ray<double> beside{{-5, 2.001, 0}, {2, 0, 0}}, from_inside{{1, 1, 0}, {2, 0, 0}};
  for (const Ray<double>& ray : {at_ball, beside, from_inside}) {
    const Claim right = claim_for(ball, ray);
    EXPECT_TRUE(verdict_on(ball, ray, right).holds) << name_of(right.status);
    for (const Status status : {Status::hit, Status::miss, Status::inside, Status::exhausted}) {
      if (status == right.status) continue;
      Claim claim = right;
      claim.status = status;
      if (status == Status::hit) claim.normal = {-1, 0, 0};
      EXPECT_FALSE(verdict_on(ball, ray, claim).holds)
          << name_of(status) << " in place of " << name_of(right.status);
    }
  }
}

/// The checker decides by the certificate, not by the claim.
TEST(Certificate, one_that_proves_nothing_is_refused) {
  const SupportFunction support = supports_of(ball);
  const Claim claim = claim_for(ball, at_ball);
  const Certificate right = certify(support, at_ball, claim);
  ASSERT_TRUE(check_certificate(support, at_ball, claim, right).holds);

  const auto holds = [&](const Certificate& certificate) {
    return check_certificate(support, at_ball, claim, certificate).holds;
  };
  EXPECT_FALSE(holds({}));
  Certificate other = right;
  for (WeightedSupport& part : other.spanning) part.direction = -part.direction;
  EXPECT_FALSE(holds(other)) << "the points of the far side";
  other = right;
  for (WeightedSupport& part : other.spanning) part.direction.z() += 1e-4;
  EXPECT_FALSE(holds(other)) << "points beside the ray";
  other = right;
  other.spanning[0].weight = -1;
  EXPECT_FALSE(holds(other)) << "no convex combination";
  other.spanning[0].weight = NAN;
  EXPECT_FALSE(holds(other));
  other = right;
  other.plane = {-1, 0, 0};
  EXPECT_FALSE(holds(other)) << "a plane that leaves a gap";
}

TEST(Certificate, t_max_is_part_of_the_claim) {
  Ray<double> ray = at_ball;
  const Claim hit = claim_for(ball, ray);
  ray.t_max = 1.6;  // the hit is at 1.634
  EXPECT_FALSE(verdict_on(ball, ray, hit).holds);
  const Claim miss = claim_for(ball, ray);
  ASSERT_EQ(miss.status, Status::miss);
  EXPECT_TRUE(verdict_on(ball, ray, miss).holds);
  ray.t_max = infinity;
  EXPECT_FALSE(verdict_on(ball, ray, miss).holds);
}

TEST(Certificate, rays_without_direction_are_points) {
  for (const double x : {0.0, 1.999, 2.001, 7.0}) {
    const Ray<double> ray{{x, 0, 0}, {0, 0, 0}};
    const Claim claim = claim_for(ball, ray);
    EXPECT_EQ(claim.status, x < 2 ? Status::inside : Status::miss) << x;
    EXPECT_TRUE(verdict_on(ball, ray, claim).holds) << x;
    Claim other = claim;
    other.status = x < 2 ? Status::miss : Status::inside;
    EXPECT_FALSE(verdict_on(ball, ray, other).holds) << x;
  }
}

/// The ray's parameter is never rounded to the size of the origin.
TEST(Certificate, far_origins_cost_nothing) {
  const Ray<double> ray{{-2e7, 1, 0}, {2, 0, 0}};
  Claim claim = claim_for(ball, ray);
  const CertificateVerdict verdict = verdict_on(ball, ray, claim);
  EXPECT_TRUE(verdict.holds) << verdict.complaint;
  EXPECT_LT(verdict.offset_hi - verdict.offset_lo, 2e-13);
  claim.t_offset += 1e-12;
  EXPECT_FALSE(verdict_on(ball, ray, claim).holds);
}

/// If not even long double determines which part of the ray is near the shape, nothing is proven.
TEST(Certificate, origins_too_far_away_are_refused) {
  const Ray<double> ray{{0, 0, -1e34}, {0, 0, 1e30}};
  for (const Status status : {Status::miss, Status::hit}) {
    Claim claim = claim_for(ball, ray);
    claim.status = status;
    claim.normal = {0, 0, -1};
    EXPECT_FALSE(verdict_on(ball, ray, claim).holds);
  }
}

TEST(Certificate, of_rays_that_just_touch_ask_for_support_points_along_directions_only) {
  const Shape box = Box{{1, 2, 3}};
  std::vector<std::pair<const Shape*, Ray<double>>> rays = {
      {&box,
       {{-0.89417536430628464, -2.137556817335728, 2.5962652220212861},
        {0.55164533704108298, 0.040061009287414739, 0.11758066959911173}}}};
  Random random(61);
  for (int i = 0; i < 200; ++i) {
    const Vec3<double> at = random.direction(), along = at.cross(random.direction());
    rays.push_back({&ball, {2 * at - 3 * along, along}});
  }
  int hits = 0;
  for (const auto& [shape, ray] : rays) {
    int no_directions = 0;
    const SupportFunction support = [&, of = shape](const Vec3<double>& n) {
      no_directions += n.allFinite() && !n.isZero(0) ? 0 : 1;
      return of->support(n);
    };
    Claim claim = claim_for(*shape, ray);
    if (claim.status == Status::hit) ++hits;
    certify(support, ray, claim);
    ASSERT_EQ(no_directions, 0) << ray.origin.transpose();
  }
  EXPECT_GT(hits, 40);
}

/// On a rim or a seam the search for support points comes to the origin but slowly.
TEST(Certificate, of_origins_on_the_surface) {
  const Shape capsule = Capsule{1, 1}, cylinder = Cylinder{1, 1};
  for (const auto& [shape, origin] :
       {std::pair(capsule, Vec3<double>(-1, 0, -1)), std::pair(cylinder, Vec3<double>(0, 1, -1)),
        std::pair(cylinder, Vec3<double>(0, 1, 0))}) {
    const Ray<double> ray{origin, {0.5, -0.75, 0.4}};
    const Claim claim = claim_for(shape, ray);
    EXPECT_NE(name_of(claim.status), name_of(Status::miss));
    const CertificateVerdict verdict = verdict_on(shape, ray, claim);
    EXPECT_TRUE(verdict.holds) << verdict.lateral;
  }
}

/// The origin lies on a rim but for a rounding: two support points next to it span it.
TEST(Certificate, of_origins_on_rims) {
  Random random(5);
  int inside = 0;
  for (int i = 0; i < 300; ++i) {
    const double r = random.uniform(0.1, 10), h = random.uniform(0.01, 10);
    const Shape shape = Cylinder{r, h};
    const double angle = random.uniform(0, 6.28);
    const Ray<double> ray{{r * std::cos(angle), r * std::sin(angle), i % 2 ? h : -h},
                          random.direction()};
    const Claim claim = claim_for(shape, ray);
    if (claim.status != Status::inside) continue;
    ++inside;
    const CertificateVerdict verdict = verdict_on(shape, ray, claim);
    EXPECT_TRUE(verdict.holds) << i << ": " << verdict.lateral;
    EXPECT_LT(verdict.lateral, 16 * tolerance::epsilon<double> * (r + h)) << i;
  }
  EXPECT_GT(inside, 50);
}

class CertifiedShapes : public ::testing::TestWithParam<SampleShape> {};

TEST_P(CertifiedShapes, all_casts_are_certified) {
  constexpr int rays = 150;
  for (const RayFamily family : {RayFamily::random, RayFamily::grazing, RayFamily::far}) {
    const CertifiedCasts casts = certified_casts(GetParam().shape, family, rays, 11);
    EXPECT_EQ(casts.rays(), rays);
    EXPECT_EQ(casts.exhausted, 0);
    for (const FailedCertificate& failure : casts.first_failures)
      ADD_FAILURE() << failure.verdict.complaint << ": " << std::setprecision(17)
                    << failure.ray.origin.transpose() << " + t "
                    << failure.ray.direction.transpose();
  }
}

std::vector<SampleShape> solids() {
  return sample_shapes_and_nestings(600, 640);
}

INSTANTIATE_TEST_SUITE_P(SampleShapes, CertifiedShapes, values_asked_for<CertifiedShapes>(solids));

}  // namespace
}  // namespace minkray::testing
