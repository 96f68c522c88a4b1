// SPDX-License-Identifier: MIT
// Faults from outside: killed at any moment, disks that are full or cannot be written, readers
// that never come. In every case, a picture is the old one or the new one, and the user gets a
// message.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/renderer/cli/nothing_lost.h"
#include "tests/support/expect_exit.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

namespace fs = std::filesystem;

// Renders again and again to where a good picture is, and is killed after any time from none to a
// whole render's.
TEST_F(NothingLost, killed_at_any_moment_the_old_picture_is_there_or_the_new_one) {
  const std::string target = folder_ / "a.exr";
  const auto render = [&](const char* samples) {
    return start_minkray({"render", folder_ / "scene.json", "-o", target, "-s", samples, "-t", "1",
                          "--bounces", "0"});
  };
  using Clock = std::chrono::steady_clock;
  ASSERT_EQ(wait_for(render("1")), 0);
  const std::string old_picture = text_of_file(target);
  const auto begin = Clock::now();
  ASSERT_EQ(wait_for(render("32")), 0);
  const auto whole = Clock::now() - begin;
  ASSERT_NE(fs::file_size(target), old_picture.size());

  constexpr int rounds = 45;
  int old_ones = 0, new_ones = 0;
  for (int i = 0; i < rounds; ++i) {
    const int signal = std::array{SIGKILL, SIGTERM, SIGINT}[static_cast<std::size_t>(i) % 3];
    std::ofstream(target, std::ios::binary) << old_picture;
    const pid_t child = render("32");
    // The last rounds wait for the new picture, however busy the machine is.
    if (i < rounds - 8)
      std::this_thread::sleep_for(whole * i / (rounds - 8));
    else
      EXPECT_TRUE(wait_until([&] { return fs::file_size(target) != old_picture.size(); })) << i;
    ::kill(child, signal);
    const int status = wait_for(child);
    if (text_of_file(target) == old_picture) {
      ++old_ones;
      EXPECT_NE(status, 0) << i;
    } else {
      ++new_ones;  // whole: what is in it can be read again
      EXPECT_EQ(minkray("merge a.exr -o b.pfm").exit_code, 0) << i;
      fs::remove(folder_ / "b.pfm");
    }
    // SIGKILL leaves no time to tidy up.
    std::vector<std::string> files = folder_.files();
    std::erase_if(files, [](const std::string& name) {
      return name.starts_with(".a.exr.") && name.ends_with(".tmp");
    });
    EXPECT_EQ(files, (std::vector<std::string>{"a.exr", "scene.json"})) << i;
    if (signal != SIGKILL) {
      EXPECT_EQ(folder_.files(), files) << i;
    }
    for (const std::string& name : folder_.files())
      if (name.starts_with(".")) fs::remove(folder_ / name);
  }
  EXPECT_GT(old_ones, 5);
  EXPECT_GE(new_ones, 8);
}

// Each run is killed once it has written a checkpoint, and some time later; a render too short for
// two kills is made longer.
TEST_F(NothingLost, killed_again_and_again_a_render_ends_with_the_same_picture) {
  const std::string picture = folder_ / "a.pfm", checkpoint = picture + ".checkpoint";
  int kills = 0;
  for (int samples = 1000; kills < 2; samples *= 4) {
    ASSERT_LE(samples, 64000) << "however long it is, the render is over before it is killed";
    fs::remove(picture);
    const auto render = [&](const std::string& output, const std::vector<std::string>& more) {
      std::vector<std::string> arguments = {
          "render", folder_ / "scene.json", "-t",  "1", "-s", std::to_string(samples), "-o",
          output,   "--checkpoint",         "0.02"};
      arguments.insert(arguments.end(), more.begin(), more.end());
      return start_minkray(arguments);
    };
    ASSERT_EQ(wait_for(render(folder_ / "whole.pfm", {})), 0);
    for (kills = 0; kills < 200; ++kills) {
      const ino_t before = inode_of(checkpoint);
      const pid_t child = render(picture, {"--resume"});
      // Written under another name and renamed: a new checkpoint is another file. At the end it is
      // removed.
      wait_until([&] { return inode_of(checkpoint) != before || has_ended(child); });
      std::this_thread::sleep_for(std::chrono::milliseconds(10 * (kills % 20)));
      ::kill(child, kills % 2 ? SIGKILL : SIGTERM);
      if (wait_for(child) == 0) break;
      // Killed after the last step but one: the picture is there, and so is the checkpoint still.
      if (fs::exists(picture)) {
        EXPECT_EQ(text_of_file(picture), text_of_file(folder_ / "whole.pfm"));
        // A process that counts lines takes long to exit after its last step.
        if (!fs::exists(checkpoint)) break;
      }
    }
    EXPECT_EQ(text_of_file(picture), text_of_file(folder_ / "whole.pfm"));
    EXPECT_FALSE(fs::exists(checkpoint));
  }
}

