// SPDX-License-Identifier: MIT
// Walks through hierarchies: no box that a ray meets is missed, by whatever instruction set, alone
// or in a group.
#include "core/bvh/traverse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/bvh/group_walk.h"
#include "core/bvh/stream.h"

#include "tests/core/bvh/boxes.h"

namespace minkray::testing {
namespace {

template <class T>
class TraverseOf : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(TraverseOf, Scalars);

/// Nothing is missing; what is there without need is touched but for rounding. Answers how many are
/// met.
template <class T>
std::size_t expect_boxes(const Bvh& bvh, const Boxes& boxes, const Ray<T>& ray) {
  const BoxSet met = boxes_met(boxes, ray);
  BoxSet first;
  for (const InstructionSet set : walk_sets()) {
    const BoxSet found = boxes_found(bvh, ray, set);
    EXPECT_TRUE(includes(found, met)) << found.size() << " of " << met.size();
    if (set == InstructionSet::sse2) first = found;
    EXPECT_EQ(found, first);
  }
  return met.size();
}

/// A box is found by a ray where it should be.
template <class T>
bool is_found(const Bounds<double>& only, const Ray<T>& ray) {
  return !boxes_found(built({only}), ray).empty();
}

TEST(Traverse, nothing_in_an_empty_hierarchy) {
  const SlabRay ray(Ray<double>{{0, 0, 0}, {1, 0, 0}});
  int called = 0;
  auto count = [&](std::uint32_t) { return ++called, false; };
  EXPECT_EQ(traverse(Bvh(), ray, count), 0u);
  EXPECT_EQ(traverse(built({box({1, -1, -1}, {2, 1, 1})}), ray, count), 1u);
  EXPECT_EQ(called, 1);
}

TYPED_TEST(TraverseOf, a_box_is_entered_where_it_should) {
  using T = TypeParam;
  using R = Ray<T>;
  const Bounds<double> only = box({1, -1, -1}, {3, 1, 1});
  EXPECT_TRUE(is_found(only, R{{0, 0, 0}, {1, 0, 0}}));
  EXPECT_TRUE(is_found(only, R{{4, 0, 0}, {-1, 0, 0}}));
  EXPECT_TRUE(is_found(only, R{{2, 0, 0}, {1, 0, 0}}));  // begins within
  EXPECT_FALSE(is_found(only, R{{0, 0, 0}, {-1, 0, 0}}));
  EXPECT_FALSE(is_found(only, R{{0, 0, 0}, {1, 0, 0}, T(0.99999)}));
  EXPECT_TRUE(is_found(only, R{{0, 0, 0}, {1, 0, 0}, T(1)}));
  EXPECT_FALSE(is_found(only, R{{0, T(1.00001), 0}, {1, 0, 0}}));
  EXPECT_FALSE(is_found(only, R{{0, T(1.00001), 0}, {1, T(-0.0), 0}}));
}

// A ray within the plane of a face, and the same with -0: 0 * infinity must not lose the box. A
// step is a power of two, and the next one above is not finite.
TEST(Traverse, the_longest_directions_enter_boxes_too) {
  const Bounds<double> only = box({1, -1, -1}, {3, 1, 1});
  for (const double length : {8e307, 9e307, std::numeric_limits<double>::max()}) {
    EXPECT_TRUE(is_found(only, Ray<double>{{2, 0, 0}, {length, 0, 0}, 0}));  // begins within
    EXPECT_TRUE(is_found(only, Ray<double>{{0, 0, 0}, {length, 0, 0}}));
    EXPECT_TRUE(is_found(only, Ray<double>{{0, 0, 0}, {length, 0, 0}, 1}));
    EXPECT_FALSE(is_found(only, Ray<double>{{0, 0, 0}, {-length, 0, 0}}));
  }
}

TYPED_TEST(TraverseOf, rays_that_lie_in_a_face_are_kept) {
  using T = TypeParam;
  using R = Ray<T>;
  const Bounds<double> only = box({1, -1, -1}, {3, 1, 1}), flat = box({1, 1, -1}, {3, 1, 1});
  for (const T zero : {T(0), T(-0.0)}) {
    for (const T y : {T(-1), T(1)}) {
      EXPECT_TRUE(is_found(only, R{{0, y, 0}, {1, zero, zero}}));
      EXPECT_TRUE(is_found(only, R{{4, y, 1}, {-1, zero, zero}}));
    }
    EXPECT_TRUE(is_found(flat, R{{0, 1, 0}, {1, zero, zero}}));
    EXPECT_FALSE(is_found(flat, R{{0, 2, 0}, {1, zero, zero}}));
    EXPECT_TRUE(is_found(flat, R{{2, 1, 0}, {zero, zero, zero}}));
    EXPECT_FALSE(is_found(flat, R{{2, 2, 0}, {zero, zero, zero}, T(1)}));
  }
}

// Rays aimed at points of the box, corners and edges above all, must meet it however they round.
TYPED_TEST(TraverseOf, a_box_is_never_lost_by_rounding) {
  using T = TypeParam;
  BoxRandom random(7);
  // Multiples of 1/1024, so that differences are exact in float, too.
  const auto point = [&](double size) {
    return Vec3<double>((random.point(size) * 1024).array().round() / 1024);
  };
  int aimed = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3<double> a = point(1);
    Vec3<double> b = point(1), target;
    for (int axis = 0; axis < 3; ++axis) {
      if (random.below(3) == 0) b[axis] = a[axis];
      const int where = random.below(3);
      target[axis] = where == 0 ? a[axis] : where == 1 ? b[axis] : (a[axis] + b[axis]) / 2;
    }
    const Vec3<T> origin = point(i % 2 ? 8 : 1000).template cast<T>(), end = target.cast<T>();
    // The exact ray through origin and target: a direction that is not rounded.
    const Vec3<T> direction = end - origin;
    if (end - direction != origin || origin + direction != end) continue;
    ++aimed;
    EXPECT_TRUE(is_found(box(a, b), Ray<T>{origin, direction}));
    EXPECT_TRUE(is_found(box(a, b), Ray<T>{origin, direction, T(1)}));
  }
  EXPECT_GT(aimed, 10000);
}

TYPED_TEST(TraverseOf, finds_what_a_search_of_all_boxes_finds) {
  using T = TypeParam;
  BoxRandom random;
  std::size_t met = 0;
  for (const BvhBuild build : {BvhBuild::quality, BvhBuild::speed})
    for (const std::size_t count : {2u, 3u, 17u, 100u, 1000u}) {
      const Boxes boxes = scattered_boxes(count, random);
      const Bvh bvh = built(boxes, build);
      for (int i = 0; i < 200; ++i) {
        const Vec3<T> origin = random.point(15).cast<T>();
        const Vec3<T> target =
            boxes[static_cast<std::size_t>(random.below(int(count)))].centre().cast<T>();
        met += expect_boxes<T>(bvh, boxes,
                               {origin, target - origin, static_cast<T>(random.within(0.5, 2))});
        met += expect_boxes<T>(bvh, boxes, {origin, Vec3<T>::Unit(i % 3)});
      }
    }
  EXPECT_GT(met, 1000u);
}

// Directions of any length, and origins far away: the same line finds the same boxes.
TEST(Traverse, lengths_and_distances_lose_nothing) {
  BoxRandom random;
  const Boxes boxes = scattered_boxes(300, random);
  const Bvh bvh = built(boxes);
  for (const int exponent : {-1000, -150, -60, 60, 150, 1000})
    for (int i = 0; i < 100; ++i) {
      const Vec3<double> target = boxes[static_cast<std::size_t>(i)].centre();
      const Vec3<double> origin = random.point(15), away = target - origin;
      const Vec3<double> scaled(std::ldexp(away.x(), exponent), std::ldexp(away.y(), exponent),
                                std::ldexp(away.z(), exponent));
      const BoxSet found = boxes_found(bvh, Ray<double>{origin, scaled});
      EXPECT_EQ(found, boxes_found(bvh, Ray<double>{origin, away}));
      EXPECT_TRUE(found.count(static_cast<std::uint32_t>(i)));
      const double far = std::ldexp(1.0, std::clamp(exponent, 20, 150));
      EXPECT_TRUE(boxes_found(bvh, Ray<double>{target - far * away, away})
                      .count(static_cast<std::uint32_t>(i)));
    }
}

// Far from the world's origin floats are coarser than the things there: no box may be lost, though
// more are found than are met.
TEST(Traverse, far_from_the_origin_nothing_is_lost) {
  BoxRandom random;
  const Vec3<double> there(1e6, -3e6, 2e6);
  Boxes boxes = scattered_boxes(500, random);
  for (Bounds<double>& b : boxes) b = {b.lower + there, b.upper + there};
  const Bvh bvh = built(boxes);
  std::size_t met = 0;
  for (int i = 0; i < 5000; ++i) {
    const Bounds<double>& aim = boxes[static_cast<std::size_t>(i) % boxes.size()];
    Vec3<double> target;
    for (int axis = 0; axis < 3; ++axis)
      target[axis] = random.below(2) ? aim.lower[axis] : aim.upper[axis];
    const Vec3<double> origin = there + random.point(15);
    met += expect_boxes<double>(bvh, boxes, {origin, target - origin});
  }
  EXPECT_GT(met, 5000u);
}

// A grid of cubes that share faces, edges and corners, at coordinates that float rounds, and rays
// within those faces, along those edges, and through those corners from afar.
TEST(Traverse, loses_nothing_at_shared_faces_and_edges) {
  BoxRandom random;
  constexpr int n = 6;
  const auto plane = [](int i) { return 0.1 * i - 0.3; };
  Boxes boxes;
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < n; ++z)
        boxes.push_back(
            {{plane(x), plane(y), plane(z)}, {plane(x + 1), plane(y + 1), plane(z + 1)}});
  const Bvh bvh = built(boxes);
  const auto corner = [&] {
    return Vec3<double>(plane(random.below(n + 1)), plane(random.below(n + 1)),
                        plane(random.below(n + 1)));
  };
  std::size_t met = 0;
  for (int i = 0; i < 1500; ++i) {
    const Vec3<double> a = corner(), b = corner();
    met += expect_boxes<double>(bvh, boxes, {a + 3 * (a - b), b - a});  // corner to corner
    Vec3<double> along = Vec3<double>::Zero();
    along[i % 3] = i % 2 ? 1 : -1;
    met += expect_boxes<double>(bvh, boxes, {a - 5 * along, along});  // along an edge
    along[(i + 1) % 3] = random.within(-1, 1);
    met += expect_boxes<double>(bvh, boxes, {a - 5 * along, along});  // within a face
  }
  EXPECT_GT(met, 4500u);
}

