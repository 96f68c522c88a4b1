// SPDX-License-Identifier: MIT
// Scene files of version 2: includes, groups, rotations, colours, defaults and keys.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/shape/shape.h"
#include "renderer/image/colour.h"
#include "renderer/scene_json/scene_json.h"
#include "renderer/scene_json/schema.h"
#include "renderer/scene_json/version_one.h"
#include "renderer/scene_json/write_scene.h"
#include "tests/support/messages.h"
#include "tests/support/temporary_folder.h"

namespace minkray {
namespace {

class VersionTwo : public ::testing::Test {
 protected:
  /// The scene of a text as a file "scene.json" in the folder, where there are no mistakes.
  Scene read(const std::string& text) {
    Mistakes mistakes("scene.json");
    auto scene = parse_scene(text, folder_.path(), mistakes);
    EXPECT_TRUE(scene) << mistakes.text();
    return scene ? std::move(*scene) : Scene();
  }
  Scene read_objects(const std::string& objects) {
    return read(R"({"version": 2, "objects": [)" + objects + "]}");
  }
  std::string mistakes_of(const std::string& text) {
    folder_.write("scene.json", text);
    Mistakes mistakes("scene.json");
    const auto scene = parse_scene(text, folder_.path(), mistakes);
    EXPECT_EQ(scene.has_value(), mistakes.none());
    return mistakes.text();
  }

