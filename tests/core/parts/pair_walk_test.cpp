// SPDX-License-Identifier: MIT
// Bounds of boxes in a walk over pairs: lower bounds hold for everything in the boxes.
#include "core/parts/pair_walk.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/bvh/traverse.h"
#include "core/parts/parts_reach.h"
#include "tests/support/meshes.h"
#include "tests/support/number_of_cases.h"
#include "tests/support/random.h"

namespace minkray {
namespace {

/// A patch of points near a plane, and a box with a slab around them.
struct Patch {
  std::vector<Vec3<double>> points;
  MiddleBox box;
};

Patch random_patch(testing::Random& random) {
  Patch patch;
  const Vec3<double> middle = random.in_cube(), n = random.direction();
  const double thin = random.below(2) == 0 ? 0.01 : 1;
  Bounds<double> bounds;
  patch.box.low = std::numeric_limits<double>::infinity();
  patch.box.high = -patch.box.low;
  // The slab's normal need not have unit length.
  patch.box.normal = random.uniform(0.5, 1.5) * n;
  for (int i = 0; i < 20; ++i) {
    Vec3<double> p = 0.3 * random.in_cube();
    p -= (1 - thin) * n.dot(p) * n;
    patch.points.push_back(middle + p);
    bounds.extend(patch.points.back());
    const double height = patch.box.normal.dot(patch.points.back());
    patch.box.low = std::min(patch.box.low, height);
    patch.box.high = std::max(patch.box.high, height);
  }
  patch.box.middle = bounds.centre();
  patch.box.half = bounds.half_extents();
  return patch;
}

TEST(BoxGaps, are_lower_bounds_of_all_that_is_in_them) {
  testing::Random random(1);
  double sum = 0, of_points = 0;
  for (int i = 0; i < testing::number_of_cases(400); ++i) {
    EightBoxes boxes;
    std::vector<Patch> patches;
    for (int k = 0; k < 8; ++k) {
      patches.push_back(random_patch(random));
      boxes.set(k, patches.back().box);
    }
    const Patch other = random_patch(random);
    const Turned at{random.rotation(), 2 * random.in_cube()};
    const Vec3<double> along = random.direction();
    double reach = -std::numeric_limits<double>::infinity();
    for (const Vec3<double>& p : other.points) reach = std::max(reach, -along.dot(at.turn * p));
    const KnownDirection known{along, reach};
    double gaps[8];
    box_gaps(boxes, other.box, at, i % 2 == 0 ? &known : nullptr, gaps);
    for (std::size_t k = 0; k < 8; ++k) {
      double least = std::numeric_limits<double>::infinity();
      for (const Vec3<double>& p : patches[k].points)
        for (const Vec3<double>& q : other.points)
          least = std::min(least, (at.turn * q + at.shift - p).norm());
      ASSERT_LE(gaps[k], least + 1e-14);
      sum += std::max(0.0, gaps[k]);
      of_points += least;
    }
  }
  EXPECT_GT(sum, 0.7 * of_points);
}

TEST(BoxGaps, instruction_sets_have_the_same_bits) {
  if (!has_avx2()) GTEST_SKIP() << "no AVX2 here";
  testing::Random random(2);
  for (int i = 0; i < 500; ++i) {
    EightBoxes boxes;
    for (int k = 0; k < 8; ++k) boxes.set(k, random_patch(random).box);
    const MiddleBox other = random_patch(random).box;
    const Turned at{random.rotation(), random.in_cube()};
    const KnownDirection known{random.direction(), 0.3};
    double wide[8], narrow[8];
    box_gaps_avx2(boxes, other, at, &known, wide);
    box_gaps_sse2(boxes, other, at, &known, narrow);
    ASSERT_EQ(std::memcmp(wide, narrow, sizeof wide), 0);
  }
}

TEST(MeshSlabs, hold_the_triangles_below_them) {
  const auto mesh = testing::torus(40, 24).shared();
  const Vec3<double> middle = mesh->bounds().centre();
  const auto& nodes = mesh->bvh().nodes;
  std::size_t count = 0, children = 0;
  const auto below = [&](auto&& self, std::uint32_t what, const NodeSlabs& slabs,
                         int child) -> void {
    if ((what & BvhNode::leaf) == 0) {
      for (const std::uint32_t inner : nodes[what].children)
        if (inner != BvhNode::none) self(self, inner, slabs, child);
      return;
    }
    const MeshLeaf& leaf = mesh->leaves()[what & ~BvhNode::leaf];
    for (int i = 0; i < leaf.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const double height =
            slabs.normal(child).cast<double>().dot(mesh->corner(leaf.triangles[i], k) - middle);
        ASSERT_GE(height, double{slabs.low[child]} - 1e-15);
        ASSERT_LE(height, double{slabs.high[child]} + 1e-15);
      }
  };
  for (std::uint32_t i = 0; i < nodes.size(); ++i)
    for (int k = 0; k < bvh_width && nodes[i].children[k] != BvhNode::none; ++k) {
      ++children;
      const NodeSlabs& slabs = mesh->slabs().of(i);
      count += slabs.normal(k).isZero(0) ? 0 : 1;
      below(below, nodes[i].children[k], slabs, k);
    }
  EXPECT_GT(count, children / 2);
}

TEST(PartsReach, is_that_of_the_furthest_corner) {
  testing::Random random(3);
  const auto mesh = testing::bumpy_ball(20, 24).shared();
  for (int i = 0; i < 200; ++i) {
    const Vec3<double> n = random.direction();
    const Mat3<double> turn = random.rotation();
    double furthest = -std::numeric_limits<double>::infinity();
    for (const Vec3<double>& v : mesh->vertices()) furthest = std::max(furthest, n.dot(turn * v));
    furthest -= n.dot(turn * mesh->bounds().centre());
    const double reach = reach_along(*mesh, turn, n);
    EXPECT_GE(reach, furthest);
    EXPECT_LE(reach, furthest + 1e-14);
  }
}

}  // namespace
}  // namespace minkray
