// SPDX-License-Identifier: MIT
// Materials, textures, skies and lenses in scene files: mistakes are reported all at once, and
// valid input survives being written and read again.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "renderer/io/image_file.h"
#include "renderer/io/png.h"
#include "renderer/io/read_image.h"
#include "renderer/scene_json/scene_json.h"
#include "renderer/scene_json/write_scene.h"
#include "tests/support/messages.h"
#include "tests/support/must_hold.h"
#include "tests/support/program.h"

namespace minkray {
namespace {

/// A folder with a few pictures in it.
class Pictures : public ::testing::Test {
 protected:
  Pictures() {
    Image sky(8, 4, Vec3<float>(0.5F, 2, 8));
    write("sky.exr", encode_image(sky, "sky.exr"));
    write("board.png", encode_image(Image(2, 2, Vec3<float>(0.5F, 0.25F, 1)), "board.png"));
    sky.at(3, 2).x() = std::numeric_limits<float>::quiet_NaN();
    write("nan.exr", encode_image(sky, "nan.exr"));
    write("broken.png", {'n', 'o', 'n', 'e'});
    write("text.txt", {'n', 'o', 'n', 'e'});
  }

  void write(const std::string& name, const std::vector<unsigned char>& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }

  /// A scene of these materials, lights and further keys of its camera.
  static std::string scene(const std::string& materials, const std::string& lights = "",
                           const std::string& camera = "") {
    return R"({"version": 1, "camera": {"position": [0, -4, 2], "look_at": [0, 0, 0])" + camera +
           R"(}, "lights": [)" + lights + R"(], "materials": [)" + materials +
           R"(], "objects": [{"name": "ball", "shape": {"type": "sphere", "radius": 1}, "material": "m",
            "transform": {"translate": [0, 1, 0]}}]})";
  }
  std::vector<std::string> complaints(const std::string& text) const {
    Mistakes mistakes("x.json");
    const auto read = parse_scene(text, folder_ / "", mistakes);
    EXPECT_EQ(read.has_value(), mistakes.none());
    return mistakes.messages();
  }

  TemporaryFolder folder_;
};

constexpr const char* matt = R"({"name": "m", "type": "lambert", "color": [1, 1, 1]})";

TEST_F(Pictures, all_mistakes_of_materials_are_told_at_once) {
  const auto found = complaints(scene(R"(
    {"name": "m", "type": "dielectric", "roughness": -0.1, "index_of_refraction": 0.5,
     "absorption": [0, -1, 0], "priority": "high"},
    {"name": "lamp", "type": "emissive", "radiance": [1, 2, -3]},
    {"name": "none", "type": "conductor"},
    {"name": "both", "type": "conductor", "metal": "gold", "color": [1, 1, 1]},
    {"name": "ore", "type": "conductor", "metal": "golt"},
    {"name": "mix", "type": "mix", "materials": ["m", "later"]},
    {"name": "later", "type": "principled", "base_color": [0.5, 0.5, 1.5], "coat": 2},
    {"name": "dots", "type": "lambert", "color": {"type": "dots"}},
    {"name": "turn", "type": "lambert", "color": {"type": "checker", "mapping": "around", "scale": 0}},
    {"name": "paper", "type": "translucent", "color": [1, 1, 1], "transmission": 1.5},
    {"name": "dent", "type": "lambert", "color": [1, 1, 1], "bump": [1, 1, 1], "bump_height": -1,
     "normal_map": {"type": "checker"}})"));
  const std::vector<std::string> places = {
      "/materials/0/roughness: must be >= 0 and <= 1 (got -0.1)",
      "/materials/0/index_of_refraction: must be >= 1 (got 0.5)",
      "/materials/0/absorption/1: must be >= 0 (got -1)",
      "/materials/0/priority: must be a number",
      "/materials/1/radiance/2: must be >= 0 and <= 1e15 (got -3)",
      "/materials/2: must have either \"metal\" or \"color\" (got neither)",
      "/materials/3: must have either \"metal\" or \"color\" (got both)",
      "/materials/4/metal: must be the name of a metal",
      "/materials/5/materials/1: must be the name of a material",
      "/materials/6/base_color/2: must be",
      "/materials/6/coat: must be",
      "/materials/7/color/type: must be the name of a texture",
      "/materials/8/color/mapping: must be the name of a mapping",
      "/materials/8/color/scale: must be > 0 (got 0)",
      "/materials/9/transmission: must be",
      "/materials/10/bump_height: must be >= 0 (got -1)"};
  EXPECT_EQ(found.size(), places.size());
  tell_figure("mistakes_of_materials_told_at_once", static_cast<double>(found.size()),
              "== " + std::to_string(places.size()));
  for (const std::string& place : places) EXPECT_TRUE(has(in_lines(found), place));
}

TEST_F(Pictures, reliefs_are_textures) {
  const auto found = complaints(scene(
      R"({"name": "m", "type": "lambert", "color": [1, 1, 1], "bump": [1, 1, 1],
          "normal_map": {"type": "checker"}})"));
  ASSERT_EQ(found.size(), 2u) << ::testing::PrintToString(found);
  EXPECT_TRUE(has(found[0], "/materials/0/bump: must be a texture"));
  EXPECT_TRUE(has(found[1], "/materials/0/normal_map: must be a texture of type"));
}

TEST_F(Pictures, numbers_that_are_none_are_refused) {
  EXPECT_FALSE(
      complaints(scene(R"({"name": "m", "type": "dielectric", "roughness": NaN})")).empty());
  EXPECT_FALSE(
      complaints(scene(R"({"name": "m", "type": "emissive", "radiance": [1e999, 0, 0]})")).empty());
}

TEST_F(Pictures, pictures_that_cannot_be_used_are_told_all_at_once) {
  const auto image = [](const char* name, const char* file) {
    return std::string(R"({"name": ")") + name +
           R"(", "type": "lambert", "color": {"type": "image", "file": ")" + file + R"("}})";
  };
  const auto found = complaints(scene(
      image("m", "missing.png") + "," + image("b", "broken.png") + "," + image("t", "text.txt"),
      R"({"type": "environment", "file": "nan.exr"}, {"type": "environment", "file": "gone.hdr"})"));
  ASSERT_EQ(found.size(), 5u) << ::testing::PrintToString(found);
  tell_figure("pictures_that_cannot_be_used_told_at_once", static_cast<double>(found.size()),
              "== 5");
  for (const auto& [place, what] : {std::pair{"/lights/0/file", "must hold finite numbers"},
                                    {"/lights/1/file", "gone.hdr"},
                                    {"/materials/0/color/file", "missing.png"},
                                    {"/materials/1/color/file", "cannot be read"},
                                    {"/materials/2/color/file", "must be one of .exr"}})
    EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                            [&](const std::string& message) {
                              return message.find(place) != std::string::npos &&
                                     message.find(what) != std::string::npos;
                            }))
        << place << " " << what;
}

