// SPDX-License-Identifier: MIT
// An object hidden from the camera, from shadow rays or from scattered ones is absent for these.
#include <gtest/gtest.h>

#include "renderer/film/data_channels.h"
#include "renderer/film/render.h"
#include "renderer/scene_json/scene_json.h"
#include "renderer/scene_json/write_scene.h"

namespace minkray {
namespace {

/// A ball above a floor, in the sun; the floor's material, the ball's keys and other things.
std::string written_scene(const std::string& floor, const std::string& ball,
                          const std::string& others = "") {
  const std::string with_ball =
      ball.empty()
          ? ""
          : R"(, {"name": "ball", "shape": {"type": "sphere", "radius": 1}, )" + ball + "}";
  return R"({"version": 1, "camera": {"position": [0, -6, 6], "look_at": [0, 0, 0]},
    "lights": [{"type": "directional", "direction": [1, 0.5, -2], "color": [2, 2, 2]}],
    "background": {"zenith": [0.5, 0.6, 1], "nadir": [0.1, 0.1, 0.1]},
    "materials": [{"name": "matt", "type": "lambert", "color": [0.8, 0.7, 0.6]},
                  {"name": "ghost", "type": "lambert", "color": [0.8, 0.7, 0.6],
                   "visible_to": ["scattered", "shadow"]},
                  {"name": "lamp", "type": "emissive", "radiance": [1, 1, 1]},
                  {"name": "half lamp", "type": "mix", "materials": ["matt", "lamp"],
                   "amount": 0.5},
                  {"name": "mirror", "type": "glossy", "color": [1, 1, 1], "roughness": 0}],
    "objects": [{"name": "floor", "shape": {"type": "box", "half_extents": [9, 9, 0.5]},
                 "material": ")" +
         floor + R"(", "transform": {"translate": [0, 0, -1.5]}})" + with_ball + "]" + others + "}";
}

const std::string none, seen = R"("material": "matt")";

std::string visible_to(const std::string& names, const std::string& material = "matt") {
  return "\"material\": \"" + material + "\", \"visible_to\": [" + names + "]";
}

Scene read(const std::string& text) {
  Mistakes mistakes("x.json");
  auto scene = parse_scene(text, ".", mistakes);
  EXPECT_TRUE(scene) << mistakes.text();
  return scene.value_or(Scene());
}

std::string complaint(const std::string& ball) {
  Mistakes mistakes("x.json");
  EXPECT_FALSE(parse_scene(written_scene("matt", ball), ".", mistakes)) << ball;
  return mistakes.text();
}

constexpr int width = 60, height = 40;

Image picture(const std::string& text, IntegratorKind integrator) {
  const Scene scene = read(text);
  RenderOptions options;
  options.resolution = {width, height};
  options.samples = 4;
  options.integrator.kind = integrator;
  return render(scene, make_world(scene), options).image;
}

/// Number of equal pixels.
int alike(const Image& a, const Image& b) {
  int count = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) count += a.at(x, y) == b.at(x, y) ? 1 : 0;
  return count;
}

class VisibleTo : public ::testing::TestWithParam<IntegratorKind> {};

// Pictures of direct light follow no scattered rays.
TEST(VisibleToRays, hidden_from_all_rays_of_a_picture_it_is_not_there) {
  const Image without = picture(written_scene("matt", none), IntegratorKind::direct);
  const Image hidden =
      picture(written_scene("matt", visible_to(R"("scattered")")), IntegratorKind::direct);
  EXPECT_EQ(alike(without, hidden), width * height);
  EXPECT_LT(alike(without, picture(written_scene("matt", seen), IntegratorKind::direct)),
            width * height - 100);
}

TEST(VisibleToRays, hidden_from_shadow_rays_it_throws_no_shadow) {
  const auto direct = [](const std::string& ball) {
    return picture(written_scene("matt", ball), IntegratorKind::direct);
  };
  const Image without = direct(none), all = direct(seen);
  const Image lit = direct(visible_to(R"("camera", "scattered")"));
  int shaded = 0, of_ball = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool is_lit = lit.at(x, y) == without.at(x, y);
      // Pixels of the ball are no darker: the ball casts no shadow on itself, nor on the floor
      // next to it.
      EXPECT_TRUE(is_lit || (all.at(x, y).array() <= lit.at(x, y).array()).all()) << x << " " << y;
      of_ball += is_lit ? 0 : 1;
      shaded += is_lit && all.at(x, y) != without.at(x, y) ? 1 : 0;
    }
  EXPECT_GT(of_ball, 100);
  EXPECT_GT(shaded, 30);
}

