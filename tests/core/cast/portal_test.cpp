// SPDX-License-Identifier: MIT
// Compares casts at shapes without a closed form with a slow portal refinement in long double.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "core/derived/ellipsoid_sum.h"
#include "tests/oracle/closed_form.h"
#include "tests/oracle/portal.h"
#include "tests/support/as_test_name.h"
#include "tests/support/ray_families.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/values_asked_for.h"

namespace minkray::testing {
namespace {

/// In radii, as a distance between planes.
constexpr Long portal_gap = 1e-15L;

using S = Shape;

S rotated(S shape, const Mat3<double>& turn, const Vec3<double>& by = {0.1, 0.2, 0.3}) {
  return Transform{std::move(shape), AffineMap(Affine<double>{turn, by})};
}

S rotated(S shape, const Vec3<double>& axis, double angle) {
  const Mat3<double> turn = Eigen::AngleAxis<double>(angle, axis.normalized()).toRotationMatrix();
  return rotated(std::move(shape), turn, {0.1, -0.2, 0.3});
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
      const PortalHit hit = portal(o, d, portal_gap);
      ASSERT_EQ(hit.answer == PortalHit::Answer::miss, exact.empty());
      if (exact.empty()) continue;
      ++hits;
      ASSERT_EQ(hit.answer, PortalHit::Answer::hit);
      EXPECT_LE(hit.t_lo, exact.lower + 1e-17L);
      EXPECT_GE(hit.t_hi, exact.lower - 1e-17L);
      EXPECT_LE((hit.t_hi - hit.t_lo) * std::abs(hit.normal.dot(d)),
                portal_gap * portal.radius() * 2);
    }
    EXPECT_GT(hits, 40);
  }
}

struct PortalRow {
  std::string name;
  S shape;
  RayFamily family;
  int rays, hits;  ///< the least number of hits
  Long gap, band;  ///< of the portal, and around the silhouette within which either is right, in R
  double allowed;  ///< error of t times cosine, in R
  double supports = 1e9;  ///< per ray
  int most_supports = 1 << 30;
};

void PrintTo(const PortalRow& row, std::ostream* out) {
  *out << row.name << ", " << name_of(row.family);
}

const S egg = Ellipsoid{{1, 0.5, 0.25}}, other = Ellipsoid{{0.3, 0.5, 1}};

/// Sums of ellipsoids, by name.
std::vector<SampleShape> sums() {
  const S across = rotated(other, {1, 2, 3}, 1.1);
  return {{"two, aligned", MinkowskiSum{{egg, other}}},
          {"two, turned", MinkowskiSum{{egg, across}}},
          {"three", MinkowskiSum{{egg, across, rotated(Ellipsoid{{1, 1, 0.2}}, {2, -1, 1}, 2)}}},
          {"grown", Rounded{0.1, egg}},
          {"difference", MinkowskiDifference{egg, across}}};
}

/// Sums of ellipsoids are met to a few roundings of a support plane, and ordinary ones by one
/// support call; others to the allowance of certificates (core/proof/check_certificate.h).
std::vector<PortalRow> portal_rows() {
  std::vector<PortalRow> rows;
  const auto add_sum = [&](const SampleShape& sum, RayFamily family, double supports, int most) {
    rows.push_back({sum.name, sum.shape, family, 300, 1, 1e-16L, 1e-14L,
                    4 * std::numeric_limits<double>::epsilon(), supports, most});
  };
  for (const SampleShape& sum : sums()) {
    add_sum(sum, RayFamily::random, 1, 1);
    add_sum(sum, RayFamily::grazing, 1, 1);
    add_sum(sum, RayFamily::degenerate, 2, 10);
  }
  // Radii where one is negligible next to the others.
  const S needle = rotated(Ellipsoid{{1, 0.01, 0.01}}, {1, 2, 3}, 1.1),
          plate = rotated(Ellipsoid{{1, 0.03, 0.001}}, {1, 2, 3}, 1);
  add_sum({"needles", MinkowskiSum{{needle, S(Ellipsoid{{0.01, 1, 0.01}})}}}, RayFamily::random, 4,
          60);
  add_sum({"plate and ball", MinkowskiSum{{plate, S(Sphere{0.2})}}}, RayFamily::random, 4, 60);

  const S rod = Cylinder{0.4, 1};
  const auto at_random = [](const S& shape, std::uint64_t seed) {
    return rotated(shape, Random(seed).rotation());
  };
  std::vector<SampleShape> others = {
      {"superellipsoid, p = 4", Superellipsoid{{1, 0.7, 0.5}, 4}},
      {"superellipsoid, p = 1.5", Superellipsoid{{1, 1, 1}, 1.5}},
      {"sum of ellipsoids", MinkowskiSum{{egg, at_random(egg, 7)}}},
      {"rounded cylinder", Rounded{0.1, rod}},
      {"nested hulls", HullOf{{S(HullOf{{egg, at_random(rod, 8)}}), at_random(egg, 9)}}},
      {"cylinder less cylinder", MinkowskiDifference{rod, at_random(rod, 10)}},
  };
  for (const std::uint64_t seed : {701u, 702u, 703u, 704u, 705u, 706u}) {
    const S shape = Rounded{0.05, random_nesting(seed)};
    others.push_back({name_of_nesting(shape), shape});
  }
  for (const SampleShape& one : others)
    for (const auto& [family, rays] :
         {std::pair(RayFamily::random, 200), {RayFamily::grazing, 100}})
      rows.push_back({one.name, one.shape, family, rays, rays / 4, portal_gap, 0,
                      64 * std::numeric_limits<double>::epsilon()});
  return rows;
}