TEST_F(Pictures, skies_and_lenses_are_checked) {
  const auto one = [&](const std::string& lights, const std::string& camera) {
    const auto found = complaints(scene(matt, lights, camera));
    return found.size() == 1 ? found[0] : ::testing::PrintToString(found);
  };
  expect_messages([&](const std::string& keys) { return one("", keys); },
                  {{R"(, "focus_on": "bell")", "did you mean \"ball\"?"},
                   {R"(, "focus_on": "ball", "focus_distance": 3)", "got both"},
                   {R"(, "type": "fisheye", "aperture": 1)", "/camera/aperture"},
                   {R"(, "type": "fish")", "the name of a camera"},
                   {R"(, "blades": 2)", "/camera/blades: must be 0 or a whole number from 3"},
                   {R"(, "fov_y_degrees": 180)", "must be > 0 and < 180 (got 180)"},
                   {R"(, "type": "fisheye", "fov_y_degrees": 361)", "<= 360 (got 361)"}});
  EXPECT_TRUE(complaints(scene(matt, "", R"(, "type": "fisheye", "fov_y_degrees": 220)")).empty());
  const std::string place = R"(, "latitude_degrees": 51, "longitude_degrees": 0)",
                    day = R"("type": "sun_sky")", noon = R"(, "time": "2026-06-21T12:00Z")";
  // A plain environment must still have both colours.
  expect_messages([&](const std::string& keys) { return one("{" + keys + "}", ""); },
                  {{day + R"(, "sun": [1, 0, -0.1])", "above the horizon"},
                   {day, "must have either \"sun\" or all of \"time\""},
                   {day + R"(, "sun": [0, 0, 1])" + noon, "either"},
                   {day + noon + R"(, "latitude_degrees": 51)", "either"},
                   {day + R"(, "time": "noon")" + place, "/lights/0/time: must be a time"},
                   {day + R"(, "time": "2026-06-21T00:00Z")" + place, "below the horizon"},
                   {R"("type": "environment", "zenith": [1, 1, 1])", "/lights/0/nadir"}});
  EXPECT_TRUE(complaints(scene(matt, "{" + day + noon + place + "}")).empty());
}

