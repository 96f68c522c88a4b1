// SPDX-License-Identifier: MIT
#include "renderer/film/data_channels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/cast/cast.h"
#include "renderer/base/errors.h"
#include "renderer/rays/camera.h"
#include "tests/support/messages.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

constexpr double radius = 1.5;

/// A ball before a box, seen from outside.
Scene two_objects() {
  const auto at = [](double x, double y, double z) { return shifted_by(x, y, z); };
  Scene scene;
  scene.camera.position = {1, -6, 2};
  scene.camera.look_at = {0, 0, 0};
  scene.materials = {{"matt", LambertMaterial{}}};
  scene.objects = {{"box", Box{{4, 0.5, 1}}, at(0, 4, 0), 0},
                   {"ball", Sphere{radius}, at(0, 0, 0), 0}};
  return scene;
}

class DataChannels : public ::testing::Test {
 protected:
  DataChannels() : scene_(two_objects()), world_(make_world(scene_)) {
    options_.resolution = {48, 36};
    planes_ = measure_data_channels(scene_, world_, parse_data_channels("all"), options_);
  }

  template <class Number>
  const std::vector<Number>& plane(const std::string& name) const {
    for (const ExrPlane& plane : planes_)
      if (plane.name == name) return std::get<std::vector<Number>>(plane.values);
    throw std::runtime_error("no plane " + name);
  }
  double real(const std::string& name, std::size_t i) const {
    return static_cast<double>(plane<float>(name)[i]);
  }
  Vec3<double> vector(const std::string& name, std::size_t i) const {
    return {real(name + ".X", i), real(name + ".Y", i), real(name + ".Z", i)};
  }

  Scene scene_;
  World world_;
  RenderOptions options_;
  std::vector<ExrPlane> planes_;
};

TEST_F(DataChannels, are_those_of_the_ray_through_the_pixels_centre) {
  const Camera camera(scene_.camera, options_.resolution);
  const Vec3<double> forward = unit<double>(scene_.camera.look_at - scene_.camera.position);
  int of_ball = 0, of_box = 0, of_nothing = 0;
  for (std::size_t i = 0; i < plane<float>("Z").size(); ++i) {
    const Ray<double> ray =
        camera.ray(static_cast<double>(i % 48) + 0.5, static_cast<double>(i / 48) + 0.5);
    const std::uint32_t id = plane<std::uint32_t>("id.object")[i];
    const std::uint32_t status = plane<std::uint32_t>("status")[i];
    ASSERT_LE(id, 2u);
    if (id == 0) {
      ++of_nothing;
      EXPECT_EQ(status, 0u);
      EXPECT_TRUE(std::isinf(real("Z", i)) && std::isinf(real("dist", i)));
      EXPECT_TRUE(vector("N", i).isZero(0) && vector("P", i).isZero(0));
      EXPECT_EQ(real("gjk.gap", i), 0);
      continue;
    }
    EXPECT_EQ(status, 1u);
    ++(id == 1 ? of_box : of_ball);
    // Numbers are rounded to floats: 1e-6 of coordinates of up to 11.
    const Vec3<double> hit_point = vector("P", i);
    EXPECT_LT((hit_point - ray.at(real("dist", i))).norm(), 1e-5);
    EXPECT_NEAR(real("Z", i), (hit_point - scene_.camera.position).dot(forward), 1e-5);
    EXPECT_NEAR(vector("N", i).norm(), 1, 1e-6);
    EXPECT_LT(vector("N", i).dot(ray.direction), 1e-6);
    if (id == 2) {
      EXPECT_NEAR(hit_point.norm(), radius, 1e-5);
      EXPECT_LT((vector("N", i) - hit_point / radius).norm(), 1e-5);
    }
    EXPECT_GE(real("gjk.gap", i), 0);
    // Closed forms answer for both, and cost neither.
    EXPECT_EQ(plane<std::uint32_t>("gjk.iterations")[i], 0u);
    EXPECT_EQ(plane<std::uint32_t>("gjk.supports")[i], 0u);
  }
  EXPECT_GT(of_ball, 100);
  EXPECT_GT(of_box, 100);
  EXPECT_GT(of_nothing, 100);
}