TEST(Traverse, near_boxes_come_first_and_a_hit_ends_the_search_behind_it) {
  Boxes row;
  for (int i = 0; i < 1024; ++i) row.push_back(box({2.0 * i, 0, 0}, {2.0 * i + 1, 1, 1}));
  const Bvh bvh = built(row);
  for (const bool backwards : {false, true}) {
    SlabRay ray(backwards ? Ray<double>{{4000, 0.5, 0.5}, {-1, 0, 0}}
                          : Ray<double>{{-4000, 0.5, 0.5}, {1, 0, 0}});
    std::vector<std::uint32_t> order;
    const auto visited = traverse(bvh, ray, [&](std::uint32_t i) {
      order.push_back(i);
      ray.numbers.t_max = ray.limit(4000 + (backwards ? -1.0 : 1.0) * 2.0 * i);
      return false;
    });
    EXPECT_EQ(order, std::vector<std::uint32_t>{backwards ? 1023u : 0u});
    EXPECT_LE(visited, 5u);
  }
}

TEST(Traverse, slabs_of_many_rays_are_those_of_single_rays) {
  if (!has_avx2()) GTEST_SKIP() << "no AVX2";
  BoxRandom random(4);
  std::vector<Ray<double>> rays;
  for (int i = 0; i < 20'000; ++i) {
    // Lengths from the least to the greatest, and all between.
    const double length = std::exp2(i % 3 == 0 ? random.within(-1074, 1023) : random.within(-9, 9));
    Ray<double> ray{std::exp2(random.within(-60, 60)) * random.point(1),
                    length * random.point(1).normalized()};
    if (i % 5 == 0) ray.direction[i % 3] = i % 2 == 0 ? 0.0 : -0.0;
    if (i % 7 == 0) ray.direction[i % 3] *= 0x1p-600;
    if (i % 4 == 0) ray.t_max = std::exp2(random.within(-30, 30));
    rays.push_back(ray);
  }
  rays.push_back({{1, 2, 3}, {0, 0, 0}});
  rays.push_back({{0, -0.0, 3}, {0.5, 2, -1}});
  std::vector<SlabRay> together(rays.size());
  make_slabs_avx2(reinterpret_cast<const char*>(rays.data()), sizeof rays[0], rays.size(),
                  together.data());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const SlabRay single(rays[i]);
    ASSERT_EQ(together[i].steps, single.steps) << i;
    ASSERT_EQ(std::memcmp(&together[i].numbers, &single.numbers, sizeof single.numbers), 0) << i;
  }
}

