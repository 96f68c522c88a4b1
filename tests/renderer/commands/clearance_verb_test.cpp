// SPDX-License-Identifier: MIT
// minkray clearance and minkray field as their users meet them.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "renderer/io/exr.h"
#include "renderer/json/json.h"
#include "tests/support/expect_exit.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

/// A pendulum of a ball that hangs 1 from its hinge, and a post 1.5 away.
class ClearanceVerb : public ::testing::Test {
 protected:
  ClearanceVerb() {
    folder.write("pendulum.urdf", R"(<robot name="pendulum">
  <link name="post"><collision><origin xyz="1.5 0 0"/>
    <geometry><sphere radius="0.2"/></geometry></collision></link>
  <link name="arm"/>
  <link name="bob"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="swing" type="continuous"><parent link="post"/><child link="arm"/>
    <axis xyz="0 1 0"/></joint>
  <joint name="rod" type="continuous"><parent link="arm"/><child link="bob"/>
    <origin xyz="0 0 -1"/></joint>
</robot>)");
    // Angles from hanging down to straight up: at -pi/2 the bob is nearest to the post.
    folder.write("swing.csv", "time,swing\n0,0\n2,-3.141592653589793\n");
    folder.write("half.csv", "swing\n0\n-1\n");
    folder.write("pendulum.srdf", R"(<robot name="pendulum">
  <disable_collisions link1="bob" link2="post" reason="Never"/></robot>)");
    write_ball_scene(folder / "ball.json", 0.5);
  }
  ProgramOutcome clearance(const std::string& words) const {
    return run_minkray(folder, "clearance pendulum.urdf " + words);
  }
  const TemporaryFolder folder;
};

TEST_F(ClearanceVerb, names_the_pair_and_the_time_of_the_least) {
  const ProgramOutcome outcome = clearance("--path swing.csv --tolerance 1e-6");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json answer = Json::parse(outcome.out);
  // Between the ball's way and the post there is 1.5 - 1 - 0.1 - 0.2.
  EXPECT_EQ(answer["status"].text(), "clear");
  EXPECT_LE(answer["lower"].get<double>(), 0.2);
  EXPECT_GE(answer["upper"].get<double>(), 0.2 - 1e-15);
  EXPECT_NEAR(answer["lower"].get<double>(), 0.2, 1e-6);
  EXPECT_NEAR(answer["time"].get<double>(), 1, 1e-3);
  EXPECT_EQ(answer["a"].text(), "post/sphere");
  EXPECT_EQ(answer["b"].text(), "bob/sphere");
  EXPECT_NEAR(answer["point_a"][0].get<double>(), 1.3, 1e-6);
  EXPECT_NEAR(answer["point_b"][0].get<double>(), 1.1, 1e-6);
  EXPECT_NEAR(answer["normal"][0].get<double>(), -1, 1e-6);
  EXPECT_EQ(answer["pairs"].get<int>(), 1);
}

TEST_F(ClearanceVerb, what_may_touch_is_not_asked_for) {
  for (const char* words : {"--srdf pendulum.srdf", "--allow post,bob", "--only-obstacles"}) {
    const ProgramOutcome outcome = clearance(std::string("--path swing.csv ") + words);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(Json::parse(outcome.out)["pairs"].get<int>(), 0) << words;
  }
}

TEST_F(ClearanceVerb, obstacles_are_scenes_and_a_collision_is_told_with_its_depth) {
  const ProgramOutcome outcome =
      clearance("--path swing.csv --obstacle ball.json --tolerance 1e-6");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json answer = Json::parse(outcome.out);
  // The ball around the hinge has a radius of 0.5: 1 - 0.1 - 0.5 all the time; the post is nearer.
  EXPECT_NEAR(answer["upper"].get<double>(), 0.2, 1e-6);
  write_ball_scene(folder / "ball.json", 0.95);
  const Json collision =
      Json::parse(clearance("--path swing.csv --obstacle ball.json --tolerance 1e-6").out);
  EXPECT_EQ(collision["status"].text(), "collides");
  EXPECT_NEAR(collision["lower"].get<double>(), -0.05, 1e-6);
  EXPECT_EQ(collision["b"].text(), "ball");
}

