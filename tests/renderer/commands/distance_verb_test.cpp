// SPDX-License-Identifier: MIT
// minkray distance as its users meet it: of two shapes, and of the pairs of a robot and a world.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "renderer/json/json.h"
#include "tests/support/messages.h"
#include "tests/support/program.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

/// An arm of two balls in a row on a rail, the outer one on a hinge; a world with a floor; a ball.
class DistanceVerb : public ::testing::Test {
 protected:
  DistanceVerb() {
    folder_.write("arm.urdf", R"(<robot name="arm">
  <link name="base"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
  <link name="cart"><collision><geometry><sphere radius="0.5"/></geometry></collision></link>
  <link name="hand"><collision><origin xyz="1 0 0"/>
    <geometry><sphere radius="0.25"/></geometry></collision></link>
  <joint name="rail" type="prismatic"><parent link="base"/><child link="cart"/>
    <axis xyz="1 0 0"/><limit lower="0" upper="9" effort="1" velocity="1"/></joint>
  <joint name="turn" type="continuous"><parent link="cart"/><child link="hand"/>
    <axis xyz="0 1 0"/></joint>
</robot>)");
    folder_.write("arm.srdf", R"(<robot name="arm">
  <disable_collisions link1="base" link2="hand" reason="Never"/></robot>)");
    folder_.write("world.sdf", R"(<sdf version="1.7"><world name="w">
  <model name="floor"><static>true</static><pose>0 0 -2 0 0 0</pose><link name="l"><collision name="floor">
    <geometry><plane><normal>0 0 1</normal><size>9 9</size></plane></geometry></collision></link></model>
  <model name="post"><static>true</static><pose>6 0 0 0 0 0</pose><link name="l"><collision name="post">
    <geometry><sphere><radius>0.5</radius></sphere></geometry></collision></link></model>
</world></sdf>)");
    folder_.write("tool.json", R"({"type": "transform", "translate": [0, 5, 0],
                                   "shape": {"type": "sphere", "radius": 1}})");
    folder_.write("other.json", R"({"type": "sphere", "radius": 1})");
    write_ball_scene(folder_ / "ball.json", 0.5);
  }

  ProgramOutcome run(const std::string& words) const {
    return run_minkray(folder_, "distance " + words);
  }
  Json json_of(const std::string& words) const {
    const ProgramOutcome outcome = run(words + " --json");
    EXPECT_EQ(outcome.exit_code, 0) << words << "\n" << outcome.err;
    return Json::parse(outcome.out.empty() ? "{\"pairs\": []}" : outcome.out);
  }
  static std::string names(const Json& pair) {
    return std::string(pair["a"].text()) + " " + std::string(pair["b"].text());
  }

  TemporaryFolder folder_;
};

TEST_F(DistanceVerb, of_two_shapes_is_one_object) {
  const ProgramOutcome outcome = run("tool.json other.json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json answer = Json::parse(outcome.out);
  EXPECT_EQ(answer["status"].text(), "separated");
  EXPECT_NEAR(answer["value"].get<double>(), 3, 1e-12);
}

TEST_F(DistanceVerb, of_two_shapes_is_a_table_of_one_row_in_a_file) {
  const ProgramOutcome file = run("tool.json other.json -o pair.csv");
  ASSERT_EQ(file.exit_code, 0) << file.err;
  EXPECT_EQ(file.out, "");
  const std::string header =
      "a,b,status,value,lower,upper,point_a_x,point_a_y,point_a_z,"
      "point_b_x,point_b_y,point_b_z,normal_x,normal_y,normal_z\n";
  const std::string text = text_of_file(folder_ / "pair.csv");
  ASSERT_TRUE(text.starts_with(header + "tool,other,separated,")) << text;
  EXPECT_EQ(std::ranges::count(text, '\n'), 2);
  const auto numbers = [&](const char* words) {
    const ProgramOutcome outcome = run(std::string(words) + " -o pair.csv --json");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    std::istringstream row(text_of_file(folder_ / "pair.csv").substr(header.size()));
    std::vector<std::string> cells;
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    EXPECT_EQ(cells.size(), 15u);
    cells.resize(15);
    return std::pair(cells, Json::parse(outcome.out));
  };
  const auto [cells, json] = numbers("tool.json other.json");
  EXPECT_EQ(std::stod(cells[3]), json["value"].get<double>());
  EXPECT_EQ(std::stod(cells[4]), json["lower"].get<double>());
  EXPECT_EQ(std::stod(cells[5]), json["upper"].get<double>());
  EXPECT_NEAR(std::stod(cells[7]), 4, 1e-12);   // the tool's lowest point along y
  EXPECT_NEAR(std::stod(cells[10]), 1, 1e-12);  // the other's highest
  EXPECT_NEAR(std::stod(cells[13]), -1, 1e-12);
  // A lower bound alone has no points.
  folder_.write("egg.json", R"({"type": "transform", "translate": [0, 5, 1],
    "shape": {"type": "ellipsoid", "radii": [1, 0.5, 0.25]}})");
  folder_.write("can.json", R"({"type": "cylinder", "radius": 1, "half_height": 1})");
  const auto [bound, bound_json] = numbers("egg.json can.json --at-most 1");
  EXPECT_GT(std::stod(bound[4]), 1);
  EXPECT_EQ(std::stod(bound[4]), bound_json["lower"].get<double>());
  EXPECT_EQ(bound[5] == "inf", bound_json["upper"].is_null());
  EXPECT_EQ(bound[6].empty(), !bound_json.contains("point_a"));
}

