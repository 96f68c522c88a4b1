// SPDX-License-Identifier: MIT
// Compares casts at shapes without a closed form with a slow portal refinement in long double.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "tests/oracle/closed_form.h"
#include "tests/oracle/portal.h"
#include "tests/support/ray_families.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/values_asked_for.h"

namespace minkray::testing {
namespace {

/// In radii, as a distance between planes.
constexpr Long gap = 1e-15L;

using S = Shape;

std::vector<SampleShape> without_closed_form() {
  const S egg = Ellipsoid{{1, 0.5, 0.25}}, rod = Cylinder{0.4, 1};
  const auto turned = [](S shape, std::uint64_t seed) -> S {
    return Transform{std::move(shape),
                     AffineMap(Affine<double>{Random(seed).rotation(), {0.1, 0.2, 0.3}})};
  };
  std::vector<SampleShape> shapes = {
      {"superellipsoid, p = 4", Superellipsoid{{1, 0.7, 0.5}, 4}},
      {"superellipsoid, p = 1.5", Superellipsoid{{1, 1, 1}, 1.5}},
      {"sum of ellipsoids", MinkowskiSum{{egg, turned(egg, 7)}}},
      {"rounded cylinder", Rounded{0.1, rod}},
      {"nested hulls", HullOf{{S(HullOf{{egg, turned(rod, 8)}}), turned(egg, 9)}}},
      {"cylinder less cylinder", MinkowskiDifference{rod, turned(rod, 10)}},
  };
  for (const std::uint64_t seed : {701u, 702u, 703u, 704u, 705u, 706u}) {
    S shape = Rounded{0.05, random_nesting(seed)};
    shapes.push_back({name_of_nesting(shape), shape});
  }
  return shapes;
}

/// The oracle is tested itself, where the truth is known.
TEST(Portal, agrees_with_closed_forms) {
  for (const S& shape : {S(Sphere{1}), S(Ellipsoid{{1, 0.5, 0.25}}), S(Cone{1, 1}),
                         S(Cylinder{0.7, 1}), S(Box{{1, 0.5, 0.25}})}) {
    const PortalCast portal(shape);
    FamilyRays rays(shape, RayFamily::random, 31);
    int hits = 0;
    for (int i = 0; i < 200; ++i) {
      const Ray<double> ray = rays.next();
      const Vec3<Long> o = ray.origin.cast<Long>(), d = ray.direction.cast<Long>();
      const Interval exact = *line_in_shape(shape, o, d);
      const PortalHit hit = portal(o, d, gap);
      ASSERT_EQ(hit.answer == PortalHit::Answer::miss, exact.empty());
      if (exact.empty()) continue;
      ++hits;
      ASSERT_EQ(hit.answer, PortalHit::Answer::hit);
      EXPECT_LE(hit.t_lo, exact.lower + 1e-17L);
      EXPECT_GE(hit.t_hi, exact.lower - 1e-17L);
      EXPECT_LE((hit.t_hi - hit.t_lo) * std::abs(hit.normal.dot(d)), gap * portal.radius() * 2);
    }
    EXPECT_GT(hits, 40);
  }
}

class BesidePortal : public ::testing::TestWithParam<SampleShape> {};

void compare(const S& sample, RayFamily family, int count) {
  const Shape rounded = sample;
  const PreparedShape prepared(rounded);
  const PortalCast portal(rounded);
  FamilyRays rays(rounded, family, 32);
  // Allowance of certificates (core/proof/check_certificate.h), here against an independent
  // result.
  const double allowed = 64 * double(std::numeric_limits<double>::epsilon());
  int hits = 0;
  for (int i = 0; i < count; ++i) {
    const Ray<double> ray = rays.next();
    const Ray<double> same_ray = ray;
    const Vec3<Long> o = same_ray.origin.cast<Long>(), d = same_ray.direction.cast<Long>();
    const PortalHit truth = portal(o, d, gap);
    if (truth.answer == PortalHit::Answer::undecided) continue;
    const CastResult<double> result = cast_ray(prepared, ray);
    ASSERT_EQ(result.status, truth.answer == PortalHit::Answer::hit ? Status::hit : Status::miss)
        << "ray " << i;
    if (result.status != Status::hit) continue;
    ++hits;
    const Long t = Long(result.t_base) + Long(result.t_offset);
    const Long cosine = std::abs(truth.normal.dot(d));
    EXPECT_LE((t - truth.t_hi) * cosine, allowed * portal.radius()) << "ray " << i;
    EXPECT_LE((truth.t_lo - t) * cosine, allowed * portal.radius()) << "ray " << i;
  }
  EXPECT_GT(hits, count / 4);
}

TEST_P(BesidePortal, casts) {
  compare(GetParam().shape, RayFamily::random, 200);
  compare(GetParam().shape, RayFamily::grazing, 100);
}

INSTANTIATE_TEST_SUITE_P(Shapes, BesidePortal, values_asked_for<BesidePortal>(without_closed_form));

}  // namespace
}  // namespace minkray::testing
