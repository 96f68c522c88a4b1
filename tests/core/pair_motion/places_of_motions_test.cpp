// SPDX-License-Identifier: MIT
// Times of impact, contact points, heights over half-spaces and near pairs are the same wherever
// the bodies are.
#include <gtest/gtest.h>

#include "core/pair_distance/half_space_distance.h"
#include "core/pair_distance/manifold.h"
#include "core/pair_motion/impact.h"
#include "core/world/near_pairs.h"
#include "tests/core/pair_distance/places.h"
#include "tests/support/number_of_cases.h"
#include "tests/support/shifted.h"

namespace minkray::testing {
namespace {

struct Motions {
  RigidMotion a, b;
};

Motions any_motions(const PosedShapes& pair, bool turns, RandomShapes& random) {
  Motions motions{{pair.pose_a}, {pair.pose_b}};
  const Vec3<double> between = pair.pose_b.translation - pair.pose_a.translation;
  motions.a.velocity = 0.3 * pair.size * random.direction();
  motions.b.velocity =
      motions.a.velocity - random.in(0.3, 2) * (between + 0.3 * pair.size * random.direction());
  if (turns) motions.a.angular_velocity = random.in(0, 2) * random.direction();
  if (turns) motions.b.angular_velocity = random.in(0, 2) * random.direction();
  return motions;
}

/// Two answers to the same question may both be true, and the second is about as sharp.
std::string complaint_of_impacts(const Impact& near, const Impact& far, double shortest) {
  std::ostringstream text;
  text.precision(17);
  text << name_of(near.status) << " in [" << near.t_lo << ", " << near.t_hi << "], far away "
       << name_of(far.status) << " in [" << far.t_lo << ", " << far.t_hi << "]";
  if (near.status != far.status) return text.str();
  if (near.status != ImpactStatus::hit) return "";
  if (near.t_lo > far.t_hi || far.t_lo > near.t_hi) return text.str();
  if (far.t_hi - far.t_lo > 4 * (near.t_hi - near.t_lo) + shortest) return text.str();
  return "";
}

TEST(Places, times_of_impact_are_the_same_in_poses_and_shapes_that_are_moved) {
  RandomShapes random(607);
  int hits = 0, count = 0;
  for (int k = 0; k < number_of_cases(800); ++k) {
    PosedShapes pair = any_pair(2 * k, random);
    if (pair.size > 1e3 || pair.size < 1e-3 || pair.distance().value < 1e-6 * pair.size) continue;
    const Motions here = any_motions(pair, k % 2 == 0, random);
    const Impact near =
        first_impact(ContactShape(pair.a), here.a, ContactShape(pair.b), here.b, 1.5);
    hits += near.status == ImpactStatus::hit;
    ++count;
    for (const double place : places) {
      const Vec3<double> way = place_at(place, random);
      Motions there = here;
      there.a.pose = moved(here.a.pose, way);
      there.b.pose = moved(here.b.pose, way);
      const Impact far =
          first_impact(ContactShape(pair.a), there.a, ContactShape(pair.b), there.b, 1.5);
      ASSERT_EQ(far.status, near.status) << k;
      ASSERT_EQ(far.t_lo, near.t_lo) << k;
      ASSERT_EQ(far.t_hi, near.t_hi) << k;
      ASSERT_EQ(far.distance, near.distance) << k;
      if (k % 2 == 0) continue;
      // Without turns the frame is no matter.
      there.b.pose = here.b.pose;
      const Shape of_a = moved(under(pair.a, pair.pose_a), way);
      there.a.pose = shifted_by(-way);
      const Impact in_shape =
          first_impact(ContactShape(of_a), there.a, ContactShape(pair.b), there.b, 1.5);
      const double speed = (here.b.velocity - here.a.velocity).norm();
      ASSERT_EQ(complaint_of_impacts(near, in_shape, 1e-9 * pair.size / speed), "")
          << k << " " << place;
    }
  }
  EXPECT_GT(hits, count / 4);
}

TEST(Places, balls_meet_when_their_closed_form_says) {
  RandomShapes random(608);
  for (const double place : {0.0, 10.0, 100.0, 1e4, 1e6, 1e9})
    for (int k = 0; k < number_of_cases(2000); ++k) {
      const Vec3<double> at = place_at(place, random);
      RigidMotion a{{random.turn(), at}},
          b{{random.turn(), at + random.in(1, 5) * random.direction()}};
      a.velocity = random.in(0, 1) * random.direction();
      b.velocity = a.velocity - random.in(0.5, 2) * (b.pose.translation - a.pose.translation) +
                   0.5 * random.direction();
      if (k % 2 == 0) a.angular_velocity = random.direction();
      const double radius_a = random.in(0.1, 0.5), radius_b = random.in(0.1, 0.5);
      const QuadVec x = quad(b.pose.translation) - quad(a.pose.translation),
                    v = quad(b.velocity) - quad(a.velocity);
      const Quad r = Quad(radius_a) + Quad(radius_b), towards = -x.dot(v), vv = v.squaredNorm(),
                 inside = towards * towards - vv * (x.squaredNorm() - r * r);
      if (!(x.squaredNorm() > r * r)) continue;
      const Impact found = first_impact(ContactShape(Shape(Sphere{radius_a})), a,
                                        ContactShape(Shape(Sphere{radius_b})), b, 3);
      const Quad time = inside > 0 ? (towards - root(inside)) / vv : Quad(-1);
      if (found.status == ImpactStatus::miss) {
        ASSERT_TRUE(!(inside > 0) || time < 0 || time > 3) << place << " " << k;
      }
      if (found.status != ImpactStatus::hit || !(inside > 0)) continue;
      ASSERT_LE(found.t_lo, time) << place << " " << k;
      ASSERT_GE(found.t_hi, time) << place << " " << k;
    }
}

TEST(Places, half_spaces_are_as_far_as_they_are_nearby) {
  RandomShapes random(609);
  const std::array<Vec3<double>, 2> normals = {Vec3<double>::UnitZ(), Vec3<double>(0, -1, 0)};
  for (int k = 0; k < number_of_cases(900); ++k) {
    const Shape shape = any_shape(k, random);
    const ContactShape ready(shape);
    const Affine<double> pose{random.turn(), coarse(random.in(0, 2) * random.direction())};
    const Vec3<double>& n = normals[static_cast<std::size_t>(k) % 2];
    const double offset = coarse(Vec3<double>::Constant(random.in(-2, 2))).x();
    const SignedDistance near = distance_to_half_space(n, offset, ready, pose);
    for (const double place : places) {
      const Vec3<double> way = place_at(place, random);
      const SignedDistance far =
          distance_to_half_space(n, offset + n.dot(way), ready, moved(pose, way));
      const SignedDistance in_shape = distance_to_half_space(
          n, offset + n.dot(way), ContactShape(moved(under(shape, pose), way)), {});
      const double size = ready.ball_radius() + ready.offset() + 3;
      ASSERT_EQ(complaint_of(near, far, size), "") << k << " " << place;
      ASSERT_EQ(complaint_of(near, in_shape, size), "") << k << " " << place;
    }
  }
}

TEST(Places, contacts_are_as_deep_as_they_are_nearby) {
  RandomShapes random(610);
  int points = 0;
  for (int k = 0; k < 400; ++k) {
    const Shape box = Box{{random.in(0.5, 1), random.in(0.5, 1), random.in(0.2, 1)}},
                other = k % 2 == 0 ? Shape(Cylinder{random.in(0.2, 1), 0.5})
                                   : Shape(Box{{0.5, 0.25, 0.5}});
    const ContactShape a(box), b(other);
    const double tilt = k % 3 == 0 ? 0 : random.in(0, 0.01);
    const Affine<double> pose_a{}, pose_b{rotation_matrix(tilt, 0.0, 0.0, 1.0),
                                          coarse({random.in(-0.3, 0.3), random.in(-0.3, 0.3),
                                                  std::get<Box>(box.kind).half_extents.z() + 0.5})};
    const auto manifold = [&](const Vec3<double>& way) {
      const Affine<double> at_a = moved(pose_a, way), at_b = moved(pose_b, way);
      return contact_manifold(a, at_a, b, at_b, signed_distance(a, at_a, b, at_b));
    };
    const ContactManifold near = manifold(Vec3<double>::Zero());
    if (near.count < 3) continue;
    // The gap between two faces is linear along them, but for corners 1e-6 of the size from an
    // edge; which of equal corners are kept may differ.
    Mat3<double> edges;
    Vec3<double> rises;
    edges.row(2) = near.normal;
    rises.z() = 0;
    for (int i = 1; i < 3; ++i) {
      const auto& corner = near.points[static_cast<std::size_t>(i)];
      edges.row(i - 1) = corner.point_a - near.points[0].point_a;
      rises[i - 1] = corner.distance - near.points[0].distance;
    }
    const Vec3<double> slope = edges.inverse() * rises;
    for (const double place : places) {
      const Vec3<double> way = place_at(place, random);
      const ContactManifold far = manifold(way);
      ASSERT_EQ(far.count, near.count) << k << " " << place;
      for (std::size_t i = 0; i < static_cast<std::size_t>(far.count); ++i, ++points) {
        const Vec3<double> from = far.points[i].point_a - way - near.points[0].point_a;
        ASSERT_NEAR(far.points[i].distance, near.points[0].distance + slope.dot(from),
                    1e-12 + tilt * (3e-6 + 2e-15 * place))
            << k << " " << place;
      }
    }
  }
  EXPECT_GT(points, 2000);
}

TEST(Places, near_pairs_are_the_same) {
  RandomShapes random(611);
  for (const double place : places) {
    const Vec3<double> way = place_at(place, random);
    std::vector<ContactBody> here, there;
    for (int i = 0; i < 60; ++i) {
      const ContactShape shape(random_shape(i % kinds_of_bodies, 0.5, random));
      const Affine<double> pose{random.turn(), coarse(3 * random.direction())};
      here.push_back({shape, pose});
      there.push_back({shape, moved(pose, way)});
    }
    NearPairsOptions options;
    options.at_most = 0.25;
    const std::vector<NearPair> near = near_pairs(ContactWorld(here), options),
                                far = near_pairs(ContactWorld(there), options);
    ASSERT_EQ(near.size(), far.size()) << place;
    ASSERT_GT(near.size(), 20u);
    for (std::size_t i = 0; i < near.size(); ++i) {
      ASSERT_EQ(near[i].a, far[i].a);
      ASSERT_EQ(near[i].b, far[i].b);
      ASSERT_EQ(near[i].distance.lower, far[i].distance.lower);
    }
    const auto nearest = nearest_bodies(here.back(), ContactWorld(here), 5),
               also = nearest_bodies(there.back(), ContactWorld(there), 5);
    for (std::size_t i = 0; i < nearest.size(); ++i) ASSERT_EQ(nearest[i].b, also[i].b) << place;
  }
}

}  // namespace
}  // namespace minkray::testing
