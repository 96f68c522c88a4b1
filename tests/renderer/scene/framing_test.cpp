// SPDX-License-Identifier: MIT
// The camera of a robot's scene: every body is within the picture's margin, and one touches it.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/world/half_space.h"
#include "renderer/rays/camera.h"
#include "renderer/scene/framing.h"
#include "tests/renderer/import/imports.h"
#include "tests/support/program.h"
#include "tests/support/random.h"
#include "tests/support/robot_models.h"

namespace minkray {
namespace {

/// The skin around all bodies, as it is seen at most.
constexpr double most_skin = 0.02;

/// The least distance of bodies from an edge, as a fraction of the picture's width or height, seen
/// at support points of all objects.
struct Free {
  double least = 1;

  void look(const Scene& scene, const Resolution& picture, double time) {
    const Camera camera(scene.camera, picture);
    testing::Random random(7);
    for (const Object& object : scene.objects) {
      const bool is_plane = object.mesh && object.mesh->sides() == MeshSides::front;
      if (object.half_space || is_plane) continue;
      const Affine<double> pose = object.motion ? object.motion->pose_at(time) : object.pose;
      for (int i = 0; i < 300; ++i) {
        const Vec3<double> n = pose.linear.transpose() * random.direction();
        const Vec3<double> point = pose(
            object.mesh ? *std::ranges::max_element(object.mesh->vertices(), {},
                                                    [&](const Vec3<double>& v) { return n.dot(v); })
                        : object.shape.support(n));
        const auto seen = camera.project(point);
        if (!seen) {
          least = -1;
          return;
        }
        const double x = seen->x() / picture.width, y = seen->y() / picture.height;
        least = std::min({least, x, 1 - x, y, 1 - y});
      }
    }
  }
};

constexpr Resolution pictures[] = {{960, 720}, {200, 400}, {400, 200}, {30, 3000}};

TEST(Framing, all_of_every_robot_is_in_the_picture_and_fills_it) {
  if (!has_robot_models()) GTEST_SKIP() << "run scenes/fetch-models";
  ImportOptions options = without_meshes();
  options.package_dirs = {(robot_models() / "dart/urdf/wam").string(),
                          (robot_models() / "simbody/TaskSpaceControl-Atlas/geometry").string()};
  int robots = 0;
  for (const char* name :
       {"mujoco/humanoid/humanoid.xml", "mujoco/humanoid/22_humanoids.xml", "mujoco/mug/mug.xml",
        "mujoco/composite/particle.xml", "dart/mjcf/openai/reacher.xml",
        "dart/urdf/drchubo/drchubo.urdf", "dart/urdf/wam/wam.urdf",
        "dart/urdf/KR5/KR5 sixx R650.urdf", "dart/sdf/atlas/atlas_v3_no_head.sdf",
        "simbody/TaskSpaceControl-Atlas/models/atlas_v4.urdf"}) {
    for (const Resolution& picture : pictures) {
      options.picture = picture;
      const Scene scene = import_scene(robot_models() / name, options).scene;
      EXPECT_EQ(scene.camera.resolution.width, picture.width);
      Free free;
      free.look(scene, picture, 0);
      EXPECT_GE(free.least, framing_margin) << name << " " << picture.width;
      EXPECT_LE(free.least, framing_margin + most_skin) << name << " " << picture.width;
      ++robots;
    }
  }
  EXPECT_EQ(robots, 40);
}

class SmallRobot : public ::testing::Test {
 protected:
  Scene scene_of_text(const std::string& world, ImportOptions options = {}) {
    std::ofstream(folder_ / "r.xml") << "<mujoco><worldbody>" << world << "</worldbody></mujoco>";
    return import_scene(folder_ / "r.xml", options).scene;
  }
  TemporaryFolder folder_;
};

TEST_F(SmallRobot, of_any_size_and_place_is_framed) {
  for (const char* world :
       {"<geom size='1'/>", "<geom size='1e-9' pos='3 4 5'/>", "<geom size='1e12'/>",
        "<geom type='capsule' size='1e-6' fromto='0 0 0 2.1 -1.7 0.9'/>",  // in the line of sight
        "<geom type='box' size='100 .01 .01'/><geom size='.1' pos='0 0 5'/>"}) {
    for (const Resolution& picture : pictures) {
      ImportOptions options;
      options.picture = picture;
      Free free;
      free.look(scene_of_text(world, options), picture, 0);
      EXPECT_GE(free.least, framing_margin) << world;
    }
  }
}

TEST_F(SmallRobot, without_any_body_has_a_camera_all_the_same) {
  const Scene scene = scene_of_text("<geom type='plane' size='1 1 1'/>");
  EXPECT_TRUE(scene.camera.position.allFinite());
  EXPECT_GT((scene.camera.position - scene.camera.look_at).norm(), 0.1);
  EXPECT_GT(scene.camera.position.z(), 0);
}

TEST_F(SmallRobot, is_not_looked_at_from_within_a_wall_nor_in_the_dark) {
  const std::string box = "<geom type='box' size='.3 .3 .2' pos='0 0 .4'/>";
  const std::string floor = "<geom type='plane' size='0 0 1'/>";
  const std::string walls =
      "<geom type='plane' size='0 0 1' zaxis='1 0 0' pos='-.5 0 0'/>"
      "<geom type='plane' size='0 0 1' zaxis='-1 0 0' pos='.5 0 0'/>"
      "<geom type='plane' size='0 0 1' zaxis='0 1 0' pos='0 -.5 0'/>"
      "<geom type='plane' size='0 0 1' zaxis='0 -1 0' pos='0 .5 0'/>";
  const std::string front_wall = "<geom type='plane' size='0 0 1' zaxis='-1 0 0' pos='.5 0 0'/>";
  const std::string ceiling = "<geom type='plane' size='0 0 1' zaxis='0 0 -1' pos='0 0 .7'/>";
  const std::string back_wall = "<geom type='plane' size='0 0 1' zaxis='1 0 0' pos='-.5 0 0'/>";
  for (const std::string& planes :
       {floor, floor + back_wall, floor + walls, floor + front_wall, ceiling}) {
    const Scene scene = scene_of_text(planes + box);
    int half_spaces = 0;
    for (const Object& object : scene.objects) {
      if (!object.half_space) continue;
      ++half_spaces;
      const HalfSpaceBody<double> placed = object.half_space->posed(object.pose);
      EXPECT_GT(placed.normal.dot(scene.camera.position), placed.offset) << planes;
    }
    EXPECT_GT(half_spaces, 0);
    // A lamp replaces the sun where it does not shine.
    EXPECT_EQ(std::holds_alternative<DirectionalLight>(scene.lights[0]),
              planes == floor || planes == floor + back_wall);
    Free free;
    free.look(scene, scene.camera.resolution, 0);
    EXPECT_GE(free.least, framing_margin) << planes;
  }
}

TEST_F(SmallRobot, that_moves_is_in_the_picture_all_the_time) {
  std::ofstream(folder_ / "joints.csv") << "time,j\n0,0\n1,2.5\n";
  ImportOptions options;
  options.joint_rows = folder_ / "joints.csv";
  const Scene scene = scene_of_text(
      "<body><joint name='j' axis='0 1 0'/><geom type='capsule' size='.05' fromto='0 0 0 1 0 0'/>"
      "</body>",
      options);
  Free free;
  for (int i = 0; i <= 100; ++i) free.look(scene, scene.camera.resolution, i * 0.01);
  EXPECT_GE(free.least, framing_margin);
}

}  // namespace
}  // namespace minkray
