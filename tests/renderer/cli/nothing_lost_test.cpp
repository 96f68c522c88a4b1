// SPDX-License-Identifier: MIT
// Faults from outside: killed at any moment, disks that are full or cannot be written, files that
// are none. Whatever happens, a picture is the old one or the new one, and the user is told.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

#include "renderer/io/exr.h"
#include "renderer/scene/scene_json.h"
#include "tests/renderer/cli/nothing_lost.h"
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
      EXPECT_EQ(shell("\"$MINKRAY\" merge a.exr -o b.pfm").exit_code, 0) << i;
      fs::remove(folder_ / "b.pfm");
    }
    // SIGKILL leaves no time to tidy up.
    std::vector<std::string> files = folder_.files();
    std::erase_if(files, [](const std::string& name) {
      return name.starts_with(".a.exr.") && name.ends_with(".part");
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
      // Written beside and renamed: a new checkpoint is another file. At the end it is removed.
      wait_until([&] { return inode_of(checkpoint) != before || has_ended(child); });
      std::this_thread::sleep_for(std::chrono::milliseconds(10 * (kills % 20)));
      ::kill(child, kills % 2 ? SIGKILL : SIGTERM);
      if (wait_for(child) == 0) break;
      // Killed after the last step but one: the picture is there, and so is the checkpoint still.
      if (fs::exists(picture)) {
        EXPECT_EQ(text_of_file(picture), text_of_file(folder_ / "whole.pfm"));
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
  const ProgramOutcome other = shell("\"$MINKRAY\" render scene.json -o a.png -s 2 --resume");
  EXPECT_EQ(other.exit_code, 3);
  EXPECT_NE(other.err.find("a.png.checkpoint: is the checkpoint of another picture: "
                           "minkray.samples is 5000, not 2"),
            std::string::npos)
      << other.err;
  EXPECT_TRUE(fs::exists(folder_ / "a.png.checkpoint"));
  EXPECT_EQ(shell("\"$MINKRAY\" render scene.json -o a.png -s 2").exit_code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "a.png.checkpoint"));
}

TEST_F(NothingLost, a_full_disk_costs_the_new_picture_and_not_the_old_one) {
  if (fs::exists("/dev/full")) {
    const ProgramOutcome full =
        shell("ln -s /dev/full full.png; \"$MINKRAY\" render scene.json -o full.png -s 1");
    EXPECT_EQ(full.exit_code, 4);
    EXPECT_NE(full.err.find("full.png: No space left on device"), std::string::npos) << full.err;
    fs::remove(folder_ / "full.png");
  }
  // A limit of file sizes: some blocks can be written, and then no more.
  const ProgramOutcome limited =
      shell("echo old > a.pfm; ulimit -f 8; \"$MINKRAY\" render scene.json -o a.pfm -s 1");
  EXPECT_EQ(limited.exit_code, 4);
  EXPECT_NE(limited.err.find("a.pfm: File too large"), std::string::npos) << limited.err;
  EXPECT_EQ(text_of_file(folder_ / "a.pfm"), "old\n");
  EXPECT_EQ(folder_.files(), (std::vector<std::string>{"a.pfm", "scene.json"}));
}

TEST_F(NothingLost, a_full_file_system_as_well) {
  const ProgramOutcome mounted = shell("mkdir small && mount -t tmpfs -o size=16k minkray small");
  if (mounted.exit_code != 0) GTEST_SKIP() << "may not mount a tmpfs";
  const ProgramOutcome full = shell(
      "echo old > small/a.pfm; \"$MINKRAY\" render scene.json -o small/a.pfm -s 1; code=$?; "
      "cat small/a.pfm; ls -A small; exit $code");
  EXPECT_EQ(shell("umount small").exit_code, 0);
  EXPECT_EQ(full.exit_code, 4);
  EXPECT_NE(full.err.find("small/a.pfm: No space left on device"), std::string::npos) << full.err;
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
  const ProgramOutcome refused =
      shell("\"$MINKRAY\" render scene.json -o locked/a.png -s 16777216");
  EXPECT_EQ(refused.exit_code, 4);
  EXPECT_NE(refused.err.find("locked/a.png: "), std::string::npos) << refused.err;
  if (is_mount) {
    EXPECT_EQ(shell("umount locked").exit_code, 0);
  }
  ::chmod((folder_ / "locked").c_str(), 0700);
}

TEST_F(NothingLost, what_is_no_file_is_an_error_at_once) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe.json").c_str(), 0600), 0);
  ASSERT_EQ(::mkfifo((folder_ / "pipe.obj").c_str(), 0600), 0);
  ASSERT_EQ(::mkfifo((folder_ / "pipe.png.checkpoint").c_str(), 0600), 0);
  fs::create_directory(folder_ / "dir.png.checkpoint");
  ASSERT_EQ(::mkfifo((folder_ / "f#.png.frames").c_str(), 0600), 0);
  std::ofstream(folder_ / "mesh.json") << R"({"version": 1,
    "camera": {"position": [0, -5, 1], "look_at": [0, 0, 0]}, "lights": [],
    "materials": [{"name": "matt", "type": "lambert", "color": [1, 1, 1]}],
    "objects": [{"name": "hull", "shape": {"type": "hull", "file": "pipe.obj"},
                 "material": "matt"}]})";
  std::ofstream(folder_ / "huge.json") << "{";
  fs::resize_file(folder_ / "huge.json", std::uintmax_t{2} << 30);  // a hole: takes no disk
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"info pipe.json", "pipe.json: must be a file (got a pipe)"},
      {"info mesh.json", "pipe.obj: must be a file (got a pipe)"},
      {"info /dev/zero", "/dev/zero: must be a file (got a device)"},
      {"info .", ".: must be a file (got a directory)"},
      {"info huge.json", "huge.json: must not hold more than 268435456 bytes (got 2147483648)"},
      {"merge pipe.json -o a.png", "pipe.json: must be a file (got a pipe)"},
      {"merge . -o a.png", ".: must be a file (got a directory)"},
      {"render scene.json -o pipe.png --resume", "pipe.png.checkpoint: must be a file (got a pipe"},
      {"render scene.json -o dir.png --resume", "dir.png.checkpoint: must be a file (got a dir"},
      {"render scene.json -o f#.png --frames 0..1 --resume", "f#.png.frames: must be a file (got"},
      {"cast none.jsonl", "none.jsonl: cannot be read: No such file or directory"},
      {"cast .", ".: must be a file (got a directory)"},
  };
  for (const auto& [arguments, message] : cases) {
    // More is not taken for a file that is refused.
    const ProgramOutcome outcome = shell(limited_memory() + "timeout 10 \"$MINKRAY\" " + arguments);
    EXPECT_EQ(outcome.exit_code, 3) << arguments << outcome.err;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << arguments << ": " << outcome.err;
  }
}

