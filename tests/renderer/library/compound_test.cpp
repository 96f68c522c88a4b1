// SPDX-License-Identifier: MIT
// Compounds through the public headers, compared with their parts one by one.
#include <gtest/gtest.h>
#include <minkray/minkray.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/renderer/library/errors.h"
#include "tests/renderer/library/rays.h"
#include "tests/renderer/library/shapes.h"

namespace {

namespace mk = minkray;

class Random {
 public:
  explicit Random(unsigned seed) : random_(seed) {}
  double in(double from, double to) {
    return from + (to - from) * double(random_() >> 11) * 0x1p-53;
  }
  mk::Pose pose(double far) {
    const mk::Vec3 by = {in(-far, far), in(-far, far), in(-far, far)};
    return mk::pose(by, {in(-1, 1), in(-1, 1), in(-1, 1), in(-1, 1)});
  }

 private:
  std::mt19937_64 random_;
};

/// Every kind of shape, in a heap.
std::vector<mk::Part> heap(unsigned seed, double far = 1.5) {
  Random random(seed);
  std::vector<mk::Part> parts;
  for (const mk::Shape& shape : some_shapes()) parts.push_back({shape, random.pose(far)});
  return parts;
}

mk::Shape tetrahedron(double size) {
  return mk::mesh(std::vector<mk::Vec3>{{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}},
                  {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
}

/// A scene of compounds, and one in which each part is an object of its own.
struct TwoScenes {
  mk::Scene compounds, parts;
  std::vector<std::uint32_t> object_of, part_of;  ///< by object of `parts`

  void add(const std::vector<mk::Part>& of, const mk::Pose& pose) {
    const std::uint32_t object = compounds.add(mk::compound(of), pose);
    for (std::size_t i = 0; i < of.size(); ++i) {
      parts.add(of[i].shape, pose * of[i].pose);
      object_of.push_back(object);
      part_of.push_back(std::uint32_t(i));
    }
  }
  void add_to_both(const mk::Shape& shape, const mk::Pose& pose) {
    object_of.push_back(compounds.add(shape, pose));
    part_of.push_back(~0u);
    parts.add(shape, pose);
  }
};

TwoScenes two_scenes() {
  TwoScenes made;
  Random random(5);
  mk::Pose stretched = mk::translation({0, 4, 0});
  stretched.rows[0][0] = 1.5;
  stretched.rows[1][0] = 0.3;
  made.add(heap(1), {});
  made.add(heap(2), random.pose(3));
  made.add(heap(3), stretched);
  made.add_to_both(mk::sphere(0.7), mk::translation({-2, 1, 0}));
  made.add_to_both(tetrahedron(1), mk::translation({1, -2, 1}));
  made.compounds.commit();
  made.parts.commit();
  return made;
}

constexpr double near = 1e-11;

TEST(LibraryCompound, is_met_where_its_parts_are) {
  const TwoScenes both = two_scenes();
  std::vector<mk::Ray> rays = rays_around({0, 1, 0}, 3, 3000);
  for (std::size_t i = 0; i < 600; ++i) {  // from within some
    mk::Ray& ray = rays[5 * i];
    for (int k = 0; k < 3; ++k) ray.origin[std::size_t(k)] += 0.9 * ray.direction[std::size_t(k)];
    if (i % 3 == 0) ray.t_max = 1;
  }
  std::vector<mk::Hit> hits(rays.size()), expected(rays.size());
  both.compounds.cast(rays, hits);
  both.parts.cast(rays, expected);
  int met = 0, inside = 0, proven = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(hits[i].status, expected[i].status) << i;
    const mk::Hit one = both.compounds.cast(rays[i]);
    EXPECT_EQ(one.t, hits[i].t);
    EXPECT_EQ(one.part, hits[i].part);
    EXPECT_EQ(both.compounds.occluded(rays[i]), hits[i].found() ? mk::hit : mk::miss);
    if (i % 10 == 0) {
      const mk::Proof proof = both.compounds.prove(rays[i], hits[i]);
      EXPECT_TRUE(proof.holds) << i << ": " << proof.complaint;
      proven += proof.holds;
    }
    if (!hits[i].found()) continue;
    ++met;
    inside += hits[i].status == mk::inside;
    EXPECT_NEAR(hits[i].t, expected[i].t, near) << i;
    EXPECT_LE(hits[i].t_lo, hits[i].t);
    EXPECT_GE(hits[i].t_hi, hits[i].t);
    if (hits[i].status == mk::inside) continue;  // of several, the least number
    EXPECT_EQ(hits[i].object, both.object_of[expected[i].object]);
    EXPECT_EQ(std::uint32_t(hits[i].part), both.part_of[expected[i].object] == ~0u
                                               ? std::uint32_t(expected[i].part)
                                               : both.part_of[expected[i].object]);
    mk::Hit lie = hits[i];
    lie.t_base += 1e-3;
    if (i % 50 == 0) {
      EXPECT_FALSE(both.compounds.prove(rays[i], lie).holds);
    }
  }
  EXPECT_GT(met, 900);
  EXPECT_LT(met, 2700);
  EXPECT_GT(inside, 10);
  EXPECT_EQ(proven, 300);
}

TEST(LibraryCompound, is_left_where_its_last_part_is) {
  const std::vector<mk::Part> parts = heap(1);
  TwoScenes both;
  both.add(parts, mk::translation({1, 0, 0}));
  both.compounds.commit();
  both.parts.commit();
  const std::vector<mk::Ray> rays = rays_around({1, 0, 0}, 2, 500);
  std::size_t crossings = 0;
  for (const mk::Ray& ray : rays) {
    const mk::Hit exit = both.compounds.exit(0, ray);
    mk::Hit last;
    last.status = mk::miss;
    for (std::uint32_t i = 0; i < parts.size(); ++i)
      if (const mk::Hit one = both.parts.exit(i, ray);
          one.found() && (!last.found() || one.t > last.t))
        last = one;
    ASSERT_EQ(exit.status, last.status);
    if (last.found()) {
      EXPECT_NEAR(exit.t, last.t, near);
      EXPECT_EQ(std::uint32_t(exit.part), last.object);
      EXPECT_GE(exit.t_hi, exit.t);
    }
    const mk::AllHits all = both.compounds.all_hits(ray), of_parts = both.parts.all_hits(ray);
    const mk::View<const mk::Crossing> found = all.hits(), expected = of_parts.hits();
    ASSERT_EQ(found.size(), expected.size());
    crossings += found.size();
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i].t, expected[i].t, near);
      EXPECT_EQ(std::uint32_t(found[i].part), expected[i].object);
      EXPECT_EQ(found[i].leaves, expected[i].leaves);
    }
  }
  EXPECT_GT(crossings, 500u);
}

