// SPDX-License-Identifier: MIT
// Things that move: where they are when, and how they are blurred while the shutter is open.
#include <gtest/gtest.h>

#include <numbers>

#include "renderer/film/render.h"
#include "renderer/rays/camera.h"
#include "renderer/scene_json/scene_json.h"
#include "tests/support/messages.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

/// A quaternion that turns about z.
std::array<double, 4> about_z(double angle) {
  return {0, 0, std::sin(angle / 2), std::cos(angle / 2)};
}

Shape rounded_box() {
  return Rounded{0.1, Shape(Box{{0.5, 0.3, 0.2}})};
}

/// A rounded box that flies and turns, a ball that rises, and a floor that does not move.
Scene flight(double shutter) {
  Scene scene;
  scene.camera.position = {0, -8, 3};
  scene.camera.shutter = shutter;
  scene.lights = {DirectionalLight{{-1, 1, -2}, {2, 2, 2}},
                  EnvironmentLight{{0.7, 0.8, 1.0}, {0.3, 0.3, 0.3}}};
  scene.materials = {{"matt", LambertMaterial{{0.7, 0.6, 0.5}}},
                     {"shiny", GlossyMaterial{{0.2, 0.3, 0.7}, 0.0, 1.5}}};
  scene.objects = {{"floor", Box{{20, 20, 1}}, shifted_by(0, 0, -2), 1},
                   {"box", rounded_box(), {}, 0},
                   {"ball", Sphere{0.5}, {}, 0}};
  // Tilted: where a normal is horizontal but for rounding, the frame that scattered rays are drawn
  // in may be one or the other.
  const Affine<double> tilt{rotation_matrix(0.2, 0.15, 0.0, 1.0), {0, 0, 0}};
  scene.objects[1].motion = Motion{{{0, {-2, 0, 0}, about_z(0)}, {1, {1, 1, 1}, about_z(2)}}, tilt};
  scene.objects[2].motion =
      Motion{{{0.25, {1, 0, 0}, {0, 0, 0, 1}}, {0.5, {1, 0, 1}, {0, 0, 0, 1}}}, {}};
  set_time(scene, 0);
  return scene;
}

RenderOptions coarse_picture() {
  RenderOptions options;
  options.resolution = {64, 48};
  options.samples = 4;
  return options;
}