// Files of 2 GB, without as much memory: what they begin with tells that they are no use.
TEST_F(NothingLost, a_huge_file_is_looked_at_before_it_is_read) {
  constexpr std::uintmax_t huge = std::uintmax_t{2} << 30;  // holes: they take no disk
  ASSERT_EQ(shell("\"$MINKRAY\" render scene.json -s 1 -o a.exr").exit_code, 0);
  std::ofstream(folder_ / "zeros.exr") << "";
  fs::copy_file(folder_ / "a.exr", folder_ / "long.exr");
  // A header that promises a large picture, and as large a file.
  std::string bytes = text_of_file(folder_ / "a.exr");
  const std::string window("dataWindow\0box2i", 16);
  const std::size_t at = bytes.find(window);
  ASSERT_NE(at, std::string::npos);
  const std::int32_t corner = 19999;
  for (const std::size_t entry : {2u, 3u})  // behind the name, the type and four bytes of size
    std::memcpy(bytes.data() + at + window.size() + 1 + 4 + 4 * entry, &corner, sizeof corner);
  std::ofstream(folder_ / "large.exr", std::ios::binary) << bytes;
  for (const char* name : {"zeros.exr", "long.exr", "large.exr"})
    fs::resize_file(folder_ / name, huge);
  std::vector<std::pair<std::string, std::string>> cases = {
      {"zeros.exr", ": cannot be used as an OpenEXR image: it does not begin like one"},
      {"long.exr", ": cannot be used as an OpenEXR image: its 2147483648 bytes are far more"},
  };
  if (!limited_memory().empty())
    cases.emplace_back("large.exr", ": there is not enough memory to read it");
  for (const auto& [name, message] : cases) {
    const ProgramOutcome merged =
        shell(limited_memory() + "timeout 10 \"$MINKRAY\" merge " + name + " -o a.png");
    EXPECT_EQ(merged.exit_code, 3) << merged.err;
    EXPECT_NE(merged.err.find(name + message), std::string::npos) << merged.err;
    fs::rename(folder_ / name, folder_ / "b.png.checkpoint");
    const ProgramOutcome resumed = shell(
        limited_memory() + "timeout 10 \"$MINKRAY\" render scene.json -s 1 -o b.png --resume");
    EXPECT_EQ(resumed.exit_code, 3) << resumed.err;
    EXPECT_NE(resumed.err.find("b.png.checkpoint" + message), std::string::npos) << resumed.err;
  }
}

