// SPDX-License-Identifier: MIT
// Shapes of proportions that no solver's rounding was made for: what is answered is right, by
// closed forms in long double, and nearly everything is answered.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "core/cast/packet_cast.h"
#include "core/proof/check_certificate.h"
#include "tests/support/random.h"
#include "tests/support/ray_families.h"

namespace minkray::testing {
namespace {

using Long = long double;

/// Counts of each result.
struct Answered {
  int hits = 0, misses = 0, exhausted = 0;
  int compared = 0;  ///< with a truth that rounding leaves no doubt about
};

/// Through and past the shape as its radii are: rays aimed at the bounding ball would meet nothing
/// of a needle.
Ray<double> ray_at(const Vec3<double>& radii, Random& random) {
  const auto spot = [&](double reach) -> Vec3<double> {
    return random.in_cube().cwiseProduct(radii) * reach;
  };
  const Vec3<double> through = spot(1), from = through + 4 * spot(1) + spot(3);
  return {from, through - from};
}

/// The first point of the line in the ellipsoid, by the quadratic formula of the ball it is mapped
/// to; the discriminant relative to its terms measures the distance from tangency.
struct EllipsoidTruth {
  bool hit, certain;
  Long t;
};
EllipsoidTruth truth_of(const Vec3<double>& radii, const Ray<double>& ray) {
  Vec3<Long> o, d;
  for (int i = 0; i < 3; ++i) {
    o[i] = Long(ray.origin[i]) / Long(radii[i]);
    d[i] = Long(ray.direction[i]) / Long(radii[i]);
  }
  const Vec3<Long> beside = d.cross(o) / d.norm();
  const Long den = 1 - beside.squaredNorm();
  const bool inside = o.norm() < 1;
  const Long t =
      inside ? 0 : (-o.dot(d) - std::sqrt(std::max(den, Long(0))) * d.norm()) / d.squaredNorm();
  // Ray and shape are rounded to the longest radius.
  const Long rounding = 128 * std::numeric_limits<double>::epsilon() * Long(radii.maxCoeff());
  const Long nearest = std::min(std::abs(den), std::abs(o.norm() - 1)) * Long(radii.minCoeff());
  return {inside || (den > 0 && t > 0), nearest > rounding, t};
}

Answered check_ellipsoid(const Vec3<double>& wanted, int rays) {
  Random random(7);
  const PreparedShape prepared{Shape(Ellipsoid{wanted})};
  EXPECT_TRUE(prepared.definition().is_extreme());
  EXPECT_FALSE(prepared.definition().has_packets());
  Answered answered;
  for (int i = 0; i < rays; ++i) {
    const Ray<double> exact = ray_at(wanted, random);
    const EllipsoidTruth truth = truth_of(wanted, exact);
    const CastResult<double> result = cast_ray(prepared, exact);
    if (result.status == Status::exhausted) {
      ++answered.exhausted;
      continue;
    }
    (result.status == Status::miss ? answered.misses : answered.hits) += 1;
    if (!truth.certain) continue;
    ++answered.compared;
    EXPECT_EQ(result.found(), truth.hit) << wanted.transpose() << ", exact " << i;
    if (result.status != Status::hit || !truth.hit) continue;
    // Along the normal, in epsilons of the longest radius.
    const Long off = (Long(result.t_base) + Long(result.t_offset) - truth.t) *
                     Long(exact.direction.dot(result.normal));
    EXPECT_LE(std::abs(off), 64 * std::numeric_limits<double>::epsilon() * wanted.norm())
        << wanted.transpose() << ", exact " << i;
  }
  return answered;
}

TEST(ExtremeShapes, ellipsoids_are_met_where_they_are) {
  const auto check = [](const Answered& answered) {
    EXPECT_GT(answered.hits, 300);
    EXPECT_GT(answered.misses, 300);
    EXPECT_LE(answered.exhausted, 20);
    EXPECT_GT(answered.compared, 500);
  };
  for (const Vec3<double>& radii :
       {Vec3<double>(1, 1, 1e-8), Vec3<double>(1, 1e-8, 1e-8), Vec3<double>(1, 1e-4, 1e-10)})
    check(check_ellipsoid(radii, 2000));
}

/// A sliver against its plane and its three edges, in long double.
TEST(ExtremeShapes, slivers_are_met_where_they_are) {
  Random random(8);
  Answered answered;
  for (int i = 0; i < 2000; ++i) {
    const Mat3<double> turn = random.rotation();
    const double thin = std::pow(10.0, random.uniform(-8, -4));
    const std::array<Vec3<double>, 3> corners = {turn.col(0), Vec3<double>(-turn.col(0)),
                                                 Vec3<double>(thin * turn.col(1))};
    const PreparedShape prepared{Shape(Triangle{corners})};
    ASSERT_TRUE(prepared.definition().is_extreme());
    const double u = random.uniform(-0.2, 1), v = random.uniform(-0.2, 1);
    const Vec3<double> through =
        corners[0] + u * (corners[1] - corners[0]) * 0.9 + v * (corners[2] - corners[0]);
    const Vec3<double> direction = random.direction();
    const Ray<double> ray{through - 3 * direction, direction};

    const auto exact = [](const Vec3<double>& x) { return Vec3<Long>(x.cast<Long>()); };
    const Vec3<Long> a = exact(corners[0]), ab = exact(corners[1]) - a, ac = exact(corners[2]) - a;
    const Vec3<Long> d = exact(ray.direction), o = exact(ray.origin) - a;
    const Vec3<Long> normal = ab.cross(ac);
    const Long slope = normal.dot(d) / normal.norm();
    if (std::abs(slope) < 0.01L) continue;
    const Long t = -normal.dot(o) / normal.dot(d);
    const Vec3<Long> at = o + t * d;
    const Long beta = at.cross(ac).dot(normal) / normal.squaredNorm();
    const Long gamma = ab.cross(at).dot(normal) / normal.squaredNorm();
    const Long least = std::min({beta, gamma, 1 - beta - gamma});
    if (std::abs(least) * thin < 1e-13L) continue;  // within rounding of an edge

    const CastResult<double> result = cast_ray(prepared, ray);
    if (result.status == Status::exhausted) {
      ++answered.exhausted;
      continue;
    }
    (result.status == Status::miss ? answered.misses : answered.hits) += 1;
    EXPECT_EQ(result.status == Status::hit, least > 0) << i << ", thickness " << thin;
    if (result.status == Status::hit && least > 0) {
      const Long off = (Long(result.t_base) + Long(result.t_offset) - t) * slope;
      EXPECT_NEAR(double(off), 0, 1e-12) << i << ", thickness " << thin;
    }
  }
  EXPECT_GT(answered.hits, 300);
  EXPECT_GT(answered.misses, 300);
  // The sliver is so thin that even its middle is lost in rounding.
  EXPECT_LE(answered.exhausted, 60);
}

/// The corners of a box that has been turned, and a spot within it.
struct TurnedBox {
  std::vector<Vec3<double>> corners;
  Vec3<double> within;
};
TurnedBox turned_box(const Vec3<double>& half_extents, Random& random) {
  const Vec3<double> x = random.direction();
  const Vec3<double> y = x.cross(random.direction()).normalized();
  const auto turned = [&](const Vec3<double>& at) -> Vec3<double> {
    return x * at.x() + y * at.y() + x.cross(y) * at.z();
  };
  TurnedBox box;
  for (int corner = 0; corner < 8; ++corner)
    box.corners.push_back(turned({corner & 1 ? half_extents.x() : -half_extents.x(),
                                  corner & 2 ? half_extents.y() : -half_extents.y(),
                                  corner & 4 ? half_extents.z() : -half_extents.z()}));
  box.within = turned(0.8 * random.in_cube().cwiseProduct(half_extents));
  return box;
}

void expect_inside(const Shape& shape, const Vec3<double>& origin, Random& random) {
  const Ray<double> ray{origin, random.direction()};
  const CastResult<double> result = cast_ray(PreparedShape(shape), ray);
  EXPECT_EQ(result.status, Status::inside) << origin.transpose();
  const SupportFunction support = supports_of(shape);
  const Claim claim = claim_of(result);
  EXPECT_EQ(check_certificate(support, ray, claim, certify(support, ray, claim)).complaint, "");
}

TEST(ExtremeShapes, what_is_inside_can_be_proven) {
  Random random(11);
  for (const double thin : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-9})
    for (const Vec3<double>& half_extents :
         {Vec3<double>(1, thin, thin), Vec3<double>(1, 1, thin), Vec3<double>(1, 0.03, thin)})
      for (int i = 0; i < 20; ++i) {
        SCOPED_TRACE(half_extents.transpose());
        const TurnedBox box = turned_box(half_extents, random);
        expect_inside(Hull{PointCloud(box.corners)}, box.within, random);
      }
}

TEST(ExtremeShapes, in_a_thin_skin_one_is_inside) {
  Random random(12);
  for (const double radius : {1e-3, 1e-5, 1e-7, 1e-9})
    for (int i = 0; i < 20; ++i) {
      const TurnedBox box = turned_box({1, 0.8, 0.6}, random);
      const Vec3<double> middle = (box.corners[0] + box.corners[3]) / 2;  // of a face
      const Vec3<double> out = middle.normalized() * radius * random.uniform(0.1, 0.9);
      const Shape hull = Hull{PointCloud(box.corners)};
      expect_inside(Rounded{radius, hull}, middle + out, random);
    }
}

/// The plane of a miss separates: the whole of the ray lies before it.
void expect_plane(const Shape& shape, const Ray<double>& ray, const CastResult<double>& miss) {
  const Vec3<Long> n = miss.normal.cast<Long>(), o = ray.origin.cast<Long>();
  EXPECT_NEAR(double(n.norm()), 1, 1e-6);
  EXPECT_GT(double(n.dot(o - shape.support(n))), 0);
  if (std::isfinite(ray.t_max)) return;
  EXPECT_GE(double(n.dot(ray.direction.cast<Long>())), -1e-6);
}

/// Through the middle of an axis by numbers that are exact, and up to just before it.
void expect_needles_of_least_radius_are_met() {
  for (const double radius : {1.0, 2.0, 3.0, 100.0})
    for (const bool is_round : {true, false}) {
      SCOPED_TRACE(double(radius));
      const double thin = radius * std::numeric_limits<double>::denorm_min(), half = 0.1875;
      const Shape needle = is_round ? Shape(Capsule{thin, half}) : Shape(Cylinder{thin, half});
      const PreparedShape prepared(needle);
      Ray<double> ray{{1.0, double(-0.625), 2.09375}, {double(-0.5), 0.3125, -1.0}};
      const CastResult<double> hit = cast_ray(prepared, ray);
      EXPECT_EQ(hit.status, Status::hit);
      EXPECT_NEAR(double(hit.t()), 2, 1e-5);
      ray.t_max = 1.5;
      const CastResult<double> miss = cast_ray(prepared, ray);
      ASSERT_EQ(miss.status, Status::miss);
      expect_plane(needle, ray, miss);
    }
}

TEST(ExtremeShapes, needles_of_the_least_radius_are_met) {
  expect_needles_of_least_radius_are_met();
}

/// A length of 1e160 has no square in double: closed forms answered such a miss without a normal.
TEST(ExtremeShapes, misses_by_any_number_of_radii_have_planes) {
  for (const int size : {-1000, -500, -450, -400, -300, 0, 9})
    for (const int apart : {1, 30, 100, 300, 600, 1000})
      for (const double turned : {0.0, 1.0}) {
        if (size + apart > 1000) continue;
        SCOPED_TRACE(::testing::Message() << size << ", " << apart << ", " << turned);
        const double radius = std::ldexp(1.0, size), off = std::ldexp(radius, apart);
        const Vec3<double> middle = Vec3<double>(1, 2, 3) * radius;
        const Mat3<double> turn =
            Eigen::AngleAxis<double>(turned, Vec3<double>::UnitZ()).toRotationMatrix();
        const Shape ball = Sphere{radius};
        const PreparedShape posed(ball, {turn, middle});
        const Ray<double> ray{middle + Vec3<double>(off, 0, 0), {0, 0, 1}};
        const CastResult<double> miss = cast_ray(posed, ray);
        // Further away than 1e180 radii what the ray's place is known to may have no square.
        if (apart >= 600 && miss.status == Status::exhausted) continue;
        ASSERT_EQ(miss.status, Status::miss);
        expect_plane(Transform{ball, Affine<double>{turn, middle}}, ray, miss);
      }
}

/// A point has no size that lengths could be measured by: those without a square were none.
void expect_points_are_missed_from(int smallest) {
  for (int k = 0; k >= smallest; k -= 7)
    for (const double behind : {0.0, 2.0, -2.0}) {
      SCOPED_TRACE(::testing::Message() << k << ", " << double(behind));
      const double unit = std::ldexp(1.0, k);
      const Vec3<double> at = Vec3<double>(5.0, -1.0, 3.0) * unit;
      const Shape point = Point{at};
      const PreparedShape prepared(point);
      const Ray<double> past{at + Vec3<double>(1.0, 2.0, behind) * unit, {0.0, 0.0, 1.0}};
      const Ray<double> through{at + Vec3<double>(0.0, 0.0, -2.0) * unit, {0.0, 0.0, 1.0}};
      const CastResult<double> miss = cast_ray(prepared, past);
      EXPECT_EQ(miss.status, Status::miss);
      EXPECT_EQ(cast_exit(prepared, past).status, Status::miss);
      expect_plane(point, past, miss);
      EXPECT_EQ(cast_ray(prepared, through).status, Status::hit);
      EXPECT_EQ(cast_exit(prepared, through).status, Status::hit);
    }
}

TEST(ExtremeShapes, points_are_missed_by_however_little) {
  expect_points_are_missed_from(-1060);
}

TEST(ExtremeShapes, packets_say_what_single_casts_say) {
  const Shape shape = Ellipsoid{{1, 1e-5, 1e-9}};
  const PreparedShape prepared{shape};
  FamilyRays rays(shape, RayFamily::random, 5);
  for (int i = 0; i < 50; ++i) {
    RayPacket packet{};
    for (int lane = 0; lane < packet_lanes; ++lane) {
      const Ray<double> ray = rays.next();
      packet.set(lane, ray);
    }
    CastPacket answers{};
    cast_packet(prepared, packet, all_lanes, answers, best_instruction_set());
    for (int lane = 0; lane < packet_lanes; ++lane) {
      const CastResult<double> one = cast_ray(prepared, packet.ray(lane));
      const CastResult<double> other = answers.result(lane);
      EXPECT_EQ(one.status, other.status);
      if (one.status == Status::hit) {
        EXPECT_EQ(one.t(), other.t());
      }
    }
  }
}

}  // namespace
}  // namespace minkray::testing