  TemporaryFolder folder_;
};

const std::string ball = R"("shape": {"type": "sphere", "radius": 1})";

void expect_near(const Vec3<double>& found, const Vec3<double>& expected) {
  EXPECT_LT((found - expected).norm(), 1e-14) << found.transpose();
}

TEST_F(VersionTwo, a_shape_alone_is_a_scene) {
  const Scene scene = read_objects("{" + ball + "}");
  ASSERT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.objects[0].name, "sphere 1");
  EXPECT_EQ(scene.materials[scene.objects[0].material].name, "default");
  EXPECT_TRUE(scene.camera_is_framed);
  EXPECT_EQ(scene.lights.size(), 2u);
  // The whole ball is seen: its middle is ahead, and further away than it is large.
  EXPECT_LT(scene.camera.look_at.norm(), 0.1);
  EXPECT_GT(scene.camera.position.norm(), 1 / std::sin(20 * std::numbers::pi / 180));
}

TEST_F(VersionTwo, cameras_see_the_sky_that_lights_the_scene) {
  const auto background = [&](const std::string& lights) {
    return read(R"({"version": 2, "objects": [], "lights": [)" + lights + "]}").background.zenith;
  };
  const std::string sky =
      R"({"type": "environment", "zenith": [0, 0.5, 1], "nadir": [0, 0, 0], "intensity": 2})";
  EXPECT_EQ(background(sky), Colour(0, 1, 2));
  EXPECT_LT(background("").maxCoeff(), 1);
}

TEST_F(VersionTwo, a_rotation_may_be_written_in_four_ways) {
  const double s = std::sqrt(0.5);
  const std::pair<std::string, Vec3<double>> turns[] = {
      // Each with where it takes (1, 2, 3).
      {"[0, 0, " + std::to_string(s) + ", " + std::to_string(s) + "]", {-2, 1, 3}},
      {R"({"axis": [0, 0, 5], "degrees": 90})", {-2, 1, 3}},
      {R"({"axis": [0, 0, 1], "degrees": -270})", {-2, 1, 3}},
      {R"({"euler_xyz_degrees": [0, 0, 90]})", {-2, 1, 3}},
      {R"({"euler_xyz_degrees": [90, 0, 90]})", {3, 1, 2}},  // about x, and then about the old z
      {R"({"look_at": [0, 0, 9]})", {1, 2, 3}},
      {R"({"look_at": [9, 0, 0]})", {3, 1, 2}},  // z goes to x, x to y: it stays level
      {R"({"look_at": [0, 0, -9]})", {1, -2, -3}}};
  for (const auto& [written, expected] : turns) {
    const Scene scene = read_objects("{" + ball + R"(, "transform": {"rotate": )" + written + "}}");
    ASSERT_EQ(scene.objects.size(), 1u) << written;
    expect_near(scene.objects[0].pose(Vec3<double>(1, 2, 3)), expected);
  }
}

TEST_F(VersionTwo, a_thing_looks_at_a_point_from_where_it_is) {
  const Scene scene = read_objects(
      "{" + ball + R"(, "transform": {"translate": [1, 1, 1], "rotate": {"look_at": [1, 5, 1]}}})");
  expect_near(scene.objects.at(0).pose(Vec3<double>(0, 0, 1)), {1, 2, 1});
}

TEST_F(VersionTwo, colours_are_srgb_where_they_are_written_so) {
  const Scene scene =
      read_objects("{" + ball + R"(, "color": "#ff8000"}, {)" + ball +
                   R"(, "color": [0.1, 0.2, 0.3]}, {)" + ball + R"(, "color": "#ff8000"})");
  ASSERT_EQ(scene.materials.size(), 2u);
  const auto colour = [&](std::size_t i) {
    return std::get<LambertMaterial>(scene.materials[scene.objects[i].material].kind)
        .colour.colour();
  };
  EXPECT_EQ(colour(0), Colour(1, from_srgb(128 / 255.0), 0));
  EXPECT_EQ(colour(1), Colour(0.1, 0.2, 0.3));
  EXPECT_EQ(scene.objects[2].material, scene.objects[0].material);
}

TEST_F(VersionTwo, groups_pose_and_name_what_is_in_them) {
  const Scene scene = read_objects(
      R"({"name": "arm", "transform": {"translate": [0, 0, 10], "scale": 2}, "objects": [
           {"name": "a", )" +
      ball + R"(, "transform": {"translate": [1, 0, 0]}},
           {"name": "hand", "transform": {"rotate": {"axis": [0, 0, 1], "degrees": 90}},
            "objects": [{"name": "b", )" +
      ball + R"(, "transform": {"translate": [1, 0, 0]}}]}]})");
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[0].name, "arm/a");
  EXPECT_EQ(scene.objects[1].name, "arm/hand/b");
  expect_near(scene.objects[0].pose(Vec3<double>(1, 0, 0)), {4, 0, 10});
  expect_near(scene.objects[1].pose(Vec3<double>(1, 0, 0)), {0, 4, 10});
}

TEST_F(VersionTwo, files_may_be_included_again_and_again) {
  std::filesystem::create_directory(folder_.path() / "parts");
  folder_.write("parts/peg.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n");
  folder_.write("parts/paint.json", R"({"version": 2, "materials":
      [{"name": "red", "type": "lambert", "color": "#ff0000"}]})");
  folder_.write("parts/peg.json", R"({"version": 2, "include": "paint.json", "camera": {},
      "lights": [], "objects": [{"name": "peg", "material": "red",
      "shape": {"type": "hull", "file": "peg.obj"}}]})");
  const std::string text = R"({"version": 2, "include": ["parts/paint.json"],
      "materials": [{"name": "pale", "type": "mix", "materials": ["red", "red"]}],
      "objects": [{"include": "parts/peg.json"},
                  {"name": "high", "include": "parts/peg.json", "transform": {"translate": [0, 0, 5]}},
                  {"material": "red", )" +
                           ball + "}]}";
  const Scene scene = read(text);
  ASSERT_EQ(scene.objects.size(), 3u);
  EXPECT_EQ(scene.objects[0].name, "peg");
  EXPECT_EQ(scene.objects[1].name, "high/peg");
  EXPECT_EQ(scene.objects[1].pose.translation, Vec3<double>(0, 0, 5));
  EXPECT_EQ(scene.materials.size(), 2u);
  EXPECT_FALSE(scene.lights.empty());  // a group takes objects and materials only

  // Included files are part of the scene's hash, and of the list of its files.
  std::vector<std::filesystem::path> files;
  load_scene(folder_.write("scene.json", text), &files);
  EXPECT_EQ(files.size(), 3u);
  folder_.write("parts/paint.json", R"({"version": 2, "materials":
      [{"name": "red", "type": "lambert", "color": "#fe0000"}]})");
  EXPECT_NE(read(text).hash, scene.hash);
}

TEST_F(VersionTwo, what_is_included_at_the_top_is_part_of_the_scene_itself) {
  folder_.write("stage.json",
                R"({"version": 2, "camera": {"position": [0, -9, 0], "look_at": [0, 0, 0]},
      "lights": [{"type": "point", "position": [0, 0, 9]}], "background": "#000000",
      "objects": [{"name": "floor", "shape": {"type": "plane"}}],
      "particles": [{"name": "p", "material": "m", "shape": {"type": "point"}, "poses": [[0, 0, 0]]}]})");
  const std::string end = R"("materials": [{"name": "m", "type": "lambert", "color": [1, 1, 1]}],
      "objects": [{"name": "own", )" +
                          ball + "}]}";
  const Scene scene = read(R"({"version": 2, "include": "stage.json", )" + end);
  EXPECT_EQ(scene.camera.position, Vec3<double>(0, -9, 0));
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.background.zenith, Colour(0, 0, 0));
  EXPECT_EQ(scene.particles.size(), 1u);
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[1].name, "own");
  const Scene other = read(R"({"version": 2, "include": "stage.json", "background": [1, 1, 1],
      "camera": {"position": [0, 0, 7], "look_at": [0, 0, 0]}, )" +
                           end);
  EXPECT_EQ(other.camera.position, Vec3<double>(0, 0, 7));
  EXPECT_EQ(other.camera.up, Vec3<double>(0, 1, 0));  // the camera looks straight down
  EXPECT_EQ(other.background.zenith, Colour(1, 1, 1));
}