/// One object is cast at by the paper's solver, which has iterations to show and bounds that are
/// apart: the channels equal a cast from the pixel's centre, number by number.
TEST(DataChannelsOfOneCast, are_its_iterations_supports_gap_and_status) {
  Scene scene;
  scene.camera.position = {1, -6, 2};
  scene.camera.look_at = {0, 0, 0};
  scene.materials = {{"matt", LambertMaterial{}}};
  const Shape shape = Ellipsoid{{2, 0.5, 1}};
  scene.objects = {{"egg", shape, shifted_by(0, 0, 0), 0}};
  CastOptions cast_options;
  cast_options.solver = &solver::gjk_alone;
  RenderOptions options;
  options.resolution = {32, 24};
  const std::vector<std::string_view> names =
      parse_data_channels("gjk.iterations,gjk.supports,gjk.gap,status");
  std::set<std::uint32_t> statuses, iterations;
  const auto check = [&] {
    const auto planes =
        measure_data_channels(scene, make_world(scene, cast_options), names, options);
    const auto number = [&](std::size_t plane, std::size_t pixel) {
      return std::get<std::vector<std::uint32_t>>(planes[plane].values)[pixel];
    };
    const PreparedShape prepared(shape);
    const Camera camera(scene.camera, options.resolution);
    for (std::size_t i = 0; i < 32 * 24; ++i) {
      const Ray<double> ray =
          camera.ray(static_cast<double>(i % 32) + 0.5, static_cast<double>(i / 32) + 0.5);
      const CastResult<double> cast = cast_ray(prepared, ray, cast_options);
      const bool is_asked = number(1, i) > 0;  // rays past the bounds are not cast
      if (!is_asked) {
        EXPECT_NE(cast.status, Status::hit) << i;
        EXPECT_EQ(number(3, i), 0u) << i;
        continue;
      }
      EXPECT_EQ(number(3, i), cast.status == Status::miss     ? 0u
                              : cast.status == Status::hit    ? 1u
                              : cast.status == Status::inside ? 2u
                                                              : 3u);
      EXPECT_EQ(number(0, i), static_cast<std::uint32_t>(cast.iterations)) << i;
      EXPECT_EQ(number(1, i), static_cast<std::uint32_t>(cast.supports)) << i;
      const double gap = cast.status == Status::hit ? cast.offset_hi - cast.offset_lo : 0;
      EXPECT_EQ(std::get<std::vector<float>>(planes[2].values)[i], static_cast<float>(gap)) << i;
      statuses.insert(number(3, i));
      iterations.insert(number(0, i));
    }
  };
  check();
  EXPECT_EQ(statuses, (std::set<std::uint32_t>{0, 1}));
  EXPECT_GT(iterations.size(), 3u);
  cast_options.max_iterations = 2;  // does not converge
  check();
  EXPECT_TRUE(statuses.contains(3u));
  cast_options.max_iterations = CastOptions().max_iterations;
  scene.camera.position = {0.1, 0.1, 0.1};  // from within
  check();
  EXPECT_EQ(statuses, (std::set<std::uint32_t>{0, 1, 2, 3}));
}

TEST_F(DataChannels, of_a_tile_are_a_part_of_the_whole) {
  options_.tile = {3, 5};
  const auto planes = measure_data_channels(scene_, world_, parse_data_channels("Z"), options_);
  const PixelRect tile = options_.region();
  const auto& values = std::get<std::vector<float>>(planes.at(0).values);
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x)
      EXPECT_EQ(values[static_cast<std::size_t>((y - tile.y0) * tile.width() + x - tile.x0)],
                plane<float>("Z")[static_cast<std::size_t>(y * 48 + x)]);
}

TEST(DataChannelNames, are_known_or_an_error_that_lists_them) {
  EXPECT_EQ(parse_data_channels("Z,N,Z"), (std::vector<std::string_view>{"Z", "N"}));
  EXPECT_EQ(parse_data_channels("all").size(), data_channels.size());
  for (const char* wrong : {"", "z", "Z,", "N.X", "Z,,N", "depth"}) {
    const std::string message = message_of<WrongUsage>([&] { parse_data_channels(wrong); });
    for (const DataChannelDescription& channel : data_channels)
      EXPECT_TRUE(has(message, channel.name)) << wrong;
  }
}

}  // namespace
}  // namespace minkray
