// SPDX-License-Identifier: MIT
// Queries on pairs return what tests/golden/pairs.txt records, bit for bit, and on the same paths:
// signed distances, contact points, times of impact, casts of shapes and the distances of GJK, for
// every two kinds of bodies, apart, touching and in each other. Other tests check that the results
// are right; here nothing changes unnoticed, not even the cost of a query. `./run golden` records
// the results.
#include <gtest/gtest.h>

#include "core/pair_distance/half_space_distance.h"
#include "core/pair_distance/manifold.h"
#include "core/pair_motion/impact.h"
#include "core/pair_motion/swept.h"
#include "renderer/paper/rotating_cast.h"
#include "renderer/paper/shape_cast.h"
#include "tests/core/pair_distance/aligned_bodies.h"
#include "tests/core/pair_distance/pair_judge.h"
#include "tests/renderer/paper/random_poses.h"
#include "tests/support/hashed_bits.h"

namespace minkray::testing {
namespace {

struct Bits : HashedBits {
  using HashedBits::add;

  void add(const SignedDistance& found) {
    add(answers, found.status);
    for (const double number : {found.value, found.lower, found.upper}) add(answers, number);
    for (const Vec3<double>& v : {found.point_a, found.point_b, found.normal}) add(answers, v);
    add(costs, found.is_exhausted);
    add(costs, found.supports);
  }
  void add(const ContactManifold& contact) {
    add(answers, contact.count);
    add(answers, contact.normal);
    for (int i = 0; i < contact.count; ++i) {
      add(answers, contact.points[std::size_t(i)].point_a);
      add(answers, contact.points[std::size_t(i)].point_b);
      add(answers, contact.points[std::size_t(i)].distance);
    }
  }
  void add(const Impact& impact) {
    add(answers, impact.status);
    for (const double number : {impact.t_lo, impact.t_hi, impact.distance}) add(answers, number);
    for (const Vec3<double>& v : {impact.point_a, impact.point_b, impact.normal}) add(answers, v);
    add(costs, impact.steps);
  }
  void add(const ShapeCastResult& found) {
    add(answers, found.cast.status);
    for (const double number : {found.cast.t_base, found.cast.t_offset}) add(answers, number);
    for (const Vec3<double>& v : {found.point_a, found.point_b, found.cast.normal}) add(answers, v);
    add(costs, found.cast.path);
    add(costs, found.cast.supports);
  }
  void add(const RotatingCastResult& found) {
    add(answers, found.status);
    for (const double number : {found.t, found.t_lo, found.position_error}) add(answers, number);
    for (const Vec3<double>& v : {found.point_a, found.point_b, found.normal}) add(answers, v);
    add(answers, found.proven);
    for (const int count : {found.steps, found.iterations, found.supports}) add(costs, count);
  }
  void add(const DistanceResult<double, 3>& found) {
    add(answers, found.status);
    for (const double number : {found.distance, found.lower, found.certificate})
      add(answers, number);
    for (const Vec3<double>& v : {found.point_a, found.point_b, found.axis}) add(answers, v);
    for (const int count : {found.iterations, found.supports}) add(costs, count);
  }
};

using AllBits = std::map<std::string, Bits>;

constexpr int pairs_each = 48;          ///< of two kinds
constexpr int moving_pairs_each = 12;   ///< of these, for what moves and for the distances of GJK
constexpr int aligned_pairs_each = 24;  ///< of two kinds of aligned bodies
constexpr int slender_pairs = 1000;     ///< for each thinness
constexpr int hidden_pairs = 300;       ///< of shapes known by their support mapping only
constexpr int coaxial_pairs = 500;      ///< of solids of revolution about parallel axes

void ask_distances(const Body& a, const Body& b, int k, AllBits& bits) {
  const SignedDistance found = signed_distance(a, b);
  bits["distances"].add(found);
  bits["contacts"].add(contact_manifold(a.ready, a.pose, b.ready, b.pose, found));
  const double size = size_of(a, b);
  SignedDistanceOptions options;
  switch (k % 4) {
    case 0:
      options.only_sign = true;
      break;
    case 1:
      options.at_most = 0.1 * size;
      break;
    case 2:
      options.max_supports = 300;
      break;
    default:
      options.tolerance = 1e-4;
      break;
  }
  bits["rough distances"].add(signed_distance(a, b, options));
  PairMemory memory;
  Affine<double> pose = b.pose;
  for (int frame = 0; frame < 3; ++frame) {
    bits["remembered distances"].add(signed_distance(a.ready, a.pose, b.ready, pose, memory));
    pose.linear = rotation_matrix(0.01, 0.02, -0.01, 1.0) * pose.linear;
    pose.translation += 0.02 * size * Vec3<double>(0.3, -0.5, 0.8);
  }
  bits["half-spaces"].add(
      distance_to_half_space(Vec3<double>(2, -1, 2) / 3, 0.25, b.ready, b.pose));
}

void ask_impacts(const Body& a, const Body& b, AllBits& bits, RandomShapes& random) {
  const double size = size_of(a, b);
  const Vec3<double> between = b.pose.translation - a.pose.translation;
  RigidMotion of_a{a.pose}, of_b{b.pose};
  of_a.velocity = 0.3 * size * random.direction();
  of_b.velocity = of_a.velocity - random.in(0, 2) * (between + 0.4 * size * random.direction());
  bits["straight impacts"].add(first_impact(a.ready, of_a, b.ready, of_b, 1.5));
  PairMemory memory;
  for (int frame = 0; frame < 2; ++frame)
    bits["remembered impacts"].add(first_impact(a.ready, of_a, b.ready, of_b, 1.5, memory));
  of_a.angular_velocity = random.in(0, 3) * random.direction();
  of_b.angular_velocity = random.in(0, 3) * random.direction();
  bits["turning impacts"].add(first_impact(a.ready, of_a, b.ready, of_b, 1.5));

  const Shape path = swept(b.shape, b.pose, of_b.at(1));
  for (int i = 0; i < 6; ++i) {
    const Vec3<double> n = random.direction();
    Bits::add(bits["swept"].answers, Vec3<double>(path.support(n)));
    Bits::add(bits["swept"].answers, distance_from_axis(b.shape, n));
  }
}

void ask_casts(const Body& a, const Body& b, AllBits& bits, RandomShapes& random) {
  const Vec3<double> between = b.pose.translation - a.pose.translation;
  const double size = size_of(a, b);
  const Vec3<double> velocity = -between + 0.4 * size * random.direction();
  const PreparedPair pair = pair_of(a.shape, a.pose, b.shape, b.pose);
  bits["shape casts"].add(cast_shape(pair, Vec3<double>(velocity)));
  const RigidMotion of_b{b.pose, velocity, random.direction()};
  bits["turning casts"].add(cast_rotating(a.shape, {a.pose}, b.shape, of_b, 1.5, 4));
  for (const auto& subalgorithm : named_subalgorithms)
    bits["GJK " + std::string(subalgorithm.name)].add(
        distance_between(place(a.shape, a.pose), place(b.shape, b.pose), {}, subalgorithm.kind));
}

void expect_as_recorded(const std::string& of, const AllBits& bits) {
  RecordedHashes recorded("pairs.txt", "the queries of golden_pairs_test.cpp answer");
  testing::expect_as_recorded(recorded, of, bits);
}

class GoldenPairs : public ::testing::TestWithParam<int> {};

TEST_P(GoldenPairs, are_as_recorded) {
  RandomShapes random(2004u + unsigned(GetParam()));
  AllBits bits;
  for (int other = 0; other < kinds_of_bodies; ++other)
    for (int k = 0; k < pairs_each; ++k) {
      const auto [a, b] = random_pair(GetParam(), other, k, random);
      ask_distances(a, b, k, bits);
      if (k >= moving_pairs_each) continue;
      ask_impacts(a, b, bits, random);
      ask_casts(a, b, bits, random);
    }
  expect_as_recorded("kind " + std::to_string(GetParam()), bits);
}

INSTANTIATE_TEST_SUITE_P(Kinds, GoldenPairs, ::testing::Range(0, kinds_of_bodies));

TEST(GoldenAlignedPairs, are_as_recorded) {
  RandomShapes random(5);
  AllBits bits;
  for (int k = 0; k < kinds_of_aligned_bodies * kinds_of_aligned_bodies * aligned_pairs_each; ++k) {
    const Shape one = aligned_shape(k, random),
                other = aligned_shape(k / kinds_of_aligned_bodies, random);
    const Mat3<double> turn_a = right_angle(random), turn_b = right_angle(random);
    const Body a(one, {turn_a, Vec3<double>::Zero()}), b(other, {turn_b, grid_point(random)});
    // Some use as many support points as they may.
    SignedDistanceOptions options;
    options.max_supports = 2000;
    const SignedDistance found = signed_distance(a, b, options);
    bits["distances"].add(found);
    bits["contacts"].add(contact_manifold(a.ready, a.pose, b.ready, b.pose, found));
    RigidMotion of_a{a.pose}, of_b{b.pose};
    of_b.pose.translation += Vec3<double>(0, 0, 4);
    of_b.velocity = Vec3<double>(0, 0, -4);
    bits["straight impacts"].add(first_impact(a.ready, of_a, b.ready, of_b, 1));
    if (k % 8 > 0) continue;
    of_b.angular_velocity = Vec3<double>(0, 0, 1);
    bits["turning impacts"].add(first_impact(a.ready, of_a, b.ready, of_b, 1));
  }
  expect_as_recorded("aligned", bits);
}

TEST(GoldenHiddenPairs, are_as_recorded) {
  RandomShapes random(61);
  AllBits bits;
  const auto hidden = [&](int kind) {
    ShapeList shapes;
    for (int i = 0; i < 2; ++i) shapes.push_back(random_shape(kind, 1, random));
    return Shape(HullOf{shapes});
  };
  for (int k = 0; k < hidden_pairs; ++k) {
    const Body a(hidden(k % kinds_of_bodies), {random.turn(), Vec3<double>::Zero()});
    Body b(hidden(k / kinds_of_bodies % kinds_of_bodies),
           {random.turn(), random.in(0, 2.5) * random.direction()});
    const double left = std::pow(10, random.in(-14, -2));
    if (k % 3 > 0) bring_near(a, b, k % 3 == 1 ? left : -left, 1);
    ask_distances(a, b, k, bits);
    if (k % 20 == 0) ask_impacts(a, b, bits, random);
  }
  expect_as_recorded("hidden", bits);
}

TEST(GoldenCoaxialPairs, are_as_recorded) {
  RandomShapes random(11);
  AllBits bits;
  constexpr std::array of_revolution = {6, 7, 8, 9, 10, 14, 15};
  const auto little = [&] { return random.in(0, 1) < 0.4 ? 0 : std::pow(10, random.in(-17, 0)); };
  for (int k = 0; k < coaxial_pairs; ++k) {
    const auto kind = [&](int i) { return of_revolution[std::size_t(i) % of_revolution.size()]; };
    const Shape one = random_shape(kind(k), 1, random),
                other = random_shape(kind(k / 7), 1, random);
    const Mat3<double> turn = random.turn();
    const double x = little(), y = little(), tilt = k % 4 == 0 ? little() : 0;
    const Body a(one, {turn, Vec3<double>::Zero()}),
        b(other, {turn * rotation_matrix(tilt, 0.0, 0.0, 1.0),
                  turn * Vec3<double>(x, y, random.in(-2, 2))});
    ask_distances(a, b, k, bits);
  }
  expect_as_recorded("coaxial", bits);
}

TEST(GoldenSlenderPairs, are_as_recorded) {
  AllBits bits;
  for (const int thin : {30, 1000, 100000}) {
    RandomShapes random(static_cast<unsigned>(thin));
    for (int k = 0; k < slender_pairs; ++k) {
      const auto [a, b] = slender_pair(k, thin, random);
      ask_distances(a, b, k, bits);
      if (k % 20 == 0) ask_impacts(a, b, bits, random);
    }
  }
  expect_as_recorded("slender", bits);
}

}  // namespace
}  // namespace minkray::testing
