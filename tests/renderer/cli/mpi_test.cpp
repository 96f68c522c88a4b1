// SPDX-License-Identifier: MIT
// Pictures that the ranks of an MPI job share, on one machine.
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>

#include "renderer/share/ranks.h"
#include "tests/renderer/cli/drivers.h"
#include "tests/support/expect_exit.h"

namespace minkray {
namespace {

namespace fs = std::filesystem;

class Mpi : public Drivers {
 protected:
  void SetUp() override {
    if (!has_mpi) GTEST_SKIP() << "built without MPI (libopenmpi-dev)";
    if (!has_program("mpirun")) GTEST_SKIP() << "needs mpirun (openmpi-bin)";
    allow_root();
    ::setenv("ASAN_OPTIONS", "detect_leaks=0", 1);  // Open MPI's own, where a sanitizer looks
  }
  void allow_root() {
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  }

  /// The tiles' files that are there, and their numbers.
  std::map<std::string, ino_t> tiles() const {
    std::map<std::string, ino_t> found;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder_ / "a.pfm.parts", error)) {
      struct stat status = {};
      if (entry.path().extension() == ".exr" && ::stat(entry.path().c_str(), &status) == 0)
        found[entry.path().filename().string()] = status.st_ino;
    }
    return found;
  }

  bool has_picture() const { return fs::exists(folder_ / "a.pfm"); }

  /// None once it has ended.
  static std::vector<pid_t> children_of(pid_t parent) {
    std::vector<pid_t> children;
    const std::string tasks = "/proc/" + std::to_string(parent) + "/task";
    std::error_code error;
    for (const auto& task : fs::directory_iterator(tasks, error)) {
      std::istringstream list(text_of_file(task.path() / "children"));
      for (pid_t child = 0; list >> child;) children.push_back(child);
    }
    return children;
  }

  static constexpr const char* render =
      "mpirun --oversubscribe -n 4 \"$MINKRAY\" render scene.json -t 1 -s 8 -o a.pfm --tiles 9 ";
};

TEST_F(Mpi, four_ranks_make_the_same_picture_as_one) {
  const ProgramOutcome made = shell(render);
  expect_same_picture(made);
  expect_parts(made.err, {"rank 0 of 4 on ", "rank 3 of 4 on "});
  EXPECT_TRUE(has(made.err, ": 1 thread"));
}

