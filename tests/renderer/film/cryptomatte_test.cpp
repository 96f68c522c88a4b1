// SPDX-License-Identifier: MIT
// Mattes by name: hashes as others have them, and coverage that is the picture's.
#include "renderer/film/cryptomatte.h"
#include "tests/support/messages.h"
#include "tests/support/shifted.h"

#include <gtest/gtest.h>

#include <cmath>

namespace minkray {
namespace {

TEST(Cryptomatte, hashes_are_those_of_murmur3) {
  EXPECT_EQ(cryptomatte_hash(""), 0u);
  EXPECT_EQ(cryptomatte_hash("hello"), 0x248bfa47u);
  EXPECT_EQ(cryptomatte_hash("hello, world"), 0x149bbb7fu);
  EXPECT_EQ(cryptomatte_hash("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
}

TEST(Cryptomatte, ids_are_normal_numbers) {
  for (int i = 0; i < 20000; ++i)
    EXPECT_TRUE(std::isnormal(cryptomatte_id("object " + std::to_string(i)))) << i;
}

TEST(Cryptomatte, covers_what_the_picture_covers) {
  Scene scene;
  scene.camera.position = {0, -6, 0};
  scene.materials = {{"matt", LambertMaterial{}}};
  for (const double x : {-0.7, 0.7})
    scene.objects.push_back({x < 0 ? "left" : "right", Sphere{0.8}, shifted_by(x, 0.1 * x, 0), 0});
  const World world = make_world(scene);
  RenderOptions options;
  options.resolution = {40, 30};
  options.samples = 37;
  const Rendering picture = render(scene, world, options);
  const Cryptomatte mattes = measure_cryptomatte(scene, world, options);
  ASSERT_EQ(mattes.planes.size(), 12u);
  EXPECT_EQ(mattes.planes[0].name, "CryptoObject00.R");
  EXPECT_EQ(mattes.planes[11].name, "CryptoObject02.A");
  const auto value = [&](std::size_t plane, std::size_t pixel) {
    return std::get<std::vector<float>>(mattes.planes[plane].values)[pixel];
  };
  int mixed = 0;
  for (std::size_t i = 0; i < picture.met.size(); ++i) {
    float covered = 0;
    for (std::size_t rank = 0; rank < 6; ++rank) {
      const float id = value(2 * rank, i), part = value(2 * rank + 1, i);
      EXPECT_TRUE(id == 0 || id == cryptomatte_id("left") || id == cryptomatte_id("right"));
      EXPECT_EQ(id == 0, part == 0);
      if (rank > 0) {
        EXPECT_LE(part, value(2 * rank - 1, i));
      }
      covered += part;
    }
    EXPECT_NEAR(covered, static_cast<float>(picture.met[i]) / 37, 1e-6);
    mixed += value(3, i) > 0 ? 1 : 0;
  }
  EXPECT_GT(mixed, 5);
  std::string all;
  for (const auto& [key, text] : mattes.texts) all += key + " " + text + "\n";
  expect_parts(all, {"/manifest {\"left\":", "/conversion uint32_to_float32"});
}

}  // namespace
}  // namespace minkray