/// A robot's motion and files of version 1 turn about the world's origin, which none expected.
TEST_F(VersionTwo, keys_turn_an_object_about_its_own_origin) {
  const std::string keys =
      R"("keys": [{"time": 0}, {"time": 1, "rotate": {"axis": [0, 0, 1], "degrees": 90},
                   "translate": [0, 0, 2]}])";
  Scene scene = read_objects("{" + ball + R"(, "transform": {"translate": [5, 0, 0]}, )" + keys +
                             "}, {" + ball + R"(, "transform": {"translate": [5, 0, 0]},
                             "pivot": [4, 0, 0], )" +
                             keys + "}");
  ASSERT_EQ(scene.objects.size(), 2u);
  set_time(scene, 1);
  expect_near(scene.objects[0].pose(Vec3<double>(1, 0, 0)), {5, 1, 2});
  expect_near(scene.objects[1].pose(Vec3<double>(1, 0, 0)), {4, 2, 2});
}

TEST_F(VersionTwo, keys_go_with_their_groups) {
  Scene scene = read_objects(
      R"({"transform": {"translate": [0, 0, 3], "scale": [-2, 2, 2],
                        "rotate": {"axis": [1, 0, 0], "degrees": 90}}, "objects": [{)" +
      ball + R"(, "transform": {"translate": [1, 0, 0]},
      "keys": [{"time": 0}, {"time": 1, "rotate": {"axis": [0, 0, 1], "degrees": 90},
                             "translate": [0, 1, 0]}]}]})");
  ASSERT_EQ(scene.objects.size(), 1u);
  set_time(scene, 1);
  // In the group the point (1, 0, 0) of the ball goes to (1, 2, 0).
  expect_near(scene.objects[0].pose(Vec3<double>(1, 0, 0)), {-2, 0, 7});
}

