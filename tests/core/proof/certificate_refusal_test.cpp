// SPDX-License-Identifier: MIT
// Certificates that the checker refuses, each for one reason, next to the nearest that it accepts.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/cast/cast.h"
#include "core/proof/certificate.h"
#include "core/proof/check_certificate.h"
#include "tests/support/mapped.h"

namespace minkray::testing {
namespace {

using V = Vec3<double>;

// All shapes whose insides were certified lay around the origin.
TEST(Certificate, of_an_origin_within_a_shape_is_that_shapes_wherever_it_is) {
  const V where(40, -30, 20);
  const Shape ball = mapped(Sphere{2}, moved(where));
  const SupportFunction support = supports_of(ball);
  for (const V& from : {where, V(where + V(1, -1, 0.5)), V(-where), V(where + V(1.5, 1.5, 0))}) {
    const Ray<double> ray{from, V(0, 0, 1)};
    Claim claim;
    claim.status = Status::inside;
    const CertificateVerdict verdict =
        check_certificate(support, ray, claim, certify(support, ray, claim));
    EXPECT_EQ(verdict.holds, (from - where).norm() < 2) << from.transpose();
    if (!verdict.holds) continue;
    EXPECT_EQ(verdict.t_base + verdict.offset_lo, 0);  // begin of the ray
    EXPECT_EQ(verdict.t_base + verdict.offset_hi, 0);
  }
}

// The plane touches a flat shape with both normals.
TEST(Certificate, of_a_flat_shape_hit_from_behind_its_normal_is_refused) {
  const Shape disk = Disk{1};
  const SupportFunction support = supports_of(disk);
  const Ray<double> ray{{0.25, 0.5, 2}, {0.1, 0, -1}};
  Claim claim = claim_of(cast_ray(PreparedShape(disk), ray));
  ASSERT_EQ(claim.status, Status::hit);
  for (const double side : {1.0, -1.0}) {
    claim.normal = {0, 0, side};
    EXPECT_EQ(check_certificate(support, ray, claim, certify(support, ray, claim)).holds, side > 0);
  }
}

// A support mapping's result for no direction is no proof.
TEST(Certificate, with_a_support_point_along_no_direction_is_refused) {
  const Shape ball = Sphere{2};
  const SupportFunction support = [&](const V& n) {
    return n.allFinite() && !n.isZero(0) ? ball.support(n) : V(0, 0, 2);
  };
  const Ray<double> ray{{0, 0, 5}, {0, 0, -1}};  // hits at (0, 0, 2)
  const Claim claim = claim_of(cast_ray(PreparedShape(ball), ray));
  const Certificate right = certify(support, ray, claim);
  ASSERT_TRUE(check_certificate(support, ray, claim, right).holds);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const V& none : {V(0, 0, 0), V(nan, nan, nan), V(0, nan, 0),
                        V(0, 0, std::numeric_limits<double>::infinity())}) {
    Certificate other = right;
    other.spanning = {};
    other.spanning[0] = {none, 1};
    EXPECT_FALSE(check_certificate(support, ray, claim, other).holds) << none.transpose();
    other.spanning[0] = {V(0, 0, 1), 1};
    EXPECT_TRUE(check_certificate(support, ray, claim, other).holds);
  }
}

// The checker's allowance could be ten times as wide.
TEST(Certificate, a_hit_is_refused_that_is_two_hundred_roundings_off) {
  const Shape ball = Sphere{2};
  const SupportFunction support = supports_of(ball);
  const Ray<double> ray{{-3, 0, 0}, {1, 0, 0}};                        // enters at t = 1
  const double rounding = 2 * std::numeric_limits<double>::epsilon();  // of the radius
  for (const double roundings : {-200.0, -10.0, 0.0, 10.0, 200.0}) {
    Claim claim = claim_of(cast_ray(PreparedShape(ball), ray));
    claim.t_offset += roundings * rounding;
    EXPECT_EQ(check_certificate(support, ray, claim, certify(support, ray, claim)).holds,
              std::abs(roundings) < 100)
        << roundings;
  }
}

// The lateness of a claim was not reported.
TEST(Certificate, tells_how_far_beyond_its_bounds_a_late_hit_is) {
  const Shape ball = Sphere{2};
  const SupportFunction support = supports_of(ball);
  const Ray<double> ray{{-3, 0, 0}, {1, 0, 0}};
  const Claim right = claim_of(cast_ray(PreparedShape(ball), ray));
  const Certificate certificate = certify(support, ray, right);
  for (const double late : {0.0, 1e-9, 1e-3, 0.5}) {
    Claim claim = right;
    claim.t_offset += late;
    EXPECT_NEAR(check_certificate(support, ray, claim, certificate).late, late, 1e-14);
  }
}

// Support points on the right plane, but off the ray, were accepted as a proof.
TEST(Certificate, whose_support_points_span_a_spot_beside_the_ray_is_refused) {
  const Shape box = Box{{1, 2, 3}};
  const SupportFunction support = supports_of(box);
  const Ray<double> ray{{-5, 0.5, 0.25}, {1, 0, 0}};
  const Claim claim = claim_of(cast_ray(PreparedShape(box), ray));
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
  const Shape box = Box{{1, 2, 3}};
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

// All is 0 when divided by an infinite sum: the middle of the bounds was spanned by any corners.
TEST(Certificate, whose_weights_have_no_finite_sum_is_refused) {
  const PointCloud corners{{V(0, 0, 0), V(1, 0, 0), V(0, 1, 0), V(0, 0, 1)}};
  const Shape corner = Hull{corners};
  const SupportFunction support = supports_of(corner);
  const Ray<double> ray{{0.5, 0.5, 0.5}, {0, 0, 1}};  // from the middle of the bounds, outside
  Claim claim;
  claim.status = Status::inside;
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double weight : {1.0, 1e308, infinity}) {
    Certificate certificate;
    certificate.spanning[0] = {V(1, 0, 0), weight};
    certificate.spanning[1] = {V(0, 1, 0), weight};
    certificate.spanning[2] = {V(0, 0, 1), 0.5 * weight};
    EXPECT_FALSE(check_certificate(support, ray, claim, certificate).holds) << weight;
  }
}

// The certificate is that of the whole ray: it is the ray's end that refuses.
TEST(Certificate, of_a_hit_beyond_the_rays_end_is_refused) {
  const Shape ball = Sphere{2};
  const SupportFunction support = supports_of(ball);
  Ray<double> ray{{-3, 1, 0.5}, {0.5, 0, 0}};
  const Claim claim = claim_of(cast_ray(PreparedShape(ball), ray));
  ASSERT_EQ(claim.status, Status::hit);
  const Certificate certificate = certify(support, ray, claim);
  const double t = claim.t_base + claim.t_offset;
  for (const double share : {2.0, 1.0, 0.9999, 0.5}) {
    ray.t_max = share * t;
    const CertificateVerdict verdict = check_certificate(support, ray, claim, certificate);
    EXPECT_EQ(verdict.holds, share >= 1) << share;
    // The claim is wrong, and not the proof that was found for it.
    EXPECT_EQ(verdict.complaint, share >= 1 ? "" : "the hit lies beyond t_max") << share;
  }
}

// The support points have to lie as high as that plane.
TEST(Certificate, without_a_plane_of_its_own_is_judged_by_the_claimed_one) {
  const Shape ball = Sphere{2};
  const SupportFunction support = supports_of(ball);
  const Ray<double> ray{{-3, 0, 0}, {1, 0, 0}};
  const Claim claim = claim_of(cast_ray(PreparedShape(ball), ray));
  Certificate certificate;
  certificate.spanning[0] = {{-1, 0, 0}, 1};
  EXPECT_TRUE(check_certificate(support, ray, claim, certificate).holds);
  certificate.spanning[0].weight = 0.5;
  certificate.spanning[1] = {{1, 0, 0}, 0.5};  // the middle
  EXPECT_FALSE(check_certificate(support, ray, claim, certificate).holds);
}

// The plane touches the box, and the ray crosses it, but outside of the box.
TEST(Certificate, of_a_hit_where_a_faces_plane_is_crossed_beside_it_is_refused) {
  const Shape box = Box{{1, 1, 1}};
  const SupportFunction support = supports_of(box);
  const Ray<double> ray{{-3, -1.5, -0.5}, {1, 0.2, 0.5}};  // enters at (-0.5, -1, 0.75)
  Certificate certificate;
  certificate.plane = {0, -1, 0};
  certificate.spanning[0] = {V(1, -1, 1), 0.25};
  certificate.spanning[1] = {V(-1, -1, 1), 0.625};
  certificate.spanning[2] = {V(-1, -1, -1), 0.125};
  Claim claim;
  claim.status = Status::hit;
  claim.t_offset = 2.5;
  claim.normal = {0, -1, 0};
  EXPECT_EQ(check_certificate(support, ray, claim, certificate).complaint, "");
  claim.t_offset = 2;
  claim.normal = {-1, 0, 0};
  EXPECT_EQ(check_certificate(support, ray, claim, certificate).complaint,
            "the hit point lies outside the shape");
}

// In a face, the planes do not locate the ray: the claimed and the spanned points do.
TEST(Certificate, of_a_ray_in_a_face_is_of_what_lies_between_its_ends) {
  const Shape box = Box{{1, 1, 1}};
  const SupportFunction support = supports_of(box);
  const Ray<double> ray{{0, 0, 1}, {1, 0, 0}, 0.5};
  Claim claim;
  claim.status = Status::hit;
  claim.normal = {0, 0, 1};
  Certificate certificate;
  certificate.plane = {0, 0, 1};
  const auto complaint = [&](double claimed, double spanned) {
    claim.t_offset = claimed;
    certificate.spanning[0] = {V(1, 1, 1), (1 + spanned) / 2};
    certificate.spanning[1] = {V(-1, -1, 1), (1 - spanned) / 2};
    certificate.spanning[2] = {V(1, -1, 1), (1 + spanned) / 2};
    certificate.spanning[3] = {V(-1, 1, 1), (1 - spanned) / 2};
    return check_certificate(support, ray, claim, certificate).complaint;
  };
  for (const double t : {0.0, 0.25, 0.5}) EXPECT_EQ(complaint(t, 0.25), "") << t;
  EXPECT_EQ(complaint(-0.25, 0.25), "the hit lies before the ray");
  EXPECT_EQ(complaint(0.75, 0.25), "the hit lies beyond t_max");
  EXPECT_EQ(complaint(0.25, -0.25), "the support points span no point of the ray");
  EXPECT_EQ(complaint(0.25, 0.75), "the support points span no point of the ray");
  // The bounds begin where the ray does, not where its line enters the box.
  complaint(0.25, 0.25);
  const CertificateVerdict verdict = check_certificate(support, ray, claim, certificate);
  EXPECT_EQ(verdict.t_lo(), 0);
  // Along a plane, its rounding is as long as the ray.
  EXPECT_NEAR(verdict.t_hi(), 0.5, 1e-12);
}

// All of the ray lies in that plane, in the air as well.
TEST(Certificate, of_a_hit_in_a_faces_plane_before_or_behind_the_face_is_refused) {
  const Shape box = Box{{1, 1, 1}};
  const SupportFunction support = supports_of(box);
  const Ray<double> ray{{-3, 0, 1}, {1, 0, 0}};
  Claim claim;
  claim.status = Status::hit;
  claim.normal = {0, 0, 1};
  Certificate certificate;
  certificate.plane = {0, 0, 1};
  certificate.spanning[0] = {V(1, 1, 1), 0.5};
  certificate.spanning[1] = {V(-1, -1, 1), 0.5};
  for (const double t : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 1e17}) {
    claim.t_offset = t;
    const CertificateVerdict verdict = check_certificate(support, ray, claim, certificate);
    EXPECT_EQ(verdict.holds, t >= 2 && t <= 4) << t;
    if (!verdict.holds) {
      EXPECT_EQ(verdict.complaint, "the hit lies before or behind the shape") << t;
    }
  }
}