TEST_F(NothingLost, a_checkpoint_of_another_picture_is_refused) {
  const pid_t child = start_minkray({"render", folder_ / "scene.json", "-o", folder_ / "a.png",
                                     "-s", "5000", "--checkpoint", "0.05"});
  EXPECT_TRUE(wait_until([&] { return fs::exists(folder_ / "a.png.checkpoint"); }));
  ::kill(child, SIGTERM);
  EXPECT_TRUE(WIFSIGNALED(wait_for(child)));
  expect_exit(3, minkray("render scene.json -o a.png -s 2 --resume"),
              {"a.png.checkpoint: is the checkpoint of another picture: "
               "minkray.samples is 5000, not 2"});
  EXPECT_TRUE(fs::exists(folder_ / "a.png.checkpoint"));
  expect_exit(0, minkray("render scene.json -o a.png -s 2"));
  EXPECT_FALSE(fs::exists(folder_ / "a.png.checkpoint"));
}

TEST_F(NothingLost, a_full_disk_costs_the_new_picture_and_not_the_old_one) {
  if (fs::exists("/dev/full")) {
    const ProgramOutcome full =
        shell("ln -s /dev/full full.png; \"$MINKRAY\" render scene.json -o full.png -s 1");
    EXPECT_EQ(full.exit_code, 4);
    EXPECT_TRUE(has(full.err, "full.png: No space left on device"));
    fs::remove(folder_ / "full.png");
  }
  // A limit of file sizes: some blocks can be written, and then no more.
  expect_exit(4,
              shell("echo old > a.pfm; ulimit -f 8; \"$MINKRAY\" render scene.json -o a.pfm -s 1"),
              {"a.pfm: File too large"});
  EXPECT_EQ(text_of_file(folder_ / "a.pfm"), "old\n");
  EXPECT_EQ(folder_.files(), (std::vector<std::string>{"a.pfm", "scene.json"}));
}

TEST_F(NothingLost, a_full_file_system_as_well) {
  const ProgramOutcome mounted = shell("mkdir small && mount -t tmpfs -o size=16k minkray small");
  if (mounted.exit_code != 0) GTEST_SKIP() << "may not mount a tmpfs";
  const ProgramOutcome full = shell(
      "echo old > small/a.pfm; \"$MINKRAY\" render scene.json -o small/a.pfm -s 1; code=$?; "
      "cat small/a.pfm; ls -A small; exit $code");
  expect_exit(0, shell("umount small"));
  EXPECT_EQ(full.exit_code, 4);
  EXPECT_TRUE(has(full.err, "small/a.pfm: No space left on device"));
  EXPECT_EQ(full.out, "old\na.pfm\n");
}

TEST_F(NothingLost, a_folder_that_cannot_be_written_is_told_before_the_render) {
  fs::create_directory(folder_ / "locked");
  std::string target = folder_ / "locked/a.png";
  bool is_mount = false;
  if (::geteuid() == 0) {  // whom no rights stop
    is_mount = shell("mount -t tmpfs -o ro minkray locked").exit_code == 0;
    if (!is_mount) GTEST_SKIP() << "root, and may not mount a read-only tmpfs";
  } else {
    ::chmod((folder_ / "locked").c_str(), 0500);
  }
  expect_exit(4, minkray("render scene.json -o locked/a.png -s 16777216"), {"locked/a.png: "});
  if (is_mount) {
    expect_exit(0, shell("umount locked"));
  }
  ::chmod((folder_ / "locked").c_str(), 0700);
}

// Ctrl-C ends a render that waits for a pipe's reader.
TEST_F(NothingLost, a_pipe_that_nobody_reads_can_be_left) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe.png").c_str(), 0600), 0);
  const ProgramOutcome read = shell(
      "timeout 20 \"$MINKRAY\" render scene.json -o pipe.png -s 1 & "
      "timeout 20 cat pipe.png | head -c 4; wait");
  EXPECT_EQ(read.out.substr(1, 3), "PNG");
  const pid_t child =
      start_minkray({"render", folder_ / "scene.json", "-o", folder_ / "pipe.png", "-s", "1"});
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  ::kill(child, SIGINT);
  int status = 0;
  for (int i = 0; i < 500 && ::waitpid(child, &status, WNOHANG) == 0; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGINT);
  if (status == 0) {
    ::kill(child, SIGKILL);
    wait_for(child);
  }
}

}  // namespace
}  // namespace minkray
