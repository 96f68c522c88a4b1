// SPDX-License-Identifier: MIT
#include "core/bvh/bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <random>
#include <set>

#include "core/bvh/traverse.h"
#include "core/parallel/parallel.h"

namespace minkray {
namespace {

using Boxes = std::vector<Bounds<double>>;

Bvh built(const Boxes& boxes) {
  return build_bvh<double>(boxes);
}

Bounds<double> box(const Vec3<double>& a, const Vec3<double>& b) {
  return {a.cwiseMin(b), a.cwiseMax(b)};
}

/// Parents hold their children, leaves their boxes, every primitive is in one leaf, siblings follow
/// their parents. Answers the depth.
int check(const Bvh& bvh, const Boxes& boxes) {
  std::vector<int> seen(boxes.size(), 0);
  int deepest = 0;
  const auto holds = [](const BvhNode& node, const auto& lower, const auto& upper) {
    for (int i = 0; i < 3; ++i)
      if (!(node.planes[0][i] <= lower[i] && node.planes[1][i] >= upper[i])) return false;
    return true;
  };
  struct Open {
    std::uint32_t node;
    int depth;
  };
  std::vector<Open> open = {{0, 0}};
  std::size_t visited = 0;
  while (!open.empty()) {
    const auto [at, depth] = open.back();
    open.pop_back();
    ++visited;
    deepest = std::max(deepest, depth);
    const BvhNode& node = bvh.nodes.at(at);
    if (node.is_leaf()) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        const std::uint32_t primitive = bvh.primitives.at(i);
        ++seen.at(primitive);
        EXPECT_TRUE(holds(node, boxes[primitive].lower, boxes[primitive].upper));
      }
      continue;
    }
    EXPECT_GT(node.first, at);
    for (const std::uint32_t child : {node.first, node.first + 1}) {
      const BvhNode& below = bvh.nodes.at(child);
      EXPECT_TRUE(holds(node, below.planes[0], below.planes[1]));
      open.push_back({child, depth + 1});
    }
  }
  EXPECT_EQ(visited, bvh.nodes.size());
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(boxes.size()));
  return deepest;
}

/// The boxes that a ray meets, by the hierarchy and one by one.
void expect_same_boxes(const Bvh& bvh, const Boxes& boxes, const Ray<double>& ray) {
  std::set<std::uint32_t> found, expected;
  traverse(bvh, ray, [&](std::uint32_t i, double&) {
    found.insert(i);
    return false;
  });
  const SlabRay<double> slabs(ray);
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    double planes[2][3];
    for (int axis = 0; axis < 3; ++axis) {
      planes[0][axis] = boxes[i].lower[axis];
      planes[1][axis] = boxes[i].upper[axis];
    }
    if (slab_entry(slabs, planes, ray.t_max) < std::numeric_limits<double>::infinity())
      expected.insert(i);
  }
  // Leaves may hold further boxes: the caller tests each. None may be missing.
  EXPECT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
}

class Random {
 public:
  double within(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(generator_); }
  Vec3<double> point(double size) {
    return {within(-size, size), within(-size, size), within(-size, size)};
  }

 private:
  std::mt19937 generator_{11};
};

Boxes scattered_boxes(std::size_t count, Random& random) {
  Boxes boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3<double> middle = random.point(10), half = random.point(0.3).cwiseAbs();
    boxes.push_back({middle - half, middle + half});
  }
  return boxes;
}

