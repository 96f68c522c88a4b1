// SPDX-License-Identifier: MIT
// Pixels that stop when their noise is low: they do stop, they are about as noisy as requested,
// and they stop at the same samples in any grouping.
#include <gtest/gtest.h>

#include "renderer/film/render.h"
#include "tests/support/lit_ball.h"

namespace minkray {
namespace {

/// There is much background.
Scene ball_and_background() {
  Scene scene = lit_ball({40, 30});
  scene.background = {Colour::Constant(0.3), Colour::Constant(0.3)};
  return scene;
}

Rendering rendering(const Scene& scene, int samples, double noise, std::uint64_t seed, int packet) {
  RenderOptions options;
  options.resolution = scene.camera.resolution;
  options.samples = samples;
  options.noise = noise;
  options.seed = seed;
  options.integrator.ray_group = packet;
  const World world = make_world(scene);
  return render(scene, world, options);
}

TEST(Noise, pixels_stop_when_they_are_quiet_and_not_before) {
  const Scene scene = ball_and_background();
  constexpr double noise = 0.04;
  const Rendering all = rendering(scene, 1024, 0, 1, 16);
  const Rendering quiet = rendering(scene, 1024, noise, 2, 16);
  EXPECT_LT(quiet.counts.camera, all.counts.camera / 2);
  EXPECT_GT(quiet.counts.camera, all.counts.camera / 100);
  double squares = 0;
  for (std::size_t i = 0; i < all.image.pixels.size(); ++i) {
    const double a = quiet.image.pixels[i].mean(), b = all.image.pixels[i].mean();
    squares +=
        std::pow((a - b) / std::max(b, 0.02), 2) / static_cast<double>(all.image.pixels.size());
  }
  EXPECT_LT(std::sqrt(squares), 1.5 * noise);
}

TEST(Noise, pixels_stop_at_the_same_samples_whatever_rays_go_together) {
  const Scene scene = ball_and_background();
  const Rendering one = rendering(scene, 200, 0.1, 3, 1);
  for (const int packet : {5, 16, 32}) {
    const Rendering many = rendering(scene, 200, 0.1, 3, packet);
    EXPECT_EQ(one.image.pixels, many.image.pixels);
    EXPECT_EQ(one.met, many.met);
    EXPECT_EQ(one.counts.camera, many.counts.camera);
  }
}

}  // namespace
}  // namespace minkray
