// SPDX-License-Identifier: MIT
// Pairs give the same answers wherever they are: 6 % of the distances of capsules 100 sizes from
// the origin were out of their bounds, and all of those 10^6 sizes away. The same pair is asked for
// near the origin and moved by a vector that doubles hold exactly, in its poses, in its shapes and
// in what those are made of; capsules and balls are judged by closed forms in quadruple precision.
#include <gtest/gtest.h>

#include "core/contact/half_space_distance.h"
#include "core/contact/impact.h"
#include "core/contact/manifold.h"
#include "core/world/near_pairs.h"
#include "tests/core/contact/random_bodies.h"
#include "tests/support/sample_shapes.h"

namespace minkray::testing {
namespace {

__extension__ using Quad = __float128;
using QuadVec = std::array<Quad, 3>;

constexpr std::array places = {10.0, 100.0, 1e4, 1e6, 1e9};

/// Numbers with so few digits that they stay exact 10^9 away.
Vec3<double> coarse(const Vec3<double>& v) {
  return (v * 0x1p20).array().round().matrix() / 0x1p20;
}
Vec3<double> place_at(double distance, RandomShapes& random) {
  return (distance * random.direction()).array().round().matrix();
}

Affine<double> moved(const Affine<double>& pose, const Vec3<double>& way) {
  return {pose.linear, pose.translation + way};
}
Shape<double> under(const Shape<double>& shape, const Affine<double>& map) {
  return Transform<double>{shape, map};
}
Shape<double> moved(const Shape<double>& shape, const Vec3<double>& way) {
  return under(shape, {Mat3<double>::Identity(), way});
}

Quad root(Quad x) {
  if (!(x > 0)) return 0;
  Quad r = std::sqrt(static_cast<long double>(x));
  for (int i = 0; i < 2; ++i) r = (r + x / r) / 2;
  return r;
}
Quad dot(const QuadVec& a, const QuadVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
QuadVec along(const QuadVec& a, const QuadVec& b, Quad t) {
  return {a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]};
}
Quad limited(Quad t) {
  return t < 0 ? Quad(0) : t > 1 ? Quad(1) : t;
}

struct QuadCapsule {
  QuadVec from, way;
  Quad radius;
};

/// The capsule's end in exact arithmetic of the pose's numbers.
QuadVec image(const Affine<double>& pose, const Vec3<double>& p) {
  QuadVec q;
  for (int i = 0; i < 3; ++i) {
    Quad sum = pose.translation[i];
    for (int j = 0; j < 3; ++j) sum += Quad(pose.linear(i, j)) * Quad(p[j]);
    q[static_cast<std::size_t>(i)] = sum;
  }
  return q;
}
QuadCapsule capsule(const Affine<double>& pose, double radius, double half) {
  const QuadVec from = image(pose, {0, 0, -half}), to = image(pose, {0, 0, half});
  return {from, along(to, from, -1), radius};
}

Quad signed_distance_of(const QuadCapsule& a, const QuadCapsule& b) {
  const QuadVec x = along(b.from, a.from, -1);
  const Quad aa = dot(a.way, a.way), bb = dot(b.way, b.way), ab = dot(a.way, b.way),
             ax = dot(a.way, x), bx = dot(b.way, x), area = aa * bb - ab * ab;
  Quad least = -1;
  const auto add = [&](Quad s, Quad t) {
    const QuadVec c = along(along(x, b.way, t), a.way, -s);
    const Quad squared = dot(c, c);
    if (least < 0 || squared < least) least = squared;
  };
  for (const Quad end : {Quad(0), Quad(1)}) {
    add(limited(aa > 0 ? (ax + end * ab) / aa : 0), end);
    add(end, limited(bb > 0 ? (end * ab - bx) / bb : 0));
  }
  if (area > aa * bb * Quad(1e-25)) {
    const Quad s = (ax * bb - bx * ab) / area, t = (ax * ab - bx * aa) / area;
    if (s > 0 && s < 1 && t > 0 && t < 1) add(s, t);
  }
  return root(least) - a.radius - b.radius;
}

/// Empty if the true distance is within the bounds and the status is true.
std::string complaint_of(const SignedDistance& found, Quad truth) {
  std::ostringstream text;
  text.precision(17);
  text << name_of(found.status) << " in [" << found.lower << ", " << found.upper << "], truth "
       << static_cast<double>(truth) << ", off by "
       << static_cast<double>(truth < found.lower ? truth - found.lower : truth - found.upper);
  if (truth < found.lower || truth > found.upper) return text.str();
  if (found.status == SignedStatus::separated && !(truth > 0)) return text.str();
  if (found.status == SignedStatus::overlapping && !(truth < 0)) return text.str();
  return "";
}

/// Empty if two answers to the same question may both be true, and the second is about as sharp:
/// searches end with bounds 1e-12 of the size apart, or 1e-10 where they overlap, one here and the
/// other there.
std::string complaint_of(const SignedDistance& near, const SignedDistance& far, double size) {
  std::ostringstream text;
  text.precision(17);
  text << name_of(near.status) << " in [" << near.lower << ", " << near.upper << "], far away "
       << name_of(far.status) << " in [" << far.lower << ", " << far.upper << "]";
  const double rounding = (near.lower > 0 ? 2e-11 : 5e-10) * size;
  if (near.lower > far.upper || far.lower > near.upper) return text.str();
  if (far.upper - far.lower > 4 * (near.upper - near.lower) + rounding) return text.str();
  if (near.status == SignedStatus::separated && far.status == SignedStatus::overlapping)
    return text.str();
  if (near.status == SignedStatus::overlapping && far.status == SignedStatus::separated)
    return text.str();
  if (far.value < far.lower || far.value > far.upper) return text.str();
  return "";
}

/// A gap that rounding hides or nearly so, of both signs, or none.
double slight_gap(int k, RandomShapes& random) {
  const double gap = std::pow(10, random.in(-17, -11));
  return k % 3 == 0 ? 0 : k % 3 == 1 ? gap : -gap;
}

TEST(Places, capsules_are_as_far_apart_as_their_closed_form_says) {
  RandomShapes random(601);
  int settled = 0;
  for (const double place : {0.0, 10.0, 100.0, 1e4, 1e6, 1e9})
    for (int k = 0; k < 3000; ++k) {
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
      const Shape<double> of_a = Capsule<double>{radius_a, half_a},
                          of_b = Capsule<double>{radius_b, half_b};
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
      ASSERT_LE(mixed.upper - mixed.lower, 64 * std::numeric_limits<double>::epsilon() * size);
    }
  EXPECT_GT(settled, 11000);
}

/// All kinds, some within others.
Shape<double> any_shape(int k, RandomShapes& random) {
  static const std::vector<SampleShape> samples = sample_shapes();
  const std::size_t count = samples.size();
  switch (k % 3) {
    case 0:
      return random_shape(k / 3 % kinds_of_bodies, 1, random);
    case 1:
      return samples[static_cast<std::size_t>(k / 3) % count].shape;
    default:
      return random_nesting(static_cast<std::uint64_t>(k), 3);
  }
}

struct PosedShapes {
  Shape<double> a, b;
  Affine<double> pose_a, pose_b;
  double size = 0;

