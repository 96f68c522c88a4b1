// SPDX-License-Identifier: MIT
// Pictures that were rendered in tiles, or interrupted and resumed, are the same as of one run, and
// other programs read them.
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>

#include "renderer/io/exr.h"
#include "renderer/scene_json/scene_json.h"
#include "tests/renderer/cli/nothing_lost.h"
#include "tests/support/expect_exit.h"

namespace minkray {
namespace {

namespace fs = std::filesystem;

TEST_F(NothingLost, tiles_are_rendered_once_and_merged_to_the_same_picture) {
  expect_exit(0, shell(R"(set -e
    "$MINKRAY" render scene.json -s 3 -o whole.exr -o whole.png -o whole.pfm --aov all
    for i in 1 2 3; do "$MINKRAY" render scene.json -s 3 --tile $i/3 -o $i.exr --aov all; done
    "$MINKRAY" render scene.json -s 3 --tile 2/3 -o 2.exr --aov all --resume
    "$MINKRAY" merge 3.exr 1.exr 2.exr -o merged.exr -o merged.png -o merged.pfm
    cmp whole.png merged.png; cmp whole.pfm merged.pfm
    "$MINKRAY" merge merged.exr -o x.png 2> refused && exit 1; cat refused >&2
    if "$MINKRAY" render scene.json -s 4 --tile 2/3 -o 2.exr --aov all --resume; then exit 1; fi)"),
              {"2.exr: exists; not rendered again",
               "2.exr: is of another picture: minkray.samples is 3, not 4"});
}

// Equal except for the time, the number of threads, and the command. A render that is over before
// it can be interrupted is repeated with more samples.
TEST_F(NothingLost, resumed_data_channels_are_the_same_on_any_number_of_threads) {
  int samples = 600;
  const auto render = [&](const std::string& output, const std::string& threads,
                          const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render", folder_ / "scene.json",
                                          "-s",     std::to_string(samples),
                                          "-o",     output,
                                          "--aov",  "all",
                                          "-t",     threads};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return start_minkray(arguments);
  };
  const std::string picture = folder_ / "a.exr", checkpoint = picture + ".checkpoint";
  for (;; samples *= 4) {
    ASSERT_LE(samples, 38400) << "however long it is, the render is over before it is interrupted";
    const pid_t child = render(picture, "1", {"--checkpoint", "0.01"});
    EXPECT_TRUE(wait_until([&] { return fs::exists(checkpoint) || has_ended(child); }));
    ::kill(child, SIGTERM);
    if (wait_for(child) != 0 && fs::exists(checkpoint) && !fs::exists(picture)) break;
    fs::remove(picture);
    fs::remove(checkpoint);
  }
  ASSERT_EQ(wait_for(render(folder_ / "whole.exr", "3", {})), 0);
  ASSERT_EQ(wait_for(render(picture, "2", {"--resume"})), 0);
  const auto read = [](const std::string& file) {
    ExrImage exr = read_exr(file);
    for (const char* name : {"command", "seconds", "cpu_seconds", "threads"})
      EXPECT_EQ(exr.texts.erase(std::string("minkray.") + name), 1u) << name;
    return exr;
  };
  const ExrImage resumed = read(picture), whole = read(folder_ / "whole.exr");
  EXPECT_EQ(resumed.texts, whole.texts);
  EXPECT_EQ(resumed.window, whole.window);
  ASSERT_EQ(resumed.planes.size(), whole.planes.size());
  EXPECT_GT(whole.planes.size(), 10u);
  for (std::size_t i = 0; i < whole.planes.size(); ++i) {
    EXPECT_EQ(resumed.planes[i].name, whole.planes[i].name);
    EXPECT_TRUE(resumed.planes[i].values == whole.planes[i].values) << whole.planes[i].name;
  }
}

TEST_F(NothingLost, other_programs_read_the_files) {
  const std::string command = "render scene.json -s 2 --seed 7 -o a.exr --aov all";
  ASSERT_EQ(minkray(command).exit_code, 0);
  if (!has_program("exrheader") && !has_program("iinfo"))
    GTEST_SKIP() << "needs exrheader (openexr) or iinfo (openimageio-tools)";
  if (has_program("exrheader")) {
    const std::string header = shell("exrheader a.exr").out;
    std::string version = minkray("--version").out;
    version.erase(version.find_last_not_of('\n') + 1);
    const auto text = [](const std::string& name, const std::string& value) {
      return "\n" + name + " (type string): \"" + value + "\"\n";
    };
    const std::string hash = load_scene(folder_ / "scene.json").hash;
    EXPECT_EQ(hash.size(), 16u);
    expect_parts(header,
                 {std::string("dataWindow (type box2i): (0 0) - (63 47)"),
                  std::string("id.object, 32-bit unsigned integer"),
                  std::string("gjk.gap, 32-bit floating-point"), text("minkray.seed", "7"),
                  text("minkray.samples", "2"), text("minkray.resolution", "64x48"),
                  text("minkray.crop", "0,0,64,48"), text("minkray.bounces", "1"),
                  text("minkray.scene", hash), text("minkray.command", "minkray " + command),
                  text("software", version)});
  }
  if (has_program("iinfo")) {
    const std::string info = shell("iinfo -v --stats a.exr").out;
    expect_parts(info, {"17 channel", "Stats NanCount: 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0"});
  }
}

}  // namespace
}  // namespace minkray
