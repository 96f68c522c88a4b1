// SPDX-License-Identifier: MIT
#include "renderer/data_channels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/camera.h"
#include "renderer/errors.h"

namespace minkray {
namespace {

constexpr double radius = 1.5;

/// A ball before a box, seen from outside.
Scene two_objects() {
  const auto at = [](double x, double y, double z) {
    return Affine<double>{Mat3<double>::Identity(), {x, y, z}};
  };
  Scene scene;
  scene.camera.position = {1, -6, 2};
  scene.camera.look_at = {0, 0, 0};
  scene.materials = {{"matt", LambertMaterial{}}};
  scene.objects = {{"box", Box<double>{{4, 0.5, 1}}, at(0, 4, 0), 0},
                   {"ball", Sphere<double>{radius}, at(0, 0, 0), 0}};
  return scene;
}

class DataChannels : public testing::Test {
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
  RenderWorld world_;
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
    const Vec3<double> spot = vector("P", i);
    EXPECT_LT((spot - ray.at(real("dist", i))).norm(), 1e-5);
    EXPECT_NEAR(real("Z", i), (spot - scene_.camera.position).dot(forward), 1e-5);
    EXPECT_NEAR(vector("N", i).norm(), 1, 1e-6);
    EXPECT_LT(vector("N", i).dot(ray.direction), 1e-6);
    if (id == 2) {
      EXPECT_NEAR(spot.norm(), radius, 1e-5);
      EXPECT_LT((vector("N", i) - spot / radius).norm(), 1e-5);
    }
    EXPECT_GE(real("gjk.gap", i), 0);
    EXPECT_GE(plane<std::uint32_t>("gjk.iterations")[i], 1u);
    EXPECT_GE(plane<std::uint32_t>("gjk.supports")[i], 1u);
  }
  EXPECT_GT(of_ball, 100);
  EXPECT_GT(of_box, 100);
  EXPECT_GT(of_nothing, 100);
}

TEST_F(DataChannels, of_a_tile_are_a_part_of_the_whole) {
  options_.tile = {3, 5};
  const auto planes = measure_data_channels(scene_, world_, parse_data_channels("Z"), options_);
  const PixelRect tile = options_.part();
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
    try {
      parse_data_channels(wrong);
      FAIL() << wrong;
    } catch (const WrongUsage& error) {
      for (const DataChannelDescription& channel : data_channels)
        EXPECT_NE(std::string(error.what()).find(channel.name), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace minkray
