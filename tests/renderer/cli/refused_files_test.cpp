// SPDX-License-Identifier: MIT
// Files that are none, too large, or not what they are taken for: an error at once, in little
// memory.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "tests/renderer/cli/nothing_lost.h"
#include "tests/support/expect_exit.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

namespace fs = std::filesystem;

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
    EXPECT_TRUE(has(outcome.err, message)) << arguments;
  }
}

// Files of 2 GB, without as much memory: their first bytes show that they are unusable.
TEST_F(NothingLost, a_huge_file_is_looked_at_before_it_is_read) {
  constexpr std::uintmax_t huge = std::uintmax_t{2} << 30;  // holes: they take no disk
  ASSERT_EQ(minkray("render scene.json -s 1 -o a.exr").exit_code, 0);
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
      {"zeros.exr",
       ": cannot be used as an OpenEXR image: it does not begin with the bytes of an OpenEXR file"},
      {"long.exr", ": cannot be used as an OpenEXR image: its 2147483648 bytes are far more"},
  };
  if (!limited_memory().empty()) cases.emplace_back("large.exr", ": not enough memory to read it");
  for (const auto& [name, message] : cases) {
    expect_exit(3, shell(limited_memory() + "timeout 10 \"$MINKRAY\" merge " + name + " -o a.png"),
                {name + message});
    fs::rename(folder_ / name, folder_ / "b.png.checkpoint");
    expect_exit(3,
                shell(limited_memory() +
                      "timeout 10 \"$MINKRAY\" render scene.json -s 1 -o b.png --resume"),
                {"b.png.checkpoint" + message});
  }
}

// A pipe in the checkpoint's place is not waited for either when the picture is written.
TEST_F(NothingLost, what_is_no_checkpoint_stays) {
  ASSERT_EQ(::mkfifo((folder_ / "a.png.checkpoint").c_str(), 0600), 0);
  expect_exit(0, shell("timeout 10 \"$MINKRAY\" render scene.json -s 1 -o a.png --checkpoint 0"));
  EXPECT_TRUE(fs::is_fifo(folder_ / "a.png.checkpoint"));
}

// 100 MB without a line's end, before a query that is answered all the same.
TEST_F(NothingLost, an_endless_line_is_an_error_and_does_not_fill_the_memory) {
  expect_exit(3,
              shell("(head -c 100000000 /dev/zero | tr '\\0' x; echo; "
                    "echo '{\"type\": \"cast_ray\"}') > long.jsonl; " +
                    limited_memory() + "\"$MINKRAY\" cast --threads 1 long.jsonl"),
              {"long.jsonl:1: must not be longer than 67108864 bytes", "long.jsonl:2: "});
}

}  // namespace
}  // namespace minkray