// The squares of their lengths are no numbers, so that their unit vectors were 0.
TEST(Certificate, of_directions_too_long_or_too_short_is_refused) {
  const Shape ball = Sphere{1};
  const SupportFunction support = supports_of(ball);
  const Ray<double> at_it{{-3, 0, 0}, {1, 0, 0}}, beside{{-3, 0, 2}, {1, 0, 0}};
  for (const double length : {1e-200, 1e-100, 1.0, 1e100, 1e200}) {
    const bool is_ordinary = length > 1e-150 && length < 1e150;
    Certificate certificate;
    Claim claim;
    claim.status = Status::miss;
    certificate.plane = {0, 0, length};
    EXPECT_FALSE(check_certificate(support, at_it, claim, certificate).holds) << length;
    EXPECT_EQ(check_certificate(support, beside, claim, certificate).holds, is_ordinary) << length;
    certificate.plane = {-length, 0, 0};
    certificate.spanning[0] = {V(-1, 0, 0), 1};
    claim.status = Status::hit;
    claim.t_offset = 2;
    claim.normal = {-length, 0, 0};
    EXPECT_EQ(check_certificate(support, at_it, claim, certificate).holds, is_ordinary) << length;
    claim.t_offset = 1.5;
    EXPECT_FALSE(check_certificate(support, at_it, claim, certificate).holds) << length;
  }
}

