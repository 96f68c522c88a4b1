// SPDX-License-Identifier: MIT
// Many distances at once have the bits of each by itself, whatever the number of threads.
#include "core/pair_distance/many_distances.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/parallel/parallel.h"
#include "tests/core/pair_distance/pair_judge.h"

namespace minkray::testing {
namespace {

void expect_same_bits(const SignedDistance& one, const SignedDistance& other, std::size_t i) {
  const auto same = [](const auto& x, const auto& y) {
    return std::memcmp(&x, &y, sizeof(x)) == 0;
  };
  EXPECT_EQ(one.status, other.status) << i;
  EXPECT_EQ(one.supports, other.supports) << i;
  EXPECT_TRUE(same(one.value, other.value) && same(one.lower, other.lower) &&
              same(one.upper, other.upper) && same(one.point_a, other.point_a) &&
              same(one.point_b, other.point_b) && same(one.normal, other.normal))
      << i;
}

TEST(ManyDistances, of_many_pairs_are_those_of_each) {
  RandomShapes random(17);
  std::vector<RandomPair> made;
  for (int k = 0; k < 3 * kinds_of_bodies * kinds_of_bodies; ++k)
    made.push_back(
        random_pair(k % kinds_of_bodies, k / kinds_of_bodies % kinds_of_bodies, k, random));
  std::vector<PosedPair> pairs;
  for (const RandomPair& pair : made)
    pairs.push_back({&pair.a.ready, &pair.b.ready, pair.a.pose, pair.b.pose});
  for (const int threads : {1, 3}) {
    std::vector<SignedDistance> answers(pairs.size());
    std::vector<PairMemory> memories(pairs.size());
    with_threads(threads, [&] { signed_distances(pairs, answers); });
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const Body &a = made[i].a, &b = made[i].b;
      expect_same_bits(answers[i], signed_distance(a, b), i);
    }
    // Twice, so that there is something in the memories.
    for (int again = 0; again < 2; ++again)
      with_threads(threads, [&] { signed_distances(pairs, memories, answers); });
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const Body &a = made[i].a, &b = made[i].b;
      PairMemory memory;
      signed_distance(a, b, memory);
      expect_same_bits(answers[i], signed_distance(a, b, memory), i);
    }
  }
}

TEST(ManyDistances, of_one_pair_in_many_poses_are_those_of_each) {
  RandomShapes random(19);
  for (int kind = 0; kind < kinds_of_bodies; ++kind) {
    const Body a(random_shape(kind, 1, random), {random.turn(), random.direction()});
    const Body b(random_shape((kind + 5) % kinds_of_bodies, 1, random), {});
    std::vector<Affine<double>> poses(300);
    for (Affine<double>& pose : poses) pose = {random.turn(), random.in(0, 4) * random.direction()};
    SignedDistanceOptions options;
    options.only_sign = kind % 2 == 0;
    std::vector<SignedDistance> answers(poses.size());
    signed_distances(a.ready, a.pose, b.ready, poses, answers, options);
    for (std::size_t i = 0; i < poses.size(); ++i)
      expect_same_bits(answers[i], signed_distance(a.ready, a.pose, b.ready, poses[i], options), i);
  }
}

}  // namespace
}  // namespace minkray::testing