TEST_F(DistanceVerb, of_a_robot_among_others_is_a_table_by_distance) {
  // The cart is at 2, and the hand at 2 - 1: turned by pi about y.
  const Json answer = json_of("arm.urdf world.sdf --joint rail=2 --joint turn=3.141592653589793");
  // Joints connect the robot's own pairs but base and hand.
  ASSERT_EQ(answer["pairs"].size(), 7u);
  EXPECT_TRUE(answer["within"].is_null());
  double before = -1;
  for (std::size_t i = 0; i < 7; ++i) {
    const Json& pair = answer["pairs"][i];
    const double value = pair["value"].get<double>();
    EXPECT_GE(value, before);
    EXPECT_LE(pair["lower"].get<double>(), value);
    EXPECT_GE(pair["upper"].get<double>(), value);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(pair["point_b"][axis].get<double>() - pair["point_a"][axis].get<double>(),
                  value * pair["normal"][axis].get<double>(), 1e-9);
    before = value;
  }
  const Json& nearest = answer["pairs"][0];
  EXPECT_EQ(names(nearest), "base/box hand/sphere");
  EXPECT_NEAR(nearest["value"].get<double>(), 1 - 0.25 - 0.5, 1e-9);
  // The cart and the floor, and the cart and the post.
  std::map<std::string, double> values;
  for (std::size_t i = 0; i < 7; ++i)
    values[names(answer["pairs"][i])] = answer["pairs"][i]["value"].get<double>();
  EXPECT_NEAR(values["cart/sphere floor::l::floor"], 2 - 0.5, 1e-12);
  EXPECT_NEAR(values["hand/sphere floor::l::floor"], 2 - 0.25, 1e-12);
  EXPECT_NEAR(values["base/box floor::l::floor"], 2 - 0.5, 1e-12);
  EXPECT_NEAR(values["cart/sphere post::l::post"], 4 - 1, 1e-12);
  EXPECT_NEAR(values["hand/sphere post::l::post"], 5 - 0.75, 1e-12);
  EXPECT_NEAR(values["base/box post::l::post"], 6 - 1, 1e-12);
}

TEST_F(DistanceVerb, leaves_out_what_is_far_allowed_or_not_asked_for) {
  const std::string pose = "arm.urdf world.sdf --joint rail=2 --joint turn=3.141592653589793 ";
  const Json near = json_of(pose + "--within 1.6");
  EXPECT_EQ(near["pairs"].size(), 3u);
  EXPECT_EQ(near["within"].get<double>(), 1.6);
  for (const char* words : {"--srdf arm.srdf", "--allow hand,base", "--only-obstacles"})
    EXPECT_EQ(json_of(pose + words)["pairs"].size(), 6u) << words;
  EXPECT_EQ(json_of("arm.urdf")["pairs"].size(), 1u);
  EXPECT_EQ(json_of("arm.urdf --srdf arm.srdf")["pairs"].size(), 0u);
  EXPECT_EQ(run("arm.urdf --srdf arm.srdf").out, "no pairs\n");
  EXPECT_EQ(run("arm.urdf --within 0.1").out, "no pairs within 0.1\n");
  EXPECT_EQ(json_of("arm.urdf world.sdf ball.json tool.json")["pairs"].size(), 1u + 3 * 4);
}