// In no direction everything has the height 0, and 0 separates from 0.
TEST(Certificate, of_a_miss_without_a_plane_is_refused) {
  const Shape ball = Sphere{1};
  const SupportFunction support = supports_of(ball);
  Claim claim;
  claim.status = Status::miss;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double beside : {0.0, 0.5, 1.5}) {
    const Ray<double> ray{{-3, beside, 0}, {1, 0, 0}};
    Certificate certificate;
    for (const V& none : {V(0, 0, 0), V(nan, nan, nan), V(0, nan, 0)}) {
      certificate.plane = none;
      EXPECT_EQ(check_certificate(support, ray, claim, certificate).complaint,
                "a miss without a plane");
    }
    certificate.plane = {0, 1, 0};
    EXPECT_EQ(check_certificate(support, ray, claim, certificate).holds, beside > 1);
  }
}

// From there the ray's parameters have no digits for the shape, nor has the segment near it.
TEST(Certificate, of_a_ray_from_too_far_away_is_refused) {
  const Shape ball = Sphere{1};
  const SupportFunction support = supports_of(ball);
  for (const double away : {1e3, 1e12, 1e20, 1e24}) {
    const Ray<double> ray{{-1.1 * away, 0.5, 1.1 * away}, {1.1, 0, -1.1}};
    Claim claim;
    claim.status = Status::miss;
    Certificate certificate;
    certificate.plane = {0, 1, 0};
    const CertificateVerdict verdict = check_certificate(support, ray, claim, certificate);
    EXPECT_FALSE(verdict.holds);
    EXPECT_EQ(verdict.complaint == "the origin is too far away", away > 1e15) << verdict.complaint;
  }
}

}  // namespace
}  // namespace minkray::testing