  SignedDistance distance() const {
    return signed_distance(ContactShape(a), pose_a, ContactShape(b), pose_b);
  }
};

/// Apart, overlapping, or next to touching.
PosedShapes any_pair(int k, RandomShapes& random) {
  PosedShapes pair{any_shape(k, random), any_shape(7 * k + 1, random), {random.turn(), {}}, {}};
  const ContactShape a(pair.a), b(pair.b);
  pair.size = a.ball_radius() + b.ball_radius() + a.offset() + b.offset();
  pair.pose_a.translation = coarse(pair.size * random.direction());
  pair.pose_b = {random.turn(), coarse(random.in(0, 2) * pair.size * random.direction())};
  if (k % 2 == 0) return pair;
  const double gap = pair.distance().value;
  if (gap > 0 && gap < 10 * pair.size)
    pair.a = Rounded<double>{gap + pair.size * slight_gap(k / 2, random), Nested<double>(pair.a)};
  return pair;
}

TEST(Places, distances_of_all_kinds_are_the_same_in_poses_that_are_moved) {
  RandomShapes random(602);
  int count = 0;
  for (int k = 0; k < 1500; ++k) {
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
  const Affine<double> back{Mat3<double>::Identity(), -way};
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
  for (int k = 0; k < 2000; ++k) {
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
  const auto nested = [](const Shape<double>& shape) { return Nested<double>(shape); };
  for (int k = 0; k < 1200; ++k) {
    const Shape<double> one = random_shape(k % kinds_of_bodies, 1, random),
                        two = random_shape(k / kinds_of_bodies % kinds_of_bodies, 1, random),
                        other = random_shape(5 * k % kinds_of_bodies, 1, random);
    const Vec3<double> aside = coarse(random.direction());
    const Affine<double> pose{random.turn(), coarse(random.in(1, 4) * random.direction())};
    for (const double place : places) {
      const Vec3<double> way = place_at(place, random);
      const Shape<double> there = moved(one, way),
                          also_there = moved(two, Vec3<double>(way + aside)),
                          opposite = moved(two, Vec3<double>(aside - way));
      PosedShapes near{other, other, {}, pose}, far = near;
      switch (k % 4) {
        case 0:
          near.a = MinkowskiSum<double>{{nested(one), nested(moved(two, aside))}};
          far.a = MinkowskiSum<double>{{nested(there), nested(opposite)}};
          break;
        case 1:
          near.a = MinkowskiDifference<double>{nested(one), nested(moved(two, aside))};
          far.a = MinkowskiDifference<double>{nested(there), nested(also_there)};
          break;
        case 2:
          near.a = HullOf<double>{{nested(one), nested(moved(two, aside))}};
          far.a = HullOf<double>{{nested(there), nested(also_there)}};
          far.pose_b.translation += way;
          break;
        default:
          near.a = Rounded<double>{
              0.125, nested(HullOf<double>{{nested(one), nested(moved(two, aside))}})};
          far.a =
              Rounded<double>{0.125, nested(HullOf<double>{{nested(there), nested(also_there)}})};
          far.pose_a.translation -= way;
          break;
      }
      ASSERT_EQ(complaint_of(near.distance(), far.distance(), 4), "") << k << " " << place;
    }
  }
}

TEST(Places, points_far_away_are_the_shape_that_they_are_nearby) {
  RandomShapes random(605);
  for (int k = 0; k < 600; ++k) {
    std::vector<Vec3<double>> points;
    for (int i = 0; i < 1 + k % 40; ++i) points.push_back(coarse(random.direction()));
    const Shape<double> other = random_shape(k % kinds_of_bodies, 1, random);
    const Affine<double> pose{random.turn(), coarse(random.in(0, 3) * random.direction())};
    const PosedShapes near{Hull<double>{PointCloud<double>(points)}, other, {}, pose};
    for (const double place : places) {
      const Vec3<double> way = place_at(place, random);
      std::vector<Vec3<double>> there;
      for (const Vec3<double>& p : points) there.push_back(p + way);
      const PosedShapes far{Hull<double>{PointCloud<double>(there)}, other, {}, moved(pose, way)};
      ASSERT_EQ(complaint_of(near.distance(), far.distance(), 4), "") << k << " " << place;
    }
  }
}

TEST(Places, overlaps_are_told_by_their_sign_alone_only_if_they_are_proven) {
  RandomShapes random(606);
  SignedDistanceOptions options;
  options.only_sign = true;
  int overlapping = 0, count = 0;
  for (int k = 0; k < 2000; ++k) {
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
std::string complaint_of(const Impact& near, const Impact& far, double shortest) {
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
  for (int k = 0; k < 800; ++k) {
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
      there.a.pose = moved(here.a.pose, Vec3<double>(-way));
      there.b.pose = here.b.pose;
      const Shape<double> of_a = under(moved(under(pair.a, pair.pose_a), way),
                                       {Mat3<double>::Identity(), Vec3<double>::Zero()});
      there.a.pose = {Mat3<double>::Identity(), -way};
      const Impact in_shape =
          first_impact(ContactShape(of_a), there.a, ContactShape(pair.b), there.b, 1.5);
      const double speed = (here.b.velocity - here.a.velocity).norm();
      ASSERT_EQ(complaint_of(near, in_shape, 1e-9 * pair.size / speed), "") << k << " " << place;
    }
  }
  EXPECT_GT(hits, count / 4);
}

TEST(Places, balls_meet_when_their_closed_form_says) {
  RandomShapes random(608);
  for (const double place : {0.0, 10.0, 100.0, 1e4, 1e6, 1e9})
    for (int k = 0; k < 2000; ++k) {
      const Vec3<double> at = place_at(place, random);
      RigidMotion a{{random.turn(), at}},
          b{{random.turn(), at + random.in(1, 5) * random.direction()}};
      a.velocity = random.in(0, 1) * random.direction();
      b.velocity = a.velocity - random.in(0.5, 2) * (b.pose.translation - a.pose.translation) +
                   0.5 * random.direction();
      if (k % 2 == 0) a.angular_velocity = random.direction();
      const double radius_a = random.in(0.1, 0.5), radius_b = random.in(0.1, 0.5);
      QuadVec x, v;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto e = static_cast<Eigen::Index>(i);
        x[i] = Quad(b.pose.translation[e]) - Quad(a.pose.translation[e]);
        v[i] = Quad(b.velocity[e]) - Quad(a.velocity[e]);
      }
      const Quad r = Quad(radius_a) + Quad(radius_b), towards = -dot(x, v), vv = dot(v, v),
                 inside = towards * towards - vv * (dot(x, x) - r * r);
      if (!(dot(x, x) > r * r)) continue;
      const Impact found =
          first_impact(ContactShape(Shape<double>(Sphere<double>{radius_a})), a,
                       ContactShape(Shape<double>(Sphere<double>{radius_b})), b, 3);
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
  const std::array<Vec3<double>, 3> normals = {Vec3<double>::UnitZ(), Vec3<double>(0, -1, 0),
                                               Vec3<double>(0.6, 0, 0.8)};
  for (int k = 0; k < 900; ++k) {
    const Shape<double> shape = any_shape(k, random);
    const ContactShape ready(shape);
    const Affine<double> pose{random.turn(), coarse(random.in(0, 2) * random.direction())};
    const Vec3<double>& n = normals[static_cast<std::size_t>(k) % 2];
    const double offset = coarse(Vec3<double>::Constant(random.in(-2, 2))).x();
    const SignedDistance near = distance_to_half_space(n, offset, ready, pose);
    for (const double place : places) {
      const Vec3<double> way = place_at(place, random);
      const SignedDistance far =
          distance_to_half_space(n, offset + n.dot(way), ready, moved(pose, way));
      ASSERT_EQ(far.value, near.value) << k;
      ASSERT_NEAR(far.lower, near.lower, 1e-15) << k;
      ASSERT_NEAR(far.upper, near.upper, 1e-15) << k;
      const SignedDistance in_shape = distance_to_half_space(
          n, offset + n.dot(way), ContactShape(moved(under(shape, pose), way)), {});
      const double size = ready.ball_radius() + ready.offset() + 3;
      ASSERT_EQ(complaint_of(near, in_shape, size), "") << k << " " << place;
    }
  }
}

TEST(Places, contacts_are_as_deep_as_they_are_nearby) {
  RandomShapes random(610);
  int points = 0;
  for (int k = 0; k < 400; ++k) {
    const Shape<double> box =
                            Box<double>{{random.in(0.5, 1), random.in(0.5, 1), random.in(0.2, 1)}},
                        other = k % 2 == 0 ? Shape<double>(Cylinder<double>{random.in(0.2, 1), 0.5})
                                           : Shape<double>(Box<double>{{0.5, 0.25, 0.5}});
    const ContactShape a(box), b(other);
    const double tilt = k % 3 == 0 ? 0 : random.in(0, 0.01);
    const Affine<double> pose_a{},
        pose_b{rotation_matrix(tilt, 0.0, 0.0, 1.0),
               coarse({random.in(-0.3, 0.3), random.in(-0.3, 0.3),
                       std::get<Box<double>>(box.kind).half_extents.z() + 0.5})};
    const auto manifold = [&](const Vec3<double>& way) {
      const Affine<double> at_a = moved(pose_a, way), at_b = moved(pose_b, way);
      return contact_manifold(a, at_a, b, at_b, signed_distance(a, at_a, b, at_b));
    };
    const ContactManifold near = manifold(Vec3<double>::Zero());
    if (near.count < 3) continue;
    // The gap between two faces is linear along them, but for corners 1e-6 of the size beside an
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
    const ContactBody one = here.back();
    const auto nearest = nearest_bodies(here.back(), ContactWorld(here), 5),
               also = nearest_bodies(there.back(), ContactWorld(there), 5);
    for (std::size_t i = 0; i < nearest.size(); ++i) ASSERT_EQ(nearest[i].b, also[i].b) << place;
  }
}

}  // namespace
}  // namespace minkray::testing