// A pipe in the checkpoint's place is not waited for either when the picture is written.
TEST_F(NothingLost, what_is_no_checkpoint_stays) {
  ASSERT_EQ(::mkfifo((folder_ / "a.png.checkpoint").c_str(), 0600), 0);
  const ProgramOutcome done =
      shell("timeout 10 \"$MINKRAY\" render scene.json -s 1 -o a.png --checkpoint 0");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(fs::is_fifo(folder_ / "a.png.checkpoint"));
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

// 100 MB without a line's end, before a query that is answered all the same.
TEST_F(NothingLost, an_endless_line_is_an_error_and_does_not_fill_the_memory) {
  const ProgramOutcome outcome = shell(
      "(head -c 100000000 /dev/zero | tr '\\0' x; echo; "
      "echo '{\"type\": \"cast_ray\"}') > long.jsonl; " +
      limited_memory() + "\"$MINKRAY\" cast --threads 1 long.jsonl");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("long.jsonl:1: must not be longer than 67108864 bytes"),
            std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("long.jsonl:2: "), std::string::npos) << outcome.err;
}

TEST_F(NothingLost, values_that_do_not_fit_are_wrong_usage) {
  for (const std::string arguments : {"render scene.json -o a.png --seed 18446744073709551616",
                                      "render scene.json -o a.png --seed 99999999999999999999999",
                                      "render scene.json -o a.png --seed 1.5",
                                      "heatmap scene.json -o a.png --side-by-side ''",
                                      "render scene.json -o a.png --aov Z",
                                      "render scene.json -o a.exr --aov depth",
                                      "render scene.json -o a.exr --tile 3/2",
                                      "render scene.json -o a.png --tile 1/2",
                                      "render scene.json -o a.exr -r 2x2 --tile 1/5",
                                      "render scene.json -o a.exr -s 2 --sample-share 1/3",
                                      "render scene.json -o a.exr --sample-share 1/2 --aov Z",
                                      "render scene.json -o a.png --checkpoint -1",
                                      "render scene.json -o a.png --checkpoint nan",
                                      "heatmap scene.json -o a.png --side-by-side auto,fast",
                                      "render scene.json -o a.png --frames 0..1 --rate nan",
                                      "render scene.json -o a.png -o ./a.png",
                                      "generate spheres -o b.json --seed 18446744073709551616",
                                      "generate spheres -o b.f32",
                                      "trace scene.json --pixel 1,1 --svg scene.json",
                                      "distance-2d scene.json -o scene.json",
                                      "frobnicate",
                                      "merge -o a.png"}) {
    const ProgramOutcome outcome = shell("\"$MINKRAY\" " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_NE(outcome.err, "") << arguments;
  }
  EXPECT_EQ(shell("\"$MINKRAY\" trace scene.json --pixel 1,1 --svg ''").exit_code, 4);
  EXPECT_EQ(folder_.files(), std::vector<std::string>{"scene.json"});
  EXPECT_EQ(
      shell("\"$MINKRAY\" render scene.json -o a.png -s 1 --seed 18446744073709551615").exit_code,
      0);
}

TEST_F(NothingLost, no_output_takes_the_place_of_an_input_or_another_output) {
  const ProgramOutcome made = shell(R"(set -e
    fails() { expected=$1; shift; if "$MINKRAY" "$@"; then exit 1; else test $? = $expected; fi; }
    for i in 1 2; do "$MINKRAY" render scene.json -s 1 --tile $i/2 -o $i.exr; done
    cp 1.exr kept1.exr; cp 2.exr kept2.exr
    fails 2 merge 1.exr 2.exr -o 1.exr
    fails 2 merge 1.exr 2.exr -o ./2.exr
    cmp 1.exr kept1.exr; cmp 2.exr kept2.exr
    fails 2 render scene.json -s 1 -o 'f#.png' --frames 1..2 --contact-sheet ./f2.png
    fails 2 render scene.json -s 1 -o 'f#.png' --frames 0..1000000 --contact-sheet f1000000.png
    test ! -e f1.png
    echo notes > a.png.checkpoint
    fails 4 render scene.json -s 1 -o a.png
    "$MINKRAY" render scene.json -s 1 -o a.png --checkpoint 0
    grep -q notes a.png.checkpoint
    mkdir b.png.checkpoint
    fails 4 render scene.json -s 1 -o b.png
    test -d b.png.checkpoint)");
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.err.find("a.png.checkpoint: is no checkpoint"), std::string::npos) << made.err;
}

