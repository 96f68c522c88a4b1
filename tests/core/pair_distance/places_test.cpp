// SPDX-License-Identifier: MIT
// Pairs are as far apart wherever they are: 6 % of the distances of capsules 100 sizes from the
// origin were out of their bounds, and all of those 10^6 sizes away. Each pair is computed near
// the origin and moved, in its poses, in its shapes and in their parts.
#include <gtest/gtest.h>

#include "tests/core/pair_distance/places.h"
#include "tests/support/number_of_cases.h"
#include "tests/support/shifted.h"

namespace minkray::testing {
namespace {

TEST(Places, capsules_are_as_far_apart_as_their_closed_form_says) {
  RandomShapes random(601);
  int settled = 0, asked = 0, wide = 0;
  for (const double place : {0.0, 10.0, 100.0, 1e4, 1e6, 1e9})
    for (int k = 0; k < number_of_cases(3000); ++k) {
      const Vec3<double> at = place_at(place, random);
      const double half_a = k % 7 == 0 ? 0 : random.in(0.1, 1), half_b = random.in(0.1, 1);
      const Affine<double> pose_a{random.turn(), at + random.direction()};
      const Affine<double> pose_b{k % 5 == 0 ? pose_a.linear : random.turn(),
                                  at + random.in(0, 3) * random.direction()};
      const double radius_a = random.in(0.01, 0.3);
      QuadCapsule a = capsule(pose_a, radius_a, half_a), b = capsule(pose_b, 0, half_b);
      double radius_b = random.in(0.01, 0.3);
      if (k % 2 == 0) {  // next to touching
        radius_b = static_cast<double>(signed_distance_of(a, b)) + slight_gap(k / 2, random);
        if (!(radius_b > 0)) continue;
      }
      b.radius = radius_b;
      const Shape of_a = Capsule{radius_a, half_a}, of_b = Capsule{radius_b, half_b};
      const Quad truth = signed_distance_of(a, b);
      const ContactShape ready_a(of_a), ready_b(of_b);
      SCOPED_TRACE(std::to_string(place) + " " + std::to_string(k));
      const SignedDistance found = signed_distance(ready_a, pose_a, ready_b, pose_b);
      ASSERT_EQ(complaint_of(found, truth), "");
      settled +=
          found.status == SignedStatus::separated || found.status == SignedStatus::overlapping;
      // The poses are in the shapes, or in one of them.
      ASSERT_EQ(complaint_of(signed_distance(ContactShape(under(of_a, pose_a)),
                                             ContactShape(under(of_b, pose_b))),
                             truth),
                "");
      ASSERT_EQ(complaint_of(
                    signed_distance(ContactShape(under(of_a, pose_a)), {}, ready_b, pose_b), truth),
                "");
      const ContactShape with_map(of_b, pose_b);
      const SignedDistance mixed = signed_distance(ready_a, pose_a, with_map, {});
      ASSERT_EQ(complaint_of(mixed, truth), "");
      const double size = ready_a.ball_radius() + ready_b.ball_radius() +
                          (pose_a.translation - pose_b.translation).norm();
      ++asked;
      wide += mixed.upper - mixed.lower > 64 * std::numeric_limits<double>::epsilon() * size;
    }
  EXPECT_GT(settled, 11000);
  // Axes that all but cross leave the direction open: seen once in 230,000.
  EXPECT_LE(wide, asked / 100000);
}

TEST(Places, distances_of_all_kinds_are_the_same_in_poses_that_are_moved) {
  RandomShapes random(602);
  int count = 0;
  for (int k = 0; k < number_of_cases(1500); ++k) {
    const PosedShapes near = any_pair(k, random);
    if (near.size > 1e3 || near.size < 1e-3) continue;
    const SignedDistance here = near.distance();
    ++count;
    for (const double place : places) {
      PosedShapes far = near;
      const Vec3<double> way = place_at(place, random);
      far.pose_a = moved(near.pose_a, way);
      far.pose_b = moved(near.pose_b, way);
      const SignedDistance there = far.distance();
      // Sums in twice the digits allow for 2^-100 of the place.
      const double last_digits = std::numeric_limits<double>::epsilon() * std::abs(here.value);
      ASSERT_EQ(there.value, here.value) << k << " " << place;
      ASSERT_NEAR(there.lower, here.lower, last_digits + 1e-28 * place) << k << " " << place;
      ASSERT_NEAR(there.upper, here.upper, last_digits + 1e-28 * place) << k << " " << place;
      ASSERT_EQ(there.status, here.status) << k << " " << place;
      ASSERT_LE((there.point_a - (here.point_a + way)).norm(), 1e-15 * (place + near.size)) << k;
    }
  }
  EXPECT_GT(count, 800);
}

/// The poses are in the shapes; or so far off that the bodies' poses bring them back.
PosedShapes moved_in_shapes(const PosedShapes& near, const Vec3<double>& way, int k) {
  PosedShapes far = near;
  const Affine<double> back{shifted_by(-way)};
  switch (k % 4) {
    case 0:
      far.a = moved(under(near.a, near.pose_a), way);
      far.b = moved(under(near.b, near.pose_b), way);
      far.pose_a = far.pose_b = {};
      break;
    case 1:
      far.a = moved(under(near.a, near.pose_a), way);
      far.pose_a = {};
      far.pose_b = moved(near.pose_b, way);
      break;
    case 2:
      far.a = moved(under(near.a, near.pose_a), way);
      far.pose_a = back;
      break;
    default:
      // There and back, in the shape.
      far.b = moved(moved(near.b, way), Vec3<double>(-way));
      break;
  }
  return far;
}

TEST(Places, distances_of_all_kinds_are_the_same_in_shapes_that_are_moved) {
  RandomShapes random(603);
  int count = 0;
  for (int k = 0; k < number_of_cases(2000); ++k) {
    const PosedShapes near = any_pair(k, random);
    if (near.size > 1e3 || near.size < 1e-3) continue;
    const SignedDistance here = near.distance();
    ++count;
    for (const double place : places) {
      const PosedShapes far = moved_in_shapes(near, place_at(place, random), k);
      ASSERT_EQ(complaint_of(here, far.distance(), near.size), "") << k << " " << place;
    }
  }
  EXPECT_GT(count, 1000);
}

TEST(Places, distances_are_the_same_of_parts_that_are_moved) {
  RandomShapes random(604);
  const auto nested = [](const Shape& shape) { return Nested(shape); };
  for (int k = 0; k < number_of_cases(1200); ++k) {
    const Shape one = random_shape(k % kinds_of_bodies, 1, random),
                two = random_shape(k / kinds_of_bodies % kinds_of_bodies, 1, random),
                other = random_shape(5 * k % kinds_of_bodies, 1, random);
    const Vec3<double> aside = coarse(random.direction());
    const Affine<double> pose{random.turn(), coarse(random.in(1, 4) * random.direction())};
    for (const double place : places) {
      const Vec3<double> way = place_at(place, random);
      const Shape there = moved(one, way), also_there = moved(two, Vec3<double>(way + aside)),
                  opposite = moved(two, Vec3<double>(aside - way));
      PosedShapes near{other, other, {}, pose}, far = near;
      switch (k % 4) {
        case 0:
          near.a = MinkowskiSum{{nested(one), nested(moved(two, aside))}};
          far.a = MinkowskiSum{{nested(there), nested(opposite)}};
          break;
        case 1:
          near.a = MinkowskiDifference{nested(one), nested(moved(two, aside))};
          far.a = MinkowskiDifference{nested(there), nested(also_there)};
          break;
        case 2:
          near.a = HullOf{{nested(one), nested(moved(two, aside))}};
          far.a = HullOf{{nested(there), nested(also_there)}};
          far.pose_b.translation += way;
          break;
        default:
          near.a = Rounded{0.125, nested(HullOf{{nested(one), nested(moved(two, aside))}})};
          far.a = Rounded{0.125, nested(HullOf{{nested(there), nested(also_there)}})};
          far.pose_a.translation -= way;
          break;
      }
      ASSERT_EQ(complaint_of(near.distance(), far.distance(), 4), "") << k << " " << place;
    }
  }
}

TEST(Places, points_far_away_are_the_shape_that_they_are_nearby) {
  RandomShapes random(605);
  for (int k = 0; k < number_of_cases(600); ++k) {
    std::vector<Vec3<double>> points;
    for (int i = 0; i < 1 + k % 40; ++i) points.push_back(coarse(random.direction()));
    const Shape other = random_shape(k % kinds_of_bodies, 1, random);
    const Affine<double> pose{random.turn(), coarse(random.in(0, 3) * random.direction())};
    const PosedShapes near{Hull{PointCloud(points)}, other, {}, pose};
    for (const double place : places) {
      const Vec3<double> way = place_at(place, random);
      std::vector<Vec3<double>> there;
      for (const Vec3<double>& p : points) there.push_back(p + way);
      const PosedShapes far{Hull{PointCloud(there)}, other, {}, moved(pose, way)};
      ASSERT_EQ(complaint_of(near.distance(), far.distance(), 4), "") << k << " " << place;
    }
  }
}

TEST(Places, overlaps_are_told_by_their_sign_alone_only_if_they_are_proven) {
  RandomShapes random(606);
  SignedDistanceOptions options;
  options.only_sign = true;
  int overlapping = 0, count = 0;
  for (int k = 0; k < number_of_cases(2000); ++k) {
    const PosedShapes pair = any_pair(k, random);
    const SignedDistance full = pair.distance(),
                         sign = signed_distance(ContactShape(pair.a), pair.pose_a,
                                                ContactShape(pair.b), pair.pose_b, options);
    ASSERT_LE(sign.lower, full.upper) << k;
    ASSERT_GE(sign.upper, full.lower) << k;
    if (sign.status == SignedStatus::overlapping) {
      ASSERT_LT(sign.upper, 0) << k;
    }
    count += full.status == SignedStatus::overlapping;
    overlapping += full.status == SignedStatus::overlapping && sign.status == full.status;
  }
  EXPECT_GT(count, 150);
  EXPECT_GT(overlapping, count - count / 20);
}

}  // namespace
}  // namespace minkray::testing
