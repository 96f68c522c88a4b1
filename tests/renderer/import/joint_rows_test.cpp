// SPDX-License-Identifier: MIT
// Joints' values from files: CSV and JSON.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/renderer/import/imports.h"
#include "tests/support/messages.h"
#include "tests/support/program.h"

namespace minkray {
namespace {

constexpr const char* jointed_robot = R"(<mujoco><worldbody><body>
  <joint name="turn" axis="0 0 1"/><joint name="push" type="slide" axis="1 0 0"/>
  <geom size=".1" pos="1 0 0"/>
  <body pos="0 0 1"><joint name="ball" type="ball"/><geom size=".1" pos="0 0 1"/></body>
  </body></worldbody></mujoco>)";

class JointRows : public ::testing::Test {
 protected:
  JointRows() { std::ofstream(folder_ / "r.xml") << jointed_robot; }

  Scene with(const std::string& text) {
    std::ofstream(folder_ / "rows") << text;
    ImportOptions options;
    options.joint_rows = folder_ / "rows";
    return import_scene(folder_ / "r.xml", options).scene;
  }
  std::string message(const std::string& text) {
    return message_of<BadInput>([&] { with(text); });
  }
  TemporaryFolder folder_;
};

TEST_F(JointRows, say_the_same_in_csv_and_json) {
  const Scene csv =
      with("time,turn,push,ball,ball,ball,ball\n0,0,0,1,0,0,0\n0.5,1,2,0,0,1,0\n2,-1,0,0,1,0,0\n");
  const Scene json = with(R"([{"time": 0, "turn": 0, "push": 0, "ball": [1, 0, 0, 0]},
    {"time": 0.5, "turn": 1, "push": [2], "ball": [0, 0, 1, 0]},
    {"time": 2, "turn": -1, "push": 0, "ball": [0, 1, 0, 0]}])");
  EXPECT_EQ(csv.hash, json.hash);
  ASSERT_EQ(csv.objects.size(), json.objects.size());
  for (std::size_t i = 0; i < csv.objects.size(); ++i) {
    ASSERT_TRUE(csv.objects[i].motion && json.objects[i].motion);
    for (const double time : {0.0, 0.2, 0.5, 1.0, 3.0})
      EXPECT_EQ(csv.objects[i].motion->pose_at(time), json.objects[i].motion->pose_at(time));
  }
  // Turned by 1 about z, then pushed along its own x by 2.
  const Vec3<double> at = csv.objects[0].motion->pose_at(0.5).translation;
  EXPECT_LT((at - 3 * Vec3<double>(std::cos(1), std::sin(1), 0)).norm(), 1e-12);
}

TEST_F(JointRows, one_object_is_one_row) {
  const Scene scene = with(R"({"push": 4})");
  EXPECT_LT((scene.objects[0].pose.translation - Vec3<double>(5, 0, 0)).norm(), 1e-12);
}

TEST_F(JointRows, another_last_digit_is_another_scene) {
  EXPECT_NE(with(R"({"push": 4})").hash, with(R"({"push": 4.0000000001})").hash);
  EXPECT_NE(with(R"([{"time": 0, "push": 0}, {"time": 1, "push": 4}])").hash,
            with(R"([{"time": 0, "push": 0}, {"time": 2, "push": 4}])").hash);
}

TEST_F(JointRows, mistakes_are_told_with_their_place) {
  const std::string all = message(
      R"([{"time": 1, "none": 0}, {"time": 1, "push": "far"}, 7, {"time": 2, "ball": [1, 0]}])");
  expect_parts(all, {"/0/none: no joint has this name", "/1/push: must be",
                     "/1/time: must increase", "/2: must be an object", "/3/ball: must be"});
  EXPECT_TRUE(has(message("[]"), "must have rows"));
  EXPECT_TRUE(has(message(""), "must have rows"));
  EXPECT_TRUE(has(message("push\nnan\n"), "finite"));
  EXPECT_TRUE(has(message(R"({"push": 1e999})"), "push"));
}

TEST_F(JointRows, are_as_many_as_a_model_takes) {
  // 33,000 rows of nothing for 7000 shapes were 231 million places.
  std::ofstream(folder_ / "r.xml")
      << "<mujoco><worldbody><body><composite type='particle' count='20 35 10' spacing='1'>"
         "<geom size='.1'/></composite></body></worldbody></mujoco>";
  std::string json = "[{}", csv = "time\n0\n";
  for (int i = 1; i <= 4761; ++i) {
    json += ",{}";
    csv += std::to_string(i) + "\n";
  }
  const std::string complaint =
      "must have at most 4761 rows, for a model of 21000 links, shapes or joints (got ";
  EXPECT_TRUE(has(message(json + "]"), complaint + "4762)"));
  EXPECT_TRUE(has(message(csv), "line 4763: " + complaint + "one more)"));
}

TEST_F(JointRows, a_quaternion_of_length_zero_turns_nothing) {
  const Scene scene = with(R"({"ball": [0, 0, 0, 0]})");
  EXPECT_LT((scene.objects[1].pose.translation - Vec3<double>(0, 0, 2)).norm(), 1e-15);
}

}  // namespace
}  // namespace minkray
