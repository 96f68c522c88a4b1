// SPDX-License-Identifier: MIT
// Objects that are taken out of a scene: nothing meets them, and all other numbers stay.
#include <gtest/gtest.h>
#include <minkray/minkray.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/renderer/library/errors.h"
#include "tests/renderer/library/rays.h"
#include "tests/renderer/library/shapes.h"
#include "tests/support/temporary_folder.h"

namespace {

namespace mk = minkray;

TEST(Removal, leaves_the_scene_that_never_had_the_object) {
  const std::vector<mk::Ray> rays = rays_around({0, 0, 0.5}, 3, 3000);
  for (const std::uint32_t gone :
       {0u, 2u, scene_of_shapes().size() - 1}) {  // the last is a half-space
    mk::Scene scene = scene_of_shapes();
    const std::uint32_t size = scene.size();
    std::vector<mk::Hit> before(rays.size()), hits(rays.size());
    scene.cast(rays, before);
    scene.remove(gone);
    EXPECT_THROW(scene.cast(rays, hits), mk::Error);  // not before it is committed
    scene.commit();
    scene.cast(rays, hits);
    std::vector<std::uint8_t> blocked(rays.size());
    scene.occluded(rays, blocked);
    std::vector<mk::Proof> proofs(rays.size());
    scene.prove(rays, hits, proofs);
    std::size_t met = 0, others = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EXPECT_NE(hits[i].object, gone);
      EXPECT_EQ(blocked[i] == mk::hit, hits[i].found());
      EXPECT_EQ(scene.cast(rays[i]).t, hits[i].t);
      EXPECT_TRUE(proofs[i].holds) << proofs[i].complaint;
      if (before[i].object == gone) {
        ++met;
        continue;
      }
      EXPECT_EQ(hits[i].object, before[i].object);
      EXPECT_EQ(hits[i].t, before[i].t);
      others += hits[i].found();
    }
    EXPECT_GT(met, 20u) << gone;
    EXPECT_GT(others, 200u);
    EXPECT_EQ(scene.size(), size);
    EXPECT_EQ(scene.add(mk::sphere(1)), size);  // the number is not used again
  }
}

TEST(Removal, of_what_is_removed_already_and_uses_of_it_are_errors) {
  mk::Scene scene;
  const mk::Shape ball = mk::sphere(1);
  scene.add(ball);
  scene.add(ball, mk::translation({5, 0, 0}));
  scene.remove(1);
  scene.commit();
  const auto expect = [](auto&& work) {
    EXPECT_TRUE(has(error_of(work), "must not be removed (got 1)"));
  };
  expect([&] { scene.remove(1); });
  expect([&] { scene.set_pose(1, {}); });
  expect([&] { (void)scene.pose(1); });
  expect([&] { (void)scene.name(1); });
  expect([&] { (void)scene.exit(1, {{-9, 0, 0}, {1, 0, 0}}); });
  EXPECT_THROW(scene.remove(2), mk::Error);
  // A hit at it is not proven.
  mk::Hit lie = scene.cast({{-9, 0, 0}, {1, 0, 0}});
  ASSERT_EQ(lie.object, 0u);
  lie.object = 1;
  EXPECT_FALSE(scene.prove({{-9, 0, 0}, {1, 0, 0}}, lie).holds);
  // Moving others does not bring it back.
  scene.set_pose(0, mk::translation({0, 0, 1}));
  scene.commit();
  EXPECT_EQ(scene.cast({{5, 0, 9}, {0, 0, -1}}).status, mk::miss);
  EXPECT_NEAR(scene.cast({{0, 0, 9}, {0, 0, -1}}).t, 7, 1e-12);
  scene.remove(0);
  scene.commit();
  EXPECT_EQ(scene.cast({{0, 0, 9}, {0, 0, -1}}).status, mk::miss);
}

TEST(Removal, frees_a_scene_of_a_shape_that_lies) {
  struct Liar {
    mk::Vec3 operator()(const mk::Vec3& n) const { return *lies ? mk::Vec3{9, 9, 9} : n; }
    bool* lies;
  };
  bool lies = false;
  mk::Scene scene;
  scene.add(mk::custom(Liar{&lies}));
  scene.add(mk::sphere(1), mk::translation({0, 5, 0}));
  scene.commit();
  lies = true;
  EXPECT_THROW(scene.cast({{-9, 0.3, 0.2}, {1, 0, 0}}), mk::Error);
  EXPECT_THROW(scene.cast({{-9, 5, 0}, {1, 0, 0}}), mk::Error);
  scene.remove(0);
  scene.commit();
  EXPECT_EQ(scene.cast({{-9, 5, 0}, {1, 0, 0}}).t, 8);
}

TEST(Removal, of_obstacles_and_links_leaves_a_robot_clear_of_them) {
  const mk::TemporaryFolder folder;
  const std::string file = folder.write("slide.urdf", R"(<robot name="slide">
    <link name="base"><visual><geometry><sphere radius="0.5"/></geometry></visual></link>
    <link name="ball"><visual><geometry><sphere radius="0.5"/></geometry></visual></link>
    <joint name="way" type="prismatic"><parent link="base"/><child link="ball"/>
      <axis xyz="1 0 0"/><limit lower="0" upper="9" effort="1" velocity="1"/></joint></robot>)");
  mk::Scene scene;
  const std::uint32_t near = scene.add(mk::sphere(0.25), mk::translation({5.5, 1, 0}));
  const auto robot = scene.add_file(file);
  const std::uint32_t far = scene.add(mk::sphere(0.25), mk::translation({5, 3, 0}));
  scene.commit();
  const std::vector<double> path = {5, 6};
  EXPECT_NEAR(scene.clearance(robot, path, 2).upper, 0.25, 0.01);
  scene.remove(near);
  scene.commit();
  const mk::Clearance clear = scene.clearance(robot, path, 2);
  EXPECT_NEAR(clear.upper, 2.25, 0.03);
  EXPECT_EQ(clear.object_a, robot.first() + 1);
  EXPECT_EQ(clear.object_b, far);
  scene.remove(robot.first() + 1);
  scene.commit();
  // The rest of the robot is at rest.
  EXPECT_EQ(scene.clearance(robot, path, 2).lower, std::numeric_limits<double>::infinity());
}

TEST(Removal, does_not_frame_or_light_what_is_gone) {
  const auto picture_of = [](mk::Scene& scene) {
    scene.commit();
    std::vector<double> light(3 * 16 * 16);
    const mk::Channel channel = {"rgb", light.data(), light.size()};
    scene.render({.width = 16, .height = 16, .samples = 1}, {&channel, 1});
    return light;
  };
  mk::Scene never, removed;
  never.add(mk::sphere(1));
  removed.add(mk::sphere(1));
  removed.remove(removed.add(mk::box({1, 1, 1}), mk::translation({100, 30, 5})));
  EXPECT_EQ(picture_of(never), picture_of(removed));
}

}  // namespace
