// SPDX-License-Identifier: MIT
// Several files in one scene: a robot in a world.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
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

/// A slide at x = 4 and a post at y = 4, both of radius 0.5.
TEST_F(SeveralFiles, have_one_field_of_distances) {
  const auto least = [&](const char* words) {
    const ProgramOutcome outcome = run(std::string("field ") + words + " -r 2x2 --extent 1e-9");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    double distance = 0;
    EXPECT_EQ(std::sscanf(outcome.out.c_str(), "least distance %lf", &distance), 1) << outcome.out;
    return distance;
  };
  EXPECT_NEAR(least("slide.urdf world.sdf --joint rail=1 --through 0,0,0 -o f.png"), 3.5, 1e-5);
  EXPECT_NEAR(least("world.sdf --through 4,0,0 -o f.png"), std::sqrt(32) - 0.5, 1e-5);
  EXPECT_NEAR(least("world.sdf slide.urdf --through 4,0,0 -o f.png"), 0.5, 1e-5);
}

TEST_F(SeveralFiles, are_traced_together) {
  const ProgramOutcome named =
      run("trace slide.urdf world.sdf -r 64x48 --pixel 1,1 --object post::l::post --json");
  ASSERT_EQ(named.exit_code, 0) << named.err;
  EXPECT_EQ(Json::parse(named.out)["object"].text(), "post::l::post");
  EXPECT_NE(run("trace slide.urdf -r 64x48 --pixel 1,1 --object post::l::post").exit_code, 0);
}

TEST_F(SeveralFiles, are_compared_together) {
  const ProgramOutcome outcome =
      run("compare slide.urdf world.sdf ball.json --rays 100 --directions 50 -q --json");
  if (has(outcome.err, "minkray-compare")) GTEST_SKIP() << "built without Embree";
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(Json::parse(outcome.out)["objects"].size(), 3u);
}

/// A written scene has everything, and its materials the colours that they had.
TEST_F(SeveralFiles, are_imported_into_one_scene_file) {
  folder_.write("painted.json", R"({"version": 1, "lights": [],
    "camera": {"position": [0, -9, 1], "look_at": [0, 0, 0]},
    "materials": [{"name": "m", "type": "lambert", "color": [1, 0, 0]},
                  {"name": "n", "type": "lambert", "color": [0, 1, 0]},
                  {"name": "both", "type": "mix", "materials": ["m", "n"]}],
    "objects": [{"name": "a", "material": "both", "shape": {"type": "sphere", "radius": 1}},
                {"name": "b", "material": "m", "mesh": {
                  "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]],
                  "triangles": [[0, 1, 2], [1, 3, 2]], "materials": ["n", "m"],
                  "material_of": [0, 1]}}]})");
  std::string blue = text_of_file(folder_ / "painted.json");
  for (std::size_t at = 0; (at = blue.find("[1, 0, 0]}", at)) != std::string::npos;)
    blue.replace(at, 9, "[0, 0, 1]");
  folder_.write("blue.json", blue);
  const ProgramOutcome outcome =
      run("import painted.json slide.urdf world.sdf blue.json -o all.json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_parts(outcome.err, {"URDF", "SDF"});
  const Json all = Json::parse(text_of_file(folder_ / "all.json"));
  ASSERT_EQ(all["objects"].size(), 6u);
  std::map<std::string, std::string> colours;
  for (std::size_t i = 0; i < all["materials"].size(); ++i) {
    const Json& material = all["materials"][i];
    const auto [at, is_new] = colours.emplace(
        material["name"].text(), material.contains("color") ? material["color"].dump() : "");
    EXPECT_TRUE(is_new) << at->first;
    if (material.contains("materials")) {
      const std::string first(material["materials"][0].text());
      at->second = colours.at(first);
    }
  }
  const auto colour = [&](const Json& name) { return colours.at(std::string(name.text())); };
  EXPECT_EQ(colour(all["objects"][0]["material"]), "[1.0,0.0,0.0]");
  EXPECT_EQ(colour(all["objects"][4]["material"]), "[0.0,0.0,1.0]");
  for (const std::size_t mesh : {1, 5}) {
    const char* const own = mesh == 1 ? "[1.0,0.0,0.0]" : "[0.0,0.0,1.0]";
    const Json& written = all["objects"][mesh]["mesh"];
    EXPECT_EQ(colour(written["materials"][0]), "[0.0,1.0,0.0]");
    EXPECT_EQ(colour(written["materials"][1]), own);
  }
  // The written file is a scene with the same contents.
  const Json from_files =
      Json::parse(run("info painted.json slide.urdf world.sdf blue.json --json").out);
  const Json from_one = Json::parse(run("info all.json --json").out);
  for (const char* what : {"objects", "shapes", "bounds", "materials", "camera"})
    EXPECT_EQ(from_one[what].dump(), from_files[what].dump()) << what;
}

TEST_F(SeveralFiles, options_of_robots_are_for_all_but_joints) {
  folder_.write("both.urdf", R"(<robot name="both"><link name="l">
  <visual><geometry><sphere radius="1"/></geometry></visual>
  <collision><geometry><box size="1 1 1"/></geometry></collision></link></robot>)");
  for (const char* files : {"ball.json both.urdf", "both.urdf ball.json"}) {
    const ProgramOutcome outcome =
        run(std::string("info ") + files + " --geometry collision --json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(Json::parse(outcome.out)["shapes"].contains("box")) << files;
  }
  expect_exit(2, run("info ball.json slide.urdf --joint rail=1"), {"must be the first file"});
  expect_exit(2, run("info ball.json ball.json --geometry all"), {"need a robot file"});
}

TEST_F(SeveralFiles, what_is_wrong_with_one_is_told) {
  expect_exit(3, run("info slide.urdf nothing.sdf"), {"nothing.sdf"});
  folder_.write("wrong.json", R"({"version": 1})");
  expect_exit(3, run("render slide.urdf wrong.json -o a.png"), {"wrong.json: "});
}

}  // namespace
}  // namespace minkray