// A mirror is lit by mirrored rays alone.
TEST_P(VisibleTo, hidden_from_scattered_rays_it_is_in_no_mirror) {
  const auto mirrored = [](const std::string& ball) {
    std::string text = written_scene("mirror", ball);
    const std::size_t sun = text.find("{\"type\": \"directional\"");
    text.replace(sun, text.find('}', sun) - sun + 1,
                 R"({"type": "environment", "zenith": [0.5, 0.6, 1], "nadir": [0.1, 0.1, 0.1]})");
    return picture(text, GetParam());
  };
  const Image without = mirrored(none), all = mirrored(seen);
  const Image no_vampire = mirrored(visible_to(R"("scattered", "shadow")"));
  const Image vampire = mirrored(visible_to(R"("camera", "shadow")"));
  int in_mirror = 0, of_ball = 0, only_in_mirror = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool is_ball = vampire.at(x, y) != without.at(x, y);
      of_ball += is_ball ? 1 : 0;
      in_mirror += !is_ball && all.at(x, y) != without.at(x, y) ? 1 : 0;
      only_in_mirror += is_ball && no_vampire.at(x, y) != all.at(x, y) ? 1 : 0;
      EXPECT_TRUE(is_ball || no_vampire.at(x, y) == all.at(x, y)) << x << " " << y;
    }
  EXPECT_GT(of_ball, 100);
  EXPECT_GT(in_mirror, 50);
  EXPECT_GT(only_in_mirror, 100);
}

INSTANTIATE_TEST_SUITE_P(Integrators, VisibleTo,
                         ::testing::Values(IntegratorKind::path, IntegratorKind::ambient),
                         [](const auto& kind) {
                           return kind.param == IntegratorKind::path ? "path" : "ambient";
                         });

TEST(VisibleToRays, of_a_material_and_of_particles_as_of_an_object) {
  const Image of_object =
      picture(written_scene("matt", visible_to(R"("scattered", "shadow")")), IntegratorKind::path);
  EXPECT_EQ(alike(of_object,
                  picture(written_scene("matt", R"("material": "ghost")"), IntegratorKind::path)),
            width * height);
  const std::string particles = R"(, "particles": [{"name": "balls",
      "shape": {"type": "sphere", "radius": 1}, "poses": [[0, 0, 0]], )";
  for (const std::string& more :
       {visible_to(R"("shadow", "scattered")"), std::string(R"("material": "ghost")"),
        visible_to(R"("shadow", "scattered", "camera")", "ghost")})
    EXPECT_EQ(alike(of_object, picture(written_scene("matt", none, particles + more + "}]"),
                                       IntegratorKind::path)),
              width * height)
        << more;
}

TEST(VisibleToRays, pictures_of_data_show_what_the_camera_sees) {
  const auto planes = [](const std::string& ball) {
    const Scene scene = read(written_scene("matt", ball));
    const World world = make_world(scene);
    RenderOptions options;
    options.resolution = {width, height};
    std::vector<std::vector<float>> values;
    for (const ExrPlane& plane :
         measure_data_channels(scene, world, parse_data_channels("Z,N,thickness"), options))
      values.push_back(std::get<std::vector<float>>(plane.values));
    return values;
  };
  EXPECT_EQ(planes(visible_to(R"("shadow", "scattered")")), planes(none));
  EXPECT_NE(planes(visible_to(R"("camera")")), planes(none));
}

TEST(VisibleToRays, survives_being_written) {
  const std::string text = written_scene("ghost", visible_to(R"("shadow", "camera")"));
  const Scene again = read(scene_text(read(text)));
  EXPECT_EQ(again.objects[1].visible_to, camera_rays | shadow_rays);
  EXPECT_EQ(again.objects[0].visible_to, all_ray_kinds);
  EXPECT_EQ(again.materials[1].visible_to, scattered_rays | shadow_rays);
  EXPECT_EQ(again.materials[0].visible_to, all_ray_kinds);
}

TEST(VisibleToRays, nobody_sees_what_lists_no_rays) {
  const std::string hidden = written_scene("matt", visible_to(""));
  EXPECT_EQ(read(hidden).objects[1].visible_to, 0);
  EXPECT_EQ(read(scene_text(read(hidden))).objects[1].visible_to, 0);
}

TEST(VisibleToRays, mistakes_are_told) {
  EXPECT_EQ(complaint(R"("material": "matt", "visible_to": "camera")"),
            "x.json: /objects/1/visible_to: must be a list of names of rays (got \"camera\")");
  EXPECT_EQ(complaint(visible_to(R"("camera", "shadows")")),
            "x.json: /objects/1/visible_to/1: must be the name of rays (got \"shadows\"; did you "
            "mean \"shadow\"?)");
  EXPECT_EQ(complaint(visible_to(R"("camera", "camera")")),
            "x.json: /objects/1/visible_to/1: duplicate (got \"camera\" again)");
  for (const std::string lamp : {"lamp", "half lamp"})
    EXPECT_EQ(complaint(visible_to(R"("camera", "shadow")", lamp)),
              "x.json: /objects/1/visible_to: must contain \"shadow\" and \"scattered\" for an "
              "emissive material (\"" +
                  lamp + "\")");
  EXPECT_TRUE(
      read(written_scene("matt", visible_to(R"("shadow", "scattered")", "lamp"))).objects.size());
}

}  // namespace
}  // namespace minkray