TEST_F(ClearanceVerb, without_a_path_it_is_that_of_one_pose) {
  // The bob hangs down: the post's middle is sqrt(1.5^2 + 1^2) away.
  for (const auto& [words, distance] : std::vector<std::pair<std::string, double>>{
           {"", std::hypot(1.5, 1) - 0.3}, {"--joint swing=-1.5707963267948966", 0.2}}) {
    const ProgramOutcome outcome = clearance(words + " --tolerance 1e-6");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json answer = Json::parse(outcome.out);
    EXPECT_NEAR(answer["lower"].get<double>(), distance, 1e-6);
    EXPECT_NEAR(answer["upper"].get<double>(), distance, 1e-6);
    EXPECT_EQ(answer["time"].get<double>(), 0);
    EXPECT_EQ(answer["steps"].get<int>(), 1);
  }
  expect_exit(1, clearance("--joint swing=-1.5707963267948966 --at-least 0.21"));
}

/// Previously "clear", with infinite bounds.
TEST_F(ClearanceVerb, obstacles_may_follow_the_robot) {
  const ProgramOutcome named = clearance("--path swing.csv --obstacle ball.json");
  ASSERT_EQ(named.exit_code, 0) << named.err;
  const ProgramOutcome bare = clearance("ball.json --path swing.csv");
  EXPECT_EQ(bare.out, named.out) << bare.err;
  EXPECT_NE(clearance("--path swing.csv").out, named.out);
}

TEST_F(ClearanceVerb, particles_are_obstacles) {
  std::ofstream(folder / "grains.json") << R"({"version": 1, "lights": [],
    "camera": {"position": [0, -9, 1], "look_at": [0, 0, 0]},
    "materials": [{"name": "m", "type": "lambert", "color": [1, 1, 1]}], "objects": [],
    "particles": [{"name": "grains", "shape": {"type": "sphere", "radius": 0.3}, "material": "m",
                   "columns": ["position"], "count": 2, "poses": [[9, 0, 0], [-1, 0, 0]]}]})";
  std::ofstream(folder / "other.csv") << "swing\n0\n3\n";
  const Json answer =
      Json::parse(clearance("--path other.csv --obstacle grains.json --only-obstacles").out);
  EXPECT_EQ(answer["status"].text(), "collides");
  EXPECT_EQ(answer["b"].text(), "grains[1]");
  EXPECT_NEAR(answer["upper"].get<double>(), -0.4, 0.01);
  EXPECT_EQ(answer["pairs"].get<int>(), 2);
}

TEST_F(ClearanceVerb, fails_where_less_is_proven_than_is_asked_for) {
  expect_exit(0, clearance("--path swing.csv --at-least 0.19"));
  expect_exit(1, clearance("--path swing.csv --at-least 0.21"), {"not proven to be at least 0.21"});
  // Half the way it does not come so near.
  expect_exit(0, clearance("--path half.csv --at-least 0.21"));
}

TEST_F(ClearanceVerb, of_nothing_is_said_and_proves_nothing) {
  const std::string bare = R"(<robot name="bare"><link name="base"/><link name="tip"/>
    <joint name="turn" type="continuous"><parent link="base"/><child link="tip"/></joint></robot>)";
  folder.write("bare.urdf", bare);
  expect_exit(0, run_minkray(folder, "clearance bare.urdf --obstacle ball.json"),
              {"warning: bare.urdf: the robot has no shapes of the chosen --geometry"});
  expect_exit(1, run_minkray(folder, "clearance bare.urdf --obstacle ball.json --at-least 0.1"),
              {"no pair of bodies was checked: --at-least is not proven"});
  expect_exit(0, run_minkray(folder, "distance bare.urdf ball.json"),
              {"warning: bare.urdf: the robot has no shapes"});
}

