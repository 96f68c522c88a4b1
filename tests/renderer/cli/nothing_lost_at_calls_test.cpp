// SPDX-License-Identifier: MIT
// The program is killed before each of its calls that write files, one after the other, or the call
// fails: what no luck with the moment is needed for (tests/support/fault_at_call.cpp).
#include <gtest/gtest.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "renderer/io/exr.h"
#include "tests/renderer/cli/nothing_lost.h"
#include "tests/support/expect_exit.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

namespace fs = std::filesystem;

/// Content of the old file; no program reads it.
constexpr const char* old_content = "old\n";

/// Largest number of starts of a program, in case it never ends by itself.
constexpr int most_calls = 200;

struct Command {
  std::string arguments, output;

  std::string line() const { return "\"$MINKRAY\" " + arguments + " -o " + output; }
};

const std::vector<Command> commands = {
    {"render scene.json -r 8x6 -s 2 -t 1 -q", "a.png"},
    {"render scene.json -r 8x6 -s 2 -t 1 -q --aov all", "a.exr"},
    {"merge 1.exr 2.exr", "m.exr"},
    {"heatmap scene.json -r 8x6 -t 1 -q", "h.png"},
    {"generate hulls -n 2", "g.json"},
};

/// Shell command that kills the program before that call, or makes the call fail with the error.
/// The program's calls are listed in the file "calls".
std::string with_fault(const std::string& program, int at, int error = 0) {
  return "rm -f calls; MINKRAY_FAULT_LOG=calls MINKRAY_FAULT_AT=" + std::to_string(at) +
         " MINKRAY_FAULT=" + std::to_string(error) + " LD_PRELOAD='" MINKRAY_FAULT_AT_CALL "' " +
         program + "; exit $?";  // by a shell that is there still
}

