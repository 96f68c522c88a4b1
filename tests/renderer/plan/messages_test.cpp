// SPDX-License-Identifier: MIT
// Reads the output of planners: trajectories, planning scenes, SRDF.
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "renderer/base/errors.h"
#include "renderer/plan/document.h"
#include "renderer/plan/robot_meaning.h"
#include "renderer/plan/trajectory.h"
#include "renderer/plan/workcell.h"
#include "tests/renderer/import/imports.h"
#include "tests/support/messages.h"

namespace minkray {
namespace {

const std::string robot = R"(<robot name="r">
  <link name="base"/><link name="arm"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <link name="left"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
  <link name="right"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
  <joint name="turn" type="continuous"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/></joint>
  <joint name="open" type="prismatic"><parent link="arm"/><child link="left"/><origin xyz="1 0 0"/>
    <axis xyz="0 1 0"/><limit lower="0" upper="1" effort="1" velocity="1"/></joint>
  <joint name="also" type="prismatic"><parent link="arm"/><child link="right"/><origin xyz="1 0 0"/>
    <axis xyz="0 -1 0"/><limit lower="0" upper="1" effort="1" velocity="1"/><mimic joint="open" multiplier="2" offset="0.1"/></joint>
</robot>)";

Model robot_model() {
  return model_of(robot, "r.urdf");
}

Trajectory trajectory_of(const std::string& text, const Model& model) {
  Mistakes mistakes("plan.yaml");
  const auto document = parse_document(text, "plan.yaml", mistakes);
  EXPECT_TRUE(document) << mistakes.text();
  if (!document) return {};
  Trajectory read = read_trajectory(*document, model, mistakes);
  EXPECT_TRUE(mistakes.none()) << mistakes.text();
  return read;
}

std::string mistakes_of_plan(const std::string& text) {
  Mistakes mistakes("plan.yaml");
  if (const auto document = parse_document(text, "plan.yaml", mistakes))
    read_trajectory(*document, robot_model(), mistakes);
  return mistakes.text();
}

TEST(Trajectories, times_are_read_in_all_of_their_forms) {
  const auto plan = [](const std::string& time) {
    return "joint_trajectory:\n  header: {frame_id: base}\n  joint_names: [turn, open]\n  points:\n"
           "    - {positions: [0, 0.5], time_from_start: 0}\n"
           "    - positions: [1, 0.25]\n      velocities: [0.5, 0]\n      time_from_start: " +
           time + "\n";
  };
  for (const char* time :
       {"{secs: 2, nsecs: 500000000}", "{sec: 2, nanosec: 500000000}", "2.5", "2.5e0"}) {
    const Trajectory read = trajectory_of(plan(time), robot_model());
    ASSERT_EQ(read.rows.size(), 2u) << time;
    EXPECT_NEAR(read.rows[1].time, 2.5, 1e-15) << time;
    EXPECT_EQ(read.rows[1].values[0].first, "turn");
    EXPECT_EQ(read.rows[1].values[0].second[0], 1);
    ASSERT_EQ(read.rates.size(), 2u);
    EXPECT_TRUE(read.rates[0].empty());
    EXPECT_EQ(read.rates[1][0].second[0], 0.5);
    EXPECT_TRUE(read.has_times);
  }
}

TEST(Trajectories, json_and_yaml_say_the_same) {
  const std::string json = R"({"joint_names": ["turn"], "points": [
    {"positions": [0], "time_from_start": {"sec": 0, "nanosec": 0}},
    {"positions": [2], "time_from_start": {"sec": 1, "nanosec": 0}}]})";
  const Trajectory read = trajectory_of(json, robot_model());
  ASSERT_EQ(read.rows.size(), 2u);
  EXPECT_EQ(read.rows[1].time, 1);
  EXPECT_EQ(read.rows[1].values[0].second[0], 2);
}