TEST(Traverse, a_group_finds_the_boxes_of_its_rays) {
  if (!has_avx2()) GTEST_SKIP() << "no AVX2";
  BoxRandom random(5);
  Boxes boxes;
  for (int i = 0; i < 500; ++i) {
    const Vec3<double> at = 4 * random.point(1);
    boxes.push_back(box(at, at + random.within(0, 1) * Vec3<double>::Ones()));
  }
  const Bvh bvh = built(boxes);
  std::size_t found = 0, groups = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3<double> from = 6 * random.point(1), towards = random.point(1).normalized();
    const auto count = static_cast<std::size_t>(1 + i % 32);
    std::vector<SlabRay> rays;
    for (std::size_t k = 0; k < count; ++k)
      rays.emplace_back(
          Ray<double>{from, (1 + static_cast<double>(k)) * (towards + 0.05 * random.point(1))});
    std::vector<BoxSet> of_group(count);
    auto visit = [&](std::uint32_t number, std::uint32_t in) {
      for (std::size_t k = 0; k < count; ++k)
        if (in >> k & 1u) of_group[k].insert(number);
      // Rays past the first end after five boxes.
      for (std::size_t k = 1; k < count; ++k)
        if (of_group[k].size() == 5) rays[k].numbers.t_max = -1;
    };
    std::vector<BoxSet> alone;
    for (const SlabRay& ray : rays) {
      alone.emplace_back();
      traverse(bvh, ray, [&](std::uint32_t number) { return alone.back().insert(number), false; });
    }
    if (walk_group(bvh, rays, visit) == 0) continue;
    ++groups;
    EXPECT_EQ(of_group[0], alone[0]);
    for (std::size_t k = 1; k < count; ++k) {
      EXPECT_TRUE(includes(alone[k], of_group[k]));
      EXPECT_EQ(of_group[k].size(), std::min<std::size_t>(5, alone[k].size()));
    }
    found += alone[0].size();
  }
  EXPECT_GT(groups, 200u);
  EXPECT_GT(found, 300u);
}

}  // namespace
}  // namespace minkray::testing