std::vector<std::string> lines_of(const std::string& file) {
  std::istringstream text(text_of_file(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// True if two files hold the same picture. A header contains the time it took.
bool are_same(const std::string& a, const std::string& b) {
  if (!a.ends_with(".exr")) return text_of_file(a) == text_of_file(b);
  const ExrImage one = read_exr(a), other = read_exr(b);
  return std::equal(one.planes.begin(), one.planes.end(), other.planes.begin(), other.planes.end(),
                    [](const ExrPlane& p, const ExrPlane& q) {
                      return p.name == q.name && p.values == q.values;
                    });
}

/// Leaves out what SIGKILL leaves no time to remove.
std::vector<std::string> without_temporary_files(std::vector<std::string> files) {
  std::erase_if(files, [](const std::string& name) {
    return name.starts_with(".") && name.ends_with(".tmp");
  });
  return files;
}

/// Shell command that makes the part files that `merge` needs.
constexpr const char* make_part_files =
    "for i in 1 2; do \"$MINKRAY\" render scene.json -r 8x6 -s 1 --tile $i/2 -o $i.exr || exit; "
    "done";

/// Shell command that makes the undisturbed output of the command, next to its place.
std::string make_whole(const Command& command) {
  return command.line() + " && mv " + command.output + " new-" + command.output;
}

TEST_F(NothingLost, killed_before_any_call_the_old_file_is_there_or_the_new_one) {
  ASSERT_EQ(shell(make_part_files).exit_code, 0);
  for (const Command& command : commands) {
    const std::string target = folder_ / command.output, whole = folder_ / "new-" + command.output;
    ASSERT_EQ(shell(make_whole(command)).exit_code, 0);
    int old_ones = 0, new_ones = 0, exit_code = -1;
    for (int at = 1; exit_code != 0; ++at) {
      ASSERT_LT(at, most_calls) << command.line();
      std::ofstream(target) << old_content;
      const std::vector<std::string> before = folder_.files();
      exit_code = shell(with_fault(command.line(), at)).exit_code;
      const bool is_old = text_of_file(target) == old_content;
      ++(is_old ? old_ones : new_ones);
      EXPECT_TRUE(is_old || are_same(target, whole)) << command.line() << ", call " << at;
      std::vector<std::string> files = without_temporary_files(folder_.files());
      std::erase(files, "calls");
      EXPECT_EQ(files, before) << command.line() << ", call " << at;
      expect_exit(0, shell("rm -f calls .[!.]*"));
    }
    EXPECT_GT(old_ones, 5) << command.line();  // the faults met the writing of the file
    EXPECT_GT(new_ones, 1) << command.line();  // and what comes after it
    fs::remove(target);
  }
}

TEST_F(NothingLost, whichever_call_fails_the_old_file_is_there_and_the_user_is_told) {
  ASSERT_EQ(shell(make_part_files).exit_code, 0);
  std::ofstream(folder_ / "calls");
  for (const Command& command : commands) {
    const std::string target = folder_ / command.output, whole = folder_ / "new-" + command.output;
    ASSERT_EQ(shell(make_whole(command)).exit_code, 0);
    int message = 0;
    for (int at = 1;; ++at) {
      ASSERT_LT(at, most_calls) << command.line();
      std::ofstream(target) << old_content;
      const std::vector<std::string> before = folder_.files();
      const int error = at % 2 == 0 ? ENOSPC : EIO;
      const ProgramOutcome outcome = shell(with_fault(command.line(), at, error));
      EXPECT_EQ(folder_.files(), before) << command.line() << ", call " << at;
      std::string failed;
      for (const std::string& line : lines_of(folder_ / "calls"))
        if (line.ends_with(" fails")) failed = line;
      // Closing what nothing was written to may fail, and putting a folder on the disk.
      const bool matters = failed.starts_with("rename ") ||
                           (failed.ends_with(".tmp fails") && !failed.starts_with("close "));
      if (outcome.exit_code == 0) {
        EXPECT_FALSE(matters) << command.line() << ": " << failed;
        EXPECT_TRUE(are_same(target, whole)) << command.line() << ": " << failed;
      } else {
        ++message;
        EXPECT_EQ(outcome.exit_code, 4) << command.line() << ": " << failed;
        EXPECT_EQ(text_of_file(target), old_content) << command.line() << ": " << failed;
        EXPECT_TRUE(has(outcome.err, command.output + ": " + std::strerror(error)))
            << command.line() << ": " << failed;
      }
      if (failed.empty()) break;
    }
    EXPECT_GT(message, 4) << command.line();
    fs::remove(target);
  }
}

TEST_F(NothingLost, a_file_is_on_the_disk_before_it_is_renamed_and_its_name_afterwards) {
  const std::string folder = fs::canonical(folder_ / ".").string();
  for (const Command& command : commands) {
    if (command.arguments.starts_with("merge")) continue;
    ASSERT_EQ(shell(with_fault(command.line(), 0)).exit_code, 0);
    const std::vector<std::string> calls = lines_of(folder_ / "calls");
    /// Behind the last call that begins and ends like this.
    const auto last = [&](const std::string& begin, const std::string& end) {
      for (std::size_t i = calls.size(); i > 0; --i)
        if (calls[i - 1].starts_with(begin) && calls[i - 1].ends_with(end)) return i;
      return std::size_t{0};
    };
    const std::size_t written = last("write ", ".tmp"), synced = last("fsync ", ".tmp");
    const std::size_t renamed = last("rename ", command.output);
    EXPECT_GT(written, 0u) << command.line();
    EXPECT_GT(synced, written) << command.line();
    EXPECT_GT(renamed, synced) << command.line();
    EXPECT_GT(last("fsync " + folder, folder), renamed) << command.line();
  }
}

// With a checkpoint whenever a tile is done; each run may make a few calls more than the last.
TEST_F(NothingLost, killed_before_any_call_a_render_goes_on_to_the_same_picture) {
  const std::string render = "\"$MINKRAY\" render scene.json -s 2 -t 1 -q -o ";
  ASSERT_EQ(shell(render + "whole.pfm").exit_code, 0);
  int kills = 0;
  while (shell(with_fault(render + "a.pfm --checkpoint 1e-9 --resume", 1 + 2 * kills)).exit_code !=
         0) {
    ASSERT_LT(++kills, most_calls);
    if (fs::exists(folder_ / "a.pfm")) {
      EXPECT_TRUE(are_same(folder_ / "a.pfm", folder_ / "whole.pfm")) << kills;
    }
  }
  EXPECT_GT(kills, 4);
  EXPECT_TRUE(are_same(folder_ / "a.pfm", folder_ / "whole.pfm"));
  EXPECT_FALSE(fs::exists(folder_ / "a.pfm.checkpoint"));
}

// Over frames with other options; --resume then either makes all frames new, or refuses because not
// one is.
TEST_F(NothingLost, killed_before_any_call_frames_are_never_mixed) {
  const auto frames = [](const std::string& name, const std::string& options) {
    return "\"$MINKRAY\" render scene.json -r 8x6 -t 1 -q --frames 0..1 -o '" + name + "' " +
           options;
  };
  ASSERT_EQ(shell(frames("old#.pfm", "-s 1") + " && " + frames("new#.pfm", "-s 2")).exit_code, 0);
  ASSERT_FALSE(are_same(folder_ / "old0.pfm", folder_ / "new0.pfm"));
  const auto are = [&](const std::string& which) {
    return are_same(folder_ / "f0.pfm", folder_ / (which + "0.pfm")) &&
           are_same(folder_ / "f1.pfm", folder_ / (which + "1.pfm"));
  };
  int refused = 0, exit_code = -1;
  for (int at = 1; exit_code != 0; ++at) {
    ASSERT_LT(at, most_calls);
    ASSERT_EQ(shell("rm -f .[!.]* f*; for i in 0.pfm 1.pfm '#.pfm.frames'; do "
                    "cp \"old$i\" \"f$i\"; done")
                  .exit_code,
              0);
    exit_code = shell(with_fault(frames("f#.pfm", "-s 2"), at)).exit_code;
    const ProgramOutcome resumed = shell(frames("f#.pfm", "-s 2 --resume"));
    if (resumed.exit_code != 0) {
      ++refused;
      EXPECT_EQ(resumed.exit_code, 3) << at;
      EXPECT_TRUE(has(resumed.err,
                      "f#.pfm.frames: is the record of other frames: "
                      "minkray.samples is 1, not 2"));
    }
    EXPECT_TRUE(are(resumed.exit_code == 0 ? "new" : "old")) << at;
  }
  EXPECT_GT(refused, 3);
}

}  // namespace
}  // namespace minkray
