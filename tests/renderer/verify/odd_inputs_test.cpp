// SPDX-License-Identifier: MIT
// minkray verify with inputs that no planner should write: each is an error with its place, and no
// verdict is given on something else.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "renderer/json/json.h"
#include "tests/renderer/verify/verify_folder.h"

namespace minkray {
namespace {

class OddInputs : public VerifyFolder {
 protected:
  void SetUp() override {
    std::ofstream(folder_ / "r.urdf") << R"(<robot name="r">
  <link name="base"/>
  <link name="bob"><collision><origin xyz="1 0 0"/><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="bob"/><axis xyz="0 0 1"/>
    <limit lower="-4" upper="4" effort="1" velocity="1"/></joint>
</robot>)";
    write("plan.yaml",
          "joint_names: [turn]\npoints:\n  - positions: [0]\n    time_from_start: 0\n"
          "  - positions: [3]\n    time_from_start: 2\n");
    write("scene.yaml", scene("{id: post, primitives: [{type: sphere, dimensions: [0.2]}], "
                              "primitive_poses: [{position: [0, 1.5, 0]}]}"));
  }
  static std::string scene(const std::string& object) {
    return "world:\n  collision_objects:\n    - " + object + "\n";
  }
  ProgramOutcome verify(const std::string& words) {
    return VerifyFolder::verify("--robot r.urdf " + words);
  }
  /// Verifies a plan, or a scene; returns the exit code and the errors.
  std::string with_plan(const std::string& text, const std::string& name = "odd.yaml") {
    write(name, text);
    const ProgramOutcome outcome = verify("--scene scene.yaml --trajectory " + name);
    return std::to_string(outcome.exit_code) + " " + outcome.err;
  }
  std::string with_scene(const std::string& text) {
    write("odd.yaml", text);
    const ProgramOutcome outcome = verify("--scene odd.yaml --trajectory plan.yaml");
    return std::to_string(outcome.exit_code) + " " + outcome.err;
  }
};

void expect_begin(const std::string& text, const std::string& begin) {
  EXPECT_EQ(text.substr(0, begin.size()), begin);
}

TEST_F(OddInputs, of_plans_are_errors) {
  const std::string names = "joint_names: [turn]\npoints:\n";
  expect_begin(with_plan(names + "  []\n"), "3 odd.yaml: line 3: /points: must not be empty");
  expect_begin(with_plan("joint_trajectory: {points: []}\n"),
               "3 odd.yaml: /joint_trajectory/points: must not be empty");
  expect_begin(with_plan("joint_trajectory: 3\n"),
               "3 odd.yaml: /joint_trajectory: must be an object (got 3)");
  expect_begin(with_plan(names + "  - [0]\n"), "3 odd.yaml: line 3: /points/0: must be an object");
  expect_begin(with_plan("start_state: 3\n" + names + "  - {positions: [0]}\n"),
               "3 odd.yaml: line 1: /start_state: must be an object (got 3)");
  expect_begin(with_plan("goal_constraints: [{joint_constraints: [{joint_name: turn, position: 1}, "
                         "{joint_name: turn, position: 2}]}]\n"),
               "3 odd.yaml: /goal_constraints/0/joint_constraints/1/joint_name: duplicate");
  expect_begin(with_plan("time,turn\n1,0\n0,1\n", "odd.csv"),
               "3 odd.csv: line 3: times must increase");
}

/// One row is a pose, and rows at one time are a jump whose whole way counts.
TEST_F(OddInputs, of_few_rows_and_equal_times_have_verdicts) {
  const auto row = [](double turn, double time) {
    return "  - {positions: [" + std::to_string(turn) +
           "], time_from_start: " + std::to_string(time) + "}\n";
  };
  const std::string names = "joint_names: [turn]\npoints:\n";
  const double at_post = 1.5707963;
  expect_begin(with_plan(names + row(0, 0)), "0 ");
  write("near.yaml", scene("{id: post, primitives: [{type: sphere, dimensions: [0.2]}], "
                           "primitive_poses: [{position: [0, 1.2, 0]}]}"));
  const auto near = [&](const std::string& text) {
    write("odd.yaml", text);
    return verify("--scene near.yaml --trajectory odd.yaml").exit_code;
  };
  EXPECT_EQ(near(names + row(0, 0)), 0);
  EXPECT_EQ(near(names + row(at_post, 0)), 1);
  EXPECT_EQ(near(names + row(0, 1) + row(3, 1)), 1);
}

TEST_F(OddInputs, of_scenes_are_errors) {
  expect_begin(with_scene("world: 3\n"), "3 odd.yaml: /world: must be an object (got 3)");
  expect_begin(with_scene("robot_state: 3\n"), "3 odd.yaml: /robot_state: must be an object");
  expect_begin(with_scene("allowed_collision_matrix: 3\n"),
               "3 odd.yaml: /allowed_collision_matrix: must be an object");
  expect_begin(with_scene("world: {}\nlink_padding: [{link_name: bob}]\n"),
               "3 odd.yaml: line 2: /link_padding/0/padding: missing");
  expect_begin(with_scene("world: {}\nlink_padding: [{link_name: bbo, padding: 1}]\n"),
               "0 odd.yaml: /link_padding/0/link_name: there is no link \"bbo\"");
  expect_begin(with_scene("robot_state: {joint_state: {name: [turn, turn], position: [0, 1]}}\n"),
               "3 odd.yaml: /robot_state/joint_state/name/1: duplicate");
  // The second sphere was placed at the origin.
  expect_begin(
      with_scene(scene("{id: x, primitives: [{type: sphere, dimensions: [0.2]}, {type: "
                       "sphere, dimensions: [0.1]}], primitive_poses: [{position: [0, 1.5, "
                       "0]}]}")),
      "3 odd.yaml: line 3: /world/collision_objects/0/primitive_poses: must be one for "
      "each of the 2 primitives (got 1)");
  expect_begin(with_scene(scene("{id: x, meshes: [{vertices: [[0,0,0],[1,0,0],[0,1,0]]}]}")),
               "3 odd.yaml: line 3: /world/collision_objects/0/meshes/0/triangles: must not be "
               "empty");
}

/// Shapes of an object "post" are called post/1 and post/2, and an object "post/1" was taken for
/// one of them: what may touch "post" could touch it, too.
TEST_F(OddInputs, names_of_objects_are_not_mixed_up) {
  const std::string objects =
      "{id: post/1, primitives: [{type: sphere, dimensions: [0.2]}], primitive_poses: [{position: "
      "[0, 1.2, 0]}]}\n    - {id: post, primitives: [{type: sphere, dimensions: [0.1]}, {type: "
      "sphere, dimensions: [0.1]}], primitive_poses: [{position: [0, 3, 0]}, {position: [0, 4, "
      "0]}]}";
  const auto matrix = [](const std::string& name) {
    return "allowed_collision_matrix: {entry_names: [bob, " + name +
           "], entry_values: [[false, true], [true, false]]}\n";
  };
  expect_begin(with_scene(scene(objects) + matrix("post")), "1 ");
  expect_begin(with_scene(scene(objects) + matrix("post/1")), "0 ");
  // The matrix has names only.
  const std::string base = "{id: base, primitives: [{type: sphere, dimensions: [0.2]}]}";
  expect_begin(with_scene(scene(base)), "0 ");
  expect_begin(with_scene(scene(base) + matrix("base")),
               "3 odd.yaml: object \"base\": id: must not be the name of a link");
}

/// Times that are 0, 1, 2... are times all the same.
TEST_F(OddInputs, times_of_tables_are_times) {
  write("near.yaml", scene("{id: post, primitives: [{type: sphere, dimensions: [0.2]}], "
                           "primitive_poses: [{position: [0, 1.2, 0]}]}"));
  const auto said = [&](const std::string& name, const std::string& text) {
    write(name, text);
    const std::string out = verify("--scene near.yaml --trajectory " + name).out;
    return out.substr(std::min(out.find(", at "), out.size()));
  };
  expect_begin(said("times.csv", "\"time\",turn\n0,0\n1,1.5707963\n"), ", at 0.875 s by");
  expect_begin(said("rows.csv", "turn\n0\n1.5707963\n"), ", at row 1.875 by");
  expect_begin(said("times.json", R"([{"time":0,"turn":0},{"time":1,"turn":1.5707963}])"),
               ", at 0.875 s by");
  expect_begin(said("rows.json", R"([{"turn":0},{"turn":1.5707963}])"), ", at row 1.875 by");
}

/// Such motions are free, but for what is not verified.
TEST_F(OddInputs, starts_elsewhere_and_robots_without_shapes_have_notes) {
  expect_begin(
      with_plan("trajectory_start: {joint_state: {name: [turn], position: [1]}}\n"
                "joint_trajectory: {joint_names: [turn], points: [{positions: [0]}, "
                "{positions: [1]}]}\n"),
      "0 odd.yaml: the joint \"turn\" has another value in the first row than in the start state");
  write("r.urdf", R"(<robot name="r"><link name="base"/><link name="bob"><visual><geometry>
  <sphere radius="0.1"/></geometry></visual></link><joint name="turn" type="continuous">
  <parent link="base"/><child link="bob"/></joint></robot>)");
  expect_exit(0, verify("--scene scene.yaml --trajectory plan.yaml"),
              {"r.urdf: has no shapes that can collide"});
}

/// A quaternion's length does not matter, and one of length zero turns nothing, as in MoveIt.
TEST_F(OddInputs, quaternions_of_any_length_turn) {
  const auto lower = [&](const std::string& orientation) {
    write("odd.yaml", scene("{id: rod, primitives: [{type: box, dimensions: [1, 0.1, 0.1]}], "
                            "primitive_poses: [{position: [0, 1.8, 0], orientation: " +
                            orientation + "}]}"));
    const ProgramOutcome outcome = verify("--scene odd.yaml --trajectory plan.yaml --json");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return Json::parse(outcome.out)["lower"].get<double>();
  };
  const double as_it_is = lower("[0, 0, 0, 1]"), turned = lower("[0, 0, 1, 1]");
  EXPECT_NEAR(as_it_is, 1.75 - 1.1, 0.01);
  EXPECT_NEAR(turned, 1.3 - 1.1, 0.01);
  EXPECT_NEAR(lower("{x: 0, y: 0, z: 70, w: 70}"), turned, 1e-12);
  EXPECT_NEAR(lower("[0, 0, 0, 0]"), as_it_is, 1e-12);
}

/// The angle of a pose is between -pi and pi. A base that turned on past pi was taken to go back
/// all the way round, and velocities of the arm's joints made no difference to that.
TEST_F(OddInputs, planar_joints_go_the_shorter_way_round) {
  write("r.srdf",
        R"(<robot name="r"><virtual_joint name="roam" type="planar" child_link="base"/></robot>)");
  write("ahead.yaml", scene("{id: post, primitives: [{type: sphere, dimensions: [0.2]}], "
                            "primitive_poses: [{position: [1.2, 0, 0]}]}"));
  write("odd.yaml", R"(joint_trajectory:
  joint_names: [turn]
  points: [{positions: [0], velocities: [0], time_from_start: 0},
           {positions: [0], velocities: [0], time_from_start: 1}]
multi_dof_joint_trajectory:
  joint_names: [roam]
  points:
    - {transforms: [{translation: [0, 0, 0], rotation: [0, 0, 0.99, 0.14]}], velocities: [{}]}
    - {transforms: [{translation: [0, 0, 0], rotation: [0, 0, 0.99, -0.14]}]}
)");
  expect_exit(0, verify("--srdf r.srdf --scene ahead.yaml --trajectory odd.yaml"),
              {"\"roam\" turns by more than half a turn in 1 step", "velocities are ignored"});
}

/// With a padding of NaN every motion was free.
TEST_F(OddInputs, paddings_are_lengths) {
  const std::string words = "--scene scene.yaml --trajectory plan.yaml --padding ";
  expect_exit(2, verify(words + "nan"));
  expect_exit(2, verify(words + "-1"));
  expect_exit(1, verify(words + "1e6"));
  expect_exit(3, verify(words + "0 --inflate bob=0.1 --inflate bob=0"));
  expect_exit(3, verify(words + "0 --inflate bob=nan"));
}

TEST_F(OddInputs, lines_of_garbage_have_errors_and_hide_no_other) {
  write("lines",
        "garbage\n{\"joint_names\"\n\"none.yaml\"\n\"plan.yaml\n \"plan.yaml\"\n\"\"\n\"\\u0000\"\n"
        "\".\"\nnull\n3\n[[[[\n&a [*a]\n\xff\xfe\n" +
            std::string(100'000, '[') + "\n\"plan.yaml\"");
  const ProgramOutcome outcome = verify("--scene scene.yaml --serve < lines");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  std::string status;
  for (std::string line; std::getline(lines, line);)
    status += Json::parse(line)["status"].text().substr(0, 1);
  EXPECT_EQ(status, "eeeefeeeeeeeeef");
  EXPECT_FALSE(has(outcome.out, "line 1: line 1"));
  EXPECT_TRUE(has(outcome.out, "line 4: /: not valid JSON"));
}

}  // namespace
}  // namespace minkray
