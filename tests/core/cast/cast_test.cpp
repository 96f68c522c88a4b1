// SPDX-License-Identifier: MIT
#include "core/cast/cast.h"

#include <gtest/gtest.h>

#include "core/cast/packet_cast.h"
#include "tests/support/random.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

using testing::Random;

TEST(Cast, a_far_origin_costs_no_precision) {
  const PreparedShape ball(Sphere{1.0});
  const CastResult<double> near = cast_ray(ball, {{-4, 0.5, 0}, {1, 0, 0}});
  const CastResult<double> far = cast_ray(ball, {{-262144, 0.5, 0}, {1, 0, 0}});
  ASSERT_EQ(near.status, Status::hit);
  ASSERT_EQ(far.status, Status::hit);
  EXPECT_NEAR(near.t_offset, -std::sqrt(0.75), 1e-14);
  EXPECT_EQ(far.t_offset, near.t_offset);
  EXPECT_EQ(far.t_base, 262144.0);
}

/// Further off than numbers with the digits of two can represent, no result is valid: rays through
/// a ball's middle were once missed, and with a certificate.
TEST(Cast, no_ray_is_too_far_away_to_be_told_of) {
  const PreparedShape ball(Sphere{1});
  for (int power = 1; power < 36; ++power) {
    for (const double speed : {0.75, 3.0, 1e3, 1e-3, 1e20}) {
      const Ray<double> ray{{0, 0, -std::pow(10.0, power)}, {0, 0, speed}};
      const CastResult<double> fine = cast_ray(ball, ray);
      EXPECT_EQ(name_of(fine.status), name_of(power < 18 ? Status::hit : fine.status)) << power;
      EXPECT_NE(name_of(fine.status), name_of(Status::miss)) << power << " " << speed;
      RayPacket packet;
      for (int lane = 0; lane < packet_lanes; ++lane) packet.set(lane, ray);
      CastPacket together;
      cast_packet(ball, packet, LaneBits(1), together);
      EXPECT_EQ(together.result(0).status, fine.status) << power << " " << speed;
      // Next to the ball, as far off.
      const Ray<double> beside{{1.5, 0, -std::pow(10.0, power)}, {0, 0, speed}};
      EXPECT_NE(name_of(cast_ray(ball, beside).status), name_of(Status::hit)) << power;
      if (fine.status != Status::hit) continue;
      // o + t d with the digits of both.
      const long double at =
          std::fma((long double)(fine.t_base), (long double)(speed), (long double)(ray.origin.z()));
      const long double hit_point = at + (long double)(fine.t_offset) * speed;
      EXPECT_NEAR(static_cast<double>(hit_point), -1, 1e-15 + std::pow(10.0, power - 31)) << power;
    }
  }
}

/// A ray that ends on the surface hits it, and a hit is within the ray, whatever is rounded.
TEST(Cast, the_rays_ends_belong_to_it) {
  Random random(9);
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const PreparedShape box(Box{{1, random.uniform(0.1, 2), 1}});
    Ray<double> ray{Vec3<double>(-1 - random.below(3) * random.uniform(0, 2),
                                 random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)),
                    random.direction() + Vec3<double>(2, 0, 0)};
    const CastResult<double> first = cast_ray(box, ray);
    if (first.status == Status::hit) {
      ray.t_max = first.t();
      const CastResult<double> last = cast_ray(box, ray);
      ASSERT_EQ(name_of(last.status), name_of(Status::hit)) << i;
      ++hits;
    }
    for (const double t_max : {0.0, 1e-20, 1e-17, 1e-16}) {
      ray.t_max = t_max;
      for (const CastResult<double>& answer : {cast_ray(box, ray), cast_exit(box, ray)}) {
        if (answer.status != Status::hit) continue;
        EXPECT_GE(answer.t(), 0) << t_max;
        EXPECT_LE(answer.t(), t_max);
      }
    }
  }
  EXPECT_GT(hits, 500);
}

/// Edge on, the portal's triangle can be a sliver whose plane runs nearly along the ray: the two
/// bounds, 3.5e-4 apart, were taken for one.
TEST(Cast, thin_plates_are_met_edge_on) {
  for (const double half : {0x1p-8, 0x1p-10, 0x1p-14}) {
    const Shape plate = Box{{8, 8, half}};
    const PreparedShape sum(Shape(MinkowskiSum{{plate, plate}}));
    Random random(3);
    for (int i = 0; i < 400; ++i) {
      const double y = static_cast<double>(random.below(129) - 64) / 8;
      const double x = -16 - static_cast<double>(1 + random.below(64)) / 16;
      const CastResult<double> answer = cast_ray(sum, Ray<double>{{x, y, 0}, {1, 0, 0}});
      ASSERT_EQ(name_of(answer.status), name_of(Status::hit)) << y;
      ASSERT_NEAR(answer.t(), -16 - x, 1e-12) << y;
      ASSERT_NEAR(answer.normal.x(), -1, 1e-14) << y;
    }
  }
}