TEST_F(NothingLost, help_that_nobody_gets_is_no_success) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  EXPECT_EQ(shell("\"$MINKRAY\" --help > /dev/full").exit_code, 4);
  EXPECT_EQ(shell("\"$MINKRAY\" render --help > /dev/full").exit_code, 4);
  EXPECT_EQ(shell("\"$MINKRAY\" --version > /dev/full").exit_code, 4);
}

TEST_F(NothingLost, tiles_are_rendered_once_and_merged_to_the_same_picture) {
  const ProgramOutcome made = shell(R"(set -e
    "$MINKRAY" render scene.json -s 3 -o whole.exr -o whole.png -o whole.pfm --aov all
    for i in 1 2 3; do "$MINKRAY" render scene.json -s 3 --tile $i/3 -o $i.exr --aov all; done
    "$MINKRAY" render scene.json -s 3 --tile 2/3 -o 2.exr --aov all --resume
    "$MINKRAY" merge 3.exr 1.exr 2.exr -o merged.exr -o merged.png -o merged.pfm
    cmp whole.png merged.png; cmp whole.pfm merged.pfm
    "$MINKRAY" merge merged.exr -o x.png 2> refused && exit 1; cat refused >&2
    if "$MINKRAY" render scene.json -s 4 --tile 2/3 -o 2.exr --aov all --resume; then exit 1; fi)");
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.err.find("2.exr: is there already"), std::string::npos);
  EXPECT_NE(made.err.find("2.exr: is of another picture: minkray.samples is 3, not 4"),
            std::string::npos);
}

// But for how long they took, on how many threads, and by which command. A render that is over
// before it can be interrupted is begun anew with more samples.
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
  ASSERT_EQ(shell("\"$MINKRAY\" " + command).exit_code, 0);
  if (!has_program("exrheader") && !has_program("iinfo"))
    GTEST_SKIP() << "needs exrheader (openexr) or iinfo (openimageio-tools)";
  if (has_program("exrheader")) {
    const std::string header = shell("exrheader a.exr").out;
    std::string version = shell("\"$MINKRAY\" --version").out;
    version.erase(version.find_last_not_of('\n') + 1);
    const auto text = [](const std::string& name, const std::string& value) {
      return "\n" + name + " (type string): \"" + value + "\"\n";
    };
    const std::string hash = load_scene(folder_ / "scene.json").hash;
    EXPECT_EQ(hash.size(), 16u);
    for (const std::string& line :
         {std::string("dataWindow (type box2i): (0 0) - (63 47)"),
          std::string("id.object, 32-bit unsigned integer"),
          std::string("gjk.gap, 32-bit floating-point"), text("minkray.seed", "7"),
          text("minkray.samples", "2"), text("minkray.resolution", "64x48"),
          text("minkray.crop", "0,0,64,48"), text("minkray.bounces", "1"),
          text("minkray.scene", hash), text("minkray.command", "minkray " + command),
          text("software", version)})
      EXPECT_NE(header.find(line), std::string::npos) << line << header;
  }
  if (has_program("iinfo")) {
    const std::string info = shell("iinfo -v --stats a.exr").out;
    EXPECT_NE(info.find("17 channel"), std::string::npos) << info;
    EXPECT_NE(info.find("Stats NanCount: 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0"), std::string::npos);
  }
}

}  // namespace
}  // namespace minkray
