// SPDX-License-Identifier: MIT
#include "renderer/share/checkpoint.h"

#include <gtest/gtest.h>

#include <atomic>
#include <fstream>

#include "renderer/base/errors.h"
#include "renderer/scene_json/scene_json.h"
#include "tests/support/messages.h"
#include "tests/support/program.h"

namespace minkray {
namespace {

/// Short enough that every tile is followed by a checkpoint.
constexpr double always = 1e-9;

class CheckpointFile : public ::testing::Test {
 protected:
  CheckpointFile() {
    write_ball_scene(folder_ / "scene.json");
    scene_ = load_scene(folder_ / "scene.json");
    world_ = make_world(scene_);
    options_.resolution = {70, 50};
    options_.samples = 3;
    options_.integrator.ray_group = 4;
  }

  Checkpoint checkpoint(double seconds = always) {
    return {path_, options_, picture_facts(scene_, world_, options_), seconds};
  }

  /// Renders until the given number of packets was traced, and continues from an existing
  /// checkpoint.
  Rendering render_until(int asked_at_most, Checkpoint& checkpoint) {
    RenderJournal journal;
    if (checkpoint.exists()) journal = checkpoint.load();
    journal.finished = [&](const Rendering& rendering, std::size_t tile) {
      checkpoint.tile_finished(rendering, tile);
    };
    std::atomic<int> asked = 0;
    Rendering rendering = render(scene_, world_, options_,
                                 {{}, [&] { return ++asked > asked_at_most; }}, std::move(journal));
    if (!rendering.complete) checkpoint.interrupted(rendering);
    return rendering;
  }

  /// The picture after many interruptions.
  Rendering rendered_with_interruptions(int& interruptions) {
    for (interruptions = 0; interruptions < 1000; ++interruptions) {
      Checkpoint each = checkpoint();
      Rendering rendering = render_until(800, each);
      if (rendering.complete) {
        each.remove();
        return rendering;
      }
      EXPECT_EQ(each.complaint(), "");
    }
    return {};
  }

  TemporaryFolder folder_;
  const std::string path_ = folder_ / "x.png.checkpoint";
  Scene scene_;
  World world_;
  RenderOptions options_;
};

TEST_F(CheckpointFile, an_interrupted_picture_is_the_same_to_the_last_bit) {
  const Rendering whole = render(scene_, world_, options_);
  int interruptions = 0;
  const Rendering resumed = rendered_with_interruptions(interruptions);
  EXPECT_GT(interruptions, 2);
  EXPECT_EQ(resumed.image.pixels, whole.image.pixels);
  EXPECT_EQ(resumed.met, whole.met);
  EXPECT_EQ(resumed.counts.total(), whole.counts.total());
  EXPECT_EQ(resumed.counts.work.supports, whole.counts.work.supports);
  EXPECT_EQ(folder_.files(), std::vector<std::string>{"scene.json"});
}

TEST_F(CheckpointFile, so_is_a_share_of_the_samples_of_a_tile) {
  options_.tile = {2, 2};
  options_.sample_share = {2, 2};
  const Rendering whole = render(scene_, world_, options_);
  int interruptions = 0;
  const Rendering resumed = rendered_with_interruptions(interruptions);
  EXPECT_GT(interruptions, 0);
  ASSERT_EQ(resumed.block_sums.size(), whole.block_sums.size());
  for (std::size_t i = 0; i < whole.block_sums.size(); ++i)
    EXPECT_EQ(resumed.block_sums[i].pixels, whole.block_sums[i].pixels);
}

TEST_F(CheckpointFile, of_another_picture_is_refused_with_what_differs) {
  {
    Checkpoint first = checkpoint();
    render_until(800, first);
  }
  ASSERT_TRUE(std::filesystem::exists(path_));
  const auto complaint = [&] { return message_of<BadInput>([&] { checkpoint().load(); }); };
  EXPECT_EQ(complaint(), "");
  options_.samples = 4;
  options_.seed = 12;
  const std::string said = complaint();
  EXPECT_TRUE(said.starts_with(path_ + ": ")) << said;
  expect_parts(said, {"minkray.samples is 3, not 4", "minkray.seed is 0, not 12"});
  options_.samples = 3;
  options_.seed = 0;
  options_.tile = {1, 2};
  EXPECT_TRUE(has(complaint(), "minkray.tile is 1/1, not 1/2"));
  options_.tile = {};
  write_ball_scene(folder_ / "scene.json", 1.25);
  scene_ = load_scene(folder_ / "scene.json");
  EXPECT_TRUE(has(complaint(), "minkray.scene is "));
  std::ofstream(path_) << "torn";
  EXPECT_TRUE(complaint().starts_with(path_ + ": "));
}

TEST_F(CheckpointFile, of_a_short_render_is_never_written) {
  Checkpoint rare = checkpoint(1e6);
  render_until(800, rare);
  Checkpoint never = checkpoint(0);
  render_until(800, never);
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(CheckpointFile, that_cannot_be_written_ends_no_render) {
  Checkpoint nowhere(folder_ / "none/x.checkpoint", options_,
                     picture_facts(scene_, world_, options_), always);
  EXPECT_TRUE(render_until(1 << 30, nowhere).complete);
  EXPECT_TRUE(has(nowhere.complaint(), "none/x.checkpoint"));
}

}  // namespace
}  // namespace minkray