TEST(Cast, no_hit_is_after_the_rays_end) {
  Random random(8);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const PreparedShape box(Box{{1, random.uniform(0.1, 2), 1}});
    Ray<double> ray{{-random.uniform(1, 3), 0.05, 0.3}, {random.uniform(0.1, 7), 0, 0.01}};
    const CastResult<double> first = cast_ray(box, ray);
    if (first.status != Status::hit) continue;
    ray.t_max = std::nextafter(first.t(), 0.0);
    const CastResult<double> last = cast_ray(box, ray);
    if (last.status != Status::hit) continue;
    ++hits;
    EXPECT_LE(last.t(), ray.t_max);
    EXPECT_LE(last.offset_lo, last.t_offset);
    EXPECT_GE(last.offset_hi, last.t_offset);
    RayPacket packet;
    for (int lane = 0; lane < packet_lanes; ++lane) packet.set(lane, ray);
    CastPacket together;
    cast_packet(box, packet, LaneBits(1), together);
    EXPECT_EQ(together.result(0).t(), last.t());
  }
  EXPECT_GT(hits, 100);
}

TEST(Cast, a_ray_from_inside_says_so_and_knows_its_exit) {
  const PreparedShape box(Box{{1, 2, 3}}, shifted_by(10, 0, 0));
  const Ray<double> ray{{10, 0, 0}, {0, 0.5, 0}};
  EXPECT_EQ(cast_ray(box, ray).status, Status::inside);
  EXPECT_EQ(cast_ray(box, ray).t(), 0.0);
  const CastResult<double> exit = cast_exit(box, ray);
  ASSERT_EQ(exit.status, Status::hit);
  EXPECT_NEAR(exit.t(), 4.0, 1e-14);
  EXPECT_NEAR(exit.normal.y(), 1.0, 1e-14);
}

/// A ball of 1e-30 was once "hit" at its centre, t = 5 with t_lo = 5: squares had underflowed.
TEST(Cast, scales_near_the_ends_of_the_number_range_are_answered_like_any_other) {
  for (const double scale : {1e-200, 1e-30, 1e-5, 1e5, 1e30, 1e200}) {
    const PreparedShape ball(Sphere{scale}), box(Box{{scale, scale, scale}});
    for (const Solver* const kind : {&solver::automatic, &solver::jet, &solver::gjk_alone}) {
      const Ray<double> ray{{-5 * scale, 0, 0}, {scale, 0, 0}};
      EXPECT_EQ(cast_ray(ball, ray, {kind}).status, Status::hit) << scale;
      EXPECT_NEAR(cast_ray(ball, ray, {kind}).t(), 4, 1e-13) << scale;
      EXPECT_NEAR(cast_ray(box, ray, {kind}).t(), 4, 1e-13) << scale;
      const Ray<double> beside{{-5 * scale, 1.5 * scale, 0}, {scale, 0, 0}};
      EXPECT_EQ(cast_ray(ball, beside, {kind}).status, Status::miss) << scale;
    }
  }
}

/// Far from the shape t is coarse, but what is left of it near the shape is not.
void check_ends_from_afar() {
  Random random(19);
  const PreparedShape ball{Shape(Sphere{1.0})};
  int hits = 0, misses = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3<double> aim = random.direction() * random.uniform(0, 0.9);
    const double distance = std::pow(10.0, random.uniform(4, 5.5));
    const Vec3<double> o = aim - random.direction() * distance;
    Ray<double> ray{o, Vec3<double>((aim - o) / distance * random.uniform(0.5, 3))};
    using Long = long double;
    const Vec3<Long> origin = ray.origin.cast<Long>(), direction = ray.direction.cast<Long>();
    const Long a = direction.squaredNorm(), b = origin.dot(direction);
    const Long den = b * b - a * (origin.squaredNorm() - 1);
    if (den <= 0) continue;
    const Long enters = -(b + std::sqrt(den)) / a;
    ray.t_max = static_cast<double>(enters + random.uniform(-0.1, 0.1));
    const Long left = (Long(ray.t_max) - enters) * std::sqrt(a);
    const double rounding = 1e2 * std::numeric_limits<double>::epsilon();
    if (std::abs(left) < rounding / std::sqrt(den / a)) continue;
    const Status status = cast_ray(ball, ray).status;
    ASSERT_EQ(status, left > 0 ? Status::hit : Status::miss) << i << ": " << double(left);
    ++(left > 0 ? hits : misses);
  }
  EXPECT_GT(hits, 500);
  EXPECT_GT(misses, 500);
}

TEST(Cast, t_max_is_as_sharp_from_afar) {
  check_ends_from_afar();
}