TEST_F(Pictures, what_is_written_is_read_as_the_same) {
  const std::string text = scene(
      R"({"name": "glass", "type": "dielectric", "absorption": [1, 2, 3], "priority": -2},
         {"name": "gold", "type": "conductor", "metal": "gold", "anisotropy": 0.5},
         {"name": "white", "type": "conductor", "color": [1, 1, 1]},
         {"name": "both", "type": "mix", "materials": ["glass", "gold"], "amount": 0.25},
         {"name": "leaf", "type": "translucent", "color": [0.2, 0.6, 0.1], "transmission": 0.7},
         {"name": "hammered", "type": "conductor", "metal": "copper", "bump": {"type": "noise", "scale": 0.2},
          "bump_height": 0.02, "normal_map": {"type": "image", "file": "board.png"}},
         {"name": "board", "type": "glossy", "color": {"type": "image", "file": "board.png", "mapping": "box"}},
         {"name": "m", "type": "principled", "base_color": {"type": "wood", "scale": 0.3}, "coat": 1})",
      R"({"type": "environment", "file": "sky.exr", "rotate_degrees": 30, "intensity": 2},
         {"type": "sun_sky", "sun": [1, 0, 1]},
         {"type": "sun_sky", "time": "2026-06-21T12:00Z", "latitude_degrees": 51, "longitude_degrees": 0})",
      R"(, "aperture": 0.1, "focus_on": "ball", "blades": 6)");
  Mistakes mistakes("x.json");
  const auto first = parse_scene(text, folder_ / "", mistakes);
  ASSERT_TRUE(first) << mistakes.text();
  EXPECT_TRUE(first->background_is_sky);
  EXPECT_NEAR(first->camera.focus, (5 * 4 + 2 * 2) / std::sqrt(20.0), 1e-12);
  EXPECT_EQ(std::get<ImageSkyLight>(first->lights[0]).strength, 2);
  EXPECT_EQ(std::get<MixMaterial>(first->materials[3].kind).materials.indices[1], 1u);
  const auto second = parse_scene(scene_text(*first), folder_ / "", mistakes);
  ASSERT_TRUE(second) << mistakes.text();
  EXPECT_EQ(scene_text(*first), scene_text(*second));
}

TEST_F(Pictures, of_20000_pixels_a_side_and_of_16_bits_in_grey_are_read_or_told) {
  const std::vector<std::uint8_t> row(3 * 20000, 255);
  write("wide.png", png_of(20000, 1, row));
  write("high.png", png_of(1, 20000, row));
  write("grey.png", png_of_grey16(2, 1, std::vector<std::uint16_t>{0, 32768}));
  EXPECT_EQ(read_image(folder_ / "wide.png").width, 20000);
  EXPECT_EQ(read_image(folder_ / "high.png").height, 20000);
  const Image grey = read_image(folder_ / "grey.png");
  EXPECT_EQ(grey.at(0, 0), Vec3<float>(0, 0, 0));
  EXPECT_NEAR(grey.at(1, 0).x(), 0.214F, 0.001);
  EXPECT_EQ(grey.at(1, 0).x(), grey.at(1, 0).z());

  // The header has a large size, and nothing follows.
  std::vector<unsigned char> large = png_of(1, 1, std::vector<std::uint8_t>(3));
  for (const std::size_t number : {16, 20}) {
    large[number + 2] = 20000 / 256;
    large[number + 3] = 20000 % 256;
  }
  write("large.png", large);
  const auto error_text = complaints(scene(
      R"({"name": "m", "type": "lambert", "color": {"type": "image", "file": "large.png"}},
         {"name": "n", "type": "glossy", "color": {"type": "image", "file": "none.png"}, "roughness": -1},
         {"name": "o", "type": "conductor", "metal": "gold", "roughness": 7})"));
  ASSERT_EQ(error_text.size(), 4u);
  EXPECT_TRUE(has(error_text[0], "must have at most 2^27 pixels (got 20000 x 20000)"));
}

TEST_F(Pictures, numbers_of_pictures_are_linear) {
  const Image board = read_image(folder_ / "board.png");
  EXPECT_NEAR(board.at(0, 0).x(), 0.5F, 0.005);
  EXPECT_NEAR(board.at(1, 1).y(), 0.25F, 0.005);
  EXPECT_EQ(read_image(folder_ / "sky.exr").at(0, 0), Vec3<float>(0.5F, 2, 8));
  // Radiance's format: a header, and four bytes per pixel with a common exponent.
  std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
  for (const int byte : {128, 64, 32, 129, 128, 128, 128, 132}) hdr += static_cast<char>(byte);
  write("two.hdr", {hdr.begin(), hdr.end()});
  const Image two = read_image(folder_ / "two.hdr");
  EXPECT_NEAR(two.at(0, 0).x(), 1, 0.01);
  EXPECT_NEAR(two.at(0, 0).z(), 0.25, 0.01);
  EXPECT_NEAR(two.at(1, 0).y(), 8, 0.01);
}

/// The first ended the program by a division by zero; skies of 1.7e38 were pictures of
/// infinities.
TEST_F(Pictures, of_no_pixels_or_beyond_all_brightness_are_refused) {
  const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
  for (const auto& [rest, what] :
       {std::pair<std::string, std::string>{"-Y 0 +X 0\n", "must have pixels (got 0 x 0)"},
        {"-Y 4 +X 0\n", "must have pixels (got 0 x 4)"},
        {"-Y 1 +X 1\n\xff\xff\xff\xff", "must hold finite numbers from 0 to 1e15"},
        {"-Y 1 +X 1\n\xff\xff\xff\xb4", "must hold finite numbers from 0 to 1e15"}}) {
    const std::string hdr = header + rest;
    write("bad.hdr", {hdr.begin(), hdr.end()});
    EXPECT_TRUE(has(message_of<std::exception>([&] { read_image(folder_ / "bad.hdr"); }), what));
  }
}

}  // namespace
}  // namespace minkray
