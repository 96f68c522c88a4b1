// SPDX-License-Identifier: MIT
// The progress line shows how noisy a picture is by now and how long it will take.
#include "renderer/jobs/progress_line.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/film/render.h"
#include "renderer/json/json.h"
#include "tests/support/lit_ball.h"
#include "tests/support/messages.h"
#include "tests/support/program.h"

namespace minkray {
namespace {

TEST(Progress, tells_the_time_left_and_the_noise) {
  EXPECT_EQ(progress_text(0.25, 3'000'000, 30, 0.0123),
            " 25.0 %  0.10 Mray/s  1:30 left  noise 1.2 %");
  EXPECT_EQ(progress_text(0.25, 3'000'000, 30, -1), " 25.0 %  0.10 Mray/s  1:30 left");
}

RenderOptions small_picture(int samples) {
  RenderOptions options;
  options.resolution = {40, 30};
  options.samples = samples;
  return options;
}

// The spread of samples that are drawn evenly overestimates the error, and never underestimates it
// much.
TEST(Progress, the_noise_is_about_the_error_of_the_picture) {
  const Scene scene = lit_ball({40, 30});
  const World world = make_world(scene);
  const Image truth = render(scene, world, small_picture(4096)).image;
  double message = -1;
  int times = 0;
  RenderWatch watch;
  watch.noise = [&](double noise) {
    message = noise;
    ++times;
  };
  watch.progress = [](double, std::uint64_t) {};
  const Rendering rendering = render(scene, world, small_picture(16), watch);
  double error = 0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i)
    error += std::abs(rendering.image.pixels[i].mean() - truth.pixels[i].mean()) /
             std::max(double{truth.pixels[i].mean()}, 0.02) /
             static_cast<double>(truth.pixels.size());
  EXPECT_EQ(times, 6);  // once per tile
  EXPECT_NEAR(message, rendering.noise, 1e-12);
  EXPECT_GT(rendering.noise, error);
  EXPECT_LT(rendering.noise, 6 * error);
  const Rendering finer = render(scene, world, small_picture(256));
  EXPECT_NEAR(finer.noise, rendering.noise / 4, 0.05 * rendering.noise);
}

TEST(Progress, of_single_samples_no_noise_is_told) {
  const Scene scene = lit_ball({40, 30});
  RenderWatch watch;
  watch.noise = [](double) { ADD_FAILURE(); };
  watch.progress = [](double, std::uint64_t) {};
  EXPECT_LT(render(scene, make_world(scene), small_picture(1), watch).noise, 0);
}

// Through util-linux's script, whose commands have a terminal.
TEST(Progress, a_terminal_sees_it_and_the_report_has_it) {
  const TemporaryFolder folder;
  write_ball_scene(folder / "ball.json");
  const std::string render = "\"$MINKRAY\" render '" + (folder / "ball.json") + "' -o '" +
                             (folder / "ball.png") + "' -t 1 --checkpoint 0 ";
  const ProgramOutcome report = run_shell(render + "-q -r 32x32 -s 4 --stats=json");
  ASSERT_EQ(report.exit_code, 0) << report.err;
  EXPECT_GT(Json::parse(report.out).at("noise").get<double>(), 0);
  if (!has_program("script")) GTEST_SKIP() << "no script here";
  const ProgramOutcome seen =
      run_shell("cat > '" + (folder / "run") + "' <<'END'\n" + render + "-r 512x512 -s 128\nEND\n" +
                "script -qec \"sh '" + (folder / "run") + "'\" /dev/null </dev/null");
  ASSERT_EQ(seen.exit_code, 0) << seen.err;
  EXPECT_TRUE(has(seen.out, " left  noise "));
}

}  // namespace
}  // namespace minkray