/// The least distance of all parts; 0 if parts overlap.
mk::Distance least_of(const std::vector<mk::Part>& parts, const mk::Pose& pose, const mk::Shape& to,
                      const mk::Pose& pose_to) {
  mk::Distance least;
  least.value = least.lower = least.upper = 1e300;
  for (const mk::Part& part : parts) {
    const mk::Distance one = mk::signed_distance(part.shape, pose * part.pose, to, pose_to);
    if (one.value < least.value) least = one;
  }
  if (least.status == mk::overlapping) least.value = least.lower = least.upper = 0;
  return least;
}

TEST(LibraryCompound, is_as_far_as_its_nearest_part) {
  Random random(11);
  const std::vector<mk::Part> parts = heap(4), others = heap(5, 0.4);
  const mk::Shape compound = mk::compound(parts), other = mk::compound(others);
  const std::vector<mk::Shape> shapes = {mk::box({0.2, 0.4, 0.3}), mk::sphere(0.3),
                                         tetrahedron(0.7), mk::point({0, 0, 0})};
  int overlapping = 0, impacts = 0, count = 0;
  for (int i = 0; i < 240; ++i) {
    const mk::Pose pose = random.pose(2), pose_other = random.pose(2.5);
    const bool is_other = i % 5 == 4;
    const mk::Shape& to = is_other ? other : shapes[std::size_t(i % 5)];
    mk::Distance expected = least_of(parts, pose, to, pose_other);
    const mk::Distance found = mk::signed_distance(compound, pose, to, pose_other);
    const mk::Distance turned = mk::signed_distance(to, pose_other, compound, pose);
    ASSERT_EQ(found.status, expected.status) << i;
    EXPECT_EQ(turned.status, found.status);
    EXPECT_NEAR(found.value, expected.value, 1e-9);
    EXPECT_NEAR(turned.value, expected.value, 1e-9);
    EXPECT_LE(found.lower, expected.upper);
    EXPECT_GE(found.upper, expected.lower);
    ++count;
    overlapping += found.status == mk::overlapping;
    if (is_other) continue;
    mk::Twist twist;
    twist.velocity = {random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)};
    if (i % 2) twist.turn = {random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)};
    const mk::Impact impact = mk::time_of_impact(compound, pose, {}, to, pose_other, twist, 3);
    double first = 1e300;
    for (const mk::Part& part : parts) {
      const mk::Impact one =
          mk::time_of_impact(part.shape, pose * part.pose, {}, to, pose_other, twist, 3);
      if (one.status == mk::impact || one.status == mk::begins_inside)
        first = std::min(first, one.t_hi);
    }
    EXPECT_EQ(impact.status == mk::no_impact, first == 1e300) << i;
    if (impact.status != mk::no_impact) {
      EXPECT_NEAR(impact.t_hi, first, 1e-8) << i;
    }
    impacts += impact.status == mk::impact;
  }
  EXPECT_GT(overlapping, count / 10);
  EXPECT_LT(overlapping, count * 9 / 10);
  EXPECT_GT(impacts, 20);
}