TEST_F(VersionTwo, cameras_lights_and_materials_have_keys) {
  Scene scene = read(R"({"version": 2,
    "camera": {"position": [0, -4, 0], "look_at": [0, 0, 0],
               "keys": [{"time": 0, "position": [0, -4, 0]}, {"time": 2, "position": [4, -4, 0]},
                        {"time": 4, "fov_y_degrees": 20}, {"time": 5, "fov_y_degrees": 30}]},
    "lights": [{"type": "point", "position": [0, 0, 9], "intensity": 2,
                "keys": [{"time": 0, "intensity": 4}, {"time": 1, "intensity": 8, "color": "#ff0000"}]}],
    "materials": [{"name": "m", "type": "glossy", "color": [0, 0, 0],
                   "keys": [{"time": 1, "color": [0, 0, 0]}, {"time": 3, "color": [1, 0.5, 0]}]}],
    "objects": [{"material": "m", )" +
                     ball + "}]}");
  const auto intensity = [&] { return std::get<PointLight>(scene.lights.at(0)).colour; };
  const auto colour = [&] {
    return std::get<GlossyMaterial>(scene.materials.at(0).kind).colour.colour();
  };
  EXPECT_FALSE(scene.camera_is_framed);
  EXPECT_EQ(intensity(), Colour(4, 0, 0));
  const Scene as_written = scene;
  set_time(scene, 0.5);
  EXPECT_EQ(scene.camera.position, Vec3<double>(1, -4, 0));
  EXPECT_EQ(intensity(), Colour(6, 0, 0));
  EXPECT_EQ(colour(), Colour(0, 0, 0));
  set_time(scene, 2);
  EXPECT_EQ(scene.camera.fov_y_degrees, 20);
  EXPECT_EQ(colour(), Colour(0.5, 0.25, 0));
  set_time(scene, 99);
  EXPECT_EQ(scene.camera.position, Vec3<double>(4, -4, 0));
  EXPECT_EQ(scene.camera.fov_y_degrees, 30);

  // A written scene is read as the same scene, at all times.
  Scene again = read(scene_text(as_written));
  for (const double time : {0.0, 0.7, 1.5, 4.5}) {
    set_time(scene, time);
    set_time(again, time);
    EXPECT_EQ(again.camera.position, scene.camera.position);
    EXPECT_EQ(again.camera.fov_y_degrees, scene.camera.fov_y_degrees);
    EXPECT_EQ(std::get<PointLight>(again.lights[0]).colour, intensity());
    EXPECT_EQ(std::get<GlossyMaterial>(again.materials[0].kind).colour.colour(), colour());
  }
}

/// Such a camera was framed again for each picture size, and was not at the position of its first
/// key.
TEST_F(VersionTwo, a_camera_that_only_keys_place_is_where_they_say) {
  const Scene scene =
      read(R"({"version": 2, "camera": {"keys": [{"time": 0, "position": [0, -9, 3]}]},
      "objects": [{)" +
           ball + "}]}");
  EXPECT_EQ(scene.camera.position, Vec3<double>(0, -9, 3));
  EXPECT_FALSE(scene.camera_is_framed);
}

TEST_F(VersionTwo, motions_are_written_as_they_are) {
  const Scene scene = read(R"({"version": 2, "labels": true,
    "camera": {"keys": [{"time": 0, "fov_y_degrees": 20}]}, "objects": [
    {"transform": {"translate": [1, 2, 3]}, "keys": [{"time": 1, "rotate": [0, 0, 1, 1]}], )" +
                           ball + "}]}");
  const Scene again = read(scene_text(scene));
  EXPECT_TRUE(again.labels);
  ASSERT_TRUE(again.objects.at(0).motion);
  for (const double time : {0.0, 0.3, 1.0})
    EXPECT_TRUE(again.objects[0].motion->pose_at(time) == scene.objects[0].motion->pose_at(time));
}

TEST_F(VersionTwo, mistakes_are_told_with_their_files_and_places) {
  folder_.write("a.json", R"({"version": 2, "include": "b.json"})");
  folder_.write("b.json", R"({"version": 2, "include": "c.json"})");
  folder_.write("c.json", R"({"version": 2, "objects": [{"include": "a.json"}]})");
  folder_.write("bad.json", R"({"version": 2, "objects": [{"color": "#12", )" + ball + "}]}");
  folder_.write("particles.json", R"({"version": 2, "particles": []})");
  folder_.write("robot.urdf", "<robot/>");
  const auto in_object = [](const std::string& keys) {
    return R"({"version": 2, "objects": [{)" + ball + ", " + keys + "}]}";
  };
  const auto in_scene = [](const std::string& keys) {
    return R"({"version": 2, "objects": [], )" + keys + "}";
  };
  const std::string spellings =
      "a quaternion [x, y, z, w] or one of {\"axis\": [x, y, z], \"degrees\": d}, "
      "{\"euler_xyz_degrees\": [x, y, z]} and {\"look_at\": [x, y, z]}";
  const std::pair<std::string, std::string> cases[] = {
      {R"({"version": 2})", "scene.json: /objects: missing: must be a list"},
      {R"({"objects": []})", "scene.json: /version: missing: must be 1 or 2"},
      {in_scene(R"("include": "a.json")"),
       "c.json: /objects/0/include: must not lead back to a file that includes it (a.json includes "
       "b.json includes c.json includes a.json)"},
      {in_scene(R"("include": "scene.json")"),
       "scene.json: /include: must not lead back to a file that includes it (scene.json includes "
       "scene.json)"},
      {in_scene(R"("include": ["none.json", 3])"),
       "scene.json: /include/0: none.json: cannot be read: No such file or directory\n"
       "scene.json: /include/1: must be a scene file's name, relative to this file (got 3)"},
      {in_scene(R"("include": "robot.urdf")"),
       "robot.urdf: must be a scene file (found XML: minkray import makes a scene of a robot)"},
      {R"({"version": 2, "objects": [{"include": "bad.json"}, {"include": "bad.json"}]})",
       "bad.json: /objects/0/color: must be a colour: a list of 3 numbers or \"#rrggbb\" (got "
       "\"#12\")"},
      {R"({"version": 2, "objects": [{"include": "particles.json"}]})",
       "particles.json: /particles: must not be in a file that a group includes: include it at the "
       "top of the scene"},
      {in_object(R"("transform": {"rotate": [0, 0, 30]})"),
       "scene.json: /objects/0/transform/rotate: must be " + spellings +
           " (got a list of 3; three angles are euler_xyz_degrees)"},
      {in_object(R"("transform": {"rotate": {"axis": [0, 0, 0], "degrees": 3}})"),
       "scene.json: /objects/0/transform/rotate/axis: must not be zero"},
      {in_object(R"("transform": {"translate": [1, 2, 3], "rotate": {"look_at": [1, 2, 3]}})"),
       "scene.json: /objects/0/transform/rotate/look_at: must not be the object's own position "
       "([1,2,3])"},
      {in_object(R"("transform": {"rotate": {"degrees": 3}})"),
       "scene.json: /objects/0/transform/rotate/axis: missing: must be the axis to turn about: 3 "
       "numbers"},
      {in_object(R"("transform": {"rotation": [0, 0, 0, 1]})"),
       "scene.json: /objects/0/transform/rotation: unknown key (did you mean \"rotate\"?)"},
      {in_object(R"("keyframes": [])"),
       "scene.json: /objects/0/keyframes: unknown key (did you mean \"keys\"?)"},
      {in_object(R"("color": [1, 1, 1], "material": "m")"),
       "scene.json: /objects/0/color: not allowed together with \"material\"\n"
       "scene.json: /objects/0/material: must be the name of a material (got \"m\"; none is "
       "defined)"},
      {R"({"version": 2, "objects": [{"transform": {"scale": [1, 2, 1]}, "objects": [{)" + ball +
           R"(, "keys": [{"time": 0, "rotate": [1, 0, 0, 1]}]}]}]})",
       "scene.json: /objects/0/objects/0/keys: must not turn the object in a group that is scaled "
       "unevenly or sheared"},
      {in_scene(R"("camera": {"position": [1, 0, 0], "look_at": [0, 0, 0], "keys": [
                   {"time": 0, "position": [1, 0, 0]}, {"time": 1, "position": [-1, 0, 0]}]})"),
       "scene.json: /camera/keys/1: must not be opposite to the key before: put a key between "
       "them"},
      {in_scene(R"("camera": {"keys": [{"time": 0, "resolution": [3, 3]}]})"),
       "scene.json: /camera/keys/0/resolution: unknown key"},
      {in_scene(R"("lights": [{"type": "sun_sky", "sun": [0, 0, 1],
                   "keys": [{"time": 0, "sun": [0, 1, -1]}]}])"),
       "scene.json: /lights/0/keys/0/sun: must be above the horizon"},
      {in_scene(R"("materials": [{"name": "m", "type": "conductor", "metal": "gold",
                   "keys": [{"time": 0, "color": [1, 1, 1]}]}])"),
       "scene.json: /materials/0/keys/0/color: must change from a colour to a colour"}};
  for (const auto& [text, expected] : cases) {
    const std::string message = mistakes_of(text);
    EXPECT_EQ(message.substr(0, expected.size()), expected) << text << "\n" << message;
  }
}