TEST_F(ClearanceVerb, every_step_has_a_row_and_the_sweep_is_a_scene_that_renders) {
  const ProgramOutcome outcome = clearance("--path swing.csv --steps steps.csv --sweep sweep.json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string steps = text_of_file(folder / "steps.csv");
  EXPECT_TRUE(steps.starts_with("begin,end,lower,upper,time,a,b,status\n0,2,0.1")) << steps;
  EXPECT_EQ(std::ranges::count(steps, '\n'), 2);
  expect_exit(0, run_minkray(folder, "render sweep.json -o sweep.png -r 32x24 -q"));
}

TEST_F(ClearanceVerb, what_is_wrong_is_told) {
  std::ofstream(folder / "wrong.csv") << "swinging\n0\n";
  std::ofstream(folder / "wrong.srdf")
      << R"(<robot><disable_collisions link1="bob" link2="absent"/></robot>)";
  expect_exit(3, clearance("--path wrong.csv"),
              {"--path: wrong.csv: line 1: column \"swinging\": no joint has this name"});
  expect_exit(3, clearance("--path swing.csv --srdf wrong.srdf"),
              {"link2: there is no link \"absent\""});
  // The way between the rows is infinite, and became 2^63 parts of a sweep.
  std::ofstream(folder / "far.csv") << "swing\n-1e308\n1e308\n";
  expect_exit(3, clearance("--path far.csv --sweep sweep.json"),
              {"path: row 2 of 2: the joint \"swing\" must not change by more"});
  expect_exit(3, clearance("--path swing.csv --allow bob"));
  expect_exit(2, clearance("--path swing.csv --at-least much"));
  expect_exit(3, clearance("--joint nothing=1"));
  expect_exit(3, run_minkray(folder, "clearance ball.json --path swing.csv"),
              {"must be a robot's file"});
}

TEST(FieldVerb, the_numbers_are_the_distances_from_a_ball) {
  const TemporaryFolder folder;
  write_ball_scene(folder / "ball.json", 0.75);
  std::ofstream(folder / "probe.json") << R"({"type": "sphere", "radius": 0.25})";
  for (const bool has_probe : {false, true}) {
    const ProgramOutcome outcome = run_minkray(
        folder, std::string("field ball.json -o field.exr -o field.png -r 40x30 --extent 4 ") +
                    "--through 0,0,0.5" + (has_probe ? " --probe probe.json" : ""));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(outcome.out.starts_with("least distance -")) << outcome.out;
    const ExrImage image = read_exr(folder / "field.exr");
    ASSERT_EQ(image.window.width(), 40);
    ASSERT_EQ(image.window.height(), 30);
    const double radius = has_probe ? 1 : 0.75;
    const auto plane = [&](const char* name) {
      return std::get<std::vector<float>>(image.find(name)->values);
    };
    const std::vector<float> value = plane("R"), lower = plane("G"), upper = plane("B");
    for (int y = 0; y < 30; ++y)
      for (int x = 0; x < 40; ++x) {
        // Seen from above, x to the right and y up.
        const double px = (x + 0.5 - 20) * 0.1, py = -(y + 0.5 - 15) * 0.1;
        const double exact = std::sqrt(px * px + py * py + 0.25) - radius;
        const auto i = static_cast<std::size_t>(y * 40 + x);
        ASSERT_NEAR(value[i], exact, 1e-6) << x << ", " << y;
        ASSERT_LE(lower[i], exact + 1e-7);
        ASSERT_GE(upper[i], exact - 1e-7);
      }
  }
}

TEST(FieldVerb, what_is_wrong_is_told) {
  const TemporaryFolder folder;
  write_ball_scene(folder / "ball.json");
  const auto field = [&](const std::string& words) {
    return run_minkray(folder, "field ball.json -o f.png " + words);
  };
  for (const char* words : {"--normal 0,0,0", "--normal 1,2", "-r 40", "--tolerance nan"})
    expect_exit(2, field(words));
  expect_exit(3, field("--probe nothing.json"));
}

}  // namespace
}  // namespace minkray