/// Between a side that the ray grazes and a steep one, rounding cannot decide which it enters by,
/// but only one of them is where it meets the hull.
void check_spots_near_edges(double least_slope) {
  Random random(23);
  double worst = 0;
  int hits = 0;
  for (int i = 0; i < 8000; ++i) {
    const Vec3<double> h(random.uniform(0.3, 1), random.uniform(0.3, 1), random.uniform(0.3, 1));
    const Vec3<double> half = h;
    std::vector<Vec3<double>> corners;
    for (int k = 0; k < 8; ++k)
      corners.push_back(half.cwiseProduct(
          Vec3<double>(k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0)));
    const PreparedShape hull{Shape(Hull{PointCloud(corners)})};
    const double slope = least_slope * std::pow(10.0, random.uniform(0, 3));
    const Vec3<double> edge(-h.x(), h.y() * random.uniform(-0.9, 0.9), h.z());
    const Vec3<double> r = Vec3<double>(1, random.uniform(-0.6, 0.6), -slope);
    const Ray<double> ray{Vec3<double>(edge - r * random.uniform(0.5, 2)), r};
    const CastResult<double> result = cast_ray(hull, ray);
    if (result.status != Status::hit) continue;
    ++hits;
    const Vec3<double> hit_point =
        ray.origin + ray.direction * (double(result.t_base) + double(result.t_offset));
    worst = std::max(worst, (hit_point.cwiseAbs() - half).maxCoeff());
  }
  EXPECT_GT(hits, 3000);
  EXPECT_LE(worst, 16 * std::numeric_limits<double>::epsilon());
}

TEST(Cast, spots_near_the_edges_of_hulls_lie_on_them) {
  check_spots_near_edges(1e-5);
}

/// Seen edge-on, all edges of a plate as thin as rounding are in line with the ray.
TEST(Cast, edges_of_the_thinnest_plates_are_not_met_beyond_their_ends) {
  const double e = 3.858838162201783e-15;
  const Shape plate = Hull{PointCloud(std::vector<Vec3<double>>{{1, -2, e},
                                                                {-1, 2, e},
                                                                {-1, 0, e},
                                                                {0, 2, 0},
                                                                {0, 0, -e},
                                                                {1, 0, 0},
                                                                {0, -2, e},
                                                                {-1, 2, 0},
                                                                {1, -2, -e},
                                                                {-1, -2, 0}})};
  const PreparedShape prepared(plate);
  const CastResult<double> exit = cast_exit(
      prepared, Ray<double>{{1, -4, 7.717676324403566e-15}, {0, 2, -3.858838162201783e-15}});
  if (exit.status == Status::hit) {
    EXPECT_NEAR(exit.t(), 2, 1e-5);
  } else {
    EXPECT_EQ(exit.status, Status::miss);  // within rounding, it is
  }
}

TEST(Cast, the_shortest_directions_have_the_longest_t) {
  const PreparedShape large{Shape(Sphere{1e37})};
  const CastResult<double> far = cast_ray(large, Ray<double>{{-1e39, 0, 0}, {1e-151, 0, 0}});
  ASSERT_EQ(far.status, Status::hit);
  EXPECT_NEAR(far.t() / 9.9e189, 1, 1e-14);
}

TEST(Cast, the_shortest_directions_end_as_well) {
  const PreparedShape large(Box{{1024, 1024, 1024}}), small(Box{{1, 1, 1}});
  const auto status = [](const PreparedShape& shape, double z, double d, double t_max) {
    return cast_ray(shape, Ray<double>{{0, 0, z}, {0, 0, d}, t_max}).status;
  };
  EXPECT_EQ(status(large, -0x1p50, 0x1p-61, 0x1p100), Status::miss);
  EXPECT_EQ(status(large, -0x1p50, 0x1p-61, 0x1p112), Status::hit);
  EXPECT_EQ(status(small, -0x1p70, 0x1p-61, 3.4e38), Status::miss);
}

TEST(Cast, no_hit_is_before_the_rays_beginning) {
  const PreparedShape plate{Shape(Box{{0.027657020837068558, 0, 0.08756916970014572}})};
  const CastResult<double> result =
      cast_ray(plate, Ray<double>{{0.007332629524171352, 0, 0.003028969746083021},
                                  {-0.14729009568691254, 0.7463956475257874, -0.6489985585212708}});
  ASSERT_TRUE(result.found());
  EXPECT_GE(result.t(), 0);
}

TEST(Cast, a_points_normal_is_against_the_ray) {
  const Shape point = Point{{-0.1, -0.5, 0.6}};
  const CastResult<double> result =
      cast_ray(PreparedShape(point), Ray<double>{{-0.1, -0.5, -7.5}, {0, 0, 1e6}});
  ASSERT_NE(result.status, Status::exhausted);
  if (result.found()) {
    EXPECT_LT(result.normal.z(), -0.5);
  }
}

}  // namespace
}  // namespace minkray