TEST(Trajectories, wrappers_of_plans_are_opened) {
  const std::string point = "{joint_names: [turn], points: [{positions: [0]}, {positions: [1]}]}";
  for (const std::string& text :
       {"solution: {joint_trajectory: " + point + "}",
        "trajectory: [{joint_trajectory: " + point + "}]",
        "motion_plan_response: {trajectory: {joint_trajectory: " + point + "}}", point,
        "---\njoint_trajectory: " + point + "\n---\n"}) {
    const Trajectory read = trajectory_of(text, robot_model());
    EXPECT_EQ(read.rows.size(), 2u) << text;
    EXPECT_FALSE(read.has_times);
  }
}

TEST(Trajectories, a_request_goes_straight_from_its_start_to_its_goal) {
  const Trajectory read = trajectory_of(
      "start_state:\n  joint_state: {name: [turn, open], position: [0.5, 0.25]}\n"
      "goal_constraints:\n  - joint_constraints:\n      - {joint_name: turn, position: 1.5}\n",
      robot_model());
  ASSERT_EQ(read.rows.size(), 2u);
  EXPECT_EQ(read.rows[0].values[0].second[0], 0.5);
  EXPECT_EQ(read.rows[1].values[0].second[0], 1.5);
  Model model = robot_model();
  Trajectory copy = read;
  const JointPath path = path_of(copy, model, {});
  // Joints that are not in the goal stay where they start.
  EXPECT_EQ(path.values[1][1][0], 0.25);
}

TEST(Trajectories, mistakes_have_their_line_and_key) {
  expect_messages(
      mistakes_of_plan,
      {{"joint_trajectory:\n  joint_names: [turn, lift]\n  points:\n    - positions: [0, 1]\n",
        "plan.yaml: line 2: /joint_trajectory/joint_names/1: there is no joint \"lift\""},
       {"joint_names: [turn, open]\npoints:\n  - positions: [0, 1]\n  - positions: [0]\n",
        "plan.yaml: line 4: /points/1/positions: must have a number for each of the 2 joints "
        "(got 1)"},
       {"joint_names: [turn]\npoints:\n  - positions: [.nan]\n",
        "plan.yaml: line 3: /points/0/positions/0: "},
       {"joint_names: [turn]\npoints:\n  - {positions: [0], time_from_start: 2}\n"
        "  - {positions: [0], time_from_start: 1}\n",
        "times must increase"},
       {"joint_names: [turn\npoints: 3\n", "not valid YAML"},
       {"points: 1\npoints: 2\n", "line 2: duplicate key \"points\""},
       {"hello: world\n", "must be a trajectory"}});
}

/// "velocites" read as no velocities, and a cubic as a straight line.
TEST(Trajectories, misspelt_keys_are_mistakes_and_unknown_ones_are_not) {
  const std::string begin = "joint_names: [turn]\npoints:\n";
  expect_messages(
      mistakes_of_plan,
      {{begin + "  - postions: [0]\n",
        "plan.yaml: line 3: /points/0/postions: unknown key (did you mean \"positions\"?)"},
       {begin + "  - positions: [0]\n    velocites: [1]\n",
        "plan.yaml: line 4: /points/0/velocites: unknown key (did you mean \"velocities\"?)"},
       {"joint_trajctory: {joint_names: [turn], points: []}\n",
        "did you mean \"joint_trajectory\"?"},
       {R"({"start_sate": {}, "joint_trajectory": {"joint_names": ["turn"],
      "points": [{"positions": [0]}]}})",
        "line 1: /start_sate: unknown key"}});
  EXPECT_EQ(mistakes_of_plan(begin + "  - {positions: [0], effort: [], jerk_limit: 3}\n"
                                     "vendor: {name: x}\n"),
            "");
}

TEST(Trajectories, velocities_without_times_are_noted) {
  const Trajectory read = trajectory_of(
      "joint_names: [turn]\npoints: [{positions: [0], velocities: [1]}, {positions: [1]}]\n",
      robot_model());
  ASSERT_EQ(read.notes.size(), 1u);
  EXPECT_TRUE(has(read.notes[0], "velocities are ignored"));
}

