// SPDX-License-Identifier: MIT
// minkray verify far from the world's origin, and with joints that float in a frame that is not the
// world's.
#include <gtest/gtest.h>

#include <fstream>

#include "renderer/json/json.h"
#include "tests/renderer/verify/verify_folder.h"

namespace minkray {
namespace {

class FarFrames : public VerifyFolder {
 protected:
  ProgramOutcome verify(const std::string& words) {
    return VerifyFolder::verify("--robot r.urdf " + words);
  }
  double lower(const std::string& words) {
    const ProgramOutcome outcome = verify(words + " --json");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    return outcome.exit_code == 0 ? Json::parse(outcome.out)["lower"].get<double>() : -1;
  }
  /// Writes a scene of a ball of radius 0.2.
  void put_ball(const std::string& at) {
    write("scene.yaml",
          "world: {collision_objects: [{id: ball, primitives: [{type: sphere, dimensions: [0.2]}], "
          "primitive_poses: [{position: " +
              at + "}]}]}\n");
  }
};

constexpr const char* wide_limits = R"(<limit lower="-9" upper="9" effort="1" velocity="1"/>)";

/// A lift that slides along x at a height of 1, and a ball of radius 0.1 that floats 0.5 above it.
/// The ball was at the world's origin, and did not move with the lift.
TEST_F(FarFrames, floating_joints_are_in_their_parents_frame) {
  write("r.urdf", std::string(R"(<robot name="r"><link name="base"/><link name="lift"/>
  <link name="ball"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="slide" type="prismatic"><parent link="base"/><child link="lift"/>
    <origin xyz="0 0 1"/><axis xyz="1 0 0"/>)") +
                      wide_limits + R"(</joint>
  <joint name="fly" type="floating"><parent link="lift"/><child link="ball"/>
    <origin xyz="0 0 0.5"/></joint></robot>)");
  write("slide.yaml", "joint_names: [slide]\npoints: [{positions: [0]}, {positions: [1]}]\n");
  put_ball("[0, 0, 3]");
  EXPECT_NEAR(lower("--scene scene.yaml --trajectory slide.yaml"), 1.5 - 0.3, 0.02);
  put_ball("[1.6, 0, 1.5]");
  EXPECT_NEAR(lower("--scene scene.yaml --trajectory slide.yaml"), 0.3, 0.01);
  // From x = -1 to x = 1 in the frame of the lift, which is at rest.
  write("fly.yaml", R"(multi_dof_joint_trajectory:
  joint_names: [fly]
  points:
    - {transforms: [{translation: [-1, 0, 0], rotation: [0, 0, 0, 1]}], time_from_start: 0}
    - {transforms: [{translation: [1, 0, 0], rotation: [0, 0, 1, 1]}], time_from_start: 2}
)");
  put_ball("[0.3, 0.5, 1.5]");
  EXPECT_NEAR(lower("--scene scene.yaml --trajectory fly.yaml"), 0.2, 0.01);
  put_ball("[2.3, 0.5, 1.5]");
  EXPECT_NEAR(lower("--scene scene.yaml --trajectory fly.yaml --joint slide=2"), 0.2, 0.01);
}

/// A floating joint at the world's origin is a free one; with a virtual joint below it, its link
/// did not move with the robot.
TEST_F(FarFrames, of_virtual_joints_below_floating_ones_are_errors) {
  write("r.urdf", R"(<robot name="r"><link name="base"/>
  <link name="ball"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="fly" type="floating"><parent link="base"/><child link="ball"/></joint></robot>)");
  write("r.srdf",
        R"(<robot name="r"><virtual_joint name="v" type="planar" child_link="base"/></robot>)");
  write("fly.yaml", R"(multi_dof_joint_trajectory: {joint_names: [fly], points: [
  {transforms: [{translation: [-1, 0, 0]}]}, {transforms: [{translation: [1, 0, 0]}]}]})");
  put_ball("[0.3, 0.5, 0]");
  EXPECT_NEAR(lower("--scene scene.yaml --trajectory fly.yaml"), 0.2, 0.01);
  expect_exit(3, verify("--srdf r.srdf --scene scene.yaml --trajectory fly.yaml"),
              {"\"fly\" floats on the root already"});
}