class BesidePortal : public ::testing::TestWithParam<PortalRow> {};

TEST_P(BesidePortal, casts_are_right) {
  const PortalRow& row = GetParam();
  const PreparedShape prepared(row.shape);
  const PortalCast portal(row.shape);
  FamilyRays rays(row.shape, row.family, 71);
  int hits = 0, undecided = 0, supports = 0;
  for (int i = 0; i < row.rays; ++i) {
    const Ray<double> ray = rays.next();
    const CastResult<double> result = cast_ray(prepared, ray);
    ASSERT_NE(result.status, Status::exhausted) << i;
    supports += result.supports;
    EXPECT_LE(result.supports, row.most_supports) << i;
    const Vec3<Long> o = ray.origin.cast<Long>(), d = ray.direction.cast<Long>();
    const PortalHit truth = portal(o, d, row.gap);
    if (truth.answer == PortalHit::Answer::undecided) {
      ++undecided;
      continue;
    }
    const bool hit = result.status == Status::hit;
    hits += hit;
    if (hit != (truth.answer == PortalHit::Answer::hit)) {
      // Moved by the band, does the ray do what the cast claims?
      const Vec3<Long> n = result.normal.cast<Long>();
      const Vec3<Long> beside =
          unit<double>((n - d * (n.dot(d) / d.squaredNorm())).cast<double>()).cast<Long>();
      const Vec3<Long> moved = o + beside * (row.band * portal.radius() * (hit ? -1 : 1));
      EXPECT_EQ(portal(moved, d, row.gap).answer == PortalHit::Answer::hit, hit) << i;
    } else if (hit) {
      const Long t = Long(result.t_base) + Long(result.t_offset);
      const Long error = (t - (truth.t_lo + truth.t_hi) / 2) * truth.normal.dot(d);
      EXPECT_LE(std::abs(error), row.allowed * portal.radius()) << i;
    }
  }
  EXPECT_GE(hits, row.hits);
  EXPECT_LT(undecided, row.rays / 4);
  EXPECT_LE(supports, row.supports * row.rays);
}

INSTANTIATE_TEST_SUITE_P(Shapes, BesidePortal, values_asked_for<BesidePortal>(portal_rows),
                         [](const auto& tested) {
                           return as_test_name(tested.param.name + " " +
                                               std::string(name_of(tested.param.family)));
                         });

TEST(SumOfEllipsoids, is_told_from_other_shapes) {
  for (const SampleShape& sum : sums()) EXPECT_TRUE(is_ellipsoid_sum(sum.shape)) << sum.name;
  for (const S& shape :
       {S(MinkowskiSum{{egg, S(Box{{1, 1, 1}})}}), S(MinkowskiSum{{egg, S(Disk{1})}}),
        S(HullOf{{egg, rotated(egg, {1, 0, 0}, 1)}})})
    EXPECT_FALSE(is_ellipsoid_sum(shape)) << name_of_nesting(shape);
}

}  // namespace
}  // namespace minkray::testing