TEST(Trajectories, hostile_yaml_is_refused) {
  std::string laughs = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    laughs += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int k = 0; k < 10; ++k) laughs += before + (k < 9 ? ", " : "]\n");
  }
  EXPECT_NE(mistakes_of_plan(laughs), "");
  EXPECT_NE(mistakes_of_plan(std::string(100'000, '[')), "");
}

TEST(Trajectories, mimics_follow_in_place_and_rate) {
  Model model = robot_model();
  Trajectory read = trajectory_of(
      "joint_names: [open]\npoints:\n"
      "  - {positions: [0], velocities: [0.5], time_from_start: 0}\n"
      "  - {positions: [1], velocities: [0], time_from_start: 1}\n",
      model);
  const JointPath path = path_of(read, model, {});
  // In the order of links: turn, open, also (or as the model has them).
  std::size_t at = 0, found = 0;
  for (const ModelLink& link : path.skeleton.links)
    for (const ModelJoint& joint : link.joints) {
      if (joint.name == "also") {
        EXPECT_NEAR(path.values[1][at][0], 2.1, 1e-15);
        EXPECT_NEAR(path.rates[0][at][0], 1, 1e-15);
        ++found;
      }
      ++at;
    }
  EXPECT_EQ(found, 1u);
}

TEST(Trajectories, continuous_joints_go_the_shorter_way_round) {
  Model model = robot_model();
  Trajectory read =
      trajectory_of("joint_names: [turn]\npoints: [{positions: [3]}, {positions: [-3]}]\n", model);
  const JointPath path = path_of(read, model, {});
  EXPECT_NEAR(path.values[1][0][0], -3 + 2 * std::numbers::pi, 1e-15);
  ASSERT_EQ(read.notes.size(), 1u);
  EXPECT_TRUE(has(read.notes[0], "shorter way"));
}

PlanningScene scene_of_text(const std::string& text, const Model& model, Mistakes& mistakes) {
  const auto document = parse_document(text, "scene.yaml", mistakes);
  EXPECT_TRUE(document) << mistakes.text();
  PlanningScene scene;
  if (!document) return scene;
  with_lines(*document, mistakes, [&](Mistakes& found) {
    JsonPath path;
    const Json* json = scene_in(document->json, path);
    ASSERT_TRUE(json);
    scene = read_planning_scene(*document, *json, path, model, {}, found);
  });
  return scene;
}

const std::string scene_text = R"(name: shelf
robot_state:
  joint_state: {name: [turn], position: [1.5707963267948966]}
  attached_collision_objects:
    - link_name: left
      touch_links: [right]
      object:
        id: tool
        primitives: [{type: 4, dimensions: [0.4, 0.1]}]
        primitive_poses: [{position: {x: 0, y: 0, z: 0.2}, orientation: {x: 0, y: 0, z: 0, w: 1}}]
allowed_collision_matrix:
  entry_names: [arm, left, can]
  entry_values:
    - {enabled: [false, true, false]}
    - {enabled: [true, false, true]}
    - {enabled: [false, true, false]}
world:
  collision_objects:
    - id: can
      header: {frame_id: base}
      primitives: [{type: cylinder, dimensions: [0.2, 0.04]}, {type: 1, dimensions: [0.1, 0.2, 0.3]}]
      primitive_poses:
        - {position: [1, 2, 3], orientation: [0, 0, 0, 1]}
        - {position: [0, 0, 0], orientation: [0, 0, 0, 1]}
      pose: {position: [0, 0, 1], orientation: [0, 0, 0.7071067811865476, 0.7071067811865476]}
    - id: sign
      header: {frame_id: arm}
      primitives: [{type: 2, dimensions: [0.3]}]
      primitive_poses: [{position: {x: 1, y: 0, z: 0}}]
    - id: floor
      planes: [{coef: [0, 0, 2, 1]}]
    - id: wedge
      meshes:
        - triangles: [{vertex_indices: [0, 1, 2]}, {vertex_indices: [0, 1, 3]}]
          vertices: [{x: 0, y: 0, z: 0}, {x: 1, y: 0, z: 0}, {x: 0, y: 1, z: 0}, {x: 0, y: 0, z: 1}]
      mesh_poses: [{position: {x: 5, y: 0, z: 0}, orientation: {x: 0, y: 0, z: 0, w: 1}}]
)";

TEST(PlanningScenes, objects_stand_where_their_frames_and_poses_say) {
  Model model = robot_model();
  Mistakes mistakes("scene.yaml");
  const PlanningScene scene = scene_of_text(scene_text, model, mistakes);
  add_to_model(scene, model, mistakes);
  ASSERT_TRUE(mistakes.none()) << mistakes.text();
  const Workcell cell = workcell_of(model, {}, &scene, {}, {});
  const auto body = [&](const std::string& name) -> const ClearanceBody& {
    for (const ClearanceBody& one : cell.bodies)
      if (one.name == name) return one;
    throw std::logic_error("no body " + name);
  };
  // Turned by a quarter about z, and lifted by 1.
  EXPECT_TRUE(body("can/1").middle.at.rounded().isApprox(Vec3<double>(-2, 1, 4), 1e-12));
  EXPECT_EQ(body("can/1").shape.core().kind, CoreKind::disks);
  EXPECT_NEAR(body("can/1").shape.core().size.z(), 0.1, 1e-15);
  EXPECT_NEAR(body("can/1").shape.core().size.x(), 0.04, 1e-15);
  // The arm has turned by a quarter when the scene was made.
  EXPECT_TRUE(body("sign").middle.at.rounded().isApprox(Vec3<double>(0, 1, 0), 1e-12));
  // 2 z + 1 = 0, and the robot is above it.
  ASSERT_TRUE(body("floor").plane);
  EXPECT_TRUE(body("floor").plane->normal.isApprox(Vec3<double>::UnitZ(), 1e-12));
  EXPECT_NEAR(body("floor").plane->point.rounded().z(), -0.5, 1e-12);
  EXPECT_TRUE(body("wedge").mesh);
  EXPECT_EQ(body("tool").link, "tool");
}

TEST(PlanningScenes, the_matrix_says_which_pairs_may_touch) {
  Model model = robot_model();
  Mistakes mistakes("scene.yaml");
  const PlanningScene scene = scene_of_text(scene_text, model, mistakes);
  add_to_model(scene, model, mistakes);
  WorkcellOptions options;
  options.padding = 0.01;
  const Workcell cell = workcell_of(model, {}, &scene, {}, options);
  std::map<std::string, double> pairs;
  for (const RefereePair& pair : cell.pairs)
    pairs[cell.owners[pair.a] + " " + cell.owners[pair.b]] = pair.margin;
  EXPECT_TRUE(pairs.contains("arm can"));
  EXPECT_EQ(pairs["arm can"], 0.01);
  EXPECT_FALSE(pairs.contains("left can"));  // allowed by the matrix
  EXPECT_TRUE(pairs.contains("right can"));
  EXPECT_FALSE(pairs.contains("arm left"));    // a joint connects them
  EXPECT_FALSE(pairs.contains("right tool"));  // touch_links
  EXPECT_TRUE(pairs.contains("arm tool"));     // a carried object is no part of its link
  EXPECT_EQ(pairs["arm tool"], 0);             // padding is for obstacles
  EXPECT_TRUE(pairs.contains("tool can") || pairs.contains("can tool"));
}

TEST(PlanningScenes, what_is_carried_may_be_given_in_any_frame) {
  Model model = robot_model();
  Mistakes mistakes("scene.yaml");
  // The arm has turned by a quarter: its frame's x is the world's y.
  const PlanningScene scene = scene_of_text(R"(robot_state:
  joint_state: {name: [turn], position: [1.5707963267948966]}
  attached_collision_objects:
    - link_name: arm
      object:
        id: tool
        header: {frame_id: world}
        primitives: [{type: sphere, dimensions: [0.1]}]
        primitive_poses: [{position: {x: 0, y: 2, z: 0}}]
)",
                                            model, mistakes);
  add_to_model(scene, model, mistakes);
  ASSERT_TRUE(mistakes.none()) << mistakes.text();
  EXPECT_TRUE(model.geoms.back().pose.translation.isApprox(Vec3<double>(2, 0, 0), 1e-12));
}

TEST(PlanningScenes, what_is_wrong_is_told_with_its_line) {
  const auto wrong = [](const std::string& text) {
    Model model = robot_model();
    Mistakes mistakes("scene.yaml");
    const PlanningScene scene = scene_of_text(text, model, mistakes);
    if (mistakes.none()) add_to_model(scene, model, mistakes);
    return mistakes.text();
  };
  const std::string world = "world:\n  collision_objects:\n    - id: x\n      primitives:\n";
  const std::string ball = "primitives: [{type: sphere, dimensions: [1]}]";
  expect_messages(
      wrong, {{world + "        - {type: bxo, dimensions: [1, 1, 1]}\n",
               "scene.yaml: line 5: /world/collision_objects/0/primitives/0/type: must be box (1)"},
              {world + "        - {type: box, dimensions: [1, 1]}\n",
               "line 5: /world/collision_objects/0/primitives/0/dimensions: "},
              {"world: {collision_objects: [{id: x, header: {frame_id: nowhere}, " + ball + "}]}",
               "no frame is named \"nowhere\""},
              {"world: {octomap: {octomap: {data: [1, 2]}}}", "octomaps are not read"},
              {"robot_state: {attached_collision_objects: [{link_name: arm, object: {id: left, " +
                   ball + "}}]}",
               "must not be the name of a link"},
              {"world: {collision_objects: [{id: x, " + ball + ", primitive_pose: []}]}",
               "did you mean \"primitive_poses\"?"},
              // 0 in ROS 1, which is half a turn, and 1 in ROS 2.
              {"world: {collision_objects: [{id: x, pose: {orientation: {z: 0.1}}, " + ball + "}]}",
               "/pose/orientation/w: missing"},
              {"allowed_collision_matrix: {entry_names: [a, b], entry_values: [[true]]}",
               "must have a row for each of the 2 names"}});
}

TEST(RobotMeaning, groups_states_and_virtual_joints) {
  const TemporaryFolder folder;
  std::ofstream(folder / "r.srdf") << R"(<robot name="r">
    <virtual_joint name="roam" type="planar" parent_frame="world" child_link="base"/>
    <group name="all"><chain base_link="base" tip_link="left"/></group>
    <group name="more"><group name="all"/><joint name="also"/></group>
    <group_state name="home" group="all"><joint name="turn" value="0.5"/></group_state>
  </robot>)";
  Model model = robot_model();
  Mistakes mistakes("r.srdf");
  const RobotMeaning meaning = read_robot_meaning(folder / "r.srdf", model, mistakes);
  ASSERT_TRUE(mistakes.none()) << mistakes.text();
  EXPECT_EQ(meaning.groups.at("all"), (std::vector<std::string>{"turn", "open"}));
  EXPECT_EQ(meaning.groups.at("more"), (std::vector<std::string>{"turn", "open"}));  // not mimics
  const GroupState* home = find_state(meaning, "home", mistakes);
  ASSERT_TRUE(home);
  EXPECT_EQ(home->values[0].second[0], 0.5);
  EXPECT_TRUE(find_joint(model, "roam"));
  EXPECT_FALSE(find_state(meaning, "hme", mistakes));
  EXPECT_TRUE(has(mistakes.text(), "did you mean \"home\"?"));
}

}  // namespace
}  // namespace minkray
