// SPDX-License-Identifier: MIT
// The tree: what it holds, how deep and large it is, and that it is the same however it was built.
#include "core/bvh/bvh.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/parallel/parallel.h"
#include "tests/core/bvh/boxes.h"

namespace minkray::testing {
namespace {

constexpr BvhBuild builds[] = {BvhBuild::quality, BvhBuild::speed};

bool holds(const Bounds<float>& outer, const Bounds<double>& inner) {
  return (outer.lower.cast<double>().array() <= inner.lower.array()).all() &&
         (outer.upper.cast<double>().array() >= inner.upper.array()).all();
}

/// Children hold what is in them, every box is in one leaf, children follow their parents, every
/// node is somebody's child and has two children at least. Answers the depth.
int check(const Bvh& bvh, const Boxes& boxes) {
  std::vector<int> seen(boxes.size(), 0);
  int deepest = 0;
  struct Open {
    std::uint32_t node;
    int depth;
    Bounds<double> around;
  };
  const double inf = std::numeric_limits<double>::infinity();
  std::vector<Open> open = {{0, 1, {Vec3<double>::Constant(-inf), Vec3<double>::Constant(inf)}}};
  std::size_t visited = 0;
  while (!open.empty()) {
    const Open at = open.back();
    open.pop_back();
    ++visited;
    deepest = std::max(deepest, at.depth);
    const BvhNode& node = bvh.nodes.at(at.node);
    int children = 0;
    for (int child = 0; child < bvh_width; ++child) {
      const std::uint32_t what = node.children[child];
      if (what == BvhNode::none) continue;
      EXPECT_EQ(child, children) << "a gap between children";
      ++children;
      const Bounds<float> box = node.box(child);
      const Bounds<double> exact{box.lower.cast<double>(), box.upper.cast<double>()};
      EXPECT_TRUE((exact.lower.array() >= at.around.lower.array()).all() &&
                  (exact.upper.array() <= at.around.upper.array()).all());
      if (what & BvhNode::leaf) {
        const std::uint32_t index = what & ~BvhNode::leaf;
        ++seen.at(index);
        EXPECT_TRUE(holds(box, boxes[index]));
      } else {
        EXPECT_GT(what, at.node);
        open.push_back({what, at.depth + 1, exact});
      }
    }
    EXPECT_GE(children, boxes.size() == 1 ? 1 : 2);
  }
  EXPECT_EQ(visited, bvh.nodes.size());
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(boxes.size()));
  return deepest;
}

TEST(Bvh, holds_every_box_once) {
  EXPECT_TRUE(built({}).nodes.empty());
  BoxRandom random;
  for (const BvhBuild build : builds)
    for (const std::size_t count : {1u, 2u, 3u, 8u, 9u, 17u, 100u, 3000u, 20000u}) {
      const Boxes boxes = scattered_boxes(count, random);
      check(built(boxes, build), boxes);
    }
}

TEST(Bvh, is_the_same_for_any_number_of_threads) {
  BoxRandom random;
  const Boxes boxes = scattered_boxes(100000, random);
  for (const BvhBuild build : builds) {
    Bvh alone;
    with_threads(1, [&] { alone = built(boxes, build); });
    check(alone, boxes);
    for (const int threads : {2, 5}) {
      Bvh together;
      with_threads(threads, [&] { together = built(boxes, build); });
      ASSERT_EQ(alone.nodes.size(), together.nodes.size());
      EXPECT_EQ(std::memcmp(alone.nodes.data(), together.nodes.data(),
                            alone.nodes.size() * sizeof(BvhNode)),
                0);
    }
  }
}

// Ten million objects must fit in memory: 64 bytes for each.
TEST(Bvh, takes_at_most_64_bytes_a_box) {
  BoxRandom random;
  for (const std::size_t count : {1000u, 10000u, 70000u, 100000u}) {
    Boxes clustered = scattered_boxes(count, random);
    for (Bounds<double>& b : clustered) {
      const Vec3<double> at = b.centre().array().cube() * 1e-2;
      b = {at - b.half_extents(), at + b.half_extents()};
    }
    for (const BvhBuild build : builds)
      for (const Boxes& boxes : {scattered_boxes(count, random), clustered}) {
        const Bvh bvh = built(boxes, build);
        EXPECT_LE(bvh.bytes(), 64 * count) << count << (build == BvhBuild::speed ? " speed" : "");
        EXPECT_GE(bvh.bytes(), 32 * count);
      }
  }
}

TEST(Bvh, quality_is_worth_its_time) {
  BoxRandom random;
  const Boxes boxes = scattered_boxes(30000, random);
  const VisitEstimate quality = expected_visits(built(boxes)),
                      speed = expected_visits(built(boxes, BvhBuild::speed));
  EXPECT_LT(quality.nodes * 1.05, speed.nodes);
  EXPECT_GT(quality.nodes * 3, speed.nodes);
  // Leaves hold a box each, so these are the boxes' areas.
  EXPECT_NEAR(quality.leaves, speed.leaves, 1e-6 * speed.leaves);
}

TEST(Bvh, a_million_boxes_in_one_place_make_a_shallow_tree) {
  const Boxes boxes(1000000, box({1, 2, 3}, {2, 3, 4}));
  for (const BvhBuild build : builds) EXPECT_LE(check(built(boxes, build), boxes), 20);
}

// Each box is a tenth smaller than the one before: every split by area takes off few boxes, which
// would be a list instead of a tree.
TEST(Bvh, depth_is_bounded) {
  Boxes boxes;
  double size = 1e38;
  for (int i = 0; i < 5000; ++i) {
    boxes.push_back(box({0, 0, 0}, {size, size, size}));
    size = size < 1e-37 ? 1e38 : size * 0.9;
  }
  for (const BvhBuild build : builds) EXPECT_LE(check(built(boxes, build), boxes), bvh_max_depth);
}

TEST(Bvh, flat_and_infinite_boxes_are_boxes_too) {
  const double inf = std::numeric_limits<double>::infinity();
  BoxRandom random;
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
  for (const BvhBuild build : builds) {
    const Bvh bvh = built(boxes, build);
    check(bvh, boxes);
    for (const Bounds<double>& target : boxes) {
      const Vec3<double> origin = random.point(4);
      const Vec3<double> middle =
          target.lower.array().isFinite().all() ? target.centre() : Vec3<double>::Zero();
      const Ray<double> ray{origin, middle - origin};
      EXPECT_TRUE(includes(boxes_found(bvh, ray), boxes_met(boxes, ray)));
    }
  }
}

TEST(Bvh, refitted_around_what_has_moved) {
  BoxRandom random;
  Boxes boxes = scattered_boxes(5000, random);
  for (const BvhBuild build : builds) {
    Bvh bvh = built(boxes, build);
    const Bvh before = bvh;
    refit(bvh, in_float(boxes));
    EXPECT_EQ(
        std::memcmp(bvh.nodes.data(), before.nodes.data(), bvh.nodes.size() * sizeof(BvhNode)), 0);
    for (Bounds<double>& b : boxes) {
      const Vec3<double> by = random.point(2);
      b = {b.lower + by, b.upper + by};
    }
    refit(bvh, in_float(boxes));
    check(bvh, boxes);
    for (std::size_t i = 0; i < bvh.nodes.size(); ++i)
      EXPECT_TRUE(std::equal(bvh.nodes[i].children, bvh.nodes[i].children + bvh_width,
                             before.nodes[i].children));
    for (int i = 0; i < 300; ++i) {
      const Vec3<double> origin = random.point(15);
      const Ray<double> ray{origin, random.point(10) - origin};
      EXPECT_TRUE(includes(boxes_found(bvh, ray), boxes_met(boxes, ray)));
    }
  }
}

}  // namespace
}  // namespace minkray::testing