// A rank is killed when some tiles are there, and a rank of the next job as well. The files'
// numbers (inodes) show that finished tiles are kept. A job that is over before its rank can be
// killed is repeated with more samples.
TEST_F(Mpi, a_job_whose_rank_was_killed_goes_on_to_the_same_picture) {
  int samples = 800, kills = 0;
  const auto start = [&](const char* ranks) {
    return start_program({"mpirun", "--oversubscribe", "-n", ranks, minkray_program(), "render",
                          folder_ / "scene.json", "-t", "1", "-s", std::to_string(samples), "-o",
                          folder_ / "a.pfm", "--resume", "--tiles", "48"});
  };
  /// Starts a job and kills a rank when there are three more tiles: whether it came to that.
  const auto killed = [&](const std::map<std::string, ino_t>& before) {
    const pid_t job = start("4");
    for (int i = 0; i < 60000 && tiles().size() < before.size() + 3 && !has_picture(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const std::vector<pid_t> ranks = children_of(job);
    if (ranks.size() == 4) ::kill(ranks.back(), SIGKILL);
    const int status = wait_for(job);
    EXPECT_TRUE(ranks.size() == 4 || status == 0);
    return status != 0 && !has_picture();  // with the picture the job was as good as over
  };
  for (; kills < 2; samples *= 4) {
    ASSERT_LE(samples, 51200) << "however long it is, the job is over before a rank is killed";
    fs::remove(folder_ / "a.pfm");
    fs::remove_all(folder_ / "a.pfm.parts");
    std::map<std::string, ino_t> before;
    for (kills = 0; kills < 2 && killed(before); ++kills) {
      const std::map<std::string, ino_t> after = tiles();
      EXPECT_GE(after.size(), before.size() + 3);
      for (const auto& [name, inode] : before) EXPECT_EQ(after.at(name), inode) << name;
      before = after;
    }
    if (kills == 2) break;
  }
  EXPECT_EQ(wait_for(start("3")), 0);
  EXPECT_FALSE(fs::exists(folder_ / "a.pfm.parts"));
  EXPECT_EQ(wait_for(start_minkray({"render", folder_ / "scene.json", "-s", std::to_string(samples),
                                    "-o", folder_ / "whole.pfm"})),
            0);
  EXPECT_EQ(text_of_file(folder_ / "a.pfm"), text_of_file(folder_ / "whole.pfm"));
}

// Files left by killed ranks are removed with the tiles; files that do not belong to the picture
// stay.
TEST_F(Mpi, files_of_others_beside_the_tiles_stay) {
  const std::string parts = folder_ / "a.pfm.parts/";
  fs::create_directory(parts);
  for (const char* name : {"notes.txt", "000001-of-000010.exr", "000001-of-000009.exr.checkpoint",
                           ".000002-of-000009.exr.123.0123abcd.tmp",
                           ".000002-of-000009.exr.checkpoint.1.0123abcd.tmp"})
    std::ofstream(parts + name) << "\x76\x2f\x31\x01";
  expect_exit(0, shell(render),
              {"note: a.pfm.parts is not removed: it contains more than this picture's tiles"});
  EXPECT_EQ(tiles().size(), 1u);
  EXPECT_EQ(std::distance(fs::directory_iterator(parts), fs::directory_iterator()), 2);
  EXPECT_TRUE(fs::exists(parts + "notes.txt"));
  EXPECT_TRUE(fs::exists(parts + "000001-of-000010.exr"));
}

TEST_F(Mpi, ranks_tell_their_threads_and_warn_where_they_are_pinned_to_one_core) {
  if (!has_program("taskset")) GTEST_SKIP() << "needs taskset (util-linux)";
  if (::sysconf(_SC_NPROCESSORS_ONLN) < 2) GTEST_SKIP() << "needs two cores";
  cpu_set_t cores;
  CPU_ZERO(&cores);
  ASSERT_EQ(::sched_getaffinity(0, sizeof cores, &cores), 0);
  int core = 0;
  while (!CPU_ISSET(core, &cores)) ++core;
  const auto run = [&](const std::string& pin) {
    return shell("mpirun --oversubscribe --bind-to none -n 2 " + pin +
                 " \"$MINKRAY\" render scene.json -s 1 -t 3 -o a.pfm --tiles 2");
  };
  const ProgramOutcome pinned = run("taskset -c " + std::to_string(core));
  EXPECT_EQ(pinned.exit_code, 0) << pinned.err;
  for (const std::string rank : {"rank 0 of 2", "rank 1 of 2"}) {
    expect_parts(pinned.err, {"warning: " + rank + " is pinned to one of ", rank + " on "});
  }
  EXPECT_TRUE(has(pinned.err, ": 3 threads\n"));
  if (CPU_COUNT(&cores) > 1) {
    EXPECT_FALSE(has(run("").err, "is pinned"));
  }
}

// Only rank 0 writes the picture: the others are ended with it, and leave nothing behind.
TEST_F(Mpi, mistakes_end_the_job_with_their_code) {
  expect_exit(4, shell("mpirun --oversubscribe -n 2 \"$MINKRAY\" render scene.json -o none/a.pfm"),
              {"cannot write none/a.pfm: "});
  EXPECT_EQ(folder_.files(), std::vector<std::string>{"scene.json"});
  expect_exit(2, minkray("render scene.json -o a.pfm --tiles 4"));
}

}  // namespace
}  // namespace minkray
