// SPDX-License-Identifier: MIT
// Several files in one scene: a robot in a world.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "renderer/json/json.h"
#include "tests/support/expect_exit.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

class SeveralFiles : public ::testing::Test {
 protected:
  SeveralFiles() {
    folder_.write("slide.urdf", R"(<robot name="slide"><link name="base"/>
  <link name="ball"><visual><geometry><sphere radius="0.5"/></geometry></visual></link>
  <joint name="rail" type="prismatic"><parent link="base"/><child link="ball"/><origin xyz="3 0 0"/>
    <axis xyz="1 0 0"/><limit lower="0" upper="9" effort="1" velocity="1"/></joint></robot>)");
    folder_.write("world.sdf", R"(<sdf version="1.7"><world name="w">
  <model name="post"><static>true</static><pose>0 4 0 0 0 0</pose><link name="l"><visual name="post">
    <geometry><sphere><radius>0.5</radius></sphere></geometry></visual></link></model></world></sdf>)");
    folder_.write("cross.csv", "time,azimuth,zenith\n0,0,90\n0,90,90\n");
    write_ball_scene(folder_ / "ball.json", 0.25);
  }

  ProgramOutcome run(const std::string& words) const { return run_minkray(folder_, words); }

  /// The values of t that a scan has, and the object's number of each.
  std::vector<std::pair<double, std::string>> scan(const std::string& files) const {
    expect_exit(0, run("scan " + files + " --pattern cross.csv -q -o scan.csv --ids ids.json"));
    std::istringstream lines(text_of_file(folder_ / "scan.csv"));
    std::string line;
    std::getline(lines, line);
    std::vector<std::string> names;
    std::istringstream head(line);
    for (std::string name; std::getline(head, name, ',');) names.push_back(name);
    const auto column = [&](const char* name) {
      return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    };
    std::vector<std::pair<double, std::string>> found;
    while (std::getline(lines, line)) {
      std::vector<std::string> cells;
      std::istringstream row(line);
      for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
      found.emplace_back(std::stod(cells.at(column("t"))), cells.at(column("object")));
    }
    return found;
  }

  TemporaryFolder folder_;
};

TEST_F(SeveralFiles, are_scanned_together) {
  const auto found = scan("slide.urdf world.sdf --joint rail=1");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].first, 3 + 1 - 0.5, 1e-9);
  EXPECT_NEAR(found[1].first, 4 - 0.5, 1e-9);
  EXPECT_EQ(found[0].second, "0");
  EXPECT_EQ(found[1].second, "1");
  const auto turned = scan("world.sdf slide.urdf");
  EXPECT_NEAR(turned.at(0).first, 3 - 0.5, 1e-9);
  EXPECT_EQ(turned.at(0).second, "1");
}

TEST_F(SeveralFiles, are_described_together) {
  const ProgramOutcome text = run("info slide.urdf world.sdf");
  EXPECT_EQ(text.exit_code, 0) << text.err;
  expect_parts(text.out, {"URDF", "SDF"});
  const Json one = Json::parse(run("info slide.urdf --json").out);
  const Json both = Json::parse(run("info slide.urdf world.sdf ball.json --json").out);
  EXPECT_EQ(one["objects"].get<int>() + 2, both["objects"].get<int>());
  EXPECT_FALSE(one.contains("other_models"));
  ASSERT_EQ(both["other_models"].size(), 1u);
  EXPECT_EQ(both["other_models"][0]["format"], "SDF");
}

/// A scene file has a camera and lights; robots' files have none.
TEST_F(SeveralFiles, are_seen_by_the_camera_of_the_first_scene_file) {
  for (const char* files : {"slide.urdf ball.json", "ball.json slide.urdf"}) {
    const Json seen = Json::parse(run(std::string("info ") + files + " --json").out);
    const Json ball = Json::parse(run("info ball.json --json").out);
    EXPECT_EQ(seen["camera"].dump(), ball["camera"].dump()) << files;
    EXPECT_EQ(seen["lights"].dump(), ball["lights"].dump()) << files;
  }
  // Without one, both are in the picture: the camera is elsewhere than for one of them.
  const Json both = Json::parse(run("info slide.urdf world.sdf --json").out);
  const Json one = Json::parse(run("info slide.urdf --json").out);
  EXPECT_NE(both["camera"].dump(), one["camera"].dump());
}

TEST_F(SeveralFiles, are_rendered_and_inspected_together) {
  expect_exit(0, run("render slide.urdf ball.json world.sdf -o together.png -s 1 -r 16x12 -q"));
  expect_exit(0, run("inspect ball.json slide.urdf -o together.html -s 1 -r 16x12 -q"));
  // A part file stores all files that it was made of: another world is not the same scene.
  for (const auto& [files, part] : {std::pair("slide.urdf world.sdf", "1"),
                                    {"slide.urdf world.sdf", "2"},
                                    {"slide.urdf ball.json", "3"}}) {
    const std::string tile = std::string(part) == "1" ? "1/2" : "2/2";
    expect_exit(0, run("render " + std::string(files) + " -s 1 -r 16x12 -q --tile " + tile +
                       " -o " + part + ".exr"));
  }
  expect_exit(0, run("merge 1.exr 2.exr -o whole.png"));
  EXPECT_NE(run("merge 1.exr 3.exr -o other.png").exit_code, 0);
}

TEST_F(SeveralFiles, what_is_wrong_with_one_is_told) {
  expect_exit(3, run("info slide.urdf nothing.sdf"), {"nothing.sdf"});
  folder_.write("wrong.json", R"({"version": 1})");
  expect_exit(3, run("render slide.urdf wrong.json -o a.png"), {"wrong.json: "});
}

}  // namespace
}  // namespace minkray