TEST(LibraryCompound, overlaps_a_mesh_that_holds_one_of_its_parts) {
  const mk::Shape far_and_near = mk::compound({{mk::sphere(0.1), mk::translation({30, 0, 0})},
                                               {mk::sphere(0.1), mk::translation({1, 1, 1})}});
  const mk::Distance found = mk::signed_distance(tetrahedron(9), {}, far_and_near, {});
  EXPECT_EQ(found.status, mk::overlapping);
  EXPECT_EQ(found.point_a.x, 1);
}

TEST(LibraryCompound, stands_in_scenes_beside_others) {
  // A table: two objects share it.
  std::vector<mk::Part> parts = {{mk::box({1, 0.6, 0.05}), mk::translation({0, 0, 1})}};
  for (const double x : {-0.9, 0.9})
    for (const double y : {-0.5, 0.5})
      parts.push_back({mk::cylinder(0.05, 0.475), mk::translation({x, y, 0.475})});
  const mk::Shape table = mk::compound(parts), ball = mk::sphere(0.25);
  EXPECT_STREQ(table.kind(), "compound");
  EXPECT_NEAR(table.bounds().upper.z, 1.05, 1e-12);
  mk::Scene scene;
  const std::uint32_t first = scene.add(table, {}, "table");
  const std::uint32_t under = scene.add(ball, mk::translation({0, 0, 0.5}), "ball");
  const std::uint32_t second = scene.add(table, mk::translation({5, 0, 0}), "other");
  const std::uint32_t floor = scene.add_half_space({0, 0, 1}, -0.5, "floor");
  scene.commit();
  const mk::ScenePairs pairs = scene.distances(0.6);
  ASSERT_EQ(pairs.size(), 3u);  // the ball under the table, and both tables above the floor
  EXPECT_EQ(pairs[0].object_b, under);
  EXPECT_NEAR(pairs[0].distance.value, 0.2, 1e-12);
  for (const mk::ScenePair& pair : pairs)
    if (pair.object_b == floor) {
      EXPECT_NEAR(pair.distance.value, 0.5, 1e-12);
    }
  const mk::ScenePairs near_points = scene.nearest(std::vector<mk::Vec3>{{3, 0, 1}}, 2);
  EXPECT_NEAR(near_points[0].distance.value, 1, 1e-12);
  EXPECT_EQ(near_points[0].object_b, second);
  mk::Twist down;
  down.velocity = {0, 0, -1};
  const mk::SceneImpact lands = scene.time_of_impact(ball, mk::translation({5, 0, 3}), down, 9);
  EXPECT_EQ(lands.object, second);
  EXPECT_NEAR(lands.impact.t_hi, 1.7, 1e-9);
  EXPECT_NEAR(scene.distance_to(table, mk::translation({0, 0, 2})).distance.value, 0.95, 1e-12);
  // Legs on the floor: four points.
  scene.set_pose(second, mk::translation({5, 0, -0.5}));
  scene.commit();
  const mk::Manifold stands = scene.manifold(second, floor);
  EXPECT_EQ(stands.count, 4);
  EXPECT_EQ(scene.cast({{5, 0, 9}, {0, 0, -1}}).t, 8.45);
  scene.remove(first);
  scene.commit();
  EXPECT_EQ(scene.cast({{0.9, 0.5, 9}, {0, 0, -1}}).object, floor);
  EXPECT_EQ(scene.distances(0.6).size(), 1u);
}

TEST(LibraryCompound, has_parts_and_is_refused_where_a_shape_must_be_convex) {
  const mk::Shape box = mk::box({1, 1, 1});
  const mk::Shape compound = mk::compound({{box, mk::translation({1, 2, 3})}, {mk::sphere(2)}});
  ASSERT_EQ(mk::compound_size(compound), 2u);
  EXPECT_STREQ(mk::compound_part(compound, 1).shape.kind(), "sphere");
  EXPECT_EQ(mk::compound_part(compound, 0).pose.rows[1][3], 2);
  const std::vector<mk::Part> nothing;
  EXPECT_TRUE(has(error_of([&] { mk::compound(nothing); }), "count: must be at least 1"));
  EXPECT_TRUE(has(error_of([&] { mk::compound_part(compound, 2); }), "part: must be less than 2"));
  EXPECT_TRUE(has(error_of([&] { mk::compound_size(box); }), "must be a compound"));
  EXPECT_TRUE(has(error_of([&] { mk::compound({{compound}}); }),
                  "shapes[0]: must be convex (got a compound)"));
  EXPECT_TRUE(has(error_of([&] { mk::rounded(compound, 0.1); }), "convex (got a compound)"));
  EXPECT_TRUE(has(error_of([&] { mk::mesh_info(compound); }), "must be a mesh (got a compound)"));
}

}  // namespace