TEST(Motion, passes_through_its_keys_and_stands_still_beyond_them) {
  const Affine<double> rest{Mat3<double>::Identity() * 2, {0.5, 0, 0}};
  const Motion motion{{{1, {1, 2, 3}, about_z(0.3)}, {3, {5, 2, 3}, about_z(1.3)}}, rest};
  const auto key = [&](double angle, const Vec3<double>& position) {
    return Affine<double>{rotation_matrix(0.0, 0.0, std::sin(angle / 2), std::cos(angle / 2)),
                          position} *
           rest;
  };
  const auto expect_near = [](const Affine<double>& a, const Affine<double>& b) {
    EXPECT_LT((a.linear - b.linear).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_LT((a.translation - b.translation).cwiseAbs().maxCoeff(), 4e-15);
  };
  expect_near(motion.pose_at(-7), key(0.3, {1, 2, 3}));
  expect_near(motion.pose_at(1), key(0.3, {1, 2, 3}));
  expect_near(motion.pose_at(1.5), key(0.55, {2, 2, 3}));
  expect_near(motion.pose_at(2), key(0.8, {3, 2, 3}));
  expect_near(motion.pose_at(3), key(1.3, {5, 2, 3}));
  expect_near(motion.pose_at(9), key(1.3, {5, 2, 3}));
}

TEST(Motion, turns_by_the_shorter_way_whatever_the_sign_of_the_quaternion) {
  auto far = about_z(1.0);
  for (double& entry : far) entry = -entry;
  const Motion one{{{0, {0, 0, 0}, about_z(0)}, {1, {0, 0, 0}, about_z(1.0)}}, {}};
  const Motion other{{{0, {0, 0, 0}, about_z(0)}, {1, {0, 0, 0}, far}}, {}};
  EXPECT_LT((one.pose_at(0.4).linear - other.pose_at(0.4).linear).norm(), 1e-15);
}

// Between two keys, and over the end of them.
TEST(Motion, while_the_shutter_is_open_things_go_and_turn_as_their_keys_say) {
  const Affine<double> rest{Mat3<double>::Identity() * 2, {0.5, -1, 0.25}};
  const Motion motion{{{1, {1, 2, 3}, {0.1, -0.7, 0.2, std::sqrt(0.46)}},
                       {3, {5, 2, 3}, {0.5, 0.5, -0.5, 0.5}},
                       {4, {5, 3, 3}, {-0.5, -0.5, 0.5, -0.5}}},
                      rest};
  for (const auto& [begin, end] : {std::pair{1.0, 3.0}, {1.3, 2.9}, {1.3, 1.300001}, {3.0, 4.0}}) {
    const Movement<double> movement = motion.movement(begin, end);
    const Affine<double> opening = motion.pose_at(begin);
    for (const double moment : {0.0, 0.2, 0.5, 1.0}) {
      const Affine<double> seen = movement.moved(opening, moment);
      const Affine<double> expected = motion.pose_at(begin + moment * (end - begin));
      EXPECT_LT((seen.linear - expected.linear).norm(), 1e-13) << begin << " " << moment;
      EXPECT_LT((seen.translation - expected.translation).norm(), 1e-13) << begin << " " << moment;
    }
  }
  EXPECT_EQ(motion.movement(3, 4).angle, 0);
  EXPECT_TRUE(motion.movement(5, 6).stands());
}

TEST(Motion, a_frame_with_a_closed_shutter_is_the_picture_of_the_scene_posed_at_that_time) {
  const double time = 0.4;
  Scene moving = flight(0);
  World world = make_world(moving);
  set_time(moving, time);
  follow(world, moving);

  Scene still = flight(0);
  for (Object& object : still.objects) {
    if (object.motion) object.pose = object.motion->pose_at(time);
    object.motion.reset();
  }
  const Image frame = render(moving, world, coarse_picture()).image;
  const Image picture = render(still, make_world(still), coarse_picture()).image;
  EXPECT_EQ(frame.pixels, picture.pixels);
  const Scene at_0 = flight(0);
  EXPECT_NE(frame.pixels, render(at_0, make_world(at_0), coarse_picture()).image.pixels);
}

// Frame after frame the hierarchy is refitted and at times rebuilt; no picture shows it.
TEST(Motion, a_frame_does_not_depend_on_the_frames_before_it) {
  Scene scene = flight(0.1);
  World world = make_world(scene);
  for (const double time : {0.1, 0.9, 0.3}) {
    set_time(scene, time);
    follow(world, scene);
  }
  const Image after_others = render(scene, world, coarse_picture()).image;
  EXPECT_EQ(after_others.pixels, render(scene, make_world(scene), coarse_picture()).image.pixels);
}

// The principle of the blur: at each moment a ray sees exactly what it would see if the moved
// things stayed there for good.
TEST(Motion, every_ray_of_a_blurred_picture_sees_the_scene_as_it_stands_at_its_moment) {
  Scene blurred = flight(0.5);
  set_time(blurred, 0.3);
  const World world = make_world(blurred);
  ASSERT_TRUE(world.instances().move());
  const Camera camera(blurred.camera, {64, 48});
  const Integrator integrator(blurred, world);
  int differ_from_open = 0, met = 0;
  for (const double moment : {0.0, 0.25, 0.8, 1.0}) {
    Scene still = blurred;
    for (Object& object : still.objects) {
      object.pose = object.movement.moved(object.pose, moment);
      object.movement = {};
      object.motion.reset();
    }
    const World still_world = make_world(still);
    ASSERT_FALSE(still_world.instances().move());
    const Integrator still_integrator(still, still_world);
    for (int y = 0; y < 48; ++y) {
      // Both alone and together with others.
      constexpr std::size_t at_once = 32;
      std::array<TracedRay, 64> together;
      RayCounts counts, still_counts;
      for (int x = 0; x < 64; ++x) {
        auto& ray = together[static_cast<std::size_t>(x)];
        ray.ray = camera.ray(x + 0.5, y + 0.5);
        ray.sampler = Sampler(1, x, y, 0);
        ray.time = moment;
      }
      for (std::size_t x = 0; x < together.size(); x += at_once)
        integrator.trace(std::span(together).subspan(x, at_once), counts);
      for (int x = 0; x < 64; ++x) {
        const Ray<double> ray = camera.ray(x + 0.5, y + 0.5);
        const auto seen = [&](const Integrator& by, RayCounts& of, double time) {
          TracedRay one{ray, Sampler(1, x, y, 0)};
          one.time = time;
          by.trace(std::span(&one, 1), of);
          return one.radiance;
        };
        const Colour alone = seen(integrator, counts, moment);
        const Colour expected = seen(still_integrator, still_counts, 0);
        EXPECT_EQ(alone, together[static_cast<std::size_t>(x)].radiance);
        // The origin moves instead of the shape: the last bits of a hit are others.
        EXPECT_LT((alone - expected).cwiseAbs().maxCoeff(), 1e-9) << moment << " " << x << " " << y;
        differ_from_open += seen(integrator, counts, 0) != alone ? 1 : 0;
      }
      met += static_cast<int>(still_counts.camera - still_counts.background);
    }
  }
  EXPECT_GT(met, 4000);
  EXPECT_GT(differ_from_open, 300);
}

TEST(Motion, a_moving_ball_is_blurred_into_the_mean_of_pictures_of_it_standing) {
  Scene scene = flight(0.2);
  scene.objects.erase(scene.objects.begin(), scene.objects.begin() + 2);
  set_time(scene, 0.27);
  RenderOptions options = coarse_picture();
  options.samples = 256;
  const Image blurred = render(scene, make_world(scene), options).image;

  constexpr int moments = 64;
  options.samples = 16;
  Image mean(64, 48);
  for (int i = 0; i < moments; ++i) {
    Scene still = scene;
    Object& ball = still.objects[0];
    ball.pose = ball.movement.moved(ball.pose, (i + 0.5) / moments);
    ball.movement = {};
    const Image picture = render(still, make_world(still), options).image;
    for (std::size_t p = 0; p < mean.pixels.size(); ++p)
      mean.pixels[p] += picture.pixels[p] / float(moments);
  }
  double largest = 0;
  for (std::size_t p = 0; p < mean.pixels.size(); ++p)
    largest = std::max(largest, double((mean.pixels[p] - blurred.pixels[p]).cwiseAbs().maxCoeff()));
  // Colours reach from about 0.2 to 1.5; what is left is the noise of 256 samples.
  EXPECT_LT(largest, 0.06);
  // The picture is blurred: different from one with the shutter closed.
  Scene sharp = scene;
  sharp.objects[0].movement = {};
  options.samples = 256;
  const Image open = render(sharp, make_world(sharp), options).image;
  double difference = 0;
  for (std::size_t p = 0; p < mean.pixels.size(); ++p)
    difference =
        std::max(difference, double((open.pixels[p] - blurred.pixels[p]).cwiseAbs().maxCoeff()));
  EXPECT_GT(difference, 0.3);
}

TEST(Motion, boxes_hold_all_of_the_way) {
  Scene scene = flight(0.5);
  const World world = make_world(scene);
  // Far beyond the box at the beginning, the ray meets the box at the end only.
  const Vec3<double> end = scene.objects[1].pose.translation + scene.objects[1].movement.shift;
  const Ray<double> ray{end + Vec3<double>(0, 0, 5), {0, 0, -1}};
  QueryCounts counts;
  EXPECT_EQ(world.closest_hit(ray, counts, no_instance, 1).instance, 1u);
  EXPECT_EQ(world.closest_hit(ray, counts, no_instance, 0).instance, 0u);
  EXPECT_EQ(world.closest_hit(ray, counts).instance, 0u);
}

/// The complaints about a scene whose only object has these keys.
std::string complaints(const std::string& keys) {
  const std::string text = R"({"version": 1,
    "camera": {"position": [0, -5, 1], "look_at": [0, 0, 0]}, "lights": [],
    "materials": [{"name": "matt", "type": "lambert", "color": [0.7, 0.7, 0.7]}],
    "objects": [{"name": "ball", "shape": {"type": "sphere", "radius": 1}, "material": "matt",
                 "keys": )" +
                           keys + "}]}";
  Mistakes mistakes("s.json");
  parse_scene(text, ".", mistakes);
  return message_of([&] { throw_if_any(mistakes); });
}

TEST(Motion, wrong_keys_are_told) {
  EXPECT_EQ(complaints(R"([{"time": 0}, {"time": 1, "translate": [0, 0, 1]}])"), "");
  const auto tells = [](const std::string& keys, const std::string& what) {
    EXPECT_TRUE(has(complaints(keys), what));
  };
  tells("[]", "/objects/0/keys: must be a list of at least one key");
  tells("3", "/objects/0/keys: must be a list of at least one key");
  tells(R"([{"time": 1}, {"time": 1}])",
        "/objects/0/keys/1/time: must be later than that of the key before (got 1 after 1");
  tells(R"([{"translate": [1, 2, 3]}])", "/objects/0/keys/0");
  tells(R"([{"time": 0, "rotate": [0, 0, 0, 0]}])",
        "/objects/0/keys/0/rotate: must be a quaternion [x, y, z, w] other than zero");
  tells(R"([{"time": 0, "scale": 2}])", "/objects/0/keys/0");
}

}  // namespace
}  // namespace minkray
