// SPDX-License-Identifier: MIT
#include "renderer/share/merge.h"

#include <gtest/gtest.h>

#include <fstream>

#include "renderer/base/errors.h"
#include "renderer/io/output_file.h"
#include "renderer/scene_json/scene_json.h"
#include "tests/support/messages.h"
#include "tests/support/program.h"

namespace minkray {
namespace {

class Merge : public ::testing::Test {
 protected:
  Merge() {
    write_ball_scene(folder_ / "scene.json");
    scene_ = load_scene(folder_ / "scene.json");
    world_ = make_world(scene_);
    options_.resolution = {45, 32};
    options_.samples = 7;  // no power of two: every division rounds
  }

  /// Renders a share into a file, and answers its name.
  std::string part_file(const Share& tile, const Share& samples, std::uint64_t seed = 0) {
    RenderOptions options = options_;
    options.tile = tile;
    options.sample_share = samples;
    options.seed = seed;
    const Rendering rendering = render(scene_, world_, options);
    Facts facts = picture_facts(scene_, world_, options);
    facts[fact::tile] = tile.text();
    facts[fact::sample_share] = samples.text();
    facts[counts_fact] = counts_text(rendering.counts);
    const std::string file = folder_ / (std::to_string(++files_) + ".exr");
    write_file(file, encode_exr(exr_of(rendering, options, facts)));
    return file;
  }

  /// All part files, the last first.
  std::vector<std::string> part_files(int tiles, int shares) {
    std::vector<std::string> files;
    for (int tile = tiles; tile > 0; --tile)
      for (int share = shares; share > 0; --share)
        files.push_back(part_file({tile, tiles}, {share, shares}));
    return files;
  }

  /// Message of merging.
  static std::string complaint(const std::vector<std::string>& files) {
    return message_of<BadInput>([&] { merge_part_files(files, false); });
  }

