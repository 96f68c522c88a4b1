// SPDX-License-Identifier: MIT
// Pictures that come in passes: each pass is a picture of the samples so far, and the last one has
// the same bits as if all samples had been taken at once.
#include <gtest/gtest.h>

#include "renderer/film/render.h"
#include "tests/support/lit_ball.h"

namespace minkray {
namespace {

Scene ball_out_of_focus() {
  Scene scene = lit_ball({37, 29});
  scene.camera.aperture = 0.1;
  return scene;
}

RenderOptions options_for(const Scene& scene, int samples) {
  RenderOptions options;
  options.resolution = scene.camera.resolution;
  options.samples = samples;
  options.light_channels = true;
  return options;
}

TEST(Progressive, the_last_picture_has_the_same_bits_as_in_one_go) {
  const Scene scene = ball_out_of_focus();
  const World world = make_world(scene);
  for (const int samples : {1, 6, 16, 100})
    for (const double noise : {0.0, 0.1}) {
      RenderOptions options = options_for(scene, samples);
      options.noise = noise;
      const Rendering at_once = render(scene, world, options);
      RenderJournal journal;
      std::vector<int> passes;
      journal.passed = [&](const Rendering&, int so_far) { passes.push_back(so_far); };
      const Rendering in_passes = render(scene, world, options, {}, std::move(journal));
      EXPECT_TRUE(in_passes.complete);
      EXPECT_EQ(in_passes.image.pixels, at_once.image.pixels) << samples << " " << noise;
      EXPECT_EQ(in_passes.direct.pixels, at_once.direct.pixels);
      EXPECT_EQ(in_passes.variance.pixels, at_once.variance.pixels);
      EXPECT_EQ(in_passes.met, at_once.met);
      EXPECT_EQ(in_passes.counts.total(), at_once.counts.total());
      std::vector<int> doubling;
      for (int so_far = 1; so_far < samples; so_far *= 2) doubling.push_back(so_far);
      EXPECT_EQ(passes, doubling);
    }
}

TEST(Progressive, each_pass_is_a_picture_of_its_samples) {
  const Scene scene = ball_out_of_focus();
  const World world = make_world(scene);
  RenderJournal journal;
  int compared = 0;
  journal.passed = [&](const Rendering& so_far, int samples) {
    const Rendering alone = render(scene, world, options_for(scene, samples));
    EXPECT_EQ(so_far.met, alone.met);
    // Sums of other blocks are rounded elsewhere.
    for (std::size_t i = 0; i < alone.image.pixels.size(); ++i)
      EXPECT_NEAR((so_far.image.pixels[i] - alone.image.pixels[i]).norm(), 0,
                  1e-5 * (1 + alone.image.pixels[i].norm()));
    ++compared;
  };
  const RenderOptions options = options_for(scene, 100);
  render(scene, world, options, {}, std::move(journal));
  EXPECT_EQ(compared, 7);
}

// Pixels of tiles that are done, from a checkpoint, are left as they are.
TEST(Progressive, goes_on_where_a_checkpoint_ended) {
  const Scene scene = ball_out_of_focus();
  const World world = make_world(scene);
  const RenderOptions options = options_for(scene, 20);
  const Rendering whole = render(scene, world, options);
  RenderJournal journal;
  journal.begun = whole;
  journal.done.assign(TileGrid(options.region()).count(), false);
  journal.done[0] = true;
  std::size_t finished = 0;
  journal.finished = [&](const Rendering&, std::size_t) { ++finished; };
  journal.passed = [](const Rendering&, int) {};
  const std::size_t tiles = journal.done.size();
  const Rendering resumed = render(scene, world, options, {}, std::move(journal));
  EXPECT_EQ(resumed.image.pixels, whole.image.pixels);
  EXPECT_EQ(finished, tiles - 1);
}

TEST(LightChannels, direct_light_is_that_of_the_direct_integrator) {
  const Scene scene = ball_out_of_focus();
  const World world = make_world(scene);
  RenderOptions options = options_for(scene, 8);
  const Rendering all = render(scene, world, options);
  options.integrator.kind = IntegratorKind::direct;
  const Rendering direct = render(scene, world, options);
  EXPECT_EQ(all.direct.pixels, direct.image.pixels);
  EXPECT_EQ(direct.direct.pixels, direct.image.pixels);
  double indirect = 0;
  for (std::size_t i = 0; i < all.image.pixels.size(); ++i)
    indirect += (all.image.pixels[i] - all.direct.pixels[i]).mean();
  EXPECT_GT(indirect / static_cast<double>(all.image.pixels.size()), 5e-4);
}

// Compares the mean variance over pictures of other seeds with their actual differences. Samples
// of one pixel are spread evenly, so that it is slightly too large.
TEST(LightChannels, the_variance_is_about_how_pictures_differ) {
  const Scene scene = ball_out_of_focus();
  const World world = make_world(scene);
  RenderOptions options = options_for(scene, 16);
  const Rendering reference = render(scene, world, options_for(scene, 2048));
  double told = 0, seen = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    options.seed = seed;
    const Rendering one = render(scene, world, options);
    for (std::size_t i = 0; i < one.image.pixels.size(); ++i) {
      told += one.variance.pixels[i].x();
      const double off = one.image.pixels[i].x() - reference.image.pixels[i].x();
      seen += off * off;
    }
  }
  EXPECT_GT(told, 0.8 * seen);
  EXPECT_LT(told, 8 * seen);
}

}  // namespace
}  // namespace minkray