/// A cart 1 km from the world's origin, with two balls that pass each other at 0.1. The checker
/// takes its rounding of 1e-12 of all distances from each gap, and refused the proof.
TEST_F(FarFrames, proofs_far_from_the_origin_hold) {
  if (python().empty()) GTEST_SKIP() << "needs NumPy";
  write("r.urdf",
        std::string(R"(<robot name="r"><link name="base"/><link name="mid"/>
  <link name="a"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <link name="b"><collision><origin xyz="0 0.3 0"/><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="x" type="prismatic"><parent link="base"/><child link="a"/><axis xyz="1 0 0"/>)") +
            wide_limits +
            R"(</joint><joint name="y" type="prismatic"><parent link="base"/><child link="mid"/>)" +
            wide_limits +
            R"(</joint><joint name="z" type="prismatic"><parent link="mid"/><child link="b"/>)" +
            wide_limits + "</joint></robot>");
  write("r.srdf",
        R"(<robot name="r"><virtual_joint name="v" type="floating" child_link="base"/></robot>)");
  for (const std::string far : {"0", "100", "1000", "500000"}) {
    write("plan.yaml",
          "joint_trajectory: {joint_names: [x], points: [{positions: [-1]}, "
          "{positions: [1]}]}\nmulti_dof_joint_trajectory: {joint_names: [v], points: "
          "[{transforms: [{translation: [" +
              far +
              ", 0, 0], rotation: [0.1, 0.2, 0.3, 0.9]}]}, {transforms: "
              "[{translation: [" +
              far + ", 1, 0], rotation: [0.1, 0.2, 0.3, 0.9]}]}]}\n");
    expect_exit(0, verify("--srdf r.srdf --trajectory plan.yaml -o proof.json"));
    EXPECT_TRUE(has(check("proof.json").out, "holds: free: ")) << far;
  }
  // A clearance below the rounding of the checker has no proof.
  write("near.yaml", "joint_names: [x]\npoints: [{positions: [-1]}, {positions: [1]}]\n");
  put_ball("[0, -0.3000000000005, 0]");
  expect_exit(0, verify("--scene scene.yaml --trajectory near.yaml --tolerance 0.1"));
  expect_exit(3, verify("--scene scene.yaml --trajectory near.yaml --tolerance 0.1 -o none.json"),
              {"proof: the minimum clearance is too small"});
}

/// The checker's bound of a turn had 4e-8 to spare, and that of a planar joint's way was the length
/// of the largest x and y: bounds above the engine's refuse what the engine proves.
TEST_F(FarFrames, proofs_of_balls_and_planar_joints_hold) {
  if (python().empty()) GTEST_SKIP() << "needs NumPy";
  put_ball("[0, 3, 0]");
  const std::string begin = R"(<robot name="r"><link name="base"/><link name="mid"/>
  <link name="end"><collision><origin xyz="0.5 0 0"/><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="a" type=")";
  const std::string middle =
      R"("><parent link="base"/><child link="mid"/><axis xyz="0 0 1"/></joint>
  <joint name="b" type=")";
  const std::string end =
      R"("><parent link="mid"/><child link="end"/><axis xyz="0 0 1"/></joint></robot>)";
  const auto checked = [&](const std::string& kinds, const std::string& rows) {
    write("r.urdf", kinds);
    write("rows.json", rows);
    expect_exit(0,
                verify("--scene scene.yaml --trajectory rows.json --tolerance 0.5 -o proof.json"));
    return has(check("proof.json").out, "holds: free");
  };
  EXPECT_TRUE(checked(begin + "continuous" + middle + "spherical" + end,
                      R"([{"a":0,"b":[1,0,0,0]},{"a":0.7,"b":[0.9,0.3,0.1,0.2]}])"));
  EXPECT_TRUE(checked(begin + "continuous" + middle + "planar" + end,
                      R"([{"a":0,"b":[1,0,0]},{"a":0.7,"b":[0,1,0.3]}])"));
  EXPECT_TRUE(checked(begin + "planar" + middle + "floating" + end,
                      R"([{"a":[1,0,0],"b/x":0.2,"b":[1,0,0,0]},
                          {"a":[0,1,0.4],"b/x":0,"b":[0.9,0.3,0.1,0.2]}])"));
}

}  // namespace
}  // namespace minkray
