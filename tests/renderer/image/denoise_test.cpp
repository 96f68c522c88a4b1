// SPDX-License-Identifier: MIT
// Noise goes, edges and what is certain stay.
#include "renderer/image/denoise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/parallel/parallel.h"
#include "renderer/rays/sampler.h"

namespace minkray {
namespace {

constexpr int size = 64;
constexpr float noise = 0.2F;

/// Two walls that meet in the middle, each with a checkerboard and light that fades along y.
struct Walls {
  NoisyPicture noisy;
  Image truth;

  Walls() : truth(size, size) {
    noisy.light = noisy.variance = noisy.albedo = noisy.normal = truth;
    noisy.depth.assign(truth.pixels.size(), 5.0F);
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const bool is_left = x < size / 2;
        const float albedo = (x / 4 + y / 4) % 2 == 0 ? 0.8F : 0.3F;
        const float light = (is_left ? 1.0F : 0.25F) * (0.5F + static_cast<float>(y) / size);
        noisy.albedo.at(x, y).setConstant(albedo);
        noisy.normal.at(x, y) = is_left ? Vec3<float>(1, 0, 0) : Vec3<float>(0, 1, 0);
        truth.at(x, y).setConstant(albedo * light);
        // Half as much again or half as much, in the mean nothing.
        Sampler sampler(1, x, y, 0);
        const auto u = static_cast<float>(sampler.next()[0]);
        const float spread = noise * albedo * light;
        noisy.light.at(x, y) = truth.at(x, y).array() + spread * std::sqrt(12.0F) * (u - 0.5F);
        noisy.variance.at(x, y).setConstant(spread * spread);
      }
  }

  static double error(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
      sum += (a.pixels[i] - b.pixels[i]).cast<double>().squaredNorm();
    return std::sqrt(sum);
  }
};

TEST(Denoise, a_quarter_of_the_noise_is_left_and_edges_stay) {
  const Walls walls;
  const Image result = denoised(walls.noisy);
  EXPECT_LT(Walls::error(result, walls.truth), 0.25 * Walls::error(walls.noisy.light, walls.truth));
  // On both sides of the edge, and of the checkerboard's fields.
  for (int y = 2; y < size; y += 5)
    for (const int x : {size / 2 - 1, size / 2})
      EXPECT_NEAR(result.at(x, y).x() / walls.truth.at(x, y).x(), 1, 0.25) << x << " " << y;
}

TEST(Denoise, what_is_certain_stays) {
  Walls walls;
  walls.noisy.light = walls.truth;
  for (Vec3<float>& variance : walls.noisy.variance.pixels) variance.setZero();
  const Image result = denoised(walls.noisy);
  for (std::size_t i = 0; i < result.pixels.size(); ++i)
    EXPECT_NEAR(result.pixels[i].x() / walls.truth.pixels[i].x(), 1, 1e-3);
}

TEST(Denoise, a_lone_bright_speck_goes) {
  Walls walls;
  walls.noisy.light.at(10, 20).setConstant(1000);
  walls.noisy.variance.at(10, 20).setConstant(1e6F);
  const Image result = denoised(walls.noisy);
  EXPECT_NEAR(result.at(10, 20).x() / walls.truth.at(10, 20).x(), 1, 0.5);
}

TEST(Denoise, the_bits_do_not_depend_on_the_number_of_threads) {
  const Walls walls;
  Image one, many;
  with_threads(1, [&] { one = denoised(walls.noisy); });
  with_threads(5, [&] { many = denoised(walls.noisy); });
  EXPECT_EQ(one.pixels, many.pixels);
}

}  // namespace
}  // namespace minkray