  TemporaryFolder folder_;
  Scene scene_;
  World world_;
  RenderOptions options_;
  int files_ = 0;
};

TEST_F(Merge, any_split_gives_the_same_bits) {
  const Rendering whole = render(scene_, world_, options_);
  for (const auto& [tiles, shares] :
       {std::pair{1, 1}, {2, 1}, {7, 1}, {1, 2}, {1, 3}, {1, 7}, {4, 3}}) {
    const Merged merged = merge_part_files(part_files(tiles, shares), false);
    EXPECT_EQ(merged.image().pixels, whole.image.pixels) << tiles << " " << shares;
    EXPECT_EQ(std::get<std::vector<float>>(merged.exr.find("A")->values),
              coverage(whole.met, options_.samples));
    EXPECT_EQ(merged.counts.camera, whole.counts.camera);
    EXPECT_EQ(merged.counts.work.supports, whole.counts.work.supports);
    EXPECT_EQ(merged.missing, 0u);
  }
}

TEST_F(Merge, a_crop_may_be_split_too) {
  options_.crop = {11, 5, 40, 30};
  const Rendering whole = render(scene_, world_, options_);
  const Merged merged = merge_part_files(part_files(3, 2), false);
  EXPECT_EQ(merged.exr.window, options_.crop);
  EXPECT_EQ(merged.image().pixels, whole.image.pixels);
}

TEST_F(Merge, missing_shares_are_named) {
  std::vector<std::string> files = part_files(3, 1);
  files.erase(files.begin() + 1);
  EXPECT_TRUE(has(complaint(files), "missing: tile 2/3"));
  const Merged partial = merge_part_files(files, true);
  EXPECT_EQ(partial.missing, 1u);
  EXPECT_EQ(partial.missing_names, "tile 2/3");
  const PixelRect gap = tile_of(options_.picture(), {2, 3});
  const Rendering whole = render(scene_, world_, options_);
  const Image image = partial.image();
  const auto& alpha = std::get<std::vector<float>>(partial.exr.find("A")->values);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const bool is_missing = x >= gap.x0 && x < gap.x1 && y >= gap.y0 && y < gap.y1;
      EXPECT_EQ(image.at(x, y),
                is_missing ? Vec3<float>(Vec3<float>::Zero()) : whole.image.at(x, y));
      if (is_missing) {
        EXPECT_EQ(alpha[static_cast<std::size_t>(y * image.width + x)], 0);
      }
    }
}

// As many as a header claims, which may exceed the memory for their names.
TEST_F(Merge, of_very_many_missing_shares_the_first_are_named) {
  const std::string file = part_file({1, 1}, {1, 1});
  ExrImage exr = read_exr(file);
  exr.texts[fact::resolution] = "2048x1024";
  exr.texts[fact::crop] = "0,0,2048,1024";
  exr.texts[fact::samples] = "64";
  exr.texts[fact::tile] = "1/1048576";
  exr.texts[fact::sample_share] = "1/64";
  write_file(file, encode_exr(exr));
  const std::string message = complaint({file});
  EXPECT_TRUE(has(message, "samples 21/64 of tile 1/1048576 and 67108843 more"));
}

TEST_F(Merge, of_missing_samples_the_others_take_the_place) {
  const std::vector<std::string> files = {part_file({1, 1}, {2, 2})};
  EXPECT_TRUE(has(complaint(files), "missing: samples 1/2"));
  const Merged partial = merge_part_files(files, true);
  const Rendering whole = render(scene_, world_, options_);
  double sum = 0, sum_of_whole = 0;
  for (std::size_t i = 0; i < whole.image.pixels.size(); ++i) {
    sum += static_cast<double>(partial.image().pixels[i].sum());
    sum_of_whole += static_cast<double>(whole.image.pixels[i].sum());
  }
  EXPECT_NEAR(sum / sum_of_whole, 1, 0.02);
  EXPECT_NE(partial.image().pixels, whole.image.pixels);
}

TEST_F(Merge, part_files_of_different_pictures_are_refused) {
  const std::string first = part_file({1, 2}, {1, 1});
  EXPECT_TRUE(has(complaint({first, part_file({2, 2}, {1, 1}, 4)}), "minkray.seed is 4, not 0"));
  EXPECT_TRUE(has(complaint({first, part_file({2, 3}, {1, 1})}), "another split"));
  EXPECT_TRUE(has(complaint({first, part_file({1, 2}, {1, 1})}), "the same share"));
  options_.samples = 8;
  EXPECT_TRUE(has(complaint({first, part_file({2, 2}, {1, 1})}), "minkray.samples is 8, not 7"));
  options_.samples = 7;
  write_ball_scene(folder_ / "scene.json", 1.25);
  scene_ = load_scene(folder_ / "scene.json");
  world_ = make_world(scene_);
  const std::string other = part_file({2, 2}, {1, 1});
  const std::string said = complaint({first, other});
  EXPECT_TRUE(said.starts_with(other + ": ")) << said;
  EXPECT_TRUE(has(said, "minkray.scene is " + scene_.hash));
}

TEST_F(Merge, damaged_part_files_are_refused_by_name) {
  const std::string good = part_file({1, 2}, {1, 1}), damaged = part_file({2, 2}, {1, 1});
  std::filesystem::resize_file(damaged, std::filesystem::file_size(damaged) - 100);
  EXPECT_TRUE(complaint({good, damaged}).starts_with(damaged + ": ")) << complaint({good, damaged});
  std::ofstream(folder_ / "text.exr") << "no image";
  EXPECT_TRUE(complaint({folder_ / "text.exr"}).starts_with(folder_ / "text.exr"));
  EXPECT_TRUE(has(complaint({folder_ / "none.exr"}), "cannot be read: No such file"));
}

TEST(SceneHash, tells_scenes_and_their_meshes_apart) {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
  };
  const auto hash = [&] { return load_scene(folder / "scene.json").hash; };
  write("scene.json", R"({"version": 1,
    "camera": {"position": [0, -5, 1], "look_at": [0, 0, 0]}, "lights": [],
    "materials": [{"name": "matt", "type": "lambert", "color": [1, 1, 1]}],
    "objects": [{"name": "hull", "shape": {"type": "hull", "file": "a.obj"}, "material": "matt"}]})");
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n");
  const std::string before = hash();
  EXPECT_EQ(before.size(), 16u);
  EXPECT_EQ(hash(), before);
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1.0000000000000002\n");
  EXPECT_NE(hash(), before);
}

}  // namespace
}  // namespace minkray
