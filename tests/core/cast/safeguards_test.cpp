// SPDX-License-Identifier: MIT
// Truths that no other test asked about: `./run mutate` changed the line of code that each of them
// needs, and nothing noticed (docs/records/mutation.md).
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "core/contact/distance.h"
#include "core/contact/shape_cast.h"
#include "core/derived/convert.h"
#include "core/gjk/johnson.h"
#include "core/proof/check_certificate.h"
#include "tests/proof/certified_casts.h"
#include "tests/support/random.h"

namespace minkray::testing {
namespace {

using V = Vec3<double>;

Affine<double> moved(const V& by) {
  return {Mat3<double>::Identity(), by};
}

Shape<double> mapped(const Shape<double>& shape, const Affine<double>& map) {
  return Transform<double>{shape, map};
}

// The maps around a shape were left out of its place in the world.
TEST(Distance, of_balls_that_are_scaled_and_moved_has_its_closed_form) {
  Random random(31);
  int apart = 0;
  for (int i = 0; i < 200; ++i) {
    // Each ball is scaled and moved, turned around the world's origin, and placed: three maps.
    struct Ball {
      CentredShape<double> shape;
      V centre;
      double radius;
    };
    const auto ball = [&]() -> Ball {
      const double scale = 0.5 + random.uniform(), radius = 0.5 + random.uniform();
      const V shift = 2 * random.in_cube(), place = 3 * random.in_cube();
      const Mat3<double> turn = random.rotation();
      const Affine<double> first{scale * Mat3<double>::Identity(), shift};
      const Affine<double> second{turn, V::Zero()};
      return {centred(mapped(mapped(Sphere<double>{radius}, first), second), moved(place)),
              V(turn * shift + place), scale * radius};
    };
    const Ball a = ball(), b = ball();
    const double gap = (a.centre - b.centre).norm() - a.radius - b.radius;
    const DistanceResult<double, 3> result = distance_between(a.shape, b.shape);
    EXPECT_NEAR(result.distance, std::max(gap, 0.0), 1e-13);
    apart += gap > 0 ? 1 : 0;
  }
  EXPECT_GT(apart, 50);
  EXPECT_LT(apart, 190);
}

// The backup procedure answered for all simplices, or with nothing, and only time was lost.
TEST(Johnson, asks_for_backup_for_vertices_in_line_alone_and_gets_a_point_of_them) {
  Random random(3);
  const auto closest = [&](double thickness) {
    JohnsonSubalgorithm<double, 3> simplex;
    simplex.begin(V::Zero());
    const V middle = 2 * random.direction(), along = random.direction();
    for (int i = 0; i < 4; ++i)
      simplex.add(middle + random.uniform(-1, 1) * along + thickness * random.in_cube());
    return simplex.closest();
  };
  int backups = 0;
  for (int i = 0; i < 5000; ++i) {
    EXPECT_TRUE(closest(0.1).proper);
    const auto answer = closest(0);
    backups += answer.proper ? 0 : 1;
    EXPECT_GT(answer.v.norm(), 1 - 1e-12);  // the line's part is between 1 and 3 away
    EXPECT_LT(answer.v.norm(), 3);
  }
  EXPECT_GT(backups, 10);
}

// The new place of the first shape was forgotten.
TEST(ShapeCast, begins_where_both_shapes_were_put) {
  PreparedPair<double> pair(centred<double>(Sphere<double>{1}), centred<double>(Sphere<double>{2}));
  pair.place({-3, 5, 1}, {4, 5, 1});
  const ShapeCastResult<double> result = cast_shape(pair, V(-2, 0, 0));
  ASSERT_EQ(result.cast.status, Status::hit);
  EXPECT_NEAR(result.cast.t(), 2, 1e-14);
  EXPECT_LE((result.point_a - V(-2, 5, 1)).norm(), 1e-13);
  EXPECT_LE((result.point_b - V(-2, 5, 1)).norm(), 1e-13);
}

// All shapes whose insides were certified lay around the origin.
TEST(Certificate, of_an_origin_within_a_shape_is_that_shapes_wherever_it_is) {
  const V where(40, -30, 20);
  const Shape<double> ball = mapped(Sphere<double>{2}, moved(where));
  const SupportFunction support = supports_of(ball);
  for (const V& from : {where, V(where + V(1, -1, 0.5)), V(-where), V(where + V(1.5, 1.5, 0))}) {
    const Ray<double> ray{from, V(0, 0, 1)};
    Claim claim;
    claim.status = Status::inside;
    const CertificateVerdict verdict =
        check_certificate(support, ray, claim, certify(support, ray, claim));
    EXPECT_EQ(verdict.holds, (from - where).norm() < 2) << from.transpose();
    if (!verdict.holds) continue;
    EXPECT_EQ(verdict.t_base + verdict.offset_lo, 0);  // where the ray begins
    EXPECT_EQ(verdict.t_base + verdict.offset_hi, 0);
  }
}

// Of a flat shape the plane touches with both normals.
TEST(Certificate, of_a_flat_shape_hit_from_behind_its_normal_is_refused) {
  const Shape<double> disk = Disk<double>{1};
  const SupportFunction support = supports_of(disk);
  const Ray<double> ray{{0.25, 0.5, 2}, {0.1, 0, -1}};
  Claim claim = claim_of(cast_ray(PreparedShape<double>(disk), ray));
  ASSERT_EQ(claim.status, Status::hit);
  for (const double side : {1.0, -1.0}) {
    claim.normal = {0, 0, side};
    EXPECT_EQ(check_certificate(support, ray, claim, certify(support, ray, claim)).holds, side > 0);
  }
}

// The checker's allowance could be ten times as wide.
TEST(Certificate, a_hit_is_refused_that_is_two_hundred_roundings_off) {
  const Shape<double> ball = Sphere<double>{2};
  const SupportFunction support = supports_of(ball);
  const Ray<double> ray{{-3, 0, 0}, {1, 0, 0}};                        // enters at t = 1
  const double rounding = 2 * std::numeric_limits<double>::epsilon();  // of the radius
  for (const double roundings : {-200.0, -10.0, 0.0, 10.0, 200.0}) {
    Claim claim = claim_of(cast_ray(PreparedShape<double>(ball), ray));
    claim.t_offset += roundings * rounding;
    EXPECT_EQ(check_certificate(support, ray, claim, certify(support, ray, claim)).holds,
              std::abs(roundings) < 100)
        << roundings;
  }
}

// How late a claim is was told by nobody.
TEST(Certificate, tells_how_far_beyond_its_bounds_a_late_hit_is) {
  const Shape<double> ball = Sphere<double>{2};
  const SupportFunction support = supports_of(ball);
  const Ray<double> ray{{-3, 0, 0}, {1, 0, 0}};
  const Claim right = claim_of(cast_ray(PreparedShape<double>(ball), ray));
  const Certificate certificate = certify(support, ray, right);
  for (const double late : {0.0, 1e-9, 1e-3, 0.5}) {
    Claim claim = right;
    claim.t_offset += late;
    EXPECT_NEAR(check_certificate(support, ray, claim, certificate).late, late, 1e-14);
  }
}

// Support points on the right plane, but beside the ray, were taken for a proof.
TEST(Certificate, whose_support_points_span_a_spot_beside_the_ray_is_refused) {
  const Shape<double> box = Box<double>{{1, 2, 3}};
  const SupportFunction support = supports_of(box);
  const Ray<double> ray{{-5, 0.5, 0.25}, {1, 0, 0}};
  const Claim claim = claim_of(cast_ray(PreparedShape<double>(box), ray));
  Certificate certificate = certify(support, ray, claim);
  ASSERT_TRUE(check_certificate(support, ray, claim, certificate).holds);
  certificate.plane = {-1, 0, 0};
  certificate.spanning = {};
  certificate.spanning[0] = {V(-1, 0.1, 0.1), 1};  // a corner of the face that is hit
  const CertificateVerdict verdict = check_certificate(support, ray, claim, certificate);
  EXPECT_FALSE(verdict.holds);
  EXPECT_NEAR(verdict.lateral, V(0, 1.5, 2.75).norm(), 1e-12);
}

// With weights below zero, support points span spots outside the shape.
TEST(Certificate, with_negative_weights_is_refused) {
  const Shape<double> box = Box<double>{{1, 2, 3}};
  const SupportFunction support = supports_of(box);
  const Ray<double> beside{{-5, 3, 3}, {1, 0, 0}};
  Claim claim;
  claim.status = Status::hit;
  claim.t_offset = 4;
  claim.normal = {-1, 0, 0};
  Certificate certificate;
  certificate.plane = {-1, 0, 0};
  certificate.spanning[0] = {V(-1, 1, 1), 1.25};
  certificate.spanning[1] = {V(-1, -1, 1), -0.25};
  EXPECT_FALSE(check_certificate(support, beside, claim, certificate).holds);
}

// Algorithm 1 was asked about hits alone.
TEST(Cast, of_every_solver_tells_hits_misses_and_insides_apart) {
  for (const SolverDescription& solver : solver_descriptions) {
    CastOptions<double> options;
    options.solver = solver.kind;
    for (const Shape<double>& shape :
         {Shape<double>(Sphere<double>{1}), Shape<double>(Cylinder<double>{1, 1})}) {
      const PreparedShape<double> prepared(shape);
      const auto cast = [&](const V& origin, const V& direction) {
        return cast_ray(prepared, Ray<double>{origin, direction}, options);
      };
      const CastResult<double> hit = cast({-4, 0, 0}, {1, 0, 0});
      EXPECT_EQ(hit.status, Status::hit) << solver.name;
      EXPECT_NEAR(hit.t(), 3, 1e-7) << solver.name;
      EXPECT_LT(hit.normal.x(), -0.999) << solver.name;
      EXPECT_EQ(cast({0.25, 0.5, 0}, {1, 0, 0}).status, Status::inside) << solver.name;
      EXPECT_EQ(cast({0.25, 0.5, 0}, {1, 0, 0}).t(), 0) << solver.name;
      for (const V& from : {V(-4, 1.5, 0), V(4, 0, 0), V(-4, 0, 1.75)}) {
        const CastResult<double> miss = cast(from, {1, 0, 0});
        EXPECT_EQ(miss.status, Status::miss) << solver.name;
        EXPECT_GT(miss.normal.dot(from), miss.normal.dot(shape.support(miss.normal)))
            << solver.name;
      }
    }
  }
}

}  // namespace
}  // namespace minkray::testing