TEST_F(DistanceVerb, takes_files_of_any_kind_in_any_place) {
  const Json shape_first = json_of("tool.json arm.urdf");
  ASSERT_EQ(shape_first["pairs"].size(), 3u);
  EXPECT_EQ(names(shape_first["pairs"][0]), "tool base/box");
  EXPECT_NEAR(shape_first["pairs"][0]["value"].get<double>(), 5 - 1.5, 1e-9);
  const Json scene = json_of("ball.json tool.json");
  ASSERT_EQ(scene["pairs"].size(), 1u);
  EXPECT_EQ(names(scene["pairs"][0]), "ball tool");
  EXPECT_NEAR(scene["pairs"][0]["value"].get<double>(), 5 - 1.5, 1e-12);
  // A scene alone: each of its objects with each other one.
  EXPECT_EQ(json_of("world.sdf")["pairs"].size(), 0u) << "nothing moves against another";
  folder_.write("two.json", R"({"version": 1, "lights": [],
    "camera": {"position": [0, -9, 1], "look_at": [0, 0, 0]},
    "materials": [{"name": "m", "type": "lambert", "color": [1, 1, 1]}],
    "objects": [{"name": "a", "material": "m", "shape": {"type": "sphere", "radius": 1}},
                {"name": "b, c", "material": "m", "shape": {"type": "transform", "translate": [0, 0, 1.5],
                 "shape": {"type": "sphere", "radius": 1}}}]})");
  const Json two = json_of("two.json");
  ASSERT_EQ(two["pairs"].size(), 1u);
  EXPECT_EQ(two["pairs"][0]["status"].text(), "overlapping");
  EXPECT_NEAR(two["pairs"][0]["value"].get<double>(), -0.5, 1e-9);
  EXPECT_EQ(json_of("two.json other.json")["pairs"].size(), 2u);
}

TEST_F(DistanceVerb, tables_are_text_or_csv_of_the_same_numbers) {
  const ProgramOutcome text = run("arm.urdf world.sdf --within 1.7");
  ASSERT_EQ(text.exit_code, 0) << text.err;
  EXPECT_TRUE(text.out.starts_with("a  ")) << text.out;
  EXPECT_TRUE(has(text.out, "\nbase/box     hand/sphere      0.25      0.25   0.25   0.5 0 0 "));
  EXPECT_EQ(std::ranges::count(text.out, '\n'), 4);
  const ProgramOutcome file = run("arm.urdf world.sdf --within 1.7 -o pairs.csv");
  ASSERT_EQ(file.exit_code, 0) << file.err;
  EXPECT_EQ(file.out, "");
  const Json same = json_of("arm.urdf world.sdf --within 1.7 -o pairs.csv");
  std::istringstream lines(text_of_file(folder_ / "pairs.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_TRUE(line.starts_with("a,b,status,value,lower,upper,point_a_x,")) << line;
  for (std::size_t i = 0; i < same["pairs"].size(); ++i) {
    ASSERT_TRUE(std::getline(lines, line));
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    ASSERT_EQ(cells.size(), 15u);
    const Json& pair = same["pairs"][i];
    EXPECT_EQ(cells[0] + " " + cells[1], names(pair));
    EXPECT_EQ(cells[2], pair["status"].text());
    EXPECT_EQ(std::stod(cells[3]), pair["value"].get<double>());
    EXPECT_EQ(std::stod(cells[4]), pair["lower"].get<double>());
    EXPECT_EQ(std::stod(cells[12]), pair["normal"][0].get<double>());
  }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST_F(DistanceVerb, what_is_wrong_with_its_words_or_files_is_told) {
  const auto expect = [&](const std::string& words, int code, const std::string& text) {
    const ProgramOutcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, code) << words << "\n" << outcome.err;
    EXPECT_TRUE(has(outcome.err, text)) << words;
  };
  expect("", 2, "files");
  expect("tool.json", 2, "must have a second file");
  expect("tool.json other.json --within 1", 2, "for two shapes only");
  expect("tool.json other.json -o pair.txt", 2, "must end in .csv");
  expect("tool.json other.json --joint rail=1", 2, "for two shapes only");
  expect("arm.urdf --at-most 1", 2, "are for two shapes");
  expect("ball.json arm.urdf --joint rail=1", 2, "must be the first file");
  expect("ball.json arm.urdf --srdf arm.srdf", 2, "ball.json is no robot");
  expect("arm.urdf --within -1", 2, "--within: must be a number >= 0");
  expect("arm.urdf --within nan", 2, "--within: must be a number >= 0");
  expect("arm.urdf -o pairs.txt", 2, "must end in .csv");
  expect("arm.urdf --joint elbow=1", 3, "elbow");
  expect("arm.urdf --allow hand", 3, "--allow: must be two links");
  expect("arm.urdf nothing.json", 3, "nothing.json");
  folder_.write("wrong.srdf",
                R"(<robot><disable_collisions link1="hand" link2="nobody"/></robot>)");
  expect("arm.urdf --srdf wrong.srdf", 3, "link2: there is no link \"nobody\"");
}

}  // namespace
}  // namespace minkray