TEST(Bvh, none_and_one) {
  EXPECT_TRUE(built({}).nodes.empty());
  int called = 0;
  const auto count = [&](std::uint32_t, double&) { return ++called, false; };
  const Ray<double> ray{{0, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(traverse(built({}), ray, count), 0u);
  EXPECT_EQ(called, 0);

  const Bvh one = built({box({1, -1, -1}, {2, 1, 1})});
  EXPECT_EQ(one.nodes.size(), 1u);
  EXPECT_EQ(traverse(one, ray, count), 1u);
  EXPECT_EQ(called, 1);
  EXPECT_EQ(traverse(one, Ray<double>{{0, 3, 0}, {1, 0, 0}}, count), 1u);
  EXPECT_EQ(called, 1);
}

TEST(Bvh, finds_what_a_search_of_all_boxes_finds) {
  Random random;
  for (const std::size_t count : {2u, 3u, 17u, 100u, 3000u}) {
    const Boxes boxes = scattered_boxes(count, random);
    const Bvh bvh = built(boxes);
    check(bvh, boxes);
    for (int i = 0; i < 300; ++i) {
      const Vec3<double> origin = random.point(15);
      const Vec3<double> target =
          boxes[static_cast<std::size_t>(random.below(int(count)))].centre();
      expect_same_boxes(bvh, boxes, {origin, target - origin, random.within(0.5, 2)});
      expect_same_boxes(bvh, boxes, {origin, Vec3<double>::Unit(i % 3)});
    }
  }
}

// A grid of cubes that share faces, edges and corners, at coordinates that float rounds, and rays
// within those faces, along those edges, and through those corners from afar.
TEST(Bvh, loses_nothing_at_shared_faces_and_edges) {
  Random random;
  constexpr int n = 8;
  const auto plane = [](int i) { return 0.1 * i - 0.3; };
  Boxes boxes;
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < n; ++z)
        boxes.push_back(
            {{plane(x), plane(y), plane(z)}, {plane(x + 1), plane(y + 1), plane(z + 1)}});
  const Bvh bvh = built(boxes);
  check(bvh, boxes);
  const auto corner = [&] {
    return Vec3<double>(plane(random.below(n + 1)), plane(random.below(n + 1)),
                        plane(random.below(n + 1)));
  };
  for (int i = 0; i < 2000; ++i) {
    const Vec3<double> a = corner(), b = corner();
    expect_same_boxes(bvh, boxes, {a + 3 * (a - b), b - a});  // corner to corner
    Vec3<double> along = Vec3<double>::Zero();
    along[i % 3] = i % 2 ? 1 : -1;
    expect_same_boxes(bvh, boxes, {a - 5 * along, along});  // along an edge
    along[(i + 1) % 3] = random.within(-1, 1);
    expect_same_boxes(bvh, boxes, {a - 5 * along, along});  // within a face
  }
}

TEST(Bvh, is_the_same_for_any_number_of_threads) {
  Random random;
  const Boxes boxes = scattered_boxes(100000, random);
  Bvh alone;
  with_threads(1, [&] { alone = built(boxes); });
  check(alone, boxes);
  for (const int threads : {2, 5}) {
    Bvh together;
    with_threads(threads, [&] { together = built(boxes); });
    EXPECT_EQ(alone.primitives, together.primitives);
    ASSERT_EQ(alone.nodes.size(), together.nodes.size());
    EXPECT_EQ(std::memcmp(alone.nodes.data(), together.nodes.data(),
                          alone.nodes.size() * sizeof(BvhNode)),
              0);
  }
}

TEST(Bvh, a_million_boxes_in_one_place_make_a_shallow_tree) {
  const Boxes boxes(1000000, box({1, 2, 3}, {2, 3, 4}));
  EXPECT_LE(check(built(boxes), boxes), 20);
}

// Each box is a thousandth of the one before: every split by area takes off one box, which would
// be a list instead of a tree.
TEST(Bvh, depth_is_bounded) {
  Boxes boxes;
  double size = 1e38;
  for (int i = 0; i < 5000; ++i) {
    boxes.push_back(box({0, 0, 0}, {size, size, size}));
    size = size < 1e-37 ? 1e38 : size * 0.9;
  }
  EXPECT_LE(check(built(boxes), boxes), bvh_max_depth);
}

TEST(Bvh, flat_and_infinite_boxes_are_boxes_too) {
  const double inf = std::numeric_limits<double>::infinity();
  Random random;
  Boxes boxes;
  for (int i = 0; i < 100; ++i) {
    const Vec3<double> p = random.point(1);
    boxes.push_back({p, p});
    Vec3<double> q = p;
    q[i % 3] += 1;
    boxes.push_back({p, q});
  }
  boxes.push_back({{-inf, -inf, -1}, {inf, inf, 0}});
  boxes.push_back({{-1e300, -1, -1}, {1e300, 1, 1}});
  const Bvh bvh = built(boxes);
  check(bvh, boxes);
  for (const Bounds<double>& target : boxes) {
    const Vec3<double> origin = random.point(4);
    const Vec3<double> middle =
        target.lower.array().isFinite().all() ? target.centre() : Vec3<double>::Zero();
    expect_same_boxes(bvh, boxes, {origin, middle - origin});
  }
}

TEST(Bvh, near_boxes_come_first_and_a_hit_ends_the_search_behind_it) {
  Boxes row;
  for (int i = 0; i < 1024; ++i) row.push_back(box({2.0 * i, 0, 0}, {2.0 * i + 1, 1, 1}));
  const Bvh bvh = built(row);
  for (const bool backwards : {false, true}) {
    const Ray<double> ray = backwards ? Ray<double>{{4000, 0.5, 0.5}, {-1, 0, 0}}
                                      : Ray<double>{{-4000, 0.5, 0.5}, {1, 0, 0}};
    std::vector<std::uint32_t> order;
    const auto tested = traverse(bvh, ray, [&](std::uint32_t i, double& t_max) {
      order.push_back(i);
      t_max = 4000 + (backwards ? -1.0 : 1.0) * 2.0 * i;
      return false;
    });
    EXPECT_EQ(order.front(), backwards ? 1023u : 0u);
    EXPECT_EQ(order.size(), 1u);
    EXPECT_LE(tested, 2u * 20u);
  }
}

}  // namespace
}  // namespace minkray