TEST_F(VersionTwo, its_keys_in_files_of_version_1_are_told_and_not_in_its_schema) {
  const Json schema = scene_schema();
  for (const auto& [of, in, key] : later_keys) {
    Json scene = Json::parse(
        R"({"version": 1, "camera": {"position": [0, -5, 1], "look_at": [0, 0, 0]},
            "lights": [{"type": "point", "position": [0, 0, 9]}],
            "materials": [{"name": "m", "type": "lambert", "color": [1, 1, 1]}],
            "objects": [{"name": "o", "material": "m", )" +
        ball + "}]}");
    EXPECT_EQ(mistakes_of(scene.dump()), "");
    const bool is_item = of == LaterKey::Of::items;
    Json item = is_item ? scene.at(in)[0] : in.empty() ? scene : scene.at(in);
    item[key] = Json::array();
    const std::string name(key);
    std::string place = "/" + name;
    if (in.empty())
      scene = item;
    else if (is_item)
      scene[in] = Json::array({item});
    else
      scene[in] = item;
    if (!in.empty()) place = "/" + std::string(in) + (is_item ? "/0" : "") + place;
    EXPECT_EQ(mistakes_of(scene.dump()),
              "scene.json: " + place +
                  ": unknown key (it is one of version 2; write \"version\": 2 for it)");
    const Json* holder = &schema.at("then");
    if (!in.empty()) holder = &holder->at("properties").at(in);
    if (is_item) holder = &holder->at("items");
    EXPECT_EQ(holder->at("properties").at(key), Json(false)) << place;
  }
}

TEST_F(VersionTwo, includes_that_multiply_come_to_an_end) {
  for (int i = 0; i < 40; ++i) {
    const std::string next = "\"f" + std::to_string(i + 1) + ".json\"";
    folder_.write(
        "f" + std::to_string(i) + ".json",
        R"({"version": 2, "objects": [{"include": )" + next + R"(}, {"include": )" + next + "}]}");
  }
  folder_.write("f40.json", R"({"version": 2, "objects": []})");
  EXPECT_TRUE(has(mistakes_of(R"({"version": 2, "objects": [{"include": "f0.json"}]})"),
                  "must not bring the number of groups above 100000"));
}

TEST_F(VersionTwo, version_one_keeps_what_it_had) {
  const auto scene = [](const std::string& top, const std::string& of_object) {
    return R"({"version": 1, "camera": {"position": [0, -4, 2], "look_at": [0, 0, 0]}, "lights": [], )" +
           top + R"("materials": [{"name": "m", "type": "lambert", "color": [1, 1, 1]}],
           "objects": [{"name": "#ff0000", "material": "m", )" +
           ball + of_object + "}]}";
  };
  EXPECT_EQ(mistakes_of(scene("", "")), "");
  const std::pair<std::string, std::string> refused[] = {
      {scene(R"("include": "x.json", )", ""), "/include: unknown key (it is one of version 2"},
      {scene("", R"(, "color": "#ff0000")"),
       "/objects/0/color: unknown key (it is one of version 2"},
      {scene("", R"(, "transform": {"rotate": {"look_at": [1, 2, 3]}})"),
       "/objects/0/transform/rotate: must be a quaternion [x, y, z, w] (got an object; write "
       "\"version\": 2 for it)"},
      {scene(R"("background": "#ffffff", )", ""),
       "/background: must be a list of 3 numbers (got \"#ffffff\"; write \"version\": 2 for it)"},
      {"// mine\n" + scene("", ""), "/: not valid JSON at line:column 1:1: JSON has no comments"}};
  for (const auto& [text, expected] : refused)
    EXPECT_EQ(mistakes_of(text).substr(12, expected.size()), expected) << text;
}

}  // namespace
}  // namespace minkray
