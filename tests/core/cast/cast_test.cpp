// SPDX-License-Identifier: MIT
#include "core/cast/cast.h"

#include <gtest/gtest.h>

#include "core/cast/packet_cast.h"
#include "core/derived/convert.h"
#include "tests/support/random.h"

namespace minkray {
namespace {

using testing::Random;

TEST(Cast, a_far_origin_costs_no_precision_in_float) {
  const PreparedShape<float> ball(Sphere<float>{1.0f});
  const CastResult<float> near = cast_ray<float>(ball, {{-4, 0.5f, 0}, {1, 0, 0}});
  const CastResult<float> far = cast_ray<float>(ball, {{-262144, 0.5f, 0}, {1, 0, 0}});
  ASSERT_EQ(near.status, Status::hit);
  ASSERT_EQ(far.status, Status::hit);
  EXPECT_NEAR(near.t_offset, -std::sqrt(0.75f), 1e-6f);
  EXPECT_EQ(far.t_offset, near.t_offset);
  EXPECT_EQ(far.t_base, 262144.0f);
}

/// Further off than numbers with the digits of two can represent, no result is valid: rays through
/// a ball's middle were once missed, and with a certificate.
TEST(Cast, no_ray_is_too_far_away_to_be_told_of) {
  const PreparedShape<double> ball(Sphere<double>{1});
  const PreparedShape<float> in_float(Sphere<float>{1});
  for (int power = 1; power < 36; ++power) {
    for (const double speed : {0.75, 3.0, 1e3, 1e-3, 1e20}) {
      const Ray<double> ray{{0, 0, -std::pow(10.0, power)}, {0, 0, speed}};
      const CastResult<double> fine = cast_ray(ball, ray);
      EXPECT_EQ(name_of(fine.status), name_of(power < 18 ? Status::hit : fine.status)) << power;
      EXPECT_NE(name_of(fine.status), name_of(Status::miss)) << power << " " << speed;
      const Ray<float> same = {ray.origin.cast<float>(), ray.direction.cast<float>()};
      const CastResult<float> coarse = cast_ray(in_float, same);
      EXPECT_EQ(name_of(coarse.status), name_of(power < 13 ? Status::hit : coarse.status)) << power;
      EXPECT_NE(name_of(coarse.status), name_of(Status::miss)) << power << " " << speed;
      RayPacket<float> packet;
      for (int lane = 0; lane < packet_lanes<float>; ++lane) packet.set(lane, same);
      CastPacket<float> together;
      cast_packet(in_float, packet, LaneBits(1), together);
      EXPECT_EQ(together.result(0).status, coarse.status) << power << " " << speed;
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
    const PreparedShape<double> box(Box<double>{{1, random.uniform(0.1, 2), 1}});
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
  for (const float half : {0x1p-8f, 0x1p-10f, 0x1p-14f}) {
    const Shape<float> plate = Box<float>{{8, 8, half}};
    const PreparedShape<float> sum(Shape<float>(MinkowskiSum<float>{{plate, plate}}));
    Random random(3);
    for (int i = 0; i < 400; ++i) {
      const float y = static_cast<float>(random.below(129) - 64) / 8;
      const float x = -16 - static_cast<float>(1 + random.below(64)) / 16;
      const CastResult<float> answer = cast_ray(sum, Ray<float>{{x, y, 0}, {1, 0, 0}});
      ASSERT_EQ(name_of(answer.status), name_of(Status::hit)) << y;
      ASSERT_NEAR(answer.t(), -16 - x, 2e-5f) << y;
      ASSERT_NEAR(answer.normal.x(), -1, 1e-6f) << y;
    }
  }
}

TEST(Cast, no_hit_is_after_the_rays_end) {
  Random random(8);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const PreparedShape<double> box(Box<double>{{1, random.uniform(0.1, 2), 1}});
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
    RayPacket<double> packet;
    for (int lane = 0; lane < packet_lanes<double>; ++lane) packet.set(lane, ray);
    CastPacket<double> together;
    cast_packet(box, packet, LaneBits(1), together);
    EXPECT_EQ(together.result(0).t(), last.t());
  }
  EXPECT_GT(hits, 100);
}

TEST(Cast, a_ray_from_inside_says_so_and_knows_its_exit) {
  const PreparedShape<double> box(Box<double>{{1, 2, 3}}, {Mat3<double>::Identity(), {10, 0, 0}});
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
  for (const float scale : {1e-30f, 1e-15f, 1e-5f, 1e5f, 1e15f, 1e30f}) {
    const PreparedShape<float> ball(Sphere<float>{scale}), box(Box<float>{{scale, scale, scale}});
    for (const SolverKind kind : {SolverKind::automatic, SolverKind::jet, SolverKind::paper}) {
      const Ray<float> ray{{-5 * scale, 0, 0}, {scale, 0, 0}};
      EXPECT_EQ(cast_ray<float>(ball, ray, {kind}).status, Status::hit) << scale;
      EXPECT_NEAR(cast_ray<float>(ball, ray, {kind}).t(), 4, 1e-5) << scale;
      EXPECT_NEAR(cast_ray<float>(box, ray, {kind}).t(), 4, 1e-5) << scale;
      const Ray<float> beside{{-5 * scale, 1.5f * scale, 0}, {scale, 0, 0}};
      EXPECT_EQ(cast_ray<float>(ball, beside, {kind}).status, Status::miss) << scale;
    }
  }
}

/// Far from the shape t is coarse, but what is left of it near the shape is not.
template <class T>
void check_ends_from_afar() {
  Random random(19);
  const PreparedShape<T> ball{Shape<T>(Sphere<T>{T(1)})};
  int hits = 0, misses = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3<double> aim = random.direction() * random.uniform(0, 0.9);
    const double distance = std::pow(10.0, random.uniform(4, 5.5));
    const Vec3<double> o = aim - random.direction() * distance;
    Ray<T> ray{o.cast<T>(), Vec3<double>((aim - o) / distance * random.uniform(0.5, 3)).cast<T>()};
    using Long = long double;
    const Vec3<Long> origin = ray.origin.template cast<Long>(),
                     direction = ray.direction.template cast<Long>();
    const Long a = direction.squaredNorm(), b = origin.dot(direction);
    const Long den = b * b - a * (origin.squaredNorm() - 1);
    if (den <= 0) continue;
    const Long enters = -(b + std::sqrt(den)) / a;
    ray.t_max = static_cast<T>(enters + random.uniform(-0.1, 0.1));
    const Long left = (Long(ray.t_max) - enters) * std::sqrt(a);
    const double rounding = 1e2 * std::numeric_limits<T>::epsilon();
    if (std::abs(left) < rounding / std::sqrt(den / a)) continue;
    const Status status = cast_ray(ball, ray).status;
    ASSERT_EQ(status, left > 0 ? Status::hit : Status::miss) << i << ": " << double(left);
    ++(left > 0 ? hits : misses);
  }
  EXPECT_GT(hits, 500);
  EXPECT_GT(misses, 500);
}

TEST(Cast, t_max_is_as_sharp_from_afar) {
  check_ends_from_afar<double>();
  check_ends_from_afar<float>();
}

/// Between a side that the ray grazes and a steep one, rounding cannot decide which it enters by,
/// but only one of them is where it meets the hull.
template <class T>
void check_spots_near_edges(double least_slope) {
  Random random(23);
  double worst = 0;
  int hits = 0;
  for (int i = 0; i < 8000; ++i) {
    const Vec3<double> h(random.uniform(0.3, 1), random.uniform(0.3, 1), random.uniform(0.3, 1));
    const Vec3<T> half = h.cast<T>();
    std::vector<Vec3<T>> corners;
    for (int k = 0; k < 8; ++k)
      corners.push_back(half.cwiseProduct(
          Vec3<T>(k & 1 ? T(1) : T(-1), k & 2 ? T(1) : T(-1), k & 4 ? T(1) : T(-1))));
    const PreparedShape<T> hull{Shape<T>(Hull<T>{PointCloud<T>(corners)})};
    const double slope = least_slope * std::pow(10.0, random.uniform(0, 3));
    const Vec3<double> edge(-h.x(), h.y() * random.uniform(-0.9, 0.9), h.z());
    const Vec3<double> r = Vec3<double>(1, random.uniform(-0.6, 0.6), -slope);
    const Ray<T> ray{Vec3<double>(edge - r * random.uniform(0.5, 2)).cast<T>(), r.cast<T>()};
    const CastResult<T> result = cast_ray(hull, ray);
    if (result.status != Status::hit) continue;
    ++hits;
    const Vec3<double> hit_point =
        ray.origin.template cast<double>() +
        ray.direction.template cast<double>() * (double(result.t_base) + double(result.t_offset));
    worst = std::max(worst, (hit_point.cwiseAbs() - half.template cast<double>()).maxCoeff());
  }
  EXPECT_GT(hits, 3000);
  EXPECT_LE(worst, 16 * std::numeric_limits<T>::epsilon());
}

TEST(Cast, spots_near_the_edges_of_hulls_lie_on_them) {
  check_spots_near_edges<double>(1e-5);
  check_spots_near_edges<float>(2e-5);
}

/// Seen edge-on, all edges of a plate as thin as rounding are in line with the ray.
TEST(Cast, edges_of_the_thinnest_plates_are_not_met_beyond_their_ends) {
  const double e = 3.858838162201783e-15;
  const Shape<double> plate =
      Hull<double>{PointCloud<double>(std::vector<Vec3<double>>{{1, -2, e},
                                                                {-1, 2, e},
                                                                {-1, 0, e},
                                                                {0, 2, 0},
                                                                {0, 0, -e},
                                                                {1, 0, 0},
                                                                {0, -2, e},
                                                                {-1, 2, 0},
                                                                {1, -2, -e},
                                                                {-1, -2, 0}})};
  const PreparedShape<float> in_float(convert<float>(plate));
  const CastResult<float> exit = cast_exit(
      in_float, Ray<float>{{1, -4, 7.717676324403566e-15f}, {0, 2, -3.858838162201783e-15f}});
  if (exit.status == Status::hit) {
    EXPECT_NEAR(exit.t(), 2, 1e-5);
  } else {
    EXPECT_EQ(exit.status, Status::miss);  // within rounding, it is
  }
}

TEST(Cast, the_shortest_directions_have_the_longest_t) {
  const PreparedShape<float> ball{Shape<float>(Sphere<float>{1})};
  const CastResult<float> result = cast_ray(ball, Ray<float>{{-1e9f, 0, 0}, {5e-19f, 0, 0}});
  ASSERT_EQ(result.status, Status::hit);
  EXPECT_NEAR(result.t() / 2e27f, 1, 1e-6);
  const PreparedShape<double> large{Shape<double>(Sphere<double>{1e37})};
  const CastResult<double> far = cast_ray(large, Ray<double>{{-1e39, 0, 0}, {1e-151, 0, 0}});
  ASSERT_EQ(far.status, Status::hit);
  EXPECT_NEAR(far.t() / 9.9e189, 1, 1e-14);
}

TEST(Cast, the_shortest_directions_end_as_well) {
  const PreparedShape<float> large(Box<float>{{1024, 1024, 1024}}), small(Box<float>{{1, 1, 1}});
  const auto status = [](const PreparedShape<float>& shape, float z, float d, float t_max) {
    return cast_ray(shape, Ray<float>{{0, 0, z}, {0, 0, d}, t_max}).status;
  };
  EXPECT_EQ(status(large, -0x1p50f, 0x1p-61f, 0x1p100f), Status::miss);
  EXPECT_EQ(status(large, -0x1p50f, 0x1p-61f, 0x1p112f), Status::hit);
  EXPECT_EQ(status(small, -0x1p70f, 0x1p-61f, 3.4e38f), Status::miss);
}

TEST(Cast, no_hit_is_before_the_rays_beginning) {
  const PreparedShape<float> plate{
      Shape<float>(Box<float>{{0.027657020837068558f, 0, 0.08756916970014572f}})};
  const CastResult<float> result = cast_ray(
      plate, Ray<float>{{0.007332629524171352f, 0, 0.003028969746083021f},
                        {-0.14729009568691254f, 0.7463956475257874f, -0.6489985585212708f}});
  ASSERT_TRUE(result.found());
  EXPECT_GE(result.t(), 0);
}

TEST(Cast, a_points_normal_is_against_the_ray) {
  const Shape<float> point = Point<float>{{-0.1f, -0.5f, 0.6f}};
  const CastResult<float> result =
      cast_ray(PreparedShape<float>(point), Ray<float>{{-0.1f, -0.5f, -7.5f}, {0, 0, 1e6f}});
  // In float its place is rounded: the ray meets it, or passes it by a rounding.
  ASSERT_NE(result.status, Status::exhausted);
  if (result.found()) {
    EXPECT_LT(result.normal.z(), -0.5f);
  }
}

}  // namespace
}  // namespace minkray
